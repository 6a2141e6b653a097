"""Draw boxes around the things in a picture."""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from seewhy.data.thing import BoundingBox
from seewhy.perception.picture import whole_picture
from seewhy.report.figure import Figure

__all__ = [
    "DOUBTFUL",
    "PLAIN",
    "SHOWN",
    "DrawnBox",
    "ShownPicture",
    "box_parts",
    "boxed_picture",
]

SHOWN, PLAIN, DOUBTFUL = "#d4351c", "#2f6fb3", "#888888"

_LETTER = 7  # pixels of a letter of a box's name, with room to spare


@dataclass(frozen=True)
class DrawnBox:
    """A box as it is drawn.

    Attributes
    ----------
    box : BoundingBox
        In pixels of the picture.
    text : str
        What stands at it.
    colour : str
    dashed : bool
    name : str
        The class of its group of elements, by which a page tells it from others.
    """

    box: BoundingBox
    text: str
    colour: str = PLAIN
    dashed: bool = False
    name: str = ""


def box_parts(
    drawn: DrawnBox, *, scale: float, offset: float = 0.0, width: float | None = None
) -> str:
    """Return a box as SVG, the picture's corner being at ``offset`` from the left and the top.

    ``width`` is that of the picture as it is drawn: a name that would be cut off there begins
    further left.

    Examples
    --------
    >>> box_parts(DrawnBox(BoundingBox(0, 0, 10, 20), "1"), scale=2.0).count("<rect")
    1
    """
    box = drawn.box
    left, top = offset + box.left * scale, offset + box.top * scale
    wide, high = (box.right - box.left) * scale, (box.bottom - box.top) * scale
    dashes = " stroke-dasharray='5 4'" if drawn.dashed else ""
    above = max(top - 4, offset + 10.0)
    begins = left
    if width is not None:
        begins = max(offset, min(left, offset + width - _LETTER * len(drawn.text)))
    parts = (
        f"<rect x='{left:.1f}' y='{top:.1f}' width='{wide:.1f}' height='{high:.1f}' fill='none' "
        f"stroke='{drawn.colour}' stroke-width='2'{dashes}/>"
        f"<text x='{begins:.1f}' y='{above:.1f}' fill='{drawn.colour}' stroke='#ffffff' "
        f"stroke-width='3' paint-order='stroke'>{escape(drawn.text)}</text>"
    )
    return f"<g class='{escape(drawn.name)}'>{parts}</g>" if drawn.name else parts


def boxed_picture(
    image: Path | str | Image.Image | np.ndarray[Any, Any],
    boxes: Sequence[DrawnBox],
    *,
    longest: int,
) -> Figure:
    """Return a picture with boxes as a figure whose longer side has ``longest`` pixels.

    Raises
    ------
    PictureError
        If the image is no picture.
    """
    return ShownPicture.of(image, longest=longest).with_boxes(boxes)


@dataclass(frozen=True)
class ShownPicture:
    """A picture that stands once in a page and is shown as often as one likes.

    Attributes
    ----------
    image : str
        The SVG that shows it.
    width, height : float
        As it is shown.
    scale : float
        From the picture's pixels to those of the page.
    """

    image: str
    width: float
    height: float
    scale: float

    @classmethod
    def of(
        cls, image: Path | str | Image.Image | np.ndarray[Any, Any], *, longest: int
    ) -> ShownPicture:
        """Read a picture, its longer side to be shown with ``longest`` pixels.

        Raises
        ------
        PictureError
            If the image is no picture.
        """
        whole = whole_picture(image, longest=2 * longest)
        measured = (whole.image.width * whole.scale, whole.image.height * whole.scale)
        scale = longest / max(measured)
        wide, high = measured[0] * scale, measured[1] * scale
        shown = f"<image width='{wide:g}' height='{high:g}' href='{_jpeg(whole.image)}'/>"
        return cls(shown, wide, high, scale)

    @property
    def standing(self) -> str:
        """The SVG by which the picture stands in a page, unseen."""
        return (
            "<svg width='0' height='0' style='position: absolute' aria-hidden='true'>"
            f"<defs><g id='picture'>{self.image}</g></defs></svg>"
        )

    def with_boxes(self, boxes: Sequence[DrawnBox], *, stands: bool = False) -> Figure:
        """Return the picture with boxes; ``stands`` where :attr:`standing` is in the same page."""
        image = "<use href='#picture'/>" if stands else self.image
        drawn = (box_parts(box, scale=self.scale, width=self.width) for box in boxes)
        content = "".join((image, *drawn))
        return Figure(width=round(self.width), height=round(self.height), content=content)


def _jpeg(picture: Image.Image) -> str:
    """Return a picture as the address of data that stand in a page, small enough for many."""
    stream = io.BytesIO()
    picture.convert("RGB").save(stream, "JPEG", quality=88)
    return f"data:image/jpeg;base64,{base64.b64encode(stream.getvalue()).decode('ascii')}"
