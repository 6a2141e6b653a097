"""Whether the reasons that an answer gives suffice, by the annotation of all scenes alone.

A decision often has several reasons that are equally true. A set of a scene's values is a
sufficient reason for its class where they settle the class whatever the other values are: a prime
implicant of the decision, where none can be left out (Shih, Choi and Darwiche, "A symbolic approach
to explaining Bayesian network classifiers", IJCAI 2018; Darwiche and Hirth, "On the reasons behind
decisions", ECAI 2020). There the decision is a function of the values. Here it is the annotation,
which the values settle only for the most part: what all of them say of the class bounds what any
reason can say, so a reason is measured by that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from seewhy.dialogue.answer import AnswerType, Changes
from seewhy.dialogue.question import Asks, Question
from seewhy.dialogue.reference import Experience, ReferenceAnswers
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.vector_index import VectorIndex

__all__ = ["ENOUGH", "Sufficiency", "Values", "answer_suffices", "sufficiency_of"]

ENOUGH = 0.9
"""How much of what all values of a scene say of its class a sufficient reason has to say.

Nine tenths: of two classes that are equally frequent and settled by all values together, a reason
leaves one scene in twenty to chance, which is also what learning may take to be annotated wrongly.
Measured from what is known without any value, because most scenes are not of a given one of many
classes, so that any value, or none, would do for "why is it not …".
"""

Values = frozenset[tuple[str, str]]
"""(feature, value) pairs that scenes may share."""

_REASONS = (Asks.WHY_CLASS, Asks.WHY_NOT_CLASS)
_PROPOSALS = {Asks.CHANGE_TO_CLASS: "change", Asks.DIFFERENCE_TO_CLASS: "difference"}


class Sufficiency:
    """What values say of a class among all annotated scenes, and what class changes lead to.

    Parameters
    ----------
    experience : mapping
        The classes of all annotated scenes.
    features : sequence of str
        The names of the features, in the order of the vectors.
    decide : callable
        The class of a feature vector that no scene has, or None.

    Examples
    --------
    >>> seen = {("a", "x"): {"up": 2}, ("a", "y"): {"up": 2}, ("b", "x"): {"down": 4}}
    >>> sufficiency = Sufficiency(seen, ["first", "second"], decide=lambda vector: None)
    >>> scene, up = frozenset({("first", "a"), ("second", "x")}), frozenset({"up"})
    >>> sufficiency.suffices(frozenset({("first", "a")}), scene, up)
    True
    >>> sufficiency.suffices(frozenset({("second", "x")}), scene, up)
    False
    >>> sufficiency.leads_to(("a", "x"), (("first", "b"),), "down")
    True
    """

    def __init__(
        self,
        experience: Experience,
        features: Sequence[str],
        *,
        decide: Callable[[FeatureVector], str | None],
    ) -> None:
        self.classes = frozenset(label for counts in experience.values() for label in counts)
        self._features = tuple(features)
        self._experience = experience
        self._decide = decide
        self._totals = np.array([sum(counts.values()) for counts in experience.values()])
        self._of_class = {
            label: np.array([counts.get(label, 0) for counts in experience.values()])
            for label in self.classes
        }
        self._index = VectorIndex(list(experience))
        self._gains: dict[tuple[Values, frozenset[str]], float] = {}

    def values(self, vector: FeatureVector) -> Values:
        """All values of a scene that are known."""
        pairs = zip(self._features, vector, strict=True)
        return frozenset((feature, value) for feature, value in pairs if value is not None)

    def gain(self, values: Values, labels: frozenset[str]) -> float:
        """By how much more often scenes with the values are of one of the classes than all are.

        0 where no scene has the values, which then say nothing.
        """
        key = (values, labels)
        if key not in self._gains:
            share, least = self._share(values, labels), self._share(frozenset(), labels)
            self._gains[key] = 0.0 if share is None or least is None else share - least
        return self._gains[key]

    def _share(self, values: Values, labels: frozenset[str]) -> float | None:
        """The share of the scenes with the values that are of one of the classes, if any has."""
        alike = self._index.showing(
            (self._features.index(feature), value) for feature, value in values
        )
        total = int(self._totals[alike].sum())
        of_class = [int(self._of_class[label][alike].sum()) for label in labels & self.classes]
        return sum(of_class) / total if total else None

    def accountable(self, scene: Values, labels: frozenset[str]) -> bool:
        """Whether a scene's values speak for the classes, so that there can be a reason at all."""
        return self.gain(scene, labels) > 0.0

    def suffices(self, reason: Values, scene: Values, labels: frozenset[str]) -> bool:
        """Whether some of a scene's values say nearly all that all of them say of the classes.

        Nothing suffices where they do not speak for the classes.
        """
        return (
            reason <= scene
            and self.accountable(scene, labels)
            and self.gain(reason, labels) >= ENOUGH * self.gain(scene, labels)
        )

    def class_of(self, vector: FeatureVector) -> str | None:
        """The class of most scenes with a feature vector; where there is none, the decided one."""
        counts = self._experience.get(vector)
        if not counts:
            return self._decide(vector)
        label = max(counts, key=lambda class_name: counts[class_name])
        return label if 2 * counts[label] > sum(counts.values()) else None

    def leads_to(self, vector: FeatureVector, changes: Changes, label: str) -> bool:
        """Whether a scene is of a class once it is changed; what is so already is no change."""
        before = dict(zip(self._features, vector, strict=True))
        if not changes or any(before[feature] == value for feature, value in changes):
            return False
        after = {**before, **dict(changes)}
        return self.class_of(tuple(after[feature] for feature in self._features)) == label


