"""Draw an answer as a card: the picture, what was seen, the answer, and its justification."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from seewhy.perception.picture import as_picture
from seewhy.reply import Reply
from seewhy.report.figure import CHARACTER, Figure, text_lines
from seewhy.report.justification import draw_rows

_SIDE = 200
_MARGIN = 16


def draw_card(
    reply: Reply, image: Path | str | Image.Image | np.ndarray[Any, Any], *, width: int = 760
) -> Figure:
    """Return the card as a figure of ``width`` pixels.

    Raises
    ------
    PictureError
        If the image is no picture.
    """
    x = _MARGIN + _SIDE + _MARGIN
    room = int((width - x - _MARGIN) / CHARACTER / 1.15)
    parts = [
        f"<rect width='{width}' height='100%' fill='#ffffff'/>",
        f"<image x='{_MARGIN}' y='{_MARGIN}' width='{_SIDE}' height='{_SIDE}' "
        f"href='data:image/png;base64,{embedded(image, size=2 * _SIDE)}'/>",
    ]
    y = _MARGIN + 16.0
    for text, attributes in (
        (f"{reply.question.text}?", {"font_weight": "bold", "font_size": "14"}),
        (reply.text, {"font_size": "14"}),
        (f"by {reply.method}", {"fill": "#666666"}),
    ):
        drawn, lines = text_lines(text, x, y, width=room, **attributes)
        parts.append(drawn)
        y += lines * 15 + 10
    for text in _seen(reply):
        drawn, lines = text_lines(text, x, y, width=room, fill="#2f6fb3")
        parts.append(drawn)
        y += lines * 15 + 2
    top = max(y, _MARGIN + _SIDE) + 8
    bottom = draw_rows(reply.justification, width=width, top=top, parts=parts)
    return Figure(width=width, height=int(bottom) + 6, content="".join(parts))


def _seen(reply: Reply) -> Iterator[str]:
    """A line for every feature, and for the class where a network saw it."""
    for name, own in reply.features.items():
        text = f"{name.replace('_', ' ')}: {own.value} (p = {own.probability:.2f})"
        if own.overruled is not None:
            text += f"; the network alone saw {own.overruled[0]} (p = {own.overruled[1]:.2f})"
        yield text
    if reply.classification.class_seen is not None:
        label, probability = reply.classification.class_seen
        yield f"class: {label} (p = {probability:.2f}), a witness to the features"


def embedded(image: Path | str | Image.Image | np.ndarray[Any, Any], *, size: int) -> str:
    """Return a picture as base64 of a PNG of ``size`` by ``size`` pixels, to stand in a page."""
    stream = io.BytesIO()
    Image.fromarray(as_picture(image, size=size)).save(stream, "PNG")
    return base64.b64encode(stream.getvalue()).decode("ascii")
