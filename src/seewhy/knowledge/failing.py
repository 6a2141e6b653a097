"""The instances of axioms that fail to conclude a literal: which of them, and which ways, are told.

An instance fails in every scene that shares one of the ways in which it fails. Of a picture as a
whole all ways are told. Of things there are as many instances as pairs of things; there the
plainest way of each is told, and what fails of one axiom is told together.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from seewhy.knowledge.evidence import Evidence
from seewhy.knowledge.foundation import Need
from seewhy.knowledge.ground import literal_of
from seewhy.knowledge.possible import Belief, Instance

__all__ = ["MOST_AXIOMS", "Failing", "Ways", "by_axiom", "fewest", "told_ways"]

MOST_AXIOMS = 16
"""Of more instances that all fail, so many are told, and those that name further features."""

Ways = list[tuple[int, Need]]
"""The conditions of an instance by which it fails: their places, and what they come to."""

Failing = tuple[Instance, Ways]


def told_ways(evidence: Evidence, ways: Ways) -> Ways:
    """Return the ways that are told: all, or where there are things the plainest."""
    if not evidence.schema.presence or len(ways) < 2:
        return ways
    return [min(ways, key=lambda way: _depth(evidence, way[1]))]


def _depth(evidence: Evidence, need: Need) -> int:
    """How much there is to tell of a need: least of what a picture shows."""
    if not isinstance(need, Belief):
        return 1
    if evidence.is_ruled_out(need.key):
        return 0
    return 0 if evidence.schema.feature_of(literal_of(need.key)) is not None else 2


def fewest(groups: Mapping[frozenset[object], Failing]) -> list[Failing]:
    """Leave out the instances that fail wherever another fails: what decides that one is enough."""
    kept: list[frozenset[object]] = []
    for group in sorted(groups, key=len):
        if not any(fewer <= group for fewer in kept[: 4 * MOST_AXIOMS]):
            kept.append(group)
    chosen = set(kept)
    return [found for group, found in groups.items() if group in chosen]


def by_axiom(failing: Sequence[Failing], evidence: Evidence) -> list[list[Failing]]:
    """Return what is told together: of things all that fails of an axiom, else each by itself."""
    if not evidence.schema.presence:
        return [[found] for found in failing]
    together: dict[str, list[Failing]] = {}
    for found in failing:
        together.setdefault(found[0].axiom.identifier, []).append(found)
    return list(together.values())
