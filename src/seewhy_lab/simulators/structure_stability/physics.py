"""What happens to a structure when it is let go, simulated with MuJoCo."""

from __future__ import annotations

import math
from functools import lru_cache

import mujoco
import numpy as np

from seewhy_lab.simulators.structure_stability.structure import Structure

__all__ = ["MOVED", "TURNED", "build_model", "release"]

TABLE_HALF = (0.55, 0.20, 0.011)
"""Half the length, depth and thickness of the table top, in metres."""
TABLE_BACK = 0.145
"""How far the middle of the table lies behind the structure, in metres."""

MOVED = 0.008
"""A block has moved when its centre is this far off along any axis, in metres, ..."""
TURNED = math.radians(8.0)
"""... or when it has turned by this angle."""

PUSH = 0.72
"""Spread of the push of the hand: speed in m/s for each metre above the table."""
DEPTH_SHARE = 0.6
"""The push along the line of sight in proportion to the one across: hands come from the side."""
NUDGE = 0.012
"""Spread of the speed that each block gets of its own, in m/s."""
LONGEST = 1.5
"""Simulated time after which what still stands is taken to stand, in seconds."""

_STEP = 0.003
_REST = 0.006  # Speed in m/s (and, for 2 cm of a block, the turning) below which all is at rest.


def build_model(structure: Structure) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The structure on a table top as it stands before release; geom 0 is the table."""
    model = _compile(structure)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


# The release and the picture of a structure follow each other: the second finds the model there.
@lru_cache(maxsize=1)
def _compile(structure: Structure) -> mujoco.MjModel:
    bodies = []
    for block, (x, y, z) in zip(structure.blocks, structure.centres, strict=True):
        quat = np.empty(4)
        mujoco.mju_mat2Quat(quat, np.ascontiguousarray(block.rotation.ravel()))
        size = " ".join(f"{value:.9f}" for value in block.half)
        bodies.append(
            f'<body pos="{x:.9f} {y:.9f} {z:.9f}" quat="{" ".join(f"{q:.9f}" for q in quat)}">'
            f'<freejoint/><geom type="box" size="{size}"/></body>'
        )
    length, depth, thickness = TABLE_HALF
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{_STEP}" integrator="implicitfast" iterations="30"/>'
        '<default><geom density="650" friction="0.55 0.002 0.0001" solref="0.008 1"/></default>'
        f'<worldbody><geom type="box" size="{length} {depth} {thickness}"'
        f' pos="0 {TABLE_BACK} {-thickness}"/>{"".join(bodies)}</worldbody></mujoco>'
    )


def release(
    structure: Structure,
    rng: np.random.Generator,
    *,
    push: float = PUSH,
    nudge: float = NUDGE,
) -> bool:
    """Lets the structure go as a hand does; True where no block moves, which is stable.

    The hand leaves the structure with a push in a random direction that grows with height, because
    fingers let go of a tower near its top, and each block with a small speed of its own, because
    no block lies perfectly on the one below. A tower has to take the push up without toppling:
    that is why of two structures that look the same one may stand and the other fall.
    """
    model, data = build_model(structure)
    count = len(structure.blocks)
    before = data.xpos[1:].copy()
    upright = data.xmat[1:].reshape(count, 3, 3).copy()
    speed = rng.normal(0.0, push, 2) * (1.0, DEPTH_SHARE) * before[:, 2:3]
    speed = speed + rng.normal(0.0, nudge, (count, 2))
    data.qvel.reshape(count, 6)[:, :2] = speed
    cos_turned = math.cos(TURNED)
    quiet = 0
    for step in range(1, math.ceil(LONGEST / _STEP) + 1):
        mujoco.mj_step(model, data)
        if step % 8:
            continue
        far = np.abs(data.xpos[1:] - before).max() > MOVED
        matrices = data.xmat[1:].reshape(count, 3, 3)
        # The trace of the relative rotation is 1 + 2 cos(angle).
        cosine = (np.einsum("nij,nij->n", matrices, upright) - 1.0) / 2.0
        if far or cosine.min() < cos_turned:
            return False
        velocity = data.qvel.reshape(count, 6)
        fastest = max(np.abs(velocity[:, :3]).max(), 0.02 * np.abs(velocity[:, 3:]).max())
        quiet = quiet + 1 if fastest < _REST else 0
        if quiet >= 4:
            return True
    return True
