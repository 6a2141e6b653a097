"""How well an agent does on annotated pictures: classes, answers, features, axioms."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from seewhy.data.dataset import Dataset
from seewhy.data.making import determined_share
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks
from seewhy.errors import DatasetError
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.reply import UNKNOWN

if TYPE_CHECKING:
    from seewhy.agent import Agent
    from seewhy.dialogue.reference import ReferenceAnswers

EXPLANATORY = (
    Asks.WHY_CLASS, Asks.WHY_NOT_CLASS, Asks.CHANGE_TO_CLASS, Asks.DIFFERENCE_TO_CLASS
)  # fmt: skip


@dataclass(frozen=True)
class AxiomRecord:
    """How often an axiom applied to annotated scenes and how often it was right."""

    identifier: str
    statement: str
    text: str
    decided: int
    right: int

    @property
    def accuracy(self) -> float:
        """The share of scenes on which the axiom is right; 1 where it never applied."""
        return self.right / self.decided if self.decided else 1.0


@dataclass(frozen=True)
class Evaluation:
    """Shares, each from 0 to 1, over the scenes of a dataset.

    Attributes
    ----------
    scenes : int
        Those whose class is annotated.
    without_class : int
        Other pictures, of which only the features are judged.
    seen_in_training : int
        Scenes whose picture the model was trained on; their results prove nothing.
    classification_accuracy : float
    class_accuracy : dict
        Class → share of its scenes that were classified rightly, for the classes that occur.
    without : tuple of str
        Classes of which the model was shown no picture in training.
    unknown : float
        Share of the scenes of which the agent said that it does not know them.
    answer_accuracy : float
        The answer has the right form and mentions every relevant attribute with its value (the
        paper's measure).
    answer_accuracy_strict : float
        It mentions those and no other.
    explanation_accuracy, explanation_accuracy_strict : float
        The same over the questions that ask why, why not, what would have to change, and how a
        scene differs from a class.
    feature_accuracy : dict
        Feature → share of the pictures in which it was recognised, of those in which somebody
        said what it is; a feature of which nobody did is left out.
    decided_by_knowledge : float
        Share of scenes that the knowledge decided.
    accuracy_by_method : dict
        "knowledge", "tree" and "none" → classification accuracy where that method was used.
    determined : float
        The share that the best classifier over the annotated features would get right.
    axioms : tuple of AxiomRecord
    """

    scenes: int
    without_class: int
    seen_in_training: int
    classification_accuracy: float
    class_accuracy: dict[str, float]
    without: tuple[str, ...]
    unknown: float
    answer_accuracy: float
    answer_accuracy_strict: float
    explanation_accuracy: float
    explanation_accuracy_strict: float
    feature_accuracy: dict[str, float]
    decided_by_knowledge: float
    accuracy_by_method: dict[str, float]
    determined: float
    axioms: tuple[AxiomRecord, ...]

    def to_dict(self) -> dict[str, Any]:
        """Return the evaluation as values that JSON can hold."""
        return {
            **asdict(self),
            "axioms": [{**asdict(own), "accuracy": own.accuracy} for own in self.axioms],
        }


def evaluate(
    agent: Agent,
    dataset: Dataset,
    *,
    questions_per_scene: int = 8,
    seed: int = 0,
    reference: ReferenceAnswers | None = None,
    on_progress: Callable[[int], None] | None = None,
) -> Evaluation:
    """Evaluate an agent on the scenes of a dataset (those with split "test", if there are splits).

    For every scene, ``questions_per_scene`` of the domain's questions are drawn at random, whatever
    its class is; so what they presume is nobody's word, and the agent does not suppose it.
    Pictures without a class count for the features that are annotated, for nothing else.
    Correct answers are those of :mod:`seewhy.dialogue.reference`: of what the agent itself knows,
    or of ``reference``, where somebody knows more.

    Examples
    --------
    >>> # evaluate(agent, Dataset.load("pictures", domain)).classification_accuracy
    """
    everything = dataset.of_split("test")
    if dataset.domain.name != agent.domain.name:
        raise DatasetError(
            f"{dataset.folder}: the dataset is of the domain '{dataset.domain.name}', the model "
            f"of '{agent.domain.name}'"
        )
    scenes = everything.with_class()
    if not len(scenes):
        raise DatasetError(
            f"{everything.table.name}: no picture to evaluate on has a class; fill the column "
            "'class'"
        )
    pictures = everything.pictures(agent.picture_size, on_progress=on_progress)
    seen = [replace(own, otherwise=()) for own in agent.classify_all(pictures)]
    features = {}
    for position, key in enumerate(agent.domain.features):
        pairs = [
            (own.vector[position], true[position])
            for own, true in zip(seen, everything.vectors, strict=True)
            if true[position] is not None
        ]
        if pairs:
            features[key] = _share([value == true for value, true in pairs])
    classified = [
        own for own, label in zip(seen, everything.labels, strict=True) if label is not None
    ]
    classes = scenes.classes
    right = [own.label == true for own, true in zip(classified, classes, strict=True)]
    methods = [own.method for own in classified]
    reference = reference or agent.reference
    generator = np.random.default_rng(seed)
    possible = [q for q in agent.questions.one_of_each() if q.asks is not Asks.EXPLAIN]
    scored: list[tuple[bool, bool, bool]] = []
    known: dict[tuple[object, ...], AnswerType] = {}
    for scene, true_class, own in zip(scenes.scenes, classes, classified, strict=True):
        number = min(questions_per_scene, len(possible))
        for chosen in generator.choice(len(possible), size=number, replace=False):
            question = possible[int(chosen)]
            asked = (question.query, own.vector, own.label, own.verdict)
            if asked not in known:
                known[asked] = agent.answer(own, question).kind
            kind = known[asked]
            gold = reference.answer(question, scene.vector, true_class)
            enough, exact = score_answer(
                kind,
                gold,
                seen=dict(zip(agent.domain.features, own.vector, strict=True)),
                true=dict(zip(agent.domain.features, scene.vector, strict=True)),
                right_class=own.label == true_class,
            )
            scored.append((enough, exact, question.asks in EXPLANATORY))
    return Evaluation(
        scenes=len(scenes),
        without_class=len(everything) - len(scenes),
        seen_in_training=sum(digest in agent.trained_on for digest in scenes.picture_digests()),
        classification_accuracy=_share(right),
        class_accuracy={
            label: _share([r for r, true in zip(right, classes, strict=True) if true == label])
            for label in agent.domain.classes
            if label in classes
        },
        without=agent.without,
        unknown=_share([own.verdict == UNKNOWN for own in classified]),
        answer_accuracy=_share([row[0] for row in scored]),
        answer_accuracy_strict=_share([row[1] for row in scored]),
        explanation_accuracy=_share([row[0] for row in scored if row[2]]),
        explanation_accuracy_strict=_share([row[1] for row in scored if row[2]]),
        feature_accuracy=features,
        decided_by_knowledge=_share([method == "knowledge" for method in methods]),
        accuracy_by_method={
            method: _share([r for r, m in zip(right, methods, strict=True) if m == method])
            for method in sorted(set(methods))
        },
        determined=determined_share(scenes.vectors, classes),
        axioms=axiom_records(agent.reasoner, scenes.vectors, classes),
    )


def score_answer(
    kind: AnswerType,
    gold: AnswerType,
    *,
    seen: dict[str, str | None],
    true: dict[str, str | None],
    right_class: bool,
) -> tuple[bool, bool]:
    """Return whether an answer is right by the paper's measure and by the strict one.

    Examples
    --------
    >>> kind = AnswerType("reasons", ("lean", "base"))
    >>> gold = AnswerType("reasons", ("lean",))
    >>> both = {"lean": "yes", "base": "wide"}
    >>> score_answer(kind, gold, seen=both, true=both, right_class=True)
    (True, False)
    """
    if kind.form != gold.form:
        return False, False
    if kind.form == "belief":
        # Two classes may have one response: what is believed counts, not from which class.
        same = set(kind.values) == set(gold.values)
        return same, same
    if kind.form in ("change", "difference"):
        proposed = [frozenset(change) for change in kind.changes]
        accepted = {frozenset(change) for change in gold.changes}
        some = any(change in accepted for change in proposed)
        return some, some and all(change in accepted for change in proposed)
    if kind.form in ("class", "no_class") and not right_class:
        return kind.form == "no_class", False
    mentioned = all(f in kind.mentions and seen[f] == true[f] for f in gold.mentions)
    return mentioned, mentioned and set(kind.mentions) == set(gold.mentions)


def axiom_records(
    reasoner: Reasoner, vectors: Sequence[FeatureVector], labels: Sequence[str]
) -> tuple[AxiomRecord, ...]:
    """Count for every axiom that concludes a class the scenes that it decides, and rightly.

    An axiom decides a scene when it fires on the annotated features, whatever others conclude.
    """
    schema = reasoner.schema
    fired: dict[FeatureVector, list[tuple[Axiom, str]]] = {}
    for vector in set(vectors):
        answer_set = reasoner.answer_set(vector)
        fired[vector] = []
        for axiom in reasoner.knowledge.axioms:
            for values in answer_set.firings.get(axiom.identifier, ()) if answer_set else ():
                head = axiom.head.substitute(dict(zip(axiom.variables, values, strict=True)))
                label = schema.class_of(head)
                if label is not None:
                    fired[vector].append((axiom, label))
    concludes = {axiom.identifier for own in fired.values() for axiom, _ in own}
    records = []
    for axiom in reasoner.knowledge.axioms:
        if axiom.identifier not in concludes and axiom.head.predicate not in {
            literal.predicate for literal in schema.classes.values()
        }:
            continue
        outcomes = [
            concluded == label
            for vector, label in zip(vectors, labels, strict=True)
            for own, concluded in fired[vector]
            if own.identifier == axiom.identifier
        ]
        records.append(
            AxiomRecord(axiom.identifier, str(axiom), axiom.text, len(outcomes), sum(outcomes))
        )
    return tuple(records)


def _share(outcomes: Sequence[bool]) -> float:
    return float(np.mean(outcomes)) if outcomes else 0.0
