"""Entries of the record in words: what was done."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from seewhy.studio.drawn_things import BOXES
from seewhy.studio.labels import LABEL, REASONS
from seewhy.studio.record import UNDO, Entry
from seewhy.studio.writing import FILES

__all__ = ["in_words"]

_NAMED = 4
"""Values and things that are named, the first ones."""


def in_words(entry: Entry) -> str:
    """What was done, in a few words.

    Examples
    --------
    >>> done = {"boxes": {"a.png": {"1": {"values": {"colour": "red"}}}}, "how": "typed"}
    >>> in_words(Entry(1, "", "Ada", BOXES, done))
    'typed: 1 colour red'
    >>> in_words(Entry(2, "", "Ada", UNDO, {}, takes_back=1))
    'took back 1'
    """
    body = entry.body
    if entry.kind == UNDO:
        return f"took back {entry.takes_back}"
    if entry.kind == BOXES:
        return _of_things(body)
    if entry.kind == LABEL:
        values = {
            f"{name} {value}" if value is not None else f"{name} open again"
            for said in body["values"].values()
            for name, value in said.items()
        }
        shown = ", ".join(sorted(values)[:_NAMED]) + (" and more" if len(values) > _NAMED else "")
        return f"{body['how']}: {shown}"
    if entry.kind == REASONS:
        named = {name for features in body["reasons"].values() for name in features}
        return f"because of {', '.join(sorted(named)) or 'nothing in particular'}"
    if entry.kind == FILES:
        named = {*body.get("files", ()), *(edit["file"] for edit in body.get("edits", ()))}
        return f"{', '.join(sorted(named))}: {body['why']}"
    return entry.kind


def _of_things(body: Mapping[str, Any]) -> str:
    """What was done to things."""
    said = []
    for changes in body.get("boxes", {}).values():
        for name, change in changes.items():
            values = (change or {}).get("values", {})
            told = [f"{key} {value or 'open again'}" for key, value in values.items()]
            said.append(" ".join((name, *told)))
    said += ["none there" if so else "open whether any" for so in body.get("none", {}).values()]
    words = {True: "", False: "not ", None: "nobody knows: "}
    for pairs in body.get("related", {}).values():
        said += [f"{words[so]}{thing} {relation} {other}" for relation, thing, other, so in pairs]
    more = " and more" if len(said) > _NAMED else ""
    return f"{body['how']}: {', '.join(said[:_NAMED])}{more}"
