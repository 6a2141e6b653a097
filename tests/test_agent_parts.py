"""The parts of an agent: values, one of which takes the place of another."""

from __future__ import annotations

from copy import copy

import pytest

from conftest import TRUTH
from seewhy.agent.agent import Agent
from seewhy.domain.domain import Domain
from seewhy.errors import DomainError
from seewhy.knowledge.learned_file import Withdrawn


def test_what_an_agent_is_told_later_is_checked_as_well(tiles: Domain) -> None:
    agent = Agent(tiles)
    agent.reading = "consistent"
    assert (agent.settings.reading, agent.reading) == ("consistent", "consistent")
    with pytest.raises(DomainError, match="gate must be 0 to 1, got 2"):
        agent.gate = 2.0
    assert agent.gate is None


def test_what_follows_cannot_be_set(tiles: Domain) -> None:
    agent = Agent(tiles)
    with pytest.raises(AttributeError, match="property 'learned' of 'Agent' object has no setter"):
        agent.learned = ()  # type: ignore[misc]


def test_a_copy_stays_as_it_is_when_the_agent_learns(tiles: Domain) -> None:
    agent = Agent(tiles)
    before = copy(agent)
    agent.fit_induction([*TRUTH] * 3, [*TRUTH.values()] * 3, answers=False)
    assert agent.tree.fitted
    assert not before.tree.fitted
    assert before.experience == {}
    assert before.decide({"colour": "green", "round": "no"}) is None


def test_candidates_are_listed_once_for_the_same_parts(tiles: Domain) -> None:
    agent = Agent(tiles)
    first = agent.reading_by.consistent("consistent")
    agent.known_share = 0.5
    assert agent.reading_by.consistent("consistent") is first
    agent.experience = {("green", "yes"): {"good": 1}}
    assert agent.reading_by.consistent("consistent") is not first


def test_a_given_axiom_is_known_again(tiles: Domain) -> None:
    axiom = tiles.knowledge.axioms[0]
    known = Agent(tiles).known
    poorer = known.withdrawing(Withdrawn(str(axiom), "nobody believes it", given=True))
    assert axiom not in poorer.domain.knowledge.axioms
    assert poorer.given == tiles
    restored = poorer.restoring(poorer.axiom_set_aside(axiom.identifier))
    assert restored.withdrawn == ()
    assert restored.domain == known.domain
