"""How far labelling has come, a feature and a value, and what would help most."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from seewhy.domain.tables import CLASS
from seewhy.domain.things import Things
from seewhy.evaluation.advice import Shown, few_pictures
from seewhy.evaluation.share import Share
from seewhy.new_domain.words import plain_words
from seewhy.studio.drawn_things import PictureThings, counted
from seewhy.studio.project import Project
from seewhy.studio.proposing import Proposals

__all__ = ["Progress", "QuestionProgress", "ValueProgress", "progress_of"]

_FEWEST = 10
"""Of fewer pictures it is not told how many are recognised."""


@dataclass(frozen=True)
class ValueProgress:
    """How many pictures show a value, and how well it is recognised where it was kept out."""

    value: str
    labelled: int
    recognised: Share | None

    @property
    def words(self) -> str:
        """The value in plain words."""
        return plain_words(self.value)


@dataclass(frozen=True)
class QuestionProgress:
    """How far a feature, or the class, has come."""

    name: str
    words: str
    labelled: int
    values: tuple[ValueProgress, ...]

    @property
    def recognised(self) -> Share | None:
        """Of the pictures kept out, all values together."""
        shares = [value.recognised for value in self.values if value.recognised is not None]
        if not shares:
            return None
        return Share(sum(share.right for share in shares), sum(share.of for share in shares))


@dataclass(frozen=True)
class Progress:
    """How far labelling has come.

    Attributes
    ----------
    pictures, complete : int
        All pictures, and those of which everything is said.
    things : int
        Things that are drawn.
    questions : tuple of QuestionProgress
        Of pictures.
    of_things : tuple of QuestionProgress
    advice : tuple of str
        As ``seewhy evaluate`` gives it, with figures of heads on pictures kept out.
    """

    pictures: int
    complete: int
    things: int
    questions: tuple[QuestionProgress, ...]
    of_things: tuple[QuestionProgress, ...]
    advice: tuple[str, ...]

    @property
    def differs(self) -> bool:
        """Whether pictures of two classes are labelled, so that there is something to learn."""
        classes = next(
            (question.values for question in self.questions if question.name == CLASS), ()
        )
        return sum(value.labelled > 0 for value in classes) > 1

    @property
    def recognised(self) -> Share | None:
        """How often the heads recognise the class of labelled pictures that were kept out.

        None of so few that the share would say nothing.
        """
        found = (question.recognised for question in self.questions if question.name == CLASS)
        share = next(found, None)
        return None if share is None or share.of < _FEWEST else share


def progress_of(project: Project, proposals: Proposals) -> Progress:
    """Count what is labelled."""
    domain, labels = project.domain(), project.labels()
    there = set(project.pictures())
    names = {key: feature.values for key, feature in domain.features.items()}
    if domain.classes:
        names = {CLASS: tuple(domain.classes), **names}
    counts: dict[str, Counter[str]] = {name: Counter() for name in names}
    complete = sum(labels.is_complete(picture, domain) for picture in there)
    for picture, said in labels.of.items():
        if picture not in there:
            continue
        for name, label in said.items():
            if name in counts:
                counts[name][label.value] += 1
    questions = tuple(
        QuestionProgress(
            name,
            "class" if name == CLASS else domain.features[name].name,
            counts[name].total(),
            tuple(
                ValueProgress(value, counts[name][value], _recognised(proposals, name, place))
                for place, value in enumerate(values)
            ),
        )
        for name, values in names.items()
    )
    advice = few_pictures(
        Shown(question.name, value.value, value.labelled, value.recognised)
        for question in questions
        for value in question.values
    )
    sentences = tuple(f"{sentence[:1].upper()}{sentence[1:]}" for sentence in advice)
    drawn = [here for picture, here in labels.drawn.items() if picture in there]
    return Progress(
        pictures=len(there),
        complete=complete,
        things=sum(len(here.things) for here in drawn),
        questions=questions,
        of_things=_of_things(domain.things, drawn),
        advice=sentences if complete else (),
    )


def _of_things(
    things: Things | None, drawn: Sequence[PictureThings]
) -> tuple[QuestionProgress, ...]:
    found = []
    for key, feature in ({} if things is None else things.features).items():
        counts = counted(drawn, key)
        values = tuple(ValueProgress(value, counts[value], None) for value in feature.values)
        found.append(QuestionProgress(key, feature.name, counts.total(), values))
    return tuple(found)


def _recognised(proposals: Proposals, name: str, place: int) -> Share | None:
    judged = proposals.judged.get(name)
    if judged is None or place >= len(judged.shown) or not judged.shown[place]:
        return None
    return Share(judged.right[place], judged.shown[place])
