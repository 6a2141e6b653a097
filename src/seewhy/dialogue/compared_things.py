"""Comparisons of things in reasons, in the names that the things have."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from seewhy.knowledge.justification import Basis, Node

__all__ = ["with_things_named"]

_COMPARED = re.compile(r"(\w+) (!=|=) (\w+)")
_WORDS = {"!=": "is not", "=": "is"}


def with_things_named(node: Node, names: Mapping[str, str]) -> Node:
    """Return a reason in which compared things are called as ``names`` says: "cup is not box".

    Examples
    --------
    >>> node = Node("card1 != card2", "card1 != card2", Basis.COMPARISON)
    >>> with_things_named(node, {"card1": "the left card", "card2": "the right card"}).text
    'the left card is not the right card'
    """
    children = tuple(with_things_named(child, names) for child in node.children)
    compared = _COMPARED.fullmatch(node.text) if node.basis is Basis.COMPARISON else None
    if compared is None or not {compared[1], compared[3]} <= names.keys():
        return replace(node, children=children)
    text = f"{names[compared[1]]} {_WORDS[compared[2]]} {names[compared[3]]}"
    return replace(node, text=text, children=children)
