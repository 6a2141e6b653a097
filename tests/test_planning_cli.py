"""`seewhy plan` and `seewhy simulate`, from the outside."""

from __future__ import annotations

import itertools
import json
import re
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from conftest import Run
from seewhy.planning.diagnosis import diagnosis
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.execution.environment import PlanningEnvironment
from seewhy.report.floor_plan import Occupant, draw_floor_plan, layout
from tower import TOWER

PAPER = "message_status(m1, sarah, delivered), loc(rob1, L), loc(sally, L)"


def timeless(text: str) -> str:
    return re.sub(r"found in \d+ ms", "found in 0 ms", text)


def test_a_plan_reads_as_a_list(run: Run) -> None:
    done = run("plan", "robot_assistant", "--goal", PAPER)
    assert timeless(done.out) == (
        "  1. move to the kitchen\n"
        "  2. move to Sarah's office\n"
        "  3. deliver the first message to Sarah\n"
        "  4. move to the kitchen\n"
        "  5. move to Sally's office\n"
        "5 actions, found in 0 ms; no plan is shorter.\n"
    )
    assert done.code == 0


def test_a_plan_says_what_it_supposes(run: Run) -> None:
    empty = ("sallys_office", "library", "bobs_office", "johns_office")
    gone = [part for place in empty for part in ("--observed", f"-loc(sally, {place})")]
    done = run("plan", "robot_assistant", "--goal", "message_status(m1, sally, delivered)", *gone)
    assert timeless(done.out) == (
        "  1. move to the kitchen\n"
        "  2. deliver the first message to Sally\n"
        "2 actions, found in 0 ms; no plan is shorter.\n"
        "This supposes that Sally is in the kitchen, which is not known.\n"
    )


def test_what_is_true_or_out_of_reach_is_said(run: Run) -> None:
    assert run("plan", "robot_assistant", "--goal", "loc(rob1, library)").out == (
        "The goal holds already; nothing is to be done.\n"
    )
    done = run("plan", "robot_assistant", "--goal", "loc(sally, library)")
    assert done.out == (
        "The goal cannot be reached: nothing that can be done leads to it that Sally is in the "
        "library.\n"
    )
    assert done.code == 1
    done = run("plan", "robot_assistant", "--goal", "loc(rob1, kitchen), loc(rob1, library)")
    assert done.out == "The goal cannot be reached: nobody is at two places.\n"
    done = run("plan", "robot_assistant", "--goal", PAPER, "--horizon", "3")
    assert done.out == ("No plan of at most 3 actions reaches the goal; try a greater --horizon.\n")


def test_a_plan_as_json(run: Run) -> None:
    done = run("plan", "robot_assistant", "--goal", "loc(rob1, kitchen)", "--json")
    found = json.loads(done.out)
    assert (found["status"], found["actions"]) == ("found", ["move(rob1,kitchen)"])
    assert len(found["states"]) == 2


def test_a_problem_is_written_for_other_planners(run: Run, tmp_path: Path) -> None:
    goal = "message_status(m1, sarah, delivered)"
    folder = tmp_path / "new" / "pddl"
    assert run("plan", "robot_assistant", "--goal", goal, "--pddl", str(folder)).code == 0
    assert (folder / "domain.pddl").read_text(encoding="utf-8").startswith("(define (domain ")
    assert "(:goal " in (folder / "problem.pddl").read_text(encoding="utf-8")
    done = run(
        "plan", "robot_assistant", "--goal", "cluttered(library)", "--pddl", str(tmp_path / "no")
    )
    assert done.code == 2
    assert "cluttered(L) if place(L)" in done.err
    assert not (tmp_path / "no").exists()


@pytest.mark.parametrize("command", ["plan", "simulate"])
def test_a_wrong_goal_is_one_sentence(run: Run, command: str) -> None:
    done = run(command, "robot_assistant", "--goal", "loc(saly, kitchen)")
    assert done.code == 2
    assert done.err == (
        "seewhy: the goal 'loc(saly, kitchen)' cannot be used: 'saly' is not of sort 'agent', "
        "which 'loc' takes here; did you mean 'sally'?\n"
    )


def test_a_domain_of_pictures_plans_nothing(run: Run) -> None:
    done = run("plan", "structure_stability", "--goal", "stable(s)")
    assert done.code == 2
    assert "the domain has no planning.toml, so nothing can be planned in it" in done.err


