"""Whether what is said with a probability is right as often as that."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from seewhy.evaluation.share import Share

__all__ = ["Calibration", "CalibrationBin", "calibration_of"]

BINS = 10


@dataclass(frozen=True)
class CalibrationBin:
    """The pictures of which something was said with a probability above ``low``, up to ``high``.

    ``said`` is the mean of those probabilities, ``right`` the number that were right.
    """

    low: float
    high: float
    pictures: int
    said: float
    right: int


@dataclass(frozen=True)
class Calibration:
    """How probabilities compare with the share that is right.

    Attributes
    ----------
    share : Share
        How many were right, of those that were said with a probability.
    said : float
        The mean of the probabilities.
    error : float
        The expected calibration error (Naeini and others 2015): the distance between the mean
        probability and the share that is right in each of ten intervals of probability, weighted
        by the pictures in it. Of few pictures it is above 0 by chance alone.
    bins : tuple of CalibrationBin
        The intervals that have pictures.
    """

    share: Share
    said: float
    error: float
    bins: tuple[CalibrationBin, ...]

    @property
    def off_by_chance(self) -> bool:
        """Whether the mean probability lies within the interval of the share that is right."""
        low, high = self.share.interval
        return not self.share.of or low <= self.said <= high

    def to_dict(self) -> dict[str, Any]:
        """Return the figures as values that JSON can hold."""
        return {
            "pictures": self.share.of,
            "said": self.said,
            "right": self.share.value,
            "error": self.error,
            "bins": [asdict(some) for some in self.bins],
        }


def calibration_of(said: Sequence[tuple[float, bool]]) -> Calibration:
    """Compare probabilities (0 to 1) with whether what was said with them is right.

    Examples
    --------
    >>> found = calibration_of([(0.95, True), (0.95, True), (0.95, False), (0.55, True)])
    >>> round(found.said, 2), found.share.value, round(found.error, 3)
    (0.85, 0.75, 0.325)
    >>> [(some.low, some.pictures, some.right) for some in found.bins]
    [(0.5, 1, 1), (0.9, 3, 2)]
    """
    if not said:
        return Calibration(Share(0, 0), 0.0, 0.0, ())
    probabilities = np.array([probability for probability, _ in said])
    right = np.array([was_right for _, was_right in said])
    # The intervals are open below; rounding must not lift a probability of 0.7 above its own.
    place = np.clip(np.ceil(probabilities * BINS - 1e-9).astype(int) - 1, 0, BINS - 1)
    bins = [
        CalibrationBin(
            number / BINS,
            (number + 1) / BINS,
            int((place == number).sum()),
            float(probabilities[place == number].mean()),
            int(right[place == number].sum()),
        )
        for number in sorted(set(place.tolist()))
    ]
    apart = sum(abs(some.said * some.pictures - some.right) for some in bins)
    share = Share(int(right.sum()), len(said))
    return Calibration(share, float(probabilities.mean()), apart / len(said), tuple(bins))
