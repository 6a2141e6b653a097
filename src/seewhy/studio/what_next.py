"""Which picture to label next, and in words why a label of it is worth something."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from seewhy.domain.domain import Domain
from seewhy.labelling.labelling_order import WorthLabelling
from seewhy.labelling.spread_order import spread_order
from seewhy.studio.labels import Labels
from seewhy.studio.proposing import Proposals

__all__ = ["what_next", "why_next"]

_UNLIKE = 0.4
"""What is less unlike all that is labelled is called like some of it."""

_UNSURE = 0.5


def what_next(
    pictures: Sequence[str], labels: Labels, domain: Domain, proposals: Proposals
) -> Iterator[str]:
    """Yield pictures by what a label is worth, then what else is open, then all.

    What was not looked at yet comes by a few of everywhere; no chance has a say in it.
    """
    there = set(pictures)

    def is_open(name: str) -> bool:
        return name in there and not labels.is_complete(name, domain)

    yield from (name for name, _ in proposals.order if is_open(name))
    yield from filter(is_open, (pictures[place] for place in spread_order(len(pictures))))
    yield from pictures


def why_next(picture: str, labels: Labels, domain: Domain, proposals: Proposals) -> str:
    """Say why a label of a picture is worth something; empty where all is said of it.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> found = Proposals(pictures={"a.png": 0}, order=(("a.png", WorthLabelling(0, 1, 1, 1)),))
    >>> why_next("a.png", Labels(), domain, found)
    'Worth a label: many pictures are like it.'
    >>> why_next("b.png", Labels(), domain, found)
    'Next by its place in the folder: it is not looked at yet.'
    """
    if proposals.problem or labels.is_complete(picture, domain):
        return ""
    if picture not in proposals.pictures:
        return "Next by its place in the folder: it is not looked at yet."
    worth = dict(proposals.order).get(picture)
    if worth is None:
        return "Others are worth more: something like it is labelled, or it is proposed surely."
    first = not any(labels.is_complete(name, domain) for name in proposals.pictures)
    reasons = _reasons(worth, first=first, heads=bool(proposals.probabilities))
    if not reasons:
        return "Little is left to learn from it: it is proposed surely, or like what is labelled."
    return f"Worth a label: {', and '.join(reasons)}."


def _reasons(worth: WorthLabelling, *, first: bool, heads: bool) -> list[str]:
    if first:
        return ["many pictures are like it"]
    reasons = ["rules and heads disagree"] if worth.disputed else []
    if heads and worth.unsure > _UNSURE:
        reasons.append("the heads are unsure")
    if worth.unlike > _UNLIKE or not heads:
        reasons.append("it is unlike what is labelled")
    return reasons
