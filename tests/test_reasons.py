"""Reasons that rest on more than plain literals read as golden text, and name what is behind."""

from __future__ import annotations

from dataclasses import replace

import pytest

from knowledge_builders import schema_of
from seewhy.dialogue.answer import word_answer
from seewhy.dialogue.certainty import Ground, weakest
from seewhy.dialogue.question import Questions
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.domain.domain import Domain, load_domain
from seewhy.knowledge.language import read_knowledge, read_literal
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not

BLOCKS = """\
#sort structure.
#sort num = 1..5.
#sort width = {wide, narrow}.
#sort flaw = {tilt, slip, gap}.
#static num_blocks(structure, num).
#static base(structure, width).
#static lean(structure).
#static block_displaced(structure).
#static stable(structure).
#static sound(structure).
#static shows(structure, flaw).
"""
FLAWS = """
%% what leans is tilted
shows(S, tilt) if lean(S).
%% a displaced block slips
shows(S, slip) if block_displaced(S).
"""
FEATURES = ("num_blocks", "base", "lean", "block_displaced")


def reasoner_of(axioms: str) -> Reasoner:
    knowledge = read_knowledge(BLOCKS + axioms, file="blocks/knowledge.al")
    classes = {"stable": "stable(structure)", "unstable": "-stable(structure)"}
    return Reasoner(knowledge, schema_of(knowledge, FEATURES, classes, scene="structure"))


def tree(axioms: str, literal: str, *vector: str | None) -> str:
    node = why(reasoner_of(axioms), vector, read_literal(literal))
    assert node is not None
    return node.to_text()


def refuted(axioms: str, literal: str, *vector: str | None) -> str:
    return why_not(reasoner_of(axioms), vector, read_literal(literal)).to_text()


# Conditions of several literals


def test_an_aggregate_rests_on_the_literals_that_it_needs() -> None:
    axioms = f"{FLAWS}%% two flaws are too many\n-stable(S) if #count {{ F : shows(S, F) }} >= 2."
    axioms = axioms.replace("if #count", "if structure(S), #count")
    assert tree(axioms, "-stable(structure)", "3", "wide", "yes", "yes") == (
        '-stable(structure): "two flaws are too many" (knowledge.al:18)\n'
        "└─ for at least 2 values of flaw, shows(structure, flaw)\n"
        '   ├─ shows(structure, slip): "a displaced block slips" (knowledge.al:16)\n'
        "   │  └─ block_displaced(structure)\n"
        '   └─ shows(structure, tilt): "what leans is tilted" (knowledge.al:14)\n'
        "      └─ lean(structure)"
    )
    assert refuted(axioms, "-stable(structure)", "3", "wide", "yes", "no") == (
        "it does not follow that -stable(structure)\n"
        '└─ does not apply: "two flaws are too many" (knowledge.al:18)\n'
        "   └─ but for fewer than 2 values of flaw, shows(structure, flaw)\n"
        "      └─ nothing says that shows(structure, slip)\n"
        '         └─ does not apply: "a displaced block slips" (knowledge.al:16)\n'
        "            └─ but -block_displaced(structure)"
    )


def test_a_conditional_literal_rests_on_what_settles_it() -> None:
    axioms = """
#static good(width).
%% wide is good
good(wide).
%% every base that it has is good
stable(S) if structure(S); good(W) : base(S, W).
"""
    assert tree(axioms, "stable(structure)", None, "wide", None, None) == (
        'stable(structure): "every base that it has is good" (knowledge.al:17)\n'
        "└─ good(width) whenever base(structure, width)\n"
        '   ├─ good(wide): "wide is good" (knowledge.al:15)\n'
        "   └─ base(structure, wide)"
    )
    assert refuted(axioms, "stable(structure)", None, "narrow", None, None) == (
        "it does not follow that stable(structure)\n"
        '└─ does not apply: "every base that it has is good" (knowledge.al:17)\n'
        "   └─ but it is not so that good(width) whenever base(structure, width)\n"
        "      └─ base(structure, narrow)"
    )


def test_what_is_doubly_denied_rests_on_what_is_so() -> None:
    axioms = "%% what leans falls\n-stable(S) if structure(S), not not lean(S)."
    assert tree(axioms, "-stable(structure)", None, None, "yes", None) == (
        '-stable(structure): "what leans falls" (knowledge.al:13)\n└─ lean(structure)'
    )
    assert refuted(axioms, "-stable(structure)", None, None, "no", None) == (
        "it does not follow that -stable(structure)\n"
        '└─ does not apply: "what leans falls" (knowledge.al:13)\n'
        "   └─ but -lean(structure)"
    )


