"""What a dataset teaches of things: their regions, their boxes, what holds between two."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np
import numpy.typing as npt
from PIL import Image

from seewhy.data.dataset import Dataset
from seewhy.data.reading_ahead import read_ahead
from seewhy.data.scene import Scene
from seewhy.data.thing import CORNERS, THINGS, BoundingBox, Thing
from seewhy.domain.things import SEEN, Things
from seewhy.errors import DatasetError
from seewhy.perception.lesson import Lesson
from seewhy.perception.picture import WholePicture, whole_picture
from seewhy.perception.things.boxes import Boxes
from seewhy.perception.things.detector import SIDES, scaled
from seewhy.perception.things.fitting_detector import BoxedPictures, side_for
from seewhy.perception.things.fitting_thing_eyes import PairLesson, ThingLesson
from seewhy.perception.things.geometry import of_boxes
from seewhy.perception.things.regions import LONGEST, regions_of

__all__ = [
    "FEWEST",
    "Lessons",
    "boxes_of",
    "is_whole",
    "lessons_of",
    "require_boxes",
    "seen_once",
    "shown_boxes",
]

FEWEST = 10
"""Pictures with boxes that a detector needs at least."""

_MOST = 1500
"""Pictures that teach a detector: more would change it little."""

_SAMPLED = 40  # pictures by which the size of things is told

_BATCH = 64


@dataclass(frozen=True, eq=False)
class Lessons:
    """What a dataset teaches.

    Attributes
    ----------
    things : ThingLesson
        What things are.
    places : BoxedPictures or None
        Where they are; None where a detector is given.
    """

    things: ThingLesson
    places: BoxedPictures | None


def boxes_of(things: Sequence[Thing]) -> Boxes:
    """The boxes of things as an array; all must have one."""
    rows = [[getattr(thing.box, corner) for corner in CORNERS] for thing in things]
    return np.array(rows, dtype=np.float64).reshape(-1, 4)


def seen_once(things: Things) -> tuple[str, ...]:
    """The relations that are seen on the pair, of two converses the first.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> seen_once(load_domain("tabletop").things) in ((), ("on",))
    True
    """
    found: list[str] = []
    for key, relation in things.relations.items():
        if relation.measure == SEEN and relation.converse not in found:
            found.append(key)
    return tuple(found)


def require_boxes(dataset: Dataset) -> None:
    """Raise a DatasetError where a dataset does not show where and what things are."""
    things = dataset.domain.things
    assert things is not None, "the domain has no things"
    file = dataset.folder / THINGS
    annotated = [thing for scene in dataset.scenes for thing in scene.things]
    if not annotated:
        said = "has no things of the pictures to train on" if file.is_file() else "is missing"
        raise DatasetError(
            f"{file}: {said}; list there the things of each picture with their boxes "
            f"(image, thing, {', '.join(CORNERS)}, {', '.join(things.features)})"
        )
    if not any(thing.box for thing in annotated):
        raise DatasetError(
            f"{file}: has no boxes: fill the columns {', '.join(CORNERS)} (pixels), or import "
            "what a labelling tool wrote with 'seewhy data import'"
        )
    for key in things.features:
        if not any(key in thing.values for thing in annotated if thing.box):
            raise DatasetError(
                f"{file}: no thing with a box has a value of '{key}', which training needs; fill "
                f"the column '{key}', or remove the feature from the domain"
            )
    whole = sum(bool(scene.things) and is_whole(scene) for scene in dataset.scenes)
    if whole < FEWEST:
        raise DatasetError(
            f"{file}: {whole} picture{'s have' if whole != 1 else ' has'} a box around each thing; "
            f"to find things, at least {FEWEST} are needed, a hundred if you can"
        )


def shown_boxes(dataset: Dataset) -> Boxes:
    """The boxes of things in some pictures, in pixels of these as they are looked at.

    Raises
    ------
    DatasetError, PictureError
        If no thing has a box; if a file is no picture.
    """
    require_boxes(dataset)
    boxed = [scene for scene in dataset.scenes if any(thing.box for thing in scene.things)]
    chosen = np.random.default_rng(0).permutation(len(boxed))[:_SAMPLED]
    some = [boxed[n] for n in np.sort(chosen)]
    return np.concatenate(
        [
            boxes_of([thing for thing in scene.things if thing.box]) / picture.scale
            for scene, picture in zip(some, _pictures(some), strict=True)
        ]
    )


def is_whole(scene: Scene) -> bool:
    """Whether a picture tells where all things are: each has a box, or it is said to show none."""
    return scene.no_things or (bool(scene.things) and all(thing.box for thing in scene.things))


def lessons_of(dataset: Dataset, *, side: int, with_places: bool = True) -> Lessons:
    """What a dataset teaches of things; its pictures are read once.

    Pictures in which all things have boxes teach where things are, and those that are said to
    show none where none are; every thing that has a box teaches what it is. Other pictures without
    any thing teach nothing: nobody says that there is none.

    Parameters
    ----------
    dataset : Dataset
    side : int
        Of regions, in pixels.
    with_places : bool, default True
        False where a detector is given.

    Raises
    ------
    DatasetError, PictureError
        If no thing has a box; if a file is no picture.
    """
    require_boxes(dataset)
    domain = dataset.domain
    assert domain.things is not None
    kinds = [
        (scene, group)
        for scene, group in zip(dataset.scenes, dataset.groups, strict=True)
        if scene.no_things or any(thing.box for thing in scene.things)
    ]
    shown, groups = [scene for scene, _ in kinds], [group for _, group in kinds]
    boxed = [[thing for thing in scene.things if thing.box] for scene in shown]
    whole = [n for n, scene in enumerate(shown) if is_whole(scene)]
    chosen = np.random.default_rng(0).permutation(len(whole))[:_MOST]
    places = {whole[n] for n in chosen} if with_places else set()
    regions: list[npt.NDArray[np.uint8]] = []
    numbers: list[npt.NDArray[np.float32]] = []
    kept: dict[int, WholePicture] = {}
    for at, picture in enumerate(_pictures(shown)):
        boxes = boxes_of(boxed[at]) / picture.scale
        regions.append(regions_of(picture.image, boxes, side=side))
        numbers.append(of_boxes(boxes, picture.image.size))
        if at in places:
            kept[at] = _smaller(picture)
    flat = [(at, thing) for at, of_picture in enumerate(boxed) for thing in of_picture]
    corners = boxes_of([thing for _, thing in flat])
    pixels = np.concatenate(regions)
    lesson = _regions(
        pixels, domain.things, [thing for _, thing in flat], [groups[at] for at, _ in flat]
    )
    relations = {
        key: lesson_of_pairs
        for key in seen_once(domain.things)
        if (lesson_of_pairs := _pairs(key, shown, boxed)) is not None
    }
    return Lessons(
        ThingLesson(lesson, np.concatenate(numbers), corners, relations),
        _places(kept, boxed, groups) if with_places else None,
    )


def _regions(
    pixels: npt.NDArray[np.uint8], things: Things, shown: Sequence[Thing], groups: Sequence[str]
) -> Lesson:
    """The lesson of regions: a picture a thing."""
    return Lesson(
        batches=lambda: (pixels[n : n + _BATCH] for n in range(0, len(pixels), _BATCH)),
        labels={key: [thing.values.get(key) for thing in shown] for key in things.features},
        values={key: feature.values for key, feature in things.features.items()},
        strata=[tuple(thing.values.get(key) for key in things.features) for thing in shown],
        groups=groups,
    )


def _pictures(scenes: Sequence[Scene]) -> Iterator[WholePicture]:
    def read(scene: Scene) -> WholePicture:
        return whole_picture(scene.picture, longest=LONGEST)

    yield from read_ahead(read, scenes, ahead=8)


def _smaller(picture: WholePicture) -> WholePicture:
    """The picture at the largest side at which it may be looked for things."""
    pixels, scale = scaled(picture.image, min(SIDES[-1], max(picture.image.size)))
    return WholePicture(Image.fromarray(pixels), picture.scale / scale)


def _places(
    kept: dict[int, WholePicture],
    boxed: Sequence[Sequence[Thing]],
    groups: Sequence[str],
) -> BoxedPictures:
    order = sorted(kept)
    boxes = [boxes_of(boxed[at]) / kept[at].scale for at in order]
    side = side_for(boxes, [kept[at].image.size for at in order])
    pixels = [scaled(kept[at].image, side) for at in order]
    return BoxedPictures(
        pixels=[array for array, _ in pixels],
        boxes=[of_one * scale for of_one, (_, scale) in zip(boxes, pixels, strict=True)],
        groups=[groups[at] for at in order],
        side=side,
    )


def _pairs(
    relation: str, shown: Sequence[Scene], boxed: Sequence[Sequence[Thing]]
) -> PairLesson | None:
    """What is annotated of a relation; None where nothing is, or always the same."""
    pairs: list[tuple[int, int]] = []
    holds: list[int] = []
    start = 0
    for scene, things in zip(shown, boxed, strict=True):
        said = {
            (related.thing, related.other): related.holds
            for related in scene.related
            if related.relation == relation
        }
        for first, second in permutations(range(len(things)), 2):
            value = said.get((things[first].name, things[second].name))
            if value is not None:
                pairs.append((start + first, start + second))
                holds.append(int(value))
        start += len(things)
    if len(set(holds)) < 2:
        return None
    return PairLesson(np.array(pairs, dtype=np.int64), np.array(holds, dtype=np.int64))


def box_of(row: npt.NDArray[np.float64]) -> BoundingBox:
    """A row of corners as a box."""
    return BoundingBox(*(float(corner) for corner in row))
