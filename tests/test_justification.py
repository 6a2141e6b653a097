"""A justification is sound, complete, free of circles, and reads as golden text."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from hypothesis import Phase, example, given, settings

from knowledge_builders import Rule, World, facts, opposite, schema_of, worlds
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.language import read_knowledge, read_literal
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.why import contradiction, why
from seewhy.knowledge.why_not import why_not

thorough = settings(phases=(Phase.explicit, Phase.generate), max_examples=25)
CIRCLE = World(
    (
        Rule("p(S)", ("q(S)",)),
        Rule("q(S)", ("p(S)",)),
        Rule("q(S)", ("r(S)",)),
        Rule("r(S)", ("q(S)",)),
        Rule("r(S)", ("f(S)",)),
    )
)
# An exception to one default does not excuse a circle somewhere else.
CIRCLE_AND_EXCEPTION = World(
    (
        Rule("p(S)", ("f(S)",), default=True),
        Rule("-f(S)", ("p(S)",)),
        Rule("q(S)", ("r(S)",)),
        Rule("r(S)", ("q(S)",)),
        Rule("q(S)", ("g(S, dark)",)),
    )
)
DEFAULTS = World(
    (
        Rule("p(S)", ("f(S)",), default=True),
        Rule("-p(S)", ("g(S, dark)",)),
        Rule("q(S)", ("-p(S)",), default=True),
        Rule("-q(S)", ("n(S, N)", "N > 1")),
    )
)


def path_literals(node: Node, above: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """The beliefs from the root to every leaf, each axiom's conclusion once."""
    if node.axiom is not None and node.holds and not node.literal.startswith("not "):
        above = (*above, node.literal.replace(", ", ","))
    if not node.children:
        yield above
    for child in node.children:
        yield from path_literals(child, above)


def comparison_holds(text: str) -> bool:
    left, sign, right = text.split()
    return int(left) > int(right) if sign == ">" else int(left) < int(right)


def scenes_of(world: World) -> list[FeatureVector]:
    return world.vectors[::5]


@given(world=worlds())
@example(world=CIRCLE)
@example(world=CIRCLE_AND_EXCEPTION)
@example(world=DEFAULTS)
@thorough
def test_a_justification_is_sound(world: World) -> None:
    """What it names, and nothing else, is enough to derive the belief."""
    reasoner = Reasoner(world.knowledge, world.schema)
    for vector in scenes_of(world):
        found = reasoner.answer_set(vector)
        if found is None:
            continue
        beliefs = frozenset(map(str, found.holds))
        shown = dict(zip(world.schema.features, vector, strict=True))
        if len(reasoner.answer_sets(vector)) > 1:
            continue
        for belief in sorted(beliefs):
            node = why(reasoner, vector, read_literal(belief))
            assert node is not None
            given_facts: set[str] = set()
            supporting = list(_supporting(node))
            for reason in supporting:
                literal = reason.literal.replace(", ", ",")
                assert reason.basis is not Basis.FACT, "nothing is believed for no reason"
                if reason.basis is Basis.FEATURE:
                    assert reason.value == shown[reason.feature or ""]
                    if not literal.startswith("not "):
                        assert literal in facts(vector)
                        given_facts.add(literal)
                elif reason.basis is Basis.COMPARISON:
                    assert comparison_holds(literal)
                elif reason.basis is Basis.EXCEPTION:
                    assert reason.axiom is not None
                    assert reason.axiom.identifier in dict(found.exceptions)
                    given_facts.add(literal.removeprefix("not "))
                elif not literal.startswith("not "):
                    assert literal in beliefs
                if literal.startswith("not "):
                    assert literal[4:] not in beliefs
            named = {reason.axiom.identifier for reason in supporting if reason.axiom}
            rules = [world.rule(name) for name in named]
            assert belief in world.derived(given_facts, rules, beliefs)
            for path in path_literals(node):
                assert len(path) == len(set(path)), "a belief supports itself"


