"""Questions about things: read, answered in three values, with reasons and contrasts."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.dialogue.things.answering import ThingAnswerer, ThingReply
from seewhy.domain.domain import load_domain
from seewhy.domain.things import Things
from seewhy.errors import DatasetError, QuestionError
from test_things_domain import write_plates


@pytest.fixture(scope="module")
def table() -> Things:
    things = load_domain("tabletop").things
    assert things is not None
    return things


@pytest.fixture(scope="module")
def answerer(table: Things) -> ThingAnswerer:
    return ThingAnswerer(table)


def thing(said: str) -> dict[str, str | None]:
    """ "small red metal cube" as values; "?" is not known."""
    values = [None if word == "?" else word for word in said.split()]
    return dict(zip(("size", "colour", "material", "shape"), values, strict=True))


def in_a_row(things: Things, *said: str, depth: Sequence[int] = ()) -> ThingScene:
    """Things from left to right; ``depth`` is their order from the front."""
    count = len(said)
    order = list(depth) or list(range(count))
    return thing_scene(
        things,
        [thing(one) for one in said],
        relations={
            "left": [(a, b) for b in range(count) for a in range(b)],
            "in_front": [(a, b) for a in range(count) for b in range(count) if order[a] < order[b]],
        },
    )


@pytest.fixture(scope="module")
def scene(table: Things) -> ThingScene:
    return in_a_row(
        table,
        "small red metal cube",
        "large red rubber cube",
        "large blue metal sphere",
        "small green rubber cylinder",
        depth=(3, 2, 1, 0),
    )


ANSWERS = {
    "How many red blocks are there?": (
        2,
        "There are two red cubes: the small red metal cube and the large red rubber cube.",
    ),
    "How many yellow things are there?": (0, "There is no yellow thing."),
    "Is there a shiny ball to the right of the big cube?": (
        True,
        "Yes: there is one metal sphere right of the large red rubber cube: the large blue metal "
        "sphere.",
    ),
    "Are there no cylinders?": (
        False,
        "No: there is one cylinder: the small green rubber cylinder.",
    ),
    "What colour is the ball?": ("blue", "The large blue metal sphere is blue."),
    "What is the cylinder made of?": (
        "rubber",
        "The small green rubber cylinder is made of rubber.",
    ),
    "How big is the thing left of the big cube?": ("small", "The small red metal cube is small."),
    "Are there more cubes than balls?": (True, "Yes: there are two cubes and one sphere."),
    "Are there as many cubes as balls?": (False, "No: there are two cubes and one sphere."),
    "Is the number of cubes less than the number of small things?": (
        False,
        "No: there are two cubes and two small things.",
    ),
    "Are there at least three rubber objects?": (
        False,
        "No: there are two rubber things: the large red rubber cube and the small green rubber "
        "cylinder.",
    ),
    "Do the ball and the cylinder have the same size?": (
        False,
        "No: the large blue metal sphere is large and the small green rubber cylinder is small.",
    ),
    "Is the ball left of the cylinder?": (
        True,
        "Yes, the large blue metal sphere is left of the small green rubber cylinder.",
    ),
    "Is the ball not blue?": (False, "No, the large blue metal sphere is blue."),
    "Which things are larger than the cylinder?": (
        (1, 2),
        "There are two things larger than the small green rubber cylinder: the large red rubber "
        "cube and the large blue metal sphere.",
    ),
    "What is the leftmost thing?": (
        (0,),
        "It is the small red metal cube: it is small, it is red, it is made of metal and it is a "
        "cube.",
    ),
    "Which thing is the second from the right?": ((2,), "It is the large blue metal sphere."),
    "What colour is the largest ball?": ("blue", "The large blue metal sphere is blue."),
    "Are all cubes red?": (True, "Yes, every cube is red."),
    "Are all cubes small?": (False, "No, not every cube is small."),
    "Is a cube made of rubber?": (True, None),
    "Is the ball the only blue thing?": (
        True,
        "Yes, the large blue metal sphere is the only blue thing.",
    ),
    "Is only the ball made of metal?": (
        False,
        "No, the large blue metal sphere is not the only metal thing.",
    ),
    "Is the ball the sole cube?": (False, "No, the large blue metal sphere is no cube."),
    "Is the small cube the only one that is left of the big cube?": (
        True,
        "Yes, the small red metal cube is the only thing left of the large red rubber cube.",
    ),
    "How many things are either cubes or rubber things left of the ball?": (2, None),
    "How many things that are not cubes are left of every cylinder?": (1, None),
    "How many things are neither red nor small?": (1, None),
    "What is between the small cube and the cylinder?": ((1, 2), None),
    "What do the ball and the cylinder differ in?": (
        ("size", "colour", "material", "shape"),
        None,
    ),
    "What do the first thing and the second thing have in common?": (
        ("colour", "shape"),
        "They share colour and shape: each is red and each is a cube.",
    ),
    "please tell me, how many bals are there": (1, None),
    "There is a ball, what size is it?": ("large", None),
    "What other thing is the same colour as the small cube?": ((1,), None),
    "Is there anything else of the same shape as the ball?": (False, None),
    "What colour is the thing that the ball is left of?": ("green", None),
    "How many of the things are large?": (2, None),
    "Are there any cubes or green balls?": (
        True,
        "Yes: there are two things that are cubes or green spheres: the small red metal cube and "
        "the large red rubber cube.",
    ),
    "What's the ball's size?": ("large", None),
    "What size is the left cube?": ("small", None),
    "Which cube is the largest?": ((1,), "It is the large red rubber cube."),
    "Is the ball larger than every cube?": (False, None),
}


@pytest.mark.parametrize("question", ANSWERS)
def test_an_answer(question: str, answerer: ThingAnswerer, scene: ThingScene) -> None:
    value, text = ANSWERS[question]
    reply = answerer.answer(question, scene)
    assert reply.value == value
    assert isinstance(reply.value, bool) == isinstance(value, bool)
    if text is not None:
        assert reply.text == text


def test_reasons_go_down_to_what_was_seen(answerer: ThingAnswerer, scene: ThingScene) -> None:
    reply = answerer.answer("How many red things are left of the ball?", scene)
    assert (
        reply.justification.to_text()
        == """\
