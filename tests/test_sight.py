"""A robot that sees: a small house of its own, its pictures, and networks trained on them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import clingo
import numpy as np
import pytest

from conftest import Run, one_process
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.data.making import make_dataset
from seewhy.domain.domain import load_domain
from seewhy.errors import DomainError, PlanningError
from seewhy.planning.diagnosis.diagnosis import SurpriseKind
from seewhy.planning.dialogue.run_answers import answer
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.recording import record_of
from seewhy.planning.execution.sight import Look, Sight
from seewhy.planning.execution.simulation import simulate
from seewhy.planning.goal import read_goal
from tower import TOWER

KNOWLEDGE = """\
#sort view.
#sort robot = {rob1}.
#sort room = {hall, cellar, attic}.
#static lit(view).
#static cat(view).
#static cosy(view).
#fluent basic at(robot, room).
#fluent basic bright(room).
#fluent basic cat_in(room).
#action go(robot, room).
#action exogenous visit(room).
go(R, L) causes at(R, L).
visit(L) causes cat_in(L).
%% nobody is in two rooms
-at(R, L2) if at(R, L1), L1 != L2.
%% the cat is in one room
-cat_in(L2) if cat_in(L1), L1 != L2.
impossible go(R, L) if at(R, L).
impossible visit(L) if cat_in(L).
cosy(V) if lit(V), cat(V).
-cosy(V) if -lit(V).
-cosy(V) if -cat(V).
"""

FEATURE = """
[features.{key}]
name = "{key}"
threshold = 0.9

[features.{key}.values]
yes = {{ say = "{{it}} has {key}", words = ["there"], change = "add {key}" }}
no = {{ say = "{{it}} has no {key}", words = ["missing"], change = "remove {key}" }}
"""

DOMAIN = (
    """\
[domain]
name = "house"
title = "A house"
scene = "view"
subject = "the room"
source = "pictures.py"

[pictures]
size = 16

[classes.cosy]
literal = "cosy(V)"
say = "cosy"

[classes.bare]
literal = "-cosy(V)"
say = "bare"
"""
    + FEATURE.format(key="lit")
    + FEATURE.format(key="cat")
)

QUESTIONS = """\
[[question]]
asks = "is_class"
patterns = ["is {it} {class}"]
"""

PICTURES = """\
import numpy as np


