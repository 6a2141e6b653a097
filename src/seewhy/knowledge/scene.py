"""What a picture contributes to reasoning: the scene, its features, its possible classes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import key_of

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
        values of the feature are then believed false. What is seen of a thing is a feature, too,
        ``colour(thing1)`` for instance, and so is whether it is there.
    classes : mapping
        Class name → the literal that stands for it.
    change_costs : mapping
        Feature name → what it costs to change it (1 where left out).
    requires : mapping
        Feature name → the features that say whether the things are there that it is of. Where one
        of them is not there, its value is unknown. Left out for what is of the picture as a whole.
    presence : mapping
        Thing → the feature that says whether it is there, in the order in which things are found.
    """

    scene: str
    features: Mapping[str, Mapping[str, Literal]]
    classes: Mapping[str, Literal]
    change_costs: Mapping[str, int]
    requires: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    presence: Mapping[str, str] = field(default_factory=dict)

    def vector(self, values: Mapping[str, str | None]) -> FeatureVector:
        """Return the vector of named values: what is left out is unknown, or a thing not there."""
        return tuple(
            [values.get(feature, self._left_out.get(feature)) for feature in self.features]
        )

    @cached_property
    def _left_out(self) -> dict[str, str]:
        return dict.fromkeys(self.presence.values(), "no")

    def of_any_scene(self, literal: Literal, variable: str = "S") -> Literal:
        """Return a literal about the scene with a variable in its place.

        A value may be called like the scene: of an apple, "apple" is a kind, too.

        Examples
        --------
        >>> schema = SceneSchema("apple", {}, {}, {})
        >>> str(schema.of_any_scene(Literal("of_kind", ("apple", "apple"))))
        'of_kind(S, apple)'
        """
        arguments = list(literal.arguments)
        if self.scene in arguments:
            arguments[arguments.index(self.scene)] = variable
        return replace(literal, arguments=tuple(arguments))

    def shown(self, feature: str, value: str) -> Iterator[str]:
        """Yield the keys of what is believed for a value: its literal, and the others denied."""
        literals = self.features[feature]
        yield key_of(literals[value])
        if all(literal.positive for literal in literals.values()):
            for other, literal in literals.items():
                if other != value:
                    yield key_of(literal.complement)

    @cached_property
    def shown_by(self) -> dict[str, dict[str, tuple[str, ...]]]:
        """Key of a literal → feature → its values by which a picture shows the literal."""
        found: dict[str, dict[str, tuple[str, ...]]] = {}
        for feature, literals in self.features.items():
            for value in literals:
                for key in self.shown(feature, value):
                    by_feature = found.setdefault(key, {})
                    by_feature[feature] = (*by_feature.get(feature, ()), value)
        return found

    def feature_of(self, literal: Literal) -> str | None:
        """Return the feature that a literal speaks about, affirmed or denied."""
        lengths = self._subjects.get(literal.predicate)
        if lengths is None:
            return None
        length, by_subject = lengths
        return by_subject.get(literal.arguments[:length])

    @cached_property
    def _subjects(self) -> dict[str, tuple[int, dict[tuple[str, ...], str]]]:
        """Predicate → how many arguments are its subject, and subject → the feature."""
        found: dict[str, tuple[int, dict[tuple[str, ...], str]]] = {}
        for feature, literals in self.features.items():
            first = next(iter(literals.values()))
            # What denies another value has the same arguments; other values have another last one.
            length = len(first.arguments) - all(literal.positive for literal in literals.values())
            _, by_subject = found.setdefault(first.predicate, (length, {}))
            by_subject[first.arguments[:length]] = feature
        return found

    def class_of(self, literal: Literal) -> str | None:
        """Return the class that a literal stands for, if any."""
        return next(
            (name for name, class_literal in self.classes.items() if class_literal == literal), None
        )
