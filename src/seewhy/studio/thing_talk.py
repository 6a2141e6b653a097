"""What one browser asks about the things in one picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seewhy.studio.offered import Offers

if TYPE_CHECKING:
    from seewhy.agent.things.thing_reply import PictureReply, ReadScene

__all__ = ["ThingTalk"]

_REMEMBERED = 20


class ThingTalk(Offers):
    """A conversation about what was read of a picture; what is read anew begins another.

    Attributes
    ----------
    picture : str
        Its name; empty where none was chosen.
    scene : ReadScene or None
        What was read of it.
    replies : list of PictureReply
        The last ones, in their order.
    wanted : str or None
        The class that the picture is of, where somebody said that an answer is wrong.
    """

    def __init__(self) -> None:
        super().__init__()
        self.picture = ""
        self.scene: ReadScene | None = None
        self.replies: list[PictureReply] = []
        self.wanted: str | None = None

    def about(self, picture: str, scene: ReadScene | None = None) -> None:
        """Speak of a picture; another one, or another reading of it, ends what was said."""
        if picture != self.picture or (scene is not None and scene is not self.scene):
            self.wanted = self.wanted if picture == self.picture else None
            self.picture, self.scene, self.replies = picture, scene, []

    @property
    def previous(self) -> PictureReply | None:
        """The last answer, which a question may be about."""
        return self.replies[-1] if self.replies else None

    def remember(self, reply: PictureReply) -> None:
        """Remember an answer, the oldest forgotten."""
        self.replies = [*self.replies, reply][-_REMEMBERED:]
