"""Domains with defaults and statics of their own: golden texts of whole answers."""

from __future__ import annotations

from pathlib import Path

import pytest

from seewhy.agent.agent import Agent
from seewhy.dialogue.answer import AnswerType
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError

DOMAIN = """
[domain]
name = "orchard"
title = "Apples"
subject = "the apple"
scene = "apple"

[features.colour]
name = "colour"
values.red.say = "{it} is red"
values.green.say = "{it} is green"
values.brown.say = "{it} is brown"

[features.mouldy]
name = "mould"
values.yes.say = "{it} is mouldy"
values.no.say = "{it} is without mould"

[classes.good]
literal = "good(apple)"
say = "good"

[classes.bad]
literal = "-good(apple)"
say = "bad"
"""
KNOWLEDGE = """
#sort apple.
#sort shade = {red, green, brown}.
#sort tool = {knife, brush}.
#static colour(apple, shade).
#static mouldy(apple).
#static good(apple).
#static edible(apple).
#static needs(apple, tool).
%% apples are good
default good(A) if apple(A).
%% what is mouldy is bad
-good(A) if mouldy(A).
%% a good apple can be eaten
edible(A) if good(A).
%% a bad apple cannot be eaten
-edible(A) if -good(A).
%% a brown apple needs a knife
needs(A, knife) if colour(A, brown).
"""
QUESTIONS = """
[[question]]
asks = "class"
patterns = ["what is it"]
"""


@pytest.fixture
def orchard(tmp_path: Path) -> Agent:
    return _agent(tmp_path / "orchard", KNOWLEDGE)


def _agent(
    folder: Path, knowledge: str, *, domain: str = DOMAIN, questions: str = QUESTIONS
) -> Agent:
    folder.mkdir()
    (folder / "domain.toml").write_text(domain, encoding="utf-8")
    (folder / "knowledge.al").write_text(knowledge, encoding="utf-8")
    (folder / "questions.toml").write_text(questions, encoding="utf-8")
    return Agent(load_domain(folder))


def _ask(agent: Agent, question: str, **values: str) -> str:
    scene = agent.classify_values(values)
    return agent.answer(scene, agent.questions.understand(question)).text


DEFAULT_SAID = (
    'It is usual that the apple is good: "apples are good". Nothing that is known speaks against '
    "it."
)


@pytest.mark.parametrize(
    ("values", "question", "answer"),
    [
        ({}, "why is it good?", f"The apple is good, and no single feature accounts for it. "
        f"{DEFAULT_SAID}"),
        ({"mouldy": "no"}, "why is it good?", f"The apple is without mould. {DEFAULT_SAID}"),
        ({"mouldy": "no"}, "why isn't it bad?", f"The apple is without mould. {DEFAULT_SAID}"),
        (
            {"mouldy": "no"},
            "why is it bad?",
            f"The apple is not bad: it is good, since it is without mould. {DEFAULT_SAID}",
        ),
        (
            {"mouldy": "no"},
            "why is it good rather than bad?",
            "The apple is good, since it is without mould; it is bad when it is mouldy. "
            f"{DEFAULT_SAID}",
        ),
        (
            {"mouldy": "yes"},
            "what if it were without mould?",
            f"If the apple is without mould, it is good. {DEFAULT_SAID}",
        ),
        ({"mouldy": "yes"}, "why is it bad?", "The apple is mouldy."),
        ({}, "is it good?", "Yes, the apple is good."),
    ],
)  # fmt: skip
def test_that_a_conclusion_is_usual_is_said(
    orchard: Agent, values: dict[str, str], question: str, answer: str
) -> None:
    assert _ask(orchard, question, **values) == answer


def test_a_default_beside_another_reason_is_not_said(tmp_path: Path) -> None:
    sure = f"{KNOWLEDGE}good(A) if colour(A, red)."
    agent = _agent(tmp_path / "orchard", sure)
    assert _ask(agent, "why is it good?", colour="red") == "The apple is red."
    assert _ask(agent, "why is it good?", colour="green").endswith(DEFAULT_SAID)


def test_a_default_without_a_sentence_is_said(tmp_path: Path) -> None:
    agent = _agent(tmp_path / "orchard", KNOWLEDGE.replace("%% apples are good\n", ""))
    assert _ask(agent, "why is it good?", mouldy="no") == (
        "The apple is without mould. It is usual that the apple is good. Nothing that is known "
        "speaks against it."
    )


MANY_WAYS = """
#sort apple.
#sort shade = {red, green, brown, yellow, white}.
#static colour(apple, shade).
#static mouldy(apple).
#static good(apple).
good(A) if colour(A, C), C != brown.
-good(A) if colour(A, brown).
"""


def test_that_there_are_other_ways_as_small_is_said(tmp_path: Path) -> None:
    more = "".join(f'values.{name}.say = "{{it}} is {name}"\n' for name in ("yellow", "white"))
    domain = DOMAIN.replace("[features.mouldy]", f"{more}[features.mouldy]")
    ways = _agent(tmp_path / "many", MANY_WAYS, domain=domain)
    assert _ask(ways, "what would make it good?", colour="brown") == (
        "To make the apple good, let the colour be green, or let the colour be red, or let the "
        "colour be white; there are other ways as small."
    )
    assert _ask(ways, "how does it differ from a good one?", colour="brown") == (
        "The apple is good when it is green, or it is red, or it is white; here it is "
        "brown; there are other differences as small."
    )
    few = MANY_WAYS.replace("C != brown", "C != brown, C != yellow")
    three = _agent(tmp_path / "few", few, domain=domain)
    assert _ask(three, "what would make it good?", colour="brown") == (
        "To make the apple good, let the colour be green, or let the colour be red, or let the "
        "colour be white."
    )


