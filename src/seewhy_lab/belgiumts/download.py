"""The official archives from the network: resumed where they broke off, and checked."""

from __future__ import annotations

import http
import http.client
import lzma
import re
import ssl
import urllib.error
import urllib.request
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

from seewhy.errors import DatasetError
from seewhy_lab.belgiumts.layout import PHOTOGRAPHS, open_halves

ADDRESS = "https://btsd.ethz.ch/shareddata/BelgiumTSC/"
ARCHIVES = {"train": "BelgiumTSC_Training.zip", "test": "BelgiumTSC_Testing.zip"}

_PIECE = 2**18
_SECONDS = 30
_ATTEMPTS = 3

Progress = Callable[[str, int, int | None], None]
"""Called with the archive's name, the bytes that are here, and the bytes in all where known."""


def fetch_archives(
    folder: Path, *, address: str = ADDRESS, on_progress: Progress | None = None
) -> list[Path]:
    """Download both official archives to ``folder`` unless they are there; return their paths.

    What has arrived is kept in a file that ends in ``.part``, and the next call goes on from
    there where the server can. An archive is put in its place when every file in it is well.

    Raises
    ------
    DatasetError
        If the server cannot be reached or has no such file, the connection breaks off three
        times in a row without anything new, or what came is no whole archive. The text says how
        to go on, by hand if need be.
    """
    if not address.startswith(("https://", "http://")):
        raise DatasetError(f"'{address}' must begin with https:// or http://; correct the address")
    address = address.rstrip("/") + "/"
    return [_fetch(folder / name, address, on_progress) for name in ARCHIVES.values()]


def check_counts(archives: list[Path], *, class_ids: set[int]) -> None:
    """Raise a DatasetError if the archives do not hold as many photographs as the official ones."""
    with open_halves(archives, class_ids=class_ids) as halves:
        counts = {half.split: len(half.photographs) for half in halves}
    for (split, name), path in zip(ARCHIVES.items(), archives, strict=True):
        if counts.get(split, 0) != PHOTOGRAPHS[split]:
            raise DatasetError(
                f"{path}: holds {counts.get(split, 0):,} photographs, {name} should hold "
                f"{PHOTOGRAPHS[split]:,}; delete it and fetch it again"
            )


def _fetch(target: Path, address: str, on_progress: Progress | None) -> Path:
    if target.is_file() and _damage(target) is None:
        return target
    target.parent.mkdir(parents=True, exist_ok=True)
    part = target.with_name(target.name + ".part")
    url = address + target.name
    fruitless = 0
    while True:
        before = _size(part)
        try:
            if _receive(url, part, target.name, on_progress):
                break
            reason = f"broke off after {_megabytes(_size(part))}"
        except urllib.error.HTTPError as problem:
            raise DatasetError(
                f"{url}: the server answers {problem.code} {problem.reason}; {_by_hand(address)}"
            ) from None
        except urllib.error.URLError as problem:
            # Not being let in is no matter of trying again.
            raise DatasetError(
                f"{url}: cannot be reached ({_said(problem.reason)}); {_by_hand(address)}"
            ) from None
        except (http.client.HTTPException, ConnectionError, TimeoutError, ssl.SSLError) as problem:
            reason = f"broke off after {_megabytes(_size(part))} ({_said(problem)})"
        fruitless = 0 if _size(part) > before else fruitless + 1
        if fruitless == _ATTEMPTS:
            raise DatasetError(
                f"{url}: {reason}; the same command goes on from there, or {_by_hand(address)}"
            )
    damage = _damage(part)
    if damage is not None:
        part.unlink()
        raise DatasetError(
            f"{url}: what came {damage} and was deleted; run the command again, or "
            f"{_by_hand(address)}"
        )
    part.replace(target)
    return target


def _receive(url: str, part: Path, name: str, on_progress: Progress | None) -> bool:
    """Append what is missing to ``part``; return whether it is all there."""
    start = _size(part)
    request = urllib.request.Request(url, headers={"User-Agent": "seewhy"})
    if start:
        request.add_header("Range", f"bytes={start}-")
    try:
        response = urllib.request.urlopen(request, timeout=_SECONDS)
    except urllib.error.HTTPError as problem:
        with problem:
            if problem.code != http.HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE:
                raise
            # Nothing follows what is here: either that is all, or it belongs to another file.
            total = re.fullmatch(r"bytes \*/(\d+)", problem.headers.get("Content-Range", ""))
            if total and int(total[1]) == start:
                return True
        part.unlink()
        return False
    with response:
        span = re.fullmatch(r"bytes (\d+)-\d+/(\d+|\*)", response.headers.get("Content-Range", ""))
        goes_on = response.status == http.HTTPStatus.PARTIAL_CONTENT
        if goes_on and not (span and int(span[1]) == start):
            part.unlink()
            return False
        length = response.headers.get("Content-Length")
        begin = start if goes_on else 0
        total_size = begin + int(length) if length and length.isdigit() else None
        with part.open("ab" if goes_on else "wb") as stream:
            while piece := response.read(_PIECE):
                stream.write(piece)
                if on_progress is not None:
                    on_progress(name, stream.tell(), total_size)
    return total_size is None or _size(part) == total_size


_DAMAGED = (
    zipfile.BadZipFile, zlib.error, lzma.LZMAError, EOFError, OSError, RuntimeError, ValueError,
)  # fmt: skip
"""What reading an archive raises that is not whole, however its members are packed."""


def _damage(path: Path) -> str | None:
    """What keeps a file from being a whole zip archive; None where it is one."""
    try:
        with zipfile.ZipFile(path) as archive:
            damaged = archive.testzip()
    except _DAMAGED as problem:
        return f"is no whole zip archive ({problem})"
    return f"is damaged ({damaged})" if damaged is not None else None


def _by_hand(address: str) -> str:
    files = " and ".join(address + name for name in ARCHIVES.values())
    sources = " ".join(f"{name}" for name in ARCHIVES.values())
    return f"download {files} in a browser and run 'seewhy belgiumts import {sources} --out DIR'"


def _size(path: Path) -> int:
    return path.stat().st_size if path.exists() else 0


def _megabytes(count: int) -> str:
    return f"{count / 1e6:.1f} MB"


def _said(reason: object) -> str:
    if isinstance(reason, OSError) and reason.strerror:
        return reason.strerror
    return str(reason) or type(reason).__name__