def _supporting(node: Node) -> Iterator[Node]:
    """The node and what it rests on that is so; what fails, or what would be, is left out."""
    yield node
    for child in node.children:
        if child.holds and child.basis is not Basis.CONSISTENCY:
            yield from _supporting(child)


@given(world=worlds())
@example(world=CIRCLE)
@example(world=CIRCLE_AND_EXCEPTION)
@example(world=DEFAULTS)
@thorough
def test_a_justification_gives_every_reason(world: World) -> None:
    """Every axiom whose conditions hold without the belief itself is a reason for it."""
    reasoner = Reasoner(world.knowledge, world.schema)
    for vector in scenes_of(world):
        found = reasoner.answer_set(vector)
        if found is None:
            assert why(reasoner, vector, read_literal("p(scene)")) is None
            continue
        beliefs = frozenset(map(str, found.holds))
        given_up = {opposite(world.rule(name).concludes) for name, _ in found.exceptions}
        for rule in world.rules:
            belief = rule.concludes
            node = why(reasoner, vector, read_literal(belief))
            shared = {str(literal) for literal in reasoner.believed(vector)}
            assert (node is not None) == (belief in shared)
            if len(reasoner.answer_sets(vector)) > 1:
                continue
            if node is None:
                continue
            reasons = node.children if node.basis is Basis.REASONS else (node,)
            others = [other for other in world.rules if other.concludes != belief]
            without = world.derived((set(facts(vector)) | given_up) - {belief}, others, beliefs)
            expected = {
                number
                for number, candidate in enumerate(world.rules, start=1)
                if candidate.concludes == belief
                and belief in world.derived(without - {belief}, [candidate], beliefs)
            }
            told = {
                int(reason.axiom.identifier[1:])
                for reason in reasons
                if reason.axiom and reason.basis is not Basis.EXCEPTION
            }
            # What something else is absent for may rest on the belief itself.
            weakly = {
                number
                for number in expected
                if world.rules[number - 1].default
                or any(condition.startswith("not ") for condition in world.rules[number - 1].body)
            }
            assert expected - weakly <= told <= expected
            assert any(reason.basis is Basis.FEATURE for reason in reasons) == (
                belief in facts(vector)
            )
            assert any(reason.basis is Basis.EXCEPTION for reason in reasons) == (
                belief in given_up
            )


@given(world=worlds())
@example(world=World((*DEFAULTS.rules, Rule("r(S)", ("n(S, N)", "N > 1", "n(S, 1)")))))
@example(world=World((Rule("p(S)", ("f(S)",)), Rule("q(S)", ("f(S)", "not q(S)")))))
@thorough
def test_why_not_ranks_axioms_by_the_conditions_that_fail(world: World) -> None:
    reasoner = Reasoner(world.knowledge, world.schema)
    for vector in scenes_of(world):
        found = reasoner.answer_set(vector)
        beliefs = frozenset(map(str, found.holds)) if found else frozenset(facts(vector))
        if len(reasoner.answer_sets(vector)) > 1:
            continue
        for head in ("p(S)", "-p(S)", "q(S)", "r(S)"):
            literal = head.replace("S", "scene")
            node = why_not(reasoner, vector, read_literal(literal))
            if literal in beliefs:
                assert node.holds
                both = opposite(literal) in beliefs
                assert node.basis is (Basis.CONFLICT if both else Basis.FACT)
                continue
            expected: list[tuple[int, int]] = []
            for number, rule in enumerate(world.rules, start=1):
                if rule.concludes == literal:
                    failed = min(rule.failures(beliefs))
                    if failed == 0 and rule.default:
                        failed = 1  # what speaks against the default
                    expected.append((failed, number))
            assert not node.holds
            assert [int(child.axiom.identifier[1:]) for child in node.children if child.axiom] == [
                number for _, number in sorted(expected)
            ]
            for child, (failed, number) in zip(node.children, sorted(expected), strict=True):
                rule = world.rules[number - 1]
                against = rule.default and min(rule.failures(beliefs)) == 0
                assert sum(not condition.holds for condition in child.children) == failed - against
                assert len(child.children) == len(rule.body) + (
                    against and opposite(literal) in beliefs
                )
            assert (node.basis is Basis.UNFOUNDED) == (not expected)


