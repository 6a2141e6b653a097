"""Questions about a run: options of the commands that plan and simulate, and their answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

import typer

from seewhy.cli.conversation import converse
from seewhy.cli.screen import complain, say

if TYPE_CHECKING:
    from seewhy.errors import QuestionError
    from seewhy.planning.dialogue.run_answers import PlanningReply, RunAnswers

Ask = Annotated[
    list[str] | None,
    typer.Option("--ask", help="A question about the run; may be given several times."),
]
Chat = Annotated[
    bool,
    typer.Option("--chat", help="Afterwards answer questions about the run from the input."),
]


@dataclass(frozen=True)
class Asked:
    """A question with its answer, or why there is none."""

    question: str
    reply: PlanningReply | None = None
    problem: QuestionError | None = None

    def to_dict(self) -> dict[str, Any]:
        """Return the answer as values that JSON can hold."""
        if self.reply is not None:
            return self.reply.to_dict()
        nearest = list(self.problem.nearest) if self.problem else []
        return {"question": self.question, "error": str(self.problem), "nearest": nearest}


def ask_all(answers: RunAnswers, questions: Sequence[str] | None) -> list[Asked]:
    """Answer every question; one that is not understood does not stop the others."""
    from seewhy.errors import QuestionError

    asked = []
    for question in questions or ():
        try:
            asked.append(Asked(question, reply=answers.answer(question)))
        except QuestionError as problem:
            asked.append(Asked(question, problem=problem))
    return asked


def show_answers(asked: Sequence[Asked]) -> None:
    """Print questions and answers for a person."""
    for answered in asked:
        say(f"\n{answered.question}")
        if answered.reply is not None:
            say(answered.reply.text)
        else:
            complain(str(answered.problem))


def talk(answers: RunAnswers, *, json: bool) -> None:
    """Answer questions from the input."""
    greeting = [f"  {question}" for question in answers.questions.examples()]
    greeting = ["Ask about the run, for instance:", *greeting, "An empty line ends."]
    converse(answers.answer, greeting=greeting, json=json)


def exit_if_not_understood(asked: Sequence[Asked]) -> None:
    """End with exit code 2 where a question was not understood."""
    if any(answered.problem is not None for answered in asked):
        raise typer.Exit(2)
