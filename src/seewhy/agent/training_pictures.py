"""Which pictures an agent was trained on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from seewhy.data.dataset import Dataset
from seewhy.data.training_needs import require_feature_labels, require_two_classes
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError

__all__ = ["TrainingPictures", "require_same_domain", "scenes_to_train_on"]


@dataclass(frozen=True)
class TrainingPictures:
    """Which pictures an agent was trained on.

    Attributes
    ----------
    trained_on : frozenset of str
        Their digests.
    without_class : frozenset of str
        Those of them that had no class, so that what is remembered does not count them.
    without : tuple of str
        The classes of which there were none on purpose.
    """

    trained_on: frozenset[str] = frozenset()
    without_class: frozenset[str] = frozenset()
    without: tuple[str, ...] = ()

    @staticmethod
    def of(scenes: Dataset, without: Sequence[str]) -> TrainingPictures:
        """The pictures of scenes of which the classes ``without`` were left out."""
        shown = frozenset(scenes.picture_digests())
        classed = frozenset(scenes.with_class().picture_digests())
        return TrainingPictures(shown, shown - classed, tuple(dict.fromkeys(without)))

    @property
    def counted(self) -> frozenset[str]:
        """Those that what is remembered counts."""
        return self.trained_on - self.without_class

    def and_classes_of(self, dataset: Dataset) -> TrainingPictures:
        """These and those of a dataset to train on, of which the classes are remembered."""
        learned_from = frozenset(dataset.of_split("train").with_class().picture_digests())
        return replace(
            self,
            trained_on=self.trained_on | learned_from,
            without_class=self.without_class - learned_from,
        )


def scenes_to_train_on(dataset: Dataset, domain: Domain, *, without: Sequence[str]) -> Dataset:
    """Return the annotated scenes of a dataset that are to train on, but for some classes.

    Raises
    ------
    DatasetError
        If the dataset is of another domain or of one class only, if no picture has a value of
        some feature, or if a class to leave out is none of the domain's.
    """
    require_same_domain(dataset, domain)
    if domain.things is not None:
        raise DatasetError(
            f"{dataset.folder}: the domain '{domain.name}' has several things in a picture, which "
            "an Agent does not see; train a seewhy.ThingAgent ('seewhy train' does)"
        )
    scenes = dataset.of_split("train").without_classes(without)
    require_two_classes(scenes)
    require_feature_labels(scenes)
    return scenes.annotated()


def require_same_domain(dataset: Dataset, domain: Domain) -> None:
    """Raise a DatasetError if a dataset is of another domain."""
    if dataset.domain.name != domain.name:
        raise DatasetError(
            f"{dataset.folder}: the dataset is of the domain '{dataset.domain.name}', the "
            f"agent of '{domain.name}'; load it with the agent's domain"
        )
