"""ThingAgent: a picture becomes things, things a scene that can be, a question an answer."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from seewhy.agent.settings import settings_for
from seewhy.agent.things.thing_model import ThingModel, read_thing_model, write_thing_model
from seewhy.agent.things.thing_reading import SceneReader, ThingReading
from seewhy.agent.things.thing_reply import PictureReply, ReadScene
from seewhy.agent.things.thing_seeing import ThingSeeing
from seewhy.dialogue.things.answering import ThingAnswerer
from seewhy.domain.domain import Domain
from seewhy.domain.key_place import KeyPlace
from seewhy.domain.things import Things
from seewhy.errors import DatasetError, DomainError, NotFittedError
from seewhy.knowledge.reasoner import Reasoner
from seewhy.perception.backbones import EMBEDDED, NONE
from seewhy.perception.course import Course
from seewhy.perception.things.boxes import Boxes, in_order
from seewhy.perception.things.given_detector import OnnxDetector, as_detector
from seewhy.text.nearest import did_you_mean

if TYPE_CHECKING:
    from seewhy.agent.things.thing_seeing import Picture
    from seewhy.data.dataset import Dataset
    from seewhy.data.thing import BoundingBox
    from seewhy.perception.things.detector import Detector
    from seewhy.perception.things.given_detector import Find

__all__ = ["ThingAgent"]

BATCH = 16
"""Pictures that are in the memory at a time."""


class ThingAgent:
    """Answers questions about pictures that show several things, and says why.

    Use it when your domain has ``[things]`` and some pictures have boxes around theirs
    (``things.csv``). What sees is taught by the boxes and their values; the knowledge says which
    scenes can be; questions are about what is there, how much of it, and how it lies to each other.

    Parameters
    ----------
    domain : Domain
        With things.
    seed, eyes, device : optional
        As for :class:`~seewhy.agent.agent.Agent`.

    Raises
    ------
    DomainError
        If the domain has no things, or an option is out of its range.

    Examples
    --------
    >>> import seewhy
    >>> agent = seewhy.ThingAgent(seewhy.load_domain("tabletop"))
    >>> agent.is_trained
    False
    """

    def __init__(
        self, domain: Domain, *, seed: int = 0, eyes: str | None = None, device: str = "auto"
    ) -> None:
        if domain.things is None:
            raise DomainError(
                f"the domain '{domain.name}' has no things; load it with seewhy.Agent, or add "
                "[things] to its domain.toml"
            )
        said = domain.eyes_after(0) if eyes is None else eyes
        if said == NONE:
            raise DomainError(_none_sees(domain, given=eyes is not None))
        self.domain = domain
        self.things = domain.things
        self.settings = settings_for(domain, eyes=said, device=device, seed=seed)
        self.seeing: ThingSeeing | None = None
        self.trained_on: frozenset[str] = frozenset()

    @property
    def is_trained(self) -> bool:
        """Whether anything sees yet."""
        return self.seeing is not None

    @property
    def trained(self) -> ThingSeeing:
        """What sees.

        Raises
        ------
        NotFittedError
            If nothing does yet.
        """
        if self.seeing is None:
            raise NotFittedError("the agent is not trained yet; call fit, or load a model")
        return self.seeing

    def knowing(self, domain: Domain) -> ThingAgent:
        """Return an agent that sees as this one does, and knows what another domain says.

        The things of both have the same features and relations.
        """
        settings = self.settings
        follower = ThingAgent(
            domain, seed=settings.seed, eyes=settings.eyes, device=settings.device
        )
        follower.seeing, follower.trained_on = self.seeing, self.trained_on
        return follower

    # Learning ---------------------------------------------------------------------------------

    def fit(
        self,
        dataset: Dataset,
        *,
        detector: Detector | Find | None = None,
        checkpoints: Path | None = None,
        on_progress: Callable[[Any], None] | None = None,
    ) -> Self:
        """Train on the scenes of a dataset (those with split "train", where there are splits).

        Parameters
        ----------
        dataset : Dataset
            With ``things.csv``.
        detector : Detector or callable, optional
            One's own, which finds the boxes (see
            :data:`~seewhy.perception.things.given_detector.Find`); without it the domain's, and
            where it has none, one that is trained on annotated boxes.
        checkpoints, on_progress : optional
            How the training is run; see :class:`~seewhy.perception.course.Course`.

        Raises
        ------
        DatasetError
            If the dataset is of another domain, has no boxes, too few, or no value of a feature.
        """
        from seewhy.agent.things.thing_fitting import fitted_seeing

        course = Course(checkpoints=checkpoints, on_progress=on_progress)
        scenes, self.seeing = fitted_seeing(
            dataset,
            self.settings,
            detector=self._detector() if detector is None else as_detector(detector),
            course=course,
        )
        self.trained_on = frozenset(scenes.picture_digests())
        return self

    def _detector(self) -> Detector | None:
        """The domain's own detector, where it names one."""
        name = self.things.detector
        return None if name is None else OnnxDetector(self.domain.folder / name)

    # Reading ----------------------------------------------------------------------------------

    @cached_property
    def reasoner(self) -> Reasoner:
        """What reasons with the domain's knowledge."""
        return Reasoner(self.domain.knowledge, self.domain.schema)

    @cached_property
    def reader(self) -> SceneReader:
        """What makes a scene that can be of what is seen."""
        return SceneReader(self.domain, self.reasoner)

    def read(
        self,
        picture: Picture,
        *,
        boxes: Sequence[BoundingBox] | None = None,
        values: Sequence[Mapping[str, str]] = (),
    ) -> ThingReading:
        """Return what a picture is taken to show.

        Parameters
        ----------
        picture : path, Pillow image or array
        boxes : sequence of BoundingBox, optional
            Where the things are, where somebody knows it.
        values : sequence of mapping, optional
            With ``boxes``: what somebody knows of each, feature → value.

        Raises
        ------
        NotFittedError, PictureError
            If nothing sees yet; if it is no picture.
        DatasetError
            If there are not as many ``values`` as ``boxes``, or they name no feature or value.
        """
        _check_said(values, len(boxes or ()), self.things)
        if boxes is None:
            return self.reader.read(self.trained.look([picture])[0])
        found = _rows_of(boxes)
        order = in_order(found)
        sighting = self.trained.look([picture], [found[order]])[0]
        if values:
            sighting = sighting.told([values[number] for number in order], self.things)
        return self.reader.read(sighting)

    def read_all(
        self,
        pictures: Sequence[Picture],
        *,
        boxes: Sequence[Sequence[BoundingBox] | None] | None = None,
    ) -> Iterator[ThingReading]:
        """Yield what pictures are taken to show, a few at a time; see :meth:`read`."""
        given = [None] * len(pictures) if boxes is None else boxes
        for start in range(0, len(pictures), BATCH):
            some = slice(start, start + BATCH)
            places = [None if order is None else _in_order(order) for order in given[some]]
            for sighting in self.trained.look(pictures[some], places):
                yield self.reader.read(sighting)

    # Answering --------------------------------------------------------------------------------

    @cached_property
    def answerer(self) -> ThingAnswerer:
        """What understands questions about things."""
        return ThingAnswerer(self.things)

    def scene_of(self, reading: ThingReading) -> ReadScene:
        """Return what was read as a scene to be asked about."""
        return ReadScene(self.domain, reading, self.reasoner)

    def answer(
        self, question: str, scene: ReadScene, *, previous: PictureReply | None = None
    ) -> PictureReply:
        """Answer a question about a picture that was read.

        ``previous`` is the answer before, to which "it", "why?" and "and the red one?" go.

        Raises
        ------
        QuestionError
            If the question is not understood.
        """
        before = None if previous is None else previous.reply
        reply = self.answerer.answer(question, scene.scene, previous=before)
        probability, least_sure = scene.doubt(reply)
        return PictureReply(reply, scene, probability, least_sure)

    def ask(
        self, picture: Picture, question: str, *, boxes: Sequence[BoundingBox] | None = None
    ) -> PictureReply:
        """Answer a question about a picture.

        Raises
        ------
        NotFittedError, PictureError, QuestionError
            If nothing sees yet; if it is no picture; if the question is not understood.
        """
        return self.answer(question, self.scene_of(self.read(picture, boxes=boxes)))

    # On disk ----------------------------------------------------------------------------------

    def save(self, folder: Path | str) -> None:
        """Write the model to a folder, whole or not at all.

        Raises
        ------
        NotFittedError, ModelError
            If the agent is not trained yet; if the folder is there and is no model.
        """
        model = ThingModel(self.trained, self.settings.seed, self.trained_on)
        write_thing_model(model, Path(folder))

    @classmethod
    def load(
        cls, folder: Path | str, *, device: str = "auto", detector: Detector | Find | None = None
    ) -> Self:
        """Read a model.

        Parameters
        ----------
        folder : Path or str
        device : str
        detector : Detector or callable, optional
            One's own, where the model was trained with it.

        Raises
        ------
        ModelError
            If the folder is incomplete, was edited, or was made by another version.
        """
        finds = None if detector is None else as_detector(detector)
        model = read_thing_model(Path(folder), device=device, detector=finds)
        seeing = model.seeing
        agent = cls(
            seeing.domain, seed=model.seed, eyes=seeing.eyes.eyes.backbone.name, device=device
        )
        agent.seeing, agent.trained_on = seeing, model.trained_on
        return agent


