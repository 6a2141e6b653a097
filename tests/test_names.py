"""No name that a user chooses changes what a program means: tried with every word of ours."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import astuple
from itertools import product

import numpy as np
import pytest

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.candidates import decided_vectors, most_probable_decided
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.consistency import check_consistency, never_applies
from seewhy.knowledge.history import read_history
from seewhy.knowledge.language import read_knowledge
from seewhy.knowledge.odd_loop import OddLoops
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import SceneSchema
from seewhy.knowledge.transition_probe import TransitionProbe
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.dialogue.instances import Instances
from seewhy.planning.execution.plan_monitoring import suppositions
from seewhy.planning.execution.transition_function import TransitionFunction
from seewhy.planning.goal import read_goal
from seewhy.planning.planner.goal_test import goal_holds
from seewhy.planning.planner.planner import plan

NAME = re.compile(r"(?<![\w'])_*[a-z][\w']*")
LAMPS = """\
#sort SORT = {ONE, TWO, THREE}.
#static STATIC(SORT, SORT).
#fluent basic FLUENT(SORT).
#fluent basic PLAIN.
#fluent defined DEFINED(SORT).
#action ACTION(SORT).
#action exogenous EVENT.
STATIC(ONE, TWO). STATIC(TWO, THREE).
ACTION(X) causes FLUENT(X).
EVENT causes PLAIN.
FLUENT(Y) if FLUENT(X), STATIC(X, Y), not PLAIN.
-FLUENT(Y) if FLUENT(THREE), SORT(Y), Y = ONE.
DEFINED(X) if FLUENT(X), #count { Y : STATIC(X, Y) } > 0.
impossible ACTION(X) if FLUENT(X).
impossible ACTION(X) if PLAIN, X = TWO.
default -FLUENT(ONE).
"""
LAMP_ROLES = (
    *("SORT", "ONE", "TWO", "THREE", "STATIC", "FLUENT", "PLAIN", "DEFINED", "ACTION", "EVENT"),
)
TILES = """\
#sort SCENE.
#sort SORT = {ONE, TWO, THREE}.
#static FEATURE(SCENE, SORT).
#static PLAIN(SCENE).
#static OTHER(SCENE, SORT).
#static DERIVED(SCENE, SORT).
#static CLASS(SCENE).
DERIVED(S, X) if FEATURE(S, X), SORT(X), not OTHER(S, X).
CLASS(S) if DERIVED(S, ONE).
-CLASS(S) if PLAIN(S), FEATURE(S, TWO).
default CLASS(S) if OTHER(S, THREE).
-CLASS(S) if OTHER(S, THREE), FEATURE(S, THREE), -PLAIN(S).
"""
TILE_ROLES = (
    *("SCENE", "SORT", "ONE", "TWO", "THREE", "FEATURE", "PLAIN", "OTHER", "DERIVED", "CLASS"),
)


def named(text: str, names: dict[str, str]) -> str:
    """The text with names in the place of roles."""
    return re.sub(r"[A-Z]{3,}", lambda found: names.get(found.group(), found.group()), text)


def lamps(names: dict[str, str]) -> list[object]:
    """What planning and diagnosis say of the lamps."""
    known = read_knowledge(named(LAMPS, names))
    signature = known.signature
    seen = named(
        "observed -FLUENT(ONE) at 0. observed -FLUENT(TWO) at 0. observed -PLAIN at 0."
        "attempted ACTION(ONE) at 0. observed -FLUENT(ONE) at 1. observed PLAIN at 1.",
        names,
    )
    found = diagnose(known, read_history(seen, signature), sensors_err=True)
    goal = read_goal(named("DEFINED(TWO), FLUENT(X), X != TWO", names), known)
    start = found.states[0]
    plans = [
        plan(known, goal, start=start, answer_sets=by_answer_sets)
        for by_answer_sets in (False, True)
    ]
    transitions = TransitionFunction(known)
    world = transitions.complete([])
    probe = TransitionProbe(known, following=1)
    return [
        {
            (surprise.step, surprise.kind.name, surprise.what, surprise.certain)
            for surprise in found.surprises
        },
        [(state.holds, state.unknown) for state in found.states],
        [
            (made.status.name, made.actions, [state.holds for state in made.states])
            for made in plans
        ],
        {*suppositions(known, goal, plans[0].actions, start=start)},
        goal_holds(known, goal, plans[0].states[-1].holds),
        {(action, transitions.after(world, [action])) for action in transitions.actions},
        [(action, not probe.is_possible(action=action)) for action in probe.actions],
        [
            [(one.axiom.head, one.holds, one.absent) for one in Instances(known).of(axiom, world)]
            for axiom in known.axioms[5:]
        ],
    ]


def tiles(names: dict[str, str]) -> list[object]:
    """What is believed of the tiles."""
    known = read_knowledge(named(TILES, names))
    scene, values = names["SCENE"], [names[role] for role in ("ONE", "TWO", "THREE")]
    feature, plain, other = names["FEATURE"], names["PLAIN"], names["OTHER"]
    schema = SceneSchema(
        scene=scene,
        features={
            feature: {value: Literal(feature, (scene, value)) for value in values},
            plain: {"1": Literal(plain, (scene,)), "0": Literal(plain, (scene,), False)},
            other: {value: Literal(other, (scene, value)) for value in values},
        },
        classes={
            "high": Literal(names["CLASS"], (scene,)),
            "low": Literal(names["CLASS"], (scene,), False),
        },
        change_costs={},
    )
    check_consistency(known, schema)
    vectors = [*product([*values, None], ["1", "0", None], [*values, None])]
    reasoner, alone = Reasoner(known, schema), Reasoner(known, schema)
    together = reasoner.decide_all(vectors)
    finder = ChangeFinder(reasoner)
    some = vectors[::7]
    listed = decided_vectors(reasoner, limit=100)
    even = [
        np.log(np.full(len(by_value), 1 / len(by_value))) for by_value in schema.features.values()
    ]
    best = most_probable_decided(reasoner, even, tried=1)
    return [
        [decision.verdict.name for decision in together],
        [decision.label for decision in together],
        [alone.decide(vector) == one for vector, one in zip(vectors, together, strict=True)],
        [reasoner.believed(vector) for vector in some],
        [
            {frozenset(map(astuple, one.changes)) for one in finder.smallest(vector, "low")}
            for vector in some
        ],
        {*(listed or ())},
        best is None,
        [axiom.identifier for axiom in never_applies(known, schema)],
        [len(OddLoops(known, schema).of(vector)) for vector in some],
        [
            {(name.upper(), *map(tuple, fired)) for name, fired in found.firings.items()}
            for vector in some
            if (found := alone.answer_set(vector)) is not None
        ],
    ]


def plainly(result: object, names: dict[str, str]) -> str:
    """The result with roles in the place of names, whatever order the names stood in."""
    roles = {name: role for role, name in names.items()}

    def say(part: object) -> str:
        if isinstance(part, frozenset | set):
            return "{" + ", ".join(sorted(map(say, part))) + "}"
        if isinstance(part, list | tuple) and not hasattr(part, "_fields"):
            return "[" + ", ".join(map(say, part)) + "]"
        return NAME.sub(lambda found: roles.get(found.group(), found.group()), str(part))

    return say(result)


def words_of(told: Callable[[dict[str, str]], list[object]], roles: tuple[str, ...]) -> list[str]:
    """Every word of the programs that something is told with, the user's own left out."""
    names = {role: f"user{number}" for number, role in enumerate(roles)}
    programs: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        plain = BoundedControl.__init__

        def recorded(self: BoundedControl, program: str, **options: object) -> None:
            programs.append(program)
            plain(self, program, **options)  # type: ignore[arg-type]

        patch.setattr(BoundedControl, "__init__", recorded)
        told(names)
    words = {word for program in programs for word in NAME.findall(program)}
    words -= {*names.values(), "not"}
    return sorted(word for word in words if not word.endswith("__"))


