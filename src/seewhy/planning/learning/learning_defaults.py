"""Learn axioms about what is usually so at first from the record of earlier runs.

The paper's robot learns so that people are usually where they work (hypothesis H4).
The learner is that of pictures (:mod:`seewhy.induction.axiom_learning`); what is a picture there
is here a fluent as a run first saw it, and its features are what is fixed about the fluent's
arguments.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from seewhy.errors import PlanningError
from seewhy.induction.axiom_learning import Decide, LearningOptions
from seewhy.induction.candidate import Candidate, tally
from seewhy.induction.scene_table import SceneTable, scene_table
from seewhy.knowledge.axiom import Axiom, Origin
from seewhy.knowledge.ground import fluent_of
from seewhy.knowledge.history import History
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.reasoner import Decision, Verdict
from seewhy.knowledge.scene import FeatureVector
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.learning.candidates import default_candidates, exceptions
from seewhy.planning.learning.cases import Case, cases_of
from seewhy.planning.learning.default_sentence import default_sentence
from seewhy.planning.learning.features import NO, YES, FluentFeatures, features_of
from seewhy.planning.learning.learned_defaults import default_statement, single
from seewhy.planning.learning.one_standard_error import suggested_tolerance
from seewhy.planning.learning.preference import preferred
from seewhy.planning.learning.relations import Facts
from seewhy.planning.learning.validation import Rejected, at_first, check_explained, validated

__all__ = ["THINGS", "LearnedFromRuns", "Rejected", "learn_from_runs"]

THINGS = "observations"
SUPPORT = 0.02


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
        fluent (:func:`~seewhy.planning.learning.one_standard_error.suggested_tolerance`).
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
    >>> seen += [f"observed -loc({p}, {place}) at 5." for p in people for place in places]
    >>> run = read_history(" ".join(seen), office.knowledge.signature)
    >>> for axiom in learn_from_runs(robot, [run] * 8).axioms:
    ...     print(axiom.text, "/", axiom, axiom.origin.support)  # doctest: +NORMALIZE_WHITESPACE
    if a person works in a place, then usually the person is in the place /
    loc(P, L) if work_place(P, L), not -loc(P, L). 32
    """
    names = names or [f"run {number}" for number in range(1, len(record) + 1)]
    check_explained(domain, dict(zip(names, record, strict=True)))
    first = diagnose(domain.knowledge, domain.history).states[0]
    cases = [case for case in cases_of(domain.knowledge, record) if case.fluent in first.unknown]
    if not cases:
        raise PlanningError(
            "the record shows nothing of which the knowledge leaves open how it is at first, so "
            "nothing is to be learned from it; leave out what shall be learned (--without AXIOM), "
            "or record runs in which more is seen"
        )
    facts = Facts(domain.knowledge)
    found: list[Axiom] = []
    tolerances: dict[str, float] = {}
    for fluent in sorted({case.fluent.name for case in cases}):
        some = [case for case in cases if case.fluent.name == fluent]
        if not any(case.holds for case in some):
            continue
        features = features_of(domain.knowledge.signature, facts, some)
        options = LearningOptions(support=support, tolerance=tolerance or 0.0, seed=seed)
        if tolerance is None:
            options = replace(options, tolerance=suggested_tolerance(features, some, options))
        learned = _learned(domain, features, some, options)
        if learned:
            tolerances[fluent] = options.tolerance
        found += learned
    kept, rejected = validated(domain, dict(zip(names, record, strict=True)), first, found)
    return LearnedFromRuns(
        axioms=tuple(
            replace(axiom, identifier=f"l{number}") for number, axiom in enumerate(kept, start=1)
        ),
        rejected=tuple(rejected),
        tolerances=tolerances,
        runs=len(record),
        observations=len(cases),
    )


def _learned(
    domain: PlanningDomain,
    features: FluentFeatures,
    cases: Sequence[Case],
    options: LearningOptions,
) -> list[Axiom]:
    """The axioms about one fluent: what usually holds, then what usually does not."""
    vectors = [features.vector(case.fluent) for case in cases]
    labels = [YES if case.holds else NO for case in cases]
    table = scene_table(features.values, vectors, labels)
    usual = default_candidates(features, table, _by_diagnosis(domain, features, cases), options)
    denied = dict.fromkeys(
        exception for candidate in usual for exception in exceptions(candidate, features, table)
    )
    return [_axiom(candidate, features, domain, table) for candidate in (*usual, *denied)]


def _axiom(
    candidate: Candidate, features: FluentFeatures, domain: PlanningDomain, table: SceneTable
) -> Axiom:
    said = default_sentence(candidate, features, domain.words)
    text = f"%% {said}\n{default_statement(candidate, features)}"
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
    fluents = {features.vector(case.fluent): case.fluent for case in cases}
    table = scene_table(features.values, list(fluents), [YES] * len(fluents))
    remembered: dict[tuple[Candidate, ...], State | None] = {}

    def believed(holding: tuple[Candidate, ...]) -> State | None:
        if holding not in remembered:
            same = [preferred(candidate, features, table) for candidate in holding]
            text = "\n".join(
                default_statement(part, features)
                for candidate in same
                for part in single(candidate, features)
            )
            axioms = read_axioms(text, domain.knowledge.signature, letter="c")
            remembered[holding] = at_first(domain.knowing(axioms))
        return remembered[holding]

    def decide(candidates: Sequence[Candidate], vectors: Sequence[FeatureVector]) -> list[Decision]:
        state = believed(tuple(candidate for candidate in candidates if candidate.label == YES))
        if state is None:
            return [Decision(None, Verdict.CONTRADICTION)] * len(vectors)
        labels = {fluent_of(literal): YES if literal.positive else NO for literal in state.holds}
        found = (labels.get(fluents[tuple(vector)]) for vector in vectors)
        return [_decision(label) for label in found]

    return decide


def _decision(label: str | None) -> Decision:
    return Decision(label, Verdict.SILENT if label is None else Verdict.BELIEVED)
