"""Pictures of a source put into a dataset folder: under which names, linked or copied."""

from __future__ import annotations

import io
import logging
import os
import shutil
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path
from posixpath import splitext

from seewhy.data.importers.picture_files import PictureHeader, read_header
from seewhy.data.importers.source_files import SourceFiles, read_bytes
from seewhy.files.whole_files import whole_file

_LONGEST_PART = 180
_logger = logging.getLogger(__name__)


class Placing:
    """Puts pictures into a folder: as links while that works, as copies else.

    ``links`` tells whether all were linked so far.
    """

    def __init__(self, files: SourceFiles, folder: Path, *, link: bool) -> None:
        self._files = files
        self._folder = folder
        self.links = link

    def place(self, name: str, image: str) -> PictureHeader:
        """Put a picture where it belongs unless it is there; return how large it is."""
        target = self._folder / image
        path = self._files.on_disk(name)
        if path is not None:
            with self._files.open(name) as stream:
                header = read_header(stream)
            self._from_disk(path, target, name)
            return header
        self.links = False
        if self._is_there(target, name):
            with target.open("rb") as stream:
                return read_header(stream)
        content = read_bytes(self._files, name)
        header = read_header(io.BytesIO(content))
        with whole_file(target, durable=False) as temporary:
            temporary.write_bytes(content)
            self._stamp(temporary, name)
        return header

    def _from_disk(self, path: Path, target: Path, name: str) -> None:
        if target.exists() and (target.samefile(path) or self._is_there(target, name)):
            return
        target.parent.mkdir(parents=True, exist_ok=True)
        if self.links:
            target.unlink(missing_ok=True)
            try:
                target.hardlink_to(path.resolve())
                return
            except OSError as problem:
                self.links = False  # another file system, or none that can
                _logger.info("pictures are copied, since they cannot be linked (%s)", problem)
        with whole_file(target, durable=False) as temporary:
            shutil.copyfile(path, temporary)
            self._stamp(temporary, name)

    def _is_there(self, target: Path, name: str) -> bool:
        """Whether a copy of just this file is there: its size and time are those of the source."""
        if not target.is_file():
            return False
        found = target.stat()
        same_size = found.st_size == self._files.bytes_of(name)
        return same_size and int(found.st_mtime) == int(self._files.changed(name))

    def _stamp(self, copy: Path, name: str) -> None:
        changed = self._files.changed(name)
        os.utime(copy, (changed, changed))


def image_names(files: Sequence[str]) -> list[str]:
    """Return where the pictures of a source go in a dataset: every file a place of its own.

    Folders that all share are left out, and so are characters that file systems refuse.

    Examples
    --------
    >>> image_names(["hands/0/a.jpg", "hands/0/A.JPG", "hands/1/what?.jpg"])
    ['images/0/a.jpg', 'images/0/A-2.JPG', 'images/1/what_.jpg']
    """
    folders = [file.split("/")[:-1] for file in files]
    shared = folders[0] if folders else []
    for folder in folders:
        count = next(
            (n for n, (one, other) in enumerate(zip(shared, folder, strict=False)) if one != other),
            min(len(shared), len(folder)),
        )
        shared = shared[:count]
    used: set[str] = set()
    names = []
    for file in files:
        parts = [safe_part(part) for part in file.split("/")[len(shared) :]]
        name = "/".join(["images", *parts])
        stem, ending = splitext(name)
        number = 2
        while name.casefold() in used:
            name = f"{stem}-{number}{ending}"
            number += 1
        used.add(name.casefold())
        names.append(name)
    return names


def safe_part(part: str) -> str:
    """Return a part of a path without what file systems refuse, of a length that they take."""
    safe = "".join(
        "_" if character in '<>:"|?*\\' or not character.isprintable() else character
        for character in part
    ).strip()
    if len(safe.encode()) > _LONGEST_PART:
        stem, dot, ending = safe.rpartition(".")
        digest = sha256(part.encode(errors="surrogateescape")).hexdigest()[:12]
        short = (stem or safe).encode()[: _LONGEST_PART - 40].decode(errors="ignore")
        safe = f"{short}-{digest}{dot}{ending[:20]}"
    return safe.lstrip(".") or "_"
