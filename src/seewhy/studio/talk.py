"""What one browser asks about one picture, and what it is proposed to revise."""

from __future__ import annotations

from seewhy.dialogue.reply import Reply
from seewhy.studio.offered import Offers

__all__ = ["Talk"]

_REMEMBERED = 20


class Talk(Offers):
    """A conversation about a picture; another picture begins another.

    Attributes
    ----------
    picture : str
        Its name; empty where none was chosen.
    replies : list of Reply
        The last ones, in their order.
    wanted : str or None
        The class that the picture is of, where somebody said that an answer is wrong.
    """

    def __init__(self) -> None:
        super().__init__()
        self.picture = ""
        self.replies: list[Reply] = []
        self.wanted: str | None = None

    def about(self, picture: str) -> None:
        """Speak of a picture."""
        if picture != self.picture:
            self.picture, self.replies, self.wanted = picture, [], None

    @property
    def previous(self) -> Reply | None:
        """The last answer that a question may be about: an explanation is about the one before."""
        said = (reply for reply in reversed(self.replies) if reply.kind.form != "explain")
        return next(said, None)

    def remember(self, reply: Reply) -> None:
        """Remember an answer, the oldest forgotten."""
        self.replies = [*self.replies, reply][-_REMEMBERED:]
