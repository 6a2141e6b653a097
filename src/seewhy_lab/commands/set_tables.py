"""Compose pictures of tables with several cards of the game SET from photographs of single cards.

    python -m seewhy_lab set_tables SOURCE --count 300 --seed 0 --out tables

SOURCE has a folder for each of the 81 kinds, called NUMBER-COLOUR-SHADING-SHAPE, as in
``2-red-striped-oval``. Each photograph shows one card on a dark ground. On a table lie 9 to 12
cards, no two of one kind, a little turned and of slightly different size, on a plain, a wooden or a
noisy ground. Photographs that were taken in one go, which their names tell, are either all for
training or all for judging: a table of ``split = test`` shows none that one for training shows.
The folder is a dataset of the domain ``set_cards``; photographs stay where they are, and what is
written holds parts of them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray
from PIL import Image, ImageFilter

from seewhy.data.dataset import Dataset
from seewhy.data.scene import Scene
from seewhy.data.table_writing import write_tables
from seewhy.data.thing import BoundingBox, Thing
from seewhy.domain.domain import load_domain
from seewhy.errors import DatasetError, PictureError
from seewhy.perception.picture_file import open_picture

__all__ = ["compose", "main", "photographs"]

NUMBERS = {"1": "one", "2": "two", "3": "three"}
KINDS = 81
FEWEST, MOST = 9, 12
WIDTH, HEIGHT = 960, 720
_PARTS = 3  # One in so many tables, and about one in so many photographs, is for judging.
_PICTURES = (".jpg", ".jpeg", ".png")
_COLUMNS = {9: 3, 10: 4, 11: 4, 12: 4}


@dataclass(frozen=True)
class Photograph:
    """A photograph of one card; ``group`` names those that were taken in one go."""

    file: Path
    values: tuple[tuple[str, str], ...]
    group: str

    @property
    def is_test(self) -> bool:
        """Whether it is for judging: told by its group alone, so that no run mixes them."""
        return int(sha256(f"final/{self.group}".encode()).hexdigest()[:8], 16) % _PARTS == 0


def photographs(source: Path) -> list[Photograph]:
    """Return the photographs of single cards in class folders, with what each shows.

    Raises
    ------
    DatasetError
        If a folder is not called as it must be, or there are no pictures.
    """
    found: list[Photograph] = []
    features = load_domain("set_cards").things
    assert features is not None, "the domain has things"
    for folder in sorted(path for path in source.glob("*") if path.is_dir()):
        parts = folder.name.split("-")
        named = [NUMBERS.get(parts[0], ""), *(part.removesuffix("s") for part in parts[1:])]
        values = dict(zip(features.features, named, strict=False))
        wrong = len(parts) != len(features.features) or any(
            value not in features.features[key].values for key, value in values.items()
        )
        if wrong:
            raise DatasetError(
                f"{folder}: must be called NUMBER-COLOUR-SHADING-SHAPE, as in 2-red-striped-oval"
            )
        for file in sorted(folder.iterdir()):
            if file.suffix.lower() in _PICTURES:
                group = "_".join(file.stem.split("_")[:2])
                found.append(Photograph(file, tuple(values.items()), group))
    if not found:
        raise DatasetError(
            f"{source}: has no pictures in folders called as in 2-red-striped-oval; name the "
            "folder that holds the 81 of them"
        )
    return found


def compose(
    cards: list[Photograph], rng: np.random.Generator
) -> tuple[Image.Image, list[tuple[Photograph, BoundingBox]]]:
    """Lay photographs of cards on a table, in rows; return the picture and where each lies."""
    ground = _ground(rng)
    columns = _COLUMNS[len(cards)]
    rows = math.ceil(len(cards) / columns)
    cell = (WIDTH / columns, HEIGHT / rows)
    places = rng.permutation(columns * rows)[: len(cards)]
    found = []
    for card, place in zip(cards, sorted(int(place) for place in places), strict=True):
        row, column = divmod(place, columns)
        picture, mask = _turned(_photograph(card.file), cell, rng)
        spare = (cell[0] - picture.width, cell[1] - picture.height)
        left = round(column * cell[0] + spare[0] * rng.uniform(0.2, 0.8))
        top = round(row * cell[1] + spare[1] * rng.uniform(0.2, 0.8))
        ground.paste(picture, (left, top), mask)
        box = mask.point(lambda value: 255 if value > 127 else 0).getbbox()
        assert box is not None, "a card covers something"
        found.append((card, BoundingBox(left + box[0], top + box[1], left + box[2], top + box[3])))
    bright = rng.uniform(0.85, 1.12)
    return ground.point(lambda value: min(255, round(value * bright))), found


def _turned(
    picture: Image.Image, cell: tuple[float, float], rng: np.random.Generator
) -> tuple[Image.Image, Image.Image]:
    """A card, slightly turned and scaled so that it fits its place, and where it covers that."""
    angle = float(rng.uniform(-8.0, 8.0))
    sine, cosine = abs(math.sin(math.radians(angle))), abs(math.cos(math.radians(angle)))
    wide = cosine * picture.width + sine * picture.height
    high = sine * picture.width + cosine * picture.height
    scale = float(rng.uniform(0.78, 0.92)) * min(cell[0] / wide, cell[1] / high)
    size = (max(8, round(picture.width * scale)), max(8, round(picture.height * scale)))
    picture = picture.resize(size, Image.Resampling.LANCZOS)
    mask = Image.new("L", size, 255)
    turn = {"resample": Image.Resampling.BICUBIC, "expand": True}
    return picture.rotate(angle, **turn), mask.rotate(angle, **turn)  # type: ignore[arg-type]


def _ground(rng: np.random.Generator) -> Image.Image:
    """A table: plain, wooden or noisy."""
    colour = rng.uniform(40, 170) * rng.uniform(0.8, 1.2, 3)
    pixels = np.ones((HEIGHT, WIDTH, 1)) * np.clip(colour, 15, 190)
    kind = rng.choice(["plain", "wood", "noise"])
    if kind == "wood":
        pixels *= 1.0 + 0.18 * _noise((HEIGHT, 8), rng)[..., None]
    elif kind == "noise":
        pixels *= 1.0 + 0.30 * _noise((HEIGHT // 6, WIDTH // 6), rng)[..., None]
    pixels += rng.normal(0.0, 4.0, pixels.shape)
    return Image.fromarray(np.clip(pixels, 0, 255).astype(np.uint8))


def _noise(shape: tuple[int, int], rng: np.random.Generator) -> NDArray[np.float64]:
    """Smooth noise from -1 to 1 over the whole table."""
    small = Image.fromarray((rng.uniform(size=shape) * 255).astype(np.uint8))
    large = small.resize((WIDTH, HEIGHT), Image.Resampling.BICUBIC)
    return np.asarray(large.filter(ImageFilter.GaussianBlur(1.5)), float) / 127.5 - 1.0


def main(
    source: Annotated[Path, typer.Argument(help="The folder with 81 folders of photographs.")],
    out: Annotated[Path, typer.Option("--out", help="The folder to write.")],
    count: Annotated[int, typer.Option("--count", min=2, help="How many tables.")] = 300,
    seed: Annotated[int, typer.Option("--seed", help="Another seed makes other tables.")] = 0,
) -> None:
    """Compose tables; every third is for judging, and shows photographs of its own."""
    domain = load_domain("set_cards")
    cards = photographs(source)
    (out / "images").mkdir(parents=True, exist_ok=True)
    scenes = []
    for index in range(count):
        rng = np.random.default_rng([seed, index])
        is_test = index % _PARTS == _PARTS - 1
        chosen = _drawn([card for card in cards if card.is_test is is_test], rng, source)
        picture, placed = compose(chosen, rng)
        file = out / "images" / f"{index:06d}.jpg"
        picture.save(file, quality=92)
        things = tuple(
            Thing(str(number), dict(card.values), box)
            for number, (card, box) in enumerate(placed, start=1)
        )
        split = "test" if is_test else "train"
        whole = (None,) * len(domain.features)
        scenes.append(Scene(file, whole, split=split, group=f"table{index}", things=things))
    write_tables(Dataset(tuple(scenes), domain, out))
    print(f"{count} tables in {out}")


def _drawn(cards: list[Photograph], rng: np.random.Generator, source: Path) -> list[Photograph]:
    """So many photographs as lie on a table, no two of one kind."""
    by_kind: dict[tuple[tuple[str, str], ...], list[Photograph]] = {}
    for card in cards:
        by_kind.setdefault(card.values, []).append(card)
    count = int(rng.integers(FEWEST, MOST + 1))
    if len(by_kind) < count:
        raise DatasetError(
            f"{source}: has photographs of {len(by_kind)} kinds of cards for one part of the "
            f"tables, and a table shows up to {MOST}; add some"
        )
    kinds = list(by_kind)
    chosen = [kinds[at] for at in rng.permutation(len(kinds))[:count]]
    return [by_kind[kind][int(rng.integers(len(by_kind[kind])))] for kind in chosen]


def _photograph(file: Path) -> Image.Image:
    try:
        with open_picture(file) as opened:
            return opened.convert("RGB")
    except PictureError as problem:
        raise PictureError(f"{file} {problem}") from None


if __name__ == "__main__":
    typer.run(main)
