"""A dataset folder of scenes of things: things.csv, relations.csv, and the questions about them."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from seewhy.data.dataset import TABLE
from seewhy.data.importers.clevr import AskedOfScene, read_questions, read_scenes
from seewhy.data.importers.folder_files import FolderFiles
from seewhy.data.importers.placing import Placing
from seewhy.data.thing import RELATIONS, THINGS
from seewhy.data.thing_scene import ThingScene
from seewhy.domain.things import Things
from seewhy.errors import DatasetError
from seewhy.files.whole_files import write_whole

__all__ = ["QUESTIONS", "ImportedScenes", "import_scenes"]

QUESTIONS = "questions.csv"
_AXES = ("x", "y", "z")


@dataclass(frozen=True)
class ImportedScenes:
    """What was written.

    Attributes
    ----------
    folder : Path
    scenes, things, relations, questions : int
        How many; of relations, the pairs that stand in one.
    pictures : int
        Pictures that were found and are linked or copied into the folder.
    """

    folder: Path
    scenes: int
    things: int
    relations: int
    questions: int
    pictures: int

    def as_json(self) -> dict[str, Any]:
        """Return the account as values that JSON can hold."""
        return {**asdict(self), "folder": str(self.folder)}


def import_scenes(
    scenes: Path,
    out: Path,
    things: Things,
    *,
    questions: Path | None = None,
    pictures: Path | None = None,
    copy: bool = False,
    on_progress: Callable[[int, int], None] | None = None,
) -> ImportedScenes:
    """Write scenes in CLEVR's format as a dataset folder.

    ``scenes.csv`` has a row a picture, ``things.csv`` a row a thing with its number from 1, its
    features and, where they are known, its place, ``relations.csv`` a row a pair that stands in a
    relation, ``questions.csv`` a row a question. Of two relations that are each other's converse
    only the first is written.

    Raises
    ------
    DatasetError
        Where a file is missing or damaged, a picture is not there, or the folder holds something.
    """
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise DatasetError(f"{out}: is there already; name a new folder with --out")
    described = read_scenes(scenes, things)
    asked = [] if questions is None else read_questions(questions, described)
    images = {number: f"images/{_file_name(scene, number)}" for number, scene in described.items()}
    twice = len(images) - len(set(images.values()))
    if twice:
        raise DatasetError(f"{scenes}: {twice} scenes have the file name of another; rename them")
    out.mkdir(parents=True, exist_ok=True)
    if pictures is not None:
        _place(described, images, pictures, out, copy=copy, on_progress=on_progress)
    relations = list(_relations(described, images, things))
    write_whole(out / THINGS, _csv(*_things(described, images)))
    write_whole(out / RELATIONS, _csv(("image", "relation", "thing", "other"), relations))
    if questions is not None:
        write_whole(out / QUESTIONS, _csv(*_questions(asked, images)))
    write_whole(out / TABLE, _csv(("image",), ((image,) for image in images.values())))
    return ImportedScenes(
        folder=out,
        scenes=len(described),
        things=sum(scene.count for scene in described.values()),
        relations=len(relations),
        questions=len(asked),
        pictures=len(described) if pictures is not None else 0,
    )


def _file_name(scene: ThingScene, number: int) -> str:
    """The name of a picture's file; of a path, its last part."""
    name = scene.image.replace("\\", "/").rsplit("/", 1)[-1]
    return name if name.strip(". ") and name.isprintable() else f"{number:06d}.png"


def _place(
    scenes: Mapping[int, ThingScene],
    images: Mapping[int, str],
    pictures: Path,
    out: Path,
    *,
    copy: bool,
    on_progress: Callable[[int, int], None] | None,
) -> None:
    if not pictures.is_dir():
        raise DatasetError(f"{pictures}: is no folder; name the folder of the pictures")
    files = FolderFiles(pictures)
    placing = Placing(files, out, link=not copy)
    for done, number in enumerate(scenes, start=1):
        name = images[number].removeprefix("images/")
        if not files.has(name):
            raise DatasetError(
                f"{pictures}: has no picture '{name}', which a scene is of; name the folder of the "
                "pictures of these scenes"
            )
        placing.place(name, images[number])
        if on_progress is not None:
            on_progress(done, len(scenes))


def _things(
    scenes: Mapping[int, ThingScene], images: Mapping[int, str]
) -> tuple[Sequence[str], Iterator[Sequence[str]]]:
    features = list(next(iter(scenes.values())).values)
    placed = all(scene.positions or not scene.count for scene in scenes.values())
    axes = _AXES if placed else ()

    def rows() -> Iterator[Sequence[str]]:
        for number, scene in scenes.items():
            for thing in range(scene.count):
                place = [f"{at:g}" for at in scene.positions[thing]] if placed else []
                values = [scene.values[feature][thing] or "" for feature in features]
                yield [images[number], str(thing + 1), *place, *values]

    return ("image", "thing", *axes, *features), rows()


def _relations(
    scenes: Mapping[int, ThingScene], images: Mapping[int, str], things: Things
) -> Iterator[Sequence[str]]:
    kept: list[str] = []
    for key, relation in things.relations.items():
        if relation.converse not in kept:
            kept.append(key)
    for number, scene in scenes.items():
        for key in kept:
            for other, row in enumerate(scene.related[key]):
                for thing in range(scene.count):
                    if row >> thing & 1:
                        yield (images[number], key, str(thing + 1), str(other + 1))


def _questions(
    asked: Sequence[AskedOfScene], images: Mapping[int, str]
) -> tuple[Sequence[str], Iterator[Sequence[str]]]:
    said = {True: "yes", False: "no"}
    rows = (
        (
            images[question.image],
            question.text,
            said[question.answer]
            if isinstance(question.answer, bool)
            else str(question.answer if question.answer is not None else ""),
            question.family,
        )
        for question in asked
    )
    return ("image", "question", "answer", "family"), rows


def _csv(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return text.getvalue()
