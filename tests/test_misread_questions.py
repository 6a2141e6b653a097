"""What is nearly a question that can be asked, and means something else, is asked back."""

from __future__ import annotations

import csv
from functools import cache
from pathlib import Path

import pytest

from seewhy.dialogue.question import Questions
from seewhy.dialogue.readings import Readings
from seewhy.dialogue.spelling import english_words
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError
from seewhy_lab.commands.questions_understood import NOT_UNDERSTOOD, meaning_of

STRUCTURES, ROOMS, SIGNS = "structure_stability", "robot_assistant", "traffic_signs"
CORPUS = Path(__file__).parent / "questions" / "seventh_development_robot_assistant.csv"


@cache
def questions_of(domain: str) -> Questions:
    return Questions(load_domain(domain))


def meant(domain: str, text: str) -> str:
    try:
        return meaning_of(questions_of(domain).understand(text))
    except QuestionError:
        return NOT_UNDERSTOOD


NEARLY = {
    "a person or thing that only is named": [
        "do you believe Bob?",
        "do you mean the desk?",
        "do you agree with Bob?",
        "how do you know Bob?",
        "why do you call Bob?",
    ],
    "somebody's look or opinion": [
        "how does Bob look?",
        "what does the desk look like?",
        "what do you think of the sofa?",
        "how sure is Bob?",
        "how safe is the sofa?",
        "how safe is it?",
        "what does Bob mean?",
        "what could Bob do?",
    ],
    "what will be, can be done, or is meant to be": [
        "can the room be used?",
        "can it be used?",
        "is it about to be empty?",
        "is it supposed to be empty?",
        "is it able to be empty?",
        "would it be wrong to say that it's empty?",
    ],
    "when something happens": [
        "tell me when Bob leaves",
        "tell me if Bob leaves",
        "when Bob leaves?",
    ],
    "what is sure": ["what are you sure of?"],
    "who goes with somebody": ["what if Bob left with Sally?", "is Bob away with Sally?"],
    "two things at once": ["is there no desk or chair?", "is Bob not there and Sally?"],
    "the only one": ["is it the only empty room?", "what if there was only Bob?"],
    "another word with the same stem": ["is it useful?", "is there a vacancy?", "is Bob nowhere?"],
    "any room, any place": [
        "what is a room?",
        "is the cup in its place?",
        "show me an empty room",
        "is a room empty?",
        "is any office free?",
        "does the room look like an office?",
        "any room free?",
        "can you find a free room?",
        "do you see a chair like this?",
    ],
    "what kind of room": [
        "which room do you see?",
        "what kind of room do you see?",
        "what is the name of this room?",
    ],
    "what is wanted": ["is there a cup for me?", "can you find a chair for me?"],
    "a greeting": ["hello Bob", "thanks, Bob"],
    "what is to be done": ["empty the room", "please free this room", "if Bob leaves, tell me"],
    "somebody's thoughts": ["do you think about Bob?", "how well do you know Bob?"],
    "another person": ["is Joan there?", "is Johan in the room?"],
    "what a word means, or what follows": [
        "explain empty",
        "what is an axiom?",
        "which rule says that Bob is there?",
    ],
    "what will be, or has been": [
        "why will it be occupied?",
        "why do you think it will be empty?",
        "has Bob been away?",
        "did you see the room?",
    ],
}


@pytest.mark.parametrize("texts", NEARLY.values(), ids=NEARLY)
def test_what_means_something_else_is_asked_back(texts: list[str]) -> None:
    assert {text: meant(ROOMS, text) for text in texts} == dict.fromkeys(texts, NOT_UNDERSTOOD)