@given(world=worlds())
@example(world=World((Rule("p(S)", ("f(S)",)), Rule("-p(S)", ("g(S, dark)",)))))
@thorough
def test_a_contradiction_names_both_sides(world: World) -> None:
    reasoner = Reasoner(world.knowledge, world.schema)
    for vector in scenes_of(world):
        node = contradiction(reasoner, vector)
        assert (node is not None) == (reasoner.decide(vector).verdict.value == "contradiction")
        if node is not None:
            beliefs = set(map(str, reasoner.believed(vector)))
            both = {belief for belief in beliefs if opposite(belief) in beliefs}
            assert {child.literal.replace(", ", ",") for child in node.children} == both
            assert node.basis is Basis.CONFLICT


# Golden texts

BLOCKS = """\
#sort structure.
#sort num = 1..5.
#sort width = {wide, narrow}.
#static num_blocks(structure, num).
#static base(structure, width).
#static lean(structure).
#static block_displaced(structure).
#static stable(structure).
"""
STABILITY = """
%% a block that is not balanced on the one below it falls
-stable(S) if block_displaced(S).

%% two blocks that do not lean stay where they are
stable(S) if num_blocks(S, 2), not lean(S).

%% a wide base carries what stands straight
stable(S) if base(S, wide), not lean(S), not block_displaced(S).

%% a tall leaning structure on a narrow base topples
-stable(S) if lean(S), base(S, narrow), num_blocks(S, N), N > 3.
"""
FEATURES = ("num_blocks", "base", "lean", "block_displaced")
Ask = Callable[..., str]


def reasoner_of(axioms: str, features: tuple[str, ...] = FEATURES) -> Reasoner:
    knowledge = read_knowledge(BLOCKS + axioms, file="blocks/knowledge.al")
    classes = {"stable": "stable(structure)", "unstable": "-stable(structure)"}
    return Reasoner(knowledge, schema_of(knowledge, features, classes, scene="structure"))


def tree(axioms: str, literal: str, *vector: str | None) -> str:
    node = why(reasoner_of(axioms), vector, read_literal(literal))
    assert node is not None
    return node.to_text()


def refuted(axioms: str, literal: str, *vector: str | None) -> str:
    return why_not(reasoner_of(axioms), vector, read_literal(literal)).to_text()


def test_one_reason() -> None:
    assert tree(STABILITY, "-stable(structure)", "3", "wide", None, "yes") == (
        '-stable(structure): "a block that is not balanced on the one below it falls" '
        "(knowledge.al:11)\n"
        "└─ block_displaced(structure)"
    )


def test_several_reasons_negation_as_failure_and_what_is_not_known() -> None:
    assert tree(STABILITY, "stable(structure)", "2", "wide", None, "no") == (
        "stable(structure)\n"
        '├─ stable(structure): "two blocks that do not lean stay where they are" '
        "(knowledge.al:14)\n"
        "│  ├─ num_blocks(structure, 2)\n"
        "│  └─ nothing says that lean(structure)\n"
        '└─ stable(structure): "a wide base carries what stands straight" (knowledge.al:17)\n'
        "   ├─ base(structure, wide)\n"
        "   ├─ nothing says that lean(structure)\n"
        "   └─ -block_displaced(structure)"
    )


def test_a_comparison_is_a_reason_of_its_own() -> None:
    assert tree(STABILITY, "-stable(structure)", "4", "narrow", "yes", "no") == (
        '-stable(structure): "a tall leaning structure on a narrow base topples" '
        "(knowledge.al:20)\n"
        "├─ lean(structure)\n"
        "├─ base(structure, narrow)\n"
        "├─ num_blocks(structure, 4)\n"
        "└─ 4 > 3"
    )


