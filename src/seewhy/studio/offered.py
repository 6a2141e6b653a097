"""What one browser was proposed to revise, by the keys to take it with."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from dataclasses import dataclass

from seewhy.errors import SeeWhyError
from seewhy.revision.proposal import Proposal

__all__ = ["Offers", "Remedy"]

_PROPOSED = 400


@dataclass(frozen=True)
class Remedy:
    """A proposal as it is shown: the key to take it by, and what it would change, in words."""

    key: str
    proposal: Proposal
    said: str


class Offers:
    """Proposals that may be taken, the oldest forgotten."""

    def __init__(self) -> None:
        self._proposals: dict[str, Proposal] = {}

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
