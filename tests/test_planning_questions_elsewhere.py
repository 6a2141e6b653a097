"""Questions about a run of two robots, and in a domain that has no words but its names."""

from __future__ import annotations

from pathlib import Path

import pytest

from seewhy.planning.dialogue.run_answers import answer
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.execution import Run, execute
from seewhy.planning.goal import read_goal

TWO_KNOWLEDGE = """
#sort robot = {rob1, rob2}.
#sort place = {hall, kitchen, attic}.
#sort parcel = {letter, crate}.
#static strong(robot).
strong(rob2).
#static heavy(parcel).
heavy(crate).
#fluent basic at(robot, place).
#fluent basic lies(parcel, place).
#fluent basic carries(robot, parcel).
#action move(robot, place).
#action fetch(robot, parcel).
move(R, P) causes at(R, P).
fetch(R, C) causes carries(R, C).
-at(R, P2) if at(R, P1), P1 != P2.
-lies(C, P) if carries(R, C).
impossible move(R, P) if at(R, P).
%% a robot fetches what lies where it is
impossible fetch(R, C) if at(R, P), not lies(C, P).
%% only a strong robot lifts what is heavy
impossible fetch(R, C) if heavy(C), not strong(R).
default -carries(R, C).
default -lies(C, P).
"""
TWO_HISTORY = """
observed at(rob1, hall) at 0.
observed at(rob2, hall) at 0.
observed lies(letter, kitchen) at 0.
observed lies(crate, attic) at 0.
"""
TWO_WORDS = """
[planning]
name = "two"
title = "Two robots"
robot = "rob1"

[things]
rob1 = "the first robot"
rob2 = "the second robot"
letter = "the letter"
crate = "the crate"
hall = "the hall"
kitchen = "the kitchen"
attic = "the attic"

[fluents.at]
say = "{0} is in {1}"
deny = "{0} is not in {1}"

[fluents.lies]
say = "{0} lies in {1}"
deny = "{0} does not lie in {1}"

[actions.move]
do = "move to {1}"
did = "moved to {1}"

[actions.fetch]
do = "fetch {1}"
did = "fetched {1}"

[[sensing]]
literal = "at(R, P)"
where = "place(P)"
"""


def written(folder: Path, *, knowledge: str, words: str, history: str = "") -> PlanningDomain:
    for name, text in (("knowledge.al", knowledge), ("planning.toml", words),
                       ("history.al", history)):  # fmt: skip
        (folder / name).write_text(text, encoding="utf-8")
    return load_planning_domain(folder)


def run_to(domain: PlanningDomain, goal: str) -> Run:
    aim = read_goal(goal, domain.knowledge)
    *_, run = execute(domain, aim, sensed=[], act=lambda _: [])
    return run


@pytest.fixture(scope="module")
def two(tmp_path_factory: pytest.TempPathFactory) -> tuple[PlanningDomain, Run]:
    folder = tmp_path_factory.mktemp("two")
    domain = written(folder, knowledge=TWO_KNOWLEDGE, words=TWO_WORDS, history=TWO_HISTORY)
    return domain, run_to(domain, "carries(rob2, crate), carries(rob1, letter)")


def test_a_name_of_which_questions_keep_nothing(tmp_path: Path) -> None:
    """Who is called "the" is asked about by the name of the term, and "his" stands for that."""
    words = TWO_WORDS.replace('"the second robot"', '"the"') + '\n[possessives]\nrob2 = "his"\n'
    domain = written(tmp_path, knowledge=TWO_KNOWLEDGE, words=words, history=TWO_HISTORY)
    run = run_to(domain, "carries(rob2, crate)")
    told = answer(domain, run, "is rob2 in his location?").query
    assert (told.predicate, told.arguments) == ("at", ("rob2", "rob2"))


