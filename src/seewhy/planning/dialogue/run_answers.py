"""Answer questions about a run: what is believed, what was done, why, and what else could be."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from seewhy.errors import QuestionError
from seewhy.planning.dialogue import (
    action_answers,
    change_answers,
    course_answers,
    expectation_answers,
    past_answers,
    supposed_answers,
)
from seewhy.planning.dialogue.addressing import addressed, as_asked
from seewhy.planning.dialogue.belief_answers import BeliefAnswers
from seewhy.planning.dialogue.query import Asks, Query, Told
from seewhy.planning.dialogue.question_parsing import PlanningQuestions
from seewhy.planning.dialogue.reconstructed_run import recalled
from seewhy.planning.dialogue.run_view import RunView
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Run
from seewhy.planning.things.scene_answers import SceneAnswers

_ABOUT_RUN: Mapping[Asks, Callable[[RunView, Query], Told]] = {
    Asks.PLAN: course_answers.plan,
    Asks.DONE: course_answers.done,
    Asks.HOW_MANY_DONE: course_answers.how_many_done,
    Asks.GOAL: course_answers.goal,
    Asks.DID: course_answers.did_so,
    Asks.ENDED: course_answers.has_ended,
    Asks.WHY_ENDED: course_answers.why_ended,
    Asks.WHY_DID: action_answers.why_did,
    Asks.WHY_NOT: action_answers.why_not,
    Asks.WHAT_IF: supposed_answers.what_if,
    Asks.WHY_CHANGED: change_answers.why_changed,
    Asks.EXPECTED: expectation_answers.expected,
}
_IN_THE_PAST: Mapping[Asks, Callable[[RunView, Query], Told]] = {
    Asks.IS: past_answers.was_so,
    Asks.WHERE: past_answers.where_was,
    Asks.CONTENTS: past_answers.which_were,
    Asks.WHICH: past_answers.which_were,
}


@dataclass(frozen=True)
class PlanningReply:
    """The answer to a question about a run.

    Attributes
    ----------
    text : str
    query : Query
        The question as it was understood.
    reasons : dict
        What the answer rests on, as values that JSON can hold.
    """

    text: str
    query: Query
    reasons: dict[str, Any] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """Return the reply as values that JSON can hold."""
        return {"text": self.text, "query": self.query.to_dict(), "reasons": self.reasons}


def answer(domain: PlanningDomain, run: Run, question: str) -> PlanningReply:
    """Answer a question in words about a run, as whoever acts in it.

    Parameters
    ----------
    domain : PlanningDomain
    run : Run
        Finished, interrupted or not yet begun.
    question : str
        Such as "why did you move to the kitchen at step 2?". A step is the number of actions
        done before it; what is asked of a step is answered as it was believed then.

    Raises
    ------
    QuestionError
        If the question is not understood, or asks of a step that there is not.

    Examples
    --------
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> run = Run(read_goal("loc(rob1, kitchen)", domain.knowledge), domain.history)
    >>> print(answer(domain, run, "what is your goal?").text)
    My goal is that I am in the kitchen.
    """
    return RunAnswers(domain, run).answer(question)


class RunAnswers:
    """The answers about one run; for many questions, where :func:`answer` is for one.

    Examples
    --------
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> run = Run(read_goal("loc(rob1, kitchen)", domain.knowledge), domain.history)
    >>> answers = RunAnswers(domain, run)
    >>> asked = ("where are you?", "what is your plan?")
    >>> [answers.answer(question).query.asks.value for question in asked]
    ['where', 'plan']
    """

    def __init__(self, domain: PlanningDomain, run: Run) -> None:
        # Without errors there may be no explanation of what networks read.
        domain = replace(domain, seen_by_networks=run.sensors_err)
        run = recalled(domain, run)
        self.run = run
        self._domain = domain
        self._others: dict[str, RunAnswers] = {}
        self.questions = PlanningQuestions(domain)
        self.view = RunView(domain, run)
        self.beliefs = BeliefAnswers(domain, run)
        self.scene = None if domain.at_first is None else SceneAnswers(domain.at_first, self.view)

    def answer(self, question: str) -> PlanningReply:
        """Answer a question in words; where it begins or ends with a robot's name, as that robot.

        Raises
        ------
        QuestionError
            As :func:`answer`.
        """
        other, rest = addressed(self._domain, question)
        if other is None or other == self._domain.robot:
            return self._replied(rest)
        if other not in self._others:
            self._others[other] = RunAnswers(as_asked(self._domain, other), self.run)
        return self._others[other].answer(rest)

    def _replied(self, question: str) -> PlanningReply:
        """An answer about the run, or about the things as they are believed to be now."""
        try:
            query = self.questions.understand(question)
        except QuestionError as problem:
            if self.scene is None:
                raise
            told = self.scene.answer(question, instead_of=problem)
            return PlanningReply(told.text, Query(Asks.SCENE, question.strip(" ?")), told.reasons)
        if self.scene is not None:
            self.scene.forget()
        return self.reply(query)

    def reply(self, query: Query) -> PlanningReply:
        """Answer a question that was understood."""
        last = self.run.history.last_step
        if query.step is not None and query.step > last:
            raise QuestionError(
                f"there is no step {query.step} yet: the run has come to step {last}; ask about "
                f"step {f'0 to {last}' if last else 0}"
            )
        if query.asks in _ABOUT_RUN:
            text, reasons = _ABOUT_RUN[query.asks](self.view, query)
        else:
            text, reasons = self._believed(query)
        if query.foil is not None:
            also, against = self._rather_than(query, query.foil, reasons)
            text = " ".join(filter(None, [text, also]))
            reasons = reasons | {"rather_than": against}
        return PlanningReply(text, query, reasons)

    def _believed(self, query: Query) -> Told:
        fixed = self.view.domain.words.fixed
        if query.past and query.asks in _IN_THE_PAST and query.predicate not in fixed:
            text, reasons = _IN_THE_PAST[query.asks](self.view, query)
            if text:
                return text, reasons
        about_beliefs: dict[Asks, Callable[[Query], Told]] = {
            Asks.IS: self.beliefs.is_so,
            Asks.WHERE: self.beliefs.where,
            Asks.CONTENTS: self.beliefs.contents,
            Asks.WHICH: self.beliefs.which,
            Asks.WHY_BELIEVE: self.beliefs.why_believe,
            Asks.WHY_DISBELIEVE: self.beliefs.why_disbelieve,
        }
        return about_beliefs[query.asks](query)

    def _rather_than(self, query: Query, foil: Query, reasons: dict[str, Any]) -> Told:
        """What speaks against the other of a contrast, where the one is so."""
        if query.asks is not Asks.WHY_BELIEVE:
            return action_answers.rather_than(self.view, query, foil, reasons)
        if not reasons.get("believed"):
            return "", {}
        return self.beliefs.why_believe(replace(foil, positive=not foil.positive))
