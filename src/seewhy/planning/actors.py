"""Who does an action: the argument that its words leave out, because a sentence names it first."""

from __future__ import annotations

from collections.abc import Mapping

from seewhy.knowledge.signature import PredicateKind, Signature
from seewhy.planning.tables import ActionTable

__all__ = ["actor_places"]


def actor_places(
    signature: Signature, actions: Mapping[str, ActionTable], *, robot: str | None
) -> dict[str, int]:
    """Return the place of whoever acts among the arguments of each action that has one.

    It is an argument of the robot's sort that the words of the action do not name; where no robot
    is declared, the first argument, where there are several that it may be.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort robot = {r1, r2}. #sort place = {hall}. #fluent basic lit. "
    ...     "#action move(robot, place).")
    >>> words = {"move": ActionTable(do="move to {1}", did="moved to {1}")}
    >>> actor_places(known.signature, words, robot="r1")
    {'move': 0}
    """
    found = {}
    for name, table in actions.items():
        predicate = signature.predicates[name]
        if predicate.kind is not PredicateKind.ACTION or table.do is None:
            continue
        for place, sort in enumerate(predicate.sorts):
            members = signature.members(sort)
            acts = robot in members if robot else place == 0 and len(members) > 1
            if acts and f"{{{place}}}" not in table.do:
                found[name] = place
                break
    return found
