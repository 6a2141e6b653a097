"""Tables and trees as HTML for notebooks; names may come from a stranger, all text is escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

__all__ = ["html_line", "html_list", "html_table"]


def html_line(text: str) -> str:
    """Return text as a paragraph.

    Examples
    --------
    >>> html_line("a < b")
    '<p>a &lt; b</p>'
    """
    return f"<p>{escape(text)}</p>"


def html_list(texts: Iterable[str]) -> str:
    """Return texts as a numbered list.

    Examples
    --------
    >>> html_list(["pick up", "put down"])
    '<ol><li>pick up</li><li>put down</li></ol>'
    """
    return f"<ol>{''.join(f'<li>{escape(text)}</li>' for text in texts)}</ol>"


def html_table(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return rows of text as a table.

    Examples
    --------
    >>> html_table(["lean"], [["yes"]])
    '<table><thead><tr><th>lean</th></tr></thead><tbody><tr><td>yes</td></tr></tbody></table>'
    """
    head = "".join(f"<th>{escape(text)}</th>" for text in headings)
    body = "".join(
        f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows
    )
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
