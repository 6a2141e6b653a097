"""What a hand learns from its runs of what actions do not achieve, and of which things."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache, partial
from itertools import cycle
from pathlib import Path

import numpy as np
import pytest

from conftest import Run
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.history import History, read_history
from seewhy.knowledge.learned_file import learned_text, parse_learned
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.learning.attempts import attempts_of, spoken_about
from seewhy.planning.learning.learning_from_runs import LearnedFromRuns, learn_from_runs
from seewhy.planning.things.recorded_scene import domain_of_record
from seewhy_lab.commands.hand_learns import OF_BALLS, pursued, recorded_runs, untold
from seewhy_lab.simulators.tabletop.planned import scene_of_table
from seewhy_lab.simulators.tabletop.table import Table, TableThing

TABLE = load_planning_domain("tabletop")
HAND = untold(TABLE)
UNTOLD = tuple(part for statement in OF_BALLS for part in ("--without", statement))
SHAPES, SIZES = ("cube", "sphere", "cylinder"), ("small", "large")

Thing = tuple[str, str]
"""Size and shape of a thing."""


def tried(upper: Thing, lower: Thing, *, stays: bool) -> str:
    """The record of a run in which one thing was put on another, and stayed there or fell."""
    facts = [
        f"size(thing{number}, {size}). shape(thing{number}, {shape})."
        for number, (size, shape) in enumerate((upper, lower), start=1)
    ]
    seen = "" if stays else "-"
    return "\n".join(
        [
            *facts,
            "observed holding(hand, thing1) at 0.",
            "attempted put_on(hand, thing1, thing2) at 0.",
            f"observed {seen}on(thing1, thing2) at 1.",
            "observed -holding(hand, thing1) at 1.",
        ]
    )


def read(texts: Sequence[str]) -> list[History]:
    return [read_history(text, TABLE.knowledge.signature) for text in texts]


UPPER: tuple[Thing, ...] = (("small", "cube"), ("large", "cube"), ("small", "cylinder"))
LOWER: tuple[Thing, ...] = tuple((size, shape) for shape in SHAPES for size in SIZES)
NOTHING_STAYS_ON_A_BALL = [
    tried(upper, lower, stays=lower[1] != "sphere")
    for upper, lower in zip(cycle(UPPER), LOWER * 6, strict=False)
]
"""36 runs; in twelve something is put on a ball."""
SOME_STAY_ON_LARGE_BALLS = [
    tried(upper, lower, stays=lower != ("small", "sphere"))
    for upper, lower in zip(cycle(UPPER), [*LOWER * 6, *[("small", "sphere")] * 18], strict=False)
]
"""54 runs; in 24 something is put on a small ball, in six on a large one."""


def lines(found: LearnedFromRuns) -> list[str]:
    return [f"{axiom.text}: {axiom}" for axiom in found.axioms]


def write(folder: Path, texts: Sequence[str]) -> Path:
    folder.mkdir(parents=True)
    for number, text in enumerate(texts):
        (folder / f"{number:02}.al").write_text(text, encoding="utf-8")
    return folder


@cache
def learned_of_balls() -> LearnedFromRuns:
    """What is learned where nothing stays on a ball."""
    return learn_from_runs(HAND, read(NOTHING_STAYS_ON_A_BALL))


def test_that_nothing_stays_on_a_ball_is_learned() -> None:
    found = learned_of_balls()
    assert learned_text(found.axioms, source="the record of 36 runs") == (
        "% Axioms that 'seewhy learn' found in the record of 36 runs.\n"
        "\n"
        "%% if the hand put a thing on another thing and the other thing is a sphere, then usually "
        "the thing is not on the other thing\n"
        "% learned from 12 attempts, 100.0 % of them rightly\n"
        "impossible put_on(hand, T, H) if shape(H, sphere).\n"
        "\n"
    )
    assert (found.runs, found.attempts, found.held_back, found.rejected) == (36, 36, 7, ())


def test_what_works_all_the_same_is_an_exception() -> None:
    found = learn_from_runs(HAND, read(SOME_STAY_ON_LARGE_BALLS))
    assert lines(found) == [
        "if the hand put a thing on another thing and the other thing is a sphere, then usually "
        "the thing is not on the other thing, unless the other thing is large: "
        "impossible put_on(hand, T, H) if not size(H, large), shape(H, sphere)."
    ]


def test_what_the_knowledge_says_is_not_learned_again() -> None:
    found = learn_from_runs(TABLE, read(NOTHING_STAYS_ON_A_BALL))
    assert (found.axioms, found.attempts) == ((), 24)


def test_the_same_attempt_again_and_again_is_one() -> None:
    again = " ".join(
        f"observed holding(hand, thing1) at {step}. "
        f"attempted put_on(hand, thing1, thing2) at {step}. "
        f"observed -on(thing1, thing2) at {step + 1}."
        for step in range(12)
    )
    (history,) = read([f"shape(thing1, cube). shape(thing2, sphere). {again}"])
    about = domain_of_record(HAND, history)
    attempts = list(attempts_of(about, history, 0))
    assert [str(attempt.action) for attempt in attempts] == ["put_on(hand,thing1,thing2)"]


@pytest.mark.parametrize("seed", range(3))
def test_what_is_learned_contradicts_no_more_attempts_than_it_says(seed: int) -> None:
    """Things are put on things of all kinds; balls let four of five fall, others one of twenty."""
    rng = np.random.default_rng(seed)
    kinds = [*LOWER, ("small", "sphere"), ("large", "sphere")]
    texts = []
    for _ in range(60):
        upper, lower = (kinds[int(number)] for number in rng.integers(len(kinds), size=2))
        falls = rng.random() < (0.8 if lower[1] == "sphere" else 0.05)
        texts.append(tried(upper, lower, stays=not falls))
    record = read(texts)
    found = learn_from_runs(HAND, record)
    attempts = [
        (domain_of_record(HAND, history), attempt)
        for number, history in enumerate(record)
        for attempt in attempts_of(domain_of_record(HAND, history), history, number)
    ]
    assert len(attempts) == found.attempts == 60
    for axiom in found.axioms:
        spoken = [
            attempt
            for about, attempt in attempts
            if spoken_about(about.knowledge, [axiom], attempt)
        ]
        succeeded = sum(not attempt.missed for attempt in spoken)
        origin = axiom.origin
        assert len(spoken) == origin.support
        assert succeeded == round((1 - origin.precision) * origin.support) < len(spoken) / 2


@pytest.mark.parametrize("seed", range(3))
def test_from_chance_nothing_is_learned(seed: int) -> None:
    rng = np.random.default_rng(seed)
    texts = [
        tried(UPPER[int(rng.integers(3))], LOWER[int(rng.integers(6))], stays=rng.random() < 0.7)
        for _ in range(40)
    ]
    assert lines(learn_from_runs(HAND, read(texts))) == []


def learned_axioms() -> tuple[Axiom, ...]:
    return learned_of_balls().axioms


def test_later_runs_are_counted_to_what_was_learned() -> None:
    more = [tried(("small", "cube"), ("large", "sphere"), stays=n == 0) for n in range(8)]
    found = learn_from_runs(HAND, read(more), learned=learned_axioms())
    (kept,) = found.kept
    assert (kept.origin.support, kept.origin.precision) == (20, 19 / 20)
    assert (found.withdrawn, found.axioms) == ((), ())


def test_what_later_runs_refute_is_withdrawn() -> None:
    sticky = [tried(("small", "cube"), ("large", "sphere"), stays=n > 0) for n in range(8)]
    found = learn_from_runs(HAND, read(sticky), learned=learned_axioms())
    assert [(gone.statement, gone.reason) for gone in found.withdrawn] == [
        (
            "impossible put_on(hand, T, H) if shape(H, sphere).",
            "7 of 8 attempts of it in later runs succeeded",
        )
    ]
    assert (found.kept, found.axioms) == ((), ())


LIFTING = """\
#sort robot = {rob}.
#sort box = {b1, b2, b3, b4, b5, b6, b7, b8}.
#sort weight = {light, heavy}.
#static weighs(box, weight).
#fluent basic held(box).
#action lift(robot, box).
lift(R, B) causes held(B).
impossible lift(R, B) if held(B).
"""
LIFTING_WORDS = """\
[planning]
name = "lifting"
title = "Boxes that are lifted"
robot = "rob"

