"""Photographs of BelgiumTS as a dataset, from archives made here and from the real ones."""

from __future__ import annotations

import csv
import io
import json
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from belgiumts_archives import (
    HEADER,
    Files,
    half,
    other_half,
    pack,
    picture,
    row,
    training,
    unpack,
)
from conftest import Run, write_domain
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DatasetError, DomainError
from seewhy_lab.belgiumts.conversion import ImportedDataset, import_photographs
from seewhy_lab.belgiumts.layout import Region

CLASSES = "class_id,class,said,colour,round\n0,good,a good tile,red,yes\n1,bad,a bad tile,blue,no\n"
SCENES = """\
image,class,colour,round,split,group
images/train/00000/00010_00000.png,good,red,yes,train,00000/00010
images/train/00000/00010_00001.png,good,red,yes,train,00000/00010
images/train/00000/00020_00000.png,good,red,yes,train,00000/00020
images/train/00001/00010_00000.png,bad,blue,no,train,00001/00010
images/test/00000/00030_00000.png,good,red,yes,test,00000/00030
"""


@pytest.fixture
def signs(tmp_path: Path) -> Domain:
    """A user's domain whose folder has a classes.csv."""
    folder = write_domain(tmp_path / "own" / "tiles")
    (folder / "classes.csv").write_text(CLASSES)
    return load_domain(folder)


Importer = Callable[..., ImportedDataset]


@pytest.fixture
def imported(signs: Domain, tmp_path: Path) -> Importer:
    """Import files as the archive a.zip; return what was imported to the folder out."""

    def imported(files: Files) -> ImportedDataset:
        return import_photographs([pack(tmp_path / "a.zip", files)], tmp_path / "out", domain=signs)

    return imported


# What is written ------------------------------------------------------------------------------


def as_archives(home: Path) -> list[Path]:
    return [pack(home / "a.zip", training()), pack(home / "b.zip", other_half())]


def as_archives_without_their_folder(home: Path) -> list[Path]:
    return [
        pack(home / f"BelgiumTSC_{name} (1).zip", {k.split("/", 1)[1]: v for k, v in files.items()})
        for name, files in (("Training", training()), ("Testing", other_half()))
    ]


def as_one_archive(home: Path) -> list[Path]:
    return [
        pack(
            home / "all.zip", {f"BelgiumTSC/{k}": v for k, v in (training() | other_half()).items()}
        )
    ]


def as_folders(home: Path) -> list[Path]:
    folder = unpack(home, training() | other_half())
    return [folder / "Testing", folder / "Training"]


def as_folder_of_folders(home: Path) -> list[Path]:
    unpack(home / "BelgiumTSC_Training", training())
    unpack(home / "BelgiumTSC_Testing", other_half())
    return [home]


def as_folder_of_archives(home: Path) -> list[Path]:
    pack(home / "BelgiumTSC_Training.zip", training())
    pack(home / "BelgiumTSC_Testing.zip", other_half())
    pack(home / "holidays.zip", {"../beach.jpg": b""})
    unpack(home, {"training/sport/run.png": b"", "__MACOSX/Training/00000/._a.ppm": b""})
    return [home]


def as_archive_and_folder(home: Path) -> list[Path]:
    pack(home / "BelgiumTSC_Training.zip", training())
    unpack(home, other_half())
    # A path may be named twice.
    return [home, home / "BelgiumTSC_Training.zip"]


@pytest.mark.parametrize(
    "laid_out",
    [
        as_archives,
        as_archives_without_their_folder,
        as_one_archive,
        as_folders,
        as_folder_of_folders,
        as_folder_of_archives,
        as_archive_and_folder,
    ],
)
def test_every_way_to_keep_the_photographs(
    laid_out: Callable[[Path], list[Path]], signs: Domain, tmp_path: Path
) -> None:
    sources = laid_out(tmp_path / "photographs")
    out = tmp_path / "out"
    dataset = import_photographs(sources, out, domain=signs)
    assert (out / "scenes.csv").read_text() == SCENES
    files = training() | other_half()
    for path in sorted(out.glob("images/*/*/*.png")):
        folder = {"train": "Training", "test": "Testing"}[path.parent.parent.name]
        original = Image.open(io.BytesIO(files[f"{folder}/{path.parent.name}/{path.stem}.ppm"]))
        assert np.array_equal(np.asarray(Image.open(path)), np.asarray(original))
    assert len(list(out.glob("images/*/*/*"))) == dataset.photographs == 5
    read = Dataset.load(out, signs)
    assert (len(read.of_split("train")), len(read.of_split("test"))) == (4, 1)
    assert len(set(read.groups)) == 4


