"""A project's model of several things in a picture: loaded once, with the domain as it stands."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy.studio.answering_agent import CORRECTED, AnsweringAgent
from seewhy.studio.drawn_things import BOXES, DrawnThing
from seewhy.studio.labelling import pictures_of
from seewhy.studio.project import Project

if TYPE_CHECKING:
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.agent.things.thing_reading import ThingReading
    from seewhy.agent.things.thing_reply import ReadScene
    from seewhy.domain.domain import Domain

__all__ = ["ProjectThings"]


class ProjectThings(AnsweringAgent["ThingAgent", "ReadScene"]):
    """What answers questions about the things in the pictures of a project.

    What is known, and the words for it, are the domain's by now, as long as things have the same
    features and relations.

    Parameters
    ----------
    project : Project
    """

    def __init__(self, project: Project) -> None:
        super().__init__(project)
        self._knowing: tuple[ThingAgent, Domain, ThingAgent] | None = None

    @property
    def trained_for_this(self) -> bool:
        """Whether the model has the features and relations that the domain has by now."""
        with self.at_work() as agent:
            return _sees_alike(agent.domain, self.project.domain())

    def look(self, picture: str) -> ReadScene:
        """What a picture of the project is taken to show, with what was corrected since training.

        Where something was, things are where its boxes say.

        Raises
        ------
        LookupError
            If it is no picture of the project.
        PictureError
            If it cannot be read.
        """
        file = self.project.picture_file(picture)
        with self.at_work() as agent:
            corrected = self._corrected(picture)
            key = (id(agent), picture, file.stat().st_mtime_ns, _key_of(corrected))
            return self._seen.get(key, lambda: agent.scene_of(_read(agent, file, corrected)))

    def _corrected(self, picture: str) -> Sequence[DrawnThing] | None:
        """The things with boxes, where an answer was corrected since training; else None."""
        since = self._trained_at()
        if not any(
            entry.at > since and entry.body["how"] == CORRECTED and picture in pictures_of(entry)
            for entry in self.project.record.holding(BOXES)
        ):
            return None
        drawn = self.project.labels().drawn_in(picture).things.values()
        return tuple(thing for thing in drawn if thing.box is not None)

    def _load(self) -> ThingAgent:
        from seewhy.agent.things.thing_agent import ThingAgent

        return ThingAgent.load(self.project.model_folder)

    def _knowing_now(self, agent: ThingAgent) -> ThingAgent:
        domain = self.project.domain()
        if not _sees_alike(agent.domain, domain):
            return agent
        if self._knowing is None or self._knowing[0] is not agent or self._knowing[1] is not domain:
            self._knowing = agent, domain, agent.knowing(domain)
            self._forget()
        return self._knowing[2]


def _key_of(corrected: Sequence[DrawnThing] | None) -> object:
    """What is another where something else was corrected."""
    if corrected is None:
        return None
    return tuple((thing.box, tuple(_said_of(thing).items())) for thing in corrected)


def _said_of(thing: DrawnThing) -> dict[str, str]:
    """What a correction says of a thing."""
    return {key: label.value for key, label in thing.values.items() if label.how == CORRECTED}


def _read(agent: ThingAgent, file: Path, corrected: Sequence[DrawnThing] | None) -> ThingReading:
    if corrected is None:
        return agent.read(file)
    features = agent.things.features
    said = [
        {
            key: value
            for key, value in _said_of(thing).items()
            if key in features and value in features[key].values
        }
        for thing in corrected
    ]
    boxes = [thing.box for thing in corrected if thing.box is not None]
    return agent.read(file, boxes=boxes, values=said)


def _sees_alike(one: Domain, other: Domain) -> bool:
    """Whether what is seen for one domain can be reasoned about with the other."""
    if one.things is None or other.things is None or one.schema != other.schema:
        return False
    measures = [
        {key: relation.measure for key, relation in things.relations.items()}
        for things in (one.things, other.things)
    ]
    return measures[0] == measures[1]
