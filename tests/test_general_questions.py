"""Questions about all of a kind, and about what words mean; what is asked back instead."""

from __future__ import annotations

from functools import cache

import pytest

from seewhy.agent.agent import Agent
from seewhy.dialogue.asked import Query
from seewhy.dialogue.clarification import beyond_templates
from seewhy.dialogue.question import Questions
from seewhy.dialogue.saying_questions import say_question
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError

STRUCTURES, ROOMS, SIGNS = "structure_stability", "robot_assistant", "traffic_signs"


@cache
def questions_of(domain: str) -> Questions:
    return Questions(load_domain(domain))


def query(domain: str, text: str) -> Query:
    return questions_of(domain).understand(text).query


UNDERSTOOD = {
    (STRUCTURES, "why do structures fall?"): ("when_class", "unstable", None, None),
    (STRUCTURES, "why are towers stable?"): ("when_class", "stable", None, None),
    (STRUCTURES, "what makes a tower stable?"): ("when_class", "stable", None, None),
    (STRUCTURES, "what makes the tower stable?"): ("why_class", "stable", None, None),
    (ROOMS, "why are rooms empty?"): ("when_class", "empty", None, None),
    (ROOMS, "what is an occupied room?"): ("when_class", "occupied", None, None),
    (SIGNS, "what is a stop sign?"): ("when_class", "stop_sign", None, None),
    (STRUCTURES, "what is a base?"): ("possible", None, "base", None),
    (STRUCTURES, "what is the base?"): ("feature_value", None, "base", None),
    (STRUCTURES, "what does leaning mean?"): ("possible", None, "lean", None),
    (STRUCTURES, "how wide?"): ("feature_value", None, "base", None),
    (STRUCTURES, "is anything displaced?"): ("feature_is", None, "block_displaced", "yes"),
    (STRUCTURES, "don't you think it's unstable?"): ("is_class", "unstable", None, None),
    (STRUCTURES, "is it not true that it leans?"): ("feature_is", None, "lean", "yes"),
    (STRUCTURES, "will it fall?"): ("is_class", "unstable", None, None),
    (ROOMS, "are the desk and the chair missing?"): (
        *("all", None, None, None),
        *("desk=no", "chair=no"),
    ),
    (ROOMS, "what if we took away the computer and the cup?"): (
        *("what_if", None, None, None),
        *("computer=no", "cup=no"),
    ),
    (ROOMS, "you don't see Bob, do you?"): ("feature_is", None, "bob", "yes"),
    (ROOMS, "if Bob stayed away, would the room be free?"): (
        *("what_if", None, None, None),
        "bob=no",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("domain", "text"), UNDERSTOOD)
def test_what_is_meant(domain: str, text: str) -> None:
    assert query(domain, text) == UNDERSTOOD[domain, text]


ASKED_BACK = [
    # Neither of two of many says not which it is instead.
    (SIGNS, "is it neither round nor square?"),
    # A class is no feature that could be supposed, though a word of it names a value.
    (SIGNS, "what if it was a stop sign?"),
    (ROOMS, "what if the room were empty?"),
    # What a sign will be is not seen.
    (SIGNS, "will it be a stop sign?"),
    (ROOMS, "will it be empty?"),
    # Whether one could be is not whether this one would be.
    (STRUCTURES, "can a structure with five blocks be stable?"),
    # Which there are is not which is shown.
    (SIGNS, "which shapes do you know?"),
    (SIGNS, "which signs do you know?"),
    (STRUCTURES, "are structures stable?"),
    (ROOMS, "what is a sofa?"),
    (ROOMS, "what kind of room is this?"),
]  # fmt: skip


@pytest.mark.parametrize(("domain", "text"), ASKED_BACK)
def test_what_is_not_known_is_asked_back(domain: str, text: str) -> None:
    with pytest.raises(QuestionError, match="is not understood"):
        query(domain, text)


def test_what_a_feature_can_be_is_told_in_its_words() -> None:
    agent = Agent(load_domain(STRUCTURES))
    scene = agent.classify_values({"num_blocks": "4", "base": "narrow", "lean": "no"})

    def told(text: str) -> str:
        return agent.answer(scene, agent.questions.understand(text)).text

    assert told("what is a base?") == "The width of the base is wide or narrow."
    assert told("what is a lean?") == (
        "Either the structure leans to one side or it is standing straight."
    )


def test_of_many_values_the_first_are_told() -> None:
    agent = Agent(load_domain(SIGNS))
    scene = agent.classify_values({"shape": "circle"})
    said = agent.answer(scene, agent.questions.understand("what can the symbol be?")).text
    assert said.startswith("The symbol is a bumpy road, a bump, ")
    assert said.endswith(" or one of 27 others.")


@pytest.mark.parametrize("domain", [STRUCTURES, ROOMS, SIGNS])
def test_what_is_proposedbeyond_templates_is_understood_as_it_is_meant(domain: str) -> None:
    questions = questions_of(domain)
    for question in beyond_templates(questions.domain):
        said = say_question(questions.domain, question)
        assert questions.understand(said).query == question.query, said


@pytest.mark.parametrize(
    ("text", "beginning"),
    [("what if the shed are moist?", "what if "), ("when is it moist?", "when "),
     ("where is the lamp?", "where ")],
)  # fmt: skip
def test_what_is_proposed_asks_in_the_same_way(text: str, beginning: str) -> None:
    with pytest.raises(QuestionError) as caught:
        query(STRUCTURES, text)
    assert caught.value.nearest
    assert all(near.startswith(beginning) for near in caught.value.nearest)


def test_nothing_is_proposed_that_nobody_would_say() -> None:
    with pytest.raises(QuestionError) as caught:
        query(STRUCTURES, "does it learn?")
    assert caught.value.nearest[0] == "does the structure lean?"
    for near in caught.value.nearest:
        assert "one blocks" not in near
        assert "1 blocks" not in near
