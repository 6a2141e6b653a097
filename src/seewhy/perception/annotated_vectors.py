"""Which of the annotated feature vectors pictures may show, and how surely networks tell them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional

from seewhy.perception.labels import labelled

__all__ = ["UNKNOWN", "AnnotatedVectors", "ShownPictures", "codes_of"]

UNKNOWN = -1
VECTOR_SHARE = 0.7  # of the loss; the rest is that of the features each by itself

Codes = npt.NDArray[np.int64]


def codes_of(
    labels: Mapping[str, Sequence[str | None]],
    values: Mapping[str, Sequence[str]],
    names: Sequence[str],
) -> Codes:
    """The places of the values, shape (pictures, features); -1 where one is not known.

    Examples
    --------
    >>> codes_of({"light": ["on", None, "off"]}, {"light": ["on", "off"]}, ["light"]).tolist()
    [[0], [-1], [1]]
    """
    count = len(next(iter(labels.values())))
    codes = np.full((count, len(names)), UNKNOWN, dtype=np.int64)
    for column, name in enumerate(names):
        chosen, targets = labelled(labels[name], feature=name, values=values[name])
        codes[chosen, column] = targets
    return codes


class ShownPictures(NamedTuple):
    """Pictures on the device, the code of every feature's value, and the vectors they may be."""

    x: torch.Tensor
    codes: torch.Tensor
    fitting: torch.Tensor  # (pictures, vectors): annotated vectors that known values agree with

    def of(self, rows: torch.Tensor) -> ShownPictures:
        """Those at some places."""
        return ShownPictures(self.x[rows], self.codes[rows], self.fitting[rows])

    def joined(self, others: ShownPictures) -> ShownPictures:
        """These and others."""
        return ShownPictures(*map(torch.cat, zip(self, others, strict=True)))


@dataclass(frozen=True, eq=False)
class AnnotatedVectors:
    """The feature vectors that pictures were annotated with, a row each, as codes."""

    rows: Codes
    device: torch.device

    @classmethod
    def among(cls, codes: Codes, *, device: torch.device) -> AnnotatedVectors:
        """Those of pictures with all their values."""
        return cls(np.unique(codes[(codes != UNKNOWN).all(axis=1)], axis=0), device)

    def shown_by(self, pictures: npt.NDArray[np.uint8], codes: Codes) -> ShownPictures:
        """The pictures with the vectors that agree with what is known of them."""
        fitting = np.ones((len(codes), len(self.rows)), dtype=bool)
        for known, column in zip(codes.T, self.rows.T, strict=True):
            fitting &= (known[:, None] == column[None]) | (known[:, None] == UNKNOWN)
        return ShownPictures(
            torch.from_numpy(np.ascontiguousarray(pictures)).to(self.device),
            torch.from_numpy(codes).to(self.device),
            torch.from_numpy(fitting).to(self.device),
        )

    def logits(self, logits: Sequence[torch.Tensor]) -> torch.Tensor:
        """The logits of all vectors, shape (pictures, vectors), by those of the features."""
        joint = torch.zeros((len(logits[0]), len(self.rows)), device=self.device)
        columns = torch.from_numpy(self.rows).to(self.device)
        for of_feature, column in zip(logits, columns.T, strict=True):
            joint = joint + of_feature[:, column]
        return joint

    def loss(
        self,
        logits: Sequence[torch.Tensor],
        shown: ShownPictures,
        weights: Sequence[torch.Tensor],
    ) -> torch.Tensor:
        """That of the vectors among all, and, with a smaller share, of each feature by itself.

        ``weights`` are those of each feature's values.
        """
        joint = self.logits(logits)
        some = shown.fitting.any(dim=1)
        fitting = joint.masked_fill(~shown.fitting, -torch.inf)[some]
        vectors = torch.logsumexp(joint[some], dim=1) - torch.logsumexp(fitting, dim=1)
        together = vectors.sum() / len(shown.x)
        alone = sum(
            functional.cross_entropy(of_feature, codes, weight=weight, ignore_index=UNKNOWN)
            for of_feature, codes, weight in zip(logits, shown.codes.T, weights, strict=True)
            if (codes != UNKNOWN).any()
        )
        return VECTOR_SHARE * together + (1.0 - VECTOR_SHARE) * alone
