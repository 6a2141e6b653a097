"""Sources that are wrong: one sentence each, with the place; nothing is left half written."""

from __future__ import annotations

import json
import stat
import zipfile
from pathlib import Path

import pytest

from conftest import Run
from exports_builder import (
    choice,
    coco,
    cvat,
    draw,
    draw_all,
    imported,
    notes_of,
    pack,
    rectangle,
    task,
    voc,
    voc_object,
    write,
    write_json,
)
from seewhy.cli import data_import
from seewhy.data.importers import FORMATS, ImportRequest, import_pictures
from seewhy.errors import DatasetError, SeeWhyError

ONE_IMAGE = [{"id": 1, "file_name": "1.jpg"}]


def complaint(source: Path, format: str, **options: object) -> str:
    """The sentence about a source; nothing may have been written."""
    out = source.parent / "never written"
    with pytest.raises(SeeWhyError) as caught:
        import_pictures(ImportRequest(source, format, **options), out)  # type: ignore[arg-type]
    assert not (out / "scenes.csv").exists()
    assert not (out / "things.csv").exists()
    text = str(caught.value)
    assert "\n" not in text
    return text.replace(f"{source.parent}/", "")


# The source itself -----------------------------------------------------------------------------


def test_no_source(tmp_path: Path) -> None:
    assert complaint(tmp_path / "none", "folder") == (
        "none: there is no such file or folder; check the path"
    )


@pytest.mark.parametrize(
    ("format", "expected"),
    [
        ("folder", "no picture in it or below; name the folder that holds them"),
        ("coco", "no COCO file (JSON with 'images', 'annotations' and 'categories'); name the file "
         "that the tool exported"),
        ("voc", "no VOC annotation (XML files with <annotation>); name the folder that holds "
         "Annotations and JPEGImages"),
        ("yolo", "no picture in it or below; name the folder that holds them"),
        ("labelstudio", "no export of Label Studio; export the project as JSON or JSON-MIN and "
         "name the file"),
        ("cvat", "no CVAT annotation (annotations.xml); export the task as 'CVAT for images 1.1'"),
    ],
)  # fmt: skip
def test_nothing_of_the_format(tmp_path: Path, format: str, expected: str) -> None:
    (tmp_path / "s").mkdir()
    assert complaint(tmp_path / "s", format) == f"s: there is {expected}"


def test_a_folder_without_a_table(tmp_path: Path) -> None:
    (tmp_path / "s").mkdir()
    assert complaint(tmp_path / "s", "table").startswith("s: there is no table (.csv, .tsv, ")


def test_an_unknown_format(tmp_path: Path) -> None:
    assert complaint(tmp_path / "s", "cocoo") == (
        "'cocoo' is no format that is imported; did you mean 'coco'?"
    )


def test_a_file_that_is_no_folder(tmp_path: Path) -> None:
    write(tmp_path / "s.csv", "image\n")
    assert complaint(tmp_path / "s.csv", "folder") == (
        "s.csv: is a file, class folders are a folder or a zip archive of them"
    )


def test_pictures_that_are_none(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", [f"{kind}/{n}.jpg" for kind in "ab" for n in range(4)])
    write(source / "b/readme.txt", "about")
    write(source / "b/page.jpg", "<html>")
    (source / "b/empty.png").touch()
    draw(source / "b/flat.png", size=(3, 30))
    (source / "b/cut.jpg").write_bytes((source / "a/1.jpg").read_bytes()[:30])
    dataset, rows = imported(source, "folder", tmp_path / "data")
    assert len(rows) == 8
    notes = notes_of(dataset)
    assert notes["files that are no pictures, left out"] == ("b/readme.txt",)
    cut, *others = notes["pictures that cannot be used, left out"]
    assert cut.startswith("b/cut.jpg is ")
    assert others == [
        "b/empty.png is empty (0 bytes)",
        "b/flat.png is 3×30 pixels, each side must be at least 8",
        "b/page.jpg is not a picture of a known type",
    ]


def test_most_pictures_cannot_be_used(tmp_path: Path) -> None:
    draw(tmp_path / "s/cats/1.jpg")
    for name in ("2.jpg", "3.jpg"):
        write(tmp_path / "s/dogs" / name, "<html>")
    assert complaint(tmp_path / "s", "folder") == (
        "s: 2 of 3 pictures cannot be used, the first of them dogs/2.jpg is not a picture of a "
        "known type; copy them again from where they come from"
    )


def test_a_script_of_another_program_is_no_picture(tmp_path: Path) -> None:
    """PostScript would run in a program of its own."""
    source = draw_all(tmp_path / "s", ["cats/1.jpg", "dogs/2.jpg"])
    write(source / "dogs/3.jpg", "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 40 20\n%%EOF\n")
    dataset, rows = imported(source, "folder", tmp_path / "data")
    assert len(rows) == 2
    assert notes_of(dataset)["pictures that cannot be used, left out"] == (
        "dogs/3.jpg is PostScript (EPS), a program and no picture",
    )


def test_one_class(tmp_path: Path) -> None:
    dataset, _ = imported(draw_all(tmp_path / "s", ["cats/1.jpg"]), "folder", tmp_path / "data")
    assert list(notes_of(dataset)) == [
        "all pictures are of one class (cats): training needs pictures of another"
    ]


def test_no_class(tmp_path: Path) -> None:
    dataset, _ = imported(draw_all(tmp_path / "s", ["1.jpg"]), "folder", tmp_path / "data")
    assert list(notes_of(dataset)) == [
        "1 of 1 pictures have no class: they are there to be labelled or classified"
    ]


# The folder to write ---------------------------------------------------------------------------


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["cats/1.jpg", "dogs/1.jpg"])
    for name, expected in (
        ("scenes.csv", "holds a dataset already; name a new folder with --out, or delete this one"),
        ("notes.txt", "holds other files; name a new folder with --out"),
    ):
        out = tmp_path / f"out of {name}"
        before = write(out / name, "mine")
        with pytest.raises(DatasetError) as caught:
            import_pictures(ImportRequest(source, "folder"), out)
        assert str(caught.value) == f"{out}: {expected}"
        assert [path.name for path in out.iterdir()] == [name]
        assert before.read_text() == "mine"
    file = write(tmp_path / "file", "")
    with pytest.raises(DatasetError, match="is a file; name a new folder with --out"):
        import_pictures(ImportRequest(source, "folder"), file)
    finished = tmp_path / "data"
    import_pictures(ImportRequest(source, "folder"), finished)
    with pytest.raises(DatasetError, match="holds a dataset already"):
        import_pictures(ImportRequest(source, "folder"), finished)


