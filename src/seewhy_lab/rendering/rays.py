"""What MuJoCo's ray caster meets in a scene."""

from __future__ import annotations

from dataclasses import dataclass, fields

import mujoco
import numpy as np

from seewhy_lab.rendering.vectors import Array

__all__ = ["Hits", "Scene"]


class Scene:
    """A compiled model in MuJoCo, its kinematics computed, to cast rays in.

    Examples
    --------
    >>> model = mujoco.MjModel.from_xml_string(
    ...     '<mujoco><worldbody><geom type="box" size="1 1 1"/></worldbody></mujoco>')
    >>> data = mujoco.MjData(model)
    >>> mujoco.mj_forward(model, data)
    >>> hits = Scene(model, data).look(np.array([0.0, -3.0, 0.0]), np.array([[0.0, 1.0, 0.0]]))
    >>> hits.point.tolist(), hits.normal.tolist(), hits.face.tolist()
    ([[0.0, -1.0, 0.0]], [[0.0, -1.0, 0.0]], [1])
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self.model, self.data = model, data
        self.half: Array = self.model.geom_size.astype(np.float32)
        self.centre: Array = self.data.geom_xpos.copy()
        self.rotation: Array = self.data.geom_xmat.reshape(-1, 3, 3).copy()
        kind = self.model.geom_type
        self._flat_ends = (kind == mujoco.mjtGeom.mjGEOM_BOX) | (
            kind == mujoco.mjtGeom.mjGEOM_CYLINDER
        )
        self._flat_sides = kind == mujoco.mjtGeom.mjGEOM_BOX

    def cast(
        self,
        origin: Array,
        directions: Array,
        *,
        normals: bool = False,
        group: int | None = None,
    ) -> tuple[Array, Array, Array]:
        """The geom hit (-1: none), the distance in units of the direction, and the normal.

        With `group` only those geoms are met that are in that group, 0 to 5, and can move.
        """
        count = len(directions)
        geom = np.empty(count, np.int32)
        distance = np.empty(count)
        normal = np.empty(3 * count) if normals else None
        mujoco.mj_multiRay(
            self.model,
            self.data,
            origin,
            np.ascontiguousarray(directions).ravel(),
            None if group is None else np.eye(6, dtype=np.uint8)[group],
            group is None,
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
        order = np.argsort(geom, kind="stable")
        ends = np.searchsorted(geom[order], np.arange(len(self.rotation) + 1))
        for number, rotation in enumerate(self.rotation):
            rows = order[ends[number] : ends[number + 1]]
            if not len(rows):
                continue
            local[rows] = (point.take(rows, 0) - self.centre[number]) @ rotation
            along = np.abs(normal.take(rows, 0) @ rotation)
            # On a flat face the normal is an axis of the geom: one component is 1, the others 0.
            if self._flat_sides[number]:
                face[rows] = along[:, 1] > 0.5
            if self._flat_ends[number]:
                face[rows] += 2 * (along[:, 2] > 0.99)
        return Hits(geom, point, normal, local, face)


@dataclass(frozen=True)
class Hits:
    """What a bundle of rays meets, one row a ray.

    - `geom`: number of the geom in the model; -1 nothing. Shape (n,).
    - `point`, `normal`: place and outward normal in the world, shape (n, 3).
    - `local`: the place in the frame of the geom, shape (n, 3).
    - `face`: the axis of the geom, 0 to 2, along which the normal of a flat face points; 0 on
      round ones. Shape (n,).
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
