"""A question about things as they are, put to a scene in which they are otherwise.

"The red cube" names a thing. Where it is supposed to be blue, a question about it stays a question
about that thing, and no other becomes the one that is meant by coming to look like it.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

from seewhy.dialogue.things.evaluating import Evaluation, UnclearReferenceError
from seewhy.dialogue.things.query import Description, Fixed, HasValue, Query, Reference, References

__all__ = ["fixed"]

_Part = TypeVar("_Part")


def fixed(query: Query, evaluation: Evaluation) -> Query:
    """Return a query in which what is named by its looks is the thing that is so now.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.dialogue.things.query import ValueOf
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> scene = thing_scene(things, [{"colour": "red"}, {"colour": "blue"}], relations={})
    >>> asked = ValueOf("shape", Reference(Description((HasValue("colour", "blue"),))))
    >>> fixed(asked, Evaluation(scene, things)).one.description.selection
    Fixed(number=1)
    """
    return _fixed(query, evaluation)


def _fixed(part: _Part, evaluation: Evaluation) -> _Part:
    if isinstance(part, Reference) and _is_name(part):
        try:
            return replace(part, description=Description((), Fixed(evaluation.the(part))))
        except UnclearReferenceError:
            return part
    if isinstance(part, tuple):
        return tuple(_fixed(inner, evaluation) for inner in part)  # type: ignore[return-value]
    if is_dataclass(part) and not isinstance(part, type):
        changed: dict[str, Any] = {}
        for field in fields(part):
            before = getattr(part, field.name)
            after = _fixed(before, evaluation)
            if after is not before and after != before:
                changed[field.name] = after
        return replace(part, **changed) if changed else part
    return part


def _is_name(one: Reference) -> bool:
    """Whether a reference names a thing by what it looks like alone."""
    described = one.description
    return (
        one.which is References.THE
        and described.selection is None
        and bool(described.conditions)
        and all(isinstance(condition, HasValue) for condition in described.conditions)
    )
