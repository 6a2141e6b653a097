"""Nouns: the regular plural and its singular, and the article in front of one."""

from __future__ import annotations

import re

__all__ = ["plural", "singular", "with_article"]


def plural(noun: str) -> str:
    """Return the plural of a regular noun.

    Examples
    --------
    >>> plural("object"), plural("box"), plural("berry")
    ('objects', 'boxes', 'berries')
    """
    if noun.endswith(("s", "x", "ch", "sh")):
        return f"{noun}es"
    return f"{noun[:-1]}ies" if re.search("[^aeiou]y$", noun) else f"{noun}s"


def singular(noun: str) -> str:
    """Return the singular of a regular plural; any other word as it is.

    Examples
    --------
    >>> singular("objects"), singular("boxes"), singular("berries"), singular("glass")
    ('object', 'box', 'berry', 'glass')
    """
    for shorter in (f"{noun[:-3]}y", noun[:-2], noun[:-1]):
        if len(shorter) > 1 and plural(shorter) == noun and not shorter.endswith("s"):
            return shorter
    return noun


_SPOKEN_CONSONANT = re.compile(r"(one|once)(?![a-z])|eu|uni(?!n|m)|us[eu]|uti", re.IGNORECASE)
"""How words begin that are written with a vowel, and spoken with a consonant: "one", "unique"."""


def with_article(phrase: str) -> str:
    """Return a phrase in the singular with "a" or "an" before it.

    Examples
    --------
    >>> with_article("red block"), with_article("orange ball"), with_article("one-way street")
    ('a red block', 'an orange ball', 'a one-way street')
    """
    vowel = phrase[:1].lower() in "aeiou" and not _SPOKEN_CONSONANT.match(phrase)
    return f"{'an' if vowel else 'a'} {phrase}"