def test_a_damaged_record(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["cats/1.jpg", "dogs/1.jpg"])
    write(tmp_path / "out/imported.json", "{")
    with pytest.raises(DatasetError, match="is not as the import wrote it; delete the"):
        import_pictures(ImportRequest(source, "folder"), tmp_path / "out")


def test_a_disk_that_is_full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    archive = pack(draw_all(tmp_path / "s", ["cats/1.jpg", "dogs/1.jpg"]), tmp_path / "s.zip")
    monkeypatch.setattr("shutil.disk_usage", lambda _: _Usage())
    assert complaint(archive, "folder") == (
        "never written: the pictures need 0.0 GiB, the disk has 0.0 GiB free; make room or choose "
        "another disk"
    )


class _Usage:
    free = 1000


# Archives --------------------------------------------------------------------------------------


def _member(name: str, *, link: bool = False) -> zipfile.ZipInfo:
    member = zipfile.ZipInfo(name)
    member.external_attr = ((stat.S_IFLNK if link else stat.S_IFREG) | 0o644) << 16
    return member


@pytest.mark.parametrize("name", ["../out.jpg", "a/../../out.jpg", "/etc/out.jpg", "C:/out.jpg"])
def test_a_name_that_leads_out_of_the_archive(tmp_path: Path, name: str) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr(_member(name), b"x")
    assert complaint(tmp_path / "a.zip", "folder") == (
        f"a.zip: a file in the archive is named '{name}', which leads out of it; pack it again "
        "from its own folder"
    )


def test_a_link_in_an_archive(tmp_path: Path) -> None:
    picture = draw(tmp_path / "1.jpg").read_bytes()
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        for name in ("cats/1.jpg", "dogs/1.jpg"):
            archive.writestr(_member(name), picture)
        archive.writestr(_member("dogs/2.jpg", link=True), b"/etc/passwd")
    dataset, rows = imported(tmp_path / "a.zip", "folder", tmp_path / "data")
    assert len(rows) == 2
    assert notes_of(dataset) == {"links in the archive, left out": ("dogs/2.jpg",)}


