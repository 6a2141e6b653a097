"""How well one thing is recognised, the class or a feature, beside what chance would give."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from seewhy.evaluation.calibration import Calibration, calibration_of
from seewhy.evaluation.confusion import Confusion, confusion_of

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset
    from seewhy.dialogue.reply import Classification

__all__ = ["Recognition", "recognition_of", "recognition_of_class", "recognition_of_features"]


@dataclass(frozen=True)
class Recognition:
    """How well the class, or one feature, is recognised in the pictures annotated with it.

    Attributes
    ----------
    confusion : Confusion
        Which value was taken for which, and the accuracies: of the model, of always saying the
        most frequent value, balanced over the values.
    calibration : Calibration
        How sure the model was, and how often rightly.
    """

    confusion: Confusion
    calibration: Calibration

    def to_dict(self) -> dict[str, Any]:
        """Return the figures as values that JSON can hold."""
        confusion = self.confusion
        return {
            "pictures": confusion.share.of,
            "right": confusion.share.right,
            "accuracy": confusion.share.value,
            "interval": list(confusion.share.interval),
            "majority": confusion.majority,
            "majority_accuracy": confusion.majority_share.value,
            "balanced_accuracy": confusion.balanced_accuracy,
            "values": {
                value: {
                    "pictures": share.of,
                    "right": share.right,
                    "accuracy": share.value,
                    "interval": list(share.interval),
                }
                for value, share in confusion.recall.items()
            },
            "confusion": confusion.to_dict(),
            "calibration": self.calibration.to_dict(),
        }


def recognition_of(
    rows: Sequence[tuple[str, str | None, float | None]], *, order: Sequence[str]
) -> Recognition:
    """Compare what was annotated with what was said, and how surely.

    Parameters
    ----------
    rows : sequence of (str, str or None, float or None)
        For every picture the annotated value, the value said and its probability (0 to 1).
    order : sequence of str
        All values that there may be.

    Examples
    --------
    >>> found = recognition_of(
    ...     [("yes", "yes", 0.9), ("yes", "no", 0.6), ("no", "no", 0.9)], order=["yes", "no"]
    ... )
    >>> found.confusion.balanced_accuracy, round(found.calibration.said, 2)
    (0.75, 0.8)
    """
    return Recognition(
        confusion_of([(true, said) for true, said, _ in rows], order=order),
        calibration_of(
            [
                (probability, true == said)
                for true, said, probability in rows
                if probability is not None
            ]
        ),
    )


def recognition_of_class(dataset: Dataset, found: Sequence[Classification]) -> Recognition:
    """How well the class is recognised in the pictures of a dataset that have one.

    ``found`` has the classification of every picture. One without a probability (of a picture
    sent to the tree because a network was unsure) counts for the accuracy, not for the calibration.
    """
    return recognition_of(
        [
            (label, scene.label, scene.probability)
            for label, scene in zip(dataset.labels, found, strict=True)
            if label is not None
        ],
        order=list(dataset.domain.classes),
    )


def recognition_of_features(
    dataset: Dataset, found: Sequence[Classification]
) -> dict[str, Recognition]:
    """How well every feature is recognised that some picture of a dataset is annotated with."""
    features = {}
    for position, (key, feature) in enumerate(dataset.domain.features.items()):
        rows = [
            (value, scene.vector[position], scene.features[key].probability)
            for vector, scene in zip(dataset.vectors, found, strict=True)
            if (value := vector[position]) is not None
        ]
        if rows:
            features[key] = recognition_of(rows, order=feature.values)
    return features
