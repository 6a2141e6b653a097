"""What reads a stranger's pictures, tables and exports, each as a target that takes any bytes."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from hypothesis import strategies as st
from PIL import Image

from seewhy.data.dataset import Dataset
from seewhy.data.importers import ImportRequest, import_pictures
from seewhy.data.importers.class_features import read_class_features
from seewhy.data.importers.picture_files import read_header
from seewhy.data.picture_listing import list_pictures
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import SeeWhyError
from seewhy.perception.picture import read_picture
from seewhy.perception.pixels_digest import pixels_digest

CORPUS = Path(__file__).parent / "corpus"

LONGEST = 60.0
"""Seconds that no input of a few kilobytes may take."""

TOKENS = (
    b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\x00\x00\x00\x00", b"\xff\xd8", b"\xff\xda",
    b"\xff\xc2", b"IHDR", b"IDAT", b"PLTE", b"tRNS", b"eXIf", b"Exif\0\0", b"II*\0", b"MM\0*",
    b"RIFF", b"VP8X", b"%!PS-Adobe-3.0 EPSF-3.0\n", b"P5\n", b"-", b"1e999", b"NaN", b"null",
    b"true", b"{}", b"[", b"]", b'"', b"'", b"\\u0000", b"\\", b"\0", b"<", b"&lt;",
    b"<!DOCTYPE x>", b"&a", b"*a", b"!!python/object:os.system", b"\xff\xfe", b"\xef\xbb\xbf",
    b"\r", b"\n", b";",
    b"\t", b"|", b",", b"sep=;\n", b"../", b"/etc/passwd", b"C:\\", b"\x1b[2J", b"\xe2\x80\xae",
    b"PK\x03\x04", b"PK\x01\x02", b"99999999999999999999", b"image", b"class",
)  # fmt: skip


@dataclass(frozen=True)
class Target:
    """A reader, and what it is given.

    Attributes
    ----------
    name : str
    seeds : tuple of str
        Patterns of the files of the corpus that it reads well.
    file : str
        Where the bytes are put, below the folder of :func:`surroundings`.
    read : callable
        Of that file and a folder that is its own; raises a SeeWhyError where the file is wrong.
    """

    name: str
    seeds: tuple[str, ...]
    file: str
    read: Callable[[Path, Path], object]

    def corpus(self) -> list[bytes]:
        """The content of its files of the corpus."""
        return [
            file.read_bytes() for pattern in self.seeds for file in sorted(CORPUS.glob(pattern))
        ]

    def survive(self, content: bytes, home: Path) -> str:
        """Read bytes; return the sentence about what is wrong with them, empty where nothing is.

        Raises
        ------
        AssertionError
            If that is no sentence, or reading takes too long.
        Exception
            Whatever else the reader raises: each is a finding.
        """
        file, out = home / "sources" / self.file, home / "out"
        file.write_bytes(content)
        shutil.rmtree(out, ignore_errors=True)
        started = time.monotonic()
        complaint = ""
        try:
            self.read(file, out)
        except SeeWhyError as problem:
            complaint = str(problem)
        assert time.monotonic() - started < LONGEST
        assert "\n" not in complaint
        assert "Error" not in complaint.split("(", maxsplit=1)[0]
        return complaint


def surroundings(folder: Path) -> Path:
    """Write the pictures and folders beside which the bytes are put; return the folder."""
    home = folder / "sources"
    for name in ("1.jpg", "2.jpg", "images/1.jpg", "images/2.jpg", "voc/1.jpg", "yolo/images/1.jpg",
                 "yolo/images/2.jpg", "data/1.jpg", "data/2.jpg", "listed/1.jpg",
                 "listed/2.jpg"):  # fmt: skip
        (home / name).parent.mkdir(parents=True, exist_ok=True)
        Image.new("RGB", (40, 20), "red").save(home / name)
    (home / "yolo/labels").mkdir(exist_ok=True)
    (home / "names/labels").mkdir(parents=True, exist_ok=True)
    shutil.copytree(home / "yolo/images", home / "names/images", dirs_exist_ok=True)
    shutil.copy(CORPUS / "label.txt", home / "names/labels/1.txt")
    shutil.copy(CORPUS / "names.yaml", home / "yolo/data.yaml")
    return folder


def _read_picture(file: Path, _: Path) -> None:
    with file.open("rb") as stream:
        try:
            whole_header = read_header(stream).size != (0, 0)
        except SeeWhyError:
            whole_header = False
    pixels = read_picture(file, size=32)
    assert (pixels.shape, pixels.dtype) == ((32, 32, 3), "uint8")
    assert whole_header
    assert len(pixels_digest(file)) == 64


def _read_dataset(file: Path, _: Path) -> None:
    for scene in Dataset.load(file.parent, _domain()).scenes:
        assert scene.picture.resolve().is_relative_to(file.parent.resolve())


def _read_listing(file: Path, _: Path) -> None:
    for picture in list_pictures([file], _domain(), with_class=True).pictures:
        assert picture.resolve().is_relative_to(file.parent.resolve())


@cache
def _domain() -> Domain:
    return load_domain("structure_stability")


def _read_features(file: Path, _: Path) -> None:
    read_class_features(file)


def _import(format: str, source: str = "") -> Callable[[Path, Path], None]:
    """Import the file, or the folder of this name that it lies in."""

    def read(file: Path, out: Path) -> None:
        folder = next((parent for parent in file.parents if parent.name == source), None)
        whole = folder if source and folder is not None else file
        written = False
        try:
            import_pictures(ImportRequest(whole, format, copy=True), out)
            written = True
        finally:
            assert (out / "scenes.csv").exists() == written
            assert all(path.resolve().is_relative_to(out.resolve()) for path in out.rglob("*"))

    return read


TARGETS = (
    Target("picture", ("*.png", "*.jpg", "*.gif", "*.tif", "*.webp", "*.bmp", "*.p?m"),
           "input.png", _read_picture),
    Target("dataset", ("scenes*.csv",), "data/scenes.csv", _read_dataset),
    Target("listing", ("scenes*.csv",), "listed/pictures.csv", _read_listing),
    Target("features", ("features.csv",), "features.csv", _read_features),
    Target("folder", ("*.zip",), "folders.zip", _import("folder")),
    Target("coco", ("coco.json",), "coco.json", _import("coco")),
    Target("labelstudio", ("studio.json",), "studio.json", _import("labelstudio")),
    Target("voc", ("voc.xml",), "voc/1.xml", _import("voc")),
    Target("cvat", ("cvat.xml",), "annotations.xml", _import("cvat")),
    Target("yolo labels", ("label.txt",), "yolo/labels/1.txt", _import("yolo", "yolo")),
    Target("yolo names", ("names.yaml",), "names/data.yaml", _import("yolo", "names")),
    Target("table", ("table.csv",), "table.csv", _import("table")),
    Target("workbook", ("*.xlsx",), "table.xlsx", _import("table")),
    Target("json table", ("table.json",), "table.json", _import("table")),
    Target("json lines", ("*.jsonl",), "table.jsonl", _import("table")),
)  # fmt: skip


def inputs(corpus: Sequence[bytes]) -> st.SearchStrategy[bytes]:
    """Files of the corpus with some changes, and now and then any bytes."""
    content = st.one_of(st.sampled_from(TOKENS), st.binary(max_size=6))
    kind = st.sampled_from(["overwrite", "insert", "delete", "repeat", "cut"])
    change = st.tuples(kind, st.floats(0, 1, exclude_max=True), content, st.integers(1, 40))
    changed = st.builds(_changed, st.sampled_from(list(corpus)), st.lists(change, max_size=5))
    return st.one_of(changed, changed, changed, st.binary(max_size=400))


def _changed(whole: bytes, changes: Sequence[tuple[str, float, bytes, int]]) -> bytes:
    for kind, place, content, length in changes:
        at = int(place * len(whole))
        before, after = whole[:at], whole[at:]
        if kind == "overwrite":
            whole = before + content + after[len(content) :]
        elif kind == "insert":
            whole = before + content + after
        elif kind == "delete":
            whole = before + after[length:]
        elif kind == "repeat":
            whole = before + after[:length] * 20 + after
        else:
            whole = before
    return whole
