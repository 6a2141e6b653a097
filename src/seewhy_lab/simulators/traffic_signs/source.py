"""The image source of the domain: signs drawn from their features, then photographed."""

from __future__ import annotations

import csv
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from seewhy.domain.folder import domain_folder
from seewhy_lab.simulators.traffic_signs.photograph import photograph
from seewhy_lab.simulators.traffic_signs.sign import face

__all__ = ["FEATURES", "draw", "signs"]

FEATURES = (
    "shape",
    "main_color",
    "border_color",
    "background_image",
    "primary_symbol",
    "secondary_symbol",
    "cross",
)


@lru_cache(maxsize=1)
def signs() -> dict[str, dict[str, str]]:
    """Return the features of each class, in the order of the table of classes.

    Examples
    --------
    >>> signs()["stop_sign"]["shape"]
    'octagon'
    """
    table = domain_folder("traffic_signs") / "classes.csv"
    with table.open(newline="", encoding="utf-8") as stream:
        return {row["class"]: {key: row[key] for key in FEATURES} for row in csv.DictReader(stream)}


def draw(*, seed: int, index: int, size: int = 48) -> tuple[NDArray[np.uint8], dict[str, str], str]:
    """Draw picture number ``index`` of the set that ``seed`` stands for.

    Every run of 62 pictures, from a multiple of 62 on, shows each class once. A picture depends
    on ``seed``, ``index`` and ``size`` only.

    Returns
    -------
    tuple
        The picture, uint8 of shape (height, width, 3), the longer side ``size``; the features of
        its sign; its class.

    Examples
    --------
    >>> picture, features, label = draw(seed=0, index=0, size=32)
    >>> max(picture.shape), features == signs()[label]
    (32, True)
    """
    names = list(signs())
    turn, place = divmod(index, len(names))
    label = names[np.random.default_rng([seed, turn, 0]).permutation(len(names))[place]]
    rng = np.random.default_rng([seed, index, 1])
    features = dict(signs()[label])
    picture = photograph(face(features, rng=rng, variant=label), rng, size=size)
    return picture, features, label
