"""Tables as data frames, both ways."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from conftest import write_tiles
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError, SeeWhyError

pandas = pytest.importorskip("pandas", reason="pandas is not installed")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write_tiles(tmp_path / "p", count=6)


def test_there_and_back(folder: Path, tiles: Domain) -> None:
    (folder / "scenes.csv").write_text(
        "image,class,colour,round,split,group,reasons\n"
        "images/000.png,good,red,yes,train,one,colour round\n"
        "images/001.png,,red,,test,,\n"
        "images/002.png,bad,,no,,,round\n"
    )
    dataset = Dataset.load(folder, tiles)
    frame = dataset.to_frame()
    assert frame.columns.tolist() == [
        "image", "class", "colour", "round", "split", "group", "reasons"
    ]  # fmt: skip
    assert frame["class"].tolist() == ["good", None, "bad"]
    assert frame["reasons"].tolist() == ["colour round", None, "round"]
    again = Dataset.from_frame(frame, tiles, folder=folder)
    assert again.scenes == dataset.scenes
    assert again.pictures(16).shape == (3, 16, 16, 3)


def test_a_frame_that_pandas_read_itself(folder: Path, tiles: Domain) -> None:
    frame = pandas.read_csv(folder / "scenes.csv")
    assert Dataset.from_frame(frame, tiles, folder=folder).scenes == (
        Dataset.load(folder, tiles).scenes
    )
    few = frame[frame["split"] == "train"].astype({"colour": "category"})
    assert len(Dataset.from_frame(few, tiles, folder=folder)) == 4


def test_missing_values_whole_numbers_and_truth_values(folder: Path, structures: Domain) -> None:
    frame = pandas.DataFrame(
        {
            "image": ["images/000.png", "images/001.png", "images/002.png"],
            "class": pandas.array(["stable", None, pandas.NA], dtype="string"),
            "num_blocks": [3, float("nan"), 5],
            "base": ["wide", None, float("nan")],
            "lean": [True, False, pandas.NA],
        }
    )
    dataset = Dataset.from_frame(frame, structures, folder=folder)
    assert dataset.labels == ["stable", None, None]
    assert dataset.vectors == [
        ("3", "wide", "yes", None), (None, None, "no", None), ("5", None, None, None)
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("columns", "expected"),
    [
        (
            {"image": ["images/000.png", "images/nothing.png"]},
            "the frame, row 1: there is no picture 'images/nothing.png' in DIR; correct the path "
            "or remove the row",
        ),
        (
            {"image": ["images/000.png"], "colour": ["gren"]},
            "the frame, row 0: 'gren' is no value of 'colour'; did you mean 'green'?",
        ),
        (
            {"image": ["images/000.png"], "color": ["green"]},
            "the frame: 'color' is no feature of the domain 'tiles'; did you mean 'colour'?",
        ),
        (
            {"image": ["a\0b.png"]},
            "the frame, row 0: the picture's path 'a�b.png' cannot be used (embedded null byte); "
            "correct it",
        ),
        (
            {"image": ["images/000.png", "images/000.png"], "class": ["good", "bad"]},
            "the frame, row 1: the picture 'images/000.png' has class 'bad' here and 'good' in "
            "row 0; correct or remove one of the two rows",
        ),
        ({"image": []}, "the frame: the table has no rows; add one per picture"),
    ],
)
def test_a_wrong_frame(
    folder: Path, tiles: Domain, columns: dict[str, list[str]], expected: str
) -> None:
    with pytest.raises(DatasetError) as problem:
        Dataset.from_frame(pandas.DataFrame(columns), tiles, folder=folder)
    assert str(problem.value).replace(str(folder), "DIR") == expected


def test_a_column_twice_and_no_frame(folder: Path, tiles: Domain) -> None:
    frame = pandas.DataFrame(
        [["images/000.png", "red", "red"]], columns=["image", "colour", "colour"]
    )
    with pytest.raises(DatasetError) as problem:
        Dataset.from_frame(frame, tiles, folder=folder)
    assert str(problem.value) == "the frame: the column 'colour' stands twice; remove one"
    with pytest.raises(DatasetError) as problem:
        Dataset.from_frame([1], tiles, folder=folder)  # type: ignore[arg-type]
    assert str(problem.value) == (
        "frame must be a data frame with named columns, got list: read the table with pandas, or a "
        "folder with Dataset.load"
    )


def test_without_pandas(folder: Path, tiles: Domain, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(SeeWhyError) as problem:
        Dataset.load(folder, tiles).to_frame()
    assert str(problem.value) == (
        "pandas is not installed, which data frames need; install it with "
        "pip install 'seewhy[tables]'"
    )