def _none_sees(domain: Domain, *, given: bool) -> str:
    """That networks that grow see no things, with the place where they are asked for."""
    why = "networks that grow see one thing in a picture, and things are seen by a backbone"
    if given:
        return f"eyes 'none': {why}, such as '{EMBEDDED}'"
    place = KeyPlace(domain.folder / "domain.toml").at("domain", "eyes")
    return (
        f"{place}: eyes = 'none' sees no things: {why}; leave the line out, or name one such as "
        f"'{EMBEDDED}'"
    )


def _check_said(said: Sequence[Mapping[str, str]], boxes: int, things: Things) -> None:
    if said and len(said) != boxes:
        raise DatasetError(
            f"'values' must have one entry for each of {boxes} boxes, got {len(said)}"
        )
    for of_thing in said:
        for key, value in of_thing.items():
            if key not in things.features:
                raise DatasetError(
                    f"'{key}' is no feature of things; {did_you_mean(key, things.features)}"
                )
            known = things.features[key].values
            if value not in known:
                raise DatasetError(
                    f"'{value}' is no value of '{key}'; {did_you_mean(value, known)}"
                )


def _rows_of(boxes: Sequence[BoundingBox]) -> Boxes:
    rows = [[box.left, box.top, box.right, box.bottom] for box in boxes]
    return np.array(rows, dtype=np.float64).reshape(-1, 4)


def _in_order(boxes: Sequence[BoundingBox]) -> Boxes:
    """Boxes as an array, from the left to the right."""
    found = _rows_of(boxes)
    return found[in_order(found)]