There are two red things left of the large blue metal sphere: the small red metal cube and the \
large red rubber cube.
├─ the sphere is the large blue metal sphere
│  ├─ there is the large blue metal sphere
│  │  └─ it is a sphere
│  └─ no other thing is
│     ├─ the small red metal cube is a cube, not a sphere
│     ├─ the large red rubber cube is a cube, not a sphere
│     └─ the small green rubber cylinder is a cylinder, not a sphere
├─ there is the small red metal cube
│  ├─ it is red
│  └─ it is left of the large blue metal sphere
├─ there is the large red rubber cube
│  ├─ it is red
│  └─ it is left of the large blue metal sphere
└─ no other thing is
   ├─ the large blue metal sphere is blue, not red
   └─ the small green rubber cylinder is green, not red"""
    )
    leaves = [node for node in reply.justification.walk() if not node.children]
    assert leaves[0].literal == "shape(thing3,sphere)"
    assert (leaves[0].feature, leaves[0].value) == ("shape(thing3)", "sphere")
    assert any(leaf.literal == "left(thing1,thing3)" for leaf in leaves)
    assert reply.to_dict()["justification"]["children"]


def talk(answerer: ThingAnswerer, scene: ThingScene, *questions: str) -> list[ThingReply]:
    replies: list[ThingReply] = []
    for question in questions:
        previous = replies[-1] if replies else None
        replies.append(answerer.answer(question, scene, previous=previous))
    return replies


def test_a_conversation(answerer: ThingAnswerer, scene: ThingScene) -> None:
    _, colour, what, _, where = talk(
        answerer,
        scene,
        "Is there a ball?",
        "What colour is it?",
        "and the cylinder?",
        "why?",
        "Where is it?",
    )
    assert (colour.value, what.value) == ("blue", "green")
    assert where.text == (
        "The small green rubber cylinder is right of the small red metal cube, the large red "
        "rubber cube and the large blue metal sphere and in front of the small red metal cube, the "
        "large red rubber cube and the large blue metal sphere."
    )


def test_why(answerer: ThingAnswerer, scene: ThingScene) -> None:
    _, why = talk(answerer, scene, "How many balls are there?", "why?")
    assert why.text == "There is the large blue metal sphere: it is a sphere."
    _, why = talk(answerer, scene, "Is there a green cube?", "why?")
    assert why.text == (
        "There is no green cube: the small red metal cube is red, not green; the large red rubber "
        "cube is red, not green; the large blue metal sphere is blue, not green; the small green "
        "rubber cylinder is a cylinder, not a cube."
    )
    why = answerer.answer("Why is there no green cube?", scene)
    assert why.text.startswith("There is no green cube: ")
    assert answerer.answer("Why is the ball red?", scene).text.startswith("But it is not so: ")


def test_why_something_is_not_the_only_one(answerer: ThingAnswerer, scene: ThingScene) -> None:
    asked = ("Is the ball the only metal thing?", "why?", "and the cylinder?")
    _, why, other = talk(answerer, scene, *asked)
    assert why.text == (
        "There are two metal things. The sphere is the large blue metal sphere. There is the "
        "small red metal cube, too: it is made of metal."
    )
    assert other.text == "No, the small green rubber cylinder is no metal thing."


def test_why_of_every_thing(answerer: ThingAnswerer, scene: ThingScene) -> None:
    _, why = talk(answerer, scene, "Are all cubes red?", "why?")
    assert why.text == (
        "There are two cubes. The small red metal cube is red. The large red rubber cube is red."
    )


def test_why_not_another_answer(answerer: ThingAnswerer, scene: ThingScene) -> None:
    _, why = talk(answerer, scene, "How many small cubes are there?", "why one and not two?")
    assert why.text == (
        "There is one small cube. Nearest to one more: the large red rubber cube is large, not "
        "small; the small green rubber cylinder is a cylinder, not a cube."
    )
    _, why = talk(answerer, scene, "How many cubes are there?", "why two and not one?")
    assert why.text == (
        "The small red metal cube is one: it is a cube. The large red rubber cube is one: it is a "
        "cube."
    )
    _, why = talk(answerer, scene, "Is the ball left of the big cube?", "why not?")
    assert why.text == "The large blue metal sphere is not left of the large red rubber cube."


CHANGES = {
    ("Is there a green cube?", "yes"): (
        "If the small red metal cube were green, the answer would be yes. "
    ),
    ("Is the ball left of the small cube?", "yes"): (
        "If the small red metal cube were right of the large blue metal sphere, the answer would "
        "be yes. "
    ),
    ("How many cylinders are there?", "zero"): (
        "If the small green rubber cylinder were a cube, the answer would be zero. "
    ),
    ("How many cylinders are there?", "three"): (
        "If the small red metal cube were a cylinder and the large red rubber cube were a "
        "cylinder, the answer would be three. "
    ),
    ("What colour is the ball?", "red"): (
        "If the large blue metal sphere were red, the answer would be red."
    ),
    ("Are there more balls than cubes?", "yes"): (
        "If the small red metal cube were a sphere, the answer would be yes. "
    ),
}


@pytest.mark.parametrize(("question", "wanted"), CHANGES)
def test_the_smallest_change(
    question: str, wanted: str, answerer: ThingAnswerer, scene: ThingScene
) -> None:
    asked = f"What would have to be otherwise for the answer to be {wanted}?"
    _, change = talk(answerer, scene, question, asked)
    assert change.text.startswith(CHANGES[question, wanted])


def test_what_if(answerer: ThingAnswerer, scene: ThingScene) -> None:
    _, red, gone, as_it_is = talk(
        answerer,
        scene,
        "How many red things are there?",
        "what if the ball were red?",
        "what if the small cube were removed?",
        "How many red things are there?",
    )
    assert (red.value, gone.value, as_it_is.value) == (3, 1, 2)
    assert gone.text == "Then: there is one red thing: the large red rubber cube."
    _, unclear = talk(answerer, scene, "Is there a ball?", "what if the cube were a ball?")
    assert unclear.text.startswith("Which cube? There are two: ")


def test_places_tell_what_is_near(answerer: ThingAnswerer, table: Things) -> None:
    said = ("small red metal cube", "large blue metal sphere", "small green metal cylinder")
    placed = thing_scene(
        table,
        [thing(one) for one in said],
        relations={},
        positions=[(0, 0, 0), (4, 0, 0), (1.5, 0.2, 0)],
    )
    asked = {
        "What is the thing nearest to the cube?": (2,),
        "Which thing is farthest from the cube?": (1,),
        "What is between the cube and the ball?": (2,),
    }
    for question, value in asked.items():
        assert answerer.answer(question, placed).value == value
    assert answerer.answer("What is the thing nearest to the zylinder?", placed).value == (0,)


def test_no_change_is_said_where_the_answer_is_that(
    answerer: ThingAnswerer, scene: ThingScene
) -> None:
    _, change = talk(answerer, scene, "Is there a ball?", "What would make the answer yes?")
    assert change.text == "Nothing: that is the answer."


def test_which_of_several_is_asked_back(answerer: ThingAnswerer, scene: ThingScene) -> None:
    reply = answerer.answer("What size is the red block?", scene)
    assert reply.value is None
    assert reply.text == (
        "Which red cube? There are two: the small red metal cube and the large red rubber cube."
    )
    assert len(reply.justification.children) == 3
    assert answerer.answer("What size is the yellow block?", scene).text == (
        "There is no yellow cube."
    )


def test_what_is_not_known_is_not_said(answerer: ThingAnswerer, table: Things) -> None:
    scene = in_a_row(table, "small ? metal cube", "large red rubber cube", "? red ? sphere")
    said = {
        "What colour is the small cube?": "I don't know: the colour of the small metal cube is not "
        "known.",
        "How many red cubes are there?": "I don't know: there are at least one and at most two; "
        "not enough is seen of the small metal cube.",
        "Are there more red things than cubes?": "I don't know: not enough is seen of the small "
        "metal cube.",
        "Is the ball large?": "I don't know: not enough is seen of the red sphere.",
        "What shape is the large ball?": "I don't know which is the large sphere: it may be the "
        "red sphere.",
    }
    for question, text in said.items():
        reply = answerer.answer(question, scene)
        assert (reply.value, reply.text) == (None, text)
    assert answerer.answer("Is there a red cube?", scene).value is True
    assert answerer.answer("Are there at least two red things?", scene).value is True


def test_relations_of_which_nothing_is_said_are_unknown(
    answerer: ThingAnswerer, table: Things
) -> None:
    scene = thing_scene(
        table, [thing("small red metal cube"), thing("large red metal sphere")], relations={}
    )
    assert answerer.answer("Is the ball left of the cube?", scene).value is None


def test_the_reading_that_refers_is_taken(answerer: ThingAnswerer, table: Things) -> None:
    scene = in_a_row(
        table, "small red metal cube", "small blue metal sphere", "large green rubber cube"
    )
    # "the ball left of the green cube": else nothing would be said of the ball
    reply = answerer.answer("Is the ball left of the green cube right of the red cube?", scene)
    assert reply.value is True


REFUSED = {
    "": "the question has no words; ask 'how many things are there?'",
    "?!;": "the question has no words; ask 'how many things are there?'",
    "x" * 1001: "the question has 1,001 characters; ask in 1,000 at most",
    "a " * 300: "the question has more than 120 words; ask in fewer",
    "How many zorbs are there?": "I do not understand the question; 'zorbs' is no word of the "
    "domain",
    "What colour is it?": "I do not understand the question; say which thing is meant, as in "
    "'there is …; what is it?'",
    "why?": "I do not understand the question; ask how many, which, what or whether there are",
    "the red cube the ball": "I do not understand the question; ask how many, which, what or "
    "whether there are",
    "Is the ball made of red?": "I do not understand the question; ask how many, which, what or "
    "whether there are",
}


@pytest.mark.parametrize("question", REFUSED)
def test_what_is_not_understood(question: str, answerer: ThingAnswerer, scene: ThingScene) -> None:
    with pytest.raises(QuestionError) as refused:
        answerer.answer(question, scene)
    assert str(refused.value) == REFUSED[question]


def test_long_chains_end(answerer: ThingAnswerer, scene: ThingScene) -> None:
    chain = "the thing " + "left of the thing and right of the thing " * 9
    reply = answerer.answer(f"How many things are left of {chain}?", scene)
    assert reply.failed is not None


def test_a_question_that_is_nested_too_deeply(answerer: ThingAnswerer, scene: ThingScene) -> None:
    with pytest.raises(QuestionError, match="ask in two steps"):
        answerer.answer("what is " + "the thing that is " * 28 + "red?", scene)


def test_another_domain(tmp_path: Path) -> None:
    things = load_domain(write_plates(tmp_path)).things
    assert things is not None
    fruits = thing_scene(
        things,
        [
            {"kind_of_fruit": "apple", "ripe": "yes", "weight": "heavy"},
            {"kind_of_fruit": "cherry", "ripe": "no", "weight": "light"},
            {"kind_of_fruit": "apple", "ripe": "no", "weight": "heavy"},
        ],
        relations={"touching": [(0, 1)], "above": [(1, 0)]},
    )
    answerer = ThingAnswerer(things)
    said = {
        "How many ripe apples are there?": "There is one ripe heavy apple: the ripe heavy apple.",
        "Which fruit touches the cherry?": (0,),
        "Does the cherry touch the ripe apple?": True,
        "Is the unripe apple heavier than the cherry?": True,
        "What is the lightest fruit?": (1,),
        "How many pieces are touching a cherry?": 1,
        "What kind is the fruit above the ripe apple?": "cherry",
        "How heavy is the cherry?": "light",
        "Are there more unripe fruits than ripe ones?": True,
    }
    for question, value in said.items():
        reply = answerer.answer(question, fruits)
        if isinstance(value, str) and " " in value:
            value = 1
        assert reply.value == value, question


SCENES: dict[str, tuple[Callable[[Things], object], str]] = {
    "feature": (
        lambda things: thing_scene(things, [{"colur": "red"}], relations={}),
        "the picture, thing 1: 'colur' is no feature of things; did you mean 'colour'?",
    ),
    "value": (
        lambda things: thing_scene(things, [{"colour": "rad"}], relations={}),
        "the picture, thing 1: 'rad' is no value of 'colour'; did you mean 'red'?",
    ),
    "relation": (
        lambda things: thing_scene(things, [{}], relations={"lefft": []}),
        "the picture: 'lefft' is no relation; did you mean 'left'?",
    ),
    "thing that is not there": (
        lambda things: thing_scene(things, [{}], relations={"left": [(0, 1)]}),
        "the picture: 'left' holds of thing 1, which is not there; there are 1, counted from 0",
    ),
    "too many things": (
        lambda things: thing_scene(things, [{}] * 11, relations={}),
        "the picture: has 11 things, and the domain at most 10; raise most under [things]",
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_that_cannot_be(name: str, table: Things) -> None:
    make, said = SCENES[name]
    with pytest.raises(DatasetError) as refused:
        make(table)
    assert str(refused.value) == said


# Random questions, beside a plain interpreter of what they mean


@dataclass(frozen=True)
class Asked:
    """A wording, and what it means: sets of things by a function."""

    words: str
    meaning: Callable[[ThingScene], object]


class NotOneError(Exception):
    """A question speaks of the one thing, and there is not one."""


ADJECTIVES = {
    "size": {"small": ("small", "tiny"), "large": ("large", "big")},
    "colour": {"red": ("red",), "blue": ("blue",), "gray": ("gray", "grey")},
    "material": {"metal": ("metal", "shiny", "metallic"), "rubber": ("rubber", "matte")},
}
NOUNS = {"cube": ("cube", "block"), "sphere": ("sphere", "ball"), "cylinder": ("cylinder",)}
PLACES = {
    "left": ("left of", "to the left of", "on the left side of"),
    "right": ("right of", "to the right of"),
    "in_front": ("in front of",),
    "behind": ("behind",),
}


def described(chance: random.Random, depth: int, *, many: bool) -> Asked:
    """A noun phrase without its article: "small red cubes that are left of the ball"."""
    words: list[str] = []
    wanted: list[tuple[str, str]] = []
    for feature, values in ADJECTIVES.items():
        if chance.random() < 0.4:
            value = chance.choice(list(values))
            wanted.append((feature, value))
            words.append(chance.choice(values[value]))
    noun = chance.choice(("thing", "object"))
    if chance.random() < 0.6:
        shape = chance.choice(list(NOUNS))
        wanted.append(("shape", shape))
        noun = chance.choice(NOUNS[shape])
    words.append(noun + "s" * many)
    relation, to = "", None
    if depth:
        relation = chance.choice(list(PLACES))
        to = the(chance, depth - 1)
        that = f"that {'are' if many else 'is'}" if chance.random() < 0.5 else ""
        words += [that, chance.choice(PLACES[relation]), to.words]

    def meaning(scene: ThingScene) -> set[int]:
        found = set(range(scene.count))
        for feature, value in wanted:
            found = {one for one in found if scene.values[feature][one] == value}
        if to is not None:
            other = to.meaning(scene)
            assert isinstance(other, int)
            found = {one for one in found if scene.related[relation][other] >> one & 1}
        return found

    return Asked(" ".join(filter(None, words)), meaning)


def the(chance: random.Random, depth: int) -> Asked:
    inside = described(chance, depth, many=False)

    def meaning(scene: ThingScene) -> int:
        found = inside.meaning(scene)
        assert isinstance(found, set)
        if len(found) != 1:
            raise NotOneError
        (one,) = found
        return int(one)

    return Asked(f"the {inside.words}", meaning)


def asked(chance: random.Random) -> Asked:
    depth = chance.choice((0, 1, 1, 2, 3))
    kind = chance.choice(("count", "exists", "value", "compare", "same", "either", "both"))
    if kind == "count":
        inside = described(chance, depth, many=True)
        how = chance.choice(("How many {} are there?", "What number of {} are there?"))
        return Asked(how.format(inside.words), lambda scene: len(_set(inside, scene)))
    if kind == "exists":
        inside = described(chance, depth, many=False)
        return Asked(f"Is there a {inside.words}?", lambda scene: bool(_set(inside, scene)))
    if kind == "value":
        one = the(chance, depth)
        feature = chance.choice(("size", "colour", "material", "shape"))
        how = chance.choice(("What {1} is {0}?", "What is the {1} of {0}?", "{0} is what {1}?"))
        return Asked(
            how.format(one.words, feature), lambda scene: scene.values[feature][_one(one, scene)]
        )
    if kind == "compare":
        first, second = (described(chance, min(depth, 1), many=True) for _ in range(2))
        return Asked(
            f"Are there fewer {first.words} than {second.words}?",
            lambda scene: len(_set(first, scene)) < len(_set(second, scene)),
        )
    if kind == "same":
        one, other = the(chance, min(depth, 1)), the(chance, min(depth, 1))
        feature = chance.choice(("size", "colour", "material", "shape"))
        return Asked(
            f"Do {one.words} and {other.words} have the same {feature}?",
            lambda scene: (
                scene.values[feature][_one(one, scene)] == scene.values[feature][_one(other, scene)]
            ),
        )
    if kind == "either":
        first, second = (described(chance, min(depth, 1), many=True) for _ in range(2))
        either = chance.choice(("either ", ""))
        return Asked(
            f"How many things are {either}{first.words} or {second.words}?",
            lambda scene: len(_set(first, scene) | _set(second, scene)),
        )
    one, other = the(chance, 0), the(chance, 0)
    here, there = chance.choice(list(PLACES)), chance.choice(list(PLACES))
    both = chance.choice(("both ", ""))
    return Asked(
        f"How many objects are {both}{PLACES[here][0]} {one.words} and {PLACES[there][0]} "
        f"{other.words}?",
        lambda scene: (
            scene.related[here][_one(one, scene)] & scene.related[there][_one(other, scene)]
        ).bit_count(),
    )


def _set(said: Asked, scene: ThingScene) -> set[int]:
    found = said.meaning(scene)
    assert isinstance(found, set)
    return found


def _one(said: Asked, scene: ThingScene) -> int:
    found = said.meaning(scene)
    assert isinstance(found, int)
    return found


def random_scene(chance: random.Random, things: Things) -> ThingScene:
    count = chance.randint(1, 7)
    said = [
        " ".join(
            [
                *(chance.choice(list(values)) for values in ADJECTIVES.values()),
                chance.choice(list(NOUNS)),
            ]
        )
        for _ in range(count)
    ]
    return in_a_row(things, *said, depth=chance.sample(range(count), count))


def random_questions(things: Things, count: int) -> Iterator[tuple[str, ThingScene, object]]:
    """Questions whose references refer, each with its answer."""
    chance = random.Random(7)
    while count:
        scene, question = random_scene(chance, things), asked(chance)
        try:
            answer = question.meaning(scene)
        except NotOneError:
            continue
        count -= 1
        yield question.words, scene, answer


def test_random_questions_mean_what_a_plain_interpreter_says(
    answerer: ThingAnswerer, table: Things
) -> None:
    for question, scene, answer in random_questions(table, 300):
        reply = answerer.answer(question, scene)
        assert reply.value == answer, (question, reply.query)
        assert reply.text
        assert list(reply.justification.walk())


def test_every_change_that_is_told_makes_the_answer(answerer: ThingAnswerer, table: Things) -> None:
    """What is found is applied, and the question is asked again of the changed scene."""
    from seewhy.dialogue.things.changing import smallest_change
    from seewhy.dialogue.things.edits import edited
    from seewhy.dialogue.things.evaluating import Evaluation
    from seewhy.dialogue.things.fixing import fixed
    from seewhy.dialogue.things.outcome import outcome_of

    found = 0
    for question, scene, answer in random_questions(table, 80):
        if not isinstance(answer, bool) or scene.count > 4:
            continue
        reply = answerer.answer(question, scene)
        change = smallest_change(reply.query, not answer, reply.words)
        if change.changes is None:
            continue
        found += 1
        changed, without = edited(scene, table, change.edits)
        evaluation = Evaluation(changed, table, without=without)
        asked = fixed(reply.query, reply.words.evaluation)  # of the same things as before
        assert outcome_of(asked, evaluation).value is not answer
    assert found > 5


def test_the_page_says_what_is_answered(answerer: ThingAnswerer, scene: ThingScene) -> None:
    page = Path(__file__).parents[1] / "docs" / "things.md"
    asked = page.read_text("utf-8").split("## What follows")[0]
    rows = re.findall(r"^\| [^|]+ \| ([A-Z][^|]+\?) \| ([^|]+) \|$", asked, re.M)
    assert len(rows) == 20
    for question, answer in rows:
        assert answerer.answer(question, scene).text == answer