def test_an_archive_that_explodes(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("cats/1.jpg", b"\0" * (65 * 2**20))
    text = complaint(tmp_path / "a.zip", "folder")
    assert text.startswith("a.zip: 'cats/1.jpg' would unpack from ")
    assert text.endswith(
        " to 68,157,440 bytes, which no picture or export does; remove it from the archive"
    )


def test_archives_that_cannot_be_read(tmp_path: Path) -> None:
    write(tmp_path / "a.zip", "no archive")
    assert complaint(tmp_path / "a.zip", "folder") == (
        "a.zip: is no zip archive, or was cut short (File is not a zip file); copy or export it "
        "again"
    )
    write(tmp_path / "a.tar.gz", "x")
    assert complaint(tmp_path / "a.tar.gz", "folder") == (
        "a.tar.gz: archives other than zip are not read; unpack it and name the folder"
    )


def test_an_encrypted_archive(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("cats/1.jpg", b"x")
    content = bytearray((tmp_path / "a.zip").read_bytes())
    content[content.index(b"PK\x01\x02") + 8] |= 1  # the flag in the directory
    (tmp_path / "a.zip").write_bytes(content)
    assert complaint(tmp_path / "a.zip", "folder") == (
        "a.zip: 'cats/1.jpg' is encrypted; unpack the archive with its password and name the folder"
    )


def test_a_damaged_picture_in_an_archive(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["cats/1.png", "dogs/2.png", "dogs/3.png"])
    archive = pack(source, tmp_path / "a.zip")
    content = archive.read_bytes()
    place = content.index(b"dogs/3.png") + 20
    archive.write_bytes(content[:place] + b"\xff\xff\xff" + content[place + 3 :])
    dataset, rows = imported(archive, "folder", tmp_path / "data")
    assert len(rows) == 2
    (place_said,) = notes_of(dataset)["pictures that cannot be used, left out"]
    assert place_said.startswith(f"{archive}: dogs/3.png: is damaged in the archive (")


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_other_ways_of_packing(tmp_path: Path, method: int) -> None:
    """Their members are read; a damaged one is left out as any other."""
    picture = draw(tmp_path / "1.png").read_bytes()
    with zipfile.ZipFile(tmp_path / "a.zip", "w", method) as archive:
        for name in ("cats/1.png", "dogs/2.png", "dogs/3.png"):
            archive.writestr(name, picture)
    assert len(imported(tmp_path / "a.zip", "folder", tmp_path / "whole")[1]) == 3
    content = (tmp_path / "a.zip").read_bytes()
    place = content.index(b"dogs/3.png") + 30
    (tmp_path / "a.zip").write_bytes(content[:place] + b"\xa5" * 20 + content[place + 20 :])
    dataset, rows = imported(tmp_path / "a.zip", "folder", tmp_path / "data")
    assert len(rows) == 2
    (said,) = notes_of(dataset)["pictures that cannot be used, left out"]
    assert said.startswith(f"{tmp_path / 'a.zip'}: dogs/3.png: is damaged in the archive (")


def test_a_workbook_that_explodes(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "a.xlsx", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/workbook.xml", b" " * (65 * 2**20))
    assert complaint(tmp_path / "a.xlsx", "table") == (
        "a.xlsx: 'xl/workbook.xml' in it would unpack to what no table holds; save it as CSV"
    )


def test_names_that_no_file_system_holds(tmp_path: Path) -> None:
    picture = draw(tmp_path / "1.png").read_bytes()
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        for name in (f"{'c' * 300}/1.png", f"dogs/{'2' * 300}.png", f"dogs/{'3' * 300}.png"):
            archive.writestr(name, picture)
    _, rows = imported(tmp_path / "a.zip", "folder", tmp_path / "data")
    assert len({row["image"] for row in rows}) == 3
    for row in rows:
        assert (tmp_path / "data" / row["image"]).is_file()


LINKS_OUT = "links that lead out of the folder, left out (--outside follows them)"


def test_links_out_of_a_folder(tmp_path: Path) -> None:
    """A folder from a stranger may lead to pictures of one's own; the same in itself is well."""
    source = draw_all(tmp_path / "s", ["cats/1.png", "dogs/2.png", "dogs/3.png"])
    secret = draw(tmp_path / "secret/s.png")
    (source / "cats/secret.png").symlink_to(secret)
    (source / "dogs/more").symlink_to(secret.parent)
    (source / "birds").symlink_to("../secret")
    (source / "cats/4.png").symlink_to("../dogs/2.png")
    dataset, rows = imported(source, "folder", tmp_path / "data")
    assert [row["image"] for row in rows] == [
        "images/cats/1.png", "images/cats/4.png", "images/dogs/2.png", "images/dogs/3.png",
    ]  # fmt: skip
    assert sorted(notes_of(dataset)[LINKS_OUT]) == ["birds", "cats/secret.png", "dogs/more"]
    _, rows = imported(source, "folder", tmp_path / "all", outside=True)
    assert len(rows) == 7


def test_a_table_leads_through_a_link_out_of_its_folder(tmp_path: Path) -> None:
    source = draw_all(tmp_path / "s", ["1.png", "2.png"])
    draw(tmp_path / "secret/s.png")
    (source / "more").symlink_to("../secret")
    table = write(source / "t.csv", "image,class\n1.png,a\n2.png,b\nmore/s.png,b\n")
    dataset, rows = imported(table, "table", tmp_path / "data")
    assert len(rows) == 2
    assert notes_of(dataset)["pictures that are not there, left out"] == (
        f"more/s.png ({table}:4)",
    )


# Pictures that are missing ---------------------------------------------------------------------


def test_some_pictures_are_missing(tmp_path: Path) -> None:
    draw_all(tmp_path / "s", ["1.jpg", "2.jpg"])
    file = write_json(
        tmp_path / "s/a.json",
        coco([{"id": n, "file_name": f"{n}.jpg"} for n in (1, 2, 3)], []),
    )
    dataset, rows = imported(file, "coco", tmp_path / "data")
    assert len(rows) == 2
    assert notes_of(dataset)["pictures that are not there, left out"] == ("3.jpg (a.json)",)


def test_most_pictures_are_missing(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    write_json(
        tmp_path / "s/a.json", coco([{"id": n, "file_name": f"{n}.jpg"} for n in (1, 2, 3)], [])
    )
    assert complaint(tmp_path / "s", "coco") == (
        "s: 2 of its 3 pictures are not in " + f"{tmp_path}/s, the first of them 2.jpg (a.json); "
        "say where they lie with --pictures DIR"
    ).replace(f"{tmp_path}/", "")


def test_a_file_name_that_two_pictures_have(tmp_path: Path) -> None:
    draw_all(tmp_path / "s", ["a/1.jpg", "b/1.jpg", "2.jpg", "3.jpg"])
    file = write_json(
        tmp_path / "s/e.json", coco([{"id": n, "file_name": f"{n}.jpg"} for n in (1, 2, 3)], [])
    )
    dataset, rows = imported(file, "coco", tmp_path / "data")
    assert [row["image"] for row in rows] == ["images/2.jpg", "images/3.jpg"]
    assert notes_of(dataset)["file names that several pictures have, not told apart"] == ("1.jpg",)


def test_pictures_outside_of_the_source_are_not_looked_at(tmp_path: Path) -> None:
    secret = draw(tmp_path / "secret/s.jpg")
    draw_all(tmp_path / "s", ["1.jpg", "2.jpg"])
    table = write(tmp_path / "s/t.csv", f"image,class\n1.jpg,a\n2.jpg,b\n{secret},b\n")
    dataset, rows = imported(table, "table", tmp_path / "data")
    assert len(rows) == 2
    assert notes_of(dataset)["pictures that are not there, left out"] == (f"{secret} ({table}:4)",)
    table = write(tmp_path / "s/t.csv", "image,class\n1.jpg,a\n2.jpg,b\n../secret/s.jpg,b\n")
    assert len(imported(table, "table", tmp_path / "d")[1]) == 2


# Damaged exports -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('{"images": [\n{"id": 1, "file_name": "1.jpg"},\n{"id": 2 "file_name": "2.jpg"}]}',
         "s/a.json:3:10: is no valid JSON (expecting ',' delimiter); export it again"),
        ('{"images": [{"id": 1, "file_name": "1.jpg"}',
         "s/a.json:1:44: is no valid JSON (expecting ',' or ']'); export it again"),
        ('{"images": [{"id": 1, "file_name": "1.jpg',
         "s/a.json:1:36: is no valid JSON (unterminated string starting at); export it again"),
        ("hello", "s/a.json:1:1: is no valid JSON (expecting '{' or '['); export it again"),
        ("", "s/a.json:1:1: is no valid JSON (expecting '{' or '['); export it again"),
        ("[" * 100_000,
         "s/a.json:1:2: is no valid JSON (it is nested too deeply); export it again"),
        ("{}",
         "s/a.json: is no COCO file, it lists no images; name the file that the tool exported"),
        ('{"images": [{"file_name": "1.jpg"}]}',
         "s/a.json: images[0].id is missing; correct it or export it again"),
        ('{"images": [{"id": 1, "file_name": "1.jpg", "width": -4}]}',
         "s/a.json: images[0].width: input should be greater than 0, got -4; correct it or export "
         "it again"),
        (json.dumps(coco(ONE_IMAGE, [{"image_id": 1, "category_id": 1, "bbox": [1, 2, "x", 4]}])),
         "s/a.json: annotations[0].bbox[2]: input should be a valid number, unable to parse string "
         "as a number, got 'x'; correct it or export it again"),
        ('{"images": [{"id": 1, "file_name": "1.jpg"}], "annotations": [{"image_id": 1, '
         '"category_id": 1, "bbox": [NaN, 1, 1, 1]}]}',
         "s/a.json: annotations[0].bbox[0]: input should be a finite number, got nan; correct it "
         "or export it again"),
    ],
)  # fmt: skip
def test_damaged_coco(tmp_path: Path, text: str, expected: str) -> None:
    draw(tmp_path / "s/1.jpg")
    file = write(tmp_path / "s/a.json", text)
    with pytest.raises(DatasetError) as caught:
        import_pictures(ImportRequest(file, "coco"), tmp_path / "out")
    assert str(caught.value).replace(f"{tmp_path}/", "") == expected
    assert not (tmp_path / "out").exists()


def test_coco_annotations_that_belong_to_nothing(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    file = write_json(
        tmp_path / "s/a.json",
        coco(
            ONE_IMAGE,
            [
                {"image_id": 1, "category_id": 2, "bbox": [0, 0, 9, 9]},
                {"image_id": 1, "category_id": 9, "bbox": [0, 0, 9, 9]},
                {"image_id": 7, "category_id": 1, "bbox": [0, 0, 9, 9]},
                {"image_id": 1, "category_id": 1, "bbox": [0, 0]},
            ],
        ),
    )
    dataset, _ = imported(file, "coco", tmp_path / "data")
    assert dataset.kinds == {"dog": 1}
    notes = notes_of(dataset)
    assert notes["annotations of a category that the file does not list, left out"] == (
        f"{file}: category_id 9",
    )
    assert notes["annotations of images that their file does not list, left out"] == (
        f"{file}: 1 of them",
    )
    assert notes["annotations whose box cannot be read, left out"] == (f"{file}: annotations[3]",)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (voc("1.jpg")[:-20], "s/1.xml:5:13: is no valid XML (unclosed token); export it again"),
        ('<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n' + voc("&x;"),
         "s/1.xml: declares a document type or entities, which are not read; remove the "
         "declaration or export it again"),
        ("<html></html>", "s/1.xml: is no VOC annotation, it begins with <html>"),
    ],
)  # fmt: skip
def test_damaged_voc(tmp_path: Path, text: str, expected: str) -> None:
    draw(tmp_path / "s/1.jpg")
    write(tmp_path / "s/1.xml", text)
    assert complaint(tmp_path / "s", "voc") == expected