[statics.weighs]
say = "{0} is {1}"
deny = "{0} is not {1}"

[fluents.held]
say = "{0} is held"
deny = "{0} is not held"

[actions.lift]
do = "lift {1}"
did = "lifted {1}"

[[sensing]]
literal = "held(B)"
where = "box(B)"
"""


def lifting(folder: Path) -> PlanningDomain:
    """A domain without pictures, whose boxes are said to be light or heavy in knowledge.al."""
    folder.mkdir()
    weights = "".join(f"weighs(b{n}, {'heavy' if n > 4 else 'light'}).\n" for n in range(1, 9))
    (folder / "knowledge.al").write_text(LIFTING + weights, encoding="utf-8")
    (folder / "planning.toml").write_text(LIFTING_WORDS, encoding="utf-8")
    return load_planning_domain(folder)


def test_any_domain_that_plans_learns_from_what_its_things_are_like(tmp_path: Path) -> None:
    domain = lifting(tmp_path / "lifting")
    texts = [
        f"observed -held(b{n}) at 0. attempted lift(rob, b{n}) at 0. "
        f"observed {'-' if n > 4 else ''}held(b{n}) at 1."
        for n in range(1, 9)
    ] * 5
    record = [read_history(text, domain.knowledge.signature) for text in texts]
    found = learn_from_runs(domain, record)
    assert lines(found) == [
        "if rob lifted a box and the box is heavy, then usually the box is not held: "
        "impossible lift(rob, B) if weighs(B, heavy)."
    ]


# From the outside


def test_a_run_says_what_its_things_are_like(run: Run, tmp_path: Path) -> None:
    record = tmp_path / "run.al"
    goal = ("--goal", "put the blue cube on the gray ball", "--steps", "3")
    simulate = ("simulate", "tabletop", *goal, "--seed", "1", *UNTOLD)
    assert run(*simulate, "--record", str(record)).code == 1
    text = record.read_text(encoding="utf-8")
    assert "shape(thing6, sphere).\ncolour" not in text
    assert "\nshape(thing6, sphere).\n" in text
    # What was done so far is planned from, as before.
    plan = ("plan", "tabletop", "--goal", "clear the green cube", "--history", str(record))
    assert run(*plan, *UNTOLD).code == 0


def test_a_history_of_other_things_is_refused(run: Run, tmp_path: Path) -> None:
    record = tmp_path / "run.al"
    record.write_text("shape(thing1, sphere).", encoding="utf-8")
    done = run("plan", "tabletop", "--goal", "clear the green cube", "--history", str(record))
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        f"seewhy: {record}: says 'shape(thing1, sphere)', which is not so of the things that the "
        "plan begins with; give the scene that the file is about with --scene\n"
    )


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (
            "shape(thing1, cone).",
            "{file}:1:1: 'cone' is not of sort 'form', which 'shape' takes; it must be one of: "
            "cube, sphere, cylinder",
        ),
        (
            "shape(thing1, cube). -shape(thing1, cube).",
            "{file}:1:22: '-shape(thing1, cube)' is said, and its opposite at {file}:1:1; remove "
            "one of the two",
        ),
        (
            "shape(thing1, cube).",
            "the record shows nothing of what came of an action that the knowledge holds possible, "
            "so nothing is to be learned from it; record runs in which something is done and then "
            "seen",
        ),
        (
            "",
            "{file}: names no thing such as thing1, so nothing was done in it; take it out of the "
            "folder, or record the run anew",
        ),
    ],
)
def test_records_that_teach_nothing_are_refused(
    text: str, complaint: str, run: Run, tmp_path: Path
) -> None:
    runs = write(tmp_path / "runs", [text])
    done = run("learn", "tabletop", "--runs", str(runs), "--out", str(tmp_path / "out.al"), "--yes")
    assert (done.code, done.out) == (2, "")
    assert done.err == "seewhy: " + complaint.format(file=runs / "00.al") + "\n"


def test_the_hand_learns_on_the_command_line(run: Run, tmp_path: Path) -> None:
    runs, out = write(tmp_path / "runs", NOTHING_STAYS_ON_A_BALL), tmp_path / "learned.al"
    learn = ("learn", "tabletop", "--runs", str(runs), "--out", str(out), *UNTOLD)
    done = run(*learn, stdin="n\n")
    assert "add this axiom?" in done.out
    assert not out.exists()
    done = run(*learn, "--yes")
    assert (done.code, done.out) == (
        0,
        "added: if the hand put a thing on another thing and the other thing is a sphere, then "
        "usually the thing is not on the other thing\n"
        "  impossible put_on(hand, T, H) if shape(H, sphere).  (12 attempts, 100.0 % of them "
        "rightly; in the runs held back 4 of 4)\n",
    )
    assert done.err == (
        "7 of 36 runs are held back: nothing is learned from what was tried in them, they judge "
        "what is proposed\n"
        f"what was learned is in {out}; give it to plan or simulate with --learned\n"
    )
    goal = ("--goal", "put the blue cube on the gray ball", *UNTOLD)
    assert run("plan", "tabletop", *goal).code == 0
    assert run("plan", "tabletop", *goal, "--learned", str(out)).code == 1
    tower = ("--goal", "make a tower of four", *UNTOLD, "--learned", str(out), "--seed", "3")
    assert run("simulate", "tabletop", *tower).code == 0


def test_later_runs_withdraw_on_the_command_line(run: Run, tmp_path: Path) -> None:
    learned = tmp_path / "learned.al"
    text = learned_text(learned_axioms(), source="the record of 36 runs")
    learned.write_text(text, encoding="utf-8")
    sticky = [tried(("small", "cube"), ("large", "sphere"), stays=n > 0) for n in range(8)]
    runs = write(tmp_path / "runs", sticky)
    learn = ("learn", "tabletop", "--runs", str(runs), "--learned", str(learned), *UNTOLD)
    shown = json.loads(run(*learn, "--out", str(learned), "--json").out)
    assert shown["withdrawn"] == [
        {
            "statement": "impossible put_on(hand, T, H) if shape(H, sphere).",
            "reason": "7 of 8 attempts of it in later runs succeeded",
        }
    ]
    assert learned.read_text(encoding="utf-8") == text
    done = run(*learn, "--out", str(learned), "--yes")
    assert done.out.startswith(
        "withdrawn: impossible put_on(hand, T, H) if shape(H, sphere). 7 of 8 attempts"
    )
    after = learned.read_text(encoding="utf-8")
    assert parse_learned(after, TABLE.knowledge.signature) == ()
    assert "% withdrawn: impossible put_on(hand, T, H) if shape(H, sphere). because 7 of 8" in after


def test_what_was_learned_before_goes_with_runs(run: Run, tmp_path: Path) -> None:
    done = run("learn", "tabletop", "--data", str(tmp_path), "--learned", str(tmp_path / "l.al"))
    assert (done.code, done.err) == (
        2,
        "seewhy: --learned goes with --runs; what pictures teach is kept in the domain\n",
    )


# With real physics


def test_runs_of_the_simulated_hand_are_recorded_alike() -> None:
    first, again = ([str(one) for one in recorded_runs(2, seed=0, most_steps=4)] for _ in range(2))
    assert first == again
    for text in first:
        (history,) = read([text])
        assert {"shape", "size"} <= {literal.predicate for literal in history.statics}
        about = domain_of_record(HAND, history)
        assert all(attempt.action.name for attempt in attempts_of(about, history, 0))


def test_a_hand_that_learned_builds_on_what_carries() -> None:
    """On a ball, a cube and a cylinder; only the ball must not be built on."""
    look = {"colour": "red", "material": "rubber", "yaw": 0.0, "size": "large"}
    table = Table(
        (
            TableThing(shape="sphere", x=-0.1, y=0.0, z=0.036, **look),
            TableThing(shape="cube", x=0.0, y=0.0, z=0.031, **look),
            TableThing(shape="cylinder", x=0.1, y=0.0, z=0.034, **look),
        )
    )
    assert TABLE.at_first is not None
    domain = load_planning_domain("tabletop", scene=scene_of_table(table, TABLE.at_first.things))
    goal = "make a tower of three"
    done = pursued(
        domain, partial(untold, learned=learned_axioms()), goal, table, seed=0, most_steps=8
    )
    assert done.reached
    assert [str(action) for action in done.run.actions if action.name == "put_on"] in (
        ["put_on(hand,thing2,thing3)", "put_on(hand,thing1,thing2)"],
        ["put_on(hand,thing3,thing2)", "put_on(hand,thing1,thing3)"],
    )
    assert not pursued(domain, untold, "on(thing2, thing1)", table, seed=0, most_steps=8).reached