def test_a_chain_through_an_intermediate_concept() -> None:
    axioms = """
#static tall(structure).
#static shaky(structure).
%% more than three blocks are tall
tall(S) if num_blocks(S, N), N > 3.
%% what is tall and narrow is shaky
shaky(S) if tall(S), -base(S, wide).
%% what is shaky falls
-stable(S) if shaky(S).
"""
    assert tree(axioms, "-stable(structure)", "5", "narrow", None, None) == (
        '-stable(structure): "what is shaky falls" (knowledge.al:17)\n'
        '└─ shaky(structure): "what is tall and narrow is shaky" (knowledge.al:15)\n'
        '   ├─ tall(structure): "more than three blocks are tall" (knowledge.al:13)\n'
        "   │  ├─ num_blocks(structure, 5)\n"
        "   │  └─ 5 > 3\n"
        "   └─ base(structure, narrow)"
    )
    assert refuted(axioms, "-stable(structure)", "2", "narrow", None, None) == (
        "it does not follow that -stable(structure)\n"
        '└─ does not apply: "what is shaky falls" (knowledge.al:17)\n'
        "   └─ it does not follow that shaky(structure)\n"
        '      └─ does not apply: "what is tall and narrow is shaky" (knowledge.al:15)\n'
        "         ├─ it does not follow that tall(structure)\n"
        '         │  └─ does not apply: "more than three blocks are tall" (knowledge.al:13)\n'
        "         │     ├─ num_blocks(structure, 2)\n"
        "         │     └─ but num_blocks(structure, 2), and not 2 > 3\n"
        "         └─ base(structure, narrow)"
    )


def test_a_circle_is_no_reason() -> None:
    axioms = """
#static safe(structure).
safe(S) if stable(S).
stable(S) if safe(S).
stable(S) if base(S, wide).
"""
    assert tree(axioms, "safe(structure)", None, "wide", None, None) == (
        'safe(structure): "safe(S) if stable(S)" (knowledge.al:11)\n'
        '└─ stable(structure): "stable(S) if base(S, wide)" (knowledge.al:13)\n'
        "   └─ base(structure, wide)"
    )
    reasoner = reasoner_of(axioms)
    nothing = (None, "narrow", None, None)
    assert why(reasoner, nothing, read_literal("safe(structure)")) is None
    assert why(reasoner, nothing, read_literal("stable(structure)")) is None


def test_an_anonymous_condition_is_met_by_what_is_not_circular() -> None:
    axioms = """
#sort side = {a, b}.
#static carries(structure, side).
carries(S, a) if stable(S).
carries(S, b) if base(S, wide).
stable(S) if carries(S, _).
"""
    assert tree(axioms, "stable(structure)", None, "wide", None, None) == (
        'stable(structure): "stable(S) if carries(S, _)" (knowledge.al:14)\n'
        '└─ carries(structure, b): "carries(S, b) if base(S, wide)" (knowledge.al:13)\n'
        "   └─ base(structure, wide)"
    )


def test_a_condition_that_stands_for_several_terms() -> None:
    axioms = "stable(S) if num_blocks(S, 1..2)."
    assert tree(axioms, "stable(structure)", "2", None, None, None) == (
        'stable(structure): "stable(S) if num_blocks(S, (1..2))" '
        "(knowledge.al:9)\n"
        "└─ num_blocks(structure, 2)"
    )
    assert refuted(axioms, "stable(structure)", "4", None, None, None) == (
        "it does not follow that stable(structure)\n"
        '└─ does not apply: "stable(S) if num_blocks(S, (1..2))" '
        "(knowledge.al:9)\n"
        "   └─ but num_blocks(structure, 4)"
    )


def test_an_aggregate_rests_on_what_it_counts() -> None:
    axioms = "stable(S) if structure(S), N = #count { M : num_blocks(S, M) }, N > 0, not lean(S)."
    assert tree(axioms, "stable(structure)", "2", None, "no", None).splitlines()[1:] == [
        "├─ for exactly 1 value of num, num_blocks(structure, num)",
        "│  └─ num_blocks(structure, 2)",
        "├─ 1 > 0",
        "└─ -lean(structure)",
    ]
    assert refuted(axioms, "stable(structure)", None, None, "no", None).splitlines()[2:] == [
        "   ├─ for exactly 0 values of num, num_blocks(structure, num)",
        "   │  └─ the num blocks is not known",
        "   ├─ but 0 > 0",
        "   └─ -lean(structure)",
    ]


