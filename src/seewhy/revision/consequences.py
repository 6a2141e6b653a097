"""What a revision of the knowledge would change: every annotated scene, decided again."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.data.dataset import Dataset
from seewhy.dialogue.reference import Experience
from seewhy.knowledge.reasoner import Decision, Reasoner, Verdict

__all__ = ["ChangedScene", "Consequences", "Standing", "annotated_scenes", "consequences"]

_CONTRADICTORY = (Verdict.CONTRADICTION, Verdict.NO_ANSWER_SET)


class Standing(StrEnum):
    """What the knowledge makes of an annotated scene."""

    RIGHT = "right"
    WRONG = "wrong"
    OPEN = "left open"


@dataclass(frozen=True)
class ChangedScene:
    """An annotated scene that the revised knowledge decides otherwise.

    Attributes
    ----------
    picture : str
        Its name; empty where it is not known.
    label : str
        Of which class it is annotated to be.
    before, after : str or None
        The class that the knowledge concludes; None where it leaves the scene open.
    contradictory : bool
        Whether it is left open because the revised knowledge contradicts itself there, and the
        knowledge before did not.
    """

    picture: str
    label: str
    before: str | None
    after: str | None
    contradictory: bool = False

    @property
    def was(self) -> Standing:
        """What the knowledge made of it."""
        return _standing(self.before, self.label)

    @property
    def becomes(self) -> Standing:
        """What the revised knowledge makes of it."""
        return _standing(self.after, self.label)


@dataclass(frozen=True)
class Consequences:
    """What a revision does to annotated scenes.

    Attributes
    ----------
    scenes : int
        How many were decided again.
    changed : tuple of ChangedScene
        Those that are decided otherwise, in their order.
    """

    scenes: int
    changed: tuple[ChangedScene, ...]

    def moved(self, was: Standing, becomes: Standing) -> tuple[ChangedScene, ...]:
        """The scenes that go from one standing to another."""
        return tuple(
            scene for scene in self.changed if (scene.was, scene.becomes) == (was, becomes)
        )

    @property
    def contradictions(self) -> tuple[ChangedScene, ...]:
        """The scenes on which the revised knowledge contradicts itself, and did not before."""
        return tuple(scene for scene in self.changed if scene.contradictory)

    @property
    def lost(self) -> int:
        """How many scenes are decided rightly no more."""
        return sum(scene.was is Standing.RIGHT for scene in self.changed)

    @property
    def mended(self) -> int:
        """How many scenes are decided wrongly no more."""
        return sum(scene.was is Standing.WRONG for scene in self.changed)

    @property
    def gained(self) -> int:
        """How many scenes are decided rightly that were not before."""
        return sum(
            scene.becomes is Standing.RIGHT and scene.was is not Standing.RIGHT
            for scene in self.changed
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the consequences as values that JSON can hold."""
        return {
            "scenes": self.scenes,
            "changed": [
                {
                    "picture": scene.picture,
                    "class": scene.label,
                    "before": scene.before,
                    "after": scene.after,
                    "was": scene.was.value,
                    "becomes": scene.becomes.value,
                    "contradictory": scene.contradictory,
                }
                for scene in self.changed
            ],
        }


def consequences(before: Reasoner, after: Reasoner, scenes: AnnotatedScenes) -> Consequences:
    """Decide annotated scenes with the knowledge as it is and as it would be.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> less = replace(domain.knowledge, axioms=domain.knowledge.axioms[1:])
    >>> scenes = AnnotatedScenes((("2", "wide", "no", "yes"),), ("unstable",), ("a.png",))
    >>> found = consequences(
    ...     Reasoner(less, domain.schema), Reasoner(domain.knowledge, domain.schema), scenes
    ... )
    >>> [(scene.picture, scene.before, scene.after) for scene in found.changed]
    [('a.png', 'stable', None)]
    """
    was, becomes = before.decide_all(scenes.vectors), after.decide_all(scenes.vectors)
    changed = [
        ChangedScene(picture, label, old.label, new.label, _newly_contradictory(old, new))
        for picture, label, old, new in zip(
            scenes.pictures, scenes.labels, was, becomes, strict=True
        )
        if old.label != new.label or _newly_contradictory(old, new)
    ]
    return Consequences(len(scenes.vectors), tuple(changed))


def annotated_scenes(dataset: Dataset | None, experience: Experience) -> AnnotatedScenes:
    """Return the scenes with a class of a dataset; without one, those that are remembered.

    Examples
    --------
    >>> annotated_scenes(None, {("a",): {"x": 2}}).labels
    ('x', 'x')
    """
    if dataset is None:
        return AnnotatedScenes.of_experience(experience)
    classed = dataset.with_class()
    return AnnotatedScenes(
        tuple(classed.vectors),
        tuple(classed.classes),
        tuple(classed.name_of(scene) for scene in classed.scenes),
    )


def _newly_contradictory(old: Decision, new: Decision) -> bool:
    return new.verdict in _CONTRADICTORY and old.verdict not in _CONTRADICTORY


def _standing(concluded: str | None, label: str) -> Standing:
    if concluded is None:
        return Standing.OPEN
    return Standing.RIGHT if concluded == label else Standing.WRONG
