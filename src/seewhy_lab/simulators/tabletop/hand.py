"""A hand that moves the things on a table, simulated with MuJoCo."""

from __future__ import annotations

import math
from itertools import product

import mujoco
import numpy as np

from seewhy_lab.simulators.tabletop.bodies import build_model
from seewhy_lab.simulators.tabletop.table import Table

__all__ = ["Hand"]

PLACED = 0.002
"""Spread of where the hand puts a thing, in metres, in each level direction."""
RELEASED = 0.01
"""Spread of the speed that a thing gets as the hand lets go of it, in m/s."""
SETTLING = 2.0
"""Simulated time, in seconds, that passes after each action at most."""

_AT_REST = 0.004  # Speed in m/s (and rad/s, times a thing's size) below which a thing is at rest.
_LEAST_STEPS = 60
_AWAY = 10.0  # How far from the table a thing is kept that is held, in metres.
_HALF_LENGTH, _HALF_DEPTH = 0.150, 0.105  # Of the part of the table on which things are put.
_PLACES = 13  # Places that are looked at for room, in each direction.


class Hand:
    """The things of a table as bodies, and a hand that picks up and puts down one at a time.

    Parameters
    ----------
    table : Table
        As it is at first.
    rng : numpy.random.Generator
        For where exactly the hand puts things.
    placed, released : float, optional
        Spreads of place and speed, in metres and m/s.

    Examples
    --------
    >>> from seewhy_lab.simulators.tabletop.table import TableThing
    >>> look = {"size": "large", "colour": "red", "material": "rubber", "yaw": 0.0, "z": 0.031}
    >>> cubes = (TableThing(shape="cube", x=0.0, y=0.0, **look),
    ...          TableThing(shape="cube", x=0.1, y=0.0, **look))
    >>> hand = Hand(Table(cubes), np.random.default_rng(0))
    >>> hand.pick_up(0)
    >>> hand.put_on(0, 1)
    >>> hand.held, hand.stands_on()
    (None, {(0, 1)})
    """

    def __init__(
        self,
        table: Table,
        rng: np.random.Generator,
        *,
        placed: float = PLACED,
        released: float = RELEASED,
    ) -> None:
        self.table = table
        self.held: int | None = None
        self._rng = rng
        self._placed, self._released = placed, released
        self._model, self._data = build_model(table)
        count = len(table.things)
        self._places = self._data.qpos.reshape(count, 7)
        self._speeds = self._data.qvel.reshape(count, 6)
        self._settle()  # until what stands on something touches it

    def pick_up(self, number: int) -> None:
        """Take a thing off the table; what then loses its support falls."""
        self._touches(number, False)
        self._places[number, :3] = (_AWAY, 0.0, _AWAY)
        self.held = number
        self._settle()

    def put_on(self, number: int, on: int) -> None:
        """Put the thing that is held on the middle of another."""
        middle = self._data.xpos[on + 1]
        top = float(middle[2]) + self._rise(on)
        self._release(number, float(middle[0]), float(middle[1]), top)

    def put_down(self, number: int) -> None:
        """Put the thing that is held on the table where there is most room."""
        x, y = self._room(number)
        self._release(number, x, y, 0.0)

    def stands_on(self) -> set[tuple[int, int]]:
        """Each thing that stands on another and not on the table, with that other."""
        touching = {
            tuple(sorted((int(pair.geom1), int(pair.geom2))))
            for pair in self._data.contact[: self._data.ncon]
        }
        found = set()
        for number in range(len(self.table.things)):
            below = [
                other
                for other in range(len(self.table.things))
                if tuple(sorted((number + 1, other + 1))) in touching
                and self._higher(number, other)
            ]
            if below and (0, number + 1) not in touching:
                found.add((number, min(below, key=lambda other: self._apart(number, other))))
        return found

    def _higher(self, number: int, other: int) -> bool:
        """Whether the middle of a thing is above the top of another, or nearly so."""
        heights = self._data.xpos[:, 2]
        return bool(heights[number + 1] - heights[other + 1] > 0.6 * self._rise(other))

    def _apart(self, number: int, other: int) -> float:
        level = self._data.xpos[number + 1, :2] - self._data.xpos[other + 1, :2]
        return float(np.hypot(*level))

    def _rise(self, number: int) -> float:
        """How far a thing reaches up from its middle, as it lies."""
        thing = self.table.things[number]
        width, height = thing.half
        if thing.shape == "sphere":
            return width
        upward = np.abs(self._data.xmat[number + 1].reshape(3, 3)[2])
        if thing.shape == "cylinder":
            across = math.sqrt(max(0.0, 1.0 - float(upward[2]) ** 2))
            return float(upward[2]) * height + across * width
        return float(upward @ (width, width, height))

    def _room(self, number: int) -> tuple[float, float]:
        """The place on the table that is farthest from all things that touch it."""
        reach = self.table.things[number].reach
        others = [n for n in range(len(self.table.things)) if n not in (number, self.held)]

        def room(place: tuple[float, float]) -> float:
            return min(
                (
                    math.hypot(
                        place[0] - float(self._data.xpos[other + 1, 0]),
                        place[1] - float(self._data.xpos[other + 1, 1]),
                    )
                    - self.table.things[other].reach
                    - reach
                    for other in others
                ),
                default=math.inf,
            )

        across = np.linspace(-_HALF_LENGTH, _HALF_LENGTH, _PLACES)
        deep = np.linspace(-_HALF_DEPTH, _HALF_DEPTH, _PLACES)
        places = [(float(x), float(y)) for x, y in product(across, deep)]
        return max(places, key=room)

    def _release(self, number: int, x: float, y: float, level: float) -> None:
        thing = self.table.things[number]
        off = self._rng.normal(0.0, self._placed, 2)
        self._places[number, :3] = (x + off[0], y + off[1], level + thing.half[1])
        turn = thing.yaw / 2.0
        self._places[number, 3:] = (math.cos(turn), 0.0, 0.0, math.sin(turn))
        self._touches(number, True)
        self._speeds[number] = 0.0
        self._speeds[number, :2] = self._rng.normal(0.0, self._released, 2)
        self.held = None
        self._settle()

    def _touches(self, number: int, does: bool) -> None:
        """Whether a thing meets others and weighs anything: what is held does neither."""
        self._model.geom_contype[number + 1] = self._model.geom_conaffinity[number + 1] = int(does)
        self._model.body_gravcomp[number + 1] = float(not does)
        self._speeds[number] = 0.0

    def _settle(self) -> None:
        """Let time pass until all is at rest, or for as long as is waited."""
        for step in range(math.ceil(SETTLING / self._model.opt.timestep)):
            mujoco.mj_step(self._model, self._data)
            if step >= _LEAST_STEPS and np.abs(self._speeds[:, :3]).max() < _AT_REST:
                break
