"""What one browser asks about one picture, and what it is proposed to revise."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable

from seewhy.dialogue.reply import Reply
from seewhy.errors import SeeWhyError
from seewhy.revision.proposal import Proposal

__all__ = ["Talk"]

_REMEMBERED = 20
_PROPOSED = 400


class Talk:
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
        self.picture = ""
        self.replies: list[Reply] = []
        self.wanted: str | None = None
        self._proposals: dict[str, Proposal] = {}

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

    def propose(self, proposals: Iterable[Proposal]) -> dict[str, Proposal]:
        """Remember what may be taken; key → proposal, the key the same for the same proposal."""
        found = {_key(proposal): proposal for proposal in proposals}
        self._proposals |= found
        while len(self._proposals) > _PROPOSED:
            del self._proposals[next(iter(self._proposals))]
        return found

    def proposal(self, key: str) -> Proposal:
        """What was proposed.

        Raises
        ------
        SeeWhyError
            If nothing was proposed by this key since the studio was started.
        """
        if key not in self._proposals:
            raise SeeWhyError("that was proposed before the studio was started; look at it again")
        return self._proposals[key]


def _key(proposal: Proposal) -> str:
    said = [proposal.cause, proposal.sentence, proposal.reading, proposal.label]
    edits = [(edit.file, edit.at, edit.before, edit.after) for edit in proposal.edits]
    return hashlib.sha256(json.dumps([said, edits]).encode()).hexdigest()[:20]
