"""Pictures with what networks are to see in them."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

__all__ = ["LabelledPictures"]


@dataclass(frozen=True, eq=False)
class LabelledPictures:
    """Pictures with what networks are to see in them, all in the memory.

    Attributes
    ----------
    pixels : ndarray of uint8, shape (n, size, size, 3)
        As :func:`seewhy.perception.picture.as_picture` makes them.
    labels : mapping of str to sequence of str or None, length n
        Each feature's value in each picture; None where it is unknown.
    values : mapping of str to sequence of str
        All values that each feature can have, in the order of a network's logits.
    groups : sequence, length n, or None
        Pictures of one group (of one scene, say) are never divided between training and
        validation; None: every picture is a group.
    validation : ndarray of int64 or None
        Indices of the pictures to validate every feature on; None: each draws its own.
    """

    pixels: npt.NDArray[np.uint8]
    labels: Mapping[str, Sequence[str | None]]
    values: Mapping[str, Sequence[str]]
    groups: Sequence[object] | None = None
    validation: npt.NDArray[np.int64] | None = None

    def __len__(self) -> int:
        return len(self.pixels)

    def of_features(self, names: Collection[str]) -> LabelledPictures:
        """The same pictures with what is to be seen of some features."""
        labels = {name: column for name, column in self.labels.items() if name in names}
        return replace(self, labels=labels)
