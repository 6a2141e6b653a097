"""What each coupling of the architecture is worth, on the same networks.

`ablation` leaves a component out or trains it on everything, `confidence` sets the gate, `reading`
reads features each by itself, together, or with the class. The networks of a trial are those of
`vqa`.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from seewhy.agent.agent import Agent
from seewhy.dialogue.reference import ReferenceAnswers
from seewhy.domain.reading_rule import READINGS
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.scene import FeatureVector
from seewhy_lab.experiments.experiment import Claim, Experiment, Plan, Row, Setting, Trial
from seewhy_lab.experiments.questioning import draw_questions
from seewhy_lab.experiments.seeing import Seen, see
from seewhy_lab.experiments.vqa import (
    MEASURES,
    agent_of,
    annotator,
    common_columns,
    scenes_to_learn,
    score_agent,
)

if TYPE_CHECKING:
    from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer

__all__ = ["ABLATION", "CONFIDENCE", "GATES", "READING"]

GATES = (0.5, 0.7, 0.9)
"""Gates that `confidence` sets; without one the knowledge is asked of every picture."""

_FULL = {
    "structure_stability": Plan(trials=50, sizes=(100, 400, 1667)),
    "traffic_signs": Plan(trials=50, sizes=(100, 500, 2000)),
    "": Plan(trials=50, sizes=(100, 400)),
}
_QUICK = {
    "traffic_signs": Plan(trials=2, sizes=(50, 100)),
    "": Plan(trials=3, sizes=(100, 300), pictures=900, tested=400),
}


def _scored(
    agent: Agent,
    system: str,
    trial: Trial,
    seen: Seen,
    reference: ReferenceAnswers,
    seconds: float,
) -> Row:
    """The row of an agent that was trained in so many seconds."""
    test = seen.test.scenes
    asked = draw_questions(agent.questions, test.classes, seed=trial.seed)
    return {
        **common_columns(trial, seen),
        "system": system,
        **score_agent(agent, test, asked, reference),
        "seconds_learning": round(seconds, 2),
    }


def run_ablation(setting: Setting, trial: Trial) -> list[Row]:
    """Score the architecture, without a component, and with components trained on everything."""
    from seewhy.dialogue.learned import fit_learned_answers

    seen = see(setting, trial)
    reference = annotator(setting.scenes)
    vectors, labels = scenes_to_learn(setting, seen.train.scenes)
    whole = agent_of(setting, seen, seed=trial.seed)
    grown, taught = _learned(whole, vectors, labels, reference)

    def variant(
        system: str, *, tree: DecisionTree, answerer: RecurrentAnswerer | None, seconds: float
    ) -> Row:
        agent = agent_of(setting, seen, seed=trial.seed)
        agent.experience, agent.tree, agent.answerer = whole.experience, tree, answerer
        return _scored(agent, system, trial, seen, reference, seconds)

    values = {key: feature.values for key, feature in setting.domain.features.items()}
    tree, answerer = whole.tree, whole.answerer
    began = time.process_time()
    larger = DecisionTree(values).fit(vectors, labels, seed=trial.seed)
    middle = time.process_time()
    wider = fit_learned_answers(
        whole.domain, whole.questions, reference, vectors, labels, seed=trial.seed
    )
    grown_on_all, taught_on_all = middle - began, time.process_time() - middle
    return [
        variant("seewhy", tree=tree, answerer=answerer, seconds=grown + taught),
        variant("no_tree", tree=DecisionTree(values), answerer=answerer, seconds=taught),
        variant("no_lstm", tree=tree, answerer=None, seconds=grown),
        variant("tree_on_all", tree=larger, answerer=answerer, seconds=grown_on_all + taught),
        variant("lstm_on_all", tree=tree, answerer=wider, seconds=grown + taught_on_all),
    ]


def _learned(
    agent: Agent, vectors: list[FeatureVector], labels: list[str], reference: ReferenceAnswers
) -> tuple[float, float]:
    """Let an agent learn; return the seconds that its tree took, and its recurrent network."""
    # Decides the scenes, which is remembered, and imports: neither is learning.
    agent.fit_induction(vectors, labels, answers=False)
    began = time.process_time()
    agent.fit_induction(vectors, labels, answers=False)
    middle = time.process_time()
    agent.fit_induction(vectors, labels, reference=reference)
    grown = middle - began
    return grown, time.process_time() - middle - grown


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
        seconds = time.process_time() - began
        rows.append(_scored(agent, _gate_name(gate), trial, seen, reference, seconds))
    return rows


def _uncertain(seen: Seen, gate: float | None) -> list[int]:
    """The training pictures of which some network is less sure than a gate."""
    if gate is None:
        return []
    sure = [probabilities.max(axis=1) for probabilities in seen.train.features.values()]
    return [n for n, confidences in enumerate(zip(*sure, strict=True)) if min(confidences) < gate]


def _gate_name(gate: float | None) -> str:
    return "no_gate" if gate is None else f"gate_{100 * gate:.0f}"


def run_reading(setting: Setting, trial: Trial) -> list[Row]:
    """Score the architecture with every way of reading features, beside the class network alone."""
    from seewhy_lab.experiments.end_to_end import EndToEnd

    seen = see(setting, trial)
    reference = annotator(setting.scenes)
    vectors, labels = scenes_to_learn(setting, seen.train.scenes)
    agent = agent_of(setting, seen, seed=trial.seed)
    began = time.process_time()
    agent.fit_induction(vectors, labels, reference=reference)
    seconds = time.process_time() - began
    rows = []
    for reading in READINGS:
        agent.reading = reading  # what is learned does not depend on it
        rows.append(_scored(agent, reading, trial, seen, reference, seconds))
    alone = EndToEnd(setting.domain, seen.train).accuracy(seen.test)
    return [*rows, {**common_columns(trial, seen), "system": "end_to_end", "accuracy": alone}]


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
    title="Features read each by itself, together, and with the class",
    hypothesis=(
        "The most probable feature vector that fits the knowledge is more often right than the "
        "most probable value of each feature; and more often still where a network of the class "
        "is one more witness, whatever that network says alone."
    ),
    systems={
        "argmax": "each by itself",
        "consistent": "together",
        "with_class": "together, with the class",
        "end_to_end": "end to end (the class alone)",
    },
    measures=MEASURES,
    claims=(
        *(
            Claim(measure, reading, other)
            for reading, other in (("consistent", "argmax"), ("with_class", "consistent"))
            for measure in ("accuracy", "answers", "answers_strict")
        ),
        *(Claim("accuracy", reading, "end_to_end") for reading in READINGS),
    ),
    trial=run_reading,
    full=_FULL,
    quick=_QUICK,
)
