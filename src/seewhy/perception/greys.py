"""Greys of more than 8 bits: what is white among them, and what they are in 8 bits."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from PIL import Image

from seewhy.errors import PictureError
from seewhy.perception.picture_bands import bands_of

__all__ = ["of_eight_bits", "usual_white", "white_of"]

_WHITES = (255.0, 4095.0, 65535.0)
"""What white may be where a file does not say it: the largest numbers of 8, 12 and 16 bits."""


def white_of(image: Image.Image) -> float:
    """What is white in a picture of greys of more than 8 bits."""
    if image.format == "PPM":
        return 65535.0  # says what is white, and Pillow scales by it
    peak = max(_peak(np.asarray(band)) for band in bands_of(image))
    if not np.isfinite(peak):
        raise PictureError("has no pixel that is a number: save it as PNG or JPEG")
    return usual_white(peak, fractions=image.mode == "F")


def _peak(greys: npt.NDArray[np.generic]) -> float:
    finite = greys[np.isfinite(greys)]
    return float(finite.max()) if finite.size else -np.inf


def usual_white(peak: float, *, fractions: bool) -> float:
    """The white of greys that say no range: the first usual one that none of them exceeds."""
    whites = (1.0, *_WHITES) if fractions else _WHITES
    return next((white for white in whites if peak <= white), peak)


def of_eight_bits(greys: npt.NDArray[np.generic], white: float) -> Image.Image:
    """Greys of any range in 8 bits; Pillow's own conversion would clip them at 255."""
    with np.errstate(invalid="ignore"):  # signalling NaNs, which become 0 like all others
        wide = greys.astype(np.float64)
    shares = np.nan_to_num(wide, nan=0.0, posinf=white, neginf=0.0) / white
    return Image.fromarray(np.rint(np.clip(shares, 0.0, 1.0) * 255.0).astype(np.uint8))
