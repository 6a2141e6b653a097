"""Draw an answer about things: the picture with their boxes, and what the answer rests on."""

from __future__ import annotations

from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from seewhy.agent.things.thing_reply import PictureReply
from seewhy.data.thing import BoundingBox
from seewhy.knowledge.things import things_of
from seewhy.perception.picture import whole_picture
from seewhy.report.card import png_of
from seewhy.report.figure import CHARACTER, Figure, text_lines
from seewhy.report.justification import draw_rows

__all__ = ["draw_thing_card", "rests_on"]

_MARGIN = 16
_SHOWN, _PLAIN, _DOUBTFUL = "#d4351c", "#2f6fb3", "#888888"


def rests_on(reply: PictureReply) -> frozenset[str]:
    """The things that the reasons of an answer speak of as what is so."""
    found = set()
    for node in reply.justification.walk():
        if node.literal in reply.read.names:
            found.add(node.literal)
        elif node.feature is not None and node.holds:
            found.update(things_of(node.feature)[1])
    return frozenset(found)


def draw_thing_card(
    reply: PictureReply,
    image: Path | str | Image.Image | np.ndarray[Any, Any],
    *,
    width: int = 760,
) -> Figure:
    """Return the card as a figure of ``width`` pixels.

    Boxes of what the answer rests on are drawn in another colour, those of what may be a thing in
    dashes.

    Parameters
    ----------
    reply : PictureReply
    image : path, Pillow image or array
        What the reply is about.
    width : int, default 760

    Raises
    ------
    PictureError
        If the image is no picture.
    """
    room = width - 2 * _MARGIN
    whole = whole_picture(image, longest=2 * room)
    measured = (whole.image.width * whole.scale, whole.image.height * whole.scale)
    scale = min(room / measured[0], room / measured[1])
    high = measured[1] * scale
    parts = [
        f"<rect width='{width}' height='100%' fill='#ffffff'/>",
        f"<image x='{_MARGIN}' y='{_MARGIN}' width='{measured[0] * scale:g}' height='{high:g}' "
        f"href='data:image/png;base64,{png_of(whole.image)}'/>",
    ]
    shown, reading = rests_on(reply), reply.read.reading
    for thing in reading.doubtful:
        parts += _box(thing.box, scale, f"{thing.probability:.2f}?", _DOUBTFUL, dashed=True)
    for number, thing in enumerate(reading.things):
        term = reply.read.names[number]
        name = reply.read.words.name(number).removeprefix("the ")
        colour = _SHOWN if term in shown else _PLAIN
        parts += _box(thing.box, scale, f"{number + 1}: {name}", colour, dashed=False)
    y = high + 2 * _MARGIN + 12
    characters = int(room / CHARACTER / 1.15)
    for text, attributes in (
        (reply.reply.question, {"font_weight": "bold", "font_size": "14"}),
        (reply.text, {"font_size": "14"}),
        (reply.say_least_sure(), {"fill": "#666666"}),
    ):
        if text:
            drawn, lines = text_lines(text, _MARGIN, y, width=characters, **attributes)
            parts.append(drawn)
            y += lines * 15 + 8
    bottom = draw_rows(reply.justification, width=width, top=y, parts=parts)
    return Figure(width=width, height=int(bottom) + 6, content="".join(parts))


def _box(box: BoundingBox, scale: float, text: str, colour: str, *, dashed: bool) -> list[str]:
    left, top = _MARGIN + box.left * scale, _MARGIN + box.top * scale
    wide, high = (box.right - box.left) * scale, (box.bottom - box.top) * scale
    dashes = " stroke-dasharray='5 4'" if dashed else ""
    above = max(top - 4, _MARGIN + 10.0)
    return [
        f"<rect x='{left:.1f}' y='{top:.1f}' width='{wide:.1f}' height='{high:.1f}' fill='none' "
        f"stroke='{colour}' stroke-width='2'{dashes}/>",
        f"<text x='{left:.1f}' y='{above:.1f}' fill='{colour}' stroke='#ffffff' stroke-width='3' "
        f"paint-order='stroke'>{escape(text)}</text>",
    ]
