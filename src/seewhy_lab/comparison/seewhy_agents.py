"""(a) SeeWhy as it is by default, and (e) as it was before it had eyes that have seen before."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from seewhy.agent.agent import Agent
from seewhy.agent.pretraining import Pretrained, pretrained
from seewhy.agent.settings import Settings
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain
from seewhy.domain.reading_rule import ReadingRule
from seewhy.perception.course import Course
from seewhy_lab.comparison.system import Drawings, Fitted

__all__ = ["fit_before", "fit_default"]


def fit_default(train: Dataset, seed: int, drawings: Drawings | None) -> Fitted:
    """What ``seewhy train`` makes of a domain folder: no key but those that the folder has."""
    domain = train.domain
    eyes = domain.eyes_after(0 if drawings is None else drawings.count)
    return _fitted(Agent(domain, seed=seed, eyes=eyes), train, drawings)


def fit_before(train: Dataset, seed: int, drawings: Drawings | None) -> Fitted:
    """Networks that grow on these pictures alone, as a domain's keys have them.

    A folder of ``seewhy new`` had none: features read by ``argmax``, one convolution to start
    with, 18 passes (up to four times as many where pictures are few).
    """
    return _fitted(Agent(train.domain, seed=seed, eyes="none"), train, drawings)


def _fitted(agent: Agent, train: Dataset, drawings: Drawings | None) -> Fitted:
    # The recurrent network answers questions; no class depends on it.
    first = None
    if drawings is not None:
        first = _knowing_drawings(drawings, agent.eyes, agent.reading)
    agent.fit(train, drawn=0, start_from=first, answers=False, workers=1)

    def classify(pictures: Dataset) -> Sequence[str | None]:
        return [found.label for found in agent.classify_all(pictures.pictures(agent.picture_size))]

    networks = agent.domain.networks
    options = {
        "eyes": agent.eyes,
        "reading": agent.reading,
        "known_share": agent.known_share,
        **({"depth": networks.depth, "epochs": networks.epochs} if agent.eyes == "none" else {}),
    }
    return Fitted(classify, options)


@cache
def _knowing_drawings(drawings: Drawings, eyes: str, reading: ReadingRule) -> Pretrained:
    settings = Settings(eyes=eyes, reading=reading)
    return pretrained(
        load_domain(drawings.domain),
        count=drawings.count,
        settings=settings,
        course=Course(workers=1, checkpoints=drawings.folder),
    )