def test_further_ways_do_not_change_which_answer_it_is() -> None:
    change = ((("colour", "red"),),)
    kind = AnswerType("change", changes=change, has_more=True)
    assert kind == AnswerType("change", changes=change)
    assert kind.identifier == "change()[colour=red]"


# Statics of one's own ---------------------------------------------------------------------------

GOOD = {"colour": "brown", "mouldy": "no"}
BAD = {"colour": "red", "mouldy": "yes"}


@pytest.mark.parametrize(
    ("values", "question", "answer"),
    [
        (GOOD, "is it edible?", "Yes, the apple is edible."),
        (GOOD, "can it be eaten?", "Yes, the apple is edible."),
        (GOOD, "is the apple edible or not?", "Yes, the apple is edible."),
        (
            GOOD,
            "why is it edible?",
            'The apple is edible, since it is without mould: "a good apple can be eaten". '
            f"{DEFAULT_SAID}",
        ),
        (BAD, "is it edible?", "No, the apple is not edible."),
        (BAD, "is it not edible?", "Yes, the apple is not edible."),
        (
            BAD,
            "why is it not edible?",
            'The apple is not edible, since it is mouldy: "a bad apple cannot be eaten".',
        ),
        (
            BAD,
            "why can it be eaten?",
            'But the apple is not edible, since it is mouldy: "a bad apple cannot be eaten".',
        ),
        (GOOD, "what does it need?", "The apple needs knife."),
        (GOOD, "which tool does it need?", "The apple needs knife."),
        (GOOD, "does it need a knife?", "Yes, the apple needs knife."),
        (
            GOOD,
            "why does it need a knife?",
            'The apple needs knife, since it is brown: "a brown apple needs a knife".',
        ),
        (
            GOOD,
            "does it need a brush?",
            "Nothing that is known says that the apple needs brush; the apple needs knife.",
        ),
        (BAD, "what does it need?", "Nothing that is known says what the apple needs."),
        (
            BAD,
            "why does it need a knife?",
            'Nothing that is known says that the apple needs knife: "a brown apple needs a knife" '
            "does not apply, since the apple is red.",
        ),
    ],
)
def test_statics_are_asked_without_templates(
    orchard: Agent, values: dict[str, str], question: str, answer: str
) -> None:
    assert _ask(orchard, question, **values) == answer


def test_statics_are_asked_and_said_in_the_words_of_the_folder(tmp_path: Path) -> None:
    words = """
[beliefs.edible]
values.yes = "is fit to eat"
values.no = "is not fit to eat"

[beliefs.needs]
values.knife = "a sharp knife"
"""
    agent = _agent(tmp_path / "orchard", KNOWLEDGE, domain=DOMAIN + words)
    assert _ask(agent, "is it fit to eat?", **GOOD) == "Yes, the apple is fit to eat."
    assert _ask(agent, "is it fit to eat?", **BAD) == "No, the apple is not fit to eat."
    assert (
        _ask(agent, "does it need a sharp knife?", **GOOD) == "Yes, the apple needs a sharp knife."
    )


def test_what_is_seen_is_preferred_to_a_static_of_the_same_word(tmp_path: Path) -> None:
    known = KNOWLEDGE.replace(
        "#static edible(apple).", "#static edible(apple). #static red(apple)."
    )
    agent = _agent(tmp_path / "orchard", known)
    assert agent.questions.understand("is it red?").feature == "colour"


def test_a_static_cannot_be_supposed(orchard: Agent) -> None:
    with pytest.raises(QuestionError, match="'what if it were edible\\?' is not understood"):
        orchard.questions.understand("what if it were edible?")


@pytest.mark.parametrize(
    ("declared", "value", "said"),
    [
        ("has(apple, flaw)", "bruise", "The apple has bruise."),
        ("shows(apple, flaw)", "bruise", "The apple shows bruise."),
        ("flaw_kind(apple, flaw)", "bruise", "The flaw kind of the apple is bruise."),
        ("spoilt_by(apple, flaw)", "bruise", "The apple is spoilt by bruise."),
    ],
)
def test_a_static_is_said_as_its_name_lets_it(
    tmp_path: Path, declared: str, value: str, said: str
) -> None:
    name = declared.split("(")[0]
    known = f"{KNOWLEDGE}#sort flaw = {{bruise, crack}}. #static {declared}."
    known += f" {name}(A, {value}) if colour(A, brown)."
    asked = f'{QUESTIONS}[[question]]\nasks = "belief_value"\npredicate = "{name}"\n'
    asked += 'patterns = ["what of the flaw"]\n'
    agent = _agent(tmp_path / "orchard", known, questions=asked)
    assert _ask(agent, "what of the flaw?", **GOOD) == said
