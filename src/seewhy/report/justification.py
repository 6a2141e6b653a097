"""Draw a justification as an outline: one row a step, what it rests on indented below it."""

from __future__ import annotations

from textwrap import wrap

from seewhy.knowledge.justification import Basis, Node
from seewhy.report.figure import CHARACTER, Figure, text_lines

_INDENT = 26
_DEEPEST = 14  # below it nothing is indented further, so that there is room for the words
_LINE = 15
_GAP = 9
_COLOURS = {
    Basis.FEATURE: ("#e8f1fb", "#2f6fb3"),
    Basis.AXIOM: ("#e9f6ec", "#2f8f4e"),
    Basis.DEFAULT: ("#eef6e3", "#6d8f2f"),
    Basis.EXCEPTION: ("#fdf0e3", "#b3742f"),
    Basis.CONFLICT: ("#fbe8e8", "#b33a3a"),
    Basis.TREE: ("#f3ecfa", "#7a4fb0"),
    Basis.PATH: ("#f3ecfa", "#7a4fb0"),
    Basis.RECURRENT: ("#f3ecfa", "#7a4fb0"),
    Basis.PICTURES: ("#e8f1fb", "#2f6fb3"),
    Basis.CLASS_SEEN: ("#e8f1fb", "#2f6fb3"),
}
_PLAIN = ("#f4f4f4", "#777777")
_FAILED = ("#fdf3f3", "#c05050")


def draw_justification(node: Node, *, width: int = 720) -> Figure:
    """Return the tree as a figure of ``width`` pixels.

    Examples
    --------
    >>> leaf = Node("lean(s)", "it leans", Basis.FEATURE, probability=0.98)
    >>> figure = draw_justification(Node("-stable(s)", "it falls", Basis.AXIOM, children=(leaf,)))
    >>> "it leans (p = 0.98)" in figure.svg
    True
    """
    parts: list[str] = []
    bottom = draw_rows(node, width=width, top=6.0, parts=parts)
    return Figure(width=width, height=int(bottom) + 4, content="".join(parts))


def draw_rows(node: Node, *, width: int, top: float, parts: list[str]) -> float:
    """Append the rows of a justification to ``parts``; return where they end."""
    return _draw(node, 0, top, width, parts)


def _draw(node: Node, depth: int, y: float, width: int, parts: list[str]) -> float:
    x = 8 + min(depth, _DEEPEST) * _INDENT
    room = int((width - x - 24) / CHARACTER)
    height = len(wrap(node.label(), room) or [""]) * _LINE + 9
    fill, stroke = _COLOURS.get(node.basis, _PLAIN)
    if not node.holds:
        fill, stroke = _FAILED
    parts.append(
        f"<rect x='{x}' y='{y:g}' width='{width - x - 8}' height='{height}' rx='5' "
        f"fill='{fill}' stroke='{stroke}' stroke-width='1'/>"
    )
    text, _ = text_lines(node.label(), x + 8, y + 16, width=room, fill="#222222")
    parts.append(text)
    below = y + height + _GAP
    for child in node.children:
        corner = below + 12
        parts.append(
            f"<path d='M{x + 10},{y + height} V{corner:g} "
            f"H{8 + min(depth + 1, _DEEPEST) * _INDENT}' fill='none' stroke='#aaaaaa'/>"
        )
        below = _draw(child, depth + 1, below, width, parts)
    return below
