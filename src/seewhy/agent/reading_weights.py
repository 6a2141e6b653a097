"""How much what is seen counts in a consistent reading."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ReadingWeights:
    """How much what is seen counts in a consistent reading.

    Attributes
    ----------
    features : float
        The power to which the probabilities of features are raised: below 1 where features are
        misread together, so that their product says more than it knows.
    witness : float
        That of the class's, where it is seen by itself; 0 does not ask it.
    """

    features: float = 1.0
    witness: float = 1.0


UNWEIGHTED = ReadingWeights()
"""What is seen counts as it is."""
