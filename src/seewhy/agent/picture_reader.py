"""What the features of pictures are read as, in the way that is asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seewhy.agent.class_shares import with_class_shares
from seewhy.agent.consistent_reading import ConsistentReading, open_vectors
from seewhy.agent.deciding import Deciding
from seewhy.agent.picture_reading import Reading, read_separately
from seewhy.agent.reading_weights import UNWEIGHTED
from seewhy.agent.seeing import Pictures, Seeing, likeness
from seewhy.domain.reading_rule import ReadingRule

if TYPE_CHECKING:
    from seewhy.perception.extractor import Seen

__all__ = ["PictureReader"]

Probabilities = Mapping[str, NDArray[np.float64]]


@dataclass(frozen=True)
class PictureReader:
    """Reads pictures in any of the ways that there are.

    Two are equal that read by the same parts: candidates that one has listed are the other's.

    Attributes
    ----------
    deciding : Deciding
        Of which class a feature vector is.
    seeing : Seeing
        What sees the pictures.
    other_from : float
        How probable another class has to be for a reading to name it.
    """

    deciding: Deciding
    seeing: Seeing
    other_from: float
    _readers: dict[ReadingRule, ConsistentReading] = field(
        default_factory=dict, init=False, compare=False
    )

    def read_pictures(self, pictures: Pictures, rule: ReadingRule) -> list[Reading]:
        """Return what the features of pictures are taken to be."""
        return self.read(self.seeing.trained.probabilities(pictures), rule)

    def read_and_score(
        self, seen: Seen, rule: ReadingRule
    ) -> tuple[list[Reading], Sequence[float]]:
        """Return what the features of pictures are taken to be, and how like training's they are.

        Where every picture is answered, the score is how well a picture fits what is read.
        """
        readings = self.read(seen.probabilities, rule)
        if self.seeing.familiarity is None:
            return readings, [reading.score for reading in readings]
        features = self.deciding.known.domain.features
        return readings, likeness(self.seeing.familiarity, seen, readings, features=features)

    def read(self, probabilities: Probabilities, rule: ReadingRule) -> list[Reading]:
        """Return what the features of pictures are taken to be, from what networks make of them."""
        if rule != "argmax":
            return self.consistent(rule).read(probabilities)
        schema = self.deciding.known.reasoner.schema
        return with_class_shares(
            read_separately(schema, probabilities),
            schema,
            probabilities,
            shares_of_all=self.deciding.class_shares_of_all,
            label_of=self.deciding.label_of,
            other_from=self.other_from,
        )

    def consistent(self, rule: ReadingRule) -> ConsistentReading:
        """The consistent reading, of which the candidates are listed once."""
        if rule not in self._readers:
            known, weights = self.deciding.known, self.seeing.reading_weights
            with_class = rule == "with_class"
            self._readers[rule] = ConsistentReading(
                known.reasoner,
                open_vectors(known.reasoner, known.experience),
                label_of=self.deciding.label_of,
                shares_of=self.deciding.class_shares,
                other_from=self.other_from,
                witnessed=self.seeing.witnessed() if with_class else (),
                weights=weights.get(rule, UNWEIGHTED),
                outweighs=with_class and rule in weights,
            )
        return self._readers[rule]
