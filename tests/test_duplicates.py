"""The same picture twice, and pictures that are nearly the same."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from seewhy.data.dataset import Dataset
from seewhy.data.duplicates import settle_duplicates
from seewhy.data.likeness import alike_pairs, described, same_pixels
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError, PictureError


def scenery(seed: int, *, size: tuple[int, int] = (120, 90)) -> Image.Image:
    """Something like a photograph: soft patches of colour, edges, and the noise of a sensor."""
    rng = np.random.default_rng(seed)
    patches = rng.integers(30, 226, (5, 6, 3), dtype=np.uint8)
    image = Image.fromarray(patches).resize(size, Image.Resampling.BICUBIC)
    draw = ImageDraw.Draw(image)
    for _ in range(3):
        left, top = int(rng.integers(0, 80)), int(rng.integers(0, 60))
        draw.rectangle(
            (left, top, left + 25, top + 18), fill=tuple(rng.integers(0, 256, 3).tolist())
        )
    noisy = np.asarray(image) + rng.normal(0, 3, (size[1], size[0], 3))
    return Image.fromarray(np.clip(noisy, 0, 255).astype(np.uint8))


class Table:
    """A folder with a table that a test fills row by row."""

    def __init__(self, folder: Path, domain: Domain) -> None:
        self.folder, self.domain = folder, domain
        self.lines = ["image,class,colour,round,split,group"]

    def add(self, name: str, image: Image.Image | bytes | None, cells: str) -> None:
        path = self.folder / name
        if isinstance(image, bytes):
            path.write_bytes(image)
        elif image is not None:
            image.save(path)
        self.lines.append(f"{name},{cells}")

    def load(self) -> Dataset:
        (self.folder / "scenes.csv").write_text("\n".join(self.lines))
        return Dataset.load(self.folder, self.domain)

    def notices(self) -> list[str]:
        table = f"{self.folder}/scenes.csv: "
        found = settle_duplicates(self.load()).notices
        assert all(notice.startswith(table) for notice in found)
        return [notice.removeprefix(table) for notice in found]

    def refused(self) -> str:
        with pytest.raises(DatasetError) as problem:
            settle_duplicates(self.load())
        return str(problem.value).replace(f"{self.folder}/", "")


@pytest.fixture
def table(tmp_path: Path, tiles: Domain) -> Table:
    return Table(tmp_path, tiles)


def alike(tmp_path: Path, first: Image.Image, second: Image.Image, ending: str = "png") -> bool:
    paths = [tmp_path / f"first.{ending}", tmp_path / f"second.{ending}"]
    for path, image in zip(paths, (first, second), strict=True):
        image.save(path)
    return alike_pairs(paths, described(paths)) == [(0, 1)]


@pytest.mark.parametrize("quality", [95, 75])
@pytest.mark.parametrize("scale", [1.5, 1.0, 0.75, 0.5])
def test_copies_compressed_again_or_scaled_are_alike(
    tmp_path: Path, quality: int, scale: float
) -> None:
    for seed in range(4):
        image = scenery(seed)
        size = (round(image.width * scale), round(image.height * scale))
        image.save(tmp_path / "a.png")
        copy = image.resize(size, Image.Resampling.LANCZOS)
        copy.save(tmp_path / "b.jpg", quality=quality)
        paths = [tmp_path / "a.png", tmp_path / "b.jpg"]
        assert alike_pairs(paths, described(paths)) == [(0, 1)], seed
        assert not same_pixels(*paths)


def test_other_pictures_are_not_alike(tmp_path: Path) -> None:
    paths = []
    for seed in range(30):
        paths.append(tmp_path / f"{seed}.png")
        scenery(seed).save(paths[-1])
    assert alike_pairs(paths, described(paths)) == []


def test_a_scratch_makes_another_picture(tmp_path: Path) -> None:
    """One part in one place under one camera, with and without a fault."""
    for seed in range(6):
        sound, faulty = scenery(seed), scenery(seed)
        rng = np.random.default_rng(seed)
        x, y = int(rng.integers(20, 100)), int(rng.integers(20, 70))
        dark = tuple(255 if value < 128 else 0 for value in faulty.getpixel((x, y)))  # type: ignore[union-attr]
        ImageDraw.Draw(faulty).line((x - 5, y - 4, x + 5, y + 4), fill=dark, width=2)
        assert not alike(tmp_path, sound, faulty), seed


def test_another_colour_makes_another_picture(tmp_path: Path) -> None:
    """As bright as the other: only the colour tells a red card from a green one."""
    cards = []
    for colour in ((200, 40, 40), (20, 118, 60)):
        image = Image.new("RGB", (100, 70), (225, 225, 220))
        ImageDraw.Draw(image).ellipse((25, 20, 75, 50), fill=colour)
        cards.append(image)
    levels = [image.convert("L").getpixel((50, 35)) for image in cards]
    assert abs(levels[0] - levels[1]) < 8  # type: ignore[operator]
    assert not alike(tmp_path, *cards)


def test_plain_pictures_are_not_alike(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    plain = [
        Image.fromarray((200 + rng.normal(0, 3, (64, 64, 3))).astype(np.uint8)) for _ in range(2)
    ]
    assert not alike(tmp_path, *plain)
    assert not alike(
        tmp_path, Image.new("RGB", (64, 64), "white"), Image.new("RGB", (50, 50), "white")
    )


def test_every_picture_is_found_among_many_copies(tmp_path: Path) -> None:
    """Of twenty copies of one picture, more than are compared with each, all are connected."""
    image = scenery(1)
    paths = []
    for number in range(20):
        paths.append(tmp_path / f"{number:02d}.jpg")
        image.save(paths[-1], quality=70 + number)
    pairs = alike_pairs(paths, described(paths))
    reached, before = {0}, 0
    while len(reached) > before:
        before = len(reached)
        reached |= {n for pair in pairs if reached & set(pair) for n in pair}
    assert reached == set(range(20))


def test_rows_of_one_picture_are_one_group(table: Table) -> None:
    data = (table.folder / "x.png", scenery(0))
    data[1].save(data[0])
    content = data[0].read_bytes()
    table.add("a.png", content, "good,red,yes,,")
    table.add("b.png", scenery(1), "good,red,yes,,")
    table.add("copy.png", content, "good,red,,,")
    table.add("a.png", None, ",red,yes,,one")
    table.add("other.png", scenery(2), "bad,red,yes,,one")
    settled = settle_duplicates(table.load())
    assert settled.dataset.groups == ["one", f" {table.folder}/b.png", "one", "one", "one"]
    assert [scene.label for scene in settled.dataset.scenes] == [
        "good",
        "good",
        "good",
        None,
        "bad",
    ]
    assert table.notices() == [
        "1 picture is in several rows (lines 2, 4 and 5); the rows of a picture are one group"
    ]


def test_the_same_pixels_in_another_format_are_the_same_picture(table: Table) -> None:
    table.add("a.png", scenery(0), "good,red,yes,,")
    table.add("a.bmp", scenery(0), "good,red,yes,,")
    assert table.notices() == [
        "1 picture is in several rows (lines 2 and 3); the rows of a picture are one group"
    ]
    table.add("a.tiff", scenery(0), "bad,red,yes,,")
    assert table.refused() == (
        "scenes.csv:4: the picture 'a.tiff', which is 'a.png' of line 2 once more, has class "
        "'bad' here and 'good' there; correct or remove one of the two rows"
    )


def test_rows_that_contradict_each_other(table: Table) -> None:
    table.add("a.png", scenery(0), "good,red,yes,,")
    table.add("b.png", scenery(1), "good,red,yes,,")
    table.add("a.png", None, "good,green,yes,,")
    message = (
        "scenes.csv:4: the picture 'a.png' has colour 'green' here and 'red' in line 2; correct "
        "or remove one of the two rows"
    )
    with pytest.raises(DatasetError) as problem:
        table.load()  # found without reading a picture
    assert str(problem.value).replace(f"{table.folder}/", "") == message
    table.add("b.png", None, "bad,green,yes,,")
    table.add("b.png", None, "bad,green,yes,,")
    assert table.refused() == f"{message} (2 more such rows)"


def test_test_rows_of_training_pictures_are_left_out(table: Table) -> None:
    for seed in range(5):
        table.add(f"{seed}.png", scenery(seed), "good,red,yes,train,")
    for seed in range(4):
        table.add(f"{seed}.png", None, "good,red,yes,test,")
    table.add("9.png", scenery(9), "good,red,yes,test,")
    settled = settle_duplicates(table.load())
    assert settled.left_out == 4
    assert [scene.line for scene in settled.dataset.of_split("test").scenes] == [11]
    assert len(settled.dataset.of_split("train")) == 5
    assert table.notices() == [
        "4 test rows are of pictures that are trained on, too (line 7 as line 2; line 8 as line "
        "3; line 9 as line 4; …), left out of evaluation"
    ]
    settled.require_test_pictures()


def test_nothing_is_left_to_test_on(table: Table) -> None:
    table.add("a.png", scenery(0), "good,red,yes,train,")
    table.add("a.png", None, "good,red,yes,test,")
    settled = settle_duplicates(table.load())
    with pytest.raises(DatasetError) as problem:
        settled.require_test_pictures()
    assert str(problem.value) == (
        f"{table.folder}/scenes.csv: 1 test row is of pictures that are trained on, too (line 3 as "
        "line 2), left out of evaluation, and nothing is left; give the split 'test' pictures of "
        "its own"
    )


def test_nearly_the_same_pictures_across_the_split_are_named_and_stay(table: Table) -> None:
    table.add("a.png", scenery(0), "good,red,yes,train,")
    table.add("b.png", scenery(1), "good,red,yes,test,")
    small = scenery(0).resize((96, 72), Image.Resampling.LANCZOS)
    table.add("small.png", small, "good,red,yes,test,")
    assert table.notices() == [
        "1 pair of pictures, one to train and one to test on, is nearly the same (lines 2 and 4: "
        "a.png and small.png); results on such pictures flatter, keep them in one split"
    ]
    settled = settle_duplicates(table.load())
    assert len(settled.dataset) == 3
    groups = settled.dataset.groups
    assert groups[0] == groups[2] != groups[1]


def test_nearly_the_same_pictures_that_are_annotated_differently(table: Table) -> None:
    table.add("a.png", scenery(0), "good,red,yes,,")
    small = scenery(0).resize((96, 72), Image.Resampling.LANCZOS)
    table.add("small.png", small, "bad,red,yes,,")
    assert table.notices() == [
        "1 pair of pictures is nearly the same (lines 2 and 3: a.png and small.png); such "
        "pictures are one group",
        "1 pair of pictures is nearly the same, but annotated differently (lines 2 and 3: class "
        "good and bad); look whether that is meant",
    ]


def test_pictures_of_one_group_are_expected_to_be_alike(table: Table) -> None:
    table.add("a.png", scenery(0), "good,red,yes,,one")
    small = scenery(0).resize((96, 72), Image.Resampling.LANCZOS)
    table.add("small.png", small, "good,red,yes,,one")
    assert table.notices() == []


def test_what_is_no_picture_is_named(table: Table) -> None:
    table.add("a.png", scenery(0), "good,red,yes,,")
    table.add("b.png", b"no picture", "good,red,yes,,")
    with pytest.raises(PictureError, match=r"b\.png is not a picture"):
        settle_duplicates(table.load())


def test_progress_is_told_and_files_are_read_once(
    table: Table, monkeypatch: pytest.MonkeyPatch
) -> None:
    from seewhy.perception import picture

    read: list[str] = []
    real = picture.read_picture

    def reading(path: Path, **options: object) -> object:
        read.append(path.name)
        return real(path, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(picture, "read_picture", reading)
    for seed in range(3):
        table.add(f"{seed}.png", scenery(seed), "good,red,yes,,")
    table.add("0.png", None, "good,red,yes,,")
    told: list[int] = []
    settle_duplicates(table.load(), on_progress=told.append)
    assert told == [1, 2, 3]
    assert sorted(read) == ["0.png", "1.png", "2.png"]


def test_photographs_of_hands_and_cards(tmp_path: Path) -> None:
    """No two digits of one person are alike; of cards, only shots of one card in one series."""
    data = Path(__file__).parents[2] / "shared" / "data"
    if not (data / "hands.zip").exists():
        pytest.skip("the photographs of hands and cards are not here")
    for name in ("hands", "set_cards"):
        with zipfile.ZipFile(data / f"{name}.zip") as archive:
            wanted = [
                n for n in archive.namelist() if n.startswith(f"{name}/") and n.endswith("jpg")
            ]
            archive.extractall(tmp_path, wanted[::5])
        paths = sorted((tmp_path / name).rglob("*.jpg"))
        assert len(paths) > 300
        pairs = alike_pairs(paths, described(paths))
        assert len(pairs) <= {"hands": 0, "set_cards": 20}[name]
        assert all(paths[one].parent == paths[other].parent for one, other in pairs)