def test_one_damaged_voc_file_among_others(tmp_path: Path) -> None:
    draw_all(tmp_path / "s", ["1.jpg", "2.jpg", "3.jpg"])
    write(tmp_path / "s/1.xml", voc("1.jpg", voc_object("cat", (1, 1, 9, 9))))
    write(tmp_path / "s/2.xml", voc("2.jpg", voc_object("", (1, 1, 9, 9))))
    write(tmp_path / "s/3.xml", "<annotation>")
    dataset, rows = imported(tmp_path / "s", "voc", tmp_path / "data")
    assert len(rows) == 2
    notes = notes_of(dataset)
    assert notes["annotations that cannot be read, left out"] == (
        f"{tmp_path}/s/3.xml:1:13: is no valid XML (no element found); export it again",
    )
    assert notes["things without a name or a box, left out"] == (f"{tmp_path}/s/2.xml: object 1",)


@pytest.mark.parametrize(
    ("yaml", "label", "expected"),
    [
        ("names: [cat\ntrain: x", "", "s/data.yaml:2:6: is no valid YAML (expected ',' or ']', but "
         "got ':'); correct the line"),
        ("- cat\n- dog\n", "", "s/data.yaml: must name the classes (names: [cat, dog]), got list"),
        ("train: images\n", "", "s/data.yaml: names is missing; correct it or export it again"),
        ("names: &a [cat]\ntrain: *a\n", "", "s/data.yaml: has references (*name), which are not "
         "read; write what they stand for"),
        ("names: []\n", "", "s/data.yaml: names: must name at least one class, got list; correct "
         "it or export it again"),
        ("names: [cat]\n", "0 0.5 0.5", "s/labels/1.txt:1: must be a class number and a box "
         "(number, x, y, width, height, each from 0 to 1), got '0 0.5 0.5'; export it again"),
        ("names: [cat]\n", "\n3 .5 .5 .5 .5", "s/labels/1.txt:2: class 3 has no name in "
         "s/data.yaml, which names 1 (from 0); add the name"),
        ("names: [cat]\n", "0 20 10 20 10", "s/labels/1.txt:1: a box of YOLO is measured in shares "
         "from 0 to 1, got '0 20 10 20 10'; export it again"),
        ("names: [cat]\n", "cat .5 .5 .5 .5", "s/labels/1.txt:1: must be a class number and a box "
         "(number, x, y, width, height, each from 0 to 1), got 'cat .5 .5 .5 .5'; export it again"),
    ],
)  # fmt: skip
def test_damaged_yolo(tmp_path: Path, yaml: str, label: str, expected: str) -> None:
    draw(tmp_path / "s/images/1.jpg")
    write(tmp_path / "s/data.yaml", yaml)
    write(tmp_path / "s/labels/1.txt", label or "0 .5 .5 .5 .5")
    assert complaint(tmp_path / "s", "yolo") == expected


