"""How well the things in pictures are seen: found, missed, imagined, values, relations, scenes."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from seewhy.agent.things.thing_agent import ThingAgent
from seewhy.agent.things.thing_lessons import boxes_of, is_whole
from seewhy.agent.things.thing_reading import ThingReading, named
from seewhy.data.dataset import Dataset
from seewhy.data.measured import MEASURES, how_probable
from seewhy.data.scene import Scene
from seewhy.data.scene_vector import vector_with_things
from seewhy.data.thing import THINGS, BoundingBox
from seewhy.errors import DatasetError
from seewhy.evaluation.share import Share
from seewhy.knowledge.things import of_things, things_of
from seewhy.perception.things.boxes import matched

__all__ = ["Mistake", "SeenFeature", "ThingsSeen", "WrongScene", "evaluate_things"]

_SETTLED = 0.05
"""What boxes a pixel off decide otherwise more often than this, annotated boxes do not settle."""


@dataclass(frozen=True)
class SeenFeature:
    """How often a feature of things, or a relation between two, is read rightly.

    ``majority`` is the share of the value that is most frequent: who always says it is right so
    often.
    """

    right: Share
    majority: float


@dataclass(frozen=True)
class Mistake:
    """Something that is read wrongly.

    Attributes
    ----------
    says : str
        What, in words.
    probability : float or None
        How probable the model took it to be; None where nothing was seen, or decided.
    boxes : tuple of BoundingBox
        Of the things that it is about, in pixels of the upright picture; none where it is about
        the picture as a whole.
    """

    says: str
    probability: float | None = None
    boxes: tuple[BoundingBox, ...] = ()


@dataclass(frozen=True)
class WrongScene:
    """A picture in which something is read wrongly, its file, and what."""

    image: str
    picture: Path
    mistakes: tuple[Mistake, ...]

    @property
    def wrong(self) -> tuple[str, ...]:
        """What is read wrongly, in words."""
        return tuple(mistake.says for mistake in self.mistakes)

    def to_dict(self) -> dict[str, Any]:
        """Return it as values that JSON can hold."""
        sure = [mistake.probability for mistake in self.mistakes]
        return {
            "image": self.image,
            "wrong": list(self.wrong),
            "sure": [None if share is None else round(share, 4) for share in sure],
        }


@dataclass(frozen=True)
class ThingsSeen:
    """How well things are seen in annotated pictures.

    Attributes
    ----------
    pictures : int
    found, missed, imagined : int
        Things whose box overlaps an annotated one by half at least, annotated things without such
        a box, and boxes around no annotated thing.
    features, relations : mapping of str to SeenFeature
        Of things that were found, and pairs of such; of two converses the first. Pairs of which
        annotated boxes, exact to a pixel, do not settle a relation that is measured are left out:
        two things above each other are neither left of each other nor right.
    scenes : Share
        Pictures of which every thing is found, nothing imagined, and every annotated value right.
    scenes_with_relations : Share
        Those in which the relations are right, too.
    classes : SeenFeature or None
        Of pictures with a class.
    inconsistent : int
        Pictures of which no reading that was tried is consistent with the knowledge.
    pictures_per_second : float
        Read, from the file on.
    known : int
        Pictures that taught the model: of those it knows too much for the figures to hold for
        others.
    wrong : tuple of WrongScene
        The pictures that are not wholly right.
    """

    pictures: int
    found: int
    missed: int
    imagined: int
    features: Mapping[str, SeenFeature]
    relations: Mapping[str, SeenFeature]
    scenes: Share
    scenes_with_relations: Share
    classes: SeenFeature | None
    inconsistent: int
    pictures_per_second: float
    known: int
    wrong: tuple[WrongScene, ...]

    def to_dict(self) -> dict[str, Any]:
        """Return the figures as values that JSON can hold."""
        return {
            "pictures": self.pictures,
            "things": {
                "annotated": self.found + self.missed,
                "found": self.found,
                "missed": self.missed,
                "imagined": self.imagined,
            },
            "features": {key: _as_dict(seen) for key, seen in self.features.items()},
            "relations": {key: _as_dict(seen) for key, seen in self.relations.items()},
            "scenes_wholly_right": _share(self.scenes),
            "scenes_wholly_right_with_relations": _share(self.scenes_with_relations),
            "class": None if self.classes is None else _as_dict(self.classes),
            "inconsistent": self.inconsistent,
            "pictures_per_second": round(self.pictures_per_second, 2),
            "known": self.known,
            "wrong": [scene.to_dict() for scene in self.wrong],
        }


def _share(share: Share) -> dict[str, Any]:
    return {"right": share.right, "of": share.of, "accuracy": round(share.value, 4)}


def _as_dict(seen: SeenFeature) -> dict[str, Any]:
    return {**_share(seen.right), "majority": round(seen.majority, 4)}


def evaluate_things(
    agent: ThingAgent, dataset: Dataset, *, on_progress: Callable[[int], None] | None = None
) -> ThingsSeen:
    """Return how well the things in a dataset's pictures are seen.

    Of its splits, "test" is used, and of that the pictures in which all things have boxes, and
    those that are said to show none.

    Raises
    ------
    DatasetError
        If there is no such picture.
    """
    scenes = [scene for scene in dataset.of_split("test").scenes if is_whole(scene)]
    if not scenes:
        raise DatasetError(
            f"{dataset.folder / THINGS}: no picture to evaluate on has a box around each of its "
            "things; add boxes"
        )
    counts = _Counts(agent, dataset)
    start = time.perf_counter()
    readings = agent.read_all([scene.picture for scene in scenes])
    seconds = 0.0
    for number, scene in enumerate(scenes, start=1):
        reading = next(readings)
        seconds += time.perf_counter() - start
        counts.add(scene, reading)
        if on_progress is not None:
            on_progress(number)
        start = time.perf_counter()
    return counts.result(len(scenes) / max(seconds, 1e-9))


class _Counts:
    """Counts what is right while pictures are read."""

    def __init__(self, agent: ThingAgent, dataset: Dataset) -> None:
        self.agent, self.dataset = agent, dataset
        self.domain, self.things = agent.domain, agent.things
        self.pictures = self.found = self.missed = self.imagined = self.inconsistent = 0
        self.outcomes: dict[str, list[tuple[str, bool]]] = {}
        self.classes: list[tuple[str, bool]] = []
        self.whole = self.whole_with_relations = 0
        self.wrong: list[WrongScene] = []

    def add(self, scene: Scene, reading: ThingReading) -> None:
        """Count a picture."""
        true = boxes_of(scene.things)
        seen = np.array(
            [[t.box.left, t.box.top, t.box.right, t.box.bottom] for t in reading.things]
        ).reshape(-1, 4)
        numbers = matched(seen, true)
        pairs = {place: int(number) for place, number in enumerate(numbers) if number >= 0}
        missed = sorted({*range(len(true))} - {*pairs.values()})
        self.pictures += 1
        self.found += len(pairs)
        self.missed += len(missed)
        self.imagined += len(seen) - len(pairs)
        self.inconsistent += not reading.settled
        wrong = [
            Mistake(f"missed: {self._describe(scene, number)}", boxes=_boxes(scene, number))
            for number in missed
        ]
        wrong += [
            Mistake(
                f"imagined: a {self.things.one} at {_place(row)}",
                reading.things[place].probability,
                (reading.things[place].box,),
            )
            for place, row in enumerate(seen)
            if place not in pairs
        ]
        wrong += self._values(scene, reading, pairs)
        relations = self._relations(scene, reading, pairs)
        if scene.label is not None and self.domain.classes:
            right = reading.label == scene.label
            self.classes.append((scene.label, right))
            if not right:
                says = f"class: {reading.label or 'none'} instead of {scene.label}"
                wrong.append(Mistake(says, reading.class_probability))
        self.whole += not wrong
        self.whole_with_relations += not (wrong or relations)
        if wrong or relations:
            name = self.dataset.name_of(scene)
            self.wrong.append(WrongScene(name, scene.picture, (*wrong, *relations)))

    def _describe(self, scene: Scene, number: int) -> str:
        values = scene.things[number].values.values()
        return " ".join(values) or f"{self.things.one} {scene.things[number].name}"

    def _values(
        self, scene: Scene, reading: ThingReading, pairs: Mapping[int, int]
    ) -> Iterator[Mistake]:
        for place, number in pairs.items():
            for key, value in scene.things[number].values.items():
                read = reading.things[place].values[key]
                self.outcomes.setdefault(key, []).append((value, read.value == value))
                if read.value != value:
                    of = self._describe(scene, number)
                    says = f"{self.things.features[key].name} of {of}: {read.value}"
                    yield Mistake(says, read.probability, _boxes(scene, number))

    def _relations(
        self, scene: Scene, reading: ThingReading, pairs: Mapping[int, int]
    ) -> list[Mistake]:
        terms = list(self.domain.schema.presence)
        vector = vector_with_things(self.domain, scene.vector, scene.things, scene.related)
        true = dict(zip(self.domain.schema.features, vector, strict=True))
        read = named(reading, self.domain)
        unsettled = self._unsettled(scene)
        wrong = []
        for feature, (value, probability) in read.items():
            name, of = things_of(feature)
            relation = self.things.relations.get(name)
            if relation is None or self._said_already(name):
                continue
            places = [terms.index(term) for term in of]
            if not all(place in pairs for place in places):
                continue
            numbers = [pairs[place] for place in places]
            annotated = true.get(of_things(name, *(terms[number] for number in numbers)))
            if annotated is None or (name, *numbers) in unsettled:
                continue
            self.outcomes.setdefault(name, []).append((annotated, annotated == value))
            if annotated != value:
                said = relation.say.format(*(self._describe(scene, n) for n in numbers))
                says = f"{'not so' if value == 'no' else 'said'}: {said}"
                wrong.append(Mistake(says, probability, _boxes(scene, *numbers)))
        return wrong

    def _unsettled(self, scene: Scene) -> set[tuple[str, int, int]]:
        """The relations that annotated boxes do not settle, which are exact to a pixel."""
        boxes = boxes_of(scene.things)
        said = {relation.relation for relation in scene.related}
        found: set[tuple[str, int, int]] = set()
        for key, relation in self.things.relations.items():
            if relation.measure in MEASURES and key not in said:
                shares = how_probable(MEASURES[relation.measure], boxes, np.ones_like(boxes))
                unsure = (shares > _SETTLED) & (shares < 1.0 - _SETTLED)
                found |= {(key, int(one), int(other)) for one, other in np.argwhere(unsure)}
        return found

    def _said_already(self, name: str) -> bool:
        """Whether a relation is the converse of one that stands before it."""
        converse = self.things.relations[name].converse
        order = list(self.things.relations)
        return converse is not None and order.index(converse) < order.index(name)

    def result(self, pictures_per_second: float) -> ThingsSeen:
        """Return the figures."""
        features = {
            key: _seen(self.outcomes[key]) for key in self.things.features if key in self.outcomes
        }
        relations = {
            key: _seen(self.outcomes[key]) for key in self.things.relations if key in self.outcomes
        }
        digests = self.dataset.of_split("test").picture_digests()
        return ThingsSeen(
            pictures=self.pictures,
            found=self.found,
            missed=self.missed,
            imagined=self.imagined,
            features=features,
            relations=relations,
            scenes=Share(self.whole, self.pictures),
            scenes_with_relations=Share(self.whole_with_relations, self.pictures),
            classes=_seen(self.classes) if self.classes else None,
            inconsistent=self.inconsistent,
            pictures_per_second=pictures_per_second,
            known=len(self.agent.trained_on.intersection(digests)),
            wrong=tuple(self.wrong),
        )


def _boxes(scene: Scene, *numbers: int) -> tuple[BoundingBox, ...]:
    boxes = (scene.things[number].box for number in numbers)
    return tuple(box for box in boxes if box is not None)


def _place(row: np.ndarray[Any, np.dtype[np.float64]]) -> str:
    return f"({(row[0] + row[2]) / 2:.0f}, {(row[1] + row[3]) / 2:.0f})"


def _seen(outcomes: list[tuple[str, bool]]) -> SeenFeature:
    values = Counter(value for value, _ in outcomes)
    return SeenFeature(
        Share(sum(right for _, right in outcomes), len(outcomes)),
        max(values.values()) / len(outcomes),
    )
