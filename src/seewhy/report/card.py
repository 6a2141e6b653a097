"""Draw an answer as a card: the picture, what was seen, the answer, and its justification."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from seewhy.dialogue.certainty import says_nothing_seen
from seewhy.dialogue.reply import Reply
from seewhy.domain.tables import CLASS
from seewhy.perception.picture import Fit, as_picture
from seewhy.perception.where import Where
from seewhy.report.figure import CHARACTER, Figure, text_lines
from seewhy.report.justification import draw_rows

_SIDE = 200
_MARGIN = 16
_PANEL = 132  # side of the picture of where a feature was seen


def draw_card(
    reply: Reply,
    image: Path | str | Image.Image | np.ndarray[Any, Any],
    *,
    where: Mapping[str, Where] | None = None,
    fit: Fit = "pad",
    width: int = 760,
    reasons: bool = True,
) -> Figure:
    """Return the card as a figure of ``width`` pixels.

    Parameters
    ----------
    reply : Reply
    image : path, Pillow image or array
        What the reply is about.
    where : mapping of str to Where, optional
        Where features were seen (see :meth:`seewhy.Agent.where`), to be shown of those that the
        answer rests on.
    fit : {"pad", "stretch"}, default "pad"
        How a picture that is not square became one when it was seen.
    width : int, default 760
    reasons : bool, default True
        Whether the justification stands in it, and not elsewhere.

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
    shown = [of_feature for name, of_feature in (where or {}).items() if name in rests_on(reply)]
    if shown:
        top = _draw_where(shown, image, fit=fit, width=width, top=top, parts=parts)
    bottom = draw_rows(reply.justification, width=width, top=top, parts=parts) if reasons else top
    return Figure(width=width, height=int(bottom) + 6, content="".join(parts))


def _seen(reply: Reply) -> Iterator[str]:
    """A line for every feature, and for the class where a network saw it."""
    for name, reading in reply.features.items():
        text = f"{name.replace('_', ' ')}: {reading.value} (p = {reading.probability:.2f})"
        if reading.overruled is not None:
            text += (
                f"; the network alone saw {reading.overruled[0]} (p = {reading.overruled[1]:.2f})"
            )
        yield text
    if reply.classification.class_seen is not None:
        label, probability = reply.classification.class_seen
        yield f"class: {label} (p = {probability:.2f}), a witness to the features"


def rests_on(reply: Reply) -> frozenset[str]:
    """The features that an answer names, would change or is justified by, and the class it says.

    Of the class only where something saw it by itself.
    """
    kind = reply.kind
    names = {*kind.mentions, *(feature for change in kind.changes for feature, _ in change)}
    names.update(reply.justification.features())
    about_class = reply.question.feature is None and not says_nothing_seen(kind)
    if about_class and reply.classification.class_seen is not None:
        names.add(CLASS)
    return frozenset(names)


def _draw_where(
    shown: Sequence[Where],
    image: Path | str | Image.Image | np.ndarray[Any, Any],
    *,
    fit: Fit,
    width: int,
    top: float,
    parts: list[str],
) -> float:
    """Append a small picture for each of ``shown`` to ``parts``; return where they end."""
    columns = max(1, (width - _MARGIN) // (_PANEL + _MARGIN))
    room = int(_PANEL / CHARACTER * 1.1)
    y = top
    for start in range(0, len(shown), columns):
        lowest = y
        for column, of_feature in enumerate(shown[start : start + columns]):
            x = _MARGIN + column * (_PANEL + _MARGIN)
            drawn = of_feature.picture(image, side=2 * _PANEL, fit=fit)
            parts.append(
                f"<image x='{x}' y='{y:g}' width='{_PANEL}' height='{_PANEL}' "
                f"href='data:image/png;base64,{png_of(drawn)}'/>"
            )
            below = y + _PANEL + 15
            title = f"{of_feature.feature}: {of_feature.value}".replace("_", " ")
            said = of_feature.to_text().replace("p = ", "p\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}")
            for text, colour in ((title, "#2f6fb3"), (said, "#666666")):
                written, lines = text_lines(text, x, below, width=room, fill=colour)
                parts.append(written)
                below += 15 * lines
            lowest = max(lowest, below)
        y = lowest
    return y + 4


def embedded(image: Path | str | Image.Image | np.ndarray[Any, Any], *, size: int) -> str:
    """Return a picture as base64 of a PNG of ``size`` by ``size`` pixels, to stand in a page."""
    return png_of(Image.fromarray(as_picture(image, size=size)))


def png_of(picture: Image.Image) -> str:
    """Return a picture as base64 of a PNG, to stand in a figure."""
    stream = io.BytesIO()
    picture.save(stream, "PNG")
    return base64.b64encode(stream.getvalue()).decode("ascii")
