"""What a robot learns from the record of its earlier runs, and what it is told or not told."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import clingo
import numpy as np
import pytest

from conftest import Run
from seewhy.errors import PlanningError
from seewhy.files.whole_files import write_whole
from seewhy.knowledge.history import History, history_text, read_history, read_history_file
from seewhy.knowledge.language import read_knowledge, read_literal
from seewhy.knowledge.learned_file import learned_text, parse_learned
from seewhy.planning.diagnosis.diagnosis import diagnose, explained
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.learning.cases import cases_of
from seewhy.planning.learning.learning_from_runs import LearnedFromRuns, learn_from_runs
from seewhy_lab.experiments.planning import MEASURES, summary, trial
from seewhy_lab.experiments.statistics import Interval
from tower import TOWER

OFFICE = load_planning_domain("robot_assistant")
AT_WORK = "loc(P, L) if work_place(P, L), not -loc(P, L)"
ROBOT = OFFICE.without(AT_WORK)
PLACES = OFFICE.knowledge.signature.members("place")
AT_HOME = {person: f"{person}s_office" for person in ("bob", "john", "sarah", "sally")}
TO_BOB = "message_status(m1, bob, delivered)"


def test_a_run_is_recorded(run: Run, tmp_path: Path) -> None:
    record = tmp_path / "new" / "run.al"
    command = ("simulate", "robot_assistant", "--goal", TO_BOB, "--seed", "6", "--without", AT_WORK)
    done = run(*command, "--record", str(record))
    assert done.code == 0
    lines = record.read_text(encoding="utf-8").splitlines()
    assert lines[0] == (
        f'% seewhy simulate robot_assistant --goal "{TO_BOB}" --seed 6 --without "{AT_WORK}"'
    )
    assert [line for line in lines if not line.startswith("observed")][1:] == [
        "attempted move(rob1, bobs_office) at 0.",
        "attempted deliver(rob1, m1, bob) at 1.",
    ]
    assert "observed loc(bob, bobs_office) at 1." in lines
    history = read_history_file(record, OFFICE.knowledge.signature)
    assert len(history.observations) + len(history.occurrences) == len(lines) - 1


def test_a_record_has_a_name_of_its_kind(run: Run, tmp_path: Path) -> None:
    name = tmp_path / "run.txt"
    done = run("simulate", "robot_assistant", "--goal", TO_BOB, "--record", str(name))
    assert (done.code, done.out) == (2, "")
    assert done.err == f"seewhy: {name}: a record is written as .al; choose a name that ends so\n"


def test_a_robot_may_know_less(run: Run) -> None:
    done = run("plan", "robot_assistant", "--goal", TO_BOB, "--without", f"{AT_WORK}.", "--json")
    assert '"supposed": [\n    "loc(bob,' in done.out
    done = run("plan", "robot_assistant", "--goal", TO_BOB, "--json")
    assert '"supposed": []' in done.out
    done = run("plan", "robot_assistant", "--goal", TO_BOB, "--without", "loc(P, L) if work(P)")
    assert done.code == 2
    assert done.err == (
        f"seewhy: the knowledge has no axiom 'loc(P, L) if work(P)'; did you mean '{AT_WORK}'?\n"
    )


def test_a_file_of_learned_axioms_must_be_there(run: Run, tmp_path: Path) -> None:
    missing = tmp_path / "learned.al"
    done = run("plan", "robot_assistant", "--goal", TO_BOB, "--learned", str(missing))
    assert done.code == 2
    assert done.err == (
        f"seewhy: {missing}: there is no such file; 'seewhy learn DOMAIN --runs FOLDER --out FILE' "
        "writes one\n"
    )


def record(where: Sequence[Mapping[str, str]], *, places: Sequence[Sequence[str]]) -> list[History]:
    """Runs in which the robot looked for people, place by place: who is where, in each."""
    return [
        read_history(
            " ".join(
                f"observed {'' if at[person] == place else '-'}loc({person}, {place}) at {step}."
                for step, place in enumerate(seen)
                for person in at
            ),
            OFFICE.knowledge.signature,
        )
        for at, seen in zip(where, places, strict=True)
    ]


def random_record(
    runs: int, *, usually: Mapping[str, str], share: float, seed: int = 0
) -> list[History]:
    """Runs in which everybody is usually at one place, and else somewhere; four places are seen."""
    rng = np.random.default_rng(seed)
    where = [
        {o: p if rng.random() < share else str(rng.choice(PLACES)) for o, p in usually.items()}
        for _ in range(runs)
    ]
    return record(where, places=[rng.permutation(PLACES)[:4] for _ in range(runs)])


def said(found: LearnedFromRuns) -> list[str]:
    return [f"{axiom.text}: {axiom}" for axiom in found.axioms]


@pytest.fixture(scope="module")
def usual() -> LearnedFromRuns:
    return learn_from_runs(ROBOT, random_record(20, usually=AT_HOME, share=0.8))


def test_where_people_usually_are_is_learned(usual: LearnedFromRuns) -> None:
    assert learned_text(usual.axioms, source="the record of 20 runs") == (
        "% Axioms that 'seewhy learn' found in the record of 20 runs.\n"
        "\n"
        "%% if a person works in a place, then usually the person is in the place\n"
        "% learned from 40 observations, 85.0 % of them rightly\n"
        "loc(P, L) if work_place(P, L), not -loc(P, L).\n"
        "\n"
    )
    assert (usual.runs, usual.observations, usual.rejected) == (20, 320, ())


def test_what_was_learned_is_planned_with_like_what_is_given(usual: LearnedFromRuns) -> None:
    text = learned_text(usual.axioms)
    knowing = ROBOT.knowing(parse_learned(text, ROBOT.knowledge.signature))
    believed = diagnose(knowing.knowledge, knowing.history).now
    assert believed == diagnose(OFFICE.knowledge, OFFICE.history).now
    seen = knowing.history.with_observations([read_literal("-loc(bob, bobs_office)")], step=0)
    assert (
        clingo.parse_term("loc(bob,bobs_office)") not in diagnose(knowing.knowledge, seen).now.holds
    )


def test_who_is_usually_elsewhere_is_an_exception() -> None:
    found = learn_from_runs(
        ROBOT, random_record(40, usually={**AT_HOME, "bob": "kitchen"}, share=0.85)
    )
    assert said(found) == [
        "if a person other than Bob works in a place, then usually the person is in the place: "
        "loc(P, L) if work_place(P, L), P != bob, not -loc(P, L).",
        "usually Bob is in the kitchen: loc(bob, kitchen) if not -loc(bob, kitchen).",
    ]


def test_who_is_usually_absent_is_an_exception() -> None:
    rng = np.random.default_rng(1)
    where = [
        {person: place if rng.random() < 0.85 else "library" for person, place in AT_HOME.items()}
        | {"bob": str(rng.choice(["kitchen", "library", "bathroom", "sallys_office"]))}
        for _ in range(40)
    ]
    found = learn_from_runs(
        ROBOT, record(where, places=[rng.permutation(PLACES)[:4] for _ in range(40)])
    )
    assert said(found) == [
        "if a person other than Bob works in a place, then usually the person is in the place: "
        "loc(P, L) if work_place(P, L), P != bob, not -loc(P, L).",
        "if Bob works in a place, then usually Bob is not in the place: "
        "-loc(bob, P) if work_place(bob, P), not loc(bob, P).",
    ]


@pytest.mark.parametrize("seed", range(6))
def test_from_chance_nothing_is_learned(seed: int) -> None:
    runs = random_record(16, usually=AT_HOME, share=0.0, seed=seed)
    assert learn_from_runs(ROBOT, runs).axioms == ()


@pytest.mark.parametrize("seed", range(4))
def test_from_shuffled_records_nothing_is_learned(seed: int) -> None:
    """What was seen of one fluent is put down for another one."""
    rng = np.random.default_rng(seed)
    shuffled = []
    for run in random_record(16, usually=AT_HOME, share=0.8):
        signs = rng.permutation([observation.literal.positive for observation in run.observations])
        seen = [
            replace(observation, literal=replace(observation.literal, positive=bool(sign)))
            for observation, sign in zip(run.observations, signs, strict=True)
        ]
        history = History(tuple(seen))
        if explained(ROBOT.knowledge, history):
            shuffled.append(history)
    assert len(shuffled) >= 8
    assert learn_from_runs(ROBOT, shuffled).axioms == ()


def test_a_stay_is_counted_once_and_what_the_robot_did_not_at_all() -> None:
    text = """
    observed loc(sally, library) at 0. observed loc(rob1, library) at 0.
    attempted move(rob1, kitchen) at 0.
    observed loc(rob1, kitchen) at 1. observed -loc(sally, kitchen) at 1.
    attempted move(rob1, library) at 1.
    observed loc(sally, library) at 2. observed loc(rob1, library) at 2.
    """
    cases = cases_of(ROBOT.knowledge, [read_history(text, ROBOT.knowledge.signature)])
    assert [(str(case.fluent), case.holds) for case in cases] == [
        ("loc(sally,library)", True),
        ("loc(rob1,library)", True),
        ("loc(sally,kitchen)", False),
    ]


def test_boxes_teach_the_same_way() -> None:
    """Another domain, in which a sort says where things are."""
    tower = load_planning_domain(TOWER)
    robot = tower.without("default on(B, table)")
    lines = []
    for number in range(12):
        below = {"b1": "b4" if number % 4 == 0 else "table", "b2": "table", "b6": "table"}
        lines.append(
            " ".join(
                f"observed {'' if on == place else '-'}on({box}, {place}) at 0."
                for box, on in below.items()
                for place in ("table", "b3", "b4")
            )
        )
    runs = [read_history(line, tower.knowledge.signature) for line in lines]
    found = learn_from_runs(robot, runs)
    assert said(found) == ["usually a box is on a surface: on(B, S) if surface(S), not -on(B, S)."]
    assert (found.axioms[0].origin.support, found.axioms[0].origin.precision) == (36, 33 / 36)


def test_what_is_usual_need_not_speak_of_relations() -> None:
    """Of the second lamp nothing was seen, and nothing is learned."""
    known = read_knowledge("""
    #sort lamp = {l1, l2}. #fluent basic dark. #fluent basic lit(lamp). #action press(lamp).
    press(L) causes lit(L).
    """)
    lamps = replace(OFFICE, knowledge=known, history=History(), sensing=())
    seen = [f"observed {'-' * (n % 6 == 0)}dark at 0. observed lit(l1) at 0." for n in range(18)]
    found = learn_from_runs(lamps, [read_history(text, known.signature) for text in seen])
    assert said(found) == [
        "usually dark: dark if not -dark.",
        "usually lit (l1): lit(l1) if not -lit(l1).",
    ]


def test_a_run_that_nothing_explains_is_refused() -> None:
    text = "observed loc(bob, library) at 0. observed loc(bob, kitchen) at 0."
    with pytest.raises(PlanningError) as caught:
        learn_from_runs(ROBOT, [read_history(text, ROBOT.knowledge.signature)], names=["day.al"])
    assert str(caught.value).startswith(
        "day.al: nothing that may be assumed explains this history as long as it says 'observed "
    )


# From the outside


def written(folder: Path, histories: Sequence[History]) -> Path:
    for number, history in enumerate(histories):
        write_whole(folder / f"{number:02}.al", history_text(history, title="a day"))
    return folder


def test_learning_from_runs_on_the_command_line(run: Run, tmp_path: Path) -> None:
    runs = written(tmp_path / "runs", random_record(20, usually=AT_HOME, share=0.8))
    out = tmp_path / "learned.al"
    learn = ("learn", "robot_assistant", "--runs", str(runs), "--without", AT_WORK)
    done = run(*learn, "--out", str(out), "--yes")
    assert (done.code, done.out) == (
        0,
        "added: if a person works in a place, then usually the person is in the place\n"
        "  loc(P, L) if work_place(P, L), not -loc(P, L).  (40 observations, 85.0 % of them "
        "rightly)\n",
    )
    assert done.err == (
        f"what was learned is in {out}; give it to plan or simulate with --learned\n"
    )
    plan = ("plan", "robot_assistant", "--goal", TO_BOB, "--without", AT_WORK)
    assert '"supposed": []' in run(*plan, "--json", "--learned", str(out)).out
    simulate = ("simulate", "robot_assistant", "--goal", TO_BOB, "--without", AT_WORK)
    done = run(*simulate, "--seed", "6", "--learned", str(out))
    assert "after 2 actions and 1 plan." in done.out


def test_learning_from_runs_asks(run: Run, tmp_path: Path) -> None:
    runs = written(tmp_path / "runs", random_record(8, usually=AT_HOME, share=0.8))
    out = tmp_path / "learned.al"
    learn = ("learn", "robot_assistant", "--runs", str(runs), "--without", AT_WORK)
    done = run(*learn, "--out", str(out), stdin="n\n")
    assert "learned from 16 observations, 81.2 % of them rightly" in done.out
    assert not out.exists()
    done = run(*learn, "--out", str(out), stdin="")
    assert (done.code, done.err) == (
        2,
        "seewhy: no answer to 'add this axiom?', nothing is written; answer y or n, or give --yes "
        "to agree without being asked\n",
    )
    done = run(*learn, "--out", str(out), "--json")
    found = json.loads(done.out)
    assert (found["runs"], found["observations"], found["added"]) == (8, 128, [])
    assert found["found"] == ["loc(P, L) if work_place(P, L), not -loc(P, L)."]
    assert not out.exists()


def test_where_chance_rules_an_empty_file_is_written(run: Run, tmp_path: Path) -> None:
    runs = written(tmp_path / "runs", random_record(9, usually=AT_HOME, share=0.0))
    out = tmp_path / "learned.al"
    learn = ("learn", "robot_assistant", "--runs", str(runs), "--without", AT_WORK)
    done = run(*learn, "--out", str(out), "--yes")
    assert (done.code, done.out) == (0, "no axiom is to be learned from these 9 runs\n")
    plan = ("plan", "robot_assistant", "--goal", TO_BOB, "--learned", str(out))
    assert run(*plan).code == 0


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (
            "observed on(b1, table) at 0.",
            "{file}:1:10: 'on' is no fluent; it must be one of: loc, present, closed, has, "
            "message_status, unusual, cluttered",
        ),
        (
            "observed loc(rob1, library) at 0.",
            "the record shows nothing of which the knowledge leaves open how it is at first, so "
            "nothing is to be learned from it; leave out what shall be learned (--without AXIOM), "
            "or record runs in which more is seen",
        ),
        (
            "observed loc(bob, library) at 0. observed loc(bob, kitchen) at 0.",
            "{file}: nothing that may be assumed explains this history as long as it says "
            "'observed loc(bob, library) at 0'; correct it, or add to the knowledge what could "
            "have happened",
        ),
    ],
)
def test_records_that_teach_nothing_are_refused(
    run: Run, tmp_path: Path, text: str, complaint: str
) -> None:
    file = tmp_path / "run.al"
    file.write_text(text, encoding="utf-8")
    out = tmp_path / "out" / "learned.al"
    done = run("learn", "robot_assistant", "--runs", str(tmp_path), "--out", str(out), "--yes")
    assert (done.code, done.out) == (2, "")
    assert done.err == f"seewhy: {complaint.format(file=file)}\n"
    assert not out.exists()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (
            ("--runs", "nowhere", "--out", "l.al"),
            "nowhere: there is no such folder; 'seewhy simulate DOMAIN --goal GOAL --record "
            "FOLDER/NAME.al' records a run",
        ),
        (
            ("--runs", ".", "--out", "l.al"),
            ".: there is no record (*.al) in this folder; 'seewhy simulate DOMAIN --goal GOAL "
            "--record FOLDER/NAME.al' records a run",
        ),
        (
            (),
            "nothing is said to learn from; give --data FOLDER with annotated pictures, or --runs "
            "FOLDER with the record of a robot's runs",
        ),
        (
            ("--runs", "."),
            "--out: what is learned from runs is written as .al; give --out learned.al",
        ),
        (
            ("--runs", ".", "--out", "l.txt"),
            "l.txt: what is learned from runs is written as .al; give --out learned.al",
        ),
        (
            ("--runs", ".", "--data", "."),
            "--data goes with pictures, and --runs with a robot; leave one out",
        ),
        (
            ("--data", ".", "--out", "l.al"),
            "--out goes with --runs; what pictures teach is kept in the model",
        ),
    ],
)
def test_what_learning_is_asked_to_do_must_be_clear(
    run: Run,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: tuple[str, ...],
    complaint: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = run("learn", "robot_assistant", *arguments)
    assert (done.code, done.out, done.err) == (2, "", f"seewhy: {complaint}\n")


# The experiment


def test_a_trial_is_the_same_world_and_goal_for_both_arms() -> None:
    learned = parse_learned(
        f"% learned from 9 observations, 80.0 % of them rightly\n{AT_WORK}.",
        ROBOT.knowledge.signature,
    )
    rows = trial(seed=3, learned=learned)
    told = [
        {key: value for key, value in row.items() if not key.startswith("seconds_")} for row in rows
    ]
    goal = "message_status(m1, sally, delivered)"
    both = {"seed": 3, "size": 0, "outcome": "achieved", "achieved": True, "goal": goal}
    assert told == [
        {"system": "before", "plans": 6, "actions": 10, "execution": 145.0, **both},
        {"system": "after", "plans": 1, "actions": 3, "execution": 40.0, **both},
    ]
    for row in rows:
        assert row["seconds_planning"] == pytest.approx(row["seconds_per_plan"] * row["plans"])


def test_ratios_come_with_intervals() -> None:
    rng = np.random.default_rng(0)
    rows = []
    for seed in range(50):
        after = float(rng.integers(1, 4))
        rows.append({"seed": seed, "system": "after", **dict.fromkeys(MEASURES, after)})
        rows.append({"seed": seed, "system": "before", **dict.fromkeys(MEASURES, 2 * after)})
    rows.append({"seed": 50, "system": "before", **dict.fromkeys(MEASURES, 9.0)})
    found = summary(rows)
    assert [ratio.measure for ratio in found] == list(MEASURES)
    assert [ratio.paper for ratio in found] == [4.0, 2.3, 1.6, 6.0, 1.6]
    for ratio in found:
        assert ratio.trials == 50
        assert ratio.mean_of_ratios == ratio.ratio_of_means == Interval(2.0, 2.0, 2.0)
    rows[1] = {**rows[1], "plans": 0, "seconds_per_plan": None}
    plans, *_, per_plan = summary(rows)
    assert (plans.trials, per_plan.trials) == (50, 49)
    assert plans.mean_of_ratios.low < plans.mean_of_ratios.mean < 2.0
