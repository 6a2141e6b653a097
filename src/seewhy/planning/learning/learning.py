"""Learn axioms about what is usually so at first from the record of earlier runs.

The paper's robot learns so that people are usually where they work (section 4.3, hypothesis H4).
The learner is that of pictures (:mod:`seewhy.induction.learning`); what is a picture there is here
a fluent as a run first saw it, and its features are what is fixed about the fluent's arguments.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import binom, sem
from sklearn.model_selection import GroupKFold

from seewhy.errors import PlanningError
from seewhy.induction.candidate import Candidate, chance, tally
from seewhy.induction.generalisation import most_general
from seewhy.induction.learning import (
    BY_CHANCE,
    Decide,
    LearningOptions,
    decide_by_candidates,
    learn_axioms,
)
from seewhy.induction.scene_table import SceneTable, scene_table
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Axiom, Origin
from seewhy.knowledge.ground import fluent_of
from seewhy.knowledge.history import History
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.reasoner import Decision, Verdict
from seewhy.knowledge.scene import FeatureVector
from seewhy.planning.diagnosis import diagnose, explained, unexplained
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.learning.cases import Case, cases_of
from seewhy.planning.learning.features import NO, YES, FluentFeatures, features_of
from seewhy.planning.learning.preference import preferred
from seewhy.planning.learning.relations import Facts
from seewhy.planning.learning.usual import excluded, single, usual_sentence, usual_statement
from seewhy.planning.state import State

__all__ = ["THINGS", "LearnedFromRuns", "Rejected", "learn_from_runs"]

THINGS = "observations"
TOLERANCES = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4)
"""How often what is usual may be otherwise; the data choose."""
SUPPORT = 0.02
_FOLDS = 5
_AS_OFTEN_WRONG = 0.05
"""What is usual is right more often than wrong: so unlikely is the opposite."""


@dataclass(frozen=True)
class Rejected:
    """An axiom that fits the record and is not learned all the same, and why."""

    axiom: Axiom
    reason: str


@dataclass(frozen=True)
class LearnedFromRuns:
    """What came of learning from earlier runs.

    Attributes
    ----------
    axioms : tuple of Axiom
        With a sentence, and the observations that they rest on.
    rejected : tuple of Rejected
    tolerances : mapping of str to float
        Fluent → how often what is usual may be otherwise, as the record suggests.
    runs, observations : int
        How many runs the record has, and how many observations of it count.
    """

    axioms: tuple[Axiom, ...]
    rejected: tuple[Rejected, ...]
    tolerances: Mapping[str, float]
    runs: int
    observations: int


def learn_from_runs(
    domain: PlanningDomain,
    record: Sequence[History],
    *,
    names: Sequence[str] = (),
    support: float = SUPPORT,
    tolerance: float | None = None,
    seed: int = 0,
) -> LearnedFromRuns:
    """Learn what is usually so at first, and for whom it is not.

    Parameters
    ----------
    domain : PlanningDomain
        With the knowledge that the robot had in those runs. Of what this knowledge and
        ``history.al`` say at first nothing is learned.
    record : sequence of History
    names : sequence of str, optional
        What errors call the runs; by default "run 1" and so on.
    support : float
        The least share, of the observations that nothing explains, that an axiom speaks about.
    tolerance : float, optional
        How often what is usual may be otherwise; by default the record decides it, for every
        fluent: the greatest of :data:`TOLERANCES` within a standard error of the one that predicts
        the observations of left-out runs best.
    seed : int

    Notes
    -----
    An axiom concludes that a fluent holds and gives way to what is known. Things that it does not
    hold of are named in it, and of them it is learned that it is usually not so. That a fluent
    usually does not hold is learned only so: nearly everything is nearly nowhere.

    An axiom must be such that every recorded run can still be explained, and must leave what was
    believed at first as it was.

    Raises
    ------
    PlanningError
        If a run of the record cannot be explained by the knowledge as it is, or if no run shows
        anything that is not known at first.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.planning.domain import load_planning_domain
    >>> office = load_planning_domain("robot_assistant")
    >>> robot = office.without("loc(P, L) if work_place(P, L), not -loc(P, L).")
    >>> people, places = ("bob", "john", "sarah", "sally"), ("kitchen", "library")
    >>> seen = [f"observed loc({p}, {p}s_office) at {n}." for n, p in enumerate(people)]
    >>> seen += [f"observed -loc({p}, {own}) at 5." for p in people for own in places]
    >>> run = read_history(" ".join(seen), office.knowledge.signature)
    >>> for axiom in learn_from_runs(robot, [run] * 8).axioms:
    ...     print(axiom.text, "/", axiom, axiom.origin.support)  # doctest: +NORMALIZE_WHITESPACE
    if a person works in a place, then usually the person is in the place /
    loc(P, L) if work_place(P, L), not -loc(P, L). 32
    """
    names = names or [f"run {number}" for number in range(1, len(record) + 1)]
    _check_explained(domain, record, names)
    first = diagnose(domain.knowledge, domain.history).states[0]
    cases = [own for own in cases_of(domain.knowledge, record) if own.fluent in first.unknown]
    if not cases:
        raise PlanningError(
            "the record shows nothing of which the knowledge leaves open how it is at first, so "
            "nothing is to be learned from it; leave out what shall be learned (--without AXIOM), "
            "or record runs in which more is seen"
        )
    facts = Facts(domain.knowledge)
    found: list[Axiom] = []
    tolerances: dict[str, float] = {}
    for fluent in sorted({own.fluent.name for own in cases}):
        some = [own for own in cases if own.fluent.name == fluent]
        if not any(own.holds for own in some):
            continue
        features = features_of(domain.knowledge.signature, facts, some)
        options = LearningOptions(support=support, tolerance=tolerance or 0.0, seed=seed)
        if tolerance is None:
            options = replace(options, tolerance=_tolerance(features, some, options))
        learned = _learned(domain, features, some, options)
        if learned:
            tolerances[fluent] = options.tolerance
        found += learned
    kept, rejected = _validated(domain, dict(zip(names, record, strict=True)), first, found)
    return LearnedFromRuns(
        axioms=tuple(
            replace(own, identifier=f"l{number}") for number, own in enumerate(kept, start=1)
        ),
        rejected=tuple(rejected),
        tolerances=tolerances,
        runs=len(record),
        observations=len(cases),
    )


def _sensors_err(domain: PlanningDomain) -> bool:
    return any(own.error for own in domain.sensing)


def _check_explained(
    domain: PlanningDomain, record: Sequence[History], names: Sequence[str]
) -> None:
    for name, run in zip(names, record, strict=True):
        if not explained(domain.knowledge, run, sensors_err=_sensors_err(domain)):
            raise PlanningError(f"{name}: {unexplained(domain.knowledge, run)}")


def _label(case: Case) -> str:
    return YES if case.holds else NO


def _learned(
    domain: PlanningDomain,
    features: FluentFeatures,
    cases: Sequence[Case],
    options: LearningOptions,
) -> list[Axiom]:
    """The axioms about one fluent: what usually holds, then what usually does not."""
    vectors = [features.vector(own.fluent) for own in cases]
    labels = list(map(_label, cases))
    table = scene_table(features.values, vectors, labels)
    usual = _usual(features, table, _by_diagnosis(domain, features, cases), options)
    exceptions = [own for candidate in usual for own in _exceptions(candidate, features, table)]
    return [_axiom(own, features, domain, table) for own in (*usual, *dict.fromkeys(exceptions))]


def _usual(
    features: FluentFeatures, table: SceneTable, decide: Decide, options: LearningOptions
) -> list[Candidate]:
    """The candidates by which the fluent usually holds, each one axiom."""
    scenes = [own for row in range(len(table.vectors)) for own in _scenes(table, row)]
    learned = learn_axioms(
        features.values,
        [vector for vector, _ in scenes],
        [label for _, label in scenes],
        decide=decide,
        options=options,
    )
    found = [
        preferred(_with_usual_things(own.candidate, features, table), features, table)
        for own in learned.accepted
        if own.candidate.label == YES
    ]
    every = [one for own in found for one in single(own, features) if _is_usual(one, table)]
    return most_general(every)


def _with_usual_things(
    candidate: Candidate, features: FluentFeatures, table: SceneTable
) -> Candidate:
    """Take back things that a candidate leaves out, though it is usually right of them, too.

    What is usual has exceptions; more of them than elsewhere are no reason to know nothing.
    """
    for opposite, thing in excluded(candidate, features):
        found = tally(opposite, table)
        if found.wrong > found.right:
            conditions = []
            for own in candidate.conditions:
                values = features.values[own.feature]
                allowed = own.values
                if own.feature == thing.feature:
                    allowed = tuple(v for v in values if v in (*own.values, *thing.values))
                if allowed != values:
                    conditions.append(PathCondition(own.feature, allowed))
            candidate = Candidate(candidate.label, tuple(conditions))
    return candidate


def _is_usual(one: Candidate, table: SceneTable) -> bool:
    """Whether an axiom by itself is right more often than not, and than chance explains.

    A candidate about several things may owe its evidence to some of them.
    """
    found = tally(one, table)
    as_often_wrong = binom.sf(found.right - 1, found.right + found.wrong, 0.5)
    return bool(as_often_wrong <= _AS_OFTEN_WRONG) and chance(one, table, found) <= BY_CHANCE


def _exceptions(
    candidate: Candidate, features: FluentFeatures, table: SceneTable
) -> Iterator[Candidate]:
    """Yield that things which an axiom leaves out are usually otherwise than it says.

    Chance is judged among what the axiom would speak about, did it leave nothing out.
    """
    for own, thing in excluded(candidate, features):
        every = tuple(o for o in own.conditions if o != thing)
        rows = np.flatnonzero(table.satisfying(every))
        spoken = [(v, c) for row in rows for v, c in _scenes(table, int(row))]
        among = scene_table(features.values, [v for v, _ in spoken], [c for _, c in spoken])
        alone = Candidate(own.label, (thing,))
        if _is_usual(alone, among):
            yield own


def _scenes(table: SceneTable, row: int) -> Iterator[tuple[FeatureVector, str]]:
    for label, count in zip(table.classes, table.counts[row], strict=True):
        for _ in range(int(count)):
            yield table.vectors[row], label


def _axiom(
    candidate: Candidate, features: FluentFeatures, domain: PlanningDomain, table: SceneTable
) -> Axiom:
    said = usual_sentence(candidate, features, domain.words)
    text = f"%% {said}\n{usual_statement(candidate, features)}"
    (axiom,) = read_axioms(text, domain.knowledge.signature)
    spoken = tally(candidate, table)
    return replace(
        axiom,
        origin=Origin(
            learned=True,
            support=spoken.right + spoken.wrong,
            precision=spoken.precision,
            things=THINGS,
        ),
    )


def _by_diagnosis(
    domain: PlanningDomain, features: FluentFeatures, cases: Sequence[Case]
) -> Decide:
    """How candidates decide with the knowledge around them: what is then believed at first.

    Candidates by which something usually does not hold become no axioms, and decide nothing.
    """
    fluents = {features.vector(own.fluent): own.fluent for own in cases}
    table = scene_table(features.values, list(fluents), [YES] * len(fluents))
    remembered: dict[tuple[Candidate, ...], State | None] = {}

    def believed(holding: tuple[Candidate, ...]) -> State | None:
        if holding not in remembered:
            same = [preferred(own, features, table) for own in holding]
            text = "\n".join(
                usual_statement(one, features) for own in same for one in single(own, features)
            )
            axioms = read_axioms(text, domain.knowledge.signature, letter="c")
            remembered[holding] = _at_first(domain.knowing(axioms))
        return remembered[holding]

    def decide(candidates: Sequence[Candidate], vectors: Sequence[FeatureVector]) -> list[Decision]:
        state = believed(tuple(own for own in candidates if own.label == YES))
        if state is None:
            return [Decision(None, Verdict.CONTRADICTION)] * len(vectors)
        labels = {fluent_of(own): YES if own.positive else NO for own in state.holds}
        found = (labels.get(fluents[tuple(vector)]) for vector in vectors)
        return [_decision(label) for label in found]

    return decide


def _decision(label: str | None) -> Decision:
    return Decision(label, Verdict.SILENT if label is None else Verdict.BELIEVED)


def _at_first(domain: PlanningDomain) -> State | None:
    """What is believed at first; None where nothing can be."""
    try:
        return diagnose(domain.knowledge, domain.history).states[0]
    except PlanningError:
        return None


def _tolerance(features: FluentFeatures, cases: Sequence[Case], options: LearningOptions) -> float:
    """The greatest tolerance within a standard error of the one that predicts best."""
    folds = min(_FOLDS, len({own.run for own in cases}))
    if folds < 2:
        return 0.0
    vectors = [features.vector(own.fluent) for own in cases]
    labels = list(map(_label, cases))
    groups = [own.run for own in cases]
    scores = []
    for tolerance in TOLERANCES:
        right = []
        for train, test in GroupKFold(folds).split(vectors, labels, groups):
            predict = _predictor(
                features,
                [vectors[n] for n in train],
                [labels[n] for n in train],
                replace(options, tolerance=tolerance),
            )
            predicted = predict([vectors[n] for n in test])
            right.append(np.mean([predicted[m] == labels[n] for m, n in enumerate(test)]))
        scores.append(right)
    means = np.mean(scores, axis=1)
    best = int(np.argmax(means))
    least = means[best] - sem(scores[best])
    return max(own for own, mean in zip(TOLERANCES, means, strict=True) if mean >= least)


def _predictor(
    features: FluentFeatures,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
    options: LearningOptions,
) -> Callable[[Sequence[FeatureVector]], list[str]]:
    """Learn from some cases alone; where no axiom says that a fluent holds, it does not."""
    by_all = decide_by_candidates(features.values)

    def decide(some: Sequence[Candidate], asked: Sequence[FeatureVector]) -> Sequence[Decision]:
        return by_all([own for own in some if own.label == YES], asked)

    table = scene_table(features.values, vectors, labels)
    holding = _usual(features, table, decide, options)
    return lambda some: [own.label or NO for own in decide(holding, some)]


def _validated(
    domain: PlanningDomain, record: Mapping[str, History], first: State, found: Sequence[Axiom]
) -> tuple[list[Axiom], list[Rejected]]:
    """Keep axioms with which the record can be explained and the old beliefs stay."""
    errors = _sensors_err(domain)
    kept: list[Axiom] = []
    rejected: list[Rejected] = []
    for number, axiom in enumerate(found):
        own = replace(axiom, identifier=f"n{number}")
        with_it = domain.knowing([*kept, own])
        now = _at_first(with_it)
        reason = next(_objections(with_it, now, record, first, errors), None)
        if reason is None and now is not None:
            kept.append(own)
            first = now
        else:
            rejected.append(Rejected(axiom, reason or ""))
    return kept, rejected


def _objections(
    domain: PlanningDomain,
    now: State | None,
    record: Mapping[str, History],
    before: State,
    errors: bool,
) -> Iterator[str]:
    if now is None:
        yield "nothing can be believed with it"
        return
    if now.holds == before.holds:
        yield "others say the same"
    for literal in sorted(before.holds - now.holds):
        yield f"'{literal}' would no longer be believed at first"
    for name, run in record.items():
        if not explained(domain.knowledge, run, sensors_err=errors):
            yield f"{name} could not be explained with it"
