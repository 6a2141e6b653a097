"""Small pictures of pages: wide and light, narrow and dark."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from PIL import Image

if TYPE_CHECKING:
    from playwright.sync_api import Page

__all__ = ["MOST_BYTES", "Camera", "small_png"]

MOST_BYTES = 60_000
WIDE, NARROW, HEIGHT = 1280, 390, 800
_SHOWN_WIDE = 960
_COLOURS = (128, 64, 32, 16, 8)


class Camera:
    """Takes pictures of what a page shows.

    Parameters
    ----------
    page : playwright.sync_api.Page
    folder : Path
    """

    def __init__(self, page: Page, folder: Path) -> None:
        self.page = page
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    def __call__(self, name: str) -> None:
        """Write ``NAME.png`` and ``NAME_narrow.png``, and leave the page as it was."""
        page = self.page
        page.wait_for_timeout(500)
        (self.folder / f"{name}.png").write_bytes(small_png(page.screenshot(), width=_SHOWN_WIDE))
        page.set_viewport_size({"width": NARROW, "height": HEIGHT})
        page.emulate_media(color_scheme="dark")
        page.wait_for_timeout(300)
        narrow = self.folder / f"{name}_narrow.png"
        narrow.write_bytes(small_png(page.screenshot(), width=NARROW))
        page.emulate_media(color_scheme="light")
        page.set_viewport_size({"width": WIDE, "height": HEIGHT})


def small_png(content: bytes, *, width: int) -> bytes:
    """Return a picture made narrower, with so many colours that it takes :data:`MOST_BYTES`.

    Examples
    --------
    >>> from io import BytesIO
    >>> drawn = BytesIO()
    >>> Image.effect_noise((600, 400), 90).save(drawn, "PNG")
    >>> len(drawn.getvalue()) > MOST_BYTES >= len(small_png(drawn.getvalue(), width=300))
    True
    """
    with Image.open(BytesIO(content), formats=["PNG"]) as opened:
        image = opened.convert("RGB")
    image.thumbnail((width, image.height), Image.Resampling.LANCZOS)
    small = b""
    for colours in _COLOURS:
        written = BytesIO()
        reduced = image.quantize(colours, dither=Image.Dither.NONE)
        reduced.save(written, "PNG", optimize=True)
        small = written.getvalue()
        if len(small) <= MOST_BYTES:
            break
    return small
