"""What is made of a picture before anything is known of it: things, values, relations, how sure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from seewhy.data.measured import MEASURES, STANDING, feet, how_probable
from seewhy.domain.domain import Domain
from seewhy.domain.things import Things
from seewhy.perception.extractor import Seen
from seewhy.perception.eyes import Eyes
from seewhy.perception.picture import as_picture, whole_picture
from seewhy.perception.side_by_side import side_by_side
from seewhy.perception.things.boxes import Boxes, in_order
from seewhy.perception.things.detector import Detected, Detector, Trust
from seewhy.perception.things.geometry import of_boxes
from seewhy.perception.things.regions import LONGEST, regions_of
from seewhy.perception.things.thing_eyes import ThingEyes

if TYPE_CHECKING:
    from pathlib import Path

    from PIL import Image

    Picture = Path | str | Image.Image | np.ndarray[Any, Any]

__all__ = ["DOUBTED_FROM", "Sighting", "Table", "ThingSeeing"]

DOUBTED_FROM = 0.1
"""What is less probably a thing is none."""

Table = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Sighting:
    """What is made of a picture: things that may be there, from the left to the right.

    Attributes
    ----------
    boxes : ndarray of float, shape (n, 4)
        In pixels of the upright picture.
    presence : ndarray of float, shape (n,)
        How probable it is that each is a thing.
    values : dict of str to ndarray of float, shape (n, values)
        Of each feature.
    related : dict of str to ndarray of float, shape (n, n)
        Of each relation that is seen or measured: how probable it is that it holds of the thing of
        the row to that of the column.
    whole : dict of str to ndarray of float, shape (values,)
        Of the features of the picture as a whole, and of the class where that is seen.
    left_out : int
        Further things that may be there, less surely, beyond the most that the domain allows.
    """

    boxes: Boxes
    presence: Table
    values: dict[str, Table]
    related: dict[str, Table]
    whole: dict[str, Table]
    left_out: int = 0

    def told(self, said: Sequence[Mapping[str, str]], things: Things) -> Sighting:
        """Return the same where somebody says what things are: that is sure then.

        Parameters
        ----------
        said : sequence of mapping
            Of each thing: feature → value, of those that are said.
        things : Things
        """
        values = {key: table.copy() for key, table in self.values.items()}
        for number, of_thing in enumerate(said):
            for key, value in of_thing.items():
                values[key][number] = np.array(things.features[key].values) == value
        return replace(self, values=values)


@dataclass(frozen=True, eq=False)
class ThingSeeing:
    """What sees things.

    Attributes
    ----------
    domain : Domain
    eyes : ThingEyes
    detector : Detector
    trust : Trust
        How the detector's scores are taken.
    whole : Eyes or None
        Of the picture as a whole; None where the domain says nothing of it.
    """

    domain: Domain
    eyes: ThingEyes
    detector: Detector
    trust: Trust
    whole: Eyes | None = None

    def look(
        self, pictures: Sequence[Picture], boxes: Sequence[Boxes | None] | None = None
    ) -> list[Sighting]:
        """Look at pictures, all of which are in the memory at once.

        Parameters
        ----------
        pictures : sequence
        boxes : sequence of ndarray of float, shape (n, 4), or None; optional
            Where things are, of pictures for which somebody says it, in their order.

        Raises
        ------
        PictureError
            If a file is no picture.
        """
        given = [None] * len(pictures) if boxes is None else boxes
        located = side_by_side(self._locate, list(zip(pictures, given, strict=True)))
        counts = [len(found.boxes) for found in located]
        side = self.eyes.side
        seen = self.eyes.see(
            np.concatenate(
                [np.zeros((0, side, side, 3), np.uint8), *(place.regions for place in located)]
            ),
            np.concatenate(
                [of_boxes(np.zeros((0, 4)), (1, 1)), *(place.numbers for place in located)]
            ),
        )
        whole = self._whole(pictures)
        found: list[Sighting] = []
        start = 0
        for number, (place, count) in enumerate(zip(located, counts, strict=True)):
            rows = slice(start, start + count)
            start += count
            values = {key: table[rows] for key, table in seen.probabilities.items()}
            found.append(
                Sighting(
                    place.boxes,
                    place.presence,
                    values,
                    self._related(place, seen.projected[rows]),
                    {key: table[number] for key, table in whole.items()},
                    place.left_out,
                )
            )
        return found

    def _locate(self, asked: tuple[Picture, Boxes | None]) -> _Located:
        picture, boxes = asked
        whole = whole_picture(picture, longest=LONGEST)
        left_out = 0
        if boxes is None:
            detected = self.detector.find(whole.image)
            within, presence, left_out = self._believable(detected)
            spread = np.array(self.trust.spread)
        else:
            within, presence = boxes / whole.scale, np.ones(len(boxes))
            spread = np.zeros(4)
        lengths = np.tile(within[:, 2:] - within[:, :2], 2)
        return _Located(
            within * whole.scale,
            presence,
            spread * lengths * whole.scale,
            regions_of(whole.image, within, side=self.eyes.side),
            of_boxes(within, whole.image.size),
            left_out,
        )

    def _believable(self, detected: Detected) -> tuple[Boxes, Table, int]:
        """The boxes that may be of things in their order, and how many more there were."""
        presence = self.trust.probabilities(detected)
        things = self.domain.things
        assert things is not None
        surest = np.argsort(-presence, kind="stable")
        surest = surest[presence[surest] >= DOUBTED_FROM]
        kept = surest[: things.most]
        order = kept[in_order(detected.boxes[kept])]
        more = int((presence[surest[things.most :]] >= 0.5).sum())
        return detected.boxes[order], presence[order], more

    def _whole(self, pictures: Sequence[Picture]) -> Mapping[str, Table]:
        if self.whole is None:
            return {}
        size, fit = self.whole.size, self.domain.pictures.fit
        squares = np.zeros((len(pictures), size, size, 3), dtype=np.uint8)
        for number, picture in enumerate(pictures):
            squares[number] = as_picture(picture, size=size, fit=fit)
        seen: Seen = self.whole.see(squares)
        return seen.probabilities

    def _related(self, place: _Located, projected: npt.NDArray[np.float32]) -> dict[str, Table]:
        things = self.domain.things
        assert things is not None
        count = len(place.boxes)
        pairs = np.array(list(permutations(range(count), 2)), dtype=np.int64).reshape(-1, 2)
        found: dict[str, Table] = {}
        for key, row in self.eyes.see_pairs(projected, place.boxes, pairs).items():
            table = np.zeros((count, count))
            table[pairs[:, 0], pairs[:, 1]] = row
            found[key] = table
            converse = things.relations[key].converse
            if converse is not None and things.relations[converse].measure == "seen":
                found[converse] = table.T
        standing = _feet(found[things.support]) if things.support in found else range(count)
        for key, relation in things.relations.items():
            if relation.measure in MEASURES:
                shares = how_probable(MEASURES[relation.measure], place.boxes, place.spread)
                of_feet = relation.measure in STANDING
                found[key] = shares[np.ix_(standing, standing)] if of_feet else shares
        return found


def _feet(stands_on: Table) -> list[int]:
    """For each thing the one at the foot of its stack, by what each most probably stands on."""
    pairs = [
        (str(thing), str(int(row.argmax())))
        for thing, row in enumerate(stands_on)
        if row.size and row.max() >= 0.5
    ]
    return [int(foot) for foot in feet(map(str, range(len(stands_on))), pairs).values()]


@dataclass(frozen=True, eq=False)
class _Located:
    """Where things may be in a picture, and what is looked at there."""

    boxes: Boxes
    presence: Table
    spread: Table
    regions: npt.NDArray[np.uint8]
    numbers: npt.NDArray[np.float32]
    left_out: int
