"""Runs of robots as the pages see them: domains to choose from, steps, and questions."""

from __future__ import annotations

import itertools
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from threading import Lock
from typing import Any

import clingo

from seewhy.errors import SeeWhyError
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.ground_literal import read_ground_literal
from seewhy.knowledge.history import read_history_file
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.dialogue.query import Asks, Query
from seewhy.planning.dialogue.run_answers import PlanningReply, RunAnswers
from seewhy.planning.domain import (
    PlanningDomain,
    bundled_planning_domains,
    planning_folder,
    plans,
)
from seewhy.planning.execution.execution import Run
from seewhy.planning.spoken_goals import goal_of
from seewhy.studio.jobs import Job
from seewhy.studio.project import Project
from seewhy.studio.robot_beginnings import Beginning
from seewhy.studio.robot_process import RECORD_FILE

__all__ = [
    "RobotRun",
    "answer",
    "domains_of",
    "questions_about",
    "run_of",
    "supposable",
    "what_if",
]

_MOST_BYTES = 32_000_000
_MOST_SUPPOSED = 300
"""Fluents that may be supposed; of more a list is no help."""

_answering = Lock()
"""What answers about a run keeps what it found; one question at a time."""


@dataclass(frozen=True)
class RobotRun:
    """What is known of a run by now.

    Attributes
    ----------
    steps : sequence of mapping
        As :class:`~seewhy.report.run_page.StepsShown` has them.
    ended : str
        How it ended, in a sentence; empty while it goes on.
    achieved : bool
        Whether the goal truly holds at the end.
    """

    steps: Sequence[Mapping[str, Any]]
    ended: str = ""
    achieved: bool = False


def domains_of(project: Project) -> dict[str, str]:
    """The domains that plan: what is handed to a command → words; the project's own first."""
    found: dict[str, str] = {}
    folder = project.domain_folder
    if folder is not None and plans(folder):
        found[str(folder)] = f"{folder.name} (of this project)"
    return found | {name: name.replace("_", " ") for name in bundled_planning_domains()}


def run_of(job: Job) -> RobotRun:
    """Read the steps that a run has printed so far."""
    try:
        with job.output.open(encoding="utf-8") as printed:
            text = printed.read(_MOST_BYTES)
    except OSError:
        return RobotRun(())
    # The last line may be under way.
    lines = [json.loads(line) for line in text.splitlines(keepends=True) if line.endswith("\n")]
    steps = [line for line in lines if "number" in line]
    end = next((line for line in lines if "ended" in line), None)
    return RobotRun(steps) if end is None else RobotRun(steps, end["ended"], end["achieved"])


def answer(job: Job, question: str) -> PlanningReply:
    """Answer a question about a run in words.

    Raises
    ------
    QuestionError
        If it is not understood; the text offers what is.
    """
    with _answering:
        return _answers_about(job).answer(question)


def what_if(job: Job, literal: str, *, step: int | None = None) -> PlanningReply:
    """Say what the robot would do if a literal held, at the end of the run or at a step.

    Raises
    ------
    SeeWhyError
        If it is no literal about a fluent, or there is no such step.
    """
    with _answering:
        about = _answers_about(job)
        domain = Beginning.of(job.asked).load()
        read = read_ground_literal(literal, domain.knowledge.signature, of="fluent")
        symbol = clingo.parse_term(key_of(read))
        query = Query(
            Asks.WHAT_IF,
            f"what if {domain.words.say(symbol)}",
            symbol.name,
            tuple(map(str, symbol.arguments)),
            symbol.positive,
            step=step,
        )
        return about.reply(query)


def questions_about(beginning: Beginning) -> tuple[str, ...]:
    """A question of each kind that a run with such a beginning may be asked."""
    return _questions_about(beginning, _read_when(beginning.domain))


def supposable(domain: PlanningDomain) -> dict[str, str]:
    """What may be supposed to be so: literals that say of each basic fluent that it holds → words.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> supposable(load_planning_domain("robot_assistant"))["closed(library)"]
    'the library is closed'
    """
    symbols = list(itertools.islice(_fluents(domain.knowledge), _MOST_SUPPOSED + 1))
    if len(symbols) > _MOST_SUPPOSED:
        return {}
    return {str(symbol): domain.words.say(symbol) for symbol in symbols}


def _fluents(knowledge: Knowledge) -> Any:
    signature = knowledge.signature
    # What has fewest arguments first: whether a door is closed, before who has which message.
    predicates = sorted(signature.predicates.values(), key=lambda one: len(one.sorts))
    for predicate in predicates:
        if predicate.kind is not PredicateKind.FLUENT_BASIC:
            continue
        for arguments in itertools.product(*map(signature.members, predicate.sorts)):
            terms = [clingo.parse_term(argument) for argument in arguments]
            yield clingo.Function(predicate.name, terms)


def _answers_about(job: Job) -> RunAnswers:
    record = job.folder / RECORD_FILE
    try:
        changed = record.stat().st_mtime_ns
    except OSError:
        raise SeeWhyError("the run has not come to a step yet; ask when it has") from None
    return _answers(Beginning.of(job.asked), job.asked["goal"], record, changed)


@lru_cache(maxsize=4)
def _answers(
    beginning: Beginning,
    goal: str,
    record: Path,
    changed: int,  # noqa: ARG001
) -> RunAnswers:
    domain = beginning.load()
    history = read_history_file(record, domain.knowledge.signature)
    return RunAnswers(domain, Run(goal_of(goal, domain), history))


@lru_cache(maxsize=8)
def _questions_about(
    beginning: Beginning,
    changed: tuple[int, ...],  # noqa: ARG001
) -> tuple[str, ...]:
    from seewhy.planning.dialogue.question_parsing import PlanningQuestions

    return tuple(PlanningQuestions(beginning.load()).examples())


def _read_when(domain: str) -> tuple[int, ...]:
    folder = planning_folder(domain)
    return tuple(
        file.stat().st_mtime_ns
        for file in (folder / "planning.toml", folder / "knowledge.al")
        if file.is_file()
    )