def test_pictures_of_other_kinds_and_sizes(imported: Importer, tmp_path: Path) -> None:
    home = "Training/00000"
    names = ["00001_00000.ppm", "00002_00000.ppm", "00003_00000.ppm", "00004_00000.ppm"]
    grey = io.BytesIO()
    Image.new("L", (9, 9), 77).save(grey, "PNG")
    table = HEADER + "".join(row(name, 0, size=(512, 400)) for name in names)
    imported(
        {
            f"{home}/GT-00000.csv": table.encode(),
            f"{home}/00001_00000.png": picture(1, size=(20, 30), kind="PNG"),
            f"{home}/00002_00000.JPG": picture(2, size=(20, 30), kind="JPEG"),
            f"{home}/00003_00000.ppm": picture(3, size=(512, 400)),
            f"{home}/00004_00000.png": grey.getvalue(),
        }
    )
    sizes = {
        path.stem: (opened.size, opened.mode)
        for path in (tmp_path / "out" / "images" / "train" / "00000").iterdir()
        for opened in [Image.open(path)]
    }
    assert sizes == {
        "00001_00000": ((20, 30), "RGB"),
        "00002_00000": ((20, 30), "RGB"),
        "00003_00000": ((256, 200), "RGB"),
        "00004_00000": ((9, 9), "RGB"),
    }
    # Only the third is as its row says, and it was reduced to one half.
    assert (tmp_path / "out" / "regions.csv").read_text() == (
        "image,left,top,right,bottom\nimages/train/00000/00003_00000.png,0,1,256,199\n"
    )


def test_where_the_sign_is(imported: Importer, tmp_path: Path) -> None:
    imported(training())
    rows = (tmp_path / "out" / "regions.csv").read_text().splitlines()
    # Twelve columns and ten rows: the table's X runs down, its Y to the right.
    assert rows[:2] == [
        "image,left,top,right,bottom",
        "images/train/00000/00010_00000.png,1,2,11,8",
    ]
    assert len(rows) == 5


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ((252, 244), (21, 20, 230, 223)),  # as in the archive: sides swapped
        ((126, 122), (10, 10, 115, 112)),  # and halved
        ((96, 93), (8, 8, 88, 85)),  # and its sides rounded
        ((244, 252), (20, 21, 223, 230)),  # a table that somebody has put right
        ((252, 252), None),
        ((252, 200), None),
    ],
)
def test_regions(size: tuple[int, int], expected: tuple[int, ...] | None) -> None:
    assert Region(244, 252, 20, 21, 223, 230).within(*size) == expected


def test_an_interrupted_import_goes_on(signs: Domain, tmp_path: Path) -> None:
    archive, out = pack(tmp_path / "a.zip", training()), tmp_path / "out"

    def interrupt(done: int, total: int) -> None:
        assert total == 4
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        import_photographs([archive], out, domain=signs, on_progress=interrupt)
    assert not (out / "scenes.csv").exists()
    written = {path: path.stat().st_mtime_ns for path in out.glob("images/*/*/*.png")}
    assert len(written) == 2
    import_photographs([archive], out, domain=signs)
    assert {path: path.stat().st_mtime_ns for path in written} == written
    import_photographs([archive], tmp_path / "at once", domain=signs)
    assert contents(out) == contents(tmp_path / "at once")
    # The other half may come later, and a picture that has changed is written again.
    changed = training() | {"Training/00000/00010_00000.ppm": picture(99)} | other_half()
    import_photographs([pack(archive, changed)], out, domain=signs)
    assert (out / "scenes.csv").read_text() == SCENES
    again = {path for path, time in written.items() if path.stat().st_mtime_ns != time}
    assert again == {out / "images" / "train" / "00000" / "00010_00000.png"}


