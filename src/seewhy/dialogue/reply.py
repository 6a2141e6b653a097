"""What an agent answers: text, class, method, features and justification."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.certainty import Certainty, Ground, certainty_of, says_nothing_seen
from seewhy.dialogue.question import Question
from seewhy.knowledge.justification import Node
from seewhy.knowledge.scene import FeatureVector
from seewhy.text.notebook import html_line, html_table

UNCERTAIN = "uncertain"
"""The verdict where a network is less sure than the agent's gate."""

UNKNOWN = "unknown"
"""The verdict where the picture is unlike those that are known."""


@dataclass(frozen=True)
class FeatureReading:
    """What a feature of a picture is taken to be.

    Attributes
    ----------
    value : str
    probability : float
        The network's probability of the value (0 to 1).
    overruled : (str, float) or None
        The more probable value that the network alone saw, with its probability, where it does
        not fit what is known (see :class:`~seewhy.agent.consistent_reading.ConsistentReading`).
    """

    value: str
    probability: float
    overruled: tuple[str, float] | None = None

    @property
    def certainty(self) -> float:
        """The probability of the value that the network alone saw."""
        return self.overruled[1] if self.overruled else self.probability


@dataclass(frozen=True)
class Classification:
    """How a scene was classified.

    Attributes
    ----------
    label : str or None
        The class, or None where neither the knowledge nor a tree decides, or where the picture
        is not known.
    method : str
        "knowledge", "tree" or "none".
    vector : FeatureVector
    features : mapping
        Feature name → FeatureReading.
    verdict : str
        Why the knowledge decides, or does not ("silent", "contradiction", …); "uncertain" where
        it was not asked because a network was less sure than the agent's gate, "unknown" where
        the picture is unlike those that are known.
    probability : float or None
        Of the class, see :class:`~seewhy.agent.picture_reading.Reading`; None where there is
        none, or where an
        uncertain reading was sent to the tree.
    score : float or None
        How like the picture is to those of training, 0 to 1 (see
        :class:`~seewhy.perception.familiarity.Familiarity`), compared with
        :attr:`seewhy.Agent.unknown_below`; where the agent answers every picture because it was
        trained to, the log-probability of what is read.
    class_seen : (str, float) or None
        The most probable class that a network of its own saw, and its probability, where such a
        network has a say in the reading.
    otherwise : tuple of Classification
        What the scene may be as well, the most probable class first: those of which an asker is
        believed who presumes them (see :class:`seewhy.Agent`, ``trust``).
    told : bool
        Whether its features were named by somebody instead of seen.
    """

    label: str | None
    method: str
    vector: FeatureVector
    features: dict[str, FeatureReading]
    verdict: str
    probability: float | None = None
    score: float | None = None
    class_seen: tuple[str, float] | None = None
    otherwise: tuple[Classification, ...] = ()
    told: bool = False

    @property
    def least_certain(self) -> str:
        """The feature of which its network is least sure."""
        return min(self.features, key=lambda key: self.features[key].certainty)

    def read_in(self, justification: Node) -> Node:
        """Return a justification that says how surely each feature was read, unless it was told."""
        if self.told:
            return justification
        return justification.with_probabilities(
            {key: (reading.value, reading.probability) for key, reading in self.features.items()},
            {key: reading.overruled for key, reading in self.features.items() if reading.overruled},
        )


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
    supposed : Classification or None
        What the answer supposes the picture to be, where that is not what it is taken to be but
        what the question presumes.
    least_sure : Ground or None
        The least sure of what the answer rests on; None where that is nothing uncertain.
    """

    question: Question
    text: str
    method: str
    justification: Node
    kind: AnswerType
    classification: Classification = field(repr=False)
    supposed: Classification | None = field(default=None, repr=False)
    least_sure: Ground | None = field(default=None, repr=False)

    @property
    def label(self) -> str | None:
        """The picture's class."""
        return self.classification.label

    @property
    def certainty(self) -> Certainty | None:
        """How surely the answer is said; None where it says nothing that is seen."""
        return None if says_nothing_seen(self.kind) else certainty_of(self.least_sure)

    @property
    def scene(self) -> Classification:
        """What the answer speaks of: what is supposed, or else what the picture is taken to be."""
        return self.supposed or self.classification

    @property
    def features(self) -> dict[str, FeatureReading]:
        """Feature name → value and probability, of what the answer speaks of."""
        return self.scene.features

    def _repr_html_(self) -> str:
        """What a notebook shows: the answer, its reasons, and what was seen."""
        seen = html_table(
            ["feature", "value", "probability"],
            (
                (name, reading.value, f"{reading.probability:.2f}")
                for name, reading in self.features.items()
            ),
        )
        lines = (f"{self.question.text}?", self.text, f"by: {self.method}")
        return "".join(map(html_line, lines)) + self.justification._repr_html_() + seen

    def to_dict(self) -> dict[str, Any]:
        """Return the reply as values that JSON can hold."""
        return {
            "question": self.question.text + "?",
            "text": self.text,
            "class": self.label,
            "method": self.method,
            "class_probability": _rounded(self.classification.probability),
            "class_seen": None
            if self.classification.class_seen is None
            else {
                "class": self.classification.class_seen[0],
                "probability": _rounded(self.classification.class_seen[1]),
            },
            "supposed": None
            if self.supposed is None
            else {
                "class": self.supposed.label,
                "probability": _rounded(self.supposed.probability),
            },
            "certainty": None if self.certainty is None else self.certainty.value,
            "least_sure": None if self.least_sure is None else self.least_sure.to_dict(),
            "verdict": self.scene.verdict,
            "features": {
                name: {
                    "value": reading.value,
                    "probability": _rounded(reading.probability),
                    "overruled": None
                    if reading.overruled is None
                    else {
                        "value": reading.overruled[0],
                        "probability": _rounded(reading.overruled[1]),
                    },
                }
                for name, reading in self.features.items()
            },
            "justification": self.justification.to_dict(),
        }


def _rounded(probability: float | None) -> float | None:
    return None if probability is None else round(probability, 4)
