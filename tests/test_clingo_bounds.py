"""Every call of clingo ends: by an answer, a bound, or Ctrl-C; and threads may share a reasoner."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from pathlib import Path

import pytest

from conftest import KNOWLEDGE, write_domain
from seewhy.agent.agent import Agent
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import ReasoningError, SeeWhyError
from seewhy.knowledge import bounded_control
from seewhy.knowledge.abandoned import still_working
from seewhy.knowledge.bounded_control import BoundedControl, OutOfTimeError
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.grounding_size import GroundingSize, grounding_size
from seewhy.knowledge.history import read_history
from seewhy.knowledge.language import read_knowledge
from seewhy.knowledge.reasoner import Reasoner
from seewhy.planning.diagnosis.diagnosis import diagnose

MANY = """
#sort number = 1..10000.
#static twin(number).
twin(A) if number(A), number(B), number(C), number(D), A * B = C * D, A + B > C.
"""
PIGEONS = """
#sort pigeon = 1..14. #sort hole = 1..13.
#static inside(pigeon, hole). #static housed(pigeon). #static lost(pigeon).
inside(P, H) if pigeon(P), hole(H), not -inside(P, H).
-inside(P, H) if pigeon(P), hole(H), not inside(P, H).
-inside(P, H) if inside(Q, H), pigeon(P), P != Q.
housed(P) if inside(P, H).
lost(P) if pigeon(P), not housed(P), not lost(P).
"""
HOLES = "1 { in(P, H) : H = 1..12 } 1 :- P = 1..13. :- in(P, H), in(Q, H), P < Q."


def test_a_small_program_is_answered_at_once() -> None:
    control = BoundedControl("1 { a; b } 1. :- a.", size=GroundingSize())
    assert [list(map(str, model)) for model in control.models()] == [["b"]]


def test_a_search_goes_on_beyond_its_first_conflicts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounded_control, "_CONFLICTS", 3)
    monkeypatch.setattr(bounded_control, "_SOONER", 0.0)
    few = HOLES.replace("12", "6").replace("13", "7")
    assert BoundedControl(few, size=GroundingSize()).models() == []
    least = few.replace(":- in", "bad(P, Q) :- in") + " :~ bad(P, Q). [1, P, Q]"
    found = BoundedControl(least, size=GroundingSize()).last_model()
    assert found is not None
    assert sum(atom.name == "bad" for atom in found) == 1


def test_the_one_model_that_is_asked_for_does_not_depend_on_the_clock(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    apart = "3 { a(X) : X = 1..9 } 4. :- a(X), a(X+1)."
    soon = BoundedControl(apart, size=GroundingSize()).last_model()
    monkeypatch.setattr(bounded_control, "_SOON", 0.0)
    assert BoundedControl(apart, size=GroundingSize()).last_model() == soon


def test_a_search_that_takes_too_long_ends_with_a_sentence(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(bounded_control, "SOLVING_SECONDS", 0.3)
    control = BoundedControl(HOLES, size=GroundingSize(156, "k.al:3:1: 'in(P, H).' has instances"))
    with pytest.raises(OutOfTimeError) as caught:
        control.models()
    assert str(caught.value) == (
        "k.al:3:1: 'in(P, H).' has instances; the search for answer sets took longer than 0 s; "
        "give its sorts fewer members, or write it with fewer variables"
    )
    assert not still_working()


def test_models_without_end_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounded_control, "SOLVING_SECONDS", 0.3)
    monkeypatch.setattr(bounded_control, "_SOON", 0.1)
    control = BoundedControl("{ a(1..40) }.", size=GroundingSize())
    control.configuration.models = 0
    with pytest.raises(OutOfTimeError):
        control.models()
    control.configuration.models = 1
    assert len(control.models()) == 1


def test_memory_that_grows_ends_a_search(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounded_control, "MEMORY", -(2**40))
    with pytest.raises(ReasoningError, match="the search for answer sets took more than"):
        BoundedControl(HOLES, size=GroundingSize()).models()


def test_what_grows_is_named_with_its_place(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounded_control, "GROUNDING_SECONDS", 1.0)
    known = read_knowledge(MANY + "#fluent basic dark(number).", file="k.al")
    begun = time.perf_counter()
    with pytest.raises(ReasoningError) as caught:
        diagnose(known, read_history("", known.signature))
    assert time.perf_counter() - begun < 4
    assert str(caught.value) == (
        "k.al:4:1: 'twin(A) if number(A), number(B), number(C), number(D), (A*B) = (C*D), (A+B) > "
        "C.' has up to 10,000,000,000,000,000 instances; grounding took longer than 1 s; give its "
        "sorts fewer members, or write it with fewer variables"
    )


def test_too_many_atoms_and_too_little_memory_are_said(monkeypatch: pytest.MonkeyPatch) -> None:
    large = GroundingSize(10**9)
    monkeypatch.setattr(bounded_control, "MOST_ATOMS", 1_000)
    with pytest.raises(ReasoningError, match="it comes to more than 1,000 atoms"):
        BoundedControl("a(1..2000).", size=large)
    monkeypatch.setattr(bounded_control, "MEMORY", 2**27)
    with pytest.raises(ReasoningError, match=r"grounding took more than 0.12 GiB of memory"):
        BoundedControl("a(1..3000, 1..3000).", size=large)


def test_what_is_large_and_can_be_grounded_is() -> None:
    control = BoundedControl("a(1..5). b(X, Y) :- a(X), a(Y), X < Y.", size=GroundingSize(10**9))
    assert len(list(control.by_signature("b", 2))) == 10


@pytest.mark.parametrize(
    ("axiom", "instances"),
    [
        ("p(A) if n(A).", 20),
        ("p(A) if n(A), n(B), A < B.", 400),
        ("p(A) if q(A, B), m(A).", 9),
        ("p(A) if n(A), #count { B, C : q(B, C) } > 3.", 1_200),
        ("p(A) if n(A), B = A + 1, n(B).", 400),
        ("p(A) if n(A), q(A, 1..2).", 40),
        ("p(A) if n(A), n(_).", 20),
    ],
)
def test_there_are_never_more_instances_than_are_told(axiom: str, instances: int) -> None:
    signature = "#sort n = 1..20. #sort m = 1..3. #static p(n). #static q(n, m)."
    assert grounding_size(read_knowledge(f"{signature} {axiom}")).instances == instances


def interrupted(folder: Path, *command: str, after: float) -> tuple[int, float, str]:
    """The status of a command that is interrupted, the seconds that it then takes, its words."""
    begins = "import seewhy.cli.main as m, seewhy.check.domain; print(1, flush=True); m.main()"
    process = subprocess.Popen(
        [sys.executable, "-c", begins, *command],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        start_new_session=True,
    )  # fmt: skip
    assert process.stdout is not None
    assert process.stdout.readline() == "1\n"
    time.sleep(after)
    assert process.poll() is None, process.communicate()[0]
    begun = time.perf_counter()
    os.killpg(process.pid, signal.SIGINT)
    said = process.communicate(timeout=30)[0]
    return process.returncode, time.perf_counter() - begun, said


@pytest.mark.parametrize("more", [MANY, PIGEONS], ids=["grounding", "searching"])
def test_an_interruption_is_heard_while_clingo_works(tmp_path: Path, more: str) -> None:
    write_domain(tmp_path / "tiles", knowledge=KNOWLEDGE + more)
    code, seconds, said = interrupted(tmp_path, "check", "tiles", after=2.0)
    assert code == 130, said
    assert seconds < 3.0  # one on a machine that does nothing else
    assert "interrupted" in said
    assert "terminate" not in said
    assert "Traceback" not in said


def test_a_domain_that_grows_is_refused_by_check(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bounded_control, "GROUNDING_SECONDS", 1.0)
    with pytest.raises(SeeWhyError, match="has up to 10,000,000,000,000,000 instances; grounding"):
        load_domain(write_domain(tmp_path / "tiles", knowledge=KNOWLEDGE + MANY))


@pytest.fixture
def switching() -> Iterator[None]:
    """Threads that take turns as often as can be."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    yield
    sys.setswitchinterval(before)


