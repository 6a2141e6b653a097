"""What the server answers about a picture: what the command line answers, as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from seewhy.classification.pictures import ClassifiedPicture
from seewhy.classification.rows import Column, row_of
from seewhy.dialogue.question import Asks, Question
from seewhy.dialogue.reply import Classification
from seewhy.domain.assignments import named_values
from seewhy.perception.picture import Picture

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from seewhy.agent.agent import Agent

__all__ = ["Seen", "answered", "classified", "explained", "supposed"]


@dataclass(frozen=True, eq=False)
class Seen:
    """A picture that was looked at.

    Attributes
    ----------
    pixels : ndarray of uint8, shape (size, size, 3)
    scene : Classification
    reasons : str
        Why it is of its class, or has none; empty where nobody asked.
    """

    pixels: Picture = field(repr=False)
    scene: Classification
    reasons: str = ""


def answered(agent: Agent, seen: Seen, question: str) -> dict[str, Any]:
    """Return the answer to a question, as ``seewhy ask --json`` prints it.

    Raises
    ------
    QuestionError
        If the question is not understood.
    """
    asked = agent.questions.understand(question)
    reply = agent.answer(seen.scene, asked, image=seen.pixels)
    near = agent.nearest(seen.pixels)
    return {**reply.to_dict(), "nearest": [picture.to_dict() for picture in near]}


def classified(
    agent: Agent, seen: Seen, name: Path, *, columns: Sequence[Column]
) -> dict[str, Any]:
    """Return the row of ``seewhy classify`` for a picture, column → cell.

    Parameters
    ----------
    agent : Agent
    seen : Seen
    name : Path
    columns : sequence of Column
        Those of the agent's domain.
    """
    cells = row_of(ClassifiedPicture(name, seen.scene, seen.reasons), agent.domain)
    return {column.name: cell for column, cell in zip(columns, cells, strict=True)}


def explained(agent: Agent, seen: Seen) -> dict[str, Any]:
    """Return why a picture is of its class: a sentence, a tree, and as lines of text."""
    reply = agent.answer(seen.scene, Question(Asks.CLASS, "what is it", ()), image=seen.pixels)
    told = reply.to_dict()
    return {
        **{key: told[key] for key in ("class", "class_probability", "method", "verdict")},
        "features": told["features"],
        "reasons": seen.reasons,
        "justification": told["justification"],
        "lines": reply.justification.to_text().splitlines(),
    }


def supposed(agent: Agent, seen: Seen, changes: Sequence[str]) -> dict[str, Any]:
    """Return the class and its reasons if a picture showed other values.

    Parameters
    ----------
    agent : Agent
    seen : Seen
    changes : sequence of str
        Such as ``base=wide``.

    Raises
    ------
    DomainError
        If a change names no feature, or no value of it.
    """
    before: Mapping[str, str | None] = agent.domain.named(seen.scene.vector)
    given = named_values(agent.domain, changes)
    values = {key: value for key, value in {**before, **given}.items() if value is not None}
    scene = agent.classify_values(values)
    reply = agent.answer(scene, Question(Asks.CLASS, "what is it", ()))
    return {
        "class": seen.scene.label,
        "then": scene.label,
        "changes": given,
        "features": values,
        "verdict": scene.verdict,
        "justification": reply.justification.to_dict(),
        "lines": reply.justification.to_text().splitlines(),
    }
