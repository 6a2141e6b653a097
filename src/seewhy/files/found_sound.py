"""Texts that a check found nothing wrong with, by digest: they need not be checked twice."""

from __future__ import annotations

import hashlib
import logging
from pathlib import Path

from seewhy.files.cache_folder import cache_folder

__all__ = ["FoundSound"]

_AT_MOST = 2_000  # empty files; half of them go where there are more
_logger = logging.getLogger(__name__)


class FoundSound:
    """The texts that one check found sound, in memory and in the folder for caches.

    It never stands in the way: what cannot be read or written counts as not checked yet.

    Parameters
    ----------
    check : str
        Names the check and its version: what another version found does not count.

    Examples
    --------
    >>> sound = FoundSound("an example 1")
    >>> "a program" in sound
    False
    >>> sound.add("a program")
    >>> "a program" in sound
    True
    """

    def __init__(self, check: str) -> None:
        self._check = check
        self._digests: set[str] = set()

    def __contains__(self, text: str) -> bool:
        digest = self._digest(text)
        if digest in self._digests:
            return True
        folder = _folder()
        try:
            known = folder is not None and (folder / digest).is_file()
        except OSError:
            return False
        if known:
            self._digests.add(digest)
        return known

    def add(self, text: str) -> None:
        """Remember a text."""
        digest = self._digest(text)
        self._digests.add(digest)
        folder = _folder()
        if folder is None:
            return
        try:
            folder.mkdir(parents=True, exist_ok=True)
            (folder / digest).touch()
            _make_room(folder)
        except OSError as problem:
            _logger.warning("%s: what was checked cannot be kept (%s)", folder, problem)

    def _digest(self, text: str) -> str:
        return hashlib.blake2b(f"{self._check}\0{text}".encode(), digest_size=16).hexdigest()


def _folder() -> Path | None:
    cache = cache_folder()
    return cache / "sound" if cache is not None else None


def _make_room(folder: Path) -> None:
    files = list(folder.iterdir())
    if len(files) > _AT_MOST:
        files.sort(key=lambda file: file.stat().st_mtime)
        for file in files[: len(files) // 2]:
            file.unlink(missing_ok=True)
