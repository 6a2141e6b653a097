"""What a robot learns from the record of its earlier runs, and what it is told or not told."""

from __future__ import annotations

from pathlib import Path

from conftest import Run
from seewhy.knowledge.history import read_history_file
from seewhy.planning.domain import load_planning_domain

OFFICE = load_planning_domain("robot_assistant")
AT_WORK = "loc(P, L) if work_place(P, L), not -loc(P, L)"
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
    assert [own for own in lines if not own.startswith("observed")][1:] == [
        "attempted move(rob1, johns_office) at 0.",
        "attempted move(rob1, library) at 1.",
        "attempted move(rob1, bobs_office) at 2.",
        "attempted deliver(rob1, m1, bob) at 3.",
    ]
    assert "observed loc(bob, bobs_office) at 3." in lines
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
