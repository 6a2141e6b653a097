"""Any picture file becomes a square array of bytes, or one sentence that says why it cannot."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageOps, UnidentifiedImageError

from seewhy.errors import PictureError

__all__ = ["LARGEST_MEGAPIXELS", "SMALLEST_SIDE", "Fit", "as_picture", "read_picture"]

SMALLEST_SIDE = 8
"""Pictures with a side shorter than this (in pixels) show nothing that a network could see."""

LARGEST_MEGAPIXELS = 100
"""Pictures larger than this are refused from their header, before they fill the memory."""

Picture = npt.NDArray[np.uint8]

Fit = Literal["pad", "stretch"]
"""How a picture that is not square becomes one."""


def read_picture(path: Path | str, *, size: int, fit: Fit = "pad") -> Picture:
    """Read a picture file as a square RGB array.

    Greyscale (8 and 16 bit), palette, transparent (laid on white), CMYK and animated files (the
    first frame) are read; a rotation noted by the camera is applied. A picture that is not
    square is padded to a square in the mean colour of its border, because stretching would
    change the very shapes that features such as "leans" or "wide" are about; ``fit="stretch"``
    stretches it all the same, for pictures that are cut out close around one thing.

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
        The file is missing, a folder, empty, cut short, of no known type, smaller than 8 pixels
        on a side or larger than 100 megapixels. The text names the file and the remedy.

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

    with warnings.catch_warnings():
        # Pillow warns from 89 megapixels on; the limit that counts here is our own, below.
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        try:
            image = Image.open(file)
        except Image.DecompressionBombError:
            raise PictureError(_too_large(str(file), "far more")) from None
        except UnidentifiedImageError:
            raise PictureError(
                f"{file} is not a picture of a known type: save it as PNG or JPEG"
            ) from None
        except PermissionError:
            raise PictureError(f"{file} may not be read: check the file's permissions") from None
        except Exception as error:
            # A decoder raises whatever the damaged bytes lead it to: struct.error, IndexError, …
            raise PictureError(_damaged(str(file), error)) from None
        with image:
            return _square(image, size=size, fit=fit, name=str(file))


def as_picture(
    image: Path | str | Image.Image | npt.NDArray[np.generic], *, size: int, fit: Fit = "pad"
) -> Picture:
    """Make a square RGB array of a path, an open Pillow image or an array.

    Parameters
    ----------
    image : Path, str, PIL.Image.Image or ndarray
        A path is read by :func:`read_picture`. An array has shape (height, width),
        (height, width, 1), (height, width, 3) or (height, width, 4: the last is opacity) and
        holds booleans, uint8 in 0..255, uint16 in 0..65535 or floats in 0..1.
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
        name = getattr(image, "filename", "") or "the image"
        return _square(image, size=size, fit=fit, name=name)
    if isinstance(image, np.ndarray):
        return _square(_from_array(image), size=size, fit=fit, name="the array")
    raise PictureError(
        "a picture must be a path, a Pillow image or a NumPy array, "
        f"got {type(image).__name__}: convert it first"
    )


def _square(image: Image.Image, *, size: int, fit: Fit, name: str) -> Picture:
    """Decode, upright, on white, scaled and padded or stretched."""
    width, height = image.size
    if width * height > LARGEST_MEGAPIXELS * 1_000_000:
        found = f"{-(-width * height // 1_000_000)} megapixels ({width}×{height}), more"
        raise PictureError(_too_large(name, found))
    if min(width, height) < SMALLEST_SIDE:
        raise PictureError(
            f"{name} is {width}×{height} pixels, each side must be at least {SMALLEST_SIDE}: "
            "use the picture in its original size"
        )
    try:
        # A JPEG can be decoded at a fraction of its size; four times the need loses nothing.
        image.draft(None, (4 * size, 4 * size))
        image.load()
        upright = ImageOps.exif_transpose(image)
        opaque = _rgb(upright)
    except Image.DecompressionBombError:
        raise PictureError(_too_large(name, "far more")) from None
    except Exception as error:
        raise PictureError(_damaged(name, error)) from None

    scale = size / max(opaque.size)
    fitted = (max(1, round(opaque.width * scale)), max(1, round(opaque.height * scale)))
    if fit == "stretch":
        fitted = (size, size)
    # Pillow widens the filter with the reduction, so thin lines fade instead of breaking up.
    pixels = np.asarray(opaque.resize(fitted, Image.Resampling.BICUBIC))
    rows, columns = pixels.shape[:2]
    if rows == columns:
        return np.array(pixels, dtype=np.uint8)
    border = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    canvas = np.empty((size, size, 3), dtype=np.uint8)
    canvas[:] = np.rint(border.mean(axis=0)).astype(np.uint8)
    top, left = (size - rows) // 2, (size - columns) // 2
    canvas[top : top + rows, left : left + columns] = pixels
    return canvas


def _rgb(image: Image.Image) -> Image.Image:
    """The image in red, green and blue, what is transparent laid on white."""
    if image.mode.startswith(("I", "F")):
        return _from_array(_unit_range(np.asarray(image), mode=image.mode)).convert("RGB")
    if image.has_transparency_data:
        image = image.convert("RGBA")
        white = Image.new("RGBA", image.size, "white")
        return Image.alpha_composite(white, image).convert("RGB")
    return image.convert("RGB")


def _unit_range(values: npt.NDArray[np.generic], *, mode: str) -> npt.NDArray[np.float64]:
    """Greys of 16 bit and more as 0..1; Pillow's own conversion would clip them at 255."""
    grey = np.nan_to_num(values.astype(np.float64), nan=0.0, posinf=0.0, neginf=0.0)
    peak = float(grey.max())
    if mode.startswith("I"):
        full = max(65535.0, peak)
    else:  # floating point files state no range: 0..1, bytes, 16 bit and beyond all occur
        full = next((limit for limit in (1.0, 255.0, 65535.0) if peak <= limit), peak)
    return np.clip(grey / full, 0.0, 1.0)


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
        pixels = np.rint(values.astype(np.float64) / 257.0).astype(np.uint8)
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


def _too_large(name: str, found: str) -> str:
    return (
        f"{name} has {found} than the {LARGEST_MEGAPIXELS} megapixels that are read: "
        "scale it down first"
    )


def _damaged(name: str, error: Exception) -> str:
    return f"{name} is damaged or cut short ({error}): copy the picture again from its source"
