"""A feature that was misread: what the picture shows instead, and of which class it is then."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from seewhy.domain.wording import say_values
from seewhy.revision.proposal import Cause, Doubted, Proposal

__all__ = ["misreadings"]


def misreadings(
    doubted: Doubted,
    *,
    certainty: Mapping[str, float] | None = None,
    about: Sequence[tuple[str, str | None]] = (),
    most: int = 2,
) -> tuple[Proposal, ...]:
    """Propose what a picture may show instead of what was read.

    Parameters
    ----------
    doubted : Doubted
    certainty : mapping of str to float, optional
        How sure each feature is, 0 to 1: the least sure come first.
    about : sequence of (str, str or None)
        Features that somebody says were misread, each with its value where that was said. Without
        them, one feature is read otherwise, so that the scene is of the class that is wanted, or
        else of another than before.
    most : int, default 2
        At most so many.

    Examples
    --------
    >>> from seewhy.agent.learning_from_pictures import AnnotatedScenes
    >>> from seewhy.agent.working_knowledge import working_knowledge
    >>> from seewhy.domain.domain import load_domain
    >>> known = working_knowledge(load_domain("structure_stability"))
    >>> none = AnnotatedScenes((), (), ())
    >>> doubted = Doubted(known, {}, ("2", "wide", "yes", "yes"), none)
    >>> for proposal in misreadings(doubted):
    ...     print(proposal.reading, proposal.decision.label)
    ('block_displaced', 'no') stable
    """
    domain, reasoner = doubted.known.domain, doubted.known.reasoner
    sure = certainty or {}
    named = dict(about)
    keys = [key for key in domain.features if not named or key in named]
    found: list[Proposal] = []
    for key in sorted(keys, key=lambda key: sure.get(key, 1.0)):
        column = list(domain.features).index(key)
        for value in domain.features[key].values:
            if value == doubted.vector[column] or named.get(key) not in (None, value):
                continue
            vector = (*doubted.vector[:column], value, *doubted.vector[column + 1 :])
            decision = reasoner.decide(vector)
            as_wanted = decision.label == doubted.wanted
            other = decision.label is not None and decision.label != doubted.decision.label
            if not named and not (as_wanted if doubted.wanted is not None else other):
                continue
            clause = say_values(domain, key, (value,)).replace("{it}", domain.subject)
            found.append(
                Proposal(
                    Cause.MISREAD,
                    clause,
                    (),
                    decision,
                    reading=(key, value),
                    label=doubted.wanted,
                )
            )
    return tuple(found[:most])
