"""Evaluation: every figure of how an agent does on annotated pictures."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from seewhy.evaluation.axioms import AxiomRecord
from seewhy.evaluation.recognition import Recognition
from seewhy.evaluation.redeciding import Redecided
from seewhy.evaluation.wrong import WrongPicture
from seewhy.text.notebook import html_line, html_table

if TYPE_CHECKING:
    from seewhy.evaluation.curve import LearningCurve

__all__ = ["Evaluation"]


@dataclass(frozen=True)
class Evaluation:
    """Shares, each from 0 to 1, over the scenes of a dataset, and what they are made of.

    Attributes
    ----------
    scenes : int
        Those whose class is annotated.
    without_class : int
        Other pictures, of which only the features are judged.
    groups : int
        Groups that the scenes are of; pictures of one group show the same, or nearly.
    has_splits : bool
        Whether the dataset keeps pictures for evaluation; without that all were evaluated.
    seen_in_training : int
        Scenes whose picture the model was trained on; their results prove nothing.
    class_recognition : Recognition
        Accuracy of the class with its interval, the majority's, balanced, confusion, calibration.
    feature_recognition : dict
        Feature → the same of it, over the pictures in which somebody said what it is; a feature
        of which nobody did is left out.
    without : tuple of str
        Classes of which the model was shown no picture in training.
    unknown : float
        Share of the scenes of which the agent said that it does not know them.
    answer_accuracy : float
        The answer has the right form and mentions every relevant attribute with its value (the
        paper's measure).
    answer_accuracy_strict : float
        It mentions those and no other.
    explanation_accuracy, explanation_accuracy_strict : float
        The same over the questions that ask why, why not, what would have to change, and how a
        scene differs from a class.
    decided_by_knowledge : float
        Share of scenes that the knowledge decided.
    accuracy_by_method : dict
        "knowledge", "tree" and "none" → classification accuracy where that method was used.
    determined : float
        The share that the best classifier over the annotated features would get right.
    redecided : Redecided
        What reading each feature rightly would do to the classes.
    depended_on : dict
        Feature → whether some class depends on it, by the knowledge and the tree.
    asked_by_axioms : dict
        Feature → whether some axiom speaks about it.
    training_pictures : dict
        "class" and every feature → value → the number of pictures to train on that show it.
    wrong : tuple of WrongPicture
        All that were wrong, in the class or in a feature.
    axioms : tuple of AxiomRecord
    curve : LearningCurve or None
        Where one was asked for.
    """

    scenes: int
    without_class: int
    groups: int
    has_splits: bool
    seen_in_training: int
    class_recognition: Recognition
    feature_recognition: dict[str, Recognition]
    without: tuple[str, ...]
    unknown: float
    answer_accuracy: float
    answer_accuracy_strict: float
    explanation_accuracy: float
    explanation_accuracy_strict: float
    decided_by_knowledge: float
    accuracy_by_method: dict[str, float]
    determined: float
    redecided: Redecided
    depended_on: dict[str, bool]
    asked_by_axioms: dict[str, bool]
    training_pictures: dict[str, dict[str, int]]
    wrong: tuple[WrongPicture, ...]
    axioms: tuple[AxiomRecord, ...]
    curve: LearningCurve | None = None

    @property
    def classification_accuracy(self) -> float:
        """The share of the scenes that were classified rightly."""
        return self.class_recognition.confusion.share.value

    @property
    def class_accuracy(self) -> dict[str, float]:
        """Class → share of its scenes that were classified rightly, for the classes that occur."""
        recall = self.class_recognition.confusion.recall
        return {label: share.value for label, share in recall.items()}

    @property
    def feature_accuracy(self) -> dict[str, float]:
        """Feature → share of the pictures annotated with it in which it was recognised."""
        return {
            key: recognition.confusion.share.value
            for key, recognition in self.feature_recognition.items()
        }

    @property
    def training_notice(self) -> str | None:
        """That pictures were trained on, in words, if some were."""
        from seewhy.evaluation.advice import training_notice

        return training_notice(
            seen=self.seen_in_training, scenes=self.scenes, has_splits=self.has_splits
        )

    def advice(self) -> tuple[str, ...]:
        """Say in words what the figures suggest; see :func:`seewhy.evaluation.advice.advice`."""
        from seewhy.evaluation.advice import advice

        return advice(self)

    def _repr_html_(self) -> str:
        """What a notebook shows: each figure beside chance, and what the figures suggest."""
        rows = [
            (
                name,
                f"{100 * recognition.confusion.share.value:.1f} %",
                " to ".join(f"{100 * end:.1f} %" for end in recognition.confusion.share.interval),
                f"{100 * recognition.confusion.majority_share.value:.1f} %",
                str(recognition.confusion.share.of),
            )
            for name, recognition in (
                ("class", self.class_recognition),
                *self.feature_recognition.items(),
            )
        ]
        headings = ["", "right", "95 % interval", "always the most frequent", "pictures"]
        return html_table(headings, rows) + "".join(map(html_line, self.advice()))

    def to_dict(self) -> dict[str, Any]:
        """Return the evaluation as values that JSON can hold."""
        return {
            "scenes": self.scenes,
            "without_class": self.without_class,
            "groups": self.groups,
            "has_splits": self.has_splits,
            "seen_in_training": self.seen_in_training,
            "advice": list(self.advice()),
            "classification_accuracy": self.classification_accuracy,
            "class_accuracy": self.class_accuracy,
            "class_recognition": self.class_recognition.to_dict(),
            "without": list(self.without),
            "unknown": self.unknown,
            "answer_accuracy": self.answer_accuracy,
            "answer_accuracy_strict": self.answer_accuracy_strict,
            "explanation_accuracy": self.explanation_accuracy,
            "explanation_accuracy_strict": self.explanation_accuracy_strict,
            "feature_accuracy": self.feature_accuracy,
            "feature_recognition": {
                key: recognition.to_dict() for key, recognition in self.feature_recognition.items()
            },
            "decided_by_knowledge": self.decided_by_knowledge,
            "accuracy_by_method": dict(self.accuracy_by_method),
            "determined": self.determined,
            "redecided": self.redecided.to_dict(),
            "depended_on": dict(self.depended_on),
            "training_pictures": {key: dict(n) for key, n in self.training_pictures.items()},
            "wrong": [picture.to_dict() for picture in self.wrong],
            "axioms": [{**asdict(axiom), "accuracy": axiom.accuracy} for axiom in self.axioms],
            "curve": self.curve.to_dict() if self.curve else None,
        }
