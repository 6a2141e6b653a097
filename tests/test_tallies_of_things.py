"""Most of several things, the most common value, which values occur, how many more."""

from __future__ import annotations

from itertools import product

import pytest

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.dialogue.things.answering import ThingAnswerer, ThingReply
from seewhy.dialogue.things.evaluating import Evaluation
from seewhy.dialogue.things.outcome import Value, outcome_of
from seewhy.domain.domain import load_domain
from seewhy.domain.things import Things

FEATURES = ("size", "colour", "material", "shape")
THINGS = (
    "small red metal cube",
    "large red rubber cube",
    "large blue metal sphere",
    "small green rubber cylinder",
)


@pytest.fixture(scope="module")
def table() -> Things:
    things = load_domain("tabletop").things
    assert things is not None
    return things


@pytest.fixture(scope="module")
def answerer(table: Things) -> ThingAnswerer:
    return ThingAnswerer(table)


def in_a_row(things: Things, *said: str) -> ThingScene:
    """Things from left to right; "?" is not known."""
    values = [[None if word == "?" else word for word in one.split()] for one in said]
    return thing_scene(
        things,
        [dict(zip(FEATURES, of_one, strict=True)) for of_one in values],
        relations={"left": [(a, b) for b in range(len(said)) for a in range(b)]},
    )


@pytest.fixture(scope="module")
def scene(table: Things) -> ThingScene:
    return in_a_row(table, *THINGS)


ANSWERS: dict[str, tuple[Value, str | None]] = {
    "Are most things red?": (
        False,
        "No: two of the four things are red, which is just half: the small red metal cube and the "
        "large red rubber cube.",
    ),
    "Are most of the cubes red?": (
        True,
        "Yes: both cubes are red: the small red metal cube and the large red rubber cube.",
    ),
    "Are more than half of the things left of the cylinder?": (True, None),
    "Do most cubes have the same colour as the small cube?": (False, None),
    "Are most cylinders blue?": (False, "No: the one cylinder is not blue."),
    "Are most yellow things blue?": (False, "No: there is no yellow thing."),
    "What are most of the cubes?": (
        ("red",),
        "Both cubes are red; just half: one of the two cubes is small, one of the two cubes is "
        "large, one of the two cubes is rubber and one of the two cubes is metal.",
    ),
    "What is the most common colour?": (
        "red",
        "The most common colour of the things is red: two of the four things are red.",
    ),
    "What is the most common shape of the rubber things?": (
        ("cube", "cylinder"),
        "The most common shapes of the rubber things are cube and cylinder, which tie: one of the "
        "two rubber things is a cube and one of the two rubber things is a cylinder.",
    ),
    "Which shape occurs most often?": ("cube", None),
    "Which colour occurs least often?": (("blue", "green"), None),
    "What colour are most cubes?": ("red", None),
    "What is the most common colour of the yellow things?": ((), "There is no yellow thing."),
    "How many more cubes than balls are there?": (
        1,
        "There is one more cube than spheres: two cubes and one sphere.",
    ),
    "How many fewer balls are there than cubes?": (1, None),
    "How many more balls than cubes are there?": (
        -1,
        "There is one fewer sphere than cubes, and not more: one sphere and two cubes.",
    ),
    "How many more cubes than large things are there?": (
        0,
        "There are as many cubes as large things: two cubes and two large things.",
    ),
    "Which colours are there?": (
        ("red", "blue", "green"),
        "There are three colours: red, blue and green.",
    ),
    "How many different colours are there?": (3, None),
    "How many shapes are there among the red things?": (
        1,
        "There is one shape among the red things: cube.",
    ),
    "How many different sizes do the cubes have?": (2, None),
    "There is a ball; is it either a cube or a ball?": (True, None),
    "Is the ball either red or a cube?": (
        False,
        "No, the large blue metal sphere is neither red nor a cube.",
    ),
    "Is there either a cube or a green ball?": (True, None),
    "Is there more than one red cube?": (True, None),
    "Is more than one cube red?": (True, None),
    "Are at least two cubes small?": (
        False,
        "No: there is one small cube: the small red metal cube.",
    ),
    "Are at most two things red?": (True, None),
    "Are exactly two things red?": (True, None),
}


@pytest.mark.parametrize("question", ANSWERS)
def test_an_answer(question: str, answerer: ThingAnswerer, scene: ThingScene) -> None:
    value, text = ANSWERS[question]
    reply = answerer.answer(question, scene)
    assert reply.value == value
    assert isinstance(reply.value, bool) == isinstance(value, bool)
    if text is not None:
        assert reply.text == text


def talk(answerer: ThingAnswerer, scene: ThingScene, *questions: str) -> ThingReply:
    """The answer to the last of several questions."""
    reply: ThingReply | None = None
    for question in questions:
        reply = answerer.answer(question, scene, previous=reply)
    assert reply is not None
    return reply


