"""What sees pictures, and what is known of it from training."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from seewhy.agent.picture_reading import Reading
from seewhy.agent.reading_weights import ReadingWeights
from seewhy.domain.reading_rule import ReadingRule
from seewhy.domain.tables import CLASS
from seewhy.errors import DatasetError, NotFittedError
from seewhy.perception.conformal_threshold import refusal_threshold

if TYPE_CHECKING:
    from pathlib import Path

    from PIL import Image

    from seewhy.dialogue.reply import Classification
    from seewhy.perception.extractor import FeatureExtractor, Seen
    from seewhy.perception.eyes import Eyes
    from seewhy.perception.familiarity import Familiarity, NearPicture
    from seewhy.perception.where import Where

    Picture = Path | str | Image.Image | np.ndarray[Any, Any]

__all__ = ["Looking", "Pictures", "Seeing", "likeness"]

Pictures = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Seeing:
    """What sees pictures, and what is known of it from training.

    Attributes
    ----------
    extractor : FeatureExtractor, Eyes or None
        None before training.
    familiarity : Familiarity or None
        What is made of training pictures; None where no picture is to be refused.
    validation_scores : mapping
        Way of reading → how like those of training the pictures kept for validation are.
    reading_weights : mapping
        Way of reading → how much what is seen counts in it.
    """

    extractor: FeatureExtractor | Eyes | None = None
    familiarity: Familiarity | None = None
    validation_scores: Mapping[ReadingRule, list[float]] = field(default_factory=dict)
    reading_weights: Mapping[ReadingRule, ReadingWeights] = field(default_factory=dict)

    @property
    def trained(self) -> FeatureExtractor | Eyes:
        """What sees; see :meth:`require_trained`."""
        self.require_trained()
        assert self.extractor is not None
        return self.extractor

    def require_trained(self) -> None:
        """Raise a NotFittedError if nothing sees yet."""
        if self.extractor is None:
            raise NotFittedError("the agent is not trained yet; call fit, or load a model")

    def witnessed(self) -> frozenset[str]:
        """The classes that the network of the class was shown.

        Raises
        ------
        NotFittedError
            If there is none.
        """
        found = self.extractor.shown(CLASS) if self.extractor else frozenset()
        if not found:
            raise NotFittedError(
                "pictures are to be read with the class, but no network sees it; train with "
                "reading='with_class', or read in another way"
            )
        return found

    def only_shown(self, features: Iterable[str]) -> dict[str, str]:
        """Of features of which training pictures showed one value only, that value."""
        if self.extractor is None:
            return {}
        shown = {key: self.extractor.shown(key) for key in features}
        return {key: next(iter(values)) for key, values in shown.items() if len(values) == 1}

    def unknown_below(self, rule: ReadingRule, known_share: float) -> float | None:
        """The score below which a picture is not known; None where every one is answered."""
        return refusal_threshold(self.validation_scores.get(rule, []), known_share=known_share)

    def nearest(self, picture: Pictures, *, count: int) -> tuple[NearPicture, ...]:
        """The pictures of training that are most like one, the most alike first.

        None where networks grew on the domain's pictures alone: each makes something of its own of
        a picture.

        Raises
        ------
        NotFittedError, DatasetError
            If nothing sees yet; if ``count`` is below 1.
        """
        from seewhy.perception.eyes import SCENE

        if count < 1:
            raise DatasetError(f"count: at least 1 picture has to be asked for, got {count}")
        extractor = self.trained
        known = self.familiarity.known.get(SCENE) if self.familiarity else None
        if known is None or not known.pictures:
            return ()
        return known.nearest(extractor.see(picture).embeddings[SCENE][0], count=count)

    def where(self, picture: Pictures, scene: Classification) -> dict[str, Where]:
        """Where in a picture each feature is seen, and the class where that has a say."""
        from seewhy.perception.where import find_where

        values = {name: reading.value for name, reading in scene.features.items()}
        if scene.class_seen is not None:
            values[CLASS] = scene.class_seen[0]
        return find_where(self.trained, picture, values)


@dataclass(frozen=True)
class Looking:
    """A picture that can be looked at again; a :class:`seewhy.dialogue.telling.Look`."""

    where: Callable[[], Mapping[str, Where]]
    nearest: Callable[[], Sequence[NearPicture]]


def likeness(
    familiarity: Familiarity, seen: Seen, readings: Sequence[Reading], *, features: Iterable[str]
) -> list[float]:
    """How like pictures are to those of training that show the values read.

    Parameters
    ----------
    familiarity : Familiarity
    seen : Seen
    readings : sequence of Reading
        One a picture.
    features : iterable of str
        Those of the domain; of what else is known, like the scene as a whole, no value is read.
    """
    read = set(features)
    values = {
        key: [reading.features[key].value for reading in readings]
        if key in read
        else [key] * len(readings)
        for key in familiarity.known
    }
    embeddings = {key: seen.embeddings[key] for key in values}
    return [float(score) for score in familiarity.likeness(embeddings, values)]