def contents(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


# What is not as it should be, and is told -----------------------------------------------------


def test_oddities_are_told(imported: Importer, tmp_path: Path) -> None:
    files = half("Training", {0: [f"{n:05d}_00000.ppm" for n in range(60)]})
    home = "Training/00000"
    rows = files[f"{home}/GT-00000.csv"].decode()
    files[f"{home}/GT-00000.csv"] = (
        rows
        + row("00003_00000.ppm", 0) * 2
        + row("00077_00000.ppm", 0)
        + row("00088_00000.ppm", 1)
        + "\n"
    ).encode()
    files[f"{home}/00005_00000.png"] = picture(5, kind="PNG")
    files[f"{home}/00088_00000.ppm"] = picture(88)
    files[f"{home}/00099_00000.ppm"] = picture(99)
    files[f"{home}/stop.jpg"] = picture(100, kind="JPEG")
    files[f"{home}/00007_00000.ppm"] = b"P6 12 10 255 cut"
    found = imported(files).halves["train"]
    assert found.repeated_rows == 2
    assert found.classes == {"good": 61, "bad": 0}
    assert found.empty_classes == ("bad",)
    assert found.rows_without_file == (f"{home}/00077_00000",)
    assert found.files_without_row == (f"{home}/00099_00000.ppm", f"{home}/stop.jpg")
    assert found.without_pole == (f"{home}/stop.jpg",)
    assert {entry.file: entry.reason for entry in found.left_out} == {
        f"{home}/00005_00000.ppm": "has the same name as 00005_00000.png",
        f"{home}/00088_00000.ppm": "is of class 00001 by its row, but lies in 00000",
        f"{home}/00007_00000.ppm": "is damaged or cut short (image file is truncated (3 bytes not "
        "processed))",
    }
    last = (tmp_path / "out" / "scenes.csv").read_text().splitlines()[-1]
    assert last == "images/train/00000/stop.png,good,red,yes,train,"
    assert found.groups == 61


def deep(mode: str) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(np.zeros((10, 10), np.uint16)).save(stream, mode)
    return stream.getvalue()


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "is no PPM, PNG or JPEG picture"),
        (b"GIF89a and so on", "is no PPM, PNG or JPEG picture"),
        (picture(0, kind="PNG")[:60], "is damaged or cut short (image file is truncated"),
        (b"P6 60000 60000 255 ", "has far too many pixels for a photograph of a sign"),
        (b"P6 20000 6000 255 ", "has 20000×6000 pixels, too many for a photograph of a sign"),
        (
            picture(0, size=(7, 20)),
            "is 7×20 pixels, too few to see a sign (8 on a side are needed)",
        ),
        (picture(0, size=(2000, 40)), "is 2000×40 pixels, too few to see a sign"),
        (deep("PNG"), "has greys of more than 8 bits"),
        (bytes(65 * 2**20), "has more than 64 MiB"),
    ],
)
def test_pictures_that_cannot_be_used(content: bytes, reason: str, imported: Importer) -> None:
    files = half("Training", {0: [f"{n:05d}_00000.ppm" for n in range(30)]})
    files["Training/00000/00004_00000.ppm"] = content
    found = imported(files).halves["train"]
    assert found.photographs == 29
    assert found.left_out[0].file == "Training/00000/00004_00000.ppm"
    assert found.left_out[0].reason.startswith(reason)


def test_too_many_pictures_that_cannot_be_used(imported: Importer, tmp_path: Path) -> None:
    names = [f"{n:05d}_00000.ppm" for n in range(40)]
    files = half("Training", {0: names})
    for name in names[:2]:
        files[f"Training/00000/{name}"] = b"nothing"
    assert imported(files).photographs == 38  # one in twenty is not too many
    (tmp_path / "out" / "scenes.csv").unlink()
    files[f"Training/00000/{names[2]}"] = b"nothing"
    with pytest.raises(DatasetError) as problem:
        imported(files)
    assert str(problem.value) == (
        f"{tmp_path}/a.zip: 3 of 40 photographs cannot be used, more than one in twenty, among "
        "them Training/00000/00002_00000.ppm (is no PPM, PNG or JPEG picture); download the "
        "archive again"
    )
    assert not (tmp_path / "out" / "scenes.csv").exists()


# Errors ---------------------------------------------------------------------------------------


def changed(table: str) -> Files:
    return training() | {"Training/00001/GT-00001.csv": table.encode("latin-1")}