def test_a_run_is_told_and_drawn(run: Run, tmp_path: Path) -> None:
    page = tmp_path / "run.html"
    goal = "message_status(m1, sally, delivered)"
    done = run("simulate", "robot_assistant", "--goal", goal, "--seed", "1", "--out", str(page))
    assert done.out == (
        "  0  I plan to move to the kitchen, move to Sally's office and deliver the first message "
        "to Sally.\n"
        "     I move to the kitchen.\n"
        "  1  I move to Sally's office.\n"
        "  2  I deliver the first message to Sally.\n"
        "  3  The goal is reached.\n"
        "The robot believes that the goal is reached, after 3 actions and 1 plan.\n"
        "In truth it is reached.\n"
    )
    text = page.read_text(encoding="utf-8")
    assert text.count("<svg") == 4
    assert not re.search(r"""(src|href)=["']https?:""", text)
    for drawn in re.findall(r"<svg.*?</svg>", text, re.DOTALL):
        ElementTree.fromstring(drawn)


def test_a_record_is_asked_as_its_run_was(run: Run, tmp_path: Path) -> None:
    goal, record = "message_status(m1, sally, delivered)", tmp_path / "run.al"
    questions = ("what did you do?", "why did the plan change?", "what was your plan?",
                 "what was your plan at step 1?", "was Sally in her office?", "are you done?",
                 "why did you move to the kitchen?")  # fmt: skip
    asking = [part for question in questions for part in ("--ask", question)]
    told = run("simulate", "robot_assistant", "--goal", goal, "--seed", "12", *asking,
               "--record", str(record))  # fmt: skip
    again = run("plan", "robot_assistant", "--goal", goal, "--history", str(record), *asking)
    first = "\nwhat did you do?\n"
    assert "did not change" not in told.out
    assert again.out.partition(first)[1:] == told.out.partition(first)[1:]
    assert "The goal holds already; nothing is to be done.\n" in again.out
    assert again.code == 0


def test_a_record_of_other_actions_is_told_as_they_were_done(run: Run, tmp_path: Path) -> None:
    record = tmp_path / "other.al"
    record.write_text(
        "observed loc(rob1, library) at 0. happened move(rob1, bobs_office) at 0. "
        "observed loc(rob1, bobs_office) at 1. happened move(rob1, library) at 1. "
        "observed loc(rob1, library) at 2.",
        encoding="utf-8",
    )
    done = run("plan", "robot_assistant", "--goal", "loc(rob1, kitchen)", "--history", str(record),
               "--ask", "what did you do?", "--ask", "what is your plan?", "--json")  # fmt: skip
    replies = json.loads(done.out)["replies"]
    assert [reply["text"] for reply in replies] == [
        "I moved to Bob's office and moved to the library.",
        "My plan is to move to the kitchen.",
    ]


@pytest.mark.parametrize("command", ["plan", "simulate"])
def test_what_is_not_understood_does_not_stop_the_other_questions(run: Run, command: str) -> None:
    asking = ("--ask", "why did you frob?", "--ask", "what is your goal?")
    done = run(command, "robot_assistant", "--goal", "loc(rob1, kitchen)", *asking)
    assert done.out.endswith("\nwhat is your goal?\nMy goal is that I am in the kitchen.\n")
    assert done.err.startswith("seewhy: 'why did you frob?' is not understood; ask for instance: ")
    assert done.code == 2
    told = run(command, "robot_assistant", "--goal", "loc(rob1, kitchen)", *asking, "--json")
    first, second = json.loads(told.out)["replies"]
    assert (first["question"], first["nearest"] != []) == ("why did you frob?", True)
    assert second["text"] == "My goal is that I am in the kitchen."


def test_the_same_seed_gives_the_same_run(run: Run) -> None:
    arguments = ("simulate", "robot_assistant", "--goal", "loc(rob1, L), loc(bob, L)", "--json")

    def steps(seed: str) -> object:
        found = json.loads(run(*arguments, "--seed", seed).out)
        return [{**step, "planning_seconds": 0} for step in found["steps"]]

    assert steps("3") == steps("3")


def test_a_page_needs_its_ending(run: Run, tmp_path: Path) -> None:
    done = run(
        "simulate", "robot_assistant", "--goal", "loc(rob1, kitchen)", "--out", str(tmp_path / "a")
    )
    assert done.code == 2
    assert "the run is written as .html; choose a name that ends so" in done.err