def test_a_default_and_its_exception() -> None:
    axioms = """
%% structures stand
default stable(S) if structure(S).
%% what is out of balance falls
-stable(S) if block_displaced(S).
"""
    assert tree(axioms, "stable(structure)", *[None] * 4) == (
        'stable(structure): "structures stand" (knowledge.al:11)\n'
        "└─ nothing says that -stable(structure)\n"
        '   └─ does not apply: "what is out of balance falls" (knowledge.al:13)\n'
        "      └─ but it is not known whether block_displaced(structure)"
    )
    assert refuted(axioms, "stable(structure)", None, None, None, "yes") == (
        "it does not follow that stable(structure)\n"
        '└─ does not apply: "structures stand" (knowledge.al:11)\n'
        '   └─ -stable(structure): "what is out of balance falls" (knowledge.al:13)\n'
        "      └─ block_displaced(structure)"
    )


def test_a_default_given_up_for_consistency() -> None:
    axioms = """
%% structures stand
default stable(S) if structure(S).
%% what stands has all blocks in place
-block_displaced(S) if stable(S).
"""
    assert tree(axioms, "-stable(structure)", None, None, None, "yes") == (
        "-stable(structure): an exception, without which the beliefs would contradict each other: "
        '"structures stand" (knowledge.al:11)\n'
        "├─ block_displaced(structure)\n"
        '└─ otherwise -block_displaced(structure): "what stands has all blocks in place" '
        "(knowledge.al:13)"
    )


def test_where_a_double_negation_chooses_each_choice_is_told_and_their_features_suffice() -> None:
    axioms = """
#static sound(structure).
sound(S) if structure(S), not not sound(S).
stable(S) if sound(S), lean(S).
stable(S) if structure(S), not sound(S).
"""
    assert tree(axioms, "stable(structure)", None, None, "yes", None) == (
        "stable(structure), whichever is so\n"
        '├─ either stable(structure): "stable(S) if sound(S), lean(S)" (knowledge.al:12)\n'
        '│  ├─ sound(structure): "sound(S) if structure(S), not not sound(S)" (knowledge.al:11)\n'
        "│  │  └─ supposing that sound(structure)\n"
        "│  └─ lean(structure)\n"
        '└─ or stable(structure): "stable(S) if structure(S), not sound(S)" (knowledge.al:13)\n'
        "   └─ supposing that nothing says that sound(structure)"
    )


def test_a_belief_that_only_a_double_negation_of_itself_concludes_is_supposed() -> None:
    axioms = """
#static sound(structure).
sound(S) if structure(S), not not sound(S).
sound(S) if structure(S), not sound(S).
stable(S) if sound(S), lean(S).
"""
    assert tree(axioms, "stable(structure)", None, None, "yes", None) == (
        'stable(structure): "stable(S) if sound(S), lean(S)" (knowledge.al:13)\n'
        '├─ sound(structure): "sound(S) if structure(S), not not sound(S)" (knowledge.al:11)\n'
        "│  └─ supposing that sound(structure)\n"
        "└─ lean(structure)"
    )


def test_literals_are_supposed_where_a_sum_settles_nothing_without_what_it_concludes() -> None:
    axioms = """
#sort weight = {-1, 1}.
#static load(structure, weight).
load(S, 1) if load(S, -1).
load(S, -1) if load(S, 1).
load(S, 1) if structure(S), #sum { W : load(S, W) } >= 0.
"""
    assert tree(axioms, "load(structure, -1)", *[None] * 4) == (
        'load(structure, -1): "load(S, -1) if load(S, 1)" (knowledge.al:13)\n'
        '└─ load(structure, 1): "load(S, 1) if structure(S), 0 <= #sum { W: load(S,W) }" '
        "(knowledge.al:14)\n"
        "   └─ the sum of weight where load(structure, weight) is at least 0\n"
        "      └─ supposing that load(structure, 1)"
    )