def test_yolo_without_names(tmp_path: Path) -> None:
    draw(tmp_path / "s/images/1.jpg")
    write(tmp_path / "s/labels/1.txt", "0 .5 .5 .5 .5")
    assert complaint(tmp_path / "s", "yolo") == (
        "s: there is no data.yaml and no classes.txt beside the labels; one of them says which "
        "class each number stands for"
    )


def test_yolo_labels_without_a_picture(tmp_path: Path) -> None:
    draw_all(tmp_path / "s", ["images/1.jpg", "images/2.jpg"])
    write(tmp_path / "s/data.yaml", "names: [cat, dog]\n")
    for number in (1, 2, 3):
        write(tmp_path / f"s/labels/{number}.txt", f"{number % 2} .5 .5 .5 .5")
    dataset, rows = imported(tmp_path / "s", "yolo", tmp_path / "data")
    assert len(rows) == 2
    assert notes_of(dataset) == {
        "pictures that are not there, left out": (
            "labels/3.txt (a label file without its picture)",
        )
    }


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ({"tasks": [{}]}, "s/a.json: is no export of Label Studio, which is a list of tasks; "
         "export the project as JSON or JSON-MIN"),
        ([{"id": 1, "annotations": [], "data": {"text": "hello"}}],
         "s/a.json: [0]: names no picture (its data are: text); say which holds the picture's path "
         "with --image-column"),
        ([{"id": 1, "annotations": [{"result": [{"value": 3}]}], "data": {"image": "1.jpg"}}],
         "s/a.json: [0].annotations[0].result[0].value: input should be a valid dictionary, got 3; "
         "correct it or export it again"),
        ([{"id": 1, "annotations": {}, "data": {"image": "1.jpg"}}],
         "s/a.json: [0].annotations: input should be a valid list, got dict; correct it or export "
         "it again"),
    ],
)  # fmt: skip
def test_damaged_label_studio(tmp_path: Path, value: object, expected: str) -> None:
    draw(tmp_path / "s/1.jpg")
    file = write_json(tmp_path / "s/a.json", value)
    with pytest.raises(DatasetError) as caught:
        import_pictures(ImportRequest(file, "labelstudio"), tmp_path / "out")
    assert str(caught.value).replace(f"{tmp_path}/", "") == expected


