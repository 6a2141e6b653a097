"""Questions as people ask them who have not read the grammar, of things in three domains."""

from __future__ import annotations

import pytest

from fruit_builder import write_fruits
from seewhy.data.importers.clevr import read_scenes
from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.dialogue.scene_conclusions import SceneConclusions
from seewhy.dialogue.things.answering import ThingAnswerer, ThingReply
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError

Asked = tuple[ThingAnswerer, ThingScene]


@pytest.fixture(scope="module")
def fruits(tmp_path_factory: pytest.TempPathFactory) -> Asked:
    domain = load_domain(write_fruits(folder := tmp_path_factory.mktemp("fruits")))
    assert domain.things is not None
    (scene,) = read_scenes(folder / "scenes.json", domain.things).values()
    return ThingAnswerer(domain.things), SceneConclusions(domain).conclude(scene)


@pytest.fixture(scope="module")
def table() -> Asked:
    """A red cube, a blue ball, and a green cube with a yellow cylinder on it."""
    domain = load_domain("tabletop")
    assert domain.things is not None
    said = [("small", "red", "metal", "cube"), ("large", "blue", "rubber", "sphere")]
    said += [("small", "green", "rubber", "cube"), ("small", "yellow", "metal", "cylinder")]
    values = [dict(zip(domain.things.features, of_one, strict=True)) for of_one in said]
    left = [(0, 1), (0, 2), (1, 2), (0, 3), (1, 3)]
    scene = thing_scene(domain.things, values, relations={"left": left, "on": [(3, 2)]})
    return ThingAnswerer(domain.things), SceneConclusions(domain).conclude(scene)


@pytest.fixture(scope="module")
def blocks() -> Asked:
    domain = load_domain("structure_blocks")
    assert domain.things is not None
    said = [("green", "wide"), ("red", "narrow"), ("teal", "narrow")]
    values = [dict(zip(domain.things.features, of_one, strict=True)) for of_one in said]
    related = {"on": [(1, 0), (2, 1)], "beyond": [(2, 1)]}
    scene = thing_scene(domain.things, values, relations=related)
    return ThingAnswerer(domain.things), SceneConclusions(domain).conclude(scene)


def told(asked: Asked, *questions: str) -> str:
    """The answer to the last question of a conversation."""
    answerer, scene = asked
    reply: ThingReply | None = None
    for question in questions:
        reply = answerer.answer(question, scene, previous=reply)
    assert reply is not None
    return reply.text


