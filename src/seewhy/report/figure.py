"""A figure in SVG: what drawing functions return, for notebooks, files and reports."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from pathlib import Path
from textwrap import wrap

from seewhy.errors import SeeWhyError
from seewhy.files.whole_files import write_whole

FONT = "font-family='Helvetica, Arial, sans-serif'"
CHARACTER = 6.4
"""Width of an average character at 12 px, with room to spare."""


@dataclass(frozen=True)
class Figure:
    """An SVG picture of ``width`` by ``height`` pixels; ``svg`` is its whole text.

    Examples
    --------
    >>> Figure(width=10, height=10, content="<circle r='5'/>").svg[:4]
    '<svg'
    """

    width: int
    height: int
    content: str

    @property
    def svg(self) -> str:
        """The figure as the text of an SVG file."""
        return (
            f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {self.width} {self.height}' "
            f"width='{self.width}' height='{self.height}' {FONT} font-size='12'>"
            f"{self.content}</svg>\n"
        )

    def save(self, path: Path | str) -> Path:
        """Write the figure to an .svg file and return its path.

        Raises
        ------
        SeeWhyError
            If the path does not end in .svg.
        """
        path = Path(path)
        if path.suffix.lower() != ".svg":
            raise SeeWhyError(f"{path}: figures are saved as .svg; choose a name that ends so")
        write_whole(path, self.svg)
        return path

    def _repr_svg_(self) -> str:
        return self.svg


def text_lines(text: str, x: float, y: float, *, width: int, **attributes: str) -> tuple[str, int]:
    """Return wrapped text as SVG and the number of its lines; ``width`` in characters."""
    lines = wrap(text, width) or [""]
    attribute_text = " ".join(
        f"{name.replace('_', '-')}='{value}'" for name, value in attributes.items()
    )
    spans = "".join(
        f"<tspan x='{x:g}' y='{y + number * 15:g}'>{escape(line)}</tspan>"
        for number, line in enumerate(lines)
    )
    return f"<text {attribute_text}>{spans}</text>", len(lines)