def test_controls_of_label_studio_that_do_not_fit(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    results = [choice("kind", "a"), choice("flaws", "b", "c")]
    write_json(tmp_path / "s/a.json", [task(1, "1.jpg", results)])
    assert complaint(tmp_path / "s", "labelstudio", class_column="kin") == (
        "s: there is no control 'kin'; did you mean 'kind'?"
    )
    assert complaint(tmp_path / "s", "labelstudio", class_column="flaws") == (
        "s: 'flaws' has several choices for one picture and cannot be the class; name another "
        "control with --class-column"
    )
    assert complaint(tmp_path / "s", "labelstudio", image_column="imag") == (
        "s/a.json: [0]: has no 'imag'; did you mean 'image'?"
    )


def test_regions_of_label_studio_that_are_no_boxes(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    brush = {**rectangle("x", (0, 0, 1, 1), region="b"), "type": "brushlabels",
             "value": {"format": "rle", "rle": [0, 1], "brushlabels": ["x"]}}  # fmt: skip
    turned = {**rectangle("x", (0, 0, 50, 50), region="t"), "image_rotation": 90}
    write_json(tmp_path / "s/a.json", [task(1, "1.jpg", [brush, turned])])
    dataset, _ = imported(tmp_path / "s", "labelstudio", tmp_path / "data")
    assert dataset.things == 0
    notes = notes_of(dataset)
    assert notes["regions without a box (brushes, points), left out"] == ("1.jpg box",)
    assert notes["boxes on pictures that were turned while they were labelled, left out"] == (
        "1.jpg",
    )


@pytest.mark.parametrize(
    ("images", "expected"),
    [
        ('<track id="0" label="cat"></track>', "s/annotations.xml: is of the format 'CVAT for "
         "video'; export the task as 'CVAT for images 1.1'"),
        ('<image id="4" width="40" height="20"></image>', "s/annotations.xml: image 4 has no name; "
         "export the task again"),
        ("<image", "s/annotations.xml:5:7: is no valid XML (not well-formed (invalid token)); "
         "export it again"),
    ],
)  # fmt: skip
def test_damaged_cvat(tmp_path: Path, images: str, expected: str) -> None:
    draw(tmp_path / "s/1.jpg")
    write(tmp_path / "s/annotations.xml", cvat(images))
    assert complaint(tmp_path / "s", "cvat") == expected


def test_xml_in_an_encoding_that_does_not_exist(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    write(tmp_path / "s/annotations.xml", cvat("").replace("utf-8", "ut-8"))
    assert complaint(tmp_path / "s", "cvat") == (
        "s/annotations.xml: is no valid XML (unknown encoding: ut-8); export it again"
    )


# Tables ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("t.csv", "colour,size\nred,big\n", "s/t.csv: no column holds paths of pictures (there "
         "are: colour, size); name it with --image-column"),
        ("t.csv", "image,,class\n1.jpg,x,a\n", "s/t.csv:1: column 2 has no name; name it or remove "
         "it"),
        ("t.csv", "image,class,class\n1.jpg,a,b\n", "s/t.csv:1: the column 'class' stands twice; "
         "remove one"),
        ("t.jsonl", '{"image": "1.jpg"}\n{oops}\n', "s/t.jsonl:2: is no valid JSON (Expecting "
         "property name enclosed in double quotes: line 1 column 2 (char 1)); each line is one "
         "object"),
        ("t.jsonl", "[1]\n", 's/t.jsonl:1: must be an object such as {"image": "a.jpg"}, got list'),
        ("t.json", '{"a": 1}', "s/t.json: is no table; as JSON it is a list of objects, one a "
         "picture"),
        ("t.xlsx", "none", "s/t.xlsx: is no Excel table that can be read (File is not a zip file); "
         "save it as CSV"),
        ("t.doc", "none", "s/t.doc: is no table of a kind that is read; save it as one of .csv, "
         ".tsv, .tab, .txt, .xlsx, .xlsm, .jsonl, .ndjson, .json, .parquet, .pq"),
    ],
)  # fmt: skip
def test_damaged_tables(tmp_path: Path, name: str, text: str, expected: str) -> None:
    draw(tmp_path / "s/1.jpg")
    file = write(tmp_path / "s" / name, text)
    with pytest.raises(DatasetError) as caught:
        import_pictures(ImportRequest(file, "table"), tmp_path / "out")
    assert str(caught.value).replace(f"{tmp_path}/", "") == expected


