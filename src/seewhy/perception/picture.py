"""Any picture file becomes a square array of bytes, or one sentence that says why it cannot."""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Literal, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt
from PIL import Image

from seewhy.errors import PictureError
from seewhy.perception.decoding import decoded, upright
from seewhy.perception.picture_file import (
    SMALLEST_SIDE,
    check_measures,
    damaged,
    memory_for,
    open_picture,
)
from seewhy.perception.pixel_array import image_of_array

__all__ = [
    "Fit",
    "WholePicture",
    "as_picture",
    "picture_of_bytes",
    "read_picture",
    "reduced_picture",
    "whole_picture",
]

_KEPT_WHOLE = 16_000_000
"""Pixels; larger pictures are reduced to four times what is asked for, some rows at a time."""

Picture = npt.NDArray[np.uint8]

_Made = TypeVar("_Made")

Fit = Literal["pad", "stretch"]
"""How a picture that is not square becomes one."""


def read_picture(path: Path | str, *, size: int, fit: Fit = "pad") -> Picture:
    """Read a picture file as a square RGB array.

    The formats are those of :data:`~seewhy.perception.picture_file.FORMATS`. Greyscale (8 to 32 bit
    and floating point), palette, transparent (laid on white), CMYK and animated files (the first
    frame) are read; a rotation noted by the camera is applied. Greys of more than 8 bits say no
    range: white is the smallest of 255, 4095 and 65535 (of fractions, 1) that no pixel exceeds.
    What is no number (NaN) is black. Large pictures are reduced while they are decoded.

    A picture that is not square is padded to a square in the mean colour of its border, because
    stretching would change the very shapes that features such as "leans" or "wide" are about;
    ``fit="stretch"`` stretches it all the same, for pictures that are cut out close around one
    thing.

    Parameters
    ----------
    path : Path or str
        The file.
    size : int
        Side of the result, in pixels; at least 8.
    fit : {"pad", "stretch"}, default "pad"
        How a picture that is not square becomes one.

    Returns
    -------
    ndarray of uint8, shape (size, size, 3)
        Rows from the top, columns from the left, channels red, green, blue in 0..255.

    Raises
    ------
    PictureError
        The file is missing, a folder, empty, cut short, of no format that is read, smaller than 8
        pixels on a side, larger than 100 megapixels, or would take more than 1 GiB of memory. The
        text names the file and the remedy.

    Examples
    --------
    >>> import tempfile
    >>> from PIL import Image
    >>> path = Path(tempfile.mkdtemp()) / "red.png"
    >>> Image.new("RGB", (40, 20), "red").save(path)
    >>> read_picture(path, size=16).shape
    (16, 16, 3)
    """
    _check_size(size)
    file = Path(path)
    _check_file(file)
    return _opened_square(file, str(file), size=size, fit=fit)


def _check_file(file: Path) -> None:
    if file.is_dir():
        raise PictureError(f"{file} is a folder, not a picture: give the path of a picture file")
    try:
        empty = file.stat().st_size == 0
    except FileNotFoundError:
        raise PictureError(
            f"{file} does not exist: check the spelling of the path, upper and lower case included"
        ) from None
    except (OSError, ValueError) as error:
        raise PictureError(f"{file} cannot be read ({error}): check the path") from None
    if empty:
        raise PictureError(f"{file} is empty (0 bytes): copy the picture again from its source")


def picture_of_bytes(content: bytes, *, name: str, size: int, fit: Fit = "pad") -> Picture:
    """Make a square RGB array of what a picture file holds, as :func:`read_picture` does.

    Parameters
    ----------
    content : bytes
        The file.
    name : str
        What errors call it.
    size, fit
        See :func:`read_picture`.

    Raises
    ------
    PictureError
        As :func:`read_picture`.

    Examples
    --------
    >>> picture_of_bytes(b"no picture", name="a.png", size=16)
    Traceback (most recent call last):
    ...
    seewhy.errors.PictureError: a.png is not a picture of a known type: save it as PNG or JPEG
    """
    _check_size(size)
    if not content:
        raise PictureError(f"{name} is empty (0 bytes): send the picture itself")
    return _opened_square(io.BytesIO(content), name, size=size, fit=fit)


def _opened_square(source: Path | io.BytesIO, name: str, *, size: int, fit: Fit) -> Picture:
    try:
        with open_picture(source) as image:
            return _square(image, size=size, fit=fit)
    except PictureError as problem:
        raise PictureError(f"{name} {problem}") from None


def as_picture(
    image: Path | str | Image.Image | npt.NDArray[np.generic], *, size: int, fit: Fit = "pad"
) -> Picture:
    """Make a square RGB array of a path, an open Pillow image or an array.

    Parameters
    ----------
    image : Path, str, PIL.Image.Image or ndarray
        A path is read by :func:`read_picture`. An array has shape (height, width),
        (height, width, 1), (height, width, 3) or (height, width, 4: the last is opacity) and
        holds booleans, uint8, uint16 (white is 255, 4095 or 65535, as in a file) or floats in 0..1.
    size : int
        Side of the result, in pixels; at least 8.
    fit : {"pad", "stretch"}, default "pad"
        See :func:`read_picture`.

    Returns
    -------
    ndarray of uint8, shape (size, size, 3)

    Raises
    ------
    PictureError
        As :func:`read_picture`, or the array has another shape or range.

    Examples
    --------
    >>> as_picture(np.zeros((20, 10)), size=8).shape
    (8, 8, 3)
    """
    if isinstance(image, Path | str):
        return read_picture(image, size=size, fit=fit)
    _check_size(size)
    if isinstance(image, Image.Image):
        return _named_square(image, getattr(image, "filename", "") or "the image", size, fit)
    if isinstance(image, np.ndarray):
        return _named_square(image_of_array(image), "the array", size, fit)
    raise _no_picture(image)


