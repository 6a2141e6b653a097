"""What is named without a verb has the verb of what was said before: "is Bob gone, and Sally?"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from seewhy.dialogue.grammar import Binding
from seewhy.dialogue.said import Said

__all__ = ["verbs_shared"]

_AWAY = frozenset({"gone", "taking"})


def verbs_shared(bindings: Sequence[Binding], said: Sequence[Said]) -> list[Said] | None:
    """Return what is said, where what only is named is away as well as what was away before.

    "Bob left but not Sally" leaves her there. None where it may mean one thing and another, as
    "no desk and chair" may: of a desk and a chair, or that there is a chair.

    Examples
    --------
    >>> from seewhy.dialogue.question import Questions
    >>> from seewhy.domain.domain import load_domain
    >>> understand = Questions(load_domain("robot_assistant")).understand
    >>> [str(statement) for statement in understand("is Bob gone but not Sally?").statements]
    ['bob=no', 'sally=yes']
    """
    opposed = any(binding.role == "but" for binding in bindings)
    if opposed and len(said) == 2 and _is_one_thing(said[0]) and said[0].denied:
        # "Not Bob but Sally left" leaves him there.
        return [replace(said[0], denied=not _is_away(said[1])), said[1]]
    if not said or not any(map(_is_one_thing, said[1:])):
        return list(said)
    first = said[0]
    away = _is_away(first)
    if not away and not first.denied:
        return list(said)
    shared = [first]
    for spoken in said[1:]:
        if not _is_one_thing(spoken):
            shared.append(spoken)
        elif away and (spoken.denied or not opposed):
            shared.append(replace(spoken, denied=not spoken.denied))
        elif not away and (spoken.denied or opposed) and not spoken.replaced:
            shared.append(spoken)
        else:
            return None
    return shared


def _is_away(spoken: Said) -> bool:
    """Whether it is said of something that it is away now, and was there."""
    return spoken.denied_by in _AWAY or (spoken.statement.value == "no" and not spoken.denied)


def _is_one_thing(spoken: Said) -> bool:
    """Whether it only names what is there or is not."""
    return (spoken.verbless or spoken.replaced) and spoken.statement.value == "yes"
