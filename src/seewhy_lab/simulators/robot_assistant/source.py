"""The image source of the domain: annotated pictures of rooms, as a robot sees them."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.simulators.robot_assistant.people import PEOPLE
from seewhy_lab.simulators.robot_assistant.rendering import Built, render, visible_pixels
from seewhy_lab.simulators.robot_assistant.room import OBJECTS, furnished
from seewhy_lab.simulators.robot_assistant.view import random_decor, random_view

__all__ = ["OBJECTS", "PEOPLE", "depict", "draw", "photograph"]

_CHECKED = 48  # Side of the pictures in which is counted what can be seen, in pixels.
_NEEDED = {
    "cup": 0.0035,
    "small_box": 0.006,
    "books": 0.006,
    "computer": 0.012,
    "plant": 0.024,
    "large_box": 0.032,
    "desk": 0.025,
    "sofa": 0.035,
}
_OTHERS_NEED = 0.018
"""Which share of the picture must show a thing, ..."""
_MODESTY = 0.95
"""... times this for every room that was not good enough, ..."""
_LEAST = 0.4
"""... until it is this part of it: in a full room much stands before other things."""


def photograph(
    objects: Collection[str],
    people: Collection[str],
    *,
    rng: np.random.Generator,
    size: int = 96,
) -> NDArray[np.uint8]:
    """A picture of a room that holds exactly the given objects and people, all of them in view.

    Layout, viewpoint, light, walls and floor, and the looks of each thing are random.

    Parameters
    ----------
    objects, people : collection of str
        Out of :data:`OBJECTS` and :data:`PEOPLE`.
    rng : numpy.random.Generator
        All that is random comes from it.
    size : int, default 96
        Side of the picture, in pixels.

    Returns
    -------
    ndarray of uint8, shape (size, size, 3)

    Raises
    ------
    ValueError
        A name is not that of an object, or not that of a person.

    Examples
    --------
    >>> photograph({"desk", "cup"}, {"sally"}, rng=np.random.default_rng(0)).shape
    (96, 96, 3)
    """
    part = 1.0
    while True:
        room = furnished(objects, people, rng)
        view = random_view(room, rng)
        built = Built(room, random_decor(room, rng))
        seen = visible_pixels(built, view, size=_CHECKED)
        if all(
            count >= part * _NEEDED.get(name, _OTHERS_NEED) * _CHECKED**2
            for name, count in seen.items()
        ):
            return render(built, view, size=size)
        part = max(_LEAST, part * _MODESTY)


def depict(features: Mapping[str, str], *, seed: int, size: int = 96) -> NDArray[np.uint8]:
    """A picture of a room that holds what `features` has as ``"yes"``, and nothing else.

    It depends on the arguments only.

    Examples
    --------
    >>> depict({"sofa": "yes", "bob": "no"}, seed=1).shape
    (96, 96, 3)
    """
    return photograph(
        [name for name in OBJECTS if features.get(name) == "yes"],
        [name for name in PEOPLE if features.get(name) == "yes"],
        rng=np.random.default_rng(seed),
        size=size,
    )


def draw(*, seed: int, index: int, size: int = 96) -> tuple[NDArray[np.uint8], dict[str, str], str]:
    """Draws picture number `index` of the set that `seed` stands for.

    A picture depends on `seed`, `index` and `size` only: any number of workers in any order makes
    the same bytes. Another `size` shows the same room at another resolution.

    Returns
    -------
    picture : ndarray of uint8, shape (size, size, 3)
        A room with a random part of the objects and people.
    features : dict of str to str
        For each object and each person ``"yes"`` or ``"no"``.
    label : str
        ``"occupied"`` if somebody is in the room, else ``"empty"``.

    Examples
    --------
    >>> picture, features, label = draw(seed=0, index=0)
    >>> picture.shape, label, len(features)
    ((96, 96, 3), 'occupied', 13)
    """
    rng = np.random.default_rng([seed, index])
    names = (*OBJECTS, *PEOPLE)
    present = dict(zip(names, rng.uniform(size=len(names)) < 0.45, strict=True))
    picture = photograph(
        [name for name in OBJECTS if present[name]],
        [name for name in PEOPLE if present[name]],
        rng=rng,
        size=size,
    )
    label = "occupied" if any(present[name] for name in PEOPLE) else "empty"
    return picture, {name: "yes" if present[name] else "no" for name in names}, label
