"""Reference answers: what a correct answer says about an annotated scene.

They train the recurrent network and score every answer. Where the knowledge, given the annotated
features, decides the scene rightly, the relevant features are those of its justification.
Elsewhere they are the smallest set of the scene's feature values that says as much about its class,
among all annotated scenes, as all of them do.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import combinations

import numpy as np

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.class_changes import difference
from seewhy.dialogue.question import Asks, Question
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.domain.domain import Domain
from seewhy.knowledge.scene import FeatureVector

Experience = Mapping[FeatureVector, Mapping[str, int]]
"""Annotated feature vector → class → the number of scenes."""

_AS_CERTAIN = 0.02


def experience_of(vectors: Sequence[FeatureVector], labels: Sequence[str]) -> Experience:
    """Count the classes of every annotated feature vector.

    Examples
    --------
    >>> experience_of([("a",), ("a",)], ["x", "x"])
    {('a',): Counter({'x': 2})}
    """
    counts: dict[FeatureVector, Counter[str]] = {}
    for vector, label in zip(vectors, labels, strict=True):
        counts.setdefault(vector, Counter())[label] += 1
    return counts


def relevant_features(
    experience: Experience, features: Sequence[str], vector: FeatureVector, label: str
) -> tuple[str, ...]:
    """Return the smallest set of features that says as much about a class as all of them.

    Knowing the scene's values of these features, its class is as certain among the annotated
    scenes as knowing all its values (the shares differ by at most 0.02), and no further value
    changes that. Of several such sets of one size, the one that most scenes agree with is taken.
    Where no annotated scene has all the values, every known feature is relevant.

    Examples
    --------
    >>> seen = experience_of([("a", "x"), ("a", "y"), ("b", "x"), ("b", "y")],
    ...                      ["up", "up", "down", "down"])
    >>> relevant_features(seen, ["first", "second"], ("a", "x"), "up")
    ('first',)
    """
    known = [n for n, value in enumerate(vector) if value is not None]
    if not known:
        return ()
    agrees = np.array(
        [[other[n] == vector[n] for n in known] for other in experience], dtype=bool
    ).reshape(-1, len(known))
    totals = np.array([sum(counts.values()) for counts in experience.values()])
    of_class = np.array([counts.get(label, 0) for counts in experience.values()])
    everything = frozenset(range(len(known)))
    certain: float | None = None
    sufficient: dict[frozenset[int], int] = {}
    for size in range(len(known), 0, -1):
        for chosen in map(frozenset, combinations(everything, size)):
            alike = agrees[:, sorted(chosen)].all(axis=1)
            total = int(totals[alike].sum())
            if total == 0:
                continue
            share = float(of_class[alike].sum() / total)
            certain = share if size == len(known) else certain
            if (
                certain is not None
                and abs(share - certain) <= _AS_CERTAIN
                and all(chosen | {n} in sufficient for n in everything - chosen)
            ):
                sufficient[chosen] = total
    if not sufficient:
        return tuple(features[n] for n in known)
    best = min(sufficient, key=lambda subset: (len(subset), -sufficient[subset], sorted(subset)))
    return tuple(features[known[n]] for n in sorted(best))


class ReferenceAnswers:
    """The correct answer to a question about an annotated scene."""

    def __init__(self, domain: Domain, reasoned: ReasonedAnswers, experience: Experience) -> None:
        self.domain = domain
        self.reasoned = reasoned
        self.experience = experience
        self._known: dict[tuple[object, ...], AnswerType] = {}
        self._relevant: dict[tuple[FeatureVector, str], tuple[str, ...]] = {}

    def answer(self, question: Question, vector: FeatureVector, label: str) -> AnswerType:
        """Return the answer type for annotated features and the true class."""
        key = (question.query, vector, label)
        if key not in self._known:
            self._known[key] = self._answer(question, vector, label)
        return self._known[key]

    def _answer(self, question: Question, vector: FeatureVector, label: str) -> AnswerType:
        decides = self.reasoned.reasoner.decide(vector).label == label
        if decides or question.asks not in (Asks.WHY_CLASS, Asks.WHY_NOT_CLASS):
            kind = self.reasoned.kind(question, vector, label)
            if decides or len(kind.changes) < 2:
                return kind
            # One alternative is what a softmax over answer types can learn.
            if kind.form == "difference":
                return difference(self.domain, kind.changes[:1])
            return AnswerType(kind.form, kind.mentions, kind.changes[:1])
        same = question.label == label
        forms = {
            (Asks.WHY_CLASS, True): "reasons",
            (Asks.WHY_CLASS, False): "false_premise",
            (Asks.WHY_NOT_CLASS, True): "denied_not",
            (Asks.WHY_NOT_CLASS, False): "against",
        }
        if (vector, label) not in self._relevant:
            self._relevant[vector, label] = relevant_features(
                self.experience, list(self.domain.features), vector, label
            )
        return AnswerType(forms[question.asks, same], self._relevant[vector, label])
