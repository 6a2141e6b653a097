"""Picture files are classified, some at a time, each with its reasons."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from seewhy.data.reading_ahead import read_ahead
from seewhy.dialogue.constant_features import say_only_shown
from seewhy.dialogue.question import Asks, Question
from seewhy.dialogue.reply import Classification
from seewhy.domain.wording import sentence
from seewhy.errors import PictureError
from seewhy.induction.sentence import say_path
from seewhy.perception.picture import Fit, Picture, read_picture

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["BATCH", "ClassifiedPicture", "classify_pictures", "reasons_of"]

BATCH = 128
"""Pictures that are seen at a time; as many are read meanwhile."""


@dataclass(frozen=True)
class ClassifiedPicture:
    """What became of one picture file.

    Attributes
    ----------
    picture : Path
    classification : Classification or None
        None where the file is no picture that can be looked at.
    reasons : str
        Why it is of its class, or why it has none, as a sentence.
    problem : str
        What is wrong with the file; empty where nothing is.
    """

    picture: Path
    classification: Classification | None
    reasons: str = ""
    problem: str = ""


def classify_pictures(
    agent: Agent, pictures: Iterable[Path | str], *, batch: int = BATCH
) -> Iterator[list[ClassifiedPicture]]:
    """Classify any number of picture files; two batches of them are in the memory at a time.

    Parameters
    ----------
    agent : Agent
        A trained one.
    pictures : iterable of Path or str
        Files; :func:`seewhy.data.picture_listing.list_pictures` finds them in folders and tables.
    batch : int, default 128
        How many are yielded at a time; the last may be fewer.

    Yields
    ------
    list of ClassifiedPicture
        In the order of the files. One that cannot be read has a ``problem`` and does not stop the
        others.

    Raises
    ------
    NotFittedError
        If the agent is not trained.

    Examples
    --------
    >>> import tempfile
    >>> import seewhy
    >>> file = Path(tempfile.mkdtemp()) / "a.png"
    >>> _ = file.write_bytes(b"no picture")
    >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
    >>> ((found,),) = classify_pictures(agent, [file])
    >>> found.problem.removeprefix(str(file))
    ' is not a picture of a known type: save it as PNG or JPEG'
    """
    look = partial(_look, size=agent.picture_size, fit=agent.domain.pictures.fit)
    say_why = reasons_of(agent)
    looked = read_ahead(look, map(Path, pictures), ahead=batch)
    while some := list(islice(looked, batch)):
        pixels = [read for _, read in some if not isinstance(read, PictureError)]
        scenes = agent.classify_all(np.stack(pixels)) if pixels else []
        explained = zip(scenes, say_why(scenes), strict=True)
        yield [
            ClassifiedPicture(picture, None, problem=str(read))
            if isinstance(read, PictureError)
            else ClassifiedPicture(picture, *next(explained))
            for picture, read in some
        ]


def _look(picture: Path, *, size: int, fit: Fit) -> tuple[Path, Picture | PictureError]:
    """A picture with its pixels, or with what is wrong with it."""
    try:
        return picture, read_picture(picture, size=size, fit=fit)
    except PictureError as problem:
        return picture, problem


def reasons_of(agent: Agent) -> Callable[[Sequence[Classification]], list[str]]:
    """Return a function that says why scenes are of their class, or why they have none.

    Examples
    --------
    >>> import seewhy
    >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
    >>> reasons_of(agent)([agent.classify_values({"block_displaced": "yes"})])
    ['A block is displaced.']
    """
    questions = {
        question.label: question
        for question in agent.questions.one_of_each()
        if question.asks is Asks.WHY_CLASS
    }

    def question_about(scene: Classification) -> Question | None:
        asked = questions.get(scene.label)
        if scene.method == "tree" and (asked is None or agent.answerer is None):
            # Without the recurrent network, or words to ask it with, the tree speaks for itself.
            return None
        return asked or Question(Asks.WHY_CLASS, text="", words=(), label=scene.label)

    def say(scenes: Sequence[Classification]) -> list[str]:
        asked = [(scene, question_about(scene)) for scene in scenes]
        replies = iter(
            agent.answer_all(
                [(scene, question) for scene, question in asked if question is not None]
            )
        )
        return [
            next(replies).text if question is not None else by_tree(scene)
            for scene, question in asked
        ]

    def by_tree(scene: Classification) -> str:
        path = agent.tree.path(scene.vector)
        features = [condition.feature for condition in path.conditions]
        only = say_only_shown(agent.domain, features, agent.only_shown)
        said = [say_path(agent.domain, path), *([only] if only else [])]
        return " ".join(map(sentence, said))

    return say