TABLE = "{home}/a.zip/Training/00001/GT-00001.csv"
NUMBER = "must be a whole number from 0, got"
OFFICIAL = "take the table from the official archive"
BAD_FILES = {
    "another archive": (
        {"README": b"", "pictures/a.png": b"", "val/00000/a.ppm": b""},
        "{home}/a.zip: holds no photographs of BelgiumTS; give BelgiumTSC_Training.zip, "
        "BelgiumTSC_Testing.zip, or a folder with Training/00000 … or Testing/00000 …",
    ),
    "a class folder of no class": (
        training() | {"Training/00062/00001_00000.ppm": picture(0)},
        "{home}/a.zip/Training/00062: is the folder of no known class (they are named 00000 to "
        "00001); remove it, or add its class to classes.csv",
    ),
    "a folder that is no class folder": (
        training() | {"Training/stop/00001_00000.ppm": picture(0)},
        "{home}/a.zip/Training/stop: is the folder of no known class (they are named 00000 to "
        "00001); remove it, or add its class to classes.csv",
    ),
    "a half twice in one archive": (
        training() | {f"copy/{name}": content for name, content in training().items()},
        "{home}/a.zip/copy/Training: the Training half is also in {home}/a.zip/Training; give one "
        "of the two",
    ),
    "tables without pictures": (
        {"Training/00000/GT-00000.csv": HEADER.encode()},
        "{home}/a.zip: not one photograph is left to import; download the archives again",
    ),
    "a path out of the archive": (
        training() | {"Training/../../home/me/00000/a.ppm": b""},
        "{home}/a.zip: a file in the archive is named 'Training/../../home/me/00000/a.ppm', which "
        "leads out of it; this is not the official archive, download that one",
    ),
    "an absolute path": (
        training() | {"/Training/00000/a.ppm": b""},
        "{home}/a.zip: a file in the archive is named '/Training/00000/a.ppm', which leads out of "
        "it; this is not the official archive, download that one",
    ),
    "a table that is no text": (
        changed("Filename;é"),
        f"{TABLE}: is not UTF-8 text; take it from the official archive",
    ),
    "a table without a column": (
        changed(HEADER.replace("Roi.X1;", "")),
        f"{TABLE}:1: the column 'Roi.X1' is missing; the columns must be {HEADER.strip()}",
    ),
    "a table with commas": (
        changed(HEADER.replace(";", ",")),
        f"{TABLE}:1: the column 'Filename' is missing; the columns must be {HEADER.strip()}",
    ),
    "a row cut short": (
        changed(HEADER + "00010_00000.ppm;10;12\n"),
        f"{TABLE}:2: Roi.X1 {NUMBER} ''; {OFFICIAL}",
    ),
    "a cell that is no number": (
        changed(HEADER + "00010_00000.ppm;10;12;2;1;-8;11;1\n"),
        f"{TABLE}:2: Roi.X2 {NUMBER} '-8'; {OFFICIAL}",
    ),
    "a size of nothing": (
        changed(HEADER + "00010_00000.ppm;10;0;2;1;8;11;1\n"),
        f"{TABLE}:2: Width and Height must be at least 1, got 0; {OFFICIAL}",
    ),
    "a row without a file name": (
        changed(HEADER + ";10;12;2;1;8;11;1\n"),
        f"{TABLE}:2: the cell 'Filename' is empty; name the picture's file",
    ),
    "a table that is none": (
        changed(HEADER + "x" * 140_000),
        f"{TABLE}:1: is no table (field larger than field limit (131072)); take it from the "
        "official archive",
    ),
    "a table of sixty-five megabytes": (
        training() | {"Training/00001/GT-00001.csv": bytes(65 * 2**20)},
        f"{TABLE}: has more than 64 MiB; download the archive again",
    ),
}


@pytest.mark.parametrize("case", BAD_FILES)
def test_bad_archives(case: str, imported: Importer, tmp_path: Path) -> None:
    files, text = BAD_FILES[case]
    with pytest.raises(DatasetError) as problem:
        imported(files)
    assert str(problem.value) == text.format(home=tmp_path)
    assert not (tmp_path / "out").exists()


def test_an_encrypted_archive(signs: Domain, tmp_path: Path) -> None:
    packed = bytearray(pack(tmp_path / "b.zip", training()).read_bytes())
    place = packed.index(b"PK\x01\x02")
    while place >= 0:
        packed[place + 8] |= 1
        place = packed.find(b"PK\x01\x02", place + 1)
    (tmp_path / "b.zip").write_bytes(packed)
    with pytest.raises(DatasetError) as problem:
        import_photographs([tmp_path / "b.zip"], tmp_path / "out", domain=signs)
    assert str(problem.value) == (
        f"{tmp_path}/b.zip/Training/00000/GT-00000.csv: is encrypted in the archive, or packed by "
        "an unusual method; download the archive again"
    )