UNDERSTOOD = {
    (ROOMS, "do you see a desk?"): "is desk=yes",
    (ROOMS, "do you think it's empty?"): "is class=empty",
    (ROOMS, "tell me if Bob is there"): "is bob=yes",
    (ROOMS, "why isn't Bob gone?"): "why bob=yes",
    (ROOMS, "what if Bob came with Sally?"): "what-if bob=yes;sally=yes",
    (ROOMS, "what if not Bob but Sally were there?"): "what-if bob=no;sally=yes",
    (ROOMS, "what would it be without Bob and John?"): "what-if bob=no;john=no",
    (ROOMS, "how do you recognise an occupied room?"): "when class=occupied",
    (ROOMS, "what is the reason for the sofa?"): "why sofa=yes",
    (ROOMS, "how likely is Bob?"): "how-sure bob",
    (ROOMS, "is Bob there for sure?"): "how-sure bob",
    (ROOMS, "is Bob there and John away?"): "and bob=yes;john=no",
    (ROOMS, "is Bob or Sally missing?"): "or bob=no;sally=no",
    (ROOMS, "is there a small box or a large one?"): "or large_box=yes;small_box=yes",
    (ROOMS, "has the sofa disappeared?"): "is sofa=no",
    (ROOMS, "can you explain your answer?"): "explain",
    (ROOMS, "what makes you so sure?"): "explain",
    (ROOMS, "would a cup make a difference?"): "matters cup",
    (ROOMS, "pls tell me if u see Bob"): "is bob=yes",
    (STRUCTURES, "can it stay like that?"): "is class=stable",
    (ROOMS, "hello, is Bob there?"): "is bob=yes",
    (ROOMS, "hey, is the room empty?"): "is class=empty",
    (ROOMS, "is jhon there?"): "is john=yes",
    (ROOMS, "tell me about Bob"): "what bob",
    (ROOMS, "empty room?"): "is class=empty",
    (ROOMS, "when is a room empty?"): "when class=empty",
    (ROOMS, "have you seen this room before?"): "similar",
    (ROOMS, "has the desk been taken away?"): "is desk=no",
    (STRUCTURES, "why will it fall?"): "why class=unstable",
    (STRUCTURES, "why do you think it will be unstable?"): "why class=unstable",
    (SIGNS, "what kind of sign do you see?"): "what class",
    (SIGNS, "what is the name of this sign?"): "what class",
    (ROOMS, "is Bob gone and Sally too?"): "and bob=no;sally=no",
    (ROOMS, "is Bob gone but not Sally?"): "and bob=no;sally=yes",
    (ROOMS, "what if not Bob but Sally left?"): "what-if bob=yes;sally=no",
    (ROOMS, "is the desk missing or the chair?"): "or chair=no;desk=no",
    (ROOMS, "are Bob and Sally not there?"): "and bob=no;sally=no",
    (ROOMS, "is Bob there and Sally not?"): "and bob=yes;sally=no",
    (ROOMS, "what if Bob left and Sally?"): "what-if bob=no;sally=no",
    (ROOMS, "what if Bob left but not Sally?"): "what-if bob=no;sally=yes",
    (ROOMS, "what if Bob left instead of Sally?"): "what-if bob=no;sally=yes",
    (ROOMS, "what if I took the desk away but not the chair?"): "what-if chair=yes;desk=no",
    (ROOMS, "what if Bob came but not Sally?"): "what-if bob=yes;sally=no",
    (ROOMS, "why isn't it empty rather than occupied?"): "contrast class=occupied|class=empty",
    (ROOMS, "why don't you call it free instead of in use?"): "contrast class=occupied|class=empty",
    (ROOMS, "why is it empty rather than occupied?"): "contrast class=empty|class=occupied",
    (SIGNS, "why isn't it white rather than red?"): "contrast main_color=red|main_color=white",
    (STRUCTURES, "is it about to fall?"): "is class=unstable",
    (STRUCTURES, "will it fall?"): "is class=unstable",
    (STRUCTURES, "how certain is the base?"): "how-sure base",
    (STRUCTURES, "what do you think of the base?"): "what base",
    (SIGNS, "is it a stop sing?"): "is class=stop_sign",
}


@pytest.mark.parametrize(("asked", "meaning"), UNDERSTOOD.items(), ids=str)
def test_what_is_like_it_and_means_the_question_is_understood(
    asked: tuple[str, str], meaning: str
) -> None:
    assert meant(*asked) == meaning


def test_words_that_no_domain_has_are_english_words() -> None:
    assert {"nowhere", "vacancy", "planter", "occupant", "stable"} <= english_words()
    assert not {"stabel", "emty", "tabel"} & english_words()


def test_forms_that_cannot_begin_with_a_word_are_left_out_without_loss(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    domain, questions = load_domain(ROOMS), questions_of(ROOMS)
    pruned = Readings(domain, questions._vocabulary.for_grammar)
    whole = Readings(domain, questions._vocabulary.for_grammar)
    assert pruned._grammar.first_words
    monkeypatch.setitem(whole._grammar.__dict__, "first_words", {})
    with CORPUS.open(encoding="utf-8", newline="") as file:
        wordings = [row["wording"] for row in csv.DictReader(file)][::13]
    for wording in wordings:
        words = questions._vocabulary.for_grammar(wording)
        assert {question.query for question in pruned.read(words)} == {
            question.query for question in whole.read(words)
        }
