"""Scenes and questions in the formats of CLEVR, checked and in a domain's terms.

Source: J. Johnson, B. Hariharan, L. van der Maaten, L. Fei-Fei, C. L. Zitnick, R. Girshick,
"CLEVR: A Diagnostic Dataset for Compositional Language and Elementary Visual Reasoning", CVPR 2017.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, StrictBool, StrictInt, StrictStr

from seewhy.data.importers.folder_files import FolderFiles
from seewhy.data.importers.json_reading import checked, json_items
from seewhy.data.importers.source_files import DamagedFileError
from seewhy.data.thing_scene import MOST_THINGS, Position, ThingScene, thing_scene
from seewhy.domain.things import ThingFeature, Things
from seewhy.errors import DatasetError
from seewhy.text.nearest import did_you_mean
from seewhy.text.visible import visible

__all__ = ["AskedOfScene", "read_questions", "read_scenes"]

_POSITION = "3d_coords"
_OTHERWISE = frozenset({_POSITION, "pixel_coords", "rotation"})
"""What a scene says of a thing besides its features."""


class _Scene(BaseModel):
    model_config = ConfigDict(extra="ignore")

    image_index: Annotated[StrictInt, Field(ge=0)]
    image_filename: Annotated[str, Field(max_length=1000)] = ""
    objects: Annotated[list[dict[str, Any]], Field(max_length=MOST_THINGS)]
    relationships: dict[str, list[Annotated[list[StrictInt], Field(max_length=MOST_THINGS)]]]


class _Question(BaseModel):
    model_config = ConfigDict(extra="ignore")

    image_index: Annotated[StrictInt, Field(ge=0)]
    question: Annotated[str, Field(max_length=10_000)]
    answer: StrictBool | StrictInt | StrictStr | None = None
    template_filename: Annotated[str, Field(max_length=1000)] = ""
    question_family_index: StrictInt | None = None


@dataclass(frozen=True)
class AskedOfScene:
    """A question about a scene.

    Attributes
    ----------
    image : int
        The number of the scene.
    text : str
    answer : bool, int, str or None
        As the file has it, yes and no as True and False, digits as a number; None without one.
    family : str
        Which questions are made like it.
    place : str
        Where it stands, for whoever looks for it.
    """

    image: int
    text: str
    answer: bool | int | str | None
    family: str
    place: str


def read_scenes(path: Path, things: Things) -> dict[int, ThingScene]:
    """Return the scenes of a file by number.

    Features, values and relations are found by their names or by their words in the domain:
    ``color`` is the feature of which domain.toml says ``words = ["color"]``.

    Raises
    ------
    DatasetError
        If the file is missing or damaged, or says what the domain does not know; the text names
        the place.
    """
    scenes: dict[int, ThingScene] = {}
    for place, item in _items(path, "scenes"):
        read = checked(_Scene, item, place)
        if read.image_index in scenes:
            raise DamagedFileError(
                f"{place}: image_index {read.image_index} is that of an earlier scene, too; give "
                "each scene its own"
            )
        scenes[read.image_index] = _scene(read, things, place)
    if not scenes:
        raise DatasetError(f"{path}: has no scenes; it must be an object with a list 'scenes'")
    return scenes


def read_questions(path: Path, scenes: Mapping[int, ThingScene]) -> list[AskedOfScene]:
    """Return the questions of a file.

    Raises
    ------
    DatasetError
        If the file is missing or damaged, or asks about a scene that is not there.
    """
    asked: list[AskedOfScene] = []
    for place, item in _items(path, "questions"):
        read = checked(_Question, item, place)
        if read.image_index not in scenes:
            raise DatasetError(
                f"{place}: asks about image {read.image_index}, of which there is no scene; give "
                "the scenes that the questions were made for"
            )
        family = read.template_filename.removesuffix(".json") or "question"
        if read.question_family_index is not None:
            family = f"{family} {read.question_family_index}"
        asked.append(
            AskedOfScene(read.image_index, read.question, _answer(read.answer), family, place)
        )
    if not asked:
        raise DatasetError(
            f"{path}: has no questions; it must be an object with a list 'questions'"
        )
    return asked


def _answer(answer: bool | int | str | None) -> bool | int | str | None:
    if isinstance(answer, str):
        said = answer.strip().casefold()
        if said in ("yes", "no", "true", "false"):
            return said in ("yes", "true")
        return int(said) if said.isdecimal() and len(said) < 10 else said
    return answer


def _items(path: Path, key: str) -> Iterator[tuple[str, object]]:
    """The elements of the list of that name, each with its place."""
    if not path.is_file():
        raise DatasetError(f"{path}: there is no such file; name one with a list '{key}'")
    for found, position, item in json_items(FolderFiles(path.parent), path.name):
        if found == key and position >= 0:
            yield f"{path}: {key}[{position}]", item
        elif found == key:
            raise DamagedFileError(f"{path}: '{key}' must be a list; correct it or export it again")


def _scene(read: _Scene, things: Things, place: str) -> ThingScene:
    values: list[dict[str, str | None]] = []
    positions: list[Position] = []
    for number, said in enumerate(read.objects):
        here = f"{place}.objects[{number}]"
        values.append(_values(said, things, here))
        if _POSITION in said:
            positions.append(_position(said[_POSITION], f"{here}.{_POSITION}"))
    relations = {
        _relation(name, things, place): _pairs(rows, len(values), f"{place}.relationships.{name}")
        for name, rows in read.relationships.items()
    }
    try:
        return thing_scene(
            things,
            values,
            relations=relations,
            positions=positions if len(positions) == len(values) else (),
            image=read.image_filename or str(read.image_index),
        )
    except DatasetError as problem:
        raise DatasetError(f"{place}: {problem}") from None


def _values(said: Mapping[str, Any], things: Things, place: str) -> dict[str, str | None]:
    values: dict[str, str | None] = {}
    for name, value in said.items():
        if name in _OTHERWISE:
            continue
        feature = _feature(name, things, place)
        if value is None:
            values[feature.key] = None
            continue
        if not isinstance(value, str):
            raise DamagedFileError(
                f"{place}.{name}: must be a text, got {visible(value)}; correct it or export it "
                "again"
            )
        values[feature.key] = _value(value, feature, f"{place}.{name}")
    return values


def _feature(name: str, things: Things, place: str) -> ThingFeature:
    for feature in things.features.values():
        if name == feature.key or name in feature.called:
            return feature
    raise DatasetError(
        f"{place}: '{visible(name)}' is no feature of things in the domain; "
        f"{did_you_mean(name, things.features)}"
    )


def _value(said: str, feature: ThingFeature, place: str) -> str:
    if (value := feature.value_called(said)) is not None:
        return value
    raise DatasetError(
        f"{place}: '{visible(said)}' is no {feature.name} of the domain; "
        f"{did_you_mean(said, feature.values)}"
    )


def _relation(name: str, things: Things, place: str) -> str:
    for key, relation in things.relations.items():
        if name == key or name in relation.words or name in relation.side:
            return key
    raise DatasetError(
        f"{place}.relationships: '{visible(name)}' is no relation of the domain; "
        f"{did_you_mean(name, things.relations)}"
    )


def _pairs(rows: list[list[int]], count: int, place: str) -> list[tuple[int, int]]:
    if len(rows) != count:
        raise DamagedFileError(
            f"{place}: must have a list for each of the {count} things, got {len(rows)}; correct "
            "it or export it again"
        )
    pairs: list[tuple[int, int]] = []
    for thing, subjects in enumerate(rows):
        for subject in subjects:
            if not 0 <= subject < count:
                raise DamagedFileError(
                    f"{place}[{thing}]: thing {subject} is not there; things count from 0 to "
                    f"{count - 1}"
                )
            pairs.append((subject, thing))
    return pairs


def _position(said: object, place: str) -> Position:
    numbers = said if isinstance(said, list) else []
    if len(numbers) != 3 or not all(
        isinstance(n, int | float) and not isinstance(n, bool) and math.isfinite(n) for n in numbers
    ):
        raise DamagedFileError(
            f"{place}: must be three finite numbers, got {visible(said)}; correct it or export it "
            "again"
        )
    right, back, up = map(float, numbers)
    return right, back, up
