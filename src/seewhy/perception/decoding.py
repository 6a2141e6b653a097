"""What a picture file holds, decoded to red, green and blue on white, and turned upright."""

from __future__ import annotations

import numpy as np
from PIL import Image, ImageOps

from seewhy.errors import PictureError
from seewhy.perception.greys import of_eight_bits, white_of
from seewhy.perception.picture_bands import bands_of

__all__ = ["decoded", "upright"]

_ORIENTATION = 0x0112


def decoded(image: Image.Image, factor: int) -> Image.Image:
    """The whole picture in red, green and blue, on white, its sides divided by a number."""
    deep_colour = image.mode not in ("I", "F") and any(";16" in str(tile) for tile in _tiles(image))
    image.load()
    white = white_of(image) if image.mode.startswith(("I", "F")) else 0.0
    if deep_colour and not white:
        _check_depth(image)
    if image.mode == "RGB" and factor == 1 and not image.has_transparency_data:
        return image
    width, height = image.size
    canvas = Image.new("RGB", (-(-width // factor), -(-height // factor)))
    top = 0
    for band in bands_of(image, factor=factor):
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


def upright(image: Image.Image, whole: Image.Image) -> Image.Image:
    """What was decoded, turned as the camera noted."""
    orientation = image.getexif().get(_ORIENTATION, 1)
    if orientation == 1:
        return whole
    if whole is not image:
        whole.getexif()[_ORIENTATION] = orientation
    return ImageOps.exif_transpose(whole)


def _rgb(image: Image.Image, white: float) -> Image.Image:
    """The image in red, green and blue, what is transparent laid on white."""
    if white:
        return of_eight_bits(np.asarray(image), white).convert("RGB")
    if image.has_transparency_data:
        image = image.convert("RGBA")
        under = Image.new("RGBA", image.size, "white")
        return Image.alpha_composite(under, image).convert("RGB")
    return image.convert("RGB")
