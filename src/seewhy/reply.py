"""What an agent answers: text, class, method, features and justification."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Question
from seewhy.knowledge.justification import Node
from seewhy.knowledge.scene import FeatureVector


@dataclass(frozen=True)
class FeatureReading:
    """A feature's most probable value in a picture and its probability (0 to 1)."""

    value: str
    probability: float


@dataclass(frozen=True)
class Classification:
    """How a scene was classified.

    Attributes
    ----------
    label : str or None
        The class, or None where neither the knowledge nor a tree decides.
    method : str
        "knowledge", "tree" or "none".
    vector : FeatureVector
    features : mapping
        Feature name → FeatureReading.
    verdict : str
        Why the knowledge decides, or does not ("silent", "contradiction", …).
    """

    label: str | None
    method: str
    vector: FeatureVector
    features: dict[str, FeatureReading]
    verdict: str


@dataclass(frozen=True)
class Reply:
    """An answer with everything it rests on.

    Attributes
    ----------
    question : Question
        The question as it was understood.
    text : str
        The answer as a sentence.
    method : str
        "knowledge", or "tree" where the decision tree classified the picture and the recurrent
        network chose the answer; "none" where nothing decides.
    justification : Node
    kind : AnswerType
        What the answer says, apart from the wording.
    classification : Classification
    """

    question: Question
    text: str
    method: str
    justification: Node
    kind: AnswerType
    classification: Classification = field(repr=False)

    @property
    def label(self) -> str | None:
        """The picture's class."""
        return self.classification.label

    @property
    def features(self) -> dict[str, FeatureReading]:
        """Feature name → value and probability."""
        return self.classification.features

    def to_dict(self) -> dict[str, Any]:
        """Return the reply as values that JSON can hold."""
        return {
            "question": self.question.text + "?",
            "text": self.text,
            "class": self.label,
            "method": self.method,
            "verdict": self.classification.verdict,
            "features": {
                name: {"value": own.value, "probability": round(own.probability, 4)}
                for name, own in self.features.items()
            },
            "justification": self.justification.to_dict(),
        }
