"""What the walk through the studio knows of the pictures, and how it counts."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image

from seewhy.errors import SeeWhyError
from seewhy_lab.walk.diary import read_steps, table, write_steps
from seewhy_lab.walk.person import Effort, Step
from seewhy_lab.walk.truth import flat_folder, read_truth

TABLE = "class,thumb\n0,folded\n1,stretched\n"


def class_folders(folder: Path) -> Path:
    for label in "01":
        (folder / label).mkdir(parents=True)
        Image.new("RGB", (8, 8)).save(folder / label / f"7_{label}.png")
    return folder


def fingers(tmp_path: Path, text: str = TABLE) -> Path:
    file = tmp_path / "fingers.csv"
    file.write_text(text)
    return file


def test_class_folders_with_a_table(tmp_path: Path) -> None:
    truth = read_truth(class_folders(tmp_path / "hands"), table=fingers(tmp_path))
    assert truth.values["7_1.png"] == {"class": "1", "thumb": "stretched"}
    assert truth.features == {"thumb": ("folded", "stretched")}
    assert truth.table == TABLE
    flat = flat_folder(truth, tmp_path / "flat")
    assert sorted(path.name for path in flat.iterdir()) == ["7_0.png", "7_1.png"]


def test_a_dataset(tmp_path: Path) -> None:
    (tmp_path / "scenes.csv").write_text(
        "image,class,lean,split\nimages/1.png,stable,no,train\nimages/2.png,unstable,yes,test\n"
    )
    truth = read_truth(tmp_path)
    assert truth.classes == ("stable", "unstable")
    assert truth.values["2.png"] == {"class": "unstable", "lean": "yes"}
    assert truth.files["2.png"] == tmp_path / "images" / "2.png"


def test_a_class_without_a_row(tmp_path: Path) -> None:
    with pytest.raises(SeeWhyError, match="no row for the class 1; add one"):
        read_truth(class_folders(tmp_path / "hands"), table=fingers(tmp_path, "class,thumb\n0,a\n"))


def test_two_pictures_of_one_name(tmp_path: Path) -> None:
    folder = class_folders(tmp_path / "hands")
    (folder / "1" / "7_1.png").rename(folder / "1" / "7_0.png")
    with pytest.raises(SeeWhyError, match="have the same name; rename one"):
        read_truth(folder, table=fingers(tmp_path))


def test_steps_are_kept_and_a_persons_time_is_estimated(tmp_path: Path) -> None:
    steps = [
        Step("Label", Effort(clicks=2, keys=30, characters=10, confirmed=12, changed=15), 60.0)
    ]
    write_steps(tmp_path / "steps.json", steps)
    assert read_steps(tmp_path / "steps.json") == steps
    assert read_steps(tmp_path / "none.json") == []
    # 2 clicks of 3 s, 10 characters of 0.3 s, 12 pictures of 2 s, 15 of 4 s: 93 s.
    assert table(steps)[2].endswith("| 2 | 30 | 10 | 1.6 | 1.0 |")