def test_absences_that_wait_for_each_other_are_settled_through_an_aggregate() -> None:
    axioms = """
#static sound(structure).
sound(S) if structure(S), #count { T : sound(T) } > 0.
stable(S) if structure(S), not sound(S).
"""
    assert tree(axioms, "stable(structure)", *[None] * 4) == (
        'stable(structure): "stable(S) if structure(S), not sound(S)" (knowledge.al:12)\n'
        "└─ nothing says that sound(structure)"
    )


def test_why_not_puts_the_nearest_axiom_first() -> None:
    assert refuted(STABILITY, "stable(structure)", "3", "wide", "no", "yes") == (
        "it does not follow that stable(structure)\n"
        '├─ does not apply: "two blocks that do not lean stay where they are" (knowledge.al:14)\n'
        "│  ├─ but num_blocks(structure, 3)\n"
        "│  └─ -lean(structure)\n"
        '└─ does not apply: "a wide base carries what stands straight" (knowledge.al:17)\n'
        "   ├─ base(structure, wide)\n"
        "   ├─ -lean(structure)\n"
        "   └─ but block_displaced(structure)"
    )
    assert refuted(STABILITY, "-stable(structure)", "3", None, "yes", "no") == (
        "it does not follow that -stable(structure)\n"
        '├─ does not apply: "a block that is not balanced on the one below it falls" '
        "(knowledge.al:11)\n"
        "│  └─ but -block_displaced(structure)\n"
        '└─ does not apply: "a tall leaning structure on a narrow base topples" '
        "(knowledge.al:20)\n"
        "   ├─ lean(structure)\n"
        "   ├─ but it is not known whether base(structure, narrow)\n"
        "   ├─ num_blocks(structure, 3)\n"
        "   └─ but num_blocks(structure, 3), and not 3 > 3"
    )


def test_why_not_of_what_no_axiom_concludes() -> None:
    assert refuted("-stable(S) if lean(S).", "stable(structure)", *[None] * 4) == (
        "it does not follow that stable(structure)"
    )


def test_why_not_of_a_computed_head_looks_at_the_number_asked_for() -> None:
    axioms = """
#static weight(structure, num).
weight(S, N + 1) if num_blocks(S, N).
"""
    assert refuted(axioms, "weight(structure, 4)", "2", None, None, None) == (
        "it does not follow that weight(structure, 4)\n"
        '└─ does not apply: "weight(S, (N+1)) if num_blocks(S, N)" (knowledge.al:11)\n'
        "   └─ but num_blocks(structure, 2)"
    )
    reasoner = reasoner_of(axioms)
    node = why_not(reasoner, ("2", None, None, None), read_literal("weight(structure, 4)"))
    assert node.children[0].children[0].literal == "num_blocks(structure, 3)"


def test_why_not_where_a_condition_computes() -> None:
    axioms = "stable(S) if num_blocks(S, N - 1), N < 3, M = N * 2, M > 9, lean(S)."
    assert refuted(axioms, "stable(structure)", "2", None, "no", None) == (
        "it does not follow that stable(structure)\n"
        '└─ does not apply: "stable(S) if num_blocks(S, (N-1)), N < 3, M = (N*2), M > 9, lean(S)" '
        "(knowledge.al:9)\n"
        "   ├─ num_blocks(structure, 2)\n"
        "   ├─ but num_blocks(structure, 2), and not 3 < 3\n"
        "   ├─ 6 = (3*2)\n"
        "   ├─ but 6 > 9\n"
        "   └─ but -lean(structure)"
    )


