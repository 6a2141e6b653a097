"""Edges that are a little round: they catch the light, as those of real blocks do."""

from __future__ import annotations

import mujoco
import numpy as np

from seewhy_lab.rendering.rays import Hits, Scene
from seewhy_lab.rendering.vectors import Array, unit

__all__ = ["rounded"]


def rounded(hits: Hits, scene: Scene, *, radius: float) -> Array:
    """The normals, bent outwards near the edges of a geom as though these were rounded.

    `radius` is that of the edges, in metres. The normals have length 1 and shape (3, n): numpy is
    much faster along the last axis.
    """
    bent = np.empty((3, len(hits.geom)), np.float32)
    for number, rotation in enumerate(scene.rotation.astype(np.float32)):
        rows = np.flatnonzero(hits.geom == number)
        if not len(rows):
            continue
        at = hits.local.take(rows, 0).T
        flat = rotation.T @ hits.normal.take(rows, 0).astype(np.float32).T
        kind = scene.model.geom_type[number]
        if kind == mujoco.mjtGeom.mjGEOM_BOX:
            outwards = _of_box(at, hits.face[rows], scene.half[number], radius)
        elif kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
            outwards = _of_cylinder(at, hits.face[rows], scene.half[number], radius)
        else:
            outwards = np.zeros_like(flat)
        bent[:, rows] = rotation @ (flat + outwards)
    return unit(bent)


def _of_box(at: Array, face: Array, half: Array, radius: float) -> Array:
    over = np.clip((np.abs(at) - (half[:, None] - radius)) / radius, 0.0, 1.0)
    over[face, np.arange(len(face))] = 0.0
    return np.asarray(0.9 * over * over * np.sign(at))


def _of_cylinder(at: Array, face: Array, half: Array, radius: float) -> Array:
    away = np.hypot(at[0], at[1])
    on_end = face == 2
    along = np.clip((np.abs(at[2]) - (half[1] - radius)) / radius, 0.0, 1.0) * ~on_end
    across = np.clip((away - (half[0] - radius)) / radius, 0.0, 1.0) * on_end
    out = 0.9 * across * across / np.maximum(away, 1e-9)
    return np.stack([out * at[0], out * at[1], 0.9 * along * along * np.sign(at[2])])
