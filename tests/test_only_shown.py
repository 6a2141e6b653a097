"""Beside an answer stands of what it rests on training pictures showed one value only."""

from __future__ import annotations

import numpy as np
import pytest

from conftest import seen
from seewhy.agent.agent import Agent
from seewhy.agent.trace import trace_of
from seewhy.domain.domain import Domain
from seewhy.perception.extractor import FeatureExtractor
from seewhy.perception.fitting_extractor import fit_extractor
from seewhy.perception.labelled_pictures import LabelledPictures

VECTOR = ("3", "wide", "no", "no")


@pytest.fixture(scope="module")
def agent(structures: Domain) -> Agent:
    """All structures that it was shown stand on a wide base; other features nobody named."""
    taught = Agent(structures)
    taught.extractor = trained(structures)
    return taught


def trained(structures: Domain) -> FeatureExtractor:
    pictures = np.zeros((10, 32, 32, 3), dtype=np.uint8)
    values = {key: list(feature.values) for key, feature in structures.features.items()}
    return fit_extractor(LabelledPictures(pictures, {"base": ["wide"] * 10}, values))


@pytest.mark.parametrize(
    ("question", "text"),
    [
        (
            "what is the width of the base?",
            "The structure has a wide base. Of the width of the base, only wide was ever shown.",
        ),
        ("does it lean?", "No, the structure is standing straight."),
    ],
)
def test_the_one_value_that_was_shown_is_told(agent: Agent, question: str, text: str) -> None:
    assert agent.only_shown == {"base": "wide"}
    understood = agent.questions.understand(question)
    assert agent.answer(seen(agent, *VECTOR), understood).text == text
    assert agent.answer_all([(seen(agent, *VECTOR), understood)])[0].text == text


def test_of_what_was_named_nothing_is_told(agent: Agent) -> None:
    features = dict(zip(agent.domain.features, VECTOR, strict=True))
    reply = agent.answer(
        agent.classify_values(features), agent.questions.understand("is the base wide?")
    )
    assert "ever shown" not in reply.text


def test_a_trace_tells_it_beside_what_is_seen(agent: Agent) -> None:
    told = trace_of(agent, seen(agent, *VECTOR))
    assert "\n  of the width of the base, only wide was ever shown\n" in told.to_text()
    assert told.to_dict()["networks"]["only_shown"] == {"base": "wide"}