# What is absent

OTHERS = """
%% what stands straight on a wide base is stable
stable(S) if base(S, wide), not lean(S).
%% all others fall
-stable(S) if structure(S), not stable(S).
"""


def test_an_absence_rests_on_every_way_in_which_axioms_fail() -> None:
    assert tree(OTHERS, "-stable(structure)", None, "narrow", "yes", None) == (
        '-stable(structure): "all others fall" (knowledge.al:16)\n'
        "└─ nothing says that stable(structure)\n"
        '   └─ does not apply: "what stands straight on a wide base is stable" (knowledge.al:14)\n'
        "      ├─ but base(structure, narrow)\n"
        "      └─ but lean(structure)"
    )


def test_what_is_in_the_way_is_told_with_its_own_reasons() -> None:
    assert refuted(OTHERS, "-stable(structure)", None, "wide", "no", None) == (
        "it does not follow that -stable(structure)\n"
        '└─ does not apply: "all others fall" (knowledge.al:16)\n'
        "   └─ but stable(structure): "
        '"what stands straight on a wide base is stable" (knowledge.al:14)\n'
        "      ├─ base(structure, wide)\n"
        "      └─ -lean(structure)"
    )


def test_absences_that_wait_for_each_other_are_told_once() -> None:
    axioms = """
sound(S) if stable(S).
stable(S) if sound(S).
stable(S) if base(S, wide).
-block_displaced(S) if structure(S), not sound(S).
"""
    assert tree(axioms, "-block_displaced(structure)", None, "narrow", None, None) == (
        '-block_displaced(structure): "-block_displaced(S) if structure(S), not sound(S)" '
        "(knowledge.al:16)\n"
        "└─ nothing says that sound(structure)\n"
        '   └─ does not apply: "sound(S) if stable(S)" (knowledge.al:13)\n'
        "      └─ it does not follow that stable(structure)\n"
        '         ├─ does not apply: "stable(S) if sound(S)" (knowledge.al:14)\n'
        "         │  └─ it does not follow that sound(structure)\n"
        '         └─ does not apply: "stable(S) if base(S, wide)" (knowledge.al:15)\n'
        "            └─ but base(structure, narrow)"
    )


def test_the_surest_of_the_ways_in_which_an_axiom_fails_is_enough() -> None:
    node = why(
        reasoner_of(OTHERS), (None, "narrow", "yes", None), read_literal("-stable(structure)")
    )
    assert node is not None
    seen = node.with_probabilities({"base": ("narrow", 0.6), "lean": ("yes", 0.8)})
    assert weakest(seen) == Ground("lean", "yes", 0.8)


# Defaults and exceptions

USUAL = """
%% structures are usually sound
default sound(S) if structure(S).
%% what is sound does not lean
-lean(S) if sound(S).
%% sound is stable
stable(S) if sound(S).
%% what is not sound falls
-stable(S) if -sound(S).
"""


def test_an_exception_names_what_would_contradict_each_other() -> None:
    assert tree(USUAL, "-stable(structure)", None, None, "yes", None) == (
        '-stable(structure): "what is not sound falls" (knowledge.al:20)\n'
        "└─ -sound(structure): an exception, without which the beliefs would contradict each "
        'other: "structures are usually sound" (knowledge.al:14)\n'
        "   ├─ lean(structure)\n"
        '   └─ otherwise -lean(structure): "what is sound does not lean" (knowledge.al:16)'
    )


def test_a_default_rests_on_what_makes_an_exception_needless() -> None:
    assert tree(USUAL, "stable(structure)", None, None, "no", None) == (
        'stable(structure): "sound is stable" (knowledge.al:18)\n'
        '├─ sound(structure): "structures are usually sound" (knowledge.al:14)\n'
        "└─ nothing else would agree with what is known\n"
        "   └─ -lean(structure)"
    )