def test_a_damaged_table_in_an_archive_is_named_as_the_user_knows_it(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    write(tmp_path / "s/t.csv", 'image,class\n"1.jpg,a\n')
    text = complaint(pack(tmp_path / "s", tmp_path / "s.zip"), "table")
    assert text.startswith("s.zip: t.csv:2: a quote is opened in line 2 and not closed there")


def test_parquet_without_its_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    file = write(tmp_path / "t.parquet", "PAR1")
    assert complaint(file, "table") == (
        "t.parquet: parquet tables need the package pyarrow; install seewhy[tables], or save the "
        "table as CSV"
    )


def test_damaged_parquet(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow", reason="the extra 'tables' is not installed")
    file = write(tmp_path / "t.parquet", "PAR1 and nothing more")
    text = complaint(file, "table")
    assert text.startswith("t.parquet: is no parquet table that can be read (")


def test_several_tables(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    for name in ("a.csv", "b.csv"):
        write(tmp_path / "s" / name, "image,class\n1.jpg,x\n")
    assert complaint(tmp_path / "s", "table") == (
        "s: holds several tables (a.csv, b.csv); name the one that lists the pictures"
    )


def test_columns_that_are_not_there(tmp_path: Path) -> None:
    draw(tmp_path / "s/1.jpg")
    write(tmp_path / "s/t.csv", "image,klass\n1.jpg,x\n")
    assert complaint(tmp_path / "s", "table", class_column="class") == (
        "s/t.csv: --class-column class: there is no such column; did you mean 'klass'?"
    )


# Features of classes ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("class,tail\ncats,yes\n", "f.csv: no row says the features of the class 'dogs'; it must "
         "be one of: cats"),
        ("class,tail\ncats,yes\ndog,no\n", "f.csv: no row says the features of the class 'dogs'; "
         "did you mean 'dog'?"),
        ("class\ncats\n", "f.csv: has the column 'class' alone; add a column for every feature"),
        ("class,tail\n", "f.csv: the table has no rows; add one per class"),
        ("class,tail\n,yes\n", "f.csv:2: the cell 'class' is empty; name the class"),
        ("class,tail\ncats,yes\ncats,no\n", "f.csv:3: the class 'cats' stands a second time; "
         "remove one of the rows"),
    ],
)  # fmt: skip
def test_tables_of_features(tmp_path: Path, text: str, expected: str) -> None:
    draw_all(tmp_path / "s", ["cats/1.jpg", "dogs/1.jpg"])
    features = write(tmp_path / "f.csv", text)
    assert complaint(tmp_path / "s", "folder", features=features) == expected


def test_several_classes_that_no_row_is_of(tmp_path: Path) -> None:
    draw_all(tmp_path / "s", ["cats/1.jpg", "dogs/1.jpg", "cows/1.jpg"])
    features = write(tmp_path / "f.csv", "class,tail\ncats,yes\n")
    assert complaint(tmp_path / "s", "folder", features=features) == (
        "f.csv: no row says the features of the class 'cows' (nor those of 1 others); it must be "
        "one of: cats"
    )
    assert complaint(tmp_path / "s", "folder", features=tmp_path / "none.csv") == (
        "none.csv: there is no such file; it says the features of every class"
    )


@pytest.mark.parametrize(
    ("pattern", "expected"),
    [
        ("kind", "'kind' does not divide the names of classes; write what their parts are, with "
         "what stands between them, such as number-colour-shape"),
        ("kind-kind", "'kind-kind' does not divide the names of classes; write what their parts "
         "are, with what stands between them, such as number-colour-shape"),
        ("kind-hue", "the class 'cats' is not made as 'kind-hue' says; correct the pattern, or "
         "give a table of the classes' features with --features"),
    ],
)  # fmt: skip
def test_parts_that_do_not_fit(tmp_path: Path, pattern: str, expected: str) -> None:
    draw_all(tmp_path / "s", ["cats/1.jpg", "dogs-red/1.jpg"])
    assert complaint(tmp_path / "s", "folder", class_parts=pattern) == expected


