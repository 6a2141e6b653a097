"""What becomes of the things on a table when hands let go of them, simulated with MuJoCo."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from seewhy_lab.simulators.tabletop.bodies import build_model
from seewhy_lab.simulators.tabletop.table import Table

__all__ = ["SUNK", "fallen"]

SUNK = 0.008
"""A thing has fallen when its middle is so much lower than it was, in metres."""

NUDGE = 0.02
"""Spread of the speed that each thing gets as it is let go, in m/s, in each level direction."""
LONGEST = 2.0
"""Simulated time, in seconds, after which what still stands is taken to stand."""


def fallen(
    table: Table, rng: np.random.Generator, *, without: int | None = None, nudge: float = NUDGE
) -> frozenset[int]:
    """The numbers of the things that fall when all are let go, or `without` is taken away.

    Every thing gets a small speed of its own, since no hand is perfectly still.
    """
    model, data = build_model(table)
    count = len(table.things)
    level = data.xpos[1:, 2].copy()
    data.qvel.reshape(count, 6)[:, :2] = rng.normal(0.0, nudge, (count, 2))
    if without is not None:
        model.geom_contype[without + 1] = model.geom_conaffinity[without + 1] = 0
        data.qpos.reshape(count, 7)[without, 0] += 10.0  # far away, where it falls for ever
    found: set[int] = set()
    for _ in range(math.ceil(LONGEST / model.opt.timestep)):
        mujoco.mj_step(model, data)
        found |= set(np.flatnonzero(level - data.xpos[1:, 2] > SUNK).tolist())
        if len(found) == count:
            break
    return frozenset(found - {without})
