"""Adjectives compared: the comparative and the superlative of a regular one."""

from __future__ import annotations

import re

__all__ = ["comparative", "superlative"]

_DOUBLED = re.compile(r"^[^aeiou]*[aeiou][bdgklmnprt]$")
_VOWELS = re.compile(r"[aeiouy]+")


def comparative(adjective: str) -> str:
    """Return the comparative of a regular adjective.

    Examples
    --------
    >>> [comparative(word) for word in ("big", "large", "heavy", "small", "expensive")]
    ['bigger', 'larger', 'heavier', 'smaller', 'more expensive']
    """
    return _compared(adjective, "er", "more")


def superlative(adjective: str) -> str:
    """Return the superlative of a regular adjective.

    Examples
    --------
    >>> [superlative(word) for word in ("big", "large", "tiny", "dark", "expensive")]
    ['biggest', 'largest', 'tiniest', 'darkest', 'most expensive']
    """
    return _compared(adjective, "est", "most")


def _compared(adjective: str, ending: str, word: str) -> str:
    syllables = len(_VOWELS.findall(adjective.removesuffix("e")))
    if syllables > 1 and not adjective.endswith("y"):
        return f"{word} {adjective}"
    if adjective.endswith("e"):
        return f"{adjective}{ending[1:]}"
    if re.search("[^aeiou]y$", adjective):
        return f"{adjective[:-1]}i{ending}"
    if _DOUBLED.match(adjective):
        return f"{adjective}{adjective[-1]}{ending}"
    return f"{adjective}{ending}"
