"""Pictures among the files of a source: which they are, where they lie, how large they are."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import IO
from urllib.parse import parse_qs, unquote, urlsplit

from seewhy.data.importers.annotation import Notes
from seewhy.data.importers.source_files import SourceFiles
from seewhy.errors import PictureError

ENDINGS = (
    ".jpg", ".jpeg", ".jpe", ".jfif", ".png", ".bmp", ".gif", ".tif", ".tiff", ".webp", ".ppm",
    ".pgm", ".pbm", ".pnm",
)  # fmt: skip
"""How the names of pictures end, in any case."""

SPLITS = {
    "train": "train",
    "training": "train",
    "train2014": "train",
    "train2017": "train",
    "trainval": "train",
    "val": "validation",
    "val2014": "validation",
    "val2017": "validation",
    "valid": "validation",
    "validation": "validation",
    "dev": "validation",
    "test": "test",
    "test2017": "test",
    "testing": "test",
}
"""Word → the split that it stands for; "default" and others stand for none."""

_UPLOADED = re.compile(r"[0-9a-f]{6,8}-(?=.)")
_QUARTER_TURNS = (5, 6, 7, 8)
_ORIENTATION = 0x0112


@dataclass(frozen=True)
class PictureHeader:
    """How large a picture is, in pixels.

    Attributes
    ----------
    size : pair of int
        Width and height upright, as a person sees it.
    stored : pair of int
        Width and height as they are stored, before the camera's note on how it was held.
    orientation : int
        That note, from 1 (upright) to 8, as EXIF has it.
    """

    size: tuple[int, int]
    stored: tuple[int, int]
    orientation: int = 1


def is_picture_name(name: str) -> bool:
    """Whether a file is a picture by its name.

    Examples
    --------
    >>> is_picture_name("cats/IMG_1.JPG"), is_picture_name("LICENSE.txt")
    (True, False)
    """
    return name.casefold().endswith(ENDINGS)


def split_of(word: str) -> str:
    """Return the split that a word stands for; empty for a word of another meaning.

    Examples
    --------
    >>> split_of("Valid"), split_of("default")
    ('validation', '')
    """
    return SPLITS.get(word.strip().casefold(), "")


def read_header(stream: IO[bytes]) -> PictureHeader:
    """Return how large a picture is; its pixels are not decoded.

    Raises
    ------
    PictureError
        If it is no picture that can be looked at; the text is the reason alone.
    """
    from seewhy.perception.picture_file import damaged, open_picture

    try:
        with open_picture(stream) as image:
            width, height = image.size
            orientation = int(image.getexif().get(_ORIENTATION, 1) or 1)
    except PictureError as problem:
        raise PictureError(_without_remedy(str(problem))) from None
    except Exception as problem:
        # What reads the camera's notes raises whatever the damaged bytes lead it to.
        raise PictureError(_without_remedy(damaged(problem))) from None
    turned = orientation in _QUARTER_TURNS
    size = (height, width) if turned else (width, height)
    return PictureHeader(size=size, stored=(width, height), orientation=orientation)


def _without_remedy(text: str) -> str:
    """A sentence's reason alone: whoever lists many pictures says once what is to be done."""
    return text.rpartition(": ")[0]


class PictureFinder:
    """Finds the file that a path in an export means.

    Tools write paths from their own server or another machine: as much of the path's end as
    there is must be right, and no two files may fit alike.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from seewhy.data.importers.folder_files import FolderFiles
    >>> home = pathlib.Path(tempfile.mkdtemp())
    >>> (home / "images").mkdir()
    >>> (home / "images" / "a b.jpg").touch()
    >>> finder = PictureFinder(FolderFiles(home), Notes())
    >>> finder.find("/data/upload/1/3f2a91bc-a%20b.jpg")
    'images/a b.jpg'
    >>> finder.find("c.jpg") is None
    True
    """

    def __init__(self, files: SourceFiles, notes: Notes, *, beside: Iterable[str] = ()) -> None:
        self._files = files
        self._notes = notes
        self._beside = tuple(dict.fromkeys(("", *beside)))

    @cached_property
    def pictures(self) -> list[str]:
        """The names of all pictures of the source."""
        return [name for name in self._files.names if is_picture_name(name)]

    @cached_property
    def _by_last_part(self) -> dict[str, list[str]]:
        found: dict[str, list[str]] = {}
        for name in self.pictures:
            found.setdefault(posixpath.basename(name).casefold(), []).append(name)
        return found

    def has(self, name: str) -> bool:
        """Whether there is a file of just this name."""
        return self._files.has(name)

    def find(self, written: str, *, split: str = "") -> str | None:
        """Return the name of the file that a path means, or None where there is none.

        A file in a folder of another ``split`` is not meant.
        """
        path = _plain(written)
        if not path:
            return None
        for folder in self._beside:
            candidate = posixpath.normpath(posixpath.join(folder, path))
            if self._files.has(candidate):
                return candidate
        last = posixpath.basename(path)
        uploaded = _UPLOADED.sub("", last, count=1)
        return next(
            (
                found
                for called in dict.fromkeys((last, uploaded))
                if (found := self._by_end(path, called, split)) is not None
            ),
            None,
        )

    def _by_end(self, path: str, last: str, split: str) -> str | None:
        splits = _splits_of(path) or {split} - {""}
        same = [
            name
            for name in self._by_last_part.get(last.casefold(), ())
            if not (splits and _splits_of(name) and splits.isdisjoint(_splits_of(name)))
        ]
        if not same:
            return None
        wanted = posixpath.dirname(path).split("/")
        shared = [_common_end(posixpath.dirname(name).split("/"), wanted) for name in same]
        best = [name for name, count in zip(same, shared, strict=True) if count == max(shared)]
        if len(best) > 1:
            self._notes.add("file names that several pictures have, not told apart", path)
            return None
        return best[0]


def _plain(written: str) -> str:
    """A path or address as a path with "/" that can be looked for."""
    text = written.strip().replace("\\", "/")
    if "?d=" in text or "&d=" in text:
        return parse_qs(urlsplit(text).query).get("d", [""])[0].lstrip("/")
    if re.match(r"[a-zA-Z][a-zA-Z0-9+.-]+://", text):
        text = unquote(urlsplit(text).path)
    elif text.startswith("/data/") and "%" in text:
        text = unquote(text)
    text = re.sub(r"^[A-Za-z]:", "", text).lstrip("/")
    while text.startswith("./"):
        text = text[2:]
    return text


def _common_end(first: Sequence[str], second: Sequence[str]) -> int:
    count = 0
    for one, other in zip(reversed(first), reversed(second), strict=False):
        if one != other:
            break
        count += 1
    return count


def _splits_of(path: str) -> set[str]:
    """The splits that a path's folders name."""
    return {split_of(part) for part in path.split("/")[:-1]} - {""}