# Options ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("format", "options", "expected"),
    [
        ("coco", {"image_column": "x"}, "--image-column x: goes with table, labelstudio, not with "
         "coco; leave it out"),
        ("voc", {"inside": "x"}, "--inside x: goes with folder, not with voc; leave it out"),
        ("folder", {"class_rule": "large"}, "--class large: did you mean 'largest'?"),
        ("folder", {"test_share": 1.5}, "--test-share must be from 0 to below 1, got 1.5; 0.25 "
         "keeps a quarter"),
        ("folder", {"group": "("}, "--group '(': is no regular expression (missing ), unterminated "
         "subpattern at position 0); '^(.+)_' names what stands before the last _"),
        ("folder", {"group": "zzz"}, "--group 'zzz': is found in no file name, the first is "
         "'1.jpg'; correct the expression"),
        ("folder", {"group": "x" * 300}, "--group has 300 characters, at most 200 are read"),
        ("folder", {"inside": "cat"}, "s: 'cat' is no folder with pictures in it; did you mean "
         "'cats'?"),
        ("folder", {"features": Path("f.csv"), "class_parts": "a-b"}, "--features and "
         "--class-parts both say the features of a class; give one of them"),
    ],
)  # fmt: skip
def test_options(tmp_path: Path, format: str, options: dict[str, object], expected: str) -> None:
    draw_all(tmp_path / "s", ["cats/1.jpg", "dogs/1.jpg"])
    assert complaint(tmp_path / "s", format, **options) == expected


# Several formats at once -----------------------------------------------------------------------


def _mixed(folder: Path) -> Path:
    draw_all(folder, ["1.jpg", "2.jpg"])
    write(folder / "Annotations/1.xml", voc("1.jpg", voc_object("cat", (1, 1, 9, 9))))
    write_json(folder / "a.json", coco(ONE_IMAGE, []))
    return folder


def test_two_formats_in_one_folder(tmp_path: Path, run: Run) -> None:
    source = _mixed(tmp_path / "s")
    dataset, _ = imported(source, "voc", tmp_path / "data")
    assert notes_of(dataset)[
        "annotations of other formats beside those of Pascal VOC, not read"
    ] == ("a.json (COCO)",)
    result = run("new", tmp_path / "d", "--from", source)
    assert (result.code, result.out) == (2, "")
    assert result.err == (
        f"seewhy: {source}: holds annotations of several formats: COCO (a.json), Pascal VOC "
        "(Annotations/1.xml); say which counts with --format coco or --format voc\n"
    )
    assert not (tmp_path / "d").exists()


@pytest.mark.parametrize("format", ["yolo", "cvat", "labelstudio"])
def test_a_source_of_another_format(tmp_path: Path, format: str) -> None:
    draw_all(tmp_path / "s", ["1.jpg"])
    write_json(tmp_path / "s/a.json", coco(ONE_IMAGE, []))
    said = {"yolo": "YOLO", "cvat": "CVAT for images", "labelstudio": "Label Studio"}[format]
    assert complaint(tmp_path / "s", format) == (
        f"s: nothing in it is {said}, but a.json is COCO; give the format coco"
    )


# The command -----------------------------------------------------------------------------------


def test_the_command(tmp_path: Path, run: Run) -> None:
    source = draw_all(tmp_path / "s", ["cats/1.jpg", "cats/2.jpg", "dogs/1.jpg"])
    write(source / "notes.txt", "")
    result = run("data", "import", "folder", source, "--out", tmp_path / "data")
    assert (result.code, result.err) == (0, "files that are no pictures, left out (1): notes.txt\n")
    assert result.out == (
        f"dataset: {tmp_path}/data (3 pictures of 2 classes, linked with their source)\n"
        "  classes: cats 2, dogs 1\n"
        "  splits: none; --test-share 0.25 would keep a quarter for evaluation\n"
        f"  seewhy new NAME --from {tmp_path}/data writes a domain to go with it\n"
    )
    again = run("data", "import", "folder", "--from", source, "--out", tmp_path / "j", "--json")
    report = json.loads(again.out)
    assert (report["pictures"], report["classes"]) == (3, {"cats": 2, "dogs": 1})
    assert report["notes"] == [
        {"text": "files that are no pictures, left out", "places": ["notes.txt"]}
    ]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["foldr", "s"], "'foldr' is no format that is imported; did you mean 'folder'?"),
        (["s"], "'s' is a source; say its format before it: folder, coco, voc, yolo, labelstudio, "
         "cvat, table, clevr"),
        (["folder"], "there is no SOURCE; name a folder, a zip archive or an exported file"),
        (["folder", "s", "t"], "there are 2 sources (s, t); give one: a folder may hold several "
         "exports"),
    ],
)  # fmt: skip
def test_the_command_complains(
    tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch, arguments: list[str], expected: str
) -> None:
    draw_all(tmp_path / "s", ["cats/1.jpg"])
    monkeypatch.chdir(tmp_path)
    result = run("data", "import", *arguments, "--out", "data")
    assert (result.code, result.out, result.err) == (2, "", f"seewhy: {expected}\n")
    assert not (tmp_path / "data").exists()


def test_the_command_knows_all_formats() -> None:
    assert data_import.FORMATS == FORMATS