def test_a_picture_damaged_in_the_archive(signs: Domain, tmp_path: Path) -> None:
    files = half("Training", {0: [f"{n:05d}_00000.ppm" for n in range(30)]})
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    packed = bytearray((tmp_path / "a.zip").read_bytes())
    place = packed.index(files["Training/00000/00002_00000.ppm"])
    packed[place + 40] ^= 255
    (tmp_path / "a.zip").write_bytes(packed)
    found = import_photographs([tmp_path / "a.zip"], tmp_path / "out", domain=signs)
    (left_out,) = found.halves["train"].left_out
    assert left_out.file == "Training/00000/00002_00000.ppm"
    assert left_out.reason.startswith("is damaged in the archive (Bad CRC-32")


def test_bad_sources(signs: Domain, tmp_path: Path) -> None:
    (tmp_path / "note.zip").write_text("no archive")
    (tmp_path / "empty").mkdir()
    cut = pack(tmp_path / "cut.zip", training())
    cut.write_bytes(cut.read_bytes()[:-30])
    twice = [unpack(tmp_path / "x", training()), pack(tmp_path / "b.zip", training())]
    for sources, text in (
        ([tmp_path / "nowhere"], f"{tmp_path}/nowhere: there is no such file or folder; check the"),
        ([tmp_path / "note.zip"], f"{tmp_path}/note.zip: is no zip archive, or was cut short ("),
        ([cut], f"{tmp_path}/cut.zip: is no zip archive, or was cut short ("),
        ([tmp_path / "empty"], f"{tmp_path}/empty: holds no photographs of BelgiumTS; give Belg"),
        (
            twice,
            f"{tmp_path}/b.zip/Training: the Training half is also in {tmp_path}/x/Training; give "
            "one of the two",
        ),
    ):
        with pytest.raises(DatasetError) as problem:
            import_photographs(sources, tmp_path / "out", domain=signs)
        assert str(problem.value).startswith(text)


def test_another_dataset_is_not_overwritten(imported: Importer, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "scenes.csv").write_text("mine")
    with pytest.raises(DatasetError) as problem:
        imported(training())
    assert str(problem.value) == (
        f"{tmp_path}/out: holds a dataset that was not imported; choose another folder"
    )
    assert (tmp_path / "out" / "scenes.csv").read_text() == "mine"


BAD_CLASSES = {
    ":1: the column 'round' is missing; add it": "class_id,class,colour\n",
    ":3: class_id must be a whole number from 0, got 'one'": CLASSES.replace("\n1,", "\none,"),
    ":3: the class_id 0 stands twice; remove one": CLASSES.replace("\n1,", "\n0,"),
    ":3: 'bat' is no class of the domain 'tiles'; did you mean 'bad'?": CLASSES.replace(
        "bad,", "bat,"
    ),
    ":3: 'bleu' is no value of 'colour'; did you mean 'blue'?": CLASSES.replace("blue", "bleu"),
    ":3: '' is no value of 'colour'; it must be one of": CLASSES.replace("blue,no", ""),
    ": the table has no rows; add one per class": CLASSES.splitlines()[0] + "\n",
    ": is no table (": CLASSES + "é",
    ": there is no such file; it says which class the photographs of a class folder show, with "
    "the columns class_id, class, colour, round": None,
}


@pytest.mark.parametrize("text", BAD_CLASSES)
def test_bad_tables_of_classes(
    text: str, imported: Importer, signs: Domain, tmp_path: Path
) -> None:
    path = signs.folder / "classes.csv"
    path.unlink()
    if (table := BAD_CLASSES[text]) is not None:
        path.write_bytes(table.encode("latin-1"))
    with pytest.raises(DomainError) as problem:
        imported(training())
    assert str(problem.value).startswith(f"{path}{text}")
    assert not (tmp_path / "out").exists()


# The command ----------------------------------------------------------------------------------


