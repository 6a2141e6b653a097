"""What axioms conclude of things: asked, answered with reasons, supposed otherwise."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.dialogue.scene_conclusions import SceneConclusions
from seewhy.dialogue.things.answering import ThingAnswerer, ThingReply
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import QuestionError, SeeWhyError
from test_things_domain import DOMAIN, KNOWLEDGE, write_plates

THINGS = (
    "large red rubber cube",
    "small green rubber cube",
    "small blue metal sphere",
    "large purple rubber sphere",
    "small yellow rubber cube",
)
"""The green cube is on the red one, the blue ball on that, the yellow cube on the purple ball."""
ON = ((1, 0), (2, 1), (4, 3))
CARDS = (
    "one red solid oval",
    "two red solid oval",
    "three red solid oval",
    "one green striped diamond",
    "two purple empty diamond",
    "two purple empty squiggle",
)


def scene_of(
    domain: Domain, said: Sequence[str], relations: Mapping[str, Sequence[tuple[int, int]]]
) -> ThingScene:
    things = domain.things
    assert things is not None
    values = [dict(zip(things.features, one.split(), strict=True)) for one in said]
    return SceneConclusions(domain).conclude(thing_scene(things, values, relations=relations))


@pytest.fixture(scope="module")
def tabletop() -> Domain:
    return load_domain("tabletop")


@pytest.fixture(scope="module")
def stacks(tabletop: Domain) -> ThingScene:
    return scene_of(tabletop, THINGS, {"on": ON})


@pytest.fixture(scope="module")
def set_cards() -> Domain:
    return load_domain("set_cards")


@pytest.fixture(scope="module")
def cards(set_cards: Domain) -> ThingScene:
    return scene_of(set_cards, CARDS, {})


def ask(domain: Domain, scene: ThingScene, *questions: str) -> ThingReply:
    """The answer to the last of several questions, each of which may go with the one before."""
    assert domain.things is not None
    answerer = ThingAnswerer(domain.things)
    reply: ThingReply | None = None
    for question in questions:
        reply = answerer.answer(question, scene, previous=reply)
    assert reply is not None
    return reply


def test_what_follows_from_a_stack(stacks: ThingScene) -> None:
    assert stacks.concluded == {"falls": 0b10000, "clear": 0b10100, "stable": 0b01111}
    assert stacks.related["above"] == (0b00110, 0b00100, 0, 0b10000, 0)
    assert stacks.related["falls_without"] == stacks.related["above"]


ANSWERS = {
    "which things would fall?": "There is one thing that would fall: the small yellow rubber cube.",
    "how many things are stable?": "There are four things that are stable: the large red rubber "
    "cube, the small green rubber cube, the small blue metal sphere and the large purple rubber "
    "sphere.",
    "does the yellow cube fall?": "Yes, the small yellow rubber cube would fall.",
    "will the green cube fall?": "No, the small green rubber cube would not fall.",
    "is the red cube clear?": "No, the large red rubber cube is not clear.",
    "are there any clear cubes?": "Yes: there is one cube that is clear: the small yellow rubber "
    "cube.",
    "which unstable things are there?": "There is one thing that would fall: the small yellow "
    "rubber cube.",
    "would nothing fall?": "No: there is one thing that would fall: the small yellow rubber cube.",
    "what would happen if the green cube were removed?": "The small blue metal sphere would fall "
    "and the large red rubber cube would be clear.",
    "what happens if I take the red cube away?": "The small green rubber cube and the small blue "
    "metal sphere would fall.",
    "what would happen if the yellow cube were gone?": "The large purple rubber sphere would be "
    "clear.",
    "what would happen if the red cube were a ball?": "The small green rubber cube and the small "
    "blue metal sphere would fall.",
    "what would happen if the blue ball were red?": "Nothing else would follow.",
    "would the blue ball fall if the red cube were taken away?": "Yes, the small blue metal sphere "
    "would fall without the large red rubber cube.",
    "would the purple ball fall without the yellow cube?": "No, the large purple rubber sphere "
    "would not fall without the small yellow rubber cube.",
    "how many things would fall if the red cube were removed?": "There are two things that would "
    "fall without the large red rubber cube: the small green rubber cube and the small blue metal "
    "sphere.",
    "would anything fall without the red cube?": "Yes: there are two things that would fall "
    "without the large red rubber cube: the small green rubber cube and the small blue metal "
    "sphere.",
    "is anything on the purple ball?": "Yes: there is one thing on the large purple rubber sphere: "
    "the small yellow rubber cube.",
    "is there nothing on the blue ball?": "Yes: there is no thing on the small blue metal sphere.",
    "is nothing on the purple ball?": "No: there is one thing on the large purple rubber sphere: "
    "the small yellow rubber cube.",
    "what does the red cube carry?": "There is one thing on the large red rubber cube: the small "
    "green rubber cube.",
    "what is above the red cube?": "There are two things above the large red rubber cube: the "
    "small green rubber cube and the small blue metal sphere.",
}


@pytest.mark.parametrize("question", ANSWERS)
def test_questions_about_stacks(question: str, tabletop: Domain, stacks: ThingScene) -> None:
    assert ask(tabletop, stacks, question).text == ANSWERS[question]


def test_reasons_go_down_to_what_was_seen(tabletop: Domain, stacks: ThingScene) -> None:
    tree = ask(tabletop, stacks, "which things would fall?").justification.to_text()
    assert '│  └─ it would fall: "nothing stays on a ball"' in tree
    assert "the small yellow rubber cube is on the large purple rubber sphere" in tree
    assert "it does not follow that the small green rubber cube would fall" in tree
    told = ask(tabletop, stacks, "which things would fall?", "why?").text
    assert told == (
        "There is the small yellow rubber cube: it would fall, since the small yellow rubber cube "
        "is on the large purple rubber sphere and the large purple rubber sphere is a sphere."
    )
    gone = ask(tabletop, stacks, "what would happen if the red cube were removed?")
    assert "what is above a thing falls when that is taken away" in gone.justification.to_text()
    assert gone.value == (1, 2)
    denied = ask(tabletop, stacks, "is the red cube clear?", "why not?").text
    assert "the small green rubber cube is on the large red rubber cube" in denied


def test_what_is_supposed_is_concluded_anew(tabletop: Domain, stacks: ThingScene) -> None:
    text = ask(
        tabletop, stacks, "how many things would fall?", "what if the ball were a cube?"
    ).text
    assert text.startswith("Which sphere?")
    text = ask(
        tabletop, stacks, "how many things would fall?", "what if the purple ball were a cube?"
    ).text
    assert text == "Then: there is no thing that would fall."
    reply = ask(tabletop, stacks, "how many things would fall?", "what would make the answer zero?")
    assert reply.text.startswith("If the large purple rubber sphere were a cube, ")


def test_no_thing_more_than_the_most_is_tried(tabletop: Domain) -> None:
    small = tabletop.with_most_things(2)
    full = scene_of(small, (THINGS[4], THINGS[0]), {"on": [(0, 1)]})
    reply = ask(small, full, "would anything fall?", "what would make the answer yes?")
    assert reply.text.startswith("If the large red rubber cube were a sphere, the answer would be ")
    assert reply.text.endswith("One thing more was not tried.")


def test_of_a_scene_of_which_nothing_was_concluded(tabletop: Domain) -> None:
    things = tabletop.things
    assert things is not None
    bare = thing_scene(things, [{"shape": "cube"}], relations={})
    reply = ask(tabletop, bare, "would anything fall?")
    assert reply.value is None
    assert reply.text.startswith("I don't know")
    reply = ask(tabletop, bare, "what would happen if the cube were removed?")
    assert reply.value is None


def test_the_opposite_of_a_word_is_no_misspelling_of_it(
    tabletop: Domain, stacks: ThingScene
) -> None:
    with pytest.raises(QuestionError, match="'unclear' is no word of the domain"):
        ask(tabletop, stacks, "which unclear things are there?")


SET_ANSWERS = {
    "is there a set?": "Yes: there are two sets: the red solid oval card with one symbol, the red "
    "solid oval card with two symbols and the red solid oval card with three symbols; the red "
    "solid oval card with three symbols, the green striped diamond card with one symbol and the "
    "purple empty squiggle card with two symbols.",
    "how many sets are there?": (0, 1, 2),
    "are the first, the second and the third card a set?": "Yes: the red solid oval card with one "
    "symbol, the red solid oval card with two symbols and the red solid oval card with three "
    "symbols are a set.",
    "do cards 1, 2 and 4 form a set?": "No: the red solid oval card with one symbol, the red solid "
    "oval card with two symbols and the green striped diamond card with one symbol are no set.",
    "are the first and the second card a set?": "A set takes three cards, and these are two cards.",
    "is the third card part of a set?": "Yes, the red solid oval card with three symbols is part "
    "of a set.",
    "is the fifth card in a set?": "No, the purple empty diamond card with two symbols is not part "
    "of a set.",
    "which card would complete the first and the second card?": "The red solid oval card with "
    "three symbols makes a set with the red solid oval card with one symbol and the red solid "
    "oval card with two symbols.",
    "which card would complete the fourth and the fifth card to a set?": "A red solid diamond card "
    "with three symbols would make a set with the green striped diamond card with one symbol and "
    "the purple empty diamond card with two symbols; there is none here.",
    "which card would complete the first card?": None,
    "what do the second and the third card differ in?": "They differ in number of symbols: the red "
    "solid oval card with two symbols has two symbols and the red solid oval card with three "
    "symbols has three symbols.",
    "how many two cards are there?": "There are three cards with two symbols: the red solid oval "
    "card with two symbols, the purple empty diamond card with two symbols and the purple empty "
    "squiggle card with two symbols.",
    "how many red cards with two symbols are there?": "There is one red card with two symbols: the "
    "red solid oval card with two symbols.",
    "is the first card two?": "No, the red solid oval card with one symbol has one symbol, not "
    "two.",
    "are all red cards single?": "No, not every red card has one symbol.",
    "how many symbols does the fourth card have?": "The green striped diamond card with one symbol "
    "has one symbol.",
}


@pytest.mark.parametrize("question", SET_ANSWERS)
def test_questions_about_cards(question: str, set_cards: Domain, cards: ThingScene) -> None:
    expected = SET_ANSWERS[question]
    if expected is None:
        with pytest.raises(QuestionError):
            ask(set_cards, cards, question)
        return
    reply = ask(set_cards, cards, question)
    if isinstance(expected, tuple):
        assert reply.value == 2
        assert cards.groups["set"][0] == expected
    else:
        assert reply.text == expected


def test_why_three_cards_are_no_set(set_cards: Domain, cards: ThingScene) -> None:
    before = "are the first, the second and the fourth card a set?"
    for question in ("why not?", "why are these three no set?", "why are cards 1, 2 and 4 no set?"):
        text = ask(set_cards, cards, before, question).text
        assert "the colours of the three are all alike or all different, since" in text
        assert "the green striped diamond card with one symbol is green" in text
    tree = ask(set_cards, cards, before).justification.to_text()
    assert 'does not apply: "colours fit that are all alike"' in tree
    assert "but the green striped diamond card with one symbol is green" in tree


def test_what_would_complete_them(set_cards: Domain, cards: ThingScene) -> None:
    reply = ask(
        set_cards,
        cards,
        "what do the fourth and the fifth card have in common?",
        "which card would complete them?",
    )
    assert reply.text.startswith(
        "A red solid diamond card with three symbols would make a set with"
    )
    assert "numbers fit that are all different" in reply.justification.to_text()
    assert reply.value == ()


def test_where_there_is_no_set(set_cards: Domain) -> None:
    few = scene_of(set_cards, CARDS[:2] + CARDS[3:5], {})
    reply = ask(set_cards, few, "is there a set?")
    assert (reply.text, reply.value) == ("No: there is no set.", False)
    assert "none of the four ways to take three cards makes a set" in (
        reply.justification.to_text()
    )
    assert ask(set_cards, few, "is there no set?").value is True


def test_they_are_those_that_were_spoken_of(set_cards: Domain, cards: ThingScene) -> None:
    differ = "what do the second and the third card differ in?"
    text = ask(set_cards, cards, differ, "what do they have in common?").text
    assert text == (
        "They share colour, shading and shape: each is red, each is solid and each shows ovals."
    )


@pytest.mark.parametrize(
    ("begins", "name", "said", "count"),
    [("## What follows", "tabletop", THINGS, 5), ("## Cards of SET", "set_cards", CARDS[:5], 6)],
)
def test_the_page_says_what_follows(
    begins: str, name: str, said: Sequence[str], count: int
) -> None:
    page = (Path(__file__).parents[1] / "docs" / "things.md").read_text("utf-8")
    section = page.split(begins)[1].split("\n## ")[0]
    rows = re.findall(r"^\| [^|]+ \| ([A-Z][^|]+\?) \| ([^|]+) \|$", section, re.M)
    assert len(rows) == count
    domain = load_domain(name)
    scene = scene_of(domain, said, {"on": ON} if name == "tabletop" else {})
    for question, answer in rows:
        assert ask(domain, scene, question).text == answer


CONCLUDED = """
#static bruised(fruit).
#static pile(fruit, fruit, fruit).
#static lone(plate).
bruised(X) if above(Y, X).
"""
TABLES = """
[things.conclusions.bruised]
say = "{it} is bruised"

