"""Domains with defaults and statics of their own: golden texts of whole answers."""

from __future__ import annotations

from pathlib import Path

import pytest

from seewhy.agent.agent import Agent
from seewhy.dialogue.answer import AnswerType
from seewhy.domain.domain import load_domain

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


def _agent(folder: Path, knowledge: str, *, domain: str = DOMAIN) -> Agent:
    folder.mkdir()
    (folder / "domain.toml").write_text(domain, encoding="utf-8")
    (folder / "knowledge.al").write_text(knowledge, encoding="utf-8")
    (folder / "questions.toml").write_text(QUESTIONS, encoding="utf-8")
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
