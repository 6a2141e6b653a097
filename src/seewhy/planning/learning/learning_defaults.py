"""Learn what is usually so at first.

The paper's robot learns so that people are usually where they work (hypothesis H4).
The learner is that of pictures (:mod:`seewhy.induction.axiom_learning`); what is a picture there
is here a fluent as a run first saw it, and its features are what is fixed about the fluent's
arguments.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

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
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.learning.candidates import default_candidates, exceptions
from seewhy.planning.learning.cases import Case, cases_of
from seewhy.planning.learning.default_sentence import default_sentence
from seewhy.planning.learning.features import NO, YES, FluentFeatures, features_of
from seewhy.planning.learning.learned_defaults import default_statement, single
from seewhy.planning.learning.one_standard_error import suggested_tolerance
from seewhy.planning.learning.preference import preferred
from seewhy.planning.learning.relations import Facts
from seewhy.planning.learning.validation import at_first

__all__ = ["OBSERVATIONS", "learn_defaults", "open_cases"]

OBSERVATIONS = "observations"


def open_cases(domain: PlanningDomain, record: Sequence[History], first: State) -> list[Case]:
    """Return what runs show of that of which the knowledge leaves open how it is at first."""
    return [case for case in cases_of(domain.knowledge, record) if case.fluent in first.unknown]


def learn_defaults(
    domain: PlanningDomain,
    cases: Sequence[Case],
    *,
    tolerance: float | None,
    options: LearningOptions,
) -> tuple[list[Axiom], dict[str, float]]:
    """Return what is usually so at first, and of which fluents with what tolerance.

    An axiom concludes that a fluent holds and gives way to what is known. Things that it does not
    hold of are named in it, and of them it is learned that it is usually not so. That a fluent
    usually does not hold is learned only so: nearly everything is nearly nowhere.

    Parameters
    ----------
    domain : PlanningDomain
    cases : sequence of Case
        Of :func:`open_cases`.
    tolerance : float or None
        How often what is usual may be otherwise; None leaves it to the cases of each fluent.
    options : LearningOptions

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> learn_defaults(load_planning_domain("robot_assistant"), [], tolerance=None,
    ...     options=LearningOptions())
    ([], {})
    """
    facts = Facts(domain.knowledge)
    found: list[Axiom] = []
    tolerances: dict[str, float] = {}
    for fluent in sorted({case.fluent.name for case in cases}):
        some = [case for case in cases if case.fluent.name == fluent]
        if not any(case.holds for case in some):
            continue
        features = features_of(domain.knowledge.signature, facts, some)
        chosen = replace(options, tolerance=tolerance or 0.0)
        if tolerance is None:
            vectors = [features.vector(case.fluent) for case in some]
            labels = [YES if case.holds else NO for case in some]
            runs = [case.run for case in some]
            suggested = suggested_tolerance(features, vectors, labels, runs, chosen)
            chosen = replace(chosen, tolerance=suggested)
        learned = _learned(domain, features, some, chosen)
        if learned:
            tolerances[fluent] = chosen.tolerance
        found += learned
    return found, tolerances


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
            things=OBSERVATIONS,
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
