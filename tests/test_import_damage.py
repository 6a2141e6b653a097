"""Exports in which bytes were changed: a sentence or a dataset, never a traceback."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from exports_builder import (
    choice,
    coco,
    cvat,
    draw_all,
    pack,
    rectangle,
    task,
    voc,
    voc_object,
    write,
    write_json,
)
from seewhy.data.importers import ImportRequest, import_pictures
from seewhy.errors import SeeWhyError

CHANGES = st.lists(
    st.tuples(
        st.floats(0, 1, exclude_max=True),
        st.one_of(
            st.binary(min_size=0, max_size=4),
            st.sampled_from([b"-", b"1e999", b"null", b"{}", b"[", b'"', b"\0", b"<", b"\xff\xfe"]),
        ),
    ),
    min_size=1,
    max_size=4,
)


def write_sources(home: Path) -> dict[str, tuple[str, Path]]:
    """Name → the format and the file that is damaged."""
    draw_all(home, ["1.jpg", "2.jpg", "images/1.jpg", "images/2.jpg", "voc/1.jpg"])
    boxes = [{"image_id": n, "category_id": n, "bbox": [1, 2, 3.5, 4]} for n in (1, 2)]
    images = [{"id": n, "file_name": f"{n}.jpg"} for n in (1, 2)]
    results = [choice("kind", "a"), choice("flaws", "x", "y"),
               rectangle("b", (1, 2, 30, 40), region="r", rotation=10)]  # fmt: skip
    sources = {
        "coco": write_json(home / "coco.json", coco(images, boxes)),
        "labelstudio": write_json(
            home / "studio.json", [task(n, f"{n}.jpg", results) for n in (1, 2)]
        ),
        "voc": write(home / "voc/1.xml", voc("1.jpg", voc_object("cat", (1, 1, 9, 9)))),
        "cvat": write(
            home / "annotations.xml",
            cvat(
                '<image id="0" name="1.jpg" width="40" height="20"><tag label="t"/><box label="b" '
                'xtl="1" ytl="2" xbr="3" ybr="4"><attribute name="c">true</attribute></box></image>'
            ),
        ),
        "table": write(home / "table.csv", "image,class,colour\n1.jpg,a,red\n2.jpg,b,\n"),
    }
    yolo = home / "yolo"
    shutil.copytree(home / "images", yolo / "images")
    write(yolo / "labels/1.txt", "0 .5 .5 .5 .5\n1 .1 .1 .2 .2\n")
    write(yolo / "data.yaml", "train: images\nnames: {0: cat, 1: dog}\n")
    named = {kind: (kind, file) for kind, file in sources.items()}
    named["yolo names"] = ("yolo", yolo / "data.yaml")
    named["yolo labels"] = ("yolo", yolo / "labels/1.txt")
    folders = draw_all(home / "folders", ["a/1.jpg", "b/2.jpg"])
    named["archive"] = ("folder", pack(folders, home / "folders.zip"))
    named["excel"] = ("table", _workbook(home / "book.xlsx"))
    return named


def _workbook(path: Path) -> Path:
    from openpyxl import Workbook

    book = Workbook()
    for row in (["image", "class"], ["1.jpg", "a"], ["2.jpg", "b"]):
        book.active.append(row)
    book.save(path)
    return path


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[str, Path]]:
    return write_sources(tmp_path_factory.mktemp("exports"))


NAMES = ("coco", "labelstudio", "voc", "cvat", "table", "yolo names", "yolo labels", "archive",
         "excel")  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(changes=CHANGES)
def test_changed_bytes(
    name: str,
    changes: list[tuple[float, bytes]],
    sources: dict[str, tuple[str, Path]],
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    format, file = sources[name]
    whole = file.read_bytes()
    damaged = whole
    for place, content in changes:
        at = int(place * len(damaged))
        damaged = damaged[:at] + content + damaged[at + max(1, len(content)) :]
    out = tmp_path_factory.mktemp("out") / "data"
    # Label files are found by the folder that they lie in.
    source = file.parents[1] if name == "yolo labels" else file
    complaint = ""
    file.write_bytes(damaged)
    try:
        import_pictures(ImportRequest(source, format), out)
    except SeeWhyError as problem:
        complaint = str(problem)
    finally:
        file.write_bytes(whole)
    assert "\n" not in complaint
    assert (out / "scenes.csv").exists() == (not complaint)


@pytest.mark.parametrize("name", NAMES)
def test_none_is_damaged(name: str, sources: dict[str, tuple[str, Path]], tmp_path: Path) -> None:
    """What the test above changes is right before it is changed."""
    format, file = sources[name]
    source = file.parents[1] if name == "yolo labels" else file
    assert import_pictures(ImportRequest(source, format), tmp_path / "data").pictures > 0