FRUITS = {
    "how many fruits are in the bowl?": (
        "There are four fruits: the red ripe sound apple, the green unripe sound pear, the "
        "blue overripe rotten plum and the green ripe sound apple."
    ),
    "how many pieces of fruit are there?": (
        "There are four fruits: the red ripe sound apple, the green unripe sound pear, the "
        "blue overripe rotten plum and the green ripe sound apple."
    ),
    "how many green things?": (
        "There are two green fruits: the green unripe sound pear and the green ripe sound apple."
    ),
    "what is wrong with the bowl?": (
        "The bowl is spoiled: the green unripe sound pear will spoil, since the green unripe "
        "sound pear touches the blue overripe rotten plum and the blue overripe rotten plum "
        "is rotten; the blue overripe rotten plum will spoil, since the blue overripe rotten "
        "plum is rotten."
    ),
    "if the plum was gone, would the bowl still be fresh?": "Then: yes, the bowl is fresh.",
    "what happens if I take the plum away?": (
        "The green unripe sound pear would keep and the bowl would be fresh."
    ),
    "what would happen to the pear if the plum were removed?": (
        "The green unripe sound pear would keep."
    ),
    "why can't the pear be sold?": (
        "The pear is the green unripe sound pear. It does not follow that the green unripe "
        "sound pear can be sold: the green unripe sound pear is unripe; the green unripe "
        "sound pear will spoil, since the green unripe sound pear touches the blue overripe "
        "rotten plum and the blue overripe rotten plum is rotten."
    ),
    "why isn't the bowl fresh?": (
        "The bowl is spoiled: the green unripe sound pear will spoil, since the green unripe "
        "sound pear touches the blue overripe rotten plum and the blue overripe rotten plum "
        "is rotten; the blue overripe rotten plum will spoil, since the blue overripe rotten "
        "plum is rotten."
    ),
    "isn't the plum rotten?": "Yes, the blue overripe rotten plum is rotten.",
    "which fruit is ripest?": "It is the blue overripe rotten plum.",
    "which fruit is the least ripe?": "It is the green unripe sound pear.",
    "is the plum riper than the pear?": (
        "Yes, the blue overripe rotten plum is riper than the green unripe sound pear."
    ),
    "is the plum more ripe than the pear?": (
        "Yes, the blue overripe rotten plum is riper than the green unripe sound pear."
    ),
    "which apple is on the far right?": "It is the green ripe sound apple.",
    "is the apple on the right green?": "Yes, the green ripe sound apple is green.",
    "do the two apples touch?": "No, not every apple is next to every apple.",
    "do the apples have the same colour?": (
        "No: the red ripe sound apple is red and the green ripe sound apple is green."
    ),
    "do the apples have different colours?": (
        "Yes: the red ripe sound apple is red and the green ripe sound apple is green."
    ),
    "what do the apples have in common?": (
        "They share species, ripeness and rotten: each is an apple, each is ripe and each is sound."
    ),
    "what is the difference between the apples?": (
        "They differ in colour: the red ripe sound apple is red and the green ripe sound "
        "apple is green."
    ),
    "which fruits will keep?": (
        "There are two fruits that are not at risk: the red ripe sound apple and the green "
        "ripe sound apple."
    ),
    "is there only one plum?": "Yes: there is one plum: the blue overripe rotten plum.",
    "what kind of fruit is the third one?": "The blue overripe rotten plum is a plum.",
    "the second fruit from the left, what is it?": (
        "It is the green unripe sound pear: it is a pear, it is green, it is unripe and it is"
        " sound."
    ),
    "what would make the pear keep?": (
        "If the blue overripe rotten plum were sound, the green unripe sound pear would keep."
        " Three other changes as small would do, too."
    ),
    "how could the pear be sold?": (
        "If the green unripe sound pear were ripe and the blue overripe rotten plum were "
        "sound, the green unripe sound pear could be sold. Three other changes as small would"
        " do, too. One thing more was not tried."
    ),
}
TABLE = {
    "what's on the table?": (
        "There are four things: the small red metal cube, the large blue rubber sphere, the "
        "small green rubber cube and the small yellow metal cylinder."
    ),
    "what does the picture show?": (
        "There are four things: the small red metal cube, the large blue rubber sphere, the "
        "small green rubber cube and the small yellow metal cylinder."
    ),
    "does the picture show a ball?": "Yes: there is one sphere: the large blue rubber sphere.",
    "is the ball red or blue?": "The large blue rubber sphere is blue.",
    "is the ball either red or green?": (
        "No, the large blue rubber sphere is neither red nor green."
    ),
    "is the ball red, green or blue?": "The large blue rubber sphere is blue.",
    "which is bigger, the ball or the red cube?": "It is the large blue rubber sphere.",
    "which is further left, the ball or the green cube?": "It is the large blue rubber sphere.",
    "what is furthest to the left?": "It is the small red metal cube.",
    "how many red and green cubes are there?": (
        "There are two cubes that are red or green: the small red metal cube and the small "
        "green rubber cube."
    ),
    "are there more red than metal things?": "No: there is one red thing and two metal things.",
    "are both cubes small?": "Yes, every cube is small.",
    "do both cubes have the same material?": (
        "No: the small red metal cube is made of metal and the small green rubber cube is "
        "made of rubber."
    ),
    "is no cube large?": "Yes: there is no large cube.",
    "what if I take away the green cube?": "The small yellow metal cylinder would fall.",
    "can I safely remove the ball?": "Nothing would fall.",
    "why doesn't the cylinder fall?": (
        "The cylinder is the small yellow metal cylinder. It does not follow that the small "
        "yellow metal cylinder would fall: the small yellow metal cylinder is not on the "
        "large blue rubber sphere."
    ),
    "why isn't the green cube clear?": (
        "The green cube is the small green rubber cube. It does not follow that the small "
        "green rubber cube is clear: the small green rubber cube carries something, since the"
        " small yellow metal cylinder is on the small green rubber cube."
    ),
    "what shape is the thing the cylinder is on?": "The small green rubber cube is a cube.",
    "tell me about the ball": (
        "It is the large blue rubber sphere: it is large, it is blue, it is made of rubber "
        "and it is a sphere."
    ),
    "name the shapes": "There are three shapes: cube, sphere and cylinder.",
    "how many things are there in total?": (
        "There are four things: the small red metal cube, the large blue rubber sphere, the "
        "small green rubber cube and the small yellow metal cylinder."
    ),
    "is everything small?": "No, not every thing is small.",
    "does the ball really lie on the cube?": (
        "Which cube? There are two: the small red metal cube and the small green rubber cube."
    ),
}
BLOCKS = {
    "how many blocks does the structure have?": (
        "There are three blocks: the green wide block, the red narrow block and the teal "
        "narrow block."
    ),
    "which block is at the top?": "It is the teal narrow block.",
    "what is between the green and the teal block?": (
        "There is one block between the green wide block and the teal narrow block: the red "
        "narrow block."
    ),
    "will it fall?": "Yes, the structure is unstable.",
    "how can I make it stable?": (
        "If it were not so that the middle of the teal narrow block lies beyond the edge of "
        "the red narrow block, the structure would be stable. One other change as small would"
        " do, too."
    ),
}


