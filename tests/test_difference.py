"""How a scene differs from those of a class: what would have to be seen, and what is seen."""

from __future__ import annotations

import pytest

from conftest import seen
from seewhy.agent.agent import Agent
from seewhy.dialogue.answer import AnswerType, word_answer
from seewhy.dialogue.learned import answer_form
from seewhy.dialogue.question import Asks, Question
from seewhy.dialogue.reply import Reply
from seewhy.domain.domain import Domain
from seewhy.evaluation import EXPLANATORY, score_answer
from seewhy.knowledge.change import ChangeFinder
from signs_builder import FOUR, trained_signs


@pytest.fixture(scope="module")
def signs(tmp_path_factory: pytest.TempPathFactory) -> Agent:
    """Four signs; scenes of the one that the knowledge leaves open trained the tree."""
    return trained_signs(tmp_path_factory.getbasetemp())


TREE_SAYS = (
    "The decision tree says: of the signs that no rule decides, if the sign shows the symbol "
    "symbol 0, then it is a no entry (1 of 7 features tested, 100 % of 10 signs)"
)
"""Of the sign that no axiom concludes."""


def ask(agent: Agent, vector: tuple[str | None, ...], question: str) -> Reply:
    return agent.answer(seen(agent, *vector), agent.questions.understand(question))


def differs(label: str) -> Question:
    return Question(asks=Asks.DIFFERENCE_TO_CLASS, text="", words=(), label=label)


@pytest.mark.parametrize(
    ("sign", "question", "text"),
    [
        (
            "uneven_road",
            "how does it differ from a stop sign?",
            # All stop signs are mainly red, too, which no axiom asks.
            "A stop sign is octagon, and it shows the symbol stop; the sign is triangle, and it "
            "shows the symbol bumpy road.",
        ),
        (
            "stop_sign",
            "how is the sign unlike a give way",
            "A give way is inverted triangle, and it shows the symbol blank; the sign is octagon, "
            "and it shows the symbol stop.",
        ),
        ("stop_sign", "how does it differ from a stop sign?", "The sign is a stop sign."),
        (
            "stop_sign",
            "how does it differ from a no entry?",
            "Nothing that is known says when the sign is a no entry. All 10 signs of training that "
            "are a no entry share this: the sign is circle, it has a red border, and it shows the "
            "symbol symbol 0; here it is octagon, it has a white border, and it shows the symbol "
            f"stop. {TREE_SAYS}.",
        ),
    ],
)
def test_the_difference_in_words(signs: Agent, sign: str, question: str, text: str) -> None:
    reply = ask(signs, FOUR[sign], question)
    assert (reply.text, reply.method) == (text, "knowledge")


@pytest.mark.parametrize(
    ("question", "text"),
    [
        (
            "what would make it a no entry?",
            f"Nothing that is known would make the sign a no entry. {TREE_SAYS}.",
        ),
        (
            "why is it not a no entry?",
            f"Nothing that is known concludes that the sign is a no entry. {TREE_SAYS}.",
        ),
        (
            "why is it a stop sign rather than a no entry?",
            "The sign is a stop sign, since it is octagon, and it shows the symbol stop and the "
            "plate none; nothing that is known concludes a no entry; t" + TREE_SAYS[1:] + ".",
        ),
    ],
)
def test_of_a_class_that_only_the_tree_knows_the_tree_speaks(
    signs: Agent, question: str, text: str
) -> None:
    reply = ask(signs, FOUR["stop_sign"], question)
    assert (reply.text, reply.method) == (text, "knowledge")


def test_what_the_tree_says_is_explained(signs: Agent) -> None:
    reply = ask(signs, FOUR["stop_sign"], "what would make it a no entry?")
    assert reply.justification.to_text().splitlines()[-1] == f"└─ t{TREE_SAYS[1:]}"
    scene = seen(signs, *FOUR["stop_sign"])
    explain = signs.questions.understand("explain")
    assert signs.answer(scene, explain, previous=reply).text == (
        f"You asked: what would make the sign a no entry? {TREE_SAYS}."
    )


@pytest.mark.parametrize(
    ("vector", "label", "text"),
    [
        (
            ("5", "narrow", "yes", "no"),
            "stable",
            "The structure is stable when it has a wide base, and it is standing straight; here it "
            "has a narrow base, and it leans to one side.",
        ),
        (
            ("3", "wide", "no", "yes"),
            "stable",
            "The structure is stable when no block is displaced; here a block is displaced.",
        ),
        (
            (None, None, "yes", "yes"),
            "stable",
            "The structure is stable when it has two blocks, it is standing straight, and no "
            "block is displaced; here it leans to one side, and a block is displaced.",
        ),
    ],
)
def test_the_wording_of_a_domain_that_says_nothing_else(
    reasoning: Agent, vector: tuple[str | None, ...], label: str, text: str
) -> None:
    kind = reasoning.reasoned.kind(differs(label), vector, "unstable")
    kind = AnswerType(kind.form, kind.mentions, kind.changes[:1])
    said = word_answer(reasoning.domain, differs(label), kind, vector=vector, label="unstable")
    if vector[0] is None:
        # Which of the unknown features is to have a value is one of several smallest changes.
        assert said.startswith("The structure is stable when it")
        assert said.endswith("here it leans to one side, and a block is displaced.")
    else:
        assert said == text


