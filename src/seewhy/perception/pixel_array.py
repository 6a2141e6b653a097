"""Arrays that are pictures, and those that are not."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from PIL import Image

from seewhy.errors import PictureError
from seewhy.perception.greys import usual_white


def image_of_array(values: npt.NDArray[np.generic]) -> Image.Image:
    """Return a Pillow image of an array of pixels.

    Raises
    ------
    PictureError
        If it has another shape, type or range than pictures have; the text begins with "an array".
    """
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
        white = usual_white(float(values.max()), fractions=False)
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