NO_CIRCLES = {
    "the opposite of a default is absent because of an exception that the belief forces": (
        """
default sound(S) if structure(S).
stable(S) if sound(S).
-stable(S) if lean(S).
default -stable(S) if base(S, narrow).
""",
        "-stable(structure)",
        ("3", "narrow", "yes", None),
        '-stable(structure): "-stable(S) if lean(S)" (knowledge.al:15)\n└─ lean(structure)',
    ),
    "an exception that the belief forces": (
        """
default stable(S) if structure(S).
-sound(S) if stable(S).
sound(S) if base(S, wide).
sound(S) if -stable(S).
""",
        "sound(structure)",
        (None, "wide", None, None),
        'sound(structure): "sound(S) if base(S, wide)" (knowledge.al:15)\n└─ base(structure, wide)',
    ),
    "an exception that the belief forces by another belief": (
        """
default stable(S) if structure(S).
-shows(S, gap) if stable(S).
shows(S, gap) if sound(S).
sound(S) if base(S, wide).
sound(S) if shows(S, tilt).
shows(S, tilt) if -stable(S).
""",
        "sound(structure)",
        (None, "wide", None, None),
        'sound(structure): "sound(S) if base(S, wide)" (knowledge.al:16)\n└─ base(structure, wide)',
    ),
    "an exception to a default whose condition the belief is": (
        """
default stable(S) if sound(S).
-lean(S) if stable(S).
sound(S) if base(S, wide).
sound(S) if -stable(S).
""",
        "sound(structure)",
        (None, "wide", "yes", None),
        'sound(structure): "sound(S) if base(S, wide)" (knowledge.al:15)\n└─ base(structure, wide)',
    ),
    "an exception that what is seen forces": (
        """
default stable(S) if structure(S).
-lean(S) if stable(S).
lean(S) if -stable(S).
""",
        "lean(structure)",
        (None, None, "yes", None),
        "lean(structure)",
    ),
}


@pytest.mark.parametrize("case", NO_CIRCLES)
def test_no_belief_rests_on_an_exception_that_rests_on_it(case: str) -> None:
    axioms, literal, vector, told = NO_CIRCLES[case]
    assert tree(axioms, literal, *vector) == told


def test_what_rests_on_the_exception_alone_is_kept_with_what_would_be_so_otherwise() -> None:
    axioms = """
default stable(S) if structure(S).
sound(S) if {otherwise}.
sound(S) if -stable(S).
-lean(S) if sound(S), stable(S).
"""
    told = (
        'sound(structure): "sound(S) if -stable(S)" (knowledge.al:15)\n'
        "└─ -stable(structure): an exception, without which the beliefs would contradict each "
        'other: "default stable(S) if structure(S)" (knowledge.al:13)\n'
        "   ├─ lean(structure)\n"
        '   └─ otherwise -lean(structure): "-lean(S) if sound(S), stable(S)" (knowledge.al:16)\n'
        '      └─ otherwise sound(structure): "sound(S) if {otherwise}" (knowledge.al:14)'
    )
    vector = (None, None, "yes", None)
    by_default = axioms.format(otherwise="stable(S)")
    assert tree(by_default, "sound(structure)", *vector) == told.format(otherwise="stable(S)")
    # That nothing says the opposite is so only where the default is not given up.
    condition = "structure(S), not -stable(S)"
    by_absence = axioms.format(otherwise=condition)
    assert tree(by_absence, "sound(structure)", *vector) == (
        f"{told.format(otherwise=condition)}\n"
        "         └─ otherwise nothing says that -stable(structure)"
    )


def test_of_several_reasons_the_contradiction_tells_those_that_are_so_anyway() -> None:
    axioms = """
default stable(S) if structure(S).
sound(S) if stable(S).
sound(S) if base(S, wide).
-lean(S) if sound(S), stable(S).
"""
    assert tree(axioms, "-stable(structure)", None, "wide", "yes", None) == (
        "-stable(structure): an exception, without which the beliefs would contradict each "
        'other: "default stable(S) if structure(S)" (knowledge.al:13)\n'
        "├─ lean(structure)\n"
        '└─ otherwise -lean(structure): "-lean(S) if sound(S), stable(S)" (knowledge.al:16)\n'
        '   └─ sound(structure): "sound(S) if base(S, wide)" (knowledge.al:15)\n'
        "      └─ base(structure, wide)"
    )


# Several answer sets

EITHER = """
%% what does not slip tilts
shows(S, tilt) if lean(S), not shows(S, slip).
%% what does not tilt slips
shows(S, slip) if lean(S), not shows(S, tilt).
"""
BOTH_FALL = f"""{EITHER}
%% what tilts falls
-stable(S) if shows(S, tilt).
%% what slips falls
-stable(S) if shows(S, slip).
"""


