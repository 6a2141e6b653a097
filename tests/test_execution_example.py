"""The paper's first execution example: five blocks, narrow base, straight, none displaced.

The knowledge leaves it open, so the tree classifies it and the recurrent network answers.
"""

from __future__ import annotations

import pytest

from seewhy.agent.agent import Agent
from seewhy.dialogue.reply import Classification, FeatureReading
from seewhy.domain.domain import load_domain
from seewhy.knowledge.scene import FeatureVector

EXAMPLE: FeatureVector = ("5", "narrow", "no", "no")
# Annotated structures: (vector, stable, unstable), in the proportions that the simulation gives.
SCENES: list[tuple[FeatureVector, int, int]] = [
    (EXAMPLE, 43, 7),
    (("5", "wide", "no", "no"), 30, 2),
    (("4", "narrow", "no", "no"), 36, 1),
    (("3", "narrow", "no", "no"), 30, 0),
    (("5", "narrow", "yes", "no"), 0, 20),
    (("5", "narrow", "no", "yes"), 1, 14),
    (("3", "narrow", "yes", "no"), 12, 6),
    (("5", "wide", "yes", "no"), 14, 10),
]


@pytest.fixture(scope="module")
def agent() -> Agent:
    vectors: list[FeatureVector] = []
    labels: list[str] = []
    for vector, stable, unstable in SCENES:
        vectors += [vector] * (stable + unstable)
        labels += ["stable"] * stable + ["unstable"] * unstable
    return Agent(load_domain("structure_stability")).fit_induction(vectors, labels)


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("is this structure unstable?", "No, the structure is stable."),
        (
            "what is making this structure stable?",
            "The structure has five blocks and a narrow base, it is standing straight, "
            "and no block is displaced.",
        ),
    ],
)
def test_the_first_execution_example(agent: Agent, question: str, answer: str) -> None:
    features = {
        key: FeatureReading(value or "", 0.99) for key, value in agent.domain.named(EXAMPLE).items()
    }
    label = agent.decide(agent.domain.named(EXAMPLE))
    scene = Classification(label, "tree", EXAMPLE, features, "silent")
    reply = agent.answer(scene, agent.questions.understand(question))
    assert (reply.text, reply.method) == (answer, "tree")
    assert "the knowledge does not decide" in reply.justification.to_text()
    assert "then it is stable" in reply.justification.to_text()