def test_why_not_where_there_is_no_answer_set_keeps_what_is_seen() -> None:
    axioms = """
#static odd(structure).
odd(S) if lean(S), not odd(S).
stable(S) if base(S, wide), odd(S).
"""
    assert refuted(axioms, "stable(structure)", None, "wide", "yes", None) == (
        "it does not follow that stable(structure)\n"
        '└─ does not apply: "stable(S) if base(S, wide), odd(S)" (knowledge.al:12)\n'
        "   ├─ base(structure, wide)\n"
        "   └─ it does not follow that odd(structure)\n"
        '      └─ does not apply: "odd(S) if lean(S), not odd(S)" (knowledge.al:11)\n'
        "         ├─ lean(structure)\n"
        "         └─ nothing says that odd(structure)"
    )


def test_a_contradiction_reads_as_two_justifications() -> None:
    reasoner = reasoner_of(STABILITY)
    node = contradiction(reasoner, ("2", None, "no", "yes"))
    assert node is not None
    assert node.to_text() == (
        "the knowledge contradicts itself here\n"
        '├─ stable(structure): "two blocks that do not lean stay where they are" '
        "(knowledge.al:14)\n"
        "│  ├─ num_blocks(structure, 2)\n"
        "│  └─ -lean(structure)\n"
        '└─ -stable(structure): "a block that is not balanced on the one below it falls" '
        "(knowledge.al:11)\n"
        "   └─ block_displaced(structure)"
    )
    assert contradiction(reasoner, ("2", None, "no", "no")) is None


def test_literals_are_said_in_the_words_given() -> None:
    def say(literal: Literal) -> str:
        words = {"lean": "it leans", "stable": "it stands", "num_blocks": "it has two blocks"}
        return words[literal.predicate] if literal.positive else f"not: {words[literal.predicate]}"

    vector = ("2", None, "no", None)
    node = why(reasoner_of(STABILITY), vector, read_literal("stable(structure)"), say=say)
    assert node is not None
    assert node.to_text() == (
        'it stands: "two blocks that do not lean stay where they are" (knowledge.al:14)\n'
        "├─ it has two blocks\n"
        "└─ not: it leans"
    )


# The tree for programs


def test_the_tree_as_values_for_json() -> None:
    node = why(reasoner_of(STABILITY), ("3", None, None, "yes"), read_literal("-stable(structure)"))
    assert node is not None
    assert node.with_probabilities({"block_displaced": ("yes", 0.9712)}).to_dict() == {
        "literal": "-stable(structure)",
        "text": "-stable(structure)",
        "basis": "axiom",
        "holds": True,
        "axiom": {
            "identifier": "a1",
            "text": "a block that is not balanced on the one below it falls",
            "statement": "-stable(S) if block_displaced(S).",
            "file": "blocks/knowledge.al",
            "line": 11,
            "learned": False,
            "support": None,
        },
        "feature": None,
        "value": None,
        "probability": None,
        "overruled": None,
        "children": [
            {
                "literal": "block_displaced(structure)",
                "text": "block_displaced(structure)",
                "basis": "feature",
                "holds": True,
                "axiom": None,
                "feature": "block_displaced",
                "value": "yes",
                "probability": 0.9712,
                "overruled": None,
                "children": [],
            }
        ],
    }


def test_probabilities_stand_behind_the_features_only() -> None:
    node = why(reasoner_of(STABILITY), ("2", "wide", "no", "no"), read_literal("stable(structure)"))
    assert node is not None
    assert node.features() == ("num_blocks", "lean", "base", "block_displaced")
    text = node.with_probabilities({"lean": ("no", 0.876), "base": ("wide", 1.0)}).to_text()
    assert [line for line in text.splitlines() if "(p = " in line] == [
        "│  └─ -lean(structure) (p = 0.88)",
        "   ├─ base(structure, wide) (p = 1.00)",
        "   ├─ -lean(structure) (p = 0.88)",
    ]


@pytest.mark.parametrize("literal", ["stable(structure)", "-lean(structure)"])
def test_what_is_not_believed_has_no_justification(literal: str) -> None:
    assert why(reasoner_of(STABILITY), (None,) * 4, read_literal(literal)) is None