FOLLOWING = {
    ("Are most things red?", "why?"): "The small red metal cube is red. The large red rubber cube "
    "is red. The large blue metal sphere is blue, not red. The small green rubber cylinder is "
    "green, not red.",
    ("Are most things red?", "what would make the answer yes?"): "If the large blue metal sphere "
    "were red, the answer would be yes. Four other changes as small would do, too.",
    ("What is the most common colour?", "why red and not blue?"): "Two of the four things are red: "
    "the small red metal cube is red and the large red rubber cube is red. One of the four things "
    "is blue: the large blue metal sphere is blue. One of the four things is green: the small "
    "green rubber cylinder is green.",
    ("What is the most common colour?", "what would make the answer blue?"): "If the small red "
    "metal cube were blue, the answer would be blue. One other change as small would do, too.",
    ("How many different colours are there?", "what would make the answer two?"): "If the large "
    "blue metal sphere were red, the answer would be two. Five other changes as small would do, "
    "too.",
    ("How many more cubes than balls are there?", "why?"): "There is the small red metal cube: it "
    "is a cube. There is the large red rubber cube: it is a cube. There is the large blue metal "
    "sphere: it is a sphere.",
    ("How many more cubes than balls are there?", "what would make the answer two?"): "If the "
    "large blue metal sphere were a cylinder, the answer would be two. Three other changes as "
    "small would do, too.",
    ("Which shape occurs most often?", "and the green things?"): "The most common shape of the "
    "green thing is cylinder: the one green thing is a cylinder.",
}


@pytest.mark.parametrize("questions", FOLLOWING)
def test_what_follows_an_answer(
    questions: tuple[str, ...], answerer: ThingAnswerer, scene: ThingScene
) -> None:
    assert talk(answerer, scene, *questions).text == FOLLOWING[questions]


def test_the_tree_has_each_value_and_its_things(answerer: ThingAnswerer, scene: ThingScene) -> None:
    reply = answerer.answer("What is the most common size of the cubes?", scene)
    assert (
        reply.justification.to_text()
        == """\
The most common sizes of the cubes are small and large, which tie: one of the two cubes is small \
and one of the two cubes is large.
├─ there is the small red metal cube
│  └─ it is a cube
├─ there is the large red rubber cube
│  └─ it is a cube
├─ no other thing is
│  ├─ the large blue metal sphere is a sphere, not a cube
│  └─ the small green rubber cylinder is a cylinder, not a cube
├─ one of the two cubes is small
│  └─ the small red metal cube is small
└─ one of the two cubes is large
   └─ the large red rubber cube is large"""
    )


def test_what_is_not_known_is_not_said(answerer: ThingAnswerer, table: Things) -> None:
    unsure = in_a_row(table, "small ? metal cube", "large red rubber cube")
    for question in ("What is the most common colour?", "Are most things red?"):
        reply = answerer.answer(question, unsure)
        assert (reply.value, reply.text) == (
            None,
            "I don't know: not enough is seen of the small metal cube.",
        )


QUESTIONS = (
    "Are most things red?",
    "Are most cubes red?",
    "What is the most common colour?",
    "What is the most common shape of the red things?",
    "Which colours are there?",
    "How many different colours are there among the cubes?",
    "How many more cubes than red things are there?",
)


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize(
    "said",
    [
        ("small ? metal cube", "large red rubber cube", "large red metal sphere"),
        ("small ? metal cube", "large red rubber cube", "large ? metal sphere"),
        ("small red metal ?", "large red rubber cube", "large blue metal sphere"),
        ("small ? metal ?", "large blue rubber cube", "small red metal cube"),
    ],
)
def test_what_is_said_of_things_half_seen_is_so_whatever_they_are(
    said: tuple[str, ...], question: str, answerer: ThingAnswerer, table: Things
) -> None:
    """Whatever what is not known may be is tried: an answer is the same in all of it."""
    known = in_a_row(table, *said)
    reply = answerer.answer(question, known)
    words_of = [text.split() for text in said]
    gaps = [
        (one, at)
        for one, words in enumerate(words_of)
        for at, word in enumerate(words)
        if word == "?"
    ]
    found: set[Value] = set()
    for filling in product(*(table.features[FEATURES[at]].values for _, at in gaps)):
        words = [list(of_one) for of_one in words_of]
        for (one, at), value in zip(gaps, filling, strict=True):
            words[one][at] = value
        full = Evaluation(in_a_row(table, *map(" ".join, words)), table)
        found.add(outcome_of(reply.query, full).value)
    if reply.value is None:
        assert len(found) > 1
    else:
        assert found == {reply.value}


CUBES_ARE = (
    "the small red metal cube is a cube, not a sphere; the large red rubber cube is a cube, not"
)
NEAREST = f"Nearest to one sphere more: {CUBES_ARE} a sphere; the small green rubber cylinder is a "
WHY_NOT = {
    "Are there more spheres than cubes?": (
        f"There is one sphere and two cubes. {NEAREST}cylinder, not a sphere."
    ),
    "Are there as many cubes as spheres?": (
        f"There are two cubes and one sphere. {NEAREST}cylinder, not a sphere."
    ),
    "How many more cubes than spheres are there?": (
        "There are two cubes and one sphere. Nearest to one cube more: the large blue metal sphere "
        "is a sphere, not a cube; the small green rubber cylinder is a cylinder, not a cube."
    ),
    "Are there more cubes than spheres?": "But it is so: there are two cubes and one sphere.",
    "Are there at least two cubes?": "But it is so: there are two cubes.",
    "Is there exactly one cube?": (
        "The small red metal cube is one: it is a cube. The large red rubber cube is one: it is a "
        "cube."
    ),
}


@pytest.mark.parametrize("question", WHY_NOT)
def test_why_not_after_a_count_tells_what_is_nearest_to_another(
    answerer: ThingAnswerer, scene: ThingScene, question: str
) -> None:
    counted = answerer.answer(question, scene)
    why, why_not = (answerer.answer(text, scene, previous=counted) for text in ("why?", "why not?"))
    assert why_not.text == WHY_NOT[question]
    assert why_not.text != why.text
