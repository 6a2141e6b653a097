"""A structure on its table as MuJoCo's ray caster sees it."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from seewhy.domains.structure_stability.physics import build_model
from seewhy.domains.structure_stability.structure import Structure

__all__ = ["Array", "Hits", "Scene", "dot"]

Array = NDArray[Any]


def dot(one: Array, other: Array) -> Array:
    """The scalar products of the rows of two arrays of shape (n, 3), shape (n,)."""
    return np.asarray(np.einsum("ij,ij->i", one, other))


class Scene:
    """The structure on its table in MuJoCo, to cast rays in."""

    def __init__(self, structure: Structure) -> None:
        self.model, self.data = build_model(structure)
        self.half: Array = self.model.geom_size.astype(np.float32)
        self.centre: Array = self.data.geom_xpos.copy()
        self.rotation: Array = self.data.geom_xmat.reshape(-1, 3, 3).copy()

    def cast(
        self, origin: Array, directions: Array, *, normals: bool = False
    ) -> tuple[Array, Array, Array]:
        """The geom hit (-1: none), the distance in units of the direction, and the normal."""
        count = len(directions)
        geom = np.empty(count, np.int32)
        distance = np.empty(count)
        normal = np.empty(3 * count) if normals else None
        mujoco.mj_multiRay(
            self.model,
            self.data,
            origin,
            np.ascontiguousarray(directions).ravel(),
            None,
            1,
            -1,
            geom,
            distance,
            normal,
            count,
            mujoco.mjMAXVAL,
        )
        return geom, distance, np.empty((0, 3)) if normal is None else normal.reshape(-1, 3)

    def look(self, eye: Array, rays: Array) -> Hits:
        """What rays from `eye` in the directions `rays`, shape (n, 3), meet first."""
        geom, distance, normal = self.cast(eye, rays, normals=True)
        point = eye + distance[:, None] * rays
        local = np.zeros((len(geom), 3), np.float32)
        face = np.zeros(len(geom), np.int64)
        for number, rotation in enumerate(self.rotation):
            rows = np.flatnonzero(geom == number)
            local[rows] = (point.take(rows, 0) - self.centre[number]) @ rotation
            along = np.abs(normal.take(rows, 0) @ rotation)
            # The normal is one of the axes of the geom: one component is 1, the others are 0.
            face[rows] = (along[:, 1] > 0.5) + 2 * (along[:, 2] > 0.5)
        return Hits(geom, point, normal, local, face)


@dataclass(frozen=True)
class Hits:
    """What a bundle of rays meets, one row a ray.

    - `geom`: number of the geom, 0 the table, 1 the lowest block; -1 nothing. Shape (n,).
    - `point`, `normal`: place and outward normal in the world, shape (n, 3).
    - `local`: the place in the frame of the geom, shape (n, 3).
    - `face`: the axis of the geom, 0 to 2, along which the normal points. Shape (n,).
    """

    geom: Array
    point: Array
    normal: Array
    local: Array
    face: Array

    @property
    def label(self) -> Array:
        """One number a face of a geom; -1 where nothing is met."""
        return np.where(self.geom < 0, -1, self.geom * 3 + self.face)

    def take(self, rows: Array) -> Hits:
        """Only the given rows."""
        return Hits(*(getattr(self, field.name).take(rows, axis=0) for field in fields(self)))

    def followed_by(self, other: Hits) -> Hits:
        """These rows and then those of `other`."""
        return Hits(
            *(
                np.concatenate([getattr(self, field.name), getattr(other, field.name)])
                for field in fields(self)
            )
        )
