"""With which words the forms of a grammar begin, so that most need not be tried.

Source: the FIRST sets of parsing; Aho, Lam, Sethi and Ullman (2006), "Compilers", section 4.4.2.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from seewhy.dialogue.grammar import Form

__all__ = ["Beginning", "beginnings_of"]


class Beginning(NamedTuple):
    """The words with which something begins, and whether it may as well have no word."""

    words: frozenset[str]
    may_be_empty: bool = False


def beginnings_of(
    phrases: Mapping[str, Form], looked_up: Mapping[str, Beginning | None]
) -> dict[int, frozenset[str]]:
    """Return with which words forms begin, by their identity.

    Parameters
    ----------
    phrases : dict of str to Form
    looked_up : dict of str to Beginning
        What is looked up instead of being a phrase; None for what may begin with any word.

    Returns
    -------
    dict of int to frozenset of str
        Forms inside of the phrases. What may have no word, begin with any, or with itself, is not
        listed.

    Examples
    --------
    >>> from seewhy.dialogue.grammar import parse_form
    >>> form = parse_form("[not] <colour> one")
    >>> found = beginnings_of({"so": form}, {"colour": Beginning(frozenset({"red"}))})
    >>> sorted(found[id(form)]), sorted(found[id(form.parts[1])])
    (['not', 'red'], ['red'])
    """
    listed: dict[int, frozenset[str]] = {}
    by_name: dict[str, Beginning | None] = dict(looked_up)

    def of(form: Form) -> Beginning | None:
        begins = _of_kind(form)
        if begins is not None and not begins.may_be_empty:
            listed[id(form)] = begins.words
        return begins

    def _of_kind(form: Form) -> Beginning | None:
        if form.kind == "word":
            return Beginning(frozenset({form.text}))
        if form.kind == "phrase":
            return of_phrase(form.text)
        parts = [of(part) for part in form.parts]
        return _of_choice(parts) if form.kind == "choice" else _of_sequence(parts)

    def of_phrase(name: str) -> Beginning | None:
        if name not in by_name:
            by_name[name] = None  # as long as it is looked into
            by_name[name] = of(phrases[name])
        return by_name[name]

    for name in phrases:
        of_phrase(name)
    return listed


def _of_choice(parts: list[Beginning | None]) -> Beginning | None:
    known = [part for part in parts if part is not None]
    if len(known) < len(parts):
        return None
    words = frozenset[str]().union(*(part.words for part in known))
    return Beginning(words, any(part.may_be_empty for part in known))


def _of_sequence(parts: list[Beginning | None]) -> Beginning | None:
    words: frozenset[str] = frozenset()
    for part in parts:
        if part is None:
            return None
        words |= part.words
        if not part.may_be_empty:
            return Beginning(words)
    return Beginning(words, may_be_empty=True)