@pytest.mark.usefixtures("switching")
def test_threads_may_share_a_reasoner(structures: Domain) -> None:
    known, schema = structures.knowledge, structures.schema
    vectors = [*product(*[[*values, None] for values in schema.features.values()])]
    alone = Reasoner(known, schema)
    expected = [(alone.decide(vector), alone.believed(vector)) for vector in vectors]
    for _ in range(3):
        shared = Reasoner(known, schema)

        def work(first: int, shared: Reasoner = shared) -> bool:
            turned = vectors[first:] + vectors[:first]
            decided = shared.decide_all(turned)
            believed = [shared.believed(vector) for vector in turned]
            return [*zip(decided, believed, strict=True)] == expected[first:] + expected[:first]

        with ThreadPoolExecutor(8) as threads:
            assert all(threads.map(work, range(0, len(vectors), len(vectors) // 8)))


def test_threads_that_look_for_the_same_change_add_its_goal_once(
    structures: Domain, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whoever adds rules is kept waiting, so that the others come while it does."""
    add = BoundedControl.add

    def slowly(control: BoundedControl, part: str, program: str) -> None:
        time.sleep(0.05)
        add(control, part, program)

    monkeypatch.setattr(BoundedControl, "add", slowly)
    vector = structures.vector({"num_blocks": "5", "lean": "yes", "block_displaced": "yes"})
    labels = ["stable", "unstable"] * 4
    alone = ChangeFinder(Reasoner(structures.knowledge, structures.schema))
    expected = [alone.smallest(vector, label) for label in labels]
    shared = ChangeFinder(Reasoner(structures.knowledge, structures.schema))
    with ThreadPoolExecutor(8) as threads:
        found = list(threads.map(lambda label: shared.smallest(vector, label), labels))
    assert found == expected


@pytest.mark.usefixtures("switching")
def test_threads_may_share_an_agent(model_folder: Path, tiles_data: Path) -> None:
    asked = ["why is it good?", "why is it not bad?", "what would make it bad?", "is it round?"]
    pictures = sorted((tiles_data / "images").iterdir())[:6]

    def answers(agent: Agent) -> list[str]:
        said = []
        for scene in map(agent.classify, pictures):
            for question in map(agent.questions.understand, asked):
                reply = agent.answer(scene, question)
                said.append(str(reply))
        return said

    expected = answers(Agent.load(model_folder))
    for _ in range(2):
        fresh = Agent.load(model_folder)
        with ThreadPoolExecutor(8) as threads:
            for found in threads.map(answers, [fresh] * 8):
                assert found == expected
