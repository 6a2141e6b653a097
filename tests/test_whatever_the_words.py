"""Whatever words a folder has: it works, or one sentence says what is wrong with it.

Words of which questions keep nothing ("a", "please"), that other words are made of ("is", "not"),
in other alphabets, or without any letter.
"""

from __future__ import annotations

import json
import re

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import things_builder
from seewhy.check.change import check_change
from seewhy.check.domain import check_domain
from seewhy.data.thing_scene import thing_scene
from seewhy.dialogue.things.answering import ThingAnswerer
from seewhy.domain.domain import load_domain
from seewhy.errors import SeeWhyError
from seewhy.planning.dialogue.run_answers import RunAnswers
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.execution.execution import Run
from seewhy.planning.goal import read_goal
from seewhy.planning.spoken_goals import SpokenGoals
from test_planning_domain import KNOWLEDGE, TOML

ODD = (
    "a", "the", "a the", "it", "is", "is not", "not", "of", "no", "yes", "and", "or", "why", "what",
    "like", "I", "there", "are", "do", "can", "if", "more", "most", "how many", "one", "other",
    "same", "nothing", "please", "now", "then", "step", "slot", "you", "me", "his", "thing",
    "things", "red", "left of", "1", "-1", "007", "½", "'s", "the's", "x'y", "a_b", "_", "★", "?",
    "'", "", " ", "{", "{0}", "{it}", "\\", '"', "😀", "зелёный", "绿色", "é", "ﬁ", "İ", "ª",
    "\u200b", "x" * 90,
)  # fmt: skip
WORDS = st.sampled_from(ODD) | st.text(
    st.characters(exclude_categories=["Cs", "Cc"]), min_size=1, max_size=9
)
THING_WORDS = (
    "shape", "box", "ball", "left of", "leftmost", "on", "tidy", "the picture", "light",
    "the light is on", "{0} is on {1}",
)  # fmt: skip
OF_THINGS = (
    "how many {shape} are there",
    "is there a {box} {on} the {ball}",
    "which {shape} is {left of} the red {ball}",
    "what is the {leftmost} {shape}",
    "what colour is the {box}",
    "why",
    "what if the {box} were a {ball}",
    "is {the picture} {tidy}",
    "what is the {light}",
    "{box}",
)
ROBOT_WORDS = (
    "the hall", "move to {1}", "moved to {1}", "{0} is in {1}", "{0} is not in {1}", "the robot",
    "his", "go to {1}",
)  # fmt: skip
OF_ROBOTS = (
    "is {the robot} in {the hall}",
    "why will you {go to {1}}",
    "where is {the robot}",
    "is rob1 in {his} place",
    "what would happen if {the hall} were closed",
    "{the hall}",
)


def reworded(text: str, words: dict[str, str]) -> str:
    """Tables with other words in the place of what stands in quotes."""
    return re.sub(
        '"([^"\n]*)"',
        lambda found: json.dumps(words.get(found[1], found[1]), ensure_ascii=False),
        text,
    ).replace("\x7f", "")


def asked(question: str, words: dict[str, str], all_words: tuple[str, ...]) -> str:
    """A question in the words of the folder."""
    for word in all_words:
        question = question.replace(f"{{{word}}}", words.get(word, word))
    return question


def says_one_thing(problem: SeeWhyError) -> None:
    assert str(problem).strip()
    assert "Traceback" not in str(problem)


@settings(max_examples=5)
@given(words=st.dictionaries(st.sampled_from(THING_WORDS), WORDS, min_size=1, max_size=4))
@example(words={"shape": "a", "box": "the", "left of": "is", "on": "please"})
@example(words={"light": "★", "leftmost": "绿色", "tidy": "not"})
def test_of_things(tmp_path_factory: pytest.TempPathFactory, words: dict[str, str]) -> None:
    folder = things_builder.write_domain(tmp_path_factory.mktemp("words") / "shelf")
    file = folder / "domain.toml"
    # What tables name of each other stays as it is.
    lines = file.read_text(encoding="utf-8").splitlines()
    said = [
        line if line.startswith(("converse", "measure")) else reworded(line, words)
        for line in lines
    ]
    file.write_text("\n".join(said), encoding="utf-8")
    try:
        domain = load_domain(folder)
        check_domain(domain)
    except SeeWhyError as problem:
        says_one_thing(problem)
        return
    assert domain.things is not None
    answerer = ThingAnswerer(domain.things)
    things = [
        {"colour": "red", "form": "ball", "size": "small"},
        {"colour": "blue", "form": "box", "size": "large"},
    ]
    scene = thing_scene(domain.things, things, relations={"left": [(0, 1)], "on": [(0, 1)]})
    for question in OF_THINGS:
        try:
            reply = answerer.answer(asked(question, words, THING_WORDS), scene)
        except SeeWhyError as problem:
            says_one_thing(problem)
        else:
            assert reply.text.strip()
            assert reply.justification.to_text()


POSSESSIVES = '\n[possessives]\nrob1 = "his"\n'


@settings(max_examples=6)
@given(words=st.dictionaries(st.sampled_from(ROBOT_WORDS), WORDS, min_size=1, max_size=4))
@example(words={"the robot": "the", "the hall": "now"})
@example(words={"move to {1}": "please", "{0} is in {1}": "is {0} {1}"})
def test_of_a_robot(tmp_path_factory: pytest.TempPathFactory, words: dict[str, str]) -> None:
    folder = tmp_path_factory.mktemp("words")
    table = TOML.replace('"the hall"', '"the hall"\nrob1 = "the robot"').replace(
        'do = "move to {1}"', 'do = "move to {1}"\nalso = ["go to {1}"]'
    )
    (folder / "planning.toml").write_text(reworded(table + POSSESSIVES, words), encoding="utf-8")
    (folder / "knowledge.al").write_text(KNOWLEDGE, encoding="utf-8")
    (folder / "history.al").write_text("observed at(rob1, kitchen) at 0.\n", encoding="utf-8")
    try:
        domain = load_planning_domain(folder)
        check_change(domain)
    except SeeWhyError as problem:
        says_one_thing(problem)
        return
    goals = SpokenGoals(domain)
    for goal in (*goals.examples()[:6], domain.words.name("hall")):
        try:
            goals.read(goal)
        except SeeWhyError as problem:
            says_one_thing(problem)
    answers = RunAnswers(domain, Run(read_goal("at(rob1, hall)", domain.knowledge), domain.history))
    others = (asked(question, words, ROBOT_WORDS) for question in OF_ROBOTS)
    for question in (*answers.questions.examples()[:12], *others):
        try:
            reply = answers.answer(question)
        except SeeWhyError as problem:
            says_one_thing(problem)
        else:
            assert reply.text.strip()