TO_THE_ATTIC = (
    'because I wanted to {}fetch the crate. Otherwise I could not have done that: "a robot fetches '
    'what lies where it is", and {} was in the hall and the crate did not lie in the hall.'
)
TWO = {
    "what did you do?": (
        "I moved to the kitchen and fetched the letter. The second robot moved to the attic "
        "and fetched the crate. The goal is reached."
    ),
    "what did rob2 do?": (
        "The second robot moved to the attic and fetched the crate. The goal is reached."
    ),
    "why did you move to the attic?": (
        "I did not move to the attic; the second robot did at step 2."
    ),
    "why did the second robot move to the attic?": (
        "The second robot moved to the attic at step 2 "
        + TO_THE_ATTIC.format("let the second robot ", "the second robot")
    ),
    "second robot, why did you move to the attic?": (
        "I moved to the attic at step 2 " + TO_THE_ATTIC.format("", "I")
    ),
    "what did you do, rob2?": (
        "The first robot moved to the kitchen and fetched the letter. I moved to the attic "
        "and fetched the crate. The goal is reached."
    ),
    "have you fetched the crate?": (
        "No, I have not fetched the crate; the second robot did at step 3."
    ),
    "has rob2 fetched the crate?": "Yes, the second robot fetched the crate at step 3.",
    "why did the second robot not fetch the letter at step 0?": (
        'The second robot could not fetch the letter at step 0: "a robot fetches what lies '
        'where it is", and the second robot was in the hall and the letter did not lie in the'
        " hall."
    ),
    "what was your plan?": (
        "At step 0 I planned to move to the kitchen, fetch the letter, let the second robot "
        "move to the attic and let the second robot fetch the crate."
    ),
    "rob2, where are you?": (
        "I am in the attic. I moved to the attic at step 2; nothing that I know of has "
        "changed it since."
    ),
    "rob2, where is the first robot?": (
        "The first robot is in the kitchen. The first robot moved to the kitchen at step 0; "
        "nothing that I know of has changed it since."
    ),
    "who carries the crate?": "The second robot carries the crate.",
    "what if the second robot moved to the attic at step 0?": (
        "If the second robot moved to the attic, I would move to the kitchen, fetch the "
        "letter and let the second robot fetch the crate: 3 actions instead of 4."
    ),
    "why did the second robot fetch the crate rather than the letter?": (
        "The second robot fetched the crate at step 3 because my goal was that the second "
        'robot carries the crate. The second robot could not fetch the letter at step 3: "a '
        'robot fetches what lies where it is", and the second robot was in the attic and the '
        "letter did not lie in the attic."
    ),
}


@pytest.mark.parametrize("question", TWO)
def test_robots_are_named_and_i_is_who_is_asked(
    two: tuple[PlanningDomain, Run], question: str
) -> None:
    domain, run = two
    assert answer(domain, run, question).text == TWO[question]


def test_a_plan_says_which_robot_does_what(two: tuple[PlanningDomain, Run]) -> None:
    domain, run = two
    assert [domain.words.do(action) for action in run.actions] == [
        "move to the kitchen",
        "fetch the letter",
        "let the second robot move to the attic",
        "let the second robot fetch the crate",
    ]


NAMES_KNOWLEDGE = """
#sort lamp = {lamp1, lamp2}.
#sort colour = {red, green}.
#static next_to(lamp, lamp).
#static paint(lamp, colour).
#static has_switch(lamp).
next_to(lamp1, lamp2).
paint(lamp1, red).
has_switch(lamp1).
has_switch(lamp2).
#fluent basic lit(lamp).
#action press(lamp).
press(L) causes lit(L) if has_switch(L).
default -lit(L).
"""
NAMES_WORDS = """
[planning]
name = "names"
title = "Words that are names"
"""
NAMED = {
    "is lamp1 next to lamp2?": "Yes, lamp1 is next to lamp2. I know that from the beginning.",
    "what is next to lamp2?": "Lamp1 is next to lamp2.",
    "what is the paint of lamp1?": "The paint of lamp1 is red.",
    "does lamp2 have switch?": "Yes, lamp2 has switch. I know that from the beginning.",
    "which lamps have switch?": "Lamp1 and lamp2 have switch.",
    "was lamp1 lit?": (
        "Yes, since step 1 I have believed that lamp1 is lit. I pressed lamp1 at step 0."
    ),
    "is lamp2 next to lamp1?": (
        "Not as far as I know: nothing tells me that lamp2 is next to lamp1."
    ),
}


