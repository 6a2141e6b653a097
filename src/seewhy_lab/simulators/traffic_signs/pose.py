"""How a sign stands to the camera, and which part of the picture is cut out around it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Crop", "Pose", "crop_around", "random_pose"]

Points = NDArray[np.float64]


@dataclass(frozen=True)
class Pose:
    """A homography from the plane of a sign to the plane of the picture.

    Attributes
    ----------
    matrix : ndarray of shape (3, 3)
    """

    matrix: NDArray[np.float64]

    def project(self, points: Points) -> Points:
        """Return where points of the sign, shape (n, 2), lie in the picture.

        Examples
        --------
        >>> Pose(np.eye(3)).project(np.array([[0.5, 0.25]])).tolist()
        [[0.5, 0.25]]
        """
        seen = points @ self.matrix[:, :2].T + self.matrix[:, 2]
        projected: Points = seen[:, :2] / seen[:, 2:]
        return projected


@dataclass(frozen=True)
class Crop:
    """The part of the picture plane that is kept: its upper left corner, width and height."""

    left: float
    top: float
    width: float
    height: float


def random_pose(rng: np.random.Generator) -> Pose:
    """Return how a sign beside a road is seen: mostly from the front, sometimes along the road."""
    # The proportions of cut-out photographs say how far signs are turned: half of them by less
    # than 16 degrees, one in ten by more than 50, hardly any by more than 65.
    yaw = math.radians(66.0 * rng.random() ** 2) * rng.choice([-1.0, 1.0])
    pitch = math.radians(rng.normal(4.0, 9.0))
    roll = math.radians(rng.normal(0.0, 3.0 if rng.random() < 0.85 else 9.0))
    distance = rng.uniform(3.0, 14.0)
    rotation = _about("z", roll) @ _about("x", pitch) @ _about("y", yaw)
    matrix = rotation[:, [0, 1, 2]].copy()
    matrix[:, 2] = (0.0, 0.0, distance)
    matrix[2] /= distance
    return Pose(matrix)


def crop_around(outline: Points, rng: np.random.Generator) -> Crop:
    """Return what is cut out around a projected sign: its bounding box and a margin."""
    low, high = outline.min(axis=0), outline.max(axis=0)
    width, height = high - low
    if rng.random() < 0.75:
        left, top, right, bottom = 0.09 + rng.exponential(0.02, 4)
    else:
        left, top, right, bottom = rng.uniform(-0.01, 0.18, 4)
    return Crop(
        low[0] - left * width,
        low[1] - top * height,
        width * (1.0 + left + right),
        height * (1.0 + top + bottom),
    )


def _about(axis: str, angle: float) -> NDArray[np.float64]:
    cosine, sine = math.cos(angle), math.sin(angle)
    first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(3)
    matrix[first, first] = matrix[second, second] = cosine
    matrix[first, second], matrix[second, first] = -sine, sine
    return matrix
