"""Draw an answer about things: the picture with their boxes, and what the answer rests on."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from seewhy.agent.things.thing_reply import PictureReply, ReadScene
from seewhy.knowledge.justification import Node
from seewhy.knowledge.things import things_of
from seewhy.perception.picture import whole_picture
from seewhy.report.boxed_picture import DOUBTFUL, PLAIN, SHOWN, DrawnBox, box_parts
from seewhy.report.card import png_of
from seewhy.report.figure import CHARACTER, Figure, text_lines
from seewhy.report.justification import draw_rows

__all__ = ["boxes_of_reply", "draw_thing_card", "rests_on", "spoken_of"]

_MARGIN = 16
_NAME = re.compile(r"\w+")


def rests_on(reply: PictureReply) -> frozenset[str]:
    """The things that the reasons of an answer speak of as what is so."""
    found = set()
    for node in reply.justification.walk():
        if node.literal in reply.read.names:
            found.add(node.literal)
        elif node.feature is not None and node.holds:
            found.update(things_of(node.feature)[1])
    return frozenset(found)


def spoken_of(node: Node, read: ReadScene) -> tuple[int, ...]:
    """The numbers of the things that a step of the reasons speaks of, counted from 0."""
    names = read.names
    said = dict.fromkeys(name for name in _NAME.findall(node.literal) if name in names)
    return tuple(names.index(name) for name in said)


def boxes_of_reply(reply: PictureReply) -> list[DrawnBox]:
    """The boxes of what was read, in another colour where the answer rests on it.

    Those of what may be a thing are in dashes. The group of the first thing's box is ``box-0``.
    """
    shown, read = rests_on(reply), reply.read
    boxes = [
        DrawnBox(thing.box, f"{thing.probability:.2f}?", DOUBTFUL, dashed=True)
        for thing in read.reading.doubtful
    ]
    for number, thing in enumerate(read.reading.things):
        name = read.words.name(number).removeprefix("the ")
        colour = SHOWN if read.names[number] in shown else PLAIN
        boxes.append(DrawnBox(thing.box, f"{number + 1}: {name}", colour, name=f"box-{number}"))
    return boxes


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
    parts += [
        box_parts(replace(drawn, name=""), scale=scale, offset=_MARGIN, width=measured[0] * scale)
        for drawn in boxes_of_reply(reply)
    ]
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
