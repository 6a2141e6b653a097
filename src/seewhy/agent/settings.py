"""What an agent is told about how to see, read and answer."""

from __future__ import annotations

from dataclasses import dataclass, replace

from seewhy.domain.domain import Domain
from seewhy.domain.reading_rule import ReadingRule, reading_rule
from seewhy.errors import DomainError
from seewhy.perception.backbones import NONE, require_backbone
from seewhy.perception.conformal_threshold import KNOWN_SHARE

__all__ = ["Settings", "settings_for"]


@dataclass(frozen=True, kw_only=True)
class Settings:
    """How an agent sees, reads and answers; :func:`settings_for` fills in what a domain says.

    Attributes
    ----------
    eyes : str
        The backbone that sees, see :mod:`seewhy.perception.backbones`; ``"none"``: networks that
        grow on the domain's pictures alone, as in the paper.
    device : {"auto", "cpu", "cuda", "mps"}
        Where eyes compute: on a graphics processor where there is one. Networks that grow take CUDA
        where there is one, whatever is said.
    reading : {"argmax", "consistent", "with_class"}
        How the features of a picture are read: each its most probable value, as in the paper,
        together the most probable vector that fits what is known
        (:class:`~seewhy.agent.consistent_reading.ConsistentReading`), or that with the class, seen
        by itself, as one more witness.
    gate : float or None
        Scenes of which some network is less sure than this (0 to 1) are classified by the tree,
        whatever the knowledge says of them, and also train it: the paper's threshold on the
        confidence of extraction. None: the knowledge is always asked first.
    known_share : float
        Below 1: the share of pictures like those of training that is answered; of pictures less
        like them the agent says that it does not know them (see
        :mod:`seewhy.perception.conformal_threshold` and
        :class:`~seewhy.perception.familiarity.Familiarity`). 1 answers every picture.
    trust : float
        How often who asks is taken to be right about what a question presumes ("why is it
        unstable?"). Where the picture is not taken to be so, but it is more probable that it is
        than that who asks is wrong, the answer supposes it, and says so. 0: never.
    seed : int
        Two agents with the same seed and data agree, on processors with the same instruction set.

    Raises
    ------
    DomainError
        If one is none of those, or out of its range.

    Examples
    --------
    >>> Settings(eyes="none", reading="argmax", known_share=1.5)
    Traceback (most recent call last):
    seewhy.errors.DomainError: known_share must be above 0, at most 1, got 1.5
    """

    eyes: str
    device: str = "auto"
    reading: ReadingRule
    gate: float | None = None
    known_share: float = 1.0
    trust: float = 0.9
    seed: int = 0

    def __post_init__(self) -> None:
        require_backbone(self.eyes)
        reading_rule(self.reading)
        if self.gate is not None and not 0.0 < self.gate <= 1.0:
            raise DomainError(f"gate must be 0 to 1, got {self.gate!r}")
        if not 0.0 < self.known_share <= 1.0:
            raise DomainError(f"known_share must be above 0, at most 1, got {self.known_share!r}")
        if not 0.0 <= self.trust < 1.0:
            raise DomainError(f"trust must be at least 0, below 1, got {self.trust!r}")

    @property
    def grown(self) -> bool:
        """Whether networks grow on the domain's pictures alone."""
        return self.eyes == NONE

    @property
    def class_is_seen(self) -> bool:
        """Whether the class, seen by itself, is a witness to what the features are."""
        return self.reading == "with_class"

    def but(
        self,
        *,
        reading: str | None = None,
        gate: float | None = None,
        known_share: float | None = None,
    ) -> Settings:
        """The same but for what is given; a gate of 0 is none."""
        return replace(
            self,
            reading=self.reading if reading is None else reading_rule(reading),
            gate=self.gate if gate is None else gate or None,
            known_share=self.known_share if known_share is None else known_share,
        )

    def believed_from(self, domain: Domain) -> float:
        """How probable a class has to be for who presumes it to be believed.

        As probable as that who asks is wrong and names this class of all that the picture is not,
        which are named alike: with two classes 0.1 where nine in ten are right, with more less.
        """
        wrong = (1.0 - self.trust) / max(1, len(domain.classes) - 1)
        return wrong / (wrong + self.trust)


def settings_for(
    domain: Domain,
    *,
    eyes: str | None = None,
    device: str = "auto",
    reading: str | None = None,
    gate: float | None = None,
    known_share: float | None = None,
    trust: float = 0.9,
    seed: int = 0,
) -> Settings:
    """Return settings, where left out those of a domain.

    Without eyes, what the domain leaves open too is as in the paper: every feature is read by
    itself, and every picture answered. A gate of 0 is none.

    Raises
    ------
    DomainError
        See :class:`Settings`.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> settings = settings_for(load_domain("structure_stability"), eyes="none", gate=0)
    >>> settings.reading, settings.gate
    ('with_class', None)
    """
    sees = domain.eyes_after(domain.pictures.drawn) if eyes is None else eyes
    require_backbone(sees)
    grown = sees == NONE
    shares = (known_share, domain.known_share, 1.0 if grown else KNOWN_SHARE)
    return Settings(
        eyes=sees,
        device=device,
        reading=reading_rule(reading or domain.reading or ("argmax" if grown else "with_class")),
        gate=gate or None,
        known_share=next(share for share in shares if share is not None),
        trust=trust,
        seed=seed,
    )
