"""What each coupling of the architecture is worth, on the same networks.

`ablation` leaves a component out or trains it on everything, `confidence` sets the gate, `reading`
reads features each by itself or together. The networks of a trial are those of `vqa`.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

from seewhy.agent import Agent
from seewhy.dialogue.reference import ReferenceAnswers
from seewhy.experiments.experiment import Claim, Experiment, Plan, Row, Setting, Trial
from seewhy.experiments.questioning import draw_questions
from seewhy.experiments.seeing import Seen, see
from seewhy.experiments.vqa import (
    MEASURES,
    agent_of,
    annotator,
    common_columns,
    scenes_to_learn,
    score_agent,
)
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.scene import FeatureVector

__all__ = ["ABLATION", "CONFIDENCE", "GATES", "READING"]

GATES = (0.5, 0.7, 0.9)
"""Gates that `confidence` sets; without one the knowledge is asked of every picture."""

_FULL = {
    "structure_stability": Plan(trials=50, sizes=(100, 400, 1667)),
    "traffic_signs": Plan(trials=50, sizes=(100, 500, 2000)),
    "": Plan(trials=50, sizes=(100, 400)),
}
_QUICK = {"": Plan(trials=3, sizes=(100, 300), pictures=900, tested=400)}


def _scored(
    agent: Agent,
    system: str,
    trial: Trial,
    seen: Seen,
    reference: ReferenceAnswers,
    began: float,
) -> Row:
    """The row of a trained agent."""
    test = seen.test.scenes
    trained = time.process_time()
    asked = draw_questions(agent.questions, test.labels, seed=trial.seed)
    return {
        **common_columns(trial, seen),
        "system": system,
        **score_agent(agent, test, asked, reference),
        "seconds_learning": round(trained - began, 2),
    }


def run_ablation(setting: Setting, trial: Trial) -> list[Row]:
    """Score the architecture, without a component, and with components trained on everything."""
    seen = see(setting, trial)
    reference = annotator(setting.scenes)
    vectors, labels = scenes_to_learn(setting, seen.train.scenes)
    rows = []
    for system in ("seewhy", "no_tree", "no_lstm", "tree_on_all", "lstm_on_all"):
        began = time.process_time()
        agent = agent_of(setting, seen, seed=trial.seed)
        agent.fit_induction(vectors, labels, answers=system != "no_lstm", reference=reference)
        if system == "no_tree":
            agent.tree = DecisionTree({k: f.values for k, f in setting.domain.features.items()})
        elif system == "tree_on_all":
            agent.tree.fit(vectors, labels, seed=trial.seed)
        elif system == "lstm_on_all":
            _answers_on_all(agent, reference, vectors, labels)
        rows.append(_scored(agent, system, trial, seen, reference, began))
    return rows


def _answers_on_all(
    agent: Agent,
    reference: ReferenceAnswers,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
) -> None:
    from seewhy.dialogue.learned import fit_learned_answers

    agent.answerer = fit_learned_answers(
        agent.domain, agent.questions, reference, vectors, labels, seed=agent.seed
    )


def run_confidence(setting: Setting, trial: Trial) -> list[Row]:
    """Score the architecture without a gate, and with gates of several heights.

    With one, pictures of which some network is less sure also train the tree and the answers.
    """
    seen = see(setting, trial)
    reference = annotator(setting.scenes)
    vectors, labels = scenes_to_learn(setting, seen.train.scenes)
    rows = []
    for gate in (None, *GATES):
        began = time.process_time()
        agent = agent_of(setting, seen, seed=trial.seed, gate=gate)
        uncertain = _uncertain(seen, gate)
        agent.fit_induction(vectors, labels, uncertain=uncertain, reference=reference)
        rows.append(_scored(agent, _gate_name(gate), trial, seen, reference, began))
    return rows


def _uncertain(seen: Seen, gate: float | None) -> list[int]:
    """The training pictures of which some network is less sure than a gate."""
    if gate is None:
        return []
    sure = [own.max(axis=1) for own in seen.train.features.values()]
    return [n for n, own in enumerate(zip(*sure, strict=True)) if min(own) < gate]


def _gate_name(gate: float | None) -> str:
    return "no_gate" if gate is None else f"gate_{100 * gate:.0f}"


def run_reading(setting: Setting, trial: Trial) -> list[Row]:
    """Score the architecture with features read each by itself, and together."""
    seen = see(setting, trial)
    reference = annotator(setting.scenes)
    vectors, labels = scenes_to_learn(setting, seen.train.scenes)
    rows = []
    for reading in ("argmax", "consistent"):
        began = time.process_time()
        agent = agent_of(setting, seen, seed=trial.seed, reading=reading)
        agent.fit_induction(vectors, labels, reference=reference)
        rows.append(_scored(agent, reading, trial, seen, reference, began))
    return rows


ABLATION = Experiment(
    name="ablation",
    title="What each coupling of the components is worth",
    hypothesis=(
        "Each component earns its place: without the tree, or without the LSTM, fewer pictures "
        "and questions are right; and neither gains by training on what the knowledge decides."
    ),
    systems={
        "seewhy": "SeeWhy",
        "no_tree": "without the tree",
        "no_lstm": "without the LSTM",
        "tree_on_all": "tree trained on everything",
        "lstm_on_all": "LSTM trained on everything",
    },
    measures=MEASURES,
    claims=(
        Claim("accuracy", "seewhy", "no_tree"),
        Claim("answers", "seewhy", "no_lstm"),
        Claim("accuracy", "seewhy", "tree_on_all", equal_in=("",)),
        Claim("answers", "seewhy", "lstm_on_all", equal_in=("",)),
    ),
    trial=run_ablation,
    full=_FULL,
    quick=_QUICK,
)

CONFIDENCE = Experiment(
    name="confidence",
    title="With and without the gate of confidence",
    hypothesis=(
        "Pictures of which some network is unsure are better left to the tree, whatever the "
        "knowledge says of what was read."
    ),
    systems={
        "no_gate": "no gate",
        **{_gate_name(gate): f"gate at {100 * gate:.0f} %" for gate in GATES},
    },
    measures=MEASURES,
    claims=tuple(
        Claim(measure, _gate_name(gate), "no_gate")
        for measure in ("accuracy", "answers")
        for gate in GATES
    ),
    trial=run_confidence,
    full=_FULL,
    quick=_QUICK,
)

READING = Experiment(
    name="reading",
    title="Features read each by itself, and together",
    hypothesis=(
        "The most probable feature vector that fits the knowledge is more often right than the "
        "most probable value of each feature."
    ),
    systems={"argmax": "each by itself", "consistent": "together"},
    measures=MEASURES,
    claims=(
        Claim("accuracy", "consistent", "argmax"),
        Claim("answers", "consistent", "argmax"),
        Claim("answers_strict", "consistent", "argmax"),
    ),
    trial=run_reading,
    full=_FULL,
    quick=_QUICK,
)