def depict(features, *, seed, size):
    rng = np.random.default_rng(seed)
    ground = 200 if features.get("lit") == "yes" else 50
    picture = np.full((size, size, 3), ground, dtype=np.uint8)
    if features.get("cat") == "yes":
        top, left = rng.integers(1, size // 2, size=2)
        picture[top : top + size // 3, left : left + size // 3] = (230, 120, 20)
    return picture


def draw(*, seed, index, size):
    rng = np.random.default_rng([seed, index])
    features = {key: "yes" if rng.random() < 0.5 else "no" for key in ("lit", "cat")}
    label = "cosy" if set(features.values()) == {"yes"} else "bare"
    return depict(features, seed=[seed, index], size=size), features, label
"""

PLANNING = """\
[planning]
name = "house"
title = "A robot in a house"
robot = "rob1"

[things]
hall = "the hall"
cellar = "the cellar"
attic = "the attic"
rob1 = "the robot"

[fluents.at]
say = "{0} is in {1}"
deny = "{0} is not in {1}"

[fluents.cat_in]
say = "the cat is in {0}"
deny = "the cat is not in {0}"

[actions.go]
do = "go to {1}"
did = "went to {1}"

[[sensing]]
literal = "at(R, L)"
where = "robot(R)"

[[sensing]]
literal = "cat_in(L)"
where = "at(rob1, L)"

[pictures]
where = "at(rob1, L)"

[pictures.shows]
lit = "bright(L)"
cat = "cat_in(L)"

[simulation]
unknown = 0.5

[simulation.events]
visit = 0.2
"""


def written(folder: Path, **texts: str) -> Path:
    """Write the house; ``texts`` replace its files."""
    folder.mkdir(parents=True, exist_ok=True)
    files = {
        "knowledge.al": KNOWLEDGE,
        "domain.toml": DOMAIN,
        "questions.toml": QUESTIONS,
        "planning.toml": PLANNING,
        "pictures.py": PICTURES,
        "history.al": "observed at(rob1, hall) at 0.\n",
    }
    names = {name.partition(".")[0]: name for name in files}
    for name, text in {**files, **{names[key]: text for key, text in texts.items()}}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(tmp_path_factory.mktemp("sight") / "house")


@pytest.fixture(scope="module")
def house(folder: Path) -> PlanningDomain:
    return load_planning_domain(folder)


@pytest.fixture(scope="module")
def model(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    domain = load_domain(folder)
    pictures = tmp_path_factory.mktemp("pictures")
    make_dataset(domain, pictures, count=90, seed=5, size=16, workers=1)
    with one_process():
        agent = Agent(domain, seed=1).fit(Dataset.load(pictures, domain))
    agent.save(pictures / "model")
    return pictures / "model"


@pytest.fixture(scope="module")
def sight(house: PlanningDomain, model: Path) -> Sight:
    return Sight(house, Agent.load(model))


def term(text: str) -> clingo.Symbol:
    return clingo.parse_term(text)


def test_one_folder_sees_and_plans(folder: Path, house: PlanningDomain) -> None:
    assert list(load_domain(folder).features) == ["lit", "cat"]
    assert "view" not in house.knowledge.signature.sorts
    assert {str(shown.literal) for shown in house.shows.values()} == {"bright(L)", "cat_in(L)"}


def test_a_look_is_about_the_place_where_the_robot_is(sight: Sight) -> None:
    about = sight.about(frozenset({term("at(rob1,cellar)"), term("cat_in(attic)")}))
    assert {key: str(fluent) for key, fluent in about.items()} == {
        "lit": "bright(cellar)",
        "cat": "cat_in(cellar)",
    }


def test_networks_read_what_the_source_depicts(sight: Sight) -> None:
    here, cat, light = map(term, ("at(rob1,hall)", "cat_in(hall)", "bright(hall)"))
    for seed in range(24):
        state = {here, *([cat] if seed % 2 else []), *([light] if seed % 3 else [])}
        look = sight.look(frozenset(state), seed=seed)
        assert look.shown == {light: bool(seed % 3), cat: bool(seed % 2)}
        assert (look.read, look.misread) == (look.shown, ())


def test_the_world_does_not_depend_on_who_looks(house: PlanningDomain, sight: Sight) -> None:
    goal = read_goal("at(rob1, L), cat_in(L)", house.knowledge)
    for seed in range(6):
        *_, told = simulate(house, goal, seed=seed)
        *_, seen = simulate(house, goal, seed=seed, sight=sight)
        assert len(seen.looks) == len(seen.worlds) == len(seen.run.steps)
        assert not told.looks
        assert (seen.worlds, seen.run.actions) == (told.worlds, told.run.actions)


class Blinking(Sight):
    """Eyes that see the light wrongly at the second look."""

    looks = 0

    def look(self, state: frozenset[clingo.Symbol], *, seed: int) -> Look:
        look = super().look(state, seed=seed)
        self.looks += 1
        if self.looks != 2:
            return look
        wrong = {fluent: holds != (fluent.name == "bright") for fluent, holds in look.read.items()}
        return replace(look, read=wrong)


def test_a_wrong_reading_is_diagnosed_asked_about_and_not_recorded(
    model: Path, tmp_path: Path
) -> None:
    # The robot does not get away from the hall, whose light changes by nothing.
    stuck = "visit = 0.0\n\n[simulation.failures]\ngo = 1.0"
    home = written(tmp_path / "stuck", planning=PLANNING.replace("visit = 0.2", stuck))
    domain = load_planning_domain(home)
    sight = Blinking(domain, Agent.load(model))
    away = read_goal("at(rob1, cellar)", domain.knowledge)
    *_, last = simulate(domain, away, seed=0, sight=sight, most_steps=2)
    (wrong,) = last.looks[1].misread
    found = [surprise for step in last.run.steps for surprise in step.surprises]
    assert (1, SurpriseKind.MISREADING, wrong.name) in {
        (one.step, one.kind, one.what.name) for one in found
    }
    assert answer(domain, last.run, "where are you?").text.startswith("I am in the hall.")
    left_out = {*last.run.history.observations} - {*record_of(domain, last.run).observations}
    assert [(one.step, one.literal.predicate) for one in left_out] == [(1, "bright")]


@pytest.mark.parametrize(
    ("planning", "said"),
    [
        (
            PLANNING.replace('lit = "bright(L)"', 'lid = "bright(L)"'),
            "'lid' is no feature of domain.toml; did you mean 'lit'?",
        ),
        (
            PLANNING.replace('lit = "bright(L)"', 'lit = "brigt(L)"'),
            "'brigt' is not declared",
        ),
        (
            PLANNING.replace('[pictures]\nwhere = "at(rob1, L)"', '[pictures]\nwhere = ""'),
            "nothing is said; write where the robot senses this, such as at(",
        ),
    ],
)
def test_what_pictures_show_is_checked(tmp_path: Path, planning: str, said: str) -> None:
    with pytest.raises(DomainError) as caught:
        load_planning_domain(written(tmp_path / "house", planning=planning))
    text = str(caught.value)
    assert said in text
    line = int(text.split("planning.toml:")[1].split(":")[0])
    assert ("where" in planning.splitlines()[line - 1]) == ("nothing is said" in said)


def test_only_features_of_yes_and_no_are_fluents(tmp_path: Path) -> None:
    lamp = FEATURE.format(key="lamp").replace("yes = ", "red = ").replace("no = ", "blue = ")
    home = written(
        tmp_path / "house",
        knowledge=f"{KNOWLEDGE}#sort hue = {{red, blue}}.\n#static lamp(view, hue).\n",
        domain=DOMAIN + lamp,
        planning=PLANNING.replace('lit = "bright(L)"', 'lamp = "bright(L)"'),
    )
    with pytest.raises(DomainError, match="'lamp' has the values red, blue; only one of yes and"):
        load_planning_domain(home)


def test_pictures_need_a_domain_of_pictures(tmp_path: Path) -> None:
    home = written(tmp_path / "house")
    (home / "domain.toml").unlink()
    text = KNOWLEDGE.replace("#sort view.", "#sort view = {v}.")
    (home / "knowledge.al").write_text(text, encoding="utf-8")
    with pytest.raises(DomainError, match=r"the folder has no domain\.toml"):
        load_planning_domain(home)


def test_a_model_of_another_domain_cannot_see(house: PlanningDomain, agent: Agent) -> None:
    with pytest.raises(PlanningError, match=r"the model sees no 'lit'.*trained for the domain"):
        Sight(house, agent)


def test_a_robot_of_which_nothing_says_what_pictures_show_cannot_see(agent: Agent) -> None:
    with pytest.raises(PlanningError, match=r"planning\.toml: nothing says what pictures show"):
        Sight(load_planning_domain(TOWER), agent)


def test_a_picture_of_two_places_is_refused(tmp_path: Path, model: Path) -> None:
    home = written(
        tmp_path / "house",
        planning=PLANNING.replace(
            '[pictures]\nwhere = "at(rob1, L)"', '[pictures]\nwhere = "room(L)"'
        ),
    )
    sight = Sight(load_planning_domain(home), Agent.load(model))
    with pytest.raises(PlanningError, match="a picture is of one place"):
        sight.about(frozenset({term("at(rob1,hall)")}))


def test_a_source_that_cannot_depict_is_named(tmp_path: Path, model: Path) -> None:
    agent, lit = Agent.load(model), ("at(rob1,hall)", "bright(hall)")
    for number, (text, said) in enumerate(
        (
            (
                PICTURES.replace("def depict", "def show"),
                r"has a function depict\(features, seed=",
            ),
            (PICTURES.replace("ground = 200", "ground = 1 // 0"), "fails at depict.*ZeroDivision"),
        )
    ):
        domain = load_planning_domain(written(tmp_path / str(number), pictures=text))
        with pytest.raises((PlanningError, DomainError), match=said):
            Sight(domain, agent).look(frozenset(map(term, lit)), seed=0)


def test_a_run_with_pictures_from_the_command_line(
    run: Run, folder: Path, model: Path, tmp_path: Path
) -> None:
    page = tmp_path / "run.html"
    asked = ("simulate", str(folder), "--goal", "at(rob1, L), cat_in(L)", "--seed", "3")
    done = run(*asked, "--model", str(model), "--out", str(page))
    assert done.code in (0, 1)
    html = page.read_text(encoding="utf-8")
    assert html.count("data:image/png;base64,") == html.count("The networks read: ") > 0
    assert run("simulate", str(folder), "--goal", "at(rob1, attic)", "--model", "no").code == 2


def test_depict_shows_what_draw_annotates() -> None:
    from seewhy.data.picture_source import load_depict

    depict = load_depict(load_domain("robot_assistant"))
    one, two = (depict({"desk": "yes", "bob": "no"}, seed=4, size=48) for _ in range(2))
    assert np.array_equal(one, two)
    assert not np.array_equal(one, depict({"desk": "yes", "bob": "yes"}, seed=4, size=48))