@pytest.mark.parametrize("question", FRUITS)
def test_fruits_in_a_bowl(question: str, fruits: Asked) -> None:
    assert told(fruits, question) == FRUITS[question]


@pytest.mark.parametrize("question", TABLE)
def test_things_on_a_table(question: str, table: Asked) -> None:
    assert told(table, question) == TABLE[question]


@pytest.mark.parametrize("question", BLOCKS)
def test_blocks_of_a_structure(question: str, blocks: Asked) -> None:
    assert told(blocks, question) == BLOCKS[question]


@pytest.mark.parametrize(
    ("questions", "answer"),
    [
        (["how many cubes are there?", "how many are red?"], "There is one red cube: {red}."),
        (
            ["how many cubes are there?", "how many are red?", "how many are green?"],
            "There is one green cube: {green}.",
        ),
        (["which things are cubes?", "which are green?"], "There is one green cube: {green}."),
        (["how many cubes are there?", "what is on the green cube?"], "{on_green}"),
    ],
)
def test_how_many_of_them(questions: list[str], answer: str, table: Asked) -> None:
    red, green = "the small red metal cube", "the small green rubber cube"
    on_green = f"There is one thing on {green}: the small yellow metal cylinder."
    assert told(table, *questions) == answer.format(red=red, green=green, on_green=on_green)


def test_cards_are_named_by_their_places() -> None:
    domain = load_domain("set_cards")
    assert domain.things is not None
    rows = [(number, "red", "solid", "oval") for number in ("one", "two", "three")]
    rows += [("one", "green", "striped", "diamond")]
    values = [dict(zip(domain.things.features, row, strict=True)) for row in rows]
    scene = thing_scene(domain.things, values, relations={})
    cards = ThingAnswerer(domain.things), SceneConclusions(domain).conclude(scene)
    assert told(cards, "are the first, the second and the third card a set?").startswith("Yes:")
    assert told(cards, "are the cards 1, 2 and 4 a set?").startswith("No:")
    missing = told(cards, "which card is missing for a set with the first and second card?")
    assert missing.startswith("The red solid oval card with three symbols makes a set")
    assert told(cards, "if the third card were green, would there be a set?") == (
        "Then: no: there is no set."
    )
    assert told(cards, "is there a set?", "what if the third card had two symbols?") == (
        "Then: no: there is no set."
    )
    assert told(cards, "are there more red than green cards?") == (
        "Yes: there are three red cards and one green card."
    )
    assert told(cards, "does the fourth card show ovals?") == (
        "No, the green striped diamond card with one symbol is not oval."
    )
    assert told(cards, "what shape is on the fourth card?") == (
        "The green striped diamond card with one symbol shows diamonds."
    )
    assert told(cards, "what is on the fourth card?").startswith("It is the green striped")


def test_two_questions_at_once_are_asked_for_one_by_one(table: Asked) -> None:
    with pytest.raises(QuestionError, match="ask one question at a time"):
        told(table, "how many cubes are there and how many balls?")


def test_what_stands_behind_and_is_not_what_stands_on_the_thing_before(table: Asked) -> None:
    """ "The ball the cube is under" needs no "that"; behind "and" it would be another question."""
    assert told(table, "how many things are there the red cube is under?").startswith("There")
    with pytest.raises(QuestionError, match="do not understand"):
        told(table, "is a ball on a cube and a red ball is on a blue cube?")


def test_a_statement_of_any_length_is_read_in_no_time(table: Asked) -> None:
    """What follows it is looked for only where a question may begin."""
    with pytest.raises(QuestionError, match="do not understand"):
        told(table, "there is " + "a cube left of " * 29 + "it it")
