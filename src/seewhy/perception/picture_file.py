"""Which picture files are read, how large they may be, and how much memory reading them takes.

A picture may come from a stranger. Of Pillow's formats only those named here are tried, whatever a
file is called: PostScript, for one, would be given to Ghostscript, which runs it.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Condition
from typing import IO

from PIL import (
    BmpImagePlugin,
    GifImagePlugin,
    Image,
    JpegImagePlugin,
    PngImagePlugin,
    PpmImagePlugin,
    TiffImagePlugin,
    UnidentifiedImageError,
    WebPImagePlugin,
)

from seewhy.errors import PictureError

__all__ = [
    "FORMATS",
    "LARGEST_MEGAPIXELS",
    "MOST_MEMORY",
    "SMALLEST_SIDE",
    "check_measures",
    "damaged",
    "memory_for",
    "open_picture",
]

_PLUGINS = (
    JpegImagePlugin.JpegImageFile,
    PngImagePlugin.PngImageFile,
    BmpImagePlugin.BmpImageFile,
    GifImagePlugin.GifImageFile,
    TiffImagePlugin.TiffImageFile,
    WebPImagePlugin.WebPImageFile,
    PpmImagePlugin.PpmImageFile,
)

FORMATS = tuple(str(plugin.format) for plugin in _PLUGINS)
"""What is read, in Pillow's words: JPEG, PNG, BMP, GIF, TIFF, WEBP and PPM."""

SMALLEST_SIDE = 8
"""Pictures with a side shorter than this (in pixels) show nothing that a network could see."""

LARGEST_MEGAPIXELS = 100
"""Pictures larger than this are refused from their header, before they fill the memory."""

MOST_MEMORY = 2**30
"""Bytes that decoding may take, of one picture and of all that are decoded at a time."""

_MOST_SCANS = 50
"""A progressive JPEG refines the whole picture in every scan; those of cameras have about ten."""

_BEGINNINGS = (
    (b"%!PS", "is PostScript (EPS), a program and no picture"),
    (b"\x04%!PS", "is PostScript (EPS), a program and no picture"),
    (b"\x1b%-12345X", "is a file for a printer, a program and no picture"),
    (b"\xc5\xd0\xd3\xc6", "is PostScript (EPS), a program and no picture"),
    (b"\xd7\xcd\xc6\x9a", "is a Windows metafile (WMF), a program and no picture"),
    (b"\x01\x00\x09\x00\x00\x03", "is a Windows metafile (WMF), a program and no picture"),
    (b"%PDF", "is a PDF document, no picture"),
    (b"<svg", "is an SVG drawing, which is not read"),
    (b"\x00\x00\x00\x0cjP  ", "is a JPEG 2000 picture, which is not read"),
    (b"\xff\x4f\xff\x51", "is a JPEG 2000 picture, which is not read"),
    (b"8BPS", "is a Photoshop file, which is not read"),
    (b"gimp xcf", "is a GIMP file, which is not read"),
    (b"\x00\x00\x01\x00", "is an icon (ICO), which is not read"),
    (b"icns", "is an icon (ICNS), which is not read"),
    (b"DDS ", "is a texture (DDS), which is not read"),
    (b"\x76\x2f\x31\x01", "is an OpenEXR picture, which is not read"),
    (b"AT&TFORM", "is a DjVu document, which is not read"),
    (b"SIMPLE  =", "is a FITS file, which is not read"),
)
"""How files begin that people take for pictures, and what they are."""

_HEIF = frozenset({b"avif", b"avis", b"heic", b"heix", b"hevc", b"heim", b"mif1", b"msf1"})


@contextmanager
def open_picture(source: Path | IO[bytes]) -> Iterator[Image.Image]:
    """Yield a picture that is open until the block ends; its pixels are not decoded yet.

    Parameters
    ----------
    source : Path or binary stream
        The file, or what can be read and sought in like one.

    Raises
    ------
    PictureError
        If it is no picture of a format that is read, damaged, or too large or too small. The text
        begins with a verb: whoever knows the file's name puts it before.

    Examples
    --------
    >>> import io
    >>> with open_picture(io.BytesIO(b"%!PS-Adobe-3.0 EPSF-3.0")) as image:
    ...     image.size  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    seewhy.errors.PictureError: is PostScript (EPS), a program and no picture: save it as PNG ...
    """
    with warnings.catch_warnings():
        # Pillow warns from 89 megapixels on, and of notes of a camera that it cannot read.
        warnings.filterwarnings("ignore", module=r"PIL\.")
        with _opened(source) as image:
            check_measures(image)
            if image.info.get("progressive"):
                _check_scans(image)
            yield image


def _opened(source: Path | IO[bytes]) -> Image.Image:
    try:
        return Image.open(source, formats=FORMATS)
    except Image.DecompressionBombError:
        raise PictureError(_too_large("far more")) from None
    except UnidentifiedImageError:
        raise PictureError(_unknown(_first_bytes(source))) from None
    except PermissionError:
        raise PictureError("may not be read: check the file's permissions") from None
    except Exception as problem:
        # A decoder raises whatever the damaged bytes lead it to: struct.error, IndexError, …
        raise PictureError(damaged(problem)) from None


def check_measures(image: Image.Image) -> None:
    """Raise a PictureError if a picture is too large or too small; its text begins with a verb."""
    width, height = image.size
    if width * height > LARGEST_MEGAPIXELS * 1_000_000:
        found = f"{-(-width * height // 1_000_000)} megapixels ({width}×{height}), more"
        raise PictureError(_too_large(found))
    if min(width, height) < SMALLEST_SIDE:
        raise PictureError(
            f"is {width}×{height} pixels, each side must be at least {SMALLEST_SIDE}: "
            "use the picture in its original size"
        )


