"""Any picture file becomes a square array of bytes, or one sentence that says why it cannot."""

from __future__ import annotations

import io
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageOps

from seewhy.errors import PictureError
from seewhy.perception.picture_file import (
    SMALLEST_SIDE,
    check_measures,
    damaged,
    memory_for,
    open_picture,
)

__all__ = ["Fit", "as_picture", "picture_of_bytes", "pixels_digest", "read_picture"]

_KEPT_WHOLE = 16_000_000
"""Pixels; larger pictures are reduced to four times what is asked for, some rows at a time."""

_BAND = 1_000_000
"""Pixels that are converted at a time."""

_WHITES = (255.0, 4095.0, 65535.0)
"""What white may be where a file does not say it: the largest numbers of 8, 12 and 16 bits."""

_ORIENTATION = 0x0112

Picture = npt.NDArray[np.uint8]

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

    return _opened_square(file, str(file), size=size, fit=fit)


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
        return _named_square(_from_array(image), "the array", size, fit)
    raise PictureError(
        "a picture must be a path, a Pillow image or a NumPy array, "
        f"got {type(image).__name__}: convert it first"
    )


def pixels_digest(path: Path) -> str:
    """Return a name for what a picture shows: the same for every file that shows just the same.

    Formats, palettes and the camera's note on how it was held may differ, and what is transparent
    throughout has no colour.

    Raises
    ------
    PictureError
        As :func:`read_picture`.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> Image.new("RGB", (9, 9), "red").save(folder / "a.png")
    >>> Image.new("RGB", (9, 9), "red").save(folder / "a.bmp")
    >>> pixels_digest(folder / "a.png") == pixels_digest(folder / "a.bmp")
    True
    """
    try:
        with open_picture(path) as image:
            pixels = image.width * image.height
            with memory_for(image, stored=pixels, reduced=pixels):
                image.load()
                upright = _upright(image, image)
                digest = sha256(f"{upright.size}".encode())
                for band in _bands(upright):
                    digest.update(_plain(band))
                return digest.hexdigest()
    except PictureError as problem:
        raise PictureError(f"{path} {problem}") from None
    except Exception as error:
        raise PictureError(f"{path} {damaged(error)}") from None


def _plain(image: Image.Image) -> bytes:
    """The pixels in one of two ways: deep greys as they are, all else in 8 bits with opacity."""
    if image.mode.startswith(("I", "F")):
        return np.asarray(image).astype(np.float32).tobytes()
    whole = image if image.has_transparency_data else image.convert("RGB")
    pixels = np.array(whole.convert("RGBA"))
    pixels[pixels[..., 3] == 0] = 0
    return pixels.tobytes()


