"""Names of strangers in sentences: on one line, short, and without what steers a terminal."""

from __future__ import annotations

__all__ = ["visible"]


def visible(text: object, *, most: int = 80) -> str:
    r"""Return a text whose characters can all be seen, cut short where it is long.

    Examples
    --------
    >>> visible("a\nb\x1b[2J"), visible("abcdef", most=3)
    ('a\\nb\\x1b[2J', 'abc…')
    """
    said = "".join(
        character if character.isprintable() else repr(character)[1:-1]
        for character in str(text)[: most + 1]
    )
    return said if len(said) <= most else f"{said[:most]}…"
