"""What is said back to a remark: proposals that wait for a yes or a no, or what was done."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from seewhy.revision.proposal import Proposal
from seewhy.revision.record import Revision

__all__ = ["Said"]


@dataclass(frozen=True)
class Said:
    """What is said back to a remark.

    Attributes
    ----------
    text : str
    proposals : tuple of Proposal
        What waits for a yes or a no.
    revision : Revision or None
        What was taken or taken back.
    """

    text: str
    proposals: tuple[Proposal, ...] = ()
    revision: Revision | None = None

    def to_dict(self) -> dict[str, Any]:
        """Return it as values that JSON can hold."""
        revision = self.revision
        return {
            "text": self.text,
            "proposals": [proposal.to_dict() for proposal in self.proposals],
            "revision": None
            if revision is None
            else {
                "number": revision.number,
                "cause": revision.taken.cause.value,
                "sentence": revision.taken.sentence,
                "taken_back": revision.taken_back is not None,
            },
        }
