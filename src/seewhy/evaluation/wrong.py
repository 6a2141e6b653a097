"""The pictures that were taken for what they are not, and what was misread in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset
    from seewhy.dialogue.reply import Classification

__all__ = ["Misreading", "WrongPicture", "wrong_pictures"]


@dataclass(frozen=True)
class Misreading:
    """A feature that was seen as another value than it is annotated with, and how surely.

    ``overruled`` is what the network alone saw, with its probability, where that did not fit what
    is known; see :class:`~seewhy.dialogue.reply.FeatureReading`.
    """

    feature: str
    seen: str
    probability: float
    annotated: str
    overruled: tuple[str, float] | None = None


@dataclass(frozen=True)
class WrongPicture:
    """A picture whose class is wrong, or in which a feature was misread.

    Attributes
    ----------
    image : str
        As the dataset names it.
    picture : Path
        The file.
    label : str or None
        The annotated class, None where nobody said it.
    said : str or None
        The class that the agent said, None where it decided nothing.
    method, verdict : str
        As of :class:`~seewhy.dialogue.reply.Classification`.
    probability : float or None
        Of the class said.
    misread : tuple of Misreading
    not_annotated : tuple of str
        The features of which nobody said what they are.
    """

    image: str
    picture: Path
    label: str | None
    said: str | None
    method: str
    verdict: str
    probability: float | None
    misread: tuple[Misreading, ...]
    not_annotated: tuple[str, ...]

    @property
    def wrong_class(self) -> bool:
        """Whether the class is wrong, and not only a feature."""
        return self.label is not None and self.said != self.label

    def to_dict(self) -> dict[str, Any]:
        """Return what is wrong as values that JSON can hold."""
        return {
            "image": self.image,
            "class": self.label,
            "said": self.said,
            "method": self.method,
            "verdict": self.verdict,
            "probability": self.probability,
            "misread": [asdict(misreading) for misreading in self.misread],
            "not_annotated": list(self.not_annotated),
        }


def wrong_pictures(dataset: Dataset, found: Sequence[Classification]) -> tuple[WrongPicture, ...]:
    """Return the wrong pictures: those of a wrong class first, the surest mistakes before others.

    ``found`` has the classification of every picture of the dataset.
    """
    wrong = []
    for row, scene in zip(dataset.scenes, found, strict=True):
        annotated = dataset.domain.named(row.vector)
        misread = tuple(
            Misreading(key, reading.value, reading.probability, true, reading.overruled)
            for key, reading in scene.features.items()
            if (true := annotated[key]) is not None and true != reading.value
        )
        one = WrongPicture(
            dataset.name_of(row),
            row.picture,
            row.label,
            scene.label,
            scene.method,
            scene.verdict,
            scene.probability,
            misread,
            tuple(key for key, value in annotated.items() if value is None),
        )
        if one.wrong_class or misread:
            wrong.append(one)
    return tuple(sorted(wrong, key=_order))


def _order(wrong: WrongPicture) -> tuple[bool, float, float]:
    surest = max((misreading.probability for misreading in wrong.misread), default=0.0)
    return not wrong.wrong_class, -(wrong.probability or 0.0), -surest
