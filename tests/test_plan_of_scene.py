"""From the things of a scene to a plan: statics, what is seen at first, goals in words."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from conftest import Run, Shelf
from seewhy.cli.scene_of_plan import BeginningScene
from seewhy.data.dataset import Dataset
from seewhy.data.thing_scene import thing_scene
from seewhy.domain.domain import load_domain
from seewhy.errors import DomainError, KnowledgeError, PlanningError, SeeWhyError
from seewhy.knowledge.made_changeable import read_changeable
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.spoken_goals import goal_of

FOLDER = load_planning_domain("tabletop").folder
SCENES = json.loads((FOLDER / "scene.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def table() -> PlanningDomain:
    return load_planning_domain("tabletop")


# What is seen becomes what is known


def test_the_scene_is_what_is_known_at_first() -> None:
    things = load_domain("tabletop").things
    assert things is not None
    scene = thing_scene(
        things,
        [{"shape": "cube", "colour": "red"}, {"size": "small"}],
        relations={"on": [(1, 0)], "left": [(0, 1)]},
    )
    domain = load_planning_domain("tabletop", scene=scene)
    facts = {
        str(axiom).rstrip(".")
        for axiom in domain.knowledge.axioms
        if axiom.location.file == "scene"
    }
    assert facts >= {"shape(thing1, cube)", "-shape(thing1, sphere)", "size(thing2, small)"}
    assert not any("shape(thing2" in fact for fact in facts)  # it was not seen
    assert [str(seen) for seen in domain.history.observations] == [
        "observed -on(thing1, thing2) at 0.",
        "observed on(thing2, thing1) at 0.",
    ]
    # Where a thing stands in the picture is nothing that actions keep as it was.
    assert "left" not in domain.knowledge.signature.predicates
    assert domain.words.name("thing1") == "the red cube"


def test_what_follows_from_what_changes_changes() -> None:
    known = read_changeable(
        "#sort picture. #sort box = {b1, b2}. #static on(box, box). #static high(box). "
        "#static big(box). #static messy(picture). high(X) if on(X, Y). big(b1). "
        "-messy(P) if picture(P), on(b1, b2).",
        "#fluent basic on(box, box). #action lift(box). lift(X) causes -on(X, Y).",
        without="picture",
    )
    kinds = {name: str(found.kind) for name, found in known.signature.predicates.items()}
    assert kinds == {
        "on": "fluent basic",
        "high": "fluent defined",
        "big": "static",
        "lift": "action",
    }


def test_a_fluent_of_other_sorts_than_what_is_seen_is_refused() -> None:
    with pytest.raises(KnowledgeError, match=r"planning.al:1:1: 'on\(box\)' is declared at "):
        read_changeable("#sort box = {b1}. #static on(box, box).", "#fluent basic on(box).")


ON_THE_GREEN_CUBE = "observed on(thing5, thing3) at 0."


def test_a_history_leaves_what_is_seen(tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    shutil.copytree(FOLDER, mine)
    (mine / "history.al").write_text("observed holding(hand, thing1) at 0.", encoding="utf-8")
    domain = load_planning_domain(mine)
    seen = list(map(str, domain.history.observations))
    assert seen[0] == "observed holding(hand, thing1) at 0."
    assert ON_THE_GREEN_CUBE in seen[1:]
    nothing = tmp_path / "nothing.al"
    nothing.write_text("", encoding="utf-8")
    assert ON_THE_GREEN_CUBE in map(str, domain.history_of(nothing).observations)


# Goals in words

SAID = {
    "make a tower of three with the red block on top": "height(thing1, 3), clear(thing1)",
    "Please build a tower of 4 things.": "tower_of(4)",
    "put the red cube on the green cube": "on(thing1, thing3)",
    "put a rubber cube on the cylinder": (
        "on(V10, thing4), material(V10, rubber), shape(V10, cube)"
    ),
    "put the small cubes on the table": "on_table(thing1), on_table(thing2)",
    "clear the thing that the small ball is on": "clear(thing3)",
    "put the red cube on the green cube and then put the small ball on the red cube": (
        "on(thing1, thing3), on(thing5, thing1)"
    ),
    "the blue cube is on the cylinder and nothing is on the blue cube": (
        "on(thing2, thing4), not carries_something(thing2)"
    ),
    "pick up the leftmost cube": "holding(hand, thing1)",
    "nothing is on anything": "not stacked",
    "put the red block and the small ball on the table": "on_table(thing1), on_table(thing5)",
    "put the red block, the small ball and the cylinder on the table": (
        "on_table(thing1), on_table(thing5), on_table(thing4)"
    ),
    "put the red block on the green one and the small ball on the red one": (
        "on(thing1, thing3), on(thing5, thing1)"
    ),
    "put the red block on the green block, then the small ball on it": (
        "on(thing1, thing3), on(thing5, thing1)"
    ),
    "take the small ball, then put it on the red cube": "on(thing5, thing1)",
    "take the small ball and clear the red cube": "holding(hand, thing5), clear(thing1)",
    "clear the red block and the green block": "clear(thing1), clear(thing3)",
    "put the cylinder on the table, and then put it on the red block": "on(thing4, thing1)",
    "put everything on the red block": (
        "on(thing2, thing1), on(thing3, thing1), on(thing4, thing1), on(thing5, thing1), "
        "on(thing6, thing1)"
    ),
    "put the small ball on something": "on(thing5, V20), thing(V20)",
    "make a tower": "stacked",
    "take the small ball off the green block": "-on(thing5, thing3)",
    "on(thing1, thing2), clear(thing1)": "on(thing1, thing2), clear(thing1)",
}


@pytest.mark.parametrize("said", SAID)
def test_a_goal_in_words_is_conditions(said: str, table: PlanningDomain) -> None:
    assert str(goal_of(said, table)) == SAID[said]


UNCLEAR = {
    "put the ball on the cylinder": "Which sphere? There are two: the small purple metal sphere "
    "and the large gray metal sphere.",
    "clear the brown cube": "There is no brown cube.",
    "make coffee quickly": "'make coffee quickly' is not understood; say one such as make a tower",
    "make a tower of eleven": (
        "'eleven' is no number that 'make a tower of …' takes: it goes from 1 to 10; there are six "
        "things"
    ),
    "clear(thing9)": "'thing9'",
}


@pytest.mark.parametrize("said", UNCLEAR)
def test_a_goal_that_is_not_clear_says_why(said: str, table: PlanningDomain) -> None:
    with pytest.raises(PlanningError) as caught:
        goal_of(said, table)
    assert UNCLEAR[said] in str(caught.value)


def test_goals_are_said_in_any_domain_that_plans() -> None:
    office = load_planning_domain("robot_assistant")
    goal = goal_of("deliver the first message to Sally and move to the kitchen", office)
    assert str(goal) == "message_status(m1, sally, delivered), loc(rob1, kitchen)"


# The command

OUT_OF_REACH = {
    "put the red block on the red block": "nothing is on itself",
    "put the red block on the green one and the green one on the red one": (
        "what is on a thing is above it and nothing is on what stands above it"
    ),
    "take the red block and the blue block": "the hand holds one thing",
    "put the red block on the small ball": "a thing is not put on a ball, on which nothing stays",
    "put a cube on the large ball": "a thing is not put on a ball, on which nothing stays",
    "make a tower of seven": (
        "there is no tower of 7 in any state that there can be; the most is 6"
    ),
}


@pytest.mark.parametrize("goal", OUT_OF_REACH)
def test_why_a_goal_cannot_be_reached_is_said(goal: str, run: Run) -> None:
    found = run("plan", "tabletop", "--goal", goal)
    assert (found.code, found.out) == (1, f"The goal cannot be reached: {OUT_OF_REACH[goal]}.\n")
    told = json.loads(run("plan", "tabletop", "--goal", goal, "--json").out)
    assert (told["status"], told["why_not"]) == ("unreachable", OUT_OF_REACH[goal])


def test_a_robot_that_gives_up_says_why(run: Run) -> None:
    found = run("simulate", "tabletop", "--goal", "put the red block on the red block")
    assert found.code == 1
    assert "The goal cannot be reached: nothing is on itself.\n" in found.out


def two_scenes(folder: Path) -> Path:
    (first,) = SCENES["scenes"]
    second = {
        **first,
        "image_index": 7,
        "objects": first["objects"][:2],
        "relationships": {"on": [[], [0]]},
    }
    (folder / "scenes.json").write_text(json.dumps({"scenes": [first, second]}), encoding="utf-8")
    return folder / "scenes.json"


def test_a_plan_for_a_scene_of_a_file(run: Run, tmp_path: Path) -> None:
    where = ("--scene", two_scenes(tmp_path), "--image", "7")
    done = run("plan", "tabletop", *where, "--goal", "put the blue cube on the red cube")
    assert done.code == 0
    assert [line.strip() for line in done.out.splitlines()[:-1]] == [
        "1. pick up the small red metal cube",
        "2. put the small red metal cube on the table",
        "3. pick up the small blue rubber cube",
        "4. put the small blue rubber cube on the small red metal cube",
    ]


def test_a_run_of_a_scene_of_a_file(run: Run, tmp_path: Path) -> None:
    where = ("--scene", two_scenes(tmp_path), "--image", "7")
    done = run("simulate", "tabletop", *where, "--goal", "put everything on the table", "--json")
    told = json.loads(done.out)
    assert told["achieved"]
    assert told["goal"] == "not stacked, not holding(hand, _)"


def _lacking_scene(folder: Path) -> tuple[object, ...]:
    shutil.copytree(FOLDER, folder / "mine")
    (folder / "mine" / "scene.json").unlink()
    return ("plan", folder / "mine")


REFUSED: dict[str, Callable[[Path], tuple[object, ...]]] = {
    "has 2 scenes; say which with --image": lambda f: (
        "plan",
        "tabletop",
        "--scene",
        two_scenes(f),
    ),
    "has no scene with image_index 3": (
        lambda f: ("plan", "tabletop", "--scene", two_scenes(f), "--image", "3")
    ),
    "give the file with --scene": lambda _: ("plan", "tabletop", "--image", "3"),
    "give --model, too": lambda _: ("plan", "tabletop", "--picture", "p.png"),
    "give --picture, too": lambda _: ("plan", "tabletop", "--model", "model"),
    "the domain has no [things] that a scene could show; leave the scene out": (
        lambda f: ("plan", "robot_assistant", "--scene", two_scenes(f), "--image", "0")
    ),
    "give them with --scene or --picture, or keep scene.json": _lacking_scene,
}


@pytest.mark.parametrize("refusal", REFUSED)
def test_what_a_plan_begins_with_is_said_whole(refusal: str, run: Run, tmp_path: Path) -> None:
    done = run(*REFUSED[refusal](tmp_path), "--goal", "clear(thing1)")
    assert done.code == 2
    assert refusal in " ".join(done.err.split())


def test_a_goal_of_planning_toml_is_checked(tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    shutil.copytree(FOLDER, mine)
    text = (mine / "planning.toml").read_text(encoding="utf-8")
    for old, new, problem in (
        ('goal = "tower_of(N)"', 'goal = "towers_of(N)"', "did you mean 'tower_of'"),
        ('goal = "tower_of(N)"', 'goal = "tower_of(M)"', "asks for {N}, which is no variable"),
    ):
        (mine / "planning.toml").write_text(text.replace(old, new), encoding="utf-8")
        with pytest.raises(DomainError, match=r"planning.toml:\d+: ") as caught:
            load_planning_domain(mine)
        assert problem in str(caught.value)


# What a model sees

TAKING = """
#sort robot = {arm}.
#fluent basic taken(thing).
#action take(robot, thing).
take(R, X) causes taken(X).
default -taken(X).
impossible take(R, X) if on(Y, X), not taken(Y).
"""
WORDS = """
[planning]
name = "shelf"
title = "Things that are taken from a shelf"
robot = "arm"
[actions.take]
do = "take {1}"
did = "took {1}"
[[goals]]
say = ["take everything"]
goal = "#count { X : taken(X) } >= 2"
"""


def test_a_plan_for_what_a_model_sees(shelf: Shelf, run: Run, tmp_path: Path) -> None:
    folder = tmp_path / "shelf"
    shutil.copytree(shelf.domain, folder)
    (folder / "planning.al").write_text(TAKING, encoding="utf-8")
    (folder / "planning.toml").write_text(WORDS, encoding="utf-8")
    data = Dataset.load(shelf.data, load_domain(folder))
    picture = next(s.picture for s in data.of_split("test").scenes if len(s.things) == 2)
    seen = ("--picture", picture, "--model", shelf.model)
    done = run("plan", folder, *seen, "--goal", "take everything")
    assert done.code == 0, done.err
    assert done.err.count("seen: the ") == 2
    named = [line.removeprefix("seen: ") for line in done.err.splitlines() if "seen: " in line]
    taken = [line.split(". take ")[1] for line in done.out.splitlines() if ". take " in line]
    assert sorted(taken) == sorted(named)
    # What a model sees may be wrong; what somebody annotated is not.
    assert (
        BeginningScene(picture=picture, model=shelf.model).planning_domain(str(folder)).sensors_err
    )
    assert not BeginningScene().planning_domain("tabletop").sensors_err
    wrong = run("plan", "tabletop", *seen, "--goal", "clear(thing1)")
    assert wrong.code == 2
    assert "train a model for 'tabletop'" in wrong.err


def test_no_scene_where_there_are_no_things(table: PlanningDomain) -> None:
    assert table.at_first is not None
    with pytest.raises(SeeWhyError, match="leave the scene out"):
        load_planning_domain("robot_assistant", scene=table.at_first.scene)