def test_a_folder_of_ones_own_plans_as_well(run: Run, tmp_path: Path) -> None:
    folder = tmp_path / "own"
    shutil.copytree(load_planning_domain("robot_assistant").folder, folder)
    done = run("plan", str(folder), "--goal", "loc(rob1, kitchen)")
    assert done.out.startswith("  1. move to the kitchen\n")


def test_places_far_apart_are_drawn_far_apart() -> None:
    at = layout(["a", "b", "c", "d"], [("a", "b"), ("b", "c"), ("c", "d")])
    assert abs(at["a"][0] - at["d"][0]) > abs(at["a"][0] - at["b"][0])


def test_beliefs_and_truth_look_different() -> None:
    def drawn(*, believed: bool, true: bool) -> str:
        occupants = {"a": [Occupant("Sally", believed=believed, true=true)]}
        return draw_floor_plan({"a": (0.5, 0.5)}, [], {"a": "A"}, occupants).svg

    assert (
        len({drawn(believed=b, true=t) for b, t in ((True, True), (True, False), (False, True))})
        == 3
    )


def test_a_run_can_be_asked_about(run: Run) -> None:
    goal = "message_status(m1, sally, delivered)"
    questions = ("why did you move to the kitchen?", "what would you do if I sang?")
    asked = ("simulate", "robot_assistant", "--goal", goal, "--seed", "1", "--ask")
    assert run(*asked, questions[0]).out.endswith(
        "why did you move to the kitchen?\n"
        "I moved to the kitchen at step 0 because I wanted to move to Sally's office, in order to "
        'deliver the first message to Sally. Otherwise I could not have done that: "the robot '
        'moves to places next to its own", and I was in the library and the library is not next '
        "to Sally's office.\n"
    )
    refused = run(*asked, questions[1])
    assert refused.code == 2
    assert "what would you do if I sang" in refused.err


CHAT = """\
where are you?

what is the meaning of life?
why did you not move to Bob's office at step 0?
where were you at step 9?
quit
what is your goal?
"""


def test_a_run_can_be_talked_about(run: Run) -> None:
    goal = "message_status(m1, sally, delivered)"
    talk = ("simulate", "robot_assistant", "--goal", goal, "--seed", "1", "--chat")
    told = run(*talk, stdin=CHAT)
    assert told.code == 0
    assert told.out.split("In truth it is reached.\n")[1] == (
        "I am in Sally's office. I saw at step 3 that I was in Sally's office.\n"
        "The plan would have been longer: 5 actions (move to Bob's office, move to the library, "
        "move to the kitchen, move to Sally's office and deliver the first message to Sally) "
        "instead of 3.\n"
    )
    not_understood, no_such_step = told.err.splitlines()
    assert not_understood.startswith("seewhy: 'what is the meaning of life?' is not understood; ")
    assert not_understood.count(" · ") == 2
    assert no_such_step == (
        "seewhy: there is no step 9 yet: the run has come to step 3; ask about step 0 to 3"
    )


def test_a_talk_about_a_run_in_json_is_a_line_each(run: Run) -> None:
    goal = "message_status(m1, sally, delivered)"
    talk = ("simulate", "robot_assistant", "--goal", goal, "--seed", "1", "--chat", "--json")
    lines = [json.loads(line) for line in run(*talk, stdin=CHAT).out.splitlines()]
    assert (lines[0]["outcome"], lines[0]["achieved"]) == ("achieved", True)
    assert lines[1]["query"]["asks"] == "where"
    assert len(lines[2]["nearest"]) == 3
    assert lines[3]["reasons"]["against"] == "the plan would have been longer"
    assert lines[4]["error"].startswith("there is no step 9 yet")
    assert len(lines) == 5


def test_a_talk_ends_with_its_input(run: Run) -> None:
    talk = ("simulate", str(TOWER), "--goal", "holding(rob1, b1)", "--chat")
    asked = run(*talk, stdin="what do you hold\nwhat do you sing")
    assert asked.code == 0
    assert asked.out == f"{run(*talk).out}I hold the first small box.\n"
    assert asked.err.startswith("seewhy: 'what do you sing' is not understood; ask for instance: ")


