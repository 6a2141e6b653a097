"""What the pages of one running studio share."""

from __future__ import annotations

from dataclasses import dataclass

from fastapi import Request

from seewhy.studio.per_session import PerSession
from seewhy.studio.project import Project
from seewhy.studio.project_model import ProjectModel
from seewhy.studio.project_things import ProjectThings
from seewhy.studio.proposing import Proposer
from seewhy.studio.talk import Talk
from seewhy.studio.thing_talk import ThingTalk
from seewhy.studio.trail import Trail

__all__ = ["Studio", "studio_of"]


@dataclass(frozen=True)
class Studio:
    """What the pages share.

    Attributes
    ----------
    project : Project
    proposer : Proposer
        Looks at pictures and trains heads behind the pages' back.
    trails : PerSession of Trail
        Which pictures each browser was shown.
    model : ProjectModel
        Answers the questions.
    talks : PerSession of Talk
        What each browser asked.
    things : ProjectThings
        Answers the questions about pictures of several things.
    thing_talks : PerSession of ThingTalk
        What each browser asked about such.
    local : bool
        Whether only browsers of this machine are let in, who may name its paths.
    """

    project: Project
    proposer: Proposer
    trails: PerSession[Trail]
    model: ProjectModel
    talks: PerSession[Talk]
    things: ProjectThings
    thing_talks: PerSession[ThingTalk]
    local: bool

    @property
    def answering(self) -> ProjectModel | ProjectThings:
        """What answers questions about the project's pictures, of whichever kind they are."""
        return self.things if self.project.has_things else self.model

    def talk_of(self, session: str) -> Talk | ThingTalk:
        """What a browser asks about a picture of the project's kind."""
        return (self.thing_talks if self.project.has_things else self.talks).of(session)


def studio_of(request: Request) -> Studio:
    """The studio that a request came to."""
    studio = request.app.state.studio
    assert isinstance(studio, Studio)
    return studio