def _bands(image: Image.Image, *, factor: int = 1) -> Iterator[Image.Image]:
    """A picture from the top down, some rows at a time, their number divisible by ``factor``."""
    rows = max(1, _BAND // (image.width * factor)) * factor
    for top in range(0, image.height, rows):
        yield image.crop((0, top, image.width, min(image.height, top + rows)))


def _named_square(image: Image.Image, name: str, size: int, fit: Fit) -> Picture:
    try:
        check_measures(image)
        return _square(image, size=size, fit=fit)
    except PictureError as problem:
        raise PictureError(f"{name} {problem}") from None


def _square(image: Image.Image, *, size: int, fit: Fit) -> Picture:
    """Decode, upright, on white, scaled and padded or stretched; errors begin with a verb."""
    stored = image.width * image.height
    try:
        # A JPEG can be decoded at a fraction of its size; four times the need loses nothing.
        image.draft(None, (4 * size, 4 * size))
        factor = _reduction(image, size)
        with memory_for(image, stored=stored, reduced=image.width * image.height // factor**2):
            opaque = _upright(image, _decoded(image, factor))
            return _fitted(opaque, size=size, fit=fit)
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


def _decoded(image: Image.Image, factor: int) -> Image.Image:
    """The whole picture in red, green and blue, on white, its sides divided by a number."""
    deep_colour = image.mode not in ("I", "F") and any(";16" in str(tile) for tile in _tiles(image))
    image.load()
    white = _white_of(image) if image.mode.startswith(("I", "F")) else 0.0
    if deep_colour and not white:
        _check_depth(image)
    if image.mode == "RGB" and factor == 1 and not image.has_transparency_data:
        return image
    width, height = image.size
    canvas = Image.new("RGB", (-(-width // factor), -(-height // factor)))
    top = 0
    for band in _bands(image, factor=factor):
        coloured = _rgb(band, white)
        reduced = coloured.reduce(factor) if factor > 1 else coloured
        canvas.paste(reduced, (0, top))
        top += reduced.height
    return canvas


def _tiles(image: Image.Image) -> list[object]:
    """How the decoder is called; it says how many bits there are of which Pillow keeps eight."""
    return [getattr(tile, "args", None) for tile in getattr(image, "tile", ())]


def _check_depth(image: Image.Image) -> None:
    """Refuse colours of 16 bits of which so few are used that eight of them show nothing."""
    extrema = image.getextrema()
    bands = [extrema] if isinstance(extrema[0], int | float) else extrema
    colours = dict(zip(image.getbands(), bands, strict=True))
    colours.pop("A", None)
    peak = max(high for _, high in colours.values())
    if 0 < peak < 16:  # of 256: 12 bits in 16
        raise PictureError(
            "has colours of 16 bits and is nearly black, as pictures of 12 bits in 16 are: spread "
            "its values over the whole range, or save it with 8 bits a colour"
        )


def _upright(image: Image.Image, decoded: Image.Image) -> Image.Image:
    """What was decoded, turned as the camera noted."""
    orientation = image.getexif().get(_ORIENTATION, 1)
    if orientation == 1:
        return decoded
    if decoded is not image:
        decoded.getexif()[_ORIENTATION] = orientation
    return ImageOps.exif_transpose(decoded)


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


def _rgb(image: Image.Image, white: float) -> Image.Image:
    """The image in red, green and blue, what is transparent laid on white."""
    if white:
        return _from_greys(np.asarray(image), white).convert("RGB")
    if image.has_transparency_data:
        image = image.convert("RGBA")
        under = Image.new("RGBA", image.size, "white")
        return Image.alpha_composite(under, image).convert("RGB")
    return image.convert("RGB")


def _white_of(image: Image.Image) -> float:
    """What is white in a picture of greys of more than 8 bits."""
    if image.format == "PPM":
        return 65535.0  # says what is white, and Pillow scales by it
    peak = max(_peak(np.asarray(band)) for band in _bands(image))
    if not np.isfinite(peak):
        raise PictureError("has no pixel that is a number: save it as PNG or JPEG")
    return _white(peak, fractions=image.mode == "F")


def _peak(greys: npt.NDArray[np.generic]) -> float:
    finite = greys[np.isfinite(greys)]
    return float(finite.max()) if finite.size else -np.inf


def _white(peak: float, *, fractions: bool) -> float:
    """The white of greys that say no range: the first usual one that none of them exceeds."""
    whites = (1.0, *_WHITES) if fractions else _WHITES
    return next((white for white in whites if peak <= white), peak)


def _from_greys(greys: npt.NDArray[np.generic], white: float) -> Image.Image:
    """Greys of any range in 8 bits; Pillow's own conversion would clip them at 255."""
    shares = np.nan_to_num(greys.astype(np.float64), nan=0.0, posinf=white, neginf=0.0) / white
    return Image.fromarray(np.rint(np.clip(shares, 0.0, 1.0) * 255.0).astype(np.uint8))


def _from_array(values: npt.NDArray[np.generic]) -> Image.Image:
    """A Pillow image of an array of pixels."""
    if values.ndim == 3 and values.shape[2] == 1:
        values = values[:, :, 0]
    if not (values.ndim == 2 or (values.ndim == 3 and values.shape[2] in (3, 4))) or not (
        values.size
    ):
        raise PictureError(
            "an array is a picture when its shape is (height, width), (height, width, 3) or "
            f"(height, width, 4), got {values.shape}: reorder or convert it first"
        )
    if values.dtype == np.bool_:
        pixels = values.astype(np.uint8) * np.uint8(255)
    elif values.dtype == np.uint8:
        pixels = values.astype(np.uint8)
    elif values.dtype == np.uint16:
        white = _white(float(values.max()), fractions=False)
        pixels = np.rint(values.astype(np.float64) * (255.0 / white)).astype(np.uint8)
    elif np.issubdtype(values.dtype, np.floating):
        floats = values.astype(np.float64)
        if not (np.isfinite(floats).all() and floats.min() >= 0.0 and floats.max() <= 1.0):
            raise PictureError(
                "an array of floats is a picture when its values are in 0..1, "
                f"got {floats.min():g}..{floats.max():g}: divide by the largest possible value"
            )
        pixels = np.rint(floats * 255.0).astype(np.uint8)
    else:
        raise PictureError(
            "an array is a picture when it holds bool, uint8, uint16 or floats in 0..1, "
            f"got {values.dtype}: convert it with astype('uint8')"
        )
    return Image.fromarray(np.ascontiguousarray(pixels))


def _check_size(size: int) -> None:
    if size < SMALLEST_SIDE:
        raise PictureError(f"size must be at least {SMALLEST_SIDE} pixels, got {size}")
