"""Templates: texts with slots such as {it}, of which only those exist that are named."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping

__all__ = ["filled", "wrong_slot"]

_SLOT = re.compile(r"\{([a-z]+)\}")


def filled(template: str, values: Mapping[str, str]) -> str:
    """Return a template with its slots filled; what is filled in has no slots of its own.

    Nothing but the bare name of a slot means anything, so that a template can neither look into
    values nor make them longer.

    Examples
    --------
    >>> filled("{it} is {class}", {"it": "the {class}", "class": "good"})
    'the {class} is good'
    """
    return _SLOT.sub(lambda slot: values.get(slot.group(1), slot.group()), template)


def wrong_slot(template: str, known: Collection[str]) -> str | None:
    """Return the part of a template with a brace that is no slot, or None where all are.

    Examples
    --------
    >>> wrong_slot("{it} is {it.__class__}", ("it",))
    '{it.__class__}'
    >>> wrong_slot("{it} is so", ("it",)) is None
    True
    """
    rest = _SLOT.sub(lambda slot: "" if slot.group(1) in known else slot.group(), template)
    place = min((rest.index(brace) for brace in "{}" if brace in rest), default=None)
    if place is None:
        return None
    end = rest.find("}", place)
    return rest[place : place + 40 if end < 0 else min(end + 1, place + 40)]