def _no_picture(what: object) -> PictureError:
    return PictureError(
        "a picture must be a path, a Pillow image or a NumPy array, "
        f"got {type(what).__name__}: convert it first"
    )


def _named_square(image: Image.Image, name: str, size: int, fit: Fit) -> Picture:
    try:
        check_measures(image)
        return _square(image, size=size, fit=fit)
    except PictureError as problem:
        raise PictureError(f"{name} {problem}") from None


def reduced_picture(path: Path, *, longest: int) -> Image.Image:
    """Read a picture file as it is, upright and in red, green and blue, for somebody to look at.

    Parameters
    ----------
    path : Path
    longest : int
        Pixels of its longer side at most; a smaller picture stays as it is.

    Raises
    ------
    PictureError
        As :func:`read_picture`.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "red.png"
    >>> Image.new("RGB", (40, 20), "red").save(path)
    >>> reduced_picture(path, longest=16).size
    (16, 8)
    """
    _check_size(longest)
    try:
        with open_picture(path) as image:
            return _reduced(image, longest).image
    except PictureError as problem:
        raise PictureError(f"{path.name} {problem}") from None


class WholePicture(NamedTuple):
    """A picture as it is, and how many of its own pixels one of ``image`` stands for."""

    image: Image.Image
    scale: float


def whole_picture(
    picture: Path | str | Image.Image | npt.NDArray[np.generic], *, longest: int
) -> WholePicture:
    """Read a picture as it is, upright and in red, green and blue, of any shape.

    Parameters
    ----------
    picture
        As for :func:`as_picture`.
    longest : int
        Pixels of its longer side at most; a smaller picture stays as it is.

    Raises
    ------
    PictureError
        As :func:`as_picture`.

    Examples
    --------
    >>> whole = whole_picture(np.zeros((20, 40)), longest=16)
    >>> whole.image.size, whole.scale
    ((16, 8), 2.5)
    """
    _check_size(longest)
    if isinstance(picture, Path | str):
        file = Path(picture)
        _check_file(file)
        try:
            with open_picture(file) as image:
                return _reduced(image, longest)
        except PictureError as problem:
            raise PictureError(f"{file} {problem}") from None
    if isinstance(picture, Image.Image):
        image, name = picture, getattr(picture, "filename", "") or "the image"
    elif isinstance(picture, np.ndarray):
        image, name = image_of_array(picture), "the array"
    else:
        raise _no_picture(picture)
    try:
        check_measures(image)
        return _reduced(image, longest)
    except PictureError as problem:
        raise PictureError(f"{name} {problem}") from None


def _reduced(image: Image.Image, longest: int) -> WholePicture:
    measured = max(image.size)

    def within(found: Image.Image) -> Image.Image:
        if max(found.size) > longest:
            found = found.copy()  # the caller's image stays as it is
            found.thumbnail((longest, longest), Image.Resampling.BICUBIC)
        return found

    reduced = _decoded(image, longest, within)
    return WholePicture(reduced, measured / max(reduced.size))


def _square(image: Image.Image, *, size: int, fit: Fit) -> Picture:
    """Decode, upright, on white, scaled and padded or stretched; errors begin with a verb."""
    return _decoded(image, size, partial(_fitted, size=size, fit=fit))


def _decoded(image: Image.Image, size: int, finish: Callable[[Image.Image], _Made]) -> _Made:
    """What is made of a picture, upright and on white, of at least four times ``size``."""
    stored = image.width * image.height
    try:
        # A JPEG can be decoded at a fraction of its size; four times the need loses nothing.
        image.draft(None, (4 * size, 4 * size))
        factor = _reduction(image, size)
        with memory_for(image, stored=stored, reduced=image.width * image.height // factor**2):
            return finish(upright(image, decoded(image, factor)))
    except PictureError:
        raise
    except Image.DecompressionBombError:
        raise PictureError(
            "has far more pixels than its header says: scale it down first"
        ) from None
    except Exception as error:
        raise PictureError(damaged(error)) from None


def _reduction(image: Image.Image, size: int) -> int:
    """By which whole number the sides of a picture are divided before anything else is done."""
    if image.width * image.height <= _KEPT_WHOLE:
        return 1
    return max(1, min(max(image.size) // (4 * size), min(image.size) // SMALLEST_SIDE))


def _fitted(image: Image.Image, *, size: int, fit: Fit) -> Picture:
    scale = size / max(image.size)
    fitted = (max(1, round(image.width * scale)), max(1, round(image.height * scale)))
    if fit == "stretch":
        fitted = (size, size)
    # Pillow widens the filter with the reduction, so thin lines fade instead of breaking up.
    pixels = np.asarray(image.resize(fitted, Image.Resampling.BICUBIC))
    rows, columns = pixels.shape[:2]
    if rows == columns:
        return np.array(pixels, dtype=np.uint8)
    border = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    canvas = np.empty((size, size, 3), dtype=np.uint8)
    canvas[:] = np.rint(border.mean(axis=0)).astype(np.uint8)
    top, left = (size - rows) // 2, (size - columns) // 2
    canvas[top : top + rows, left : left + columns] = pixels
    return canvas


def _check_size(size: int) -> None:
    if size < SMALLEST_SIDE:
        raise PictureError(f"size must be at least {SMALLEST_SIDE} pixels, got {size}")