@pytest.mark.parametrize("question", NAMED)
def test_without_words_the_names_make_clauses(tmp_path: Path, question: str) -> None:
    domain = written(tmp_path, knowledge=NAMES_KNOWLEDGE, words=NAMES_WORDS)
    run = run_to(domain, "lit(lamp1)")
    assert answer(domain, run, question).text == NAMED[question]


SHELVES_KNOWLEDGE = """
#sort robot = {rob1}.
#sort room = {hall, cellar}.
#sort shelf = {rack}.
#sort chest = {trunk}.
#sort thing = {cup, watering_can}.
#sort fill = {full, dry}.
#fluent basic at(robot, room).
#fluent basic stands(thing, room).
#fluent basic lies(thing, shelf).
#fluent basic kept(thing, chest).
#fluent basic topping(thing, chest).
#fluent basic empty(thing).
#fluent basic can(robot, fill).
#action move(robot, room).
#action pour(robot, thing).
move(R, P) causes at(R, P).
pour(R, T) causes empty(T).
pour(R, watering_can) causes can(R, dry).
-can(R, full) if can(R, dry).
-at(R, P2) if at(R, P1), P1 != P2.
impossible move(R, P) if at(R, P).
default -stands(T, P).
default -lies(T, S).
default -kept(T, C).
default -topping(T, C).
default -empty(T).
"""
SHELVES_WORDS = """
[planning]
name = "shelves"
title = "Shelves"
robot = "rob1"

[things]
hall = "the hall"
cellar = "the cellar"
rack = "the rack"
trunk = "the trunk"
watering_can = "the watering can"

[fluents.at]
say = "{0} is in {1}"
deny = "{0} is not in {1}"

[fluents.stands]
say = "{0} is in {1}"
deny = "{0} is not in {1}"

[fluents.lies]
say = "{0} is on {1}"
deny = "{0} is not on {1}"

[fluents.kept]
say = "{0} is inside {1}"
deny = "{0} is not inside {1}"

[fluents.topping]
say = "{0} is on {1}"
deny = "{0} is not on {1}"

[fluents.empty]
say = "{0} is empty"
deny = "{0} is not empty"

[fluents.can]
say = "the can of {0} is {1}"
deny = "the can of {0} is not {1}"

[actions.move]
do = "move to {1}"
did = "moved to {1}"

[actions.pour]
do = "empty {1}"
did = "emptied {1}"
"""
SHELVES_HISTORY = """
observed at(rob1, hall) at 0.
observed can(rob1, full) at 0.
"""
SHELVES = {
    "what is on the rack?": "I know of nothing on the rack; I have not looked there.",
    "what is in the cellar?": "I know of nothing in the cellar; I have not looked there.",
    "what is inside the trunk?": (
        "I know of nothing inside or on the trunk; I have not looked there."
    ),
    "was the can of you full at step 0?": (
        "Yes, my can was full. I saw at step 0 that my can was full."
    ),
    "was the watering can empty at step 0?": "No, the watering can was not empty. That is usual.",
}


@pytest.mark.parametrize("question", SHELVES)
def test_places_and_nouns_are_said_as_what_they_are(tmp_path: Path, question: str) -> None:
    domain = written(
        tmp_path, knowledge=SHELVES_KNOWLEDGE, words=SHELVES_WORDS, history=SHELVES_HISTORY
    )
    run = run_to(domain, "empty(watering_can)")
    assert answer(domain, run, question).text == SHELVES[question]
