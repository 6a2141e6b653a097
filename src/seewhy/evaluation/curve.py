"""A learning curve: train on growing parts of the pictures, evaluate on the same held-out ones."""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.data.making import determined_share
from seewhy.data.training_needs import require_feature_labels, require_two_classes
from seewhy.errors import DatasetError, ModelError
from seewhy.evaluation.judging import classified
from seewhy.evaluation.other_knowledge import with_axioms
from seewhy.evaluation.recognition import (
    Recognition,
    recognition_of_class,
    recognition_of_features,
)

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.data.dataset import Dataset

__all__ = ["CurvePoint", "LearningCurve", "growing_parts", "learning_curve", "require_splits"]

HALVINGS = 3
"""The least part is an eighth of the pictures."""


@dataclass(frozen=True)
class CurvePoint:
    """What a model trained on some of the pictures does on the held-out ones.

    Attributes
    ----------
    pictures : int
        Trained on.
    class_recognition : Recognition
    feature_recognition : dict
        Feature → Recognition.
    right : tuple of bool
        For every held-out picture that has a class, whether it was classified rightly.
    """

    pictures: int
    class_recognition: Recognition
    feature_recognition: dict[str, Recognition]
    right: tuple[bool, ...]


@dataclass(frozen=True)
class LearningCurve:
    """Accuracies for growing numbers of training pictures.

    Attributes
    ----------
    points : tuple of CurvePoint
        The fewest pictures first; the last has all of them.
    held_out : int
        Pictures with a class that every point was evaluated on.
    skipped : tuple of (int, str)
        Parts that no model could be trained on: their number of pictures, and why not.
    determined : float
        The share of the held-out classes that the annotated features tell at best.
    """

    points: tuple[CurvePoint, ...]
    held_out: int
    skipped: tuple[tuple[int, str], ...] = ()
    determined: float = 1.0

    def sentences(self) -> tuple[str, ...]:
        """Say in words whether more labels would help."""
        from seewhy.evaluation.curve_advice import curve_advice

        return curve_advice(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the curve as values that JSON can hold."""
        return {
            "held_out": self.held_out,
            "determined": self.determined,
            "points": [
                {
                    "pictures": point.pictures,
                    "classification_accuracy": point.class_recognition.confusion.share.value,
                    "interval": list(point.class_recognition.confusion.share.interval),
                    "feature_accuracy": {
                        key: recognition.confusion.share.value
                        for key, recognition in point.feature_recognition.items()
                    },
                }
                for point in self.points
            ],
            "skipped": [{"pictures": count, "reason": why} for count, why in self.skipped],
            "advice": list(self.sentences()),
        }


def require_splits(dataset: Dataset) -> None:
    """Raise a DatasetError if a dataset keeps no pictures for evaluation."""
    if not any(scene.split for scene in dataset.scenes):
        raise DatasetError(
            f"{dataset.table.name}: a learning curve needs pictures that are kept for evaluation; "
            "add a column split, with train and test"
        )


def growing_parts(train: Dataset, *, seed: int = 0) -> list[Dataset]:
    """Return about an eighth, a quarter, a half and all of the pictures, each within the next.

    Groups stay whole, every class gives its share, and none loses its last group.
    """
    from seewhy.perception.validation import split

    parts = [train]
    for _ in range(HALVINGS):
        part = parts[0]
        kept, _left = split(part.labels, share=0.5, seed=seed, groups=part.groups)
        if len(kept) < len(part):
            parts.insert(0, part.take([int(position) for position in kept]))
    return parts


def learning_curve(
    agent: Agent,
    dataset: Dataset,
    folder: Path | str,
    *,
    on_part: Callable[[int], None] | None = None,
    on_progress: Callable[[Any], None] | None = None,
    on_point: Callable[[CurvePoint], None] | None = None,
) -> LearningCurve:
    """Train as an agent was trained on growing parts of a dataset, and evaluate each.

    The networks begin anew for every part, and every picture is answered. Models that were trained
    are kept in ``folder`` and found there again, as long as the pictures, their annotation, the
    domain and the options are the same; a training that was interrupted goes on where it was.

    Parameters
    ----------
    agent : Agent
        Whose given domain and options the models have; its networks and what it learned are not
        used.
    dataset : Dataset
        With the splits "train" and "test".
    folder : Path or str
    on_part : callable, optional
        Called with the number of pictures before a model is trained on them.
    on_progress : callable, optional
        As of :meth:`seewhy.Agent.fit`.
    on_point : callable, optional
        Called with every finished point.

    Raises
    ------
    DatasetError
        If the dataset has no pictures that are kept for evaluation, or too few to train on.
    """
    require_splits(dataset)
    test = dataset.of_split("test")
    train = dataset.of_split("train").without_classes(agent.without).annotated()
    points: list[CurvePoint] = []
    skipped: list[tuple[int, str]] = []
    for part in growing_parts(train, seed=agent.seed):
        try:
            require_two_classes(part)
            require_feature_labels(part)
        except DatasetError as problem:
            if len(part) == len(train):
                raise
            skipped.append((len(part), str(problem)))
            continue
        if on_part is not None:
            on_part(len(part))
        model = _trained(agent, part, Path(folder), on_progress=on_progress)
        found = classified(model, test)
        pairs = zip(found, test.labels, strict=True)
        points.append(
            CurvePoint(
                len(part),
                recognition_of_class(test, found),
                recognition_of_features(test, found),
                tuple(scene.label == label for scene, label in pairs if label is not None),
            )
        )
        if on_point is not None:
            on_point(points[-1])
    judged = test.with_class()
    determined = determined_share(judged.vectors, judged.classes)
    return LearningCurve(tuple(points), len(judged), tuple(skipped), determined)


def _trained(
    like: Agent,
    part: Dataset,
    folder: Path,
    *,
    on_progress: Callable[[Any], None] | None,
) -> Agent:
    """The model in ``folder`` that was trained on these pictures, or else a new one."""
    from seewhy.agent.agent import Agent

    model = with_axioms(like, (), ())
    # Of few pictures no model knows when to say that it does not know: more would seem worse.
    model.known_share = 1.0
    place = folder / f"{len(part)}-{_identity(model, part)}"
    try:
        return Agent.load(place)
    except ModelError:
        pass  # not trained yet, or not by this version
    checkpoints = folder / f"{place.name}.training"
    # Answers would be learned as well, but nobody asks questions here.
    model.fit(part, answers=False, checkpoints=checkpoints, on_progress=on_progress)
    model.save(place)
    shutil.rmtree(checkpoints, ignore_errors=True)
    return model


def _identity(like: Agent, part: Dataset) -> str:
    """What tells a training from others: the pictures, what is said of them, domain, options."""
    from seewhy.domain.folder import FILES

    rows = zip(part.picture_digests(), part.vectors, part.labels, part.groups, strict=True)
    texts = [(like.given.folder / name).read_text(encoding="utf-8") for name in FILES]
    # Where an agent computes is nothing that its models depend on.
    options = asdict(replace(like.settings, device="auto"))
    said = json.dumps([list(rows), texts, options], sort_keys=True)
    return hashlib.sha256(said.encode()).hexdigest()[:12]
