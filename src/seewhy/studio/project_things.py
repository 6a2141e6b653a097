"""A project's model of several things in a picture: loaded once, with the domain as it stands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seewhy.studio.answering_agent import AnsweringAgent
from seewhy.studio.project import Project

if TYPE_CHECKING:
    from seewhy.agent.things.thing_agent import ThingAgent
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
            return self._seen.get(key, lambda: agent.scene_of(agent.read(file)))

    def _load(self) -> ThingAgent:
        from seewhy.agent.things.thing_agent import ThingAgent

        return ThingAgent.load(self.project.model_folder)

    def _knowing_now(self, agent: ThingAgent) -> ThingAgent:
        domain = self.project.domain()
        if not _sees_alike(agent.domain, domain):
            return agent
        if self._knowing is None or self._knowing[0] is not agent or self._knowing[1] is not domain:
            self._knowing = agent, domain, _following(agent, domain)
            self._forget()
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
