"""What a picture contributes to reasoning: the scene, its features, its possible classes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from seewhy.knowledge.axiom import Literal

FeatureVector = tuple[str | None, ...]
"""One value per feature in the order of the schema; None where the value is unknown."""


@dataclass(frozen=True)
class SceneSchema:
    """The link between a picture's feature vector and the literals of the knowledge.

    Attributes
    ----------
    scene : str
        The sort that stands for the picture; also the term that names the picture.
    features : mapping
        Feature name → value → the literal that is believed when that value is seen. The other
        values of the feature are then believed false.
    classes : mapping
        Class name → the literal that stands for it.
    change_costs : mapping
        Feature name → what it costs to change it (1 where left out).
    """

    scene: str
    features: Mapping[str, Mapping[str, Literal]]
    classes: Mapping[str, Literal]
    change_costs: Mapping[str, int]

    def feature_of(self, literal: Literal) -> str | None:
        """Return the feature that a literal speaks about, affirmed or denied."""
        if literal.predicate in self.features and self.scene in literal.arguments[:1]:
            return literal.predicate
        return None

    def class_of(self, literal: Literal) -> str | None:
        """Return the class that a literal stands for, if any."""
        return next(
            (name for name, class_literal in self.classes.items() if class_literal == literal), None
        )