def sufficiency_of(reference: ReferenceAnswers) -> Sufficiency:
    """What suffices among the scenes that an annotator knows, and by what else he knows."""
    reasoner = reference.reasoned.reasoner
    return Sufficiency(
        reference.experience,
        list(reference.domain.features),
        decide=lambda vector: reasoner.decide(vector).label,
    )


def answer_suffices(
    kind: AnswerType,
    gold: AnswerType,
    question: Question,
    vector: FeatureVector,
    label: str,
    *,
    seen: Mapping[str, str | None],
    strict: bool,
    sufficiency: Sufficiency,
) -> bool:
    """Whether an explanatory answer about an annotated scene is true, and its reasons suffice.

    - Everything that it mentions has to be seen as it is annotated.
    - Why a scene is of a class: the values mentioned suffice for the class. Why it is not of
      another: they suffice for not being of that one. The answer takes the form of the correct
      one, which says whether what the question presumes is so.
    - What would have to change, and how a scene differs from a class: with any of the changes
      proposed, it is of the class asked about, among the annotated scenes.

    Where no reason can suffice, because a scene's values do not speak for its class, and where an
    answer gives none, it is judged as ``strict`` says: by the reasons of the correct answer.

    That nothing mentioned could be left out is not asked for, as it is of a prime implicant: the
    knowledge names the conditions of all axioms that apply. Of the annotator's own answers about
    6,000 structures every one counts as right here; but 43 % of his reasons have a value that could
    be left out, and for 24 % of his changes a part would do. So a true answer that mentions all
    values nearly always counts as right, too; ``strict`` is the measure that forbids it.

    Parameters
    ----------
    kind, gold : AnswerType
        The answer, and the annotator's.
    question : Question
    vector, label : FeatureVector, str
        The annotation of the scene.
    seen : mapping
        The features as the answer names them.
    strict : bool
        Whether the answer gives exactly the annotator's reasons.
    sufficiency : Sufficiency

    Examples
    --------
    >>> experience = {("2", "no"): {"stable": 9}, ("5", "yes"): {"unstable": 9}}
    >>> sufficiency = Sufficiency(experience, ["blocks", "lean"], decide=lambda vector: None)
    >>> question = Question(Asks.WHY_CLASS, "", (), label="stable")
    >>> answer_suffices(
    ...     AnswerType("reasons", ("lean",)), AnswerType("reasons", ("blocks",)), question,
    ...     ("2", "no"), "stable", seen={"blocks": "2", "lean": "no"}, strict=False,
    ...     sufficiency=sufficiency,
    ... )
    True
    """
    scene = sufficiency.values(vector)
    reason = _said(kind.mentions, seen)
    if reason is None or not reason <= scene:
        return False
    if kind.form in _PROPOSALS.values():
        asked = question.label
        return (
            kind.form == _PROPOSALS.get(question.asks)
            and asked is not None
            and asked != label
            and bool(kind.changes)
            and all(sufficiency.leads_to(vector, change, asked) for change in kind.changes)
        )
    if kind.form != gold.form or not reason or question.asks not in _REASONS:
        return strict
    labels = frozenset({label})
    if question.asks is Asks.WHY_NOT_CLASS and question.label not in (None, label):
        labels = sufficiency.classes - {question.label}
    if not sufficiency.accountable(scene, labels):
        return strict
    return sufficiency.suffices(reason, scene, labels)


def _said(mentions: Iterable[str], seen: Mapping[str, str | None]) -> Values | None:
    """The values that an answer names; None where it names one that it did not see."""
    said = {feature: seen[feature] for feature in mentions}
    named = frozenset((feature, value) for feature, value in said.items() if value is not None)
    return named if len(named) == len(said) else None
