"""The simulated world of a planning domain for programs that know Gymnasium."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from seewhy.planning.execution.environment import PlanningEnvironment

__all__ = ["GymnasiumEnvironment"]


class GymnasiumEnvironment(gymnasium.Env[NDArray[np.int8], np.int64]):
    """A :class:`~seewhy.planning.execution.environment.PlanningEnvironment` with its spaces.

    Parameters
    ----------
    world : PlanningEnvironment
        What happens; ``world.actions`` and ``world.fluents`` say what numbers stand for.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> world = PlanningEnvironment(load_planning_domain("robot_assistant"))
    >>> environment = GymnasiumEnvironment(world)
    >>> observation, info = environment.reset(seed=0)
    >>> environment.observation_space.contains(observation)
    True
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012

    def __init__(self, world: PlanningEnvironment) -> None:
        self.world = world
        self.action_space = gymnasium.spaces.Discrete(len(world.actions) + 1)
        self.observation_space = gymnasium.spaces.MultiDiscrete(
            np.full(len(world.fluents), 3), dtype=np.int8
        )

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.int8], dict[str, Any]]:
        """Begin an episode in a random world; ``options={"state": World}`` sets it."""
        super().reset(seed=seed)
        return self.world.reset(seed=seed, options=options)

    def step(
        self, action: int | np.int64
    ) -> tuple[NDArray[np.int8], float, bool, bool, dict[str, Any]]:
        """Do the action of this number."""
        return self.world.step(action)