def trials(words: list[str], roles: tuple[str, ...]) -> Iterator[dict[str, str]]:
    """Names for the roles, so that every word is the name of some of them, each in turn."""
    for first in range(0, len(words), 3):
        chosen = [words[(first + 7 * number) % len(words)] for number in range(len(roles))]
        if len({*chosen}) == len(roles):
            yield dict(zip(roles, chosen, strict=True))


@pytest.mark.parametrize(
    ("told", "roles", "least"), [(lamps, LAMP_ROLES, 40), (tiles, TILE_ROLES, 15)]
)
def test_no_name_changes_what_is_believed(
    told: Callable[[dict[str, str]], list[object]], roles: tuple[str, ...], least: int
) -> None:
    words = words_of(told, roles)
    assert len(words) >= least
    usual = {role: f"user{number}" for number, role in enumerate(roles)}
    expected = plainly(told(usual), usual)
    for names in trials(words, roles):
        assert plainly(told(names), names) == expected, names


def test_a_value_may_be_called_what_the_picture_is() -> None:
    usual = {role: f"user{number}" for number, role in enumerate(TILE_ROLES)}
    alike = {**usual, "ONE": usual["SCENE"]}
    expected, found = tiles(usual), tiles(alike)
    for place in (0, 1, 2, 6, 7, 8):
        assert found[place] == expected[place]


@pytest.mark.parametrize("role", ["SORT", "ONE", "PLAIN"])
def test_a_parameter_of_a_program_is_no_name(role: str) -> None:
    usual = {role: f"user{number}" for number, role in enumerate(LAMP_ROLES)}
    names = {**usual, role: "t"}
    assert plainly(lamps(names), names) == plainly(lamps(usual), usual)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "#static default(tile).",
            "1:13: 'default' is a word of the language and cannot be the name of a static; call it "
            "otherwise, 'default_it' for instance",
        ),
        (
            "#fluent basic causes.",
            "1:13: 'causes' is a word of the language and cannot be the name of a fluent basic; "
            "call it otherwise, 'causes_it' for instance",
        ),
        (
            "#sort if.",
            "1:13: 'if' is a word of the language and cannot be the name of a sort; call it "
            "otherwise, 'if_it' for instance",
        ),
        (
            "#sort word = {yes, f(not)}.",
            "1:13: 'not' is a word of the language and cannot be the name of a member of sort "
            "'word'; call it otherwise, 'not_it' for instance",
        ),
        (
            "#sort number = {one, goal__}.",
            "1:13: 'goal__' is no name of a member of sort 'number': names that end in '__' are "
            "kept for what is added to the knowledge; call it 'goal'",
        ),
        (
            "#static p(tile). p(Step__) if tile(Step__).",
            "1:30: 'Step__' is no variable: names that end in '__' are kept for what is added to "
            "the knowledge; call it 'Step'",
        ),
    ],
)
def test_reserved_names_are_refused_where_they_are_declared(text: str, message: str) -> None:
    with pytest.raises(KnowledgeError) as caught:
        read_knowledge(f"#sort tile. {text}", file="k.al")
    assert str(caught.value) == f"k.al:{message}"


def test_words_of_the_language_that_begin_statements_may_be_members() -> None:
    known = read_knowledge("#sort word = {default, observed}. #static p(word). p(default).")
    assert str(known.axioms[0].head) == "p(default)"
