"""What an agent remembers of the pictures that are labelled in dialogue."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy.agent.training_pictures import TrainingPictures
from seewhy.data.dataset import Dataset
from seewhy.data.digest import digest_of
from seewhy.dialogue.reference import Experience
from seewhy.revision.record import Counted, SceneLine
from seewhy.revision.table_text import rows_of

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["counted_by", "pictures_after", "remembering"]


def counted_by(
    agent: Agent, dataset: Dataset, picture: Path, cells: Mapping[str, str]
) -> Counted | None:
    """Return the scene that an agent remembers of a picture with a label, and instead of which.

    None where the picture is to test on, has no class, or is remembered otherwise than the
    dataset has it: then nothing that is remembered is about it.
    """
    row = next(iter(rows_of(dataset, picture)), None)
    label = cells.get("class", None if row is None else row.label)
    if label is None or (row is not None and row.split == "test"):
        return None
    digest = digest_of(picture)
    less = None
    if digest in agent.training_pictures.counted:
        if row is None or row.label is None:
            return None
        if not agent.experience.get(row.vector, {}).get(row.label):
            return None
        less = SceneLine(features=row.vector, label=row.label)
    before = {} if row is None else agent.domain.named(row.vector)
    more = SceneLine(features=agent.domain.vector({**before, **cells}), label=label)
    return Counted(less=less, more=more, picture=digest if less is None else None)


def remembering(experience: Experience, counted: Counted) -> Experience:
    """Return what is remembered, with one scene more and one less.

    Examples
    --------
    >>> counted = Counted(less=SceneLine(features=("no",), label="up"),
    ...                   more=SceneLine(features=("yes",), label="down"))
    >>> remembering({("no",): {"up": 1}}, counted)
    {('yes',): {'down': 1}}
    """
    counts = {vector: dict(classes) for vector, classes in experience.items()}
    for scene, step in ((counted.less, -1), (counted.more, 1)):
        if scene is None:
            continue
        classes = counts.setdefault(scene.features, {})
        classes[scene.label] = classes.get(scene.label, 0) + step
        if classes[scene.label] <= 0:
            del classes[scene.label]
        if not classes:
            del counts[scene.features]
    # In the order of the model's file, so that a tree is the same before and after a reload.
    return dict(sorted(counts.items(), key=lambda row: str(row[0])))


def pictures_after(pictures: TrainingPictures, counted: Counted, *, back: bool) -> TrainingPictures:
    """Return the pictures that are remembered, with a new one, or without it again.

    Examples
    --------
    >>> pictures_after(TrainingPictures(), Counted(picture="0a"), back=False).trained_on
    frozenset({'0a'})
    """
    if counted.picture is None:
        return pictures
    one = {counted.picture}
    trained_on = pictures.trained_on - one if back else pictures.trained_on | one
    return replace(pictures, trained_on=trained_on)
