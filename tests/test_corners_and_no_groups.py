"""Places by two orders, "the top left card", and what is part of no set."""

from __future__ import annotations

import pytest

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.dialogue.scene_conclusions import SceneConclusions
from seewhy.dialogue.things.answering import ThingAnswerer
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError

CARDS = (
    "one red solid oval",
    "two red solid oval",
    "three red solid oval",
    "one green striped diamond",
    "two purple empty diamond",
    "two purple empty squiggle",
)
PLACES = ((0, 0), (10, 1), (21, 0.5), (1, 10), (12, 12), (20, 11))
"""From the left and from the top, laid out by hand."""


def laid_out(places: tuple[tuple[float, float], ...], cards: tuple[str, ...]) -> ThingScene:
    domain = load_domain("set_cards")
    things = domain.things
    assert things is not None
    pairs = [(a, b) for a in range(len(cards)) for b in range(len(cards))]
    scene = thing_scene(
        things,
        [dict(zip(things.features, one.split(), strict=True)) for one in cards],
        relations={
            "left": [(a, b) for a, b in pairs if places[a][0] < places[b][0]],
            "above": [(a, b) for a, b in pairs if places[a][1] < places[b][1]],
        },
    )
    return SceneConclusions(domain).conclude(scene)


@pytest.fixture(scope="module")
def answerer() -> ThingAnswerer:
    things = load_domain("set_cards").things
    assert things is not None
    return ThingAnswerer(things)


@pytest.fixture(scope="module")
def cards() -> ThingScene:
    return laid_out(PLACES, CARDS)


ANSWERS = {
    "What colour is the top left card?": ("red", "The red solid oval card with one symbol is red."),
    "What is the bottom-right card?": ((5,), None),
    "What colour is the card at the top right?": ("red", None),
    "Which card is in the bottom left corner?": (
        (3,),
        "It is the green striped diamond card with one symbol.",
    ),
    "Is the third card the top right card?": (
        True,
        "Yes, the red solid oval card with three symbols is the top right card.",
    ),
    "What shape is the top left purple card?": (
        None,
        "Which top left purple card? There are two: the purple empty diamond card with two symbols "
        "and the purple empty squiggle card with two symbols.",
    ),
    "Which cards are part of no set?": (
        (4,),
        "There is one card that is part of no set: the purple empty diamond card with two symbols.",
    ),
    "Is the fifth card in no set?": (
        True,
        "Yes, the purple empty diamond card with two symbols is part of no set.",
    ),
    "Is the third card part of no set?": (
        False,
        "No, the red solid oval card with three symbols is part of a set.",
    ),
}


@pytest.mark.parametrize("question", ANSWERS)
def test_an_answer(question: str, answerer: ThingAnswerer, cards: ThingScene) -> None:
    value, text = ANSWERS[question]
    reply = answerer.answer(question, cards)
    assert reply.value == value
    if text is not None:
        assert reply.text == text


def test_two_ways_that_are_one_are_no_corner(answerer: ThingAnswerer, cards: ThingScene) -> None:
    with pytest.raises(QuestionError):
        answerer.answer("What is the left right card?", cards)


def test_why_it_is_that_corner(answerer: ThingAnswerer, cards: ThingScene) -> None:
    before = answerer.answer("What colour is the bottom right card?", cards)
    why = answerer.answer("why?", cards, previous=before)
    assert why.text == (
        "The bottom right card is the purple empty squiggle card with two symbols: one card is "
        "below it and one card is right of it. The purple empty squiggle card with two symbols is "
        "purple."
    )
    tree = before.justification.to_text()
    assert "the red solid oval card with one symbol is not the bottom right card" in tree
    assert "five cards are below it" in tree


def test_what_would_have_to_move(answerer: ThingAnswerer) -> None:
    scene = laid_out(PLACES[:3], CARDS[:3])
    before = answerer.answer("Is the second card the top left card?", scene)
    changed = answerer.answer("what would make the answer yes?", scene, previous=before)
    assert changed.text == (
        "If the red solid oval card with one symbol were below the red solid oval card with two "
        "symbols, the answer would be yes."
    )


def test_a_corner_of_an_order_that_is_not_known(answerer: ThingAnswerer) -> None:
    things = answerer.things
    scene = thing_scene(
        things, [{"number": "one"}, {"number": "two"}], relations={"left": [(0, 1)]}
    )
    assert answerer.answer("What is the top left card?", scene).text == (
        "I don't know which is the top left card: it may be the card with one symbol or the card "
        "with two symbols."
    )
