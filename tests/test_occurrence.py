"""Which scenes can be, judged by those that were; and changes that nobody can make."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, product

from hypothesis import example, given, settings
from hypothesis import strategies as st

from knowledge_builders import CLASSES, Rule, World, worlds
from seewhy.agent.agent import Agent
from seewhy.dialogue.question import Asks, Question
from seewhy.domain.domain import Domain
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.occurrence import EXPECTED, Occurrence
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector

VALUES = (("a", "b"), ("x", "y"), ("1", "2", "3"))
SPACE: list[FeatureVector] = list(product(*VALUES))


@settings(max_examples=200)
@given(counts=st.lists(st.integers(0, 30), min_size=len(SPACE), max_size=len(SPACE)))
def test_what_never_goes_together(counts: list[int]) -> None:
    """The definition, written out, scene by scene."""
    scenes = [vector for vector, n in zip(SPACE, counts, strict=True) for _ in range(n)]
    occurrence = Occurrence({v: n for v, n in zip(SPACE, counts, strict=True) if n})

    def share(parts: tuple[tuple[int, str], ...]) -> float:
        return sum(all(scene[n] == value for n, value in parts) for scene in scenes) / len(scenes)

    def missing(parts: tuple[tuple[int, str], ...]) -> bool:
        if not scenes or share(parts) > 0:
            return False
        rest = [tuple(other for other in parts if other != part) for part in parts]
        least = min(share((part,)) * share(more) for part, more in zip(parts, rest, strict=True))
        return len(scenes) * least >= EXPECTED - 1e-9

    for vector in SPACE:
        parts = [(n, value or "") for n, value in enumerate(vector)]
        expected = not any(
            missing(combined) for size in (2, 3) for combined in combinations(parts, size)
        )
        assert (occurrence.never_together(vector) is None) == expected


def test_what_was_seen_once_can_be() -> None:
    often = {("a", "x"): 500, ("b", "y"): 500}
    assert Occurrence(often).never_together(("a", "y")) == ((0, "a"), (1, "y"))
    assert Occurrence({**often, ("a", "y"): 1}).never_together(("a", "y")) is None
    assert Occurrence(often).never_together(("a", None)) is None
    assert Occurrence({}).never_together(("a", "y")) is None


def by_trying(
    world: World, occurrence: Occurrence, vector: FeatureVector, label: str
) -> set[FeatureVector]:
    """The nearest vectors of a class that can occur; where none can, the nearest of all."""
    if world.decision(vector)[0] == label:
        return {vector}
    # What is known stays known; what is unknown may stay so.
    space = [
        candidate
        for candidate in world.vectors
        if all(old is None or new is not None for old, new in zip(vector, candidate, strict=True))
    ]
    of_class = [candidate for candidate in space if world.decision(candidate)[0] == label]
    can = [candidate for candidate in of_class if occurrence.never_together(candidate) is None]

    def distance(candidate: FeatureVector) -> tuple[int, int]:
        changed = zip(world.costs, vector, candidate, strict=True)
        cost = sum(price for price, old, new in changed if old != new)
        moved = 0 if vector[2] is None else abs(int(vector[2]) - int(candidate[2] or 0))
        return cost, moved

    least = min(map(distance, can or of_class), default=None)
    return {candidate for candidate in can or of_class if distance(candidate) == least}


@settings(max_examples=40)
@given(
    world=worlds(costly=True),
    often=st.lists(st.sampled_from([0, 0, 0, 1, 40]), min_size=12, max_size=12),
    asked=st.lists(st.integers(0, 17), min_size=2, max_size=4, unique=True),
)
@example(world=World((Rule("p(S)", ("-f(S)",)),), "two"), often=[0] * 12, asked=[0, 12])
def test_the_nearest_that_can_occur_is_proposed(
    world: World, often: list[int], asked: list[int]
) -> None:
    """Whatever was asked before: one finder answers all, twice, and in two orders."""
    space = [scene for scene in world.vectors if None not in scene]
    occurrence = Occurrence({scene: n for scene, n in zip(space, often, strict=True) if n})
    reasoner = Reasoner(world.knowledge, world.schema)
    finder = ChangeFinder(reasoner, occurrence)
    scenes = [*space, *(scene for scene in world.vectors if None in scene)]
    questions = [
        (scenes[n % len(scenes)], label) for n in asked for label in CLASSES[world.classes]
    ]
    for vector, label in (*questions, *reversed(questions)):
        found = finder.smallest(vector, label, limit=100)
        assert {change.vector for change in found} == by_trying(world, occurrence, vector, label)


def test_a_scene_of_the_class_needs_no_change_though_it_cannot_be(structures: Domain) -> None:
    reasoner = Reasoner(structures.knowledge, structures.schema)
    never = Occurrence({("1", "wide", "no", "no"): 100, ("4", "wide", "no", "yes"): 100})
    lone: FeatureVector = ("1", "wide", "yes", "yes")
    assert never.never_together(lone) is not None
    assert reasoner.decide(lone).label == "unstable"
    (change,) = ChangeFinder(reasoner, never).smallest(lone, "unstable")
    assert (change.changes, change.vector, change.cost) == ((), lone, 0)


def test_an_agent_asks_the_scenes_that_it_knows(structures: Domain) -> None:
    """A single block is never displaced, which no axiom says."""
    lone = structures.vector(
        {"num_blocks": "1", "base": "wide", "lean": "no", "block_displaced": "no"}
    )
    axioms = tuple(
        axiom
        for axiom in structures.knowledge.axioms
        if str(axiom) == "-stable(S) if block_displaced(S)."
    )
    assert len(axioms) == 1
    little = replace(structures, knowledge=replace(structures.knowledge, axioms=axioms))
    agent = Agent(little)
    displaced = ("1", "wide", "no", "yes")
    assert [change.vector for change in agent.reasoned.ways.smallest(lone, "unstable")] == [
        displaced
    ]
    others: list[FeatureVector] = [
        (number, "wide", "no", shift) for number in "2345" for shift in ("no", "yes")
    ]
    agent.fit_induction(
        [lone] * 40 + others * 10,
        ["stable"] * 40 + ["stable", "unstable"] * 40,
        answers=False,
    )
    found = [change.vector for change in agent.reasoned.ways.smallest(lone, "unstable")]
    assert found == [("2", "wide", "no", "yes")]
    # That it needs another block, no axiom says: how it differs is what an axiom asks alone.
    differs = Question(Asks.DIFFERENCE_TO_CLASS, "", (), label="unstable")
    kind = agent.reasoned.kind(differs, lone, "stable")
    assert kind.identifier == "difference(block_displaced)[block_displaced=yes]"
