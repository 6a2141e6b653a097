"""A project's model of several things in a picture: loaded once, with the domain as it stands."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from threading import RLock
from typing import TYPE_CHECKING

from seewhy.errors import SeeWhyError
from seewhy.studio.model_there import Missing, missing_of, stamp_of
from seewhy.studio.project import Project

if TYPE_CHECKING:
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.agent.things.thing_reply import ReadScene
    from seewhy.domain.domain import Domain

__all__ = ["ProjectThings"]

_REMEMBERED = 200
"""Pictures of which it is remembered what they show."""


class ProjectThings:
    """What answers questions about the things in the pictures of a project.

    What sees is the model's. What is known, and the words for it, are the domain's by now, so that
    a revision holds at once, as long as things have the same features and relations.

    Parameters
    ----------
    project : Project
    """

    def __init__(self, project: Project) -> None:
        self.project = project
        self._lock = RLock()
        self._loaded: tuple[tuple[int, ...], ThingAgent] | None = None
        self._knowing: tuple[ThingAgent, Domain, ThingAgent] | None = None
        self._read: OrderedDict[tuple[object, ...], ReadScene] = OrderedDict()

    @property
    def missing(self) -> Missing | None:
        """What there must be before a question can be answered; None where all is there."""
        return missing_of(self.project)

    @contextmanager
    def at_work(self) -> Iterator[ThingAgent]:
        """The agent, for one thread at a time: what reasons is not shared.

        Raises
        ------
        SeeWhyError
            If there is none, or its folder is damaged.
        """
        with self._lock:
            yield self._agent()

    @property
    def trained_for_this(self) -> bool:
        """Whether the model has the features and relations that the domain has by now."""
        with self.at_work() as agent:
            return _sees_alike(agent.domain, self.project.domain())

    def look(self, picture: str) -> ReadScene:
        """What a picture of the project is taken to show.

        Raises
        ------
        LookupError
            If it is no picture of the project.
        PictureError
            If it cannot be read.
        """
        file = self.project.picture_file(picture)
        with self.at_work() as agent:
            key = (id(agent), picture, file.stat().st_mtime_ns)
            if key not in self._read:
                self._read[key] = agent.scene_of(agent.read(file))
                while len(self._read) > _REMEMBERED:
                    self._read.popitem(last=False)
            return self._read[key]

    def _agent(self) -> ThingAgent:
        missing = self.missing
        if missing is not None:
            raise SeeWhyError(f"{missing.sentence} The page {missing.words} does that.")
        stamp = stamp_of(self.project)
        if self._loaded is None or self._loaded[0] != stamp:
            from seewhy.agent.things.thing_agent import ThingAgent

            self._loaded = stamp, ThingAgent.load(self.project.model_folder)
            self._read.clear()
        agent, domain = self._loaded[1], self.project.domain()
        if not _sees_alike(agent.domain, domain):
            return agent
        if self._knowing is None or self._knowing[0] is not agent or self._knowing[1] is not domain:
            self._knowing = agent, domain, _following(agent, domain)
            self._read.clear()
        return self._knowing[2]


def _following(agent: ThingAgent, domain: Domain) -> ThingAgent:
    """An agent that sees as the model does, and knows what a domain says."""
    from seewhy.agent.things.thing_agent import ThingAgent

    settings = agent.settings
    follower = ThingAgent(domain, seed=settings.seed, eyes=settings.eyes, device=settings.device)
    follower.seeing, follower.trained_on = agent.seeing, agent.trained_on
    return follower


def _sees_alike(one: Domain, other: Domain) -> bool:
    """Whether what is seen for one domain can be reasoned about with the other."""
    if one.things is None or other.things is None or one.schema != other.schema:
        return False
    measures = [
        {key: relation.measure for key, relation in things.relations.items()}
        for things in (one.things, other.things)
    ]
    return measures[0] == measures[1]
