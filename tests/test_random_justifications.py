"""Justifications of random knowledge hold; a short run of what an experiment does at length."""

from __future__ import annotations

import random
import subprocess
import sys
from dataclasses import replace

import pytest

from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.settling import JointCondition
from seewhy_lab.experiments import justifications
from seewhy_lab.experiments.justifications import check
from seewhy_lab.experiments.random_knowledge import JOINT, Beliefs, holding, random_knowledge


@pytest.mark.parametrize("first", range(0, 40, 10))
def test_justifications_of_random_knowledge_hold(first: int) -> None:
    for seed in range(first, first + 10):
        assert check(seed, scenes=2).faults == [], f"seed {seed}"


def test_the_command_prints_what_was_checked() -> None:
    run = subprocess.run(
        [
            sys.executable,
            "-m",
            "seewhy_lab",
            "justifications_hold",
            "--programs",
            "2",
            "--scenes",
            "1",
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0
    assert run.stdout.startswith("2 programs: ")
    assert run.stdout.endswith("; 0 programs at fault\n")


def without_leaves(node: Node) -> Node:
    """The node without anything that says what a feature is."""
    children = tuple(without_leaves(child) for child in node.children if child.feature is None)
    return replace(node, children=children)


def faults(monkeypatch: pytest.MonkeyPatch, name: str, broken: object) -> set[str]:
    monkeypatch.setattr(justifications, name, broken)
    return {fault.splitlines()[0] for seed in range(6) for fault in check(seed, scenes=2).faults}


def test_reasons_that_name_no_features_are_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    right = justifications.why

    def broken(*given: object) -> Node | None:
        node = right(*given)  # type: ignore[arg-type]
        return node and without_leaves(node)

    assert any("() do not suffice" in fault for fault in faults(monkeypatch, "why", broken))


def test_beliefs_without_reasons_are_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    found = faults(monkeypatch, "why", lambda *_: None)
    assert any(fault.endswith("believed by the book: True, told: False") for fault in found)


@pytest.mark.parametrize(("basis", "is_found"), [(Basis.AXIOM, True), (Basis.ASSUMED, False)])
def test_beliefs_below_themselves_are_found_out_unless_they_are_supposed(
    monkeypatch: pytest.MonkeyPatch, basis: Basis, is_found: bool
) -> None:
    right = justifications.why

    def broken(*given: object) -> Node | None:
        node = right(*given)  # type: ignore[arg-type]
        if node is None or node.basis is not Basis.AXIOM:
            return node
        again = replace(node, basis=basis, axiom=None, children=())
        return replace(node, children=(*node.children, again))

    found = faults(monkeypatch, "why", broken)
    assert any("is its own reason" in fault for fault in found) is is_found


def test_conditions_that_are_left_out_of_why_not_are_found_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    right = justifications.why_not

    def broken(*given: object) -> Node:
        node = right(*given)  # type: ignore[arg-type]
        return replace(node, children=tuple(replace(child, children=()) for child in node.children))

    found = faults(monkeypatch, "why_not", broken)
    assert any("a condition is missing" in fault for fault in found)


# Literals that settle a condition

SCENES = (
    frozenset({"f(scene)", "-g(scene,dark)", "g(scene,light)", "n(scene,2)", "m(scene,a)"}),
    frozenset({"q(scene)", "n(scene,3)", "m(scene,a)", "m(scene,b)", "r(scene)", "f(scene)"}),
    frozenset({"-f(scene)", "n(scene,1)", "g(scene,dark)", "-g(scene,light)", "-q(scene)"}),
    frozenset[str](),
)


@pytest.mark.parametrize("text", [text for text in JOINT if "N :" not in text or "n(S" in text])
@pytest.mark.parametrize("beliefs", SCENES)
def test_what_settles_a_condition_is_enough_and_nothing_is_needless(
    text: str, beliefs: Beliefs
) -> None:
    known = random_knowledge(random.Random(1))
    possible = Reasoner(known.knowledge, known.schema).possible
    # As if every literal were possible.
    keys = ("f(scene)", "g(scene,light)", "m(scene,a)", "m(scene,b)", "q(scene)", "r(scene)")
    keys += ("n(scene,1)", "n(scene,2)", "n(scene,3)")
    literals = _by_predicate(keys)
    ground = text.replace("S", "scene")
    condition = JointCondition(
        ground, possible.signature, known.schema, literals, size=possible.size
    )
    (holds,) = holding([ground], beliefs)
    assert condition.holds(beliefs) is holds
    settled = condition.settled_by({key: key in beliefs for key in condition.keys}, holds)
    assert settled is not None
    assert _always(ground, condition.keys, settled, holds)
    for left_out in settled:
        fewer = {key: value for key, value in settled.items() if key != left_out}
        assert not _always(ground, condition.keys, fewer, holds), f"{left_out} is not needed"


def _by_predicate(keys: tuple[str, ...]) -> dict[str, tuple[object, ...]]:
    import clingo

    found: dict[str, tuple[object, ...]] = {}
    for key in keys:
        symbol = clingo.parse_term(key)
        found[symbol.name] = (*found.get(symbol.name, ()), symbol)
    return found


def _always(condition: str, keys: tuple[str, ...], settled: dict[str, bool], holds: bool) -> bool:
    """Whether a condition is so whatever the literals are that are not settled, by trying all."""
    free = [key for key in keys if key not in settled]
    for chosen in range(2 ** len(free)):
        believed = {key for place, key in enumerate(free) if chosen >> place & 1}
        believed |= {key for key, value in settled.items() if value}
        if holding([condition], frozenset(believed)) != [holds]:
            return False
    return True
