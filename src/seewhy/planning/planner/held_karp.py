"""Shortest walks past places: through the values of fluents of which exactly one holds."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import numpy.typing as npt

FAR = 10_000
"""The distance of what cannot be reached."""
MOST_STOPS = 18
"""Of more stops, these many are counted: the table of walks doubles with every one."""


class HeldKarpWalks:
    """The lengths of shortest walks past any subset of given stops, from anywhere.

    Parameters
    ----------
    into : mapping from every value to those from which one step leads to it
    stops : values to pass, at most :data:`MOST_STOPS`
    end : the value to end at, if there is one

    Examples
    --------
    >>> line = {1: {2}, 2: {1, 3}, 3: {2, 4}, 4: {3}}
    >>> walks = HeldKarpWalks(line, [1, 4], end=None)
    >>> walks.length(2, stops=0b11), walks.length(2, stops=0b10)
    (4, 2)
    """

    def __init__(
        self, into: Mapping[int, Iterable[int]], stops: Sequence[int], end: int | None
    ) -> None:
        self.stops = stops
        self._to_stop = [_distances(into, stop) for stop in stops]
        self._to_end = None if end is None else _distances(into, end)
        self._rest = self._all_walks()

    def length(self, value: int, stops: int) -> int:
        """Return the length of the shortest walk from a value past stops, given as bits."""
        if not stops:
            return 0 if self._to_end is None else self._to_end.get(value, FAR)
        best = FAR
        for number, distances in enumerate(self._to_stop):
            if stops >> number & 1:
                onward = int(self._rest[stops ^ (1 << number), number])
                best = min(best, distances.get(value, FAR) + onward)
        return best

    def _all_walks(self) -> npt.NDArray[np.int32]:
        """For every set of stops, from every stop, the walk past them (Held and Karp 1962)."""
        count = len(self.stops)
        between = np.array(
            [[to.get(stop, FAR) for stop in self.stops] for to in self._to_stop], dtype=np.int32
        ).reshape(count, count)
        rest = np.full((1 << count, count), FAR, dtype=np.int32)
        rest[0] = [self.length(stop, 0) for stop in self.stops]
        sets = np.arange(1 << count)
        sizes = sum((sets >> number & 1 for number in range(count)), np.zeros_like(sets))
        for size in range(1, count + 1):
            of_size = sets[sizes == size]
            for number in range(count):
                chosen = of_size[of_size >> number & 1 == 1]
                onward = rest[chosen ^ (1 << number), number]
                rest[chosen] = np.minimum(rest[chosen], onward[:, None] + between[number][None, :])
        return rest


def _distances(into: Mapping[int, Iterable[int]], value: int) -> dict[int, int]:
    """The number of steps to a value, from every value from which it can be reached."""
    distance, waiting = {value: 0}, deque([value])
    while waiting:
        after = waiting.popleft()
        for before in into.get(after, ()):
            if before not in distance:
                distance[before] = distance[after] + 1
                waiting.append(before)
    return distance
