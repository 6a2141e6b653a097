"""Which of several robots a question addresses: "second robot, why did you move?"."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from seewhy.dialogue.question_words import words_of
from seewhy.planning.domain import PlanningDomain

__all__ = ["addressed", "as_asked"]

_BEFORE = re.compile(r"\s*(?:(?:hey|hello|hi|dear)\s+)?([^,:?]+)[,:]\s*(.+)", re.DOTALL)
_AFTER = re.compile(r"(.+),\s*([^,?]+)\?*\s*", re.DOTALL)


def addressed(domain: PlanningDomain, question: str) -> tuple[str | None, str]:
    """Return the robot that a question names first or last, if it does, and the question itself.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> addressed(load_planning_domain("robot_assistant"), "Robot, where are you?")
    ('rob1', 'where are you?')
    """
    names = dict(_names(domain))
    before, after = _BEFORE.fullmatch(question), _AFTER.fullmatch(question)
    if before and _key(before.group(1)) in names:
        return names[_key(before.group(1))], before.group(2)
    if after and _key(after.group(2)) in names:
        return names[_key(after.group(2))], after.group(1)
    return None, question


def as_asked(domain: PlanningDomain, robot: str) -> PlanningDomain:
    """Return the domain with another robot as the one that is asked: who says "I"."""
    return replace(domain, robot=robot, words=replace(domain.words, robot=robot))


def _names(domain: PlanningDomain) -> Iterator[tuple[str, str]]:
    signature = domain.knowledge.signature
    for name, place in domain.words.actors.items():
        for term in signature.members(signature.predicates[name].sorts[place]):
            yield _key(domain.words.name(term)), term
            yield _key(term), term


def _key(name: str) -> str:
    return " ".join(word for word in words_of(name) if word != "the")
