"""Tables with a row a picture as datasets, in the formats in which people save them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from openpyxl import Workbook

from exports_builder import draw_all, imported, notes_of, pack, rows_of, write
from seewhy.data.importers.tables import TABLES

HEADER = ["File Name", "label", "Ripe", "Main Colour", "weight", "subset", "patient_id"]
ROWS: list[list[object]] = [
    ["pics/1.jpg", "good", True, "Dark Red", 3, "train", "p1"],
    ["pics/2.jpg", "bad", False, "green", 4, "val", "p1"],
    ["pics/3", "good", None, None, 3, "test", "p2"],  # without its ending
]
EXPECTED = [
    "image,class,ripe,main_colour,weight,split,group",
    "images/1.jpg,good,yes,dark_red,3,train,p1",
    "images/2.jpg,bad,no,green,4,train,p1",
    "images/3.jpg,good,,,3,test,p2",
]


def write_table(folder: Path, ending: str) -> Path:
    path = folder / f"table{ending}"
    if ending in (".csv", ".txt"):
        return write(path, _separated(";"))
    if ending in (".tsv", ".tab"):
        return write(path, _separated("\t"))
    if ending in (".xlsx", ".xlsm"):
        book = Workbook()
        for row in (HEADER, *ROWS):
            book.active.append(row)
        book.save(path)
        return path
    records = [
        {key: value for key, value in zip(HEADER, row, strict=True) if value is not None}
        for row in ROWS
    ]
    if ending == ".json":
        return write(path, json.dumps(records))
    if ending in (".jsonl", ".ndjson"):
        return write(path, "\n".join(map(json.dumps, records)) + "\n\n")
    pyarrow = pytest.importorskip("pyarrow", reason="the extra 'tables' is not installed")
    from pyarrow import parquet

    columns = {key: [row[n] for row in ROWS] for n, key in enumerate(HEADER)}
    parquet.write_table(pyarrow.table(columns), path)
    return path


def _separated(separator: str) -> str:
    lines = [HEADER, *([("" if cell is None else str(cell)) for cell in row] for row in ROWS)]
    return "\n".join(separator.join(line) for line in lines) + "\n"


@pytest.mark.parametrize(
    ("ending", "packed"),
    # in a folder, text files are not taken for tables
    [(ending, False) for ending in TABLES]
    + [(ending, True) for ending in TABLES if ending != ".txt"],
)
def test_tables(tmp_path: Path, ending: str, packed: bool) -> None:
    draw_all(tmp_path / "s", ["pics/1.jpg", "pics/2.jpg", "pics/3.jpg"])
    source = write_table(tmp_path / "s", ending)
    source = pack(tmp_path / "s", tmp_path / "s.zip") if packed else source
    dataset, _ = imported(source, "table", tmp_path / "data")
    assert (tmp_path / "data/scenes.csv").read_text().splitlines() == EXPECTED
    assert dataset.notes[0].text.endswith(
        ": pictures 'File Name', class 'label', split 'subset', group 'patient_id'"
    )


def test_columns_that_are_named(tmp_path: Path) -> None:
    draw_all(tmp_path / "s", ["1.jpg", "2.jpg"])
    table = write(tmp_path / "s/t.csv", "where,kind,label\n1.jpg,a,x\n2.jpg,b,y\n")
    _, rows = imported(table, "table", tmp_path / "data", image_column="where", class_column="kind")
    assert rows[0] == {"image": "images/1.jpg", "class": "a", "label": "x"}


def test_pictures_that_lie_elsewhere(tmp_path: Path) -> None:
    """Paths from another machine: their end tells the picture."""
    draw_all(tmp_path / "pictures", ["a/1.jpg", "b/1.jpg"])
    table = write(tmp_path / "t.csv", "image,class\nC:\\data\\a\\1.jpg,x\n/data/b/1.jpg,y\n")
    _, rows = imported(table, "table", tmp_path / "data", pictures=tmp_path / "pictures")
    assert [(row["image"], row["class"]) for row in rows] == [
        ("images/a/1.jpg", "x"),
        ("images/b/1.jpg", "y"),
    ]


def test_a_column_with_too_many_values_is_no_feature(tmp_path: Path) -> None:
    names = [f"{n}.jpg" for n in range(120)]
    draw_all(tmp_path / "s", names)
    lines = [f"{name},{n % 2},{n / 7:.3f},{n % 3}" for n, name in enumerate(names)]
    table = write(tmp_path / "s/t.csv", "image,class,length,parts\n" + "\n".join(lines))
    dataset, rows = imported(table, "table", tmp_path / "data")
    assert list(rows[0]) == ["image", "class", "parts"]
    assert notes_of(dataset) == {
        "columns with more than 100 different values, left out": ("length (120, such as '0.000')",)
    }


def test_the_same_picture_twice(tmp_path: Path) -> None:
    draw_all(tmp_path / "s", ["1.jpg", "2.jpg"])
    table = write(
        tmp_path / "s/t.csv",
        "image,class,colour,split\n1.jpg,a,red,train\n1.jpg,a,,\n2.jpg,a,,test\n2.jpg,b,red,\n",
    )
    dataset, rows = imported(table, "table", tmp_path / "data")
    assert [list(row.values()) for row in rows] == [
        ["images/1.jpg", "a", "red", "train"],
        ["images/2.jpg", "", "red", "test"],
    ]
    notes = notes_of(dataset)
    assert notes["pictures that the source lists several times, put together"] == ("1.jpg", "2.jpg")
    assert notes["pictures that are said to be of several classes, left without one"] == (
        "2.jpg (a and b)",
    )


def test_a_dataset_can_be_imported_again(tmp_path: Path) -> None:
    """Boxes, groups, splits and reasons come along."""
    draw_all(tmp_path / "s", ["1.jpg", "2.jpg"])
    write(
        tmp_path / "s/scenes.csv",
        "image,class,spotted,split,group,reasons\n1.jpg,bad,yes,train,g1,spotted\n2.jpg,good,no,test,,\n",
    )
    write(
        tmp_path / "s/things.csv",
        "image,thing,left,top,right,bottom,kind,hue\n1.jpg,1,1,2,3,4,spot,brown\n",
    )
    imported(tmp_path / "s", "table", tmp_path / "data")
    assert (tmp_path / "data/scenes.csv").read_text() == (
        "image,class,spotted,split,group,reasons\n"
        "images/1.jpg,bad,yes,train,g1,spotted\nimages/2.jpg,good,no,test,,\n"
    )
    assert rows_of(tmp_path / "data/things.csv") == [
        {"image": "images/1.jpg", "thing": "1", "left": "1", "top": "2", "right": "3",
         "bottom": "4", "kind": "spot", "hue": "brown"}
    ]  # fmt: skip


def test_what_the_source_says_is_kept(tmp_path: Path) -> None:
    draw_all(tmp_path / "s", ["1.jpg", "2.jpg"])
    table = write(tmp_path / "s/t.csv", "image,class,colour\n1.jpg,a,brown\n2.jpg,a,\n")
    features = write(tmp_path / "f.csv", "class,colour,round\na,red,yes\n")
    dataset, rows = imported(table, "table", tmp_path / "data", features=features)
    assert [(row["colour"], row["round"]) for row in rows] == [("brown", "yes"), ("red", "yes")]
    assert notes_of(dataset)[
        f"features that are said otherwise than {features} has them, kept"
    ] == ("1.jpg colour brown",)
