"""The report of a model: one HTML file with pictures, answers, reasons and accuracies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from seewhy import __version__
from seewhy.data.dataset import Scene
from seewhy.dialogue.question import Asks
from seewhy.evaluation import Evaluation
from seewhy.induction.sentence import say_path
from seewhy.report.card import embedded
from seewhy.report.html import rendered
from seewhy.report.justification import draw_justification
from seewhy.report.tree import draw_tree

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.dialogue.reply import Reply


_REASONS = 660
"""Pixels of width of the reasons, which stand beside a picture of 240."""


def report_page(
    agent: Agent,
    evaluation: Evaluation,
    answered: Sequence[tuple[Scene, Sequence[Reply]]],
    *,
    command: str,
) -> str:
    """Return the report as the text of an HTML file that opens with no network.

    Parameters
    ----------
    agent : Agent
    evaluation : Evaluation
    answered : sequence of (Scene, replies)
        The pictures to show with the replies to the questions about them.
    command : str
        The command that makes the report, for its last line.
    """
    domain = agent.domain
    summary = agent.extractor.summary() if agent.extractor else {}
    left = sum(path.support for path in agent.tree.paths())
    total = sum(sum(counts.values()) for counts in agent.experience.values())
    return rendered(
        "report.html",
        domain=domain,
        evaluation=evaluation,
        headline=_headline(evaluation),
        scenes=[_scene(agent, scene, replies) for scene, replies in answered],
        tree_note=(
            f"Of {total} training scenes, the knowledge leaves {left} open or gets them wrong. "
            "The tree was grown from these alone."
        ),
        tree_figure=draw_tree(domain, agent.tree).svg,
        paths=[say_path(domain, path) for path in agent.tree.paths()],
        networks=[
            {
                "name": domain.features[key].name,
                "layers": summary[key]["layers"],
                "accuracy": evaluation.feature_accuracy.get(key),
            }
            for key in domain.features
        ],
        version=__version__,
        command=command,
    )


def _headline(evaluation: Evaluation) -> list[tuple[str, float, str]]:
    best = f"the features determine {100 * evaluation.determined:.1f} %"
    return [
        ("classified rightly", evaluation.classification_accuracy, best),
        ("decided by the knowledge", evaluation.decided_by_knowledge, ""),
        ("answers with every relevant attribute", evaluation.answer_accuracy, ""),
        ("answers with those and no other", evaluation.answer_accuracy_strict, ""),
        ("explanatory answers, strictly", evaluation.explanation_accuracy_strict, ""),
    ]


def _scene(agent: Agent, scene: Scene, replies: Sequence[Reply]) -> dict[str, Any]:
    domain = agent.domain
    classification = replies[0].classification
    true = domain.named(scene.vector)
    return {
        "picture": embedded(scene.picture, size=240),
        "said": domain.classes[classification.label].say if classification.label else "undecided",
        "truth": domain.classes[scene.label].say if scene.label else "not annotated",
        "right": scene.label in (classification.label, None),
        "method": classification.method,
        "class_seen": classification.class_seen,
        "features": [
            {
                "name": domain.features[key].name,
                "value": reading.value,
                "probability": reading.probability,
                "overruled": reading.overruled,
                "truth": true[key],
                "wrong": true[key] is not None and true[key] != reading.value,
            }
            for key, reading in classification.features.items()
        ],
        "replies": [
            {
                "question": f"{reply.question.text}?",
                "text": reply.text,
                "figure": draw_justification(reply.justification, width=_REASONS).svg,
                "open": reply.question.asks is Asks.WHY_CLASS
                and reply.question.label == classification.label,
            }
            for reply in replies
        ],
    }
