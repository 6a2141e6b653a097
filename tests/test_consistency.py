"""Axioms that can never be used are refused; knowledge that is merely incomplete is not."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain, combinations

import pytest
from hypothesis import example, given, settings

from knowledge_builders import Rule, World, opposite, schema_of, worlds
from seewhy.errors import KnowledgeError
from seewhy.knowledge.consistency import check_consistency, never_applies
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.knowledge.scene import FeatureVector, SceneSchema

thorough = settings(max_examples=25)
# The last axiom can be used: where f holds, the default is given up.
DEFEATED = World(
    (
        Rule("p(S)", ("f(S)",), default=True),
        Rule("q(S)", ("p(S)", "not r(S)")),
        Rule("-q(S)", ("f(S)",)),
        Rule("r(S)", ("g(S, dark)", "not f(S)")),
        Rule("p(S)", ("g(S, light)",)),
    )
)
# The second axiom never fires without a contradiction, and yet it is heeded: q gives way to it.
YIELDS = World(
    (Rule("p(S)", ("f(S)",)), Rule("-p(S)", ("q(S)",)), Rule("q(S)", ("f(S)",), default=True))
)
SIGNATURE = """\
#sort tile.
#sort mark = {dot, cross}.
#static left(tile, mark).
#static torn(tile).
#static good(tile).
#static goods(tile).
"""


def fires(world: World, rule: Rule, vector: FeatureVector, *, strict: bool) -> bool:
    """Whether the axiom fires in an answer set, contradictory ones included unless strict."""

    def in_one_of(given_up: tuple[int, ...]) -> bool:
        return any(
            rule.holds(beliefs) and not (rule.default and opposite(rule.concludes) in beliefs)
            for beliefs in world.answer_sets(vector, given_up, contradictory=not strict)
        )

    defaults = [number for number, rule in enumerate(world.rules) if rule.default]
    given_up = chain.from_iterable(combinations(defaults, n) for n in range(len(defaults) + 1))
    return any(map(in_one_of, given_up if strict else ((),)))


def is_consistent(world: World, vector: FeatureVector) -> bool:
    """Whether a scene has an answer set without contradictions, defaults given up or not."""
    defaults = [number for number, rule in enumerate(world.rules) if rule.default]
    given_up = chain.from_iterable(combinations(defaults, n) for n in range(len(defaults) + 1))
    return any(world.answer_sets(vector, defaults, contradictory=False) for defaults in given_up)


def useless(world: World) -> list[int]:
    """The axioms that fire in some scene, never consistently, and that no scene can give way to."""
    return [
        number
        for number, rule in enumerate(world.rules)
        if not rule.default
        and (
            fired := [
                vector for vector in world.vectors if fires(world, rule, vector, strict=False)
            ]
        )
        and not any(fires(world, rule, vector, strict=True) for vector in world.vectors)
        and not any(is_consistent(world, vector) for vector in fired)
    ]


@given(world=worlds())
@example(world=DEFEATED)
@example(world=World((Rule("p(S)", ("f(S)",)), Rule("-p(S)", ("f(S)",)))))
@example(world=World((Rule("-f(S)", ("f(S)",)),)))
@example(world=YIELDS)
@thorough
def test_the_first_axiom_without_use_is_refused_and_no_other(world: World) -> None:
    wrong = useless(world)
    if not wrong:
        check_consistency(world.knowledge, world.schema)
        return
    with pytest.raises(KnowledgeError) as caught:
        check_consistency(world.knowledge, world.schema)
    axiom = world.knowledge.axioms[wrong[0]]
    assert str(caught.value).startswith(f"{axiom.location}: '{axiom}' can never be used: ")


@given(world=worlds())
@thorough
def test_an_axiom_that_never_applies_fires_in_no_scene(world: World) -> None:
    # A class that no axiom concludes may be told, see the next test: here each has one.
    concluding = [
        Rule(str(literal).replace("(scene)", "(S)"), ("f(S)", "not f(S)"))
        for literal in world.schema.classes.values()
    ]
    world = replace(world, rules=(*world.rules, *concluding))
    found = never_applies(world.knowledge, world.schema)
    assert [int(axiom.identifier[1:]) - 1 for axiom in found] == [
        number
        for number, rule in enumerate(world.rules)
        if not any(fires(world, rule, vector, strict=False) for vector in world.vectors)
    ]


def test_what_follows_from_a_class_that_only_a_tree_can_tell_applies() -> None:
    knowledge, schema = domain("goods(S) if good(S).\ngoods(S) if torn(S), not torn(S).")
    assert [str(axiom) for axiom in never_applies(knowledge, schema)] == [
        "goods(S) if torn(S), not torn(S)."
    ]


def domain(axioms: str) -> tuple[Knowledge, SceneSchema]:
    knowledge = read_knowledge(SIGNATURE + axioms)
    classes = {"good": "good(tile)", "bad": "-good(tile)"}
    return knowledge, schema_of(knowledge, ("left", "torn"), classes, scene="tile")


def refusal(axioms: str) -> str:
    with pytest.raises(KnowledgeError) as caught:
        check_consistency(*domain(axioms))
    return str(caught.value)


def test_two_axioms_that_always_contradict_each_other() -> None:
    assert refusal("good(T) if torn(T).\n-good(T) if torn(T), tile(T).\n") == (
        "knowledge.al:7:1: 'good(T) if torn(T).' can never be used: whenever its conditions hold, "
        "the axiom in line 8 ('-good(T) if torn(T), tile(T).') concludes the opposite; "
        "change or remove one of the two"
    )


def test_the_special_axiom_is_named_where_the_general_one_has_other_uses() -> None:
    assert refusal("good(T) if tile(T), not torn(T).\n-good(T) if -torn(T), left(T, dot).\n") == (
        "knowledge.al:8:1: '-good(T) if -torn(T), left(T, dot).' can never be used: whenever its "
        "conditions hold, the axiom in line 7 ('good(T) if tile(T), not torn(T).') concludes the "
        "opposite; change or remove one of the two"
    )


def test_an_axiom_that_contradicts_what_is_seen() -> None:
    assert refusal("-left(T, dot) if left(T, dot).\n") == (
        "knowledge.al:7:1: '-left(T, dot) if left(T, dot).' can never be used: whenever its "
        "conditions hold, the beliefs contradict each other; change or remove one of the two"
    )


def test_a_predicate_whose_name_only_begins_alike_is_not_blamed() -> None:
    axioms = "good(T) if torn(T).\n-goods(T) if torn(T).\ngoods(T) if good(T).\n"
    assert refusal(axioms) == (
        "knowledge.al:7:1: 'good(T) if torn(T).' can never be used: whenever its conditions hold, "
        "the beliefs contradict each other; change or remove one of the two"
    )


def test_the_opponent_concludes_the_opposite_of_the_same_instance() -> None:
    axioms = (
        "-left(T, cross) if torn(T).\n"
        "left(T, dot) if torn(T).\n"
        "-left(T, dot) if torn(T), not good(T).\n"
    )
    assert refusal(axioms) == (
        "knowledge.al:7:1: '-left(T, cross) if torn(T).' can never be used: whenever its "
        "conditions hold, the beliefs contradict each other; change or remove one of the two"
    )


@pytest.mark.parametrize(
    "axioms",
    [
        "good(T) if torn(T).\n-good(T) if left(T, dot).\n",
        "good(T) if torn(T).\ndefault -good(T) if torn(T).\n",
        "default goods(T) if torn(T).\n-good(T) if torn(T).\n"
        "good(T) if goods(T).\ngoods(T) if left(T, dot).\n",
        "default good(T) if torn(T).\ndefault -good(T) if torn(T).\n",
        "good(T) if torn(T), -torn(T).\n-good(T) if torn(T), -torn(T).\n",
    ],
    ids=["sometimes", "default yields", "default is given up", "two defaults", "never applies"],
)
def test_what_is_accepted(axioms: str) -> None:
    check_consistency(*domain(axioms))


def test_never_applies() -> None:
    axioms = (
        "good(T) if left(T, dot), left(T, cross).\n"
        "good(T) if left(T, dot).\n"
        "goods(T) if good(T), 2 < 1.\n"
        "default -good(T) if goods(T).\n"
    )
    assert [axiom.location.line for axiom in never_applies(*domain(axioms))] == [7, 9, 10]
