"""An answer that no template words."""

from __future__ import annotations

from dataclasses import dataclass

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.certainty import Ground
from seewhy.knowledge.justification import Node

__all__ = ["Told"]


@dataclass(frozen=True)
class Told:
    """An answer that no template words, with what it rests on.

    ``least_sure`` is the least sure of that, where it is uncertain.
    """

    kind: AnswerType
    text: str
    justification: Node
    least_sure: Ground | None = None