def test_a_belief_of_all_answer_sets_has_the_reasons_of_each() -> None:
    assert tree(BOTH_FALL, "-stable(structure)", None, None, "yes", None) == (
        "-stable(structure), whichever is so\n"
        '├─ either -stable(structure): "what slips falls" (knowledge.al:21)\n'
        '│  └─ shows(structure, slip): "what does not tilt slips" (knowledge.al:16)\n'
        "│     ├─ lean(structure)\n"
        "│     └─ supposing that nothing says that shows(structure, tilt)\n"
        '└─ or -stable(structure): "what tilts falls" (knowledge.al:19)\n'
        '   └─ shows(structure, tilt): "what does not slip tilts" (knowledge.al:14)\n'
        "      ├─ lean(structure)\n"
        "      └─ supposing that nothing says that shows(structure, slip)"
    )


def test_what_only_some_answer_sets_have_is_not_believed() -> None:
    reasoner = reasoner_of(EITHER)
    vector = (None, None, "yes", None)
    assert why(reasoner, vector, read_literal("shows(structure, slip)")) is None
    assert {str(literal) for literal in reasoner.believed(vector)} == {"lean(structure)"}
    assert why_not(reasoner, vector, read_literal("shows(structure, slip)")).to_text() == (
        "it does not follow that shows(structure, slip): it may be so or not\n"
        "├─ either it does not follow that shows(structure, slip)\n"
        '│  └─ does not apply: "what does not tilt slips" (knowledge.al:16)\n'
        "│     ├─ lean(structure)\n"
        '│     └─ but shows(structure, tilt): "what does not slip tilts" (knowledge.al:14)\n'
        "│        ├─ lean(structure)\n"
        "│        └─ supposing that nothing says that shows(structure, slip)\n"
        '└─ or shows(structure, slip): "what does not tilt slips" (knowledge.al:16)\n'
        "   ├─ lean(structure)\n"
        "   └─ supposing that nothing says that shows(structure, tilt)"
    )


# Answers


def domain_with(axioms: str) -> Domain:
    domain = load_domain("structure_stability")
    return replace(domain, knowledge=read_knowledge(BLOCKS + axioms))


def answered(domain: Domain, question: str, **values: str) -> str:
    answers = ReasonedAnswers(domain, Reasoner(domain.knowledge, domain.schema))
    vector = domain.vector({"num_blocks": "3", **values})
    label = answers.reasoner.decide(vector).label
    assert label is not None
    understood = Questions(domain).understand(question)
    kind = answers.answer(understood, vector, label).kind
    return word_answer(domain, understood, kind, vector=vector, label=label)


@pytest.mark.parametrize(
    ("axioms", "answer"),
    [
        (OTHERS, "The structure has a narrow base, and it leans to one side."),
        (USUAL, "The structure leans to one side."),
        (BOTH_FALL, "The structure leans to one side."),
    ],
    ids=["absence", "exception", "several answer sets"],
)
def test_answers_name_the_features_behind(axioms: str, answer: str) -> None:
    domain = domain_with(axioms)
    assert answered(domain, "why is it unstable?", base="narrow", lean="yes") == answer


def test_why_not_names_what_a_missing_concept_misses() -> None:
    axioms = """
sound(S) if base(S, wide), not block_displaced(S).
stable(S) if sound(S).
-stable(S) if lean(S), num_blocks(S, 5).
-stable(S) if num_blocks(S, 3).
"""
    domain = domain_with(
        axioms.replace("-stable(S) if num_blocks(S, 3).", "shows(S, gap) if lean(S).")
    )
    answers = ReasonedAnswers(domain, Reasoner(domain.knowledge, domain.schema))
    vector = domain.vector({"num_blocks": "3", "base": "narrow", "block_displaced": "yes"})
    question = Questions(domain).understand("why is it not stable?")
    assert answers.kind(question, vector, "unstable").mentions == ("base", "block_displaced")


def test_a_scene_that_answer_sets_decide_differently_is_told_as_either_or() -> None:
    axioms = f"{EITHER}\nstable(S) if shows(S, tilt).\n-stable(S) if shows(S, slip).\n"
    domain = domain_with(axioms)
    answers = ReasonedAnswers(domain, Reasoner(domain.knowledge, domain.schema))
    node = answers.undecided(domain.vector({"lean": "yes"}))
    assert node.text == (
        "the knowledge does not decide: either the structure is stable or the structure is unstable"
    )
    assert [child.features() for child in node.children] == [("lean",), ("lean",)]
    silent = answers.undecided(domain.vector({"lean": "no"}))
    assert silent.text == "the knowledge does not decide: no axiom concludes a class"
