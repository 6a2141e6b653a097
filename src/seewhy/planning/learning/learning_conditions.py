"""Learn what actions do not achieve, and of which things: executability conditions.

The learner is that of what is usual at first (:mod:`seewhy.planning.learning.candidates`). What is
usual here is that an action does not bring about what it should; a case is an attempt.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import clingo
import numpy as np

from seewhy.induction.axiom_learning import BY_CHANCE, LearningOptions
from seewhy.induction.binomial import at_least
from seewhy.induction.candidate import Candidate, Tally, tally
from seewhy.induction.scene_table import SceneTable, scene_table
from seewhy.knowledge.axiom import Axiom, Origin
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.scene import FeatureVector
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.learning.attempt_features import attempt_features
from seewhy.planning.learning.attempts import Attempt, spoken_about
from seewhy.planning.learning.candidates import default_candidates
from seewhy.planning.learning.cases import Run
from seewhy.planning.learning.executability import exceptions_in, impossible_statement
from seewhy.planning.learning.executability_sentence import Effect, impossible_sentence
from seewhy.planning.learning.features import NO, YES, ArgumentFeatures
from seewhy.planning.learning.one_standard_error import decide_what_holds, suggested_tolerance
from seewhy.planning.learning.relations import Facts
from seewhy.planning.learning.validation import RecordedRun, Rejected

__all__ = ["ATTEMPTS", "LearnedConditions", "learn_conditions"]

ATTEMPTS = "attempts"
_FEWEST_RUNS = 5
"""Of so many runs a fifth is held back; of fewer none."""


@dataclass
class LearnedConditions:
    """What came of learning from attempts.

    Attributes
    ----------
    axioms : list of Axiom
        Executability conditions, with a sentence and the attempts that they rest on.
    rejected : list of Rejected
        Those that the runs held back speak against.
    tolerances : dict of str to float
        Action → how often what is usual may be otherwise.
    held_back : int
        How many runs.
    judged : dict of str to Tally
        Axiom → how the runs held back bear it out.
    """

    axioms: list[Axiom] = field(default_factory=list)
    rejected: list[Rejected] = field(default_factory=list)
    tolerances: dict[str, float] = field(default_factory=dict)
    held_back: int = 0
    judged: dict[str, Tally] = field(default_factory=dict)


def learn_conditions(
    domain: PlanningDomain,
    runs: Sequence[RecordedRun],
    attempts: Sequence[Attempt],
    *,
    tolerance: float | None,
    options: LearningOptions,
) -> LearnedConditions:
    """Return what actions usually do not achieve, by what they are done to.

    Parameters
    ----------
    domain : PlanningDomain
    runs : sequence of RecordedRun
    attempts : sequence of Attempt
        In those runs. What the knowledge holds impossible is not counted.
    tolerance : float or None
        How often what is usual may be otherwise; None leaves it to the attempts of each action.
    options : LearningOptions

    Notes
    -----
    A fifth of the runs is held back where there are five or more. The others propose; those that
    are held back must not speak against it. What is then said of support is of all runs.

    The language has no default about what actions bring about. What usually does not work is
    therefore said as impossible, with what makes exceptions of it: a plan never relies on it.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> table = load_planning_domain("tabletop")
    >>> learn_conditions(table, [], [], tolerance=None, options=LearningOptions()).axioms
    []
    """
    judging = _held_back(len(runs), seed=options.seed)
    found = LearnedConditions(held_back=len(judging))
    learned = [axiom for axiom in domain.knowledge.axioms if axiom.origin.learned]
    new = [
        attempt
        for attempt in attempts
        if not spoken_about(runs[attempt.run][1].knowledge, learned, attempt)
    ]
    learner = _Learner(domain, runs, judging, tolerance, options)
    for name in sorted({attempt.action.name for attempt in new}):
        learner.learn_of([attempt for attempt in new if attempt.action.name == name], found)
    return found


def _held_back(runs: int, *, seed: int) -> frozenset[Run]:
    """A fifth of the runs, chosen by chance; none where there are few."""
    if runs < _FEWEST_RUNS:
        return frozenset()
    order = np.random.default_rng(seed).permutation(runs)
    return frozenset(order[: runs // _FEWEST_RUNS].tolist())


class _Learner:
    """Learns of one action after the other from the same runs."""

    def __init__(
        self,
        domain: PlanningDomain,
        runs: Sequence[RecordedRun],
        judging: frozenset[Run],
        tolerance: float | None,
        options: LearningOptions,
    ) -> None:
        self.domain, self.judging = domain, judging
        self.tolerance, self.options = tolerance, options
        self.facts = {number: Facts(about.knowledge) for number, (_, about, _) in enumerate(runs)}

    def learn_of(self, attempts: Sequence[Attempt], found: LearnedConditions) -> None:
        """Add what is learned from the attempts of one action."""
        things = None if self.domain.at_first is None else self.domain.at_first.things.sort
        signature = self.domain.knowledge.signature
        features, vectors = attempt_features(signature, attempts, self.facts, things=things)
        every = _Cases(features, attempts, vectors)
        proposing = every.of_runs(lambda run: run not in self.judging)
        held_back = every.of_runs(lambda run: run in self.judging)
        if YES not in proposing.labels:
            return
        options = self._options(proposing)
        table = proposing.table
        for candidate in default_candidates(features, table, decide_what_holds(features), options):
            axiom = self._axiom(candidate, proposing, every)
            judged = tally(candidate, held_back.table)
            reason = _speaks_against(judged, options.tolerance)
            if reason is not None:
                found.rejected.append(Rejected(axiom, reason))
                continue
            found.axioms.append(axiom)
            found.judged[str(axiom)] = judged
            found.tolerances[features.predicate] = options.tolerance

    def _options(self, cases: _Cases) -> LearningOptions:
        """How often what is usual may be otherwise: as it is said, or as the cases suggest."""
        suggested = self.tolerance
        if suggested is None:
            suggested = suggested_tolerance(
                cases.features, cases.vectors, cases.labels, cases.runs, self.options
            )
        return replace(self.options, tolerance=suggested)

    def _axiom(self, candidate: Candidate, proposing: _Cases, every: _Cases) -> Axiom:
        """A candidate as an axiom that rests on all attempts that it speaks about."""
        features, words = every.features, self.domain.words
        unless = frozenset(exceptions_in(candidate, features, proposing.table))
        missed = every.most_missed(candidate)
        said = impossible_sentence(candidate, features, words, missed, unless=unless)
        statement = impossible_statement(candidate, features, unless=unless)
        (axiom,) = read_axioms(f"%% {said}\n{statement}", self.domain.knowledge.signature)
        whole = tally(candidate, every.table)
        support = whole.right + whole.wrong
        origin = Origin(learned=True, support=support, precision=whole.precision, things=ATTEMPTS)
        return replace(axiom, origin=origin)


def _speaks_against(judged: Tally, tolerance: float) -> str | None:
    """Why runs that were held back refute an axiom; None where they do not."""
    spoken = judged.right + judged.wrong
    beyond = at_least(judged.wrong, spoken, tolerance) < BY_CHANCE if judged.wrong else False
    if judged.wrong > judged.right or beyond:
        return f"{judged.wrong} of {spoken} attempts of it in the runs held back succeeded"
    return None


@dataclass(frozen=True)
class _Cases:
    """Attempts of one action, with the features of what they were done to."""

    features: ArgumentFeatures
    attempts: Sequence[Attempt]
    vectors: Sequence[FeatureVector]

    @property
    def labels(self) -> list[str]:
        """Whether each did not bring about what it should."""
        return [YES if attempt.missed else NO for attempt in self.attempts]

    @property
    def runs(self) -> list[Run]:
        """Of which run each is."""
        return [attempt.run for attempt in self.attempts]

    @cached_property
    def table(self) -> SceneTable:
        """The cases, equal ones put together."""
        return scene_table(self.features.values, self.vectors, self.labels)

    def of_runs(self, are_meant: Callable[[Run], bool]) -> _Cases:
        """The cases of some runs."""
        kept = [n for n, attempt in enumerate(self.attempts) if are_meant(attempt.run)]
        return replace(
            self,
            attempts=[self.attempts[n] for n in kept],
            vectors=[self.vectors[n] for n in kept],
        )

    def most_missed(self, candidate: Candidate) -> Effect | None:
        """What most often does not come of what a candidate speaks about, in the arguments."""
        rows = self.table.satisfying(candidate.conditions)
        spoken = {n for row in np.flatnonzero(rows) for n in self.table.scenes[row]}
        counts = Counter(
            effect
            for n in sorted(spoken)
            for literal in self.attempts[n].missed
            for effect in _in_arguments(literal, self.attempts[n].action)
        )
        return counts.most_common(1)[0][0] if counts else None


def _in_arguments(literal: clingo.Symbol, action: clingo.Symbol) -> Iterator[Effect]:
    """What a literal says of the arguments of an action; nothing where it is of others, too."""
    terms = list(action.arguments)
    if all(argument in terms for argument in literal.arguments):
        places = tuple(terms.index(argument) for argument in literal.arguments)
        yield Effect(literal.name, places, literal.positive)
