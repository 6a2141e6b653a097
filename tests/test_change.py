"""The smallest change is the one that trying every feature vector finds."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from knowledge_builders import CLASSES, VALUES, Rule, World, schema_of, worlds
from seewhy.knowledge.change import Change, ChangeFinder, FeatureChange
from seewhy.knowledge.language import read_knowledge
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector

# In both answer sets of every scene p and one other class hold: p alone is in all of them.
WITH_COMPANY = World(
    (
        Rule("p(S)", ("f(S)",)),
        Rule("q(S)", ("f(S)", "not r(S)")),
        Rule("r(S)", ("f(S)", "not q(S)")),
    ),
    "three",
)
BY_DEFAULT = World(
    (
        Rule("p(S)", ("n(S, N)", "N > 1"), default=True),
        Rule("-p(S)", ("g(S, dark)",)),
        Rule("-f(S)", ("p(S)",)),
    ),
    costs=(3, 1, 2),
)


def by_trying(world: World, vector: FeatureVector, label: str) -> list[tuple[int, FeatureVector]]:
    """All vectors with the least cost, and among those the least movement of numbers."""
    ranked: list[tuple[int, int, FeatureVector]] = []
    # What is known stays known; what is unknown may stay so.
    choices = [
        values if known is not None else (*values, None)
        for values, known in zip(VALUES.values(), vector, strict=True)
    ]
    for candidate in product(*choices):
        if world.decision(candidate)[0] != label:
            continue
        changed = [old != new for old, new in zip(vector, candidate, strict=True)]
        cost = sum(price for price, differs in zip(world.costs, changed, strict=True) if differs)
        old, new = vector[2], candidate[2]
        moved = abs(int(old) - int(new)) if old is not None and new is not None else 0
        ranked.append((cost, moved, candidate))
    least = min((entry[:2] for entry in ranked), default=None)
    return [(cost, candidate) for cost, moved, candidate in ranked if (cost, moved) == least]


@given(
    world=worlds(costly=True),
    scenes=st.lists(st.integers(0, 35), min_size=2, max_size=4, unique=True),
)
@example(world=WITH_COMPANY, scenes=[0, 20, 30])
@example(world=BY_DEFAULT, scenes=[0, 5, 17, 35])
@settings(max_examples=30)
def test_no_vector_is_nearer(world: World, scenes: list[int]) -> None:
    # One finder for all, so that what it ruled out once must not be missing later.
    finder = ChangeFinder(Reasoner(world.knowledge, world.schema))
    for vector, label in product([world.vectors[n] for n in scenes], CLASSES[world.classes]):
        expected = by_trying(world, vector, label)
        found = finder.smallest(vector, label, limit=100)
        assert sorted((c.cost, str(c.vector)) for c in found) == sorted(
            (cost, str(candidate)) for cost, candidate in expected
        )
        for change in found:
            assert change.changes == tuple(
                FeatureChange(name, old, new)
                for name, old, new in zip(VALUES, vector, change.vector, strict=True)
                if old != new and new is not None
            )
        assert finder.smallest(vector, label, limit=1) == found[:1]
        assert finder.smallest(vector, label, limit=100) == found


KNOWLEDGE = """\
#sort structure.
#sort num = 1..5.
#sort width = {wide, narrow}.
#static num_blocks(structure, num).
#static base(structure, width).
#static lean(structure).
#static stable(structure).
#static odd(structure).
stable(S) if num_blocks(S, N), N < 3, not lean(S).
stable(S) if base(S, wide), num_blocks(S, N), N < 5.
-stable(S) if lean(S), base(S, narrow).
"""


def finder_of(**costs: int) -> ChangeFinder:
    knowledge = read_knowledge(KNOWLEDGE)
    classes = {
        "stable": "stable(structure)",
        "unstable": "-stable(structure)",
        "odd": "odd(structure)",
    }
    features = ("num_blocks", "base", "lean")
    schema = schema_of(knowledge, features, classes, scene="structure", costs=costs)
    return ChangeFinder(Reasoner(knowledge, schema))


def test_among_equal_costs_numbers_move_least() -> None:
    assert finder_of(base=2).smallest(("4", "narrow", "no"), "stable") == (
        Change(
            changes=(FeatureChange("num_blocks", "4", "2"),),
            vector=("2", "narrow", "no"),
            cost=1,
        ),
    )


def test_costs_decide_between_features() -> None:
    (cheap,) = finder_of(num_blocks=5).smallest(("4", "narrow", "no"), "stable")
    assert cheap.changes == (FeatureChange("base", "narrow", "wide"),)
    (dear,) = finder_of(base=5).smallest(("4", "narrow", "no"), "stable")
    assert dear.changes == (FeatureChange("num_blocks", "4", "2"),)
    (both,) = finder_of(base=7, num_blocks=2, lean=3).smallest(("4", "narrow", "yes"), "stable")
    assert (both.vector, both.cost) == (("2", "narrow", "no"), 5)


def test_what_is_unknown_is_found_out_at_the_cost_of_a_change() -> None:
    found = finder_of().smallest((None, "narrow", "no"), "stable")
    assert [(c.changes, c.cost) for c in found] == [
        ((FeatureChange("num_blocks", None, "1"),), 1),
        ((FeatureChange("num_blocks", None, "2"),), 1),
    ]


def test_a_class_that_is_believed_needs_no_change() -> None:
    vector = ("1", None, "no")
    assert finder_of().smallest(vector, "stable") == (Change(changes=(), vector=vector, cost=0),)


def test_a_class_out_of_reach_has_no_change() -> None:
    finder = finder_of()
    assert finder.smallest(("1", None, "no"), "odd") == ()
    assert finder.smallest(("1", None, "no"), "odd") == ()
    assert finder.smallest(("1", "narrow", "no"), "unstable") != ()


def test_the_limit_cuts_equals_in_a_fixed_order() -> None:
    finder = finder_of(base=9)
    everything = finder.smallest((None, None, "no"), "stable", limit=9)
    assert [c.vector for c in everything] == [("1", None, "no"), ("2", None, "no")]
    assert finder.smallest((None, None, "no"), "stable", limit=1) == everything[:1]


def test_a_class_that_there_is_not() -> None:
    with pytest.raises(KeyError, match="steady"):
        finder_of().smallest((None, None, None), "steady")
