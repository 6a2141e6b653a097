"""A name for what a picture shows, whatever file it is in."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

import numpy as np
from PIL import Image

from seewhy.errors import PictureError
from seewhy.perception.decoding import upright
from seewhy.perception.picture_bands import bands_of
from seewhy.perception.picture_file import damaged, memory_for, open_picture

__all__ = ["pixels_digest"]


def pixels_digest(path: Path) -> str:
    """Return a name for what a picture shows: the same for every file that shows just the same.

    Formats, palettes and the camera's note on how it was held may differ, and what is transparent
    throughout has no colour.

    Raises
    ------
    PictureError
        As :func:`~seewhy.perception.picture.read_picture`.

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
                turned = upright(image, image)
                digest = sha256(f"{turned.size}".encode())
                for band in bands_of(turned):
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
