"""What training needs of a dataset: at least two classes, and a value of every feature."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from seewhy.errors import DatasetError

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset


def require_two_classes(dataset: Dataset) -> None:
    """Raise a DatasetError if the scenes do not show what tells classes apart.

    There must be two classes, and one of them must have two pictures of different groups, or
    there would be nothing to validate with.
    """
    counts = Counter(label for label in dataset.labels if label is not None)
    if not counts:
        raise DatasetError(
            f"{dataset.table.name}: no row has a class; fill the column 'class' of pictures of "
            "at least two classes, a few dozen of each if you can"
        )
    if len(counts) < 2:
        one, number = counts.total() == 1, f"{counts.total():,}"
        rows = "the only row" if one else f"all {number} rows"
        have = "" if counts.total() == len(dataset) else f" that {'has' if one else 'have'} a class"
        raise DatasetError(
            f"{dataset.table.name}: {rows}{have} {'is' if one else 'are'} of class "
            f"'{next(iter(counts))}'; training needs scenes of at least two classes"
        )
    groups: dict[str | None, set[str]] = {}
    for scene, group in zip(dataset.scenes, dataset.groups, strict=True):
        groups.setdefault(scene.label, set()).add(group)
    groups.pop(None, None)
    if all(len(those) < 2 for those in groups.values()):
        only = "one picture" if max(counts.values()) < 2 else "pictures of one group"
        raise DatasetError(
            f"{dataset.table.name}: every class has {only} only; training needs several of each "
            "that show different things, a few dozen if you can"
        )


def require_feature_labels(dataset: Dataset) -> None:
    """Raise a DatasetError if there is a feature of which no scene has a value."""
    for position, key in enumerate(dataset.domain.features):
        if all(scene.vector[position] is None for scene in dataset.scenes):
            raise DatasetError(
                f"{dataset.table.name}: no row has a value of '{key}', which training needs; "
                f"fill the column '{key}', or remove the feature from the domain"
            )
