"""The image source of the domain: annotated pictures of things on a table."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.rendering.rays import Scene
from seewhy_lab.simulators.tabletop.bodies import build_model
from seewhy_lab.simulators.tabletop.generation import MOST, random_table, told_apart
from seewhy_lab.simulators.tabletop.rendering import render
from seewhy_lab.simulators.tabletop.table import Table
from seewhy_lab.simulators.tabletop.view import View, random_view
from seewhy_lab.simulators.tabletop.visibility import seen_things, well_seen
from seewhy_lab.simulators.thing_rows import boxes, thing_rows

__all__ = ["draw", "random_scene"]


def random_scene(*, seed: int, index: int) -> tuple[Table, View, Scene]:
    """Table number `index` of the set that `seed` stands for, its view and its model.

    Of every thing at least 60 pixels (at 320 by 240) and a quarter are seen, and of any two that
    do not stand on each other one is plainly nearer, and one plainly further left.
    """
    rng = np.random.default_rng([seed, index])
    count = int(rng.integers(1, MOST + 1))
    while True:
        table, view = random_table(rng, count=count), random_view(rng)
        if not told_apart(table, view.azimuth):
            continue
        scene = Scene(*build_model(table))
        if well_seen(scene, view, count):
            return table, view, scene


def draw(
    *, seed: int, index: int, size: int = 320
) -> tuple[
    NDArray[np.uint8],
    dict[str, str],
    None,
    list[dict[str, str | int]],
    list[tuple[str, str, str]],
]:
    """Draws picture number `index` of the set that `seed` stands for.

    A picture depends on `seed`, `index` and `size` only.

    Returns
    -------
    picture : ndarray of uint8, shape (3/4 size, size, 3)
    features : dict
        Empty: the picture as a whole has none.
    label : None
        It has no class.
    things : list of dict
        A row of things.csv for each thing, from left to right: the box of what is seen of it, and
        its values.
    related : list of (relation, thing, other)
        What stands on what.
    """
    table, view, scene = random_scene(seed=seed, index=index)
    picture = render(scene, table, view, size=size)
    found = boxes(seen_things(scene, view, size=size), len(table.things))
    things, names = thing_rows(
        found,
        [
            {
                "size": thing.size,
                "colour": thing.colour,
                "material": thing.material,
                "shape": thing.shape,
            }
            for thing in table.things
        ],
    )
    related = [("on", names[upper], names[lower]) for upper, lower in table.stands_on()]
    return picture, {}, None, things, sorted(related)