[things.groups.pile]
"""
WRONG = {
    "conclusion not declared": (
        "[things.conclusions.bruised]",
        "[things.conclusions.bruisd]",
        "the conclusion 'bruisd' is not declared in knowledge.al; did you mean 'bruised'?",
    ),
    "conclusion of the picture": (
        "[things.conclusions.bruised]",
        "[things.conclusions.lone]",
        "the conclusion 'lone' must be declared as '#static lone(fruit).', got 'lone(plate)'",
    ),
    "conclusion that changes": (
        "[things.conclusions.bruised]",
        "[things.conclusions.eaten]",
        "the conclusion 'eaten' must be declared as a static, got '#fluent basic eaten(fruit)'",
    ),
    "conclusion that is seen": (
        "[things.conclusions.bruised]",
        "[things.conclusions.ripe]",
        "'ripe' is a feature of things, too; leave one of the two out",
    ),
    "group of one": (
        "[things.groups.pile]",
        "[things.groups.bruised]",
        "the group 'bruised' must be declared of two things or more, as in '#static bruised(fruit,"
        " fruit, fruit).', got 'bruised(fruit)'",
    ),
    "group that is seen": (
        "[things.groups.pile]",
        "[things.groups.above]",
        "'above' is a relation of things, too; leave one of the two out",
    ),
    "noun of a group and of a thing": (
        "[things.groups.pile]",
        '[things.groups.pile]\nwords = ["piece"]',
        "'piece' stands for 'pile' and for 'any fruit'; let it stand for one",
    ),
    "clause of a group": (
        "[things.groups.pile]",
        '[things.groups.pile]\nsay = "they are a pile"',
        "'things.groups.pile.say': must have the slot {them} and no others, got 'they are a pile'",
    ),
    "support that is measured": (
        "most = 8",
        'most = 8\nsupport = "above"',
        "support = 'above' is no relation that is seen",
    ),
    "removed that is none": (
        'side = ["top"]',
        'side = ["top"]\nremoved = "bruisd"',
        "removed = 'bruisd' is no conclusion; did you mean 'bruised'?",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_with_conclusions(name: str, tmp_path: Path) -> None:
    old, new, said = WRONG[name]
    text = DOMAIN + TABLES
    assert old in text
    write_plates(tmp_path, domain=text.replace(old, new), knowledge=KNOWLEDGE + CONCLUDED)
    with pytest.raises(SeeWhyError) as refused:
        load_domain(tmp_path)
    assert said in str(refused.value)
    assert str(refused.value).startswith(f"{tmp_path}/domain.toml:")


def test_conclusions_without_words_of_their_own(tmp_path: Path) -> None:
    write_plates(tmp_path, domain=DOMAIN + TABLES, knowledge=KNOWLEDGE + CONCLUDED)
    things = load_domain(tmp_path).things
    assert things is not None
    assert things.conclusions["bruised"].deny == "it is not so that {it} is bruised"
    pile = things.groups["pile"]
    assert (pile.size, pile.one, pile.many) == (3, "pile", "piles")
    assert (pile.say, pile.deny) == ("{them} are a pile", "{them} are no pile")
