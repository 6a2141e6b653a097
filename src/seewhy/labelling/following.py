"""Features that follow from the class of a picture: by a table, or by rules."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from itertools import product
from math import prod

from seewhy.data.importers.class_features import read_class_features
from seewhy.data.importers.writing import CLASSES
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.errors import SeeWhyError
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector

__all__ = ["Following"]

MOST_SCENES = 4096
"""Feature vectors that are looked at; where there are more, rules say nothing here."""

_POSSIBLE = (Verdict.BELIEVED, Verdict.SILENT)


class Following:
    """What follows in a domain from what is said of a picture.

    Parameters
    ----------
    domain : Domain
        Its folder's ``classes.csv`` is the table, where there is one.
    """

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self.reasoner = Reasoner(domain.knowledge, domain.schema)

    @cached_property
    def table(self) -> Mapping[str, Mapping[str, str]]:
        """Class → feature → value; empty where there is no table that fits the domain."""
        path = self.domain.folder / CLASSES
        if not path.is_file():
            return {}
        try:
            said = read_class_features(path, tuple(self.domain.classes))
        except SeeWhyError:
            return {}
        features = self.domain.features
        return {
            label: {
                feature: value
                for feature, value in values.items()
                if feature in features and value in features[feature].values
            }
            for label, values in said.values.items()
            if label in self.domain.classes
        }

    def features_of(self, said: Mapping[str, str]) -> dict[str, str]:
        """Return the features that follow from a picture's class and its other features.

        Parameters
        ----------
        said : mapping of str to str
            Feature, or ``class``, → value.

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> following = Following(load_domain("structure_stability"))
        >>> following.features_of({"class": "stable", "num_blocks": "2"})
        {'block_displaced': 'no'}
        """
        label = said.get(CLASS)
        if label is None:
            return {}
        by_table = self.table.get(label, {})
        found = {name: value for name, value in by_table.items() if name not in said}
        return found | {
            name: value
            for name, value in self._by_rules(label, {**found, **said}).items()
            if name not in found
        }

    def _by_rules(self, label: str, said: Mapping[str, str]) -> dict[str, str]:
        """Values that all scenes share which are possible with the class and what is said."""
        open_features = [name for name in self.domain.features if name not in said]
        possible = self._possible.get(label)
        if not open_features or possible is None:
            return {}
        places = {name: place for place, name in enumerate(self.domain.features)}
        fitting = [
            vector
            for vector in possible
            if all(vector[places[name]] == said[name] for name in places if name in said)
        ]
        found = {}
        for name in open_features:
            values = {vector[places[name]] for vector in fitting}
            if len(values) == 1 and (value := values.pop()) is not None:
                found[name] = value
        return found

    @cached_property
    def _possible(self) -> Mapping[str, tuple[FeatureVector, ...]]:
        """Class → vectors that can be of it: decided so, or left open by the knowledge."""
        if self.domain.things is not None:
            return {}  # the class rests on things, too, of which nothing is said here
        values = [feature.values for feature in self.domain.features.values()]
        if prod(map(len, values)) > MOST_SCENES:
            return {}
        vectors: list[FeatureVector] = list(product(*values))
        try:
            decisions = self.reasoner.decide_all(vectors)
        except SeeWhyError:
            return {}
        found: dict[str, list[FeatureVector]] = {label: [] for label in self.domain.classes}
        for vector, decision in zip(vectors, decisions, strict=True):
            if decision.verdict not in _POSSIBLE:
                continue
            for label in (decision.label,) if decision.label is not None else tuple(found):
                found[label].append(vector)
        return {label: tuple(fitting) for label, fitting in found.items()}

    def class_of(self, said: Mapping[str, str]) -> str | None:
        """The class that the rules conclude from features that are all known; None else."""
        vector = self.domain.vector(said)
        if None in vector:
            return None
        return self.reasoner.decide(vector).label