def test_a_domain_can_ask_answer_sets_alone(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "own"
    shutil.copytree(load_planning_domain("robot_assistant").folder, folder)
    asked = ("plan", str(folder), "--goal", "loc(rob1, kitchen)")
    text = (folder / "planning.toml").read_text(encoding="utf-8")
    robot = 'robot = "rob1"\n'
    (folder / "planning.toml").write_text(text.replace(robot, f"{robot}answer_sets = true\n"))

    def searched(*_: object, **__: object) -> None:
        raise RuntimeError("the states were searched")

    monkeypatch.setattr("seewhy.planning.planner.planner.ground_problem", searched)
    assert run(*asked).out.startswith("  1. move to the kitchen\n1 action, ")
    (folder / "planning.toml").write_text(text, encoding="utf-8")
    with pytest.raises(RuntimeError, match="were searched"):
        run(*asked)


def test_a_domain_that_plans_is_checked(run: Run, tmp_path: Path) -> None:
    done = run("check", str(TOWER))
    assert done.out.splitlines()[1:] == [
        "  fluents: 11",
        "  actions: 5",
        "  axioms: 50",
        "  note: it is never possible to put any box on the ball: put(rob1, _, b5)",
        "  note: it is never possible to put any box on the roof: put(rob1, _, b6)",
        "nothing is wrong",
    ]
    both = run("check", "robot_assistant").out
    assert both.startswith("Rooms of an office building (robot_assistant) in ")
    assert "\nA robot that delivers messages in an office building (robot_assistant) in " in both
    folder = tmp_path / "own"
    shutil.copytree(load_planning_domain("robot_assistant").folder, folder)
    text = (folder / "knowledge.al").read_text(encoding="utf-8")
    (folder / "knowledge.al").write_text(
        text.replace("library, bathroom}", "library, bathroom, attic}")
    )
    said = "  note: it is never possible to move to attic: move(rob1, attic)\n"
    assert said in run("check", str(folder)).out
    found = json.loads(run("check", str(folder), "--json").out)
    assert (len(found["axioms"]), found["planning"]["fluents"]) == (0, 7)


def test_a_folder_that_only_plans_is_not_trained(run: Run, tmp_path: Path) -> None:
    done = run("train", str(TOWER), "--data", str(tmp_path), "--out", str(tmp_path / "m"))
    assert done.code == 2
    assert done.err == (
        f"seewhy: {TOWER}: the folder plans and has no pictures to train on; ask 'seewhy plan "
        f"{TOWER}', 'seewhy simulate {TOWER}' or 'seewhy check {TOWER}'\n"
    )


def test_an_interrupted_run_is_told_as_far_as_it_came(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done_before = PlanningEnvironment.step
    steps = itertools.count()

    def step(environment: PlanningEnvironment, action: int) -> object:
        if next(steps) == 1:
            raise KeyboardInterrupt
        return done_before(environment, action)

    monkeypatch.setattr(PlanningEnvironment, "step", step)
    page = tmp_path / "run.html"
    goal = "message_status(m1, sally, delivered)"
    done = run("simulate", "robot_assistant", "--goal", goal, "--seed", "1", "--out", str(page))
    assert done.code == 130
    assert done.out.endswith(
        "     I move to the kitchen.\n"
        "The run was interrupted, after 1 action and 1 plan.\n"
        "In truth it is not reached.\n"
    )
    assert page.read_text(encoding="utf-8").count("<svg") == 1


def test_a_history_is_explained_once(monkeypatch: pytest.MonkeyPatch) -> None:
    explained: list[str] = []
    explain = diagnosis.BoundedControl

    def counted(text: str, **options: Any) -> Any:
        explained.append(text)
        return explain(text, **options)

    monkeypatch.setattr(diagnosis, "BoundedControl", counted)
    monkeypatch.setattr(diagnosis, "_DIAGNOSED", {})
    known = load_planning_domain("robot_assistant")
    first = diagnosis.diagnose(known.knowledge, known.history)
    assert diagnosis.diagnose(known.knowledge, known.history) is first
    assert len(explained) == len(set(explained)) == 1
    # The same program with other sentences is explained anew: surprises tell them.
    said = [replace(axiom, text=f"{axiom.text}!") for axiom in known.knowledge.axioms]
    other = replace(known.knowledge, axioms=tuple(said))
    assert diagnosis.diagnose(other, known.history) is not first
