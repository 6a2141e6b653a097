"""Which scenes can be, judged by those that were; and changes that nobody can make."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, product

from hypothesis import given, settings
from hypothesis import strategies as st

from knowledge_builders import SIGNATURE, schema_of
from seewhy.agent import Agent
from seewhy.domain import Domain
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.language import read_knowledge
from seewhy.knowledge.occurrence import EXPECTED, Occurrence
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector

VALUES = (("a", "b"), ("x", "y"), ("1", "2", "3"))
SPACE: list[FeatureVector] = list(product(*VALUES))


@settings(max_examples=200, deadline=None, derandomize=True)
@given(counts=st.lists(st.integers(0, 30), min_size=len(SPACE), max_size=len(SPACE)))
def test_what_never_goes_together(counts: list[int]) -> None:
    """The definition, written out, scene by scene."""
    scenes = [vector for vector, n in zip(SPACE, counts, strict=True) for _ in range(n)]
    occurrence = Occurrence({v: n for v, n in zip(SPACE, counts, strict=True) if n})

    def share(parts: tuple[tuple[int, str], ...]) -> float:
        return sum(all(own[n] == value for n, value in parts) for own in scenes) / len(scenes)

    def missing(parts: tuple[tuple[int, str], ...]) -> bool:
        if not scenes or share(parts) > 0:
            return False
        rest = [tuple(other for other in parts if other != own) for own in parts]
        least = min(share((own,)) * share(more) for own, more in zip(parts, rest, strict=True))
        return len(scenes) * least >= EXPECTED - 1e-9

    for vector in SPACE:
        parts = [(n, value or "") for n, value in enumerate(vector)]
        expected = not any(missing(own) for size in (2, 3) for own in combinations(parts, size))
        assert occurrence.possible(vector) == expected


def test_what_was_seen_once_can_be() -> None:
    often = {("a", "x"): 500, ("b", "y"): 500}
    assert not Occurrence(often).possible(("a", "y"))
    assert Occurrence({**often, ("a", "y"): 1}).possible(("a", "y"))
    assert Occurrence(often).possible(("a", None))
    assert Occurrence({}).possible(("a", "y"))


KNOWLEDGE = read_knowledge(
    SIGNATURE
    + """
p(S) if f(S).
p(S) if g(S, dark), n(S, 3).
-p(S) if -f(S), g(S, light).
"""
)
SCHEMA = schema_of(KNOWLEDGE, ("f", "g", "n"), {"yes": "p(scene)", "no": "-p(scene)"})
REASONER = Reasoner(KNOWLEDGE, SCHEMA)
PLAIN: FeatureVector = ("no", "light", "1")


def proposed(occurrence: Occurrence | None) -> list[FeatureVector]:
    return [own.vector for own in ChangeFinder(REASONER, occurrence).smallest(PLAIN, "yes")]


def test_a_change_leads_to_what_can_be() -> None:
    cheapest: FeatureVector = ("yes", "light", "1")
    dark: FeatureVector = ("no", "dark", "3")
    assert proposed(None) == [cheapest]
    assert proposed(Occurrence({PLAIN: 3, dark: 2})) == [cheapest]
    # f has never been seen with light: two changes that lead to something seen are better.
    never = Occurrence({PLAIN: 100, dark: 50, ("yes", "dark", "2"): 50, ("yes", "dark", "1"): 9})
    found = proposed(never)
    assert found
    assert cheapest not in found
    assert all(never.possible(own) for own in found)


def test_where_nothing_can_be_anything_is_proposed() -> None:
    """However often it is asked, and from wherever."""
    never = Occurrence({PLAIN: 100, ("no", "dark", "1"): 100, ("yes", None, None): 100})
    finder = ChangeFinder(REASONER, never)
    plain = ChangeFinder(REASONER)
    for vector in (PLAIN, ("no", "light", "2"), PLAIN):
        found = finder.smallest(vector, "yes")
        if not any(never.possible(own.vector) for own in found):
            assert found == plain.smallest(vector, "yes")
        assert found


def test_an_agent_asks_the_scenes_that_it_knows(structures: Domain) -> None:
    """A single block is never displaced, which no axiom says."""
    lone = structures.vector(
        {"num_blocks": "1", "base": "wide", "lean": "no", "block_displaced": "no"}
    )
    axioms = tuple(
        own
        for own in structures.knowledge.axioms
        if str(own) == "-stable(S) if block_displaced(S)."
    )
    assert len(axioms) == 1
    little = replace(structures, knowledge=replace(structures.knowledge, axioms=axioms))
    agent = Agent(little)
    displaced = ("1", "wide", "no", "yes")
    assert [own.vector for own in agent.reasoned.smallest(lone, "unstable")] == [displaced]
    others: list[FeatureVector] = [
        (number, "wide", "no", shift) for number in "2345" for shift in ("no", "yes")
    ]
    agent.fit_induction(
        [lone] * 40 + others * 10,
        ["stable"] * 40 + ["stable", "unstable"] * 40,
        answers=False,
    )
    found = [own.vector for own in agent.reasoned.smallest(lone, "unstable")]
    assert found == [("2", "wide", "no", "yes")]
