"""Tables composed of photographs of single cards; the cards here are drawn."""

from __future__ import annotations

import re
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain
from seewhy.errors import DatasetError
from seewhy_lab import commands
from seewhy_lab.commands.set_tables import HEIGHT, WIDTH, main, photographs

COLOURS = {"red": (200, 30, 30), "green": (20, 130, 40), "purple": (90, 20, 140)}


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Cards of a part of the kinds, taken in eight goes."""
    folder = tmp_path_factory.mktemp("cards")
    for number, colour, shape in product("123", COLOURS, ("oval", "diamond")):
        kind = folder / f"{number}-{colour}-solid-{shape}{'s' * (number > '1')}"
        kind.mkdir()
        for go in range(8):
            card = Image.new("RGB", (60, 90), (235, 235, 230))
            draw = ImageDraw.Draw(card)
            for place in range(int(number)):
                draw.rectangle((15, 10 + 26 * place, 45, 28 + 26 * place), fill=COLOURS[colour])
            card.save(kind / f"2020_{go}_1_0.png")
    return folder


@pytest.fixture(scope="module")
def tables(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("tables")
    main(source, out=out, count=6, seed=3)
    return out


def test_what_is_written_is_a_dataset(tables: Path) -> None:
    dataset = Dataset.load(tables, load_domain("set_cards"))
    assert [scene.split for scene in dataset.scenes] == ["train", "train", "test"] * 2
    for scene in dataset.scenes:
        assert 9 <= len(scene.things) <= 12
        kinds = [tuple(thing.values.values()) for thing in scene.things]
        assert len(set(kinds)) == len(kinds)
        with Image.open(scene.picture) as picture:
            assert picture.size == (WIDTH, HEIGHT)


def test_boxes_lie_around_the_cards(tables: Path) -> None:
    dataset = Dataset.load(tables, load_domain("set_cards"))
    for scene in dataset.scenes[:3]:
        with Image.open(scene.picture) as picture:
            pixels = np.asarray(picture, float)
        for thing in scene.things:
            assert thing.box is not None
            column, row = map(int, thing.box.middle)
            colour = COLOURS[thing.values["colour"]]
            number = {"one": 1, "two": 2, "three": 3}[thing.values["number"]]
            # The middle of a card shows its symbol, or what is between two.
            high = thing.box.bottom - thing.box.top
            middle = pixels[row - int(high / 4) : row + int(high / 4), column - 3 : column + 3]
            strongest = int(np.argmax(colour))
            nearest = np.abs(middle - np.array(colour) * 1.0).sum(axis=2).min()
            assert nearest < 130, (thing, number, strongest)


def test_photographs_of_training_are_not_judged_on(source: Path) -> None:
    cards = photographs(source)
    groups = {
        part: {card.group for card in cards if card.is_test is part} for part in (True, False)
    }
    assert groups[True]
    assert groups[False]
    assert groups[True].isdisjoint(groups[False])


def test_the_same_seed_makes_the_same_tables(source: Path, tables: Path, tmp_path: Path) -> None:
    main(source, out=tmp_path, count=2, seed=3)
    for name in ("000000.jpg", "000001.jpg"):
        assert (tmp_path / "images" / name).read_bytes() == (tables / "images" / name).read_bytes()


def test_folders_that_are_no_kinds_of_cards(tmp_path: Path) -> None:
    (tmp_path / "2-red-dotted-oval").mkdir()
    with pytest.raises(DatasetError, match="must be called NUMBER-COLOUR-SHADING-SHAPE"):
        photographs(tmp_path)


def test_a_folder_without_pictures(tmp_path: Path) -> None:
    with pytest.raises(DatasetError, match="has no pictures in folders called as in"):
        photographs(tmp_path)


def test_too_few_kinds(source: Path, tmp_path: Path) -> None:
    few = tmp_path / "few"
    few.mkdir()
    for folder in sorted(source.iterdir())[:3]:
        (few / folder.name).symlink_to(folder)
    with pytest.raises(DatasetError, match="kinds of cards for one part of the tables"):
        main(few, out=tmp_path / "out", count=3, seed=0)


def test_whatever_runs_as_a_program_is_defined_before_it_runs() -> None:
    """``python -m seewhy_lab NAME`` runs the module's last line while it is read."""
    late = [
        file.name
        for file in Path(commands.__file__).parent.glob("*.py")
        if re.search(
            r"^(def|class) ", file.read_text().partition('if __name__ == "__main__":')[2], re.M
        )
    ]
    assert late == []
