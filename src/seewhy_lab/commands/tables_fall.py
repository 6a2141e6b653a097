"""Print what of the things on a table falls in the simulator, beside what `tabletop` says.

    python -m seewhy_lab tables_fall

Three tables: how often a thing falls off another, by shape and size; whether those fall that
`falls_without` names when a thing is taken away; and how many pairs of things stand to each other
as is measured from their boxes.
"""

from __future__ import annotations

import argparse
import math
from itertools import permutations, product

import numpy as np

from seewhy.data.scene_vector import vector_with_things
from seewhy.data.thing import BoundingBox, Related, Thing
from seewhy.domain.domain import load_domain
from seewhy_lab.simulators.tabletop.physics import fallen
from seewhy_lab.simulators.tabletop.source import random_scene
from seewhy_lab.simulators.tabletop.table import (
    SHAPES,
    SIZES,
    Table,
    TableThing,
    half_extent,
)
from seewhy_lab.simulators.tabletop.visibility import seen_things
from seewhy_lab.simulators.thing_rows import boxes

__all__ = ["main", "measured_rightly", "share_fallen", "taken_away"]

_OFF = 0.3
_MEASURED = (("left", 0), ("in_front", 1))


def _thing(shape: str, size: str, rng: np.random.Generator, below: TableThing | None) -> TableThing:
    off = 0.0 if below is None else _OFF * below.half[0] * rng.uniform()
    towards, yaw = rng.uniform(0.0, 2.0 * math.pi, 2)
    return TableThing(
        shape=shape,
        size=size,
        colour="red",
        material="rubber",
        x=off * math.cos(towards),
        y=off * math.sin(towards),
        z=half_extent(shape, size)[1] + (0.0 if below is None else below.top),
        yaw=float(yaw),
        support=None if below is None else 0,
    )


def share_fallen(
    upper: tuple[str, str], lower: tuple[str, str], *, runs: int, rng: np.random.Generator
) -> float:
    """In which share of runs a thing of a shape and a size falls off another.

    Examples
    --------
    >>> share_fallen(("cube", "small"), ("sphere", "large"), runs=2, rng=np.random.default_rng(0))
    1.0
    """
    count = 0
    for _ in range(runs):
        below = _thing(*lower, rng, None)
        count += 1 in fallen(Table((below, _thing(*upper, rng, below))), rng)
    return count / runs


def taken_away(*, tables: int) -> tuple[int, int]:
    """Of how many things that were taken away those fell that stood above them, and no others.

    Returns their number and that of all.
    """
    right = count = 0
    for index in range(tables):
        table, _, _ = random_scene(seed=1, index=index)
        for number in range(len(table.things)):
            above = {thing for thing in range(len(table.things)) if number in _below(table, thing)}
            found = fallen(table, np.random.default_rng(0), without=number, nudge=0.0)
            right += found == above
            count += 1
    return right, count


def _below(table: Table, number: int) -> set[int]:
    support = table.things[number].support
    return set() if support is None else {support, *_below(table, support)}


def measured_rightly(*, tables: int) -> tuple[int, int]:
    """How many pairs of things in pictures stand as measured from boxes, and how many there are."""
    domain = load_domain("tabletop")
    right = pairs = 0
    for index in range(tables):
        table, view, scene = random_scene(seed=1, index=index)
        count = len(table.things)
        found = boxes(seen_things(scene, view, size=320), count)
        things = [Thing(str(n), {}, BoundingBox(*map(float, found[n]))) for n in range(count)]
        on = [Related("on", str(one), str(other)) for one, other in table.stands_on()]
        vector = vector_with_things(domain, (), things, on)
        shown = dict(zip(domain.schema.features, vector, strict=True))
        places = table.places(view.azimuth)
        for one, other in permutations(range(count), 2):
            for relation, axis in _MEASURED:
                said = shown[f"{relation}(thing{one + 1},thing{other + 1})"] == "yes"
                right += said is (places[one][axis] < places[other][axis])
                pairs += 1
    return right, pairs


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser("python -m seewhy_lab tables_fall", description=__doc__)
    parser.add_argument("--runs", type=int, default=12, help="Runs of each pair of things.")
    parser.add_argument("--tables", type=int, default=100, help="Tables that are looked at.")
    options = parser.parse_args()
    rng = np.random.default_rng(0)
    kinds = [(shape, size) for shape, size in product(SHAPES, SIZES)]
    print("falls off", *(" ".join(reversed(kind)) for kind in kinds), sep=" | ")
    for upper in kinds:
        shares = (share_fallen(upper, lower, runs=options.runs, rng=rng) for lower in kinds)
        said = (f"{100 * share:.0f} %" for share in shares)
        print(" ".join(reversed(upper)), *said, sep=" | ", flush=True)
    right, count = taken_away(tables=options.tables)
    print(f"things taken away after which those fall that are above: {right} of {count}")
    right, pairs = measured_rightly(tables=options.tables)
    print(f"measured from boxes as it is: {right} of {pairs} ({100 * right / pairs:.1f} %)")


if __name__ == "__main__":
    main()