def test_the_command(
    run: Run, signs: Domain, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    files = training()
    files["Training/00000/GT-00000.csv"] += row("00010_00000.ppm", 0).encode() * 2
    files |= {f"Training/00001/{n:05d}_00000.ppm": picture(n) for n in range(20, 50)}
    files["Training/00001/00030_00000.ppm"] = b""
    pack(Path("BelgiumTSC_Training.zip"), files)
    unpack(Path("x"), other_half())
    command = ("belgiumts", "import", "--domain", signs.folder, "--out", "out")
    result = run(*command, "BelgiumTSC_Training.zip", "x")
    assert result.code == 0
    assert result.err == (
        "left out (1): Training/00001/00030_00000.ppm is no PPM, PNG or JPEG picture\n"
        "pictures without a row, used all the same (30): Training/00001/00020_00000.ppm; "
        "Training/00001/00021_00000.ppm; Training/00001/00022_00000.ppm; "
        "Training/00001/00023_00000.ppm; Training/00001/00024_00000.ppm; and 25 more\n"
    )
    assert [line.rstrip() for line in result.out.splitlines()] == [
        "class  train  test",
        "good       3     1",
        "bad       30     0",
        "",
        "train: 33 photographs (the official archive has 4,575) of 32 signs in 2 classes, from "
        "BelgiumTSC_Training.zip/Training",
        "  2 rows of its tables name a picture again and add nothing",
        "test: 1 photographs (the official archive has 2,520) of 1 signs in 1 classes, from "
        "x/Testing",
        "  classes without a photograph (1): bad",
        "dataset: out (34 photographs)",
    ]
    result = run(*command, "x", "--json")
    assert json.loads(result.out) == {
        "folder": "out",
        "photographs": 1,
        "halves": {
            "test": {
                "source": "x/Testing",
                "photographs": 1,
                "official": 2520,
                "classes": {"good": 1, "bad": 0},
                "groups": 1,
                "repeated_rows": 0,
                "left_out": [],
                "rows_without_file": [],
                "files_without_row": [],
                "without_pole": [],
                "empty_classes": ["bad"],
            }
        },
    }
    result = run(*command, "x")
    assert "the training half was not given: no row of scenes.csv has split = train" in result.out


def test_the_command_complains(run: Run, tmp_path: Path) -> None:
    out = ("--out", tmp_path / "out")
    result = run("belgiumts", "import", tmp_path / "nowhere", *out)
    assert (result.code, result.out) == (2, "")
    assert result.err == (
        f"seewhy: {tmp_path}/nowhere: there is no such file or folder; check the path\n"
    )
    result = run("data", "import", "germants", "--from", tmp_path, *out)
    assert result.code == 2
    assert "'germants' is no format that is imported; it must be one of: folder, " in result.err
    result = run("belgiumts", "import", *out)
    assert result.code == 2
    assert "there is no ARCHIVE; name BelgiumTSC_Training.zip, or several" in result.err
    for name, says in (("import", "that were downloaded before"), ("fetch", "from their authors'")):
        assert says in run("belgiumts", name, "--help").out


# The photographs ------------------------------------------------------------------------------


def test_the_photographs(photographs: Path, tmp_path: Path) -> None:
    domain = load_domain("traffic_signs")
    halves = import_photographs([photographs], tmp_path, domain=domain).halves
    for half_ in halves.values():
        assert half_.photographs == half_.official
        assert half_.left_out == half_.rows_without_file == half_.files_without_row == ()
        assert half_.without_pole == ()
        assert half_.classes.keys() == domain.classes.keys()
    assert (halves["train"].groups, halves["train"].repeated_rows) == (1545, 16)
    assert halves["train"].empty_classes == ()
    read = Dataset.load(tmp_path, domain)
    sizes = {}
    for scene in read.scenes:
        with Image.open(scene.picture) as opened:
            sizes[scene.picture.relative_to(tmp_path).as_posix()] = opened.size
    with (tmp_path / "regions.csv").open() as stream:
        regions = list(csv.DictReader(stream))
    # Every size fits its row one way or the other, and the sign fills most of the picture:
    # about a tenth of the sign's size is left around it.
    assert [region["image"] for region in regions] == list(sizes)
    for region in regions:
        width, height = sizes[region["image"]]
        left, top, right, bottom = (int(region[s]) for s in ("left", "top", "right", "bottom"))
        assert 0 <= left < right <= width
        assert 0 <= top < bottom <= height
        assert abs(left - (width - right)) <= 0.1 * width + 3
        assert abs(top - (height - bottom)) <= 0.1 * height + 3