def test_what_is_not_known_is_not_said_to_be_otherwise(structures: Domain) -> None:
    kind = AnswerType("difference", ("base",), ((("base", "wide"),),))
    said = word_answer(structures, differs("stable"), kind, vector=(None,) * 4, label="unstable")
    assert said == "The structure is stable when it has a wide base."


def test_several_smallest_differences(structures: Domain) -> None:
    kind = AnswerType("difference", ("base", "lean"), ((("base", "wide"),), (("lean", "no"),)))
    vector = ("5", "narrow", "yes", "no")
    assert word_answer(structures, differs("stable"), kind, vector=vector, label="unstable") == (
        "The structure is stable when it has a wide base, or it is standing straight; here it has "
        "a narrow base, and it leans to one side."
    )


def test_a_difference_is_the_smallest_change(reasoning: Agent) -> None:
    """For every structure that the knowledge decides, by the finder that other tests check."""
    finder = ChangeFinder(reasoning.reasoner)
    features = reasoning.domain.features
    checked = 0
    for base in features["base"].values:
        for displaced in features["block_displaced"].values:
            vector = ("4", base, "yes", displaced)
            label = reasoning.reasoner.decide(vector).label
            if label is None:
                continue
            other = "stable" if label == "unstable" else "unstable"
            kind = reasoning.reasoned.kind(differs(other), vector, label)
            found = finder.smallest(vector, other)
            assert [dict(change) for change in kind.changes] == [
                {part.feature: part.after for part in change.changes} for change in found
            ]
            changed = {feature for change in kind.changes for feature, _ in change}
            assert kind.mentions == tuple(feature for feature in features if feature in changed)
            checked += 1
    assert checked >= 3


def test_a_difference_is_justified_by_what_fails_and_what_would_follow(signs: Agent) -> None:
    node = ask(signs, FOUR["uneven_road"], "how does it differ from a stop sign?").justification
    assert node.text == "it does not follow that the sign is a stop sign"
    assert [child.text for child in node.children] == [
        "the sign is a stop sign",
        "with this change, the sign is a stop sign",
    ]
    assert [child.holds for child in node.children] == [False, True]
    explain = signs.questions.understand("explain")
    scene = seen(signs, *FOUR["uneven_road"])
    reply = signs.answer(scene, signs.questions.understand("how is it unlike a stop sign"))
    told = signs.answer(scene, explain, previous=reply).text
    assert "With this change, the sign is a stop sign, because" in told


# Learned --------------------------------------------------------------------------------------


def test_a_difference_is_learned_where_the_tree_decides(signs: Agent) -> None:
    reply = ask(signs, FOUR["no_entry"], "how does it differ from a stop sign?")
    assert reply.method == "tree"
    assert reply.text == (
        "A stop sign is octagon, and it shows the symbol stop; the sign is circle, and it shows "
        "the symbol symbol 0."
    )
    gold = signs.reference.answer(reply.question, FOUR["no_entry"], "no_entry")
    assert reply.kind == gold
    same = ask(signs, FOUR["no_entry"], "how does it differ from a no entry?")
    assert (same.text, same.kind) == ("The sign is a no entry.", AnswerType("same"))


def test_a_reference_has_one_alternative_where_a_network_must_learn_it(reasoning: Agent) -> None:
    for vector in (("5", "narrow", "no", "no"), ("4", "narrow", "no", "no")):
        assert reasoning.reasoner.decide(vector).label is None
        gold = reasoning.reference.answer(differs("unstable"), vector, "stable")
        all_of_them = reasoning.reasoned.kind(differs("unstable"), vector, "stable")
        assert gold.changes == all_of_them.changes[:1]
        assert gold.mentions == tuple(feature for feature, _ in gold.changes[0])


def test_both_ways_of_answering_have_the_same_forms(signs: Agent) -> None:
    for sign in ("uneven_road", "give_way"):
        for question in signs.questions.one_of_each():
            if question.asks in (Asks.EXPLAIN, Asks.BELIEF_VALUE):
                continue
            kind = signs.reasoned.kind(question, FOUR[sign], sign)
            expected = answer_form(signs.domain, question, FOUR[sign], sign)
            assert kind.form in (expected, f"no_{expected}"), question.text
            assert signs.reasoned.answer(question, FOUR[sign], sign).kind == kind


# Scoring --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("difference(lean)[lean=no]", (True, True)),
        ("difference(base,lean)[lean=no][base=wide]", (True, False)),
        ("difference(base)[base=wide]", (False, False)),
        ("no_difference()", (False, False)),
        ("change()[lean=no]", (False, False)),
    ],
)
def test_a_difference_is_scored_as_a_change_is(given: str, expected: tuple[bool, bool]) -> None:
    values: dict[str, str | None] = {"lean": "yes", "base": "narrow"}
    gold = AnswerType.parse("difference(lean)[lean=no]")
    scored = score_answer(AnswerType.parse(given), gold, seen=values, true=values, right_class=True)
    assert scored == expected
    assert Asks.DIFFERENCE_TO_CLASS in EXPLANATORY