@contextmanager
def memory_for(image: Image.Image, *, stored: int, reduced: int) -> Iterator[None]:
    """Wait until there is room to decode a picture, and keep it until the block ends.

    Threads that decode at the same time share :data:`MOST_MEMORY`.

    Parameters
    ----------
    image : PIL.Image.Image
        One that is not decoded yet, after what of its reduction the decoder does.
    stored : int
        Pixels that are in the file.
    reduced : int
        Pixels of what becomes of it in red, green and blue.

    Raises
    ------
    PictureError
        If it would take more than that alone; its text begins with a verb.
    """
    needed = _decoded_bytes(image, stored=stored) + 4 * reduced
    if needed > MOST_MEMORY:
        raise PictureError(
            f"has {-(-stored // 1_000_000)} megapixels, which take {needed / 2**30:.1f} GiB of "
            f"memory to decode as {image.format or image.mode}, more than the "
            f"{MOST_MEMORY // 2**30} GiB that a picture may take: scale it down first"
        )
    with _ROOM.taken(needed):
        yield


def _decoded_bytes(image: Image.Image, *, stored: int) -> int:
    width, height = image.size
    each = 1 if image.mode in ("1", "L", "P") else 2 if image.mode.startswith("I;16") else 4
    return each * width * height + _beside(image, stored)


def _beside(image: Image.Image, stored: int) -> int:
    """Bytes that the decoder takes beside the picture."""
    if image.format in ("JPEG", "MPO"):
        # One of several scans is kept as coefficients of two bytes until the last scan is read.
        return 2 * len(image.getbands()) * stored
    if image.format == "WEBP":
        return 8 * stored  # a canvas, and its bytes
    if isinstance(image, TiffImagePlugin.TiffImageFile):
        return _strip_bytes(image)
    return 0


def _strip_bytes(image: TiffImagePlugin.TiffImageFile) -> int:
    """Bytes of what a TIFF is packed in, strips or tiles, of which one is unpacked at a time."""
    tags = image.tag_v2
    bits = sum(_numbers(tags.get(TiffImagePlugin.BITSPERSAMPLE, 8)))
    across = max(_numbers(tags.get(TiffImagePlugin.TILEWIDTH, image.width)))
    down = _numbers(tags.get(TiffImagePlugin.TILELENGTH, 0))
    rows = _numbers(tags.get(TiffImagePlugin.ROWSPERSTRIP, image.height))
    return across * (max(down) or min(max(rows), image.height)) * bits // 8


def _numbers(value: object) -> tuple[int, ...]:
    values = value if isinstance(value, tuple) else (value,)
    return tuple(abs(number) if isinstance(number, int) else 0 for number in values) or (0,)


class _Room:
    """Bytes that threads share: one of them waits until the others leave enough."""

    def __init__(self, size: int) -> None:
        self._free = size
        self._changed = Condition()

    @contextmanager
    def taken(self, number: int) -> Iterator[None]:
        with self._changed:
            self._changed.wait_for(lambda: self._free >= number)
            self._free -= number
        try:
            yield
        finally:
            with self._changed:
                self._free += number
                self._changed.notify_all()


_ROOM = _Room(MOST_MEMORY)


def _check_scans(image: Image.Image) -> None:
    stream = getattr(image, "fp", None)
    if stream is None:
        return
    place = stream.tell()
    stream.seek(0)
    scans, last = 0, b""
    while scans <= _MOST_SCANS and (part := stream.read(2**20)):
        scans += (last + part).count(b"\xff\xda")
        last = part[-1:]
    stream.seek(place)
    if scans > _MOST_SCANS:
        raise PictureError(
            f"is a JPEG of more than {_MOST_SCANS} scans, as no camera writes it: save it again "
            "as PNG or JPEG"
        )


def _first_bytes(source: Path | IO[bytes]) -> bytes:
    try:
        if isinstance(source, Path):
            with source.open("rb") as stream:
                return stream.read(512)
        source.seek(0)
        return source.read(512)
    except OSError:
        return b""


def _unknown(start: bytes) -> str:
    """Say what a file is, by its first bytes, that is no picture of a format that is read."""
    if not start:
        return "is empty (0 bytes): copy the picture again from its source"
    return f"{_kind(start)}: save it as PNG or JPEG"


def _kind(start: bytes) -> str:
    if start[4:8] == b"ftyp" and start[8:12] in _HEIF:
        return "is a HEIC or AVIF picture, which is not read"
    if start[40:44] == b" EMF":
        return "is a Windows metafile (EMF), a program and no picture"
    if start[128:132] == b"DICM":
        return "is a DICOM file, which is not read"
    if start.lstrip().startswith(b"<?xml") and b"<svg" in start:
        return "is an SVG drawing, which is not read"
    return next(
        (what for beginning, what in _BEGINNINGS if start.startswith(beginning)),
        "is not a picture of a known type",
    )


def _too_large(found: str) -> str:
    return (
        f"has {found} than the {LARGEST_MEGAPIXELS} megapixels that are read: scale it down first"
    )


def damaged(problem: Exception) -> str:
    """Say that a decoder failed; the text begins with a verb."""
    return f"is damaged or cut short ({problem}): copy the picture again from its source"
