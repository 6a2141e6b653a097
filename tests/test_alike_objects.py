"""Objects that knowledge does not tell apart are looked at once by `seewhy check`."""

from __future__ import annotations

import random

import pytest

from seewhy.knowledge import transition_probe
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.knowledge.symmetry import first_of_each, interchangeable
from seewhy.knowledge.transition_probe import TransitionProbe
from seewhy.planning.domain import load_planning_domain

SIGNATURE = """
#sort box = {b1, b2, b3, b4}. #sort level = 1..3. #sort robot = {r1}.
#static heavy(box). #static label(box, level). #static red(box).
#fluent basic on(box, box). #fluent basic open(box). #fluent defined high(box).
#action put(robot, box, box). #action exogenous slip(box).
put(R, X, Y) causes on(X, Y). slip(X) causes open(X).
"""


def test_things_that_no_axiom_tells_apart() -> None:
    """Of a table's things the axioms ask which is a ball; colours nobody asks for."""
    table = load_planning_domain("tabletop").knowledge
    things = [group for group in interchangeable(table) if group[0].startswith("thing")]
    assert things == [("thing1", "thing2", "thing3", "thing4"), ("thing5", "thing6")]


@pytest.mark.parametrize(
    ("axioms", "expected"),
    [
        ("", (("b1", "b2", "b3", "b4"),)),
        ("red(b1).", (("b1", "b2", "b3", "b4"),)),  # nobody asks
        ("red(b1). -open(X) if red(X).", (("b2", "b3", "b4"),)),
        ("red(b1). -open(X) if -red(X).", (("b1", "b2", "b3", "b4"),)),
        ("heavy(b1). heavy(b3). open(X) if heavy(X).", (("b1", "b3"), ("b2", "b4"))),
        ("-open(b2).", (("b1", "b3", "b4"),)),
        ("impossible put(R, b1, X) if open(X).", (("b2", "b3", "b4"),)),
        ("-open(X) if on(X, Y), X < Y.", ()),
        ("-open(X) if label(X, N), N < 2. label(b1, 1).", (("b2", "b3", "b4"),)),
        ("-open(X) if box(X), #count { Y : on(Y, X) } > 1.", (("b1", "b2", "b3", "b4"),)),
        ("-open(X) if box(X), #count { Y : on(Y, X), Y < X } > 1.", ()),
        ("red(b4). -open(X) if box(X), #count { Y : red(Y) } > 1.", (("b1", "b2", "b3"),)),
    ],
)
def test_what_tells_objects_apart(axioms: str, expected: tuple[tuple[str, ...], ...]) -> None:
    assert interchangeable(read_knowledge(SIGNATURE + axioms)) == expected


def test_one_of_each_choice() -> None:
    places = [("a", "b", "c", "x")] * 3
    chosen = first_of_each([("a", "b", "c")], places)
    assert chosen is not None
    assert len(chosen) == 15  # of 64: the patterns of three places, each a letter of its own or x
    assert first_of_each([("a", "b")], [tuple(map(str, range(40)))] * 3) is None


CONSTRAINTS = (
    "-on(X, Z) if on(X, Y), box(Z), Y != Z.",
    "-on(Z, Y) if on(X, Y), box(Z), X != Z.",
    "open(X) if box(X), not -open(X), heavy(X).",
    "-open(X) if on(X, Y), not open(Y).",
    "open(Y) if on(X, Y), not -open(Y).",
    "open(X) if red(X), not -open(X).",
    "-open(X) if high(X), not open(X).",
    "high(X) if on(X, Y).",
    "high(X) if on(X, Y), high(Y).",
    "impossible put(R, X, X) if box(X).",
    "impossible put(R, X, Y) if heavy(X), red(Y).",
    "on(X, Y) if open(X), heavy(Y), not -on(X, Y).",
    "-on(X, Y) if open(X), heavy(Y), not on(X, Y).",
    "slip(X) causes -open(Y) if on(X, Y).",
)


def _random_knowledge(seed: int) -> Knowledge:
    chance = random.Random(seed)
    facts = [f"{name}({box})." for name in ("heavy", "red") for box in ("b1", "b2", "b3", "b4")]
    chosen = [*chance.sample(facts, 3), *chance.sample(CONSTRAINTS, chance.randint(2, 6))]
    return read_knowledge(SIGNATURE + "\n".join(chosen))


@pytest.mark.parametrize("seed", range(25))
def test_nothing_is_overlooked(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """What two states may follow is found, whether alike objects are looked at once or each."""
    knowledge = _random_knowledge(seed)
    once = TransitionProbe(knowledge, following=2)
    monkeypatch.setattr(transition_probe, "_first_of_each", lambda _: iter(()))
    each = TransitionProbe(knowledge, following=2)
    for action in (None, *each.actions):
        assert once.is_possible(action=action) is each.is_possible(action=action), action
