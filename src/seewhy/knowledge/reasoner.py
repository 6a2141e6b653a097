"""Decide scenes: ground once, solve under assumptions, remember by feature vector."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import Literal as OneOf

import clingo

from seewhy.knowledge.answer_set import AnswerSet, answer_set_of
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.batch import SCENES, Batch, Outcome
from seewhy.knowledge.grounding import Grounding, Search
from seewhy.knowledge.grounding_size import GroundingSize, grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.odd_loop import OddLoops
from seewhy.knowledge.possible import PossibleInstances
from seewhy.knowledge.program import program_text
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.sufficient import SufficientFeatures

Minimality = OneOf["cardinality", "inclusion"]
_WORTH_A_BATCH = 32  # new scenes for which it pays to sort the ground rules into layers
_REMEMBERED = 2_000  # scenes whose whole answer sets are kept; classes are all kept
_MOST_ANSWER_SETS = 16


class Verdict(StrEnum):
    """Why a scene is decided or not."""

    BELIEVED = "believed"
    SILENT = "silent"
    SEVERAL = "several classes"
    CONTRADICTION = "contradiction"
    NO_ANSWER_SET = "no answer set"


@dataclass(frozen=True)
class Decision:
    """What the knowledge says about a scene: a class, or None with the reason."""

    label: str | None
    verdict: Verdict


class Reasoner:
    """Beliefs about scenes under a domain's knowledge (section 3.2 of the paper).

    A scene is classified when exactly one class is believed in every preferred answer set.
    Defaults are given up only where the program is otherwise inconsistent, and minimally.

    Threads may share one: its programs are solved for one of them at a time.

    Departure from the paper: the program is not rewritten for every picture; it is grounded
    once, and a picture's features are assumptions. The answer sets are the same.

    Parameters
    ----------
    knowledge : Knowledge
    schema : SceneSchema
    minimality : {"cardinality", "inclusion"}
        Which sets of exceptions are preferred: the smallest, or all from which none can be left
        out.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> reasoner.decide(domain.vector({"block_displaced": "yes"})).label
    'unstable'
    >>> reasoner.decide(domain.vector({})).verdict.value
    'silent'
    """

    def __init__(
        self,
        knowledge: Knowledge,
        schema: SceneSchema,
        *,
        minimality: Minimality = "cardinality",
    ) -> None:
        self.knowledge = knowledge
        self.schema = schema
        self.minimality = minimality
        self._decisions: dict[FeatureVector, Decision] = {}
        self._answer_sets: dict[FeatureVector, tuple[AnswerSet, ...]] = {}
        self._believed: dict[FeatureVector, frozenset[clingo.Symbol]] = {}

    @cached_property
    def _size(self) -> GroundingSize:
        return grounding_size(self.knowledge)

    @cached_property
    def _plain(self) -> Grounding:
        text = program_text(self.knowledge, self.schema)
        return Grounding(text, self.schema, size=self._size)

    @cached_property
    def _restoring(self) -> Grounding:
        """The program with exceptions to defaults, for scenes that are inconsistent without."""
        text = program_text(self.knowledge, self.schema, exceptions=True)
        if self.minimality == "cardinality":
            text += "#minimize { 1, I, V : exception(I, V) }.\n#show exception/2.\n"
            arguments = ["--project=show"]
        else:
            # Subset-minimal models over the shown atoms: prefer them false, record each found.
            text += "#show exception/2.\n"
            arguments = ["--heuristic=Domain", "--enum-mode=domRec", "--dom-mod=false,show"]
        return Grounding(text, self.schema, size=self._size, arguments=arguments)

    @cached_property
    def _explaining(self) -> Grounding:
        text = program_text(self.knowledge, self.schema, exceptions=True, firings=True)
        # Reading the atoms of an answer set takes longer than finding it.
        text += "#show holds/1. #show fires/2. #show exception/2. #show conflict/0.\n"
        # Of several answer sets, the first found must not depend on what was asked before.
        return Grounding(text, self.schema, size=self._size, arguments=["--heuristic=None"])

    @cached_property
    def possible(self) -> PossibleInstances:
        """The instances of axioms and the literals that some scene could have."""
        return PossibleInstances(self.knowledge, self.schema, self._explaining, self._size)

    @cached_property
    def sufficient(self) -> SufficientFeatures:
        """Which features suffice for a belief."""
        return SufficientFeatures(
            self.knowledge, self.schema, self._explaining, self.believed, size=self._size
        )

    def forget(self) -> None:
        """Drop everything remembered about scenes; the programs stay grounded."""
        self._decisions.clear()
        self._answer_sets.clear()
        self._believed.clear()

    def decide(self, vector: FeatureVector) -> Decision:
        """Classify one scene.

        Raises
        ------
        ValueError
            If ``vector`` does not fit the features.
        """
        known = self._decisions.get(vector)
        if known is None:
            known = self._decisions[vector] = self._decide(vector)
        return known

    def decide_all(self, vectors: Sequence[FeatureVector]) -> list[Decision]:
        """Classify many scenes; equal feature vectors are solved once."""
        # In the order given, so that nothing depends on how strings hash.
        new = [vector for vector in dict.fromkeys(vectors) if vector not in self._decisions]
        if len(new) >= _WORTH_A_BATCH:
            self._decide_in_batches(new)
        return [self.decide(vector) for vector in vectors]

    @cached_property
    def _batch(self) -> Batch:
        return Batch(self.knowledge, self.schema)

    def _decide_in_batches(self, vectors: Sequence[FeatureVector]) -> None:
        """Decide what a batch can decide; the rest is left for :meth:`_decide`."""
        for start in range(0, len(vectors), SCENES):
            chunk = vectors[start : start + SCENES]
            try:
                outcomes = self._batch.outcomes(chunk)
            except (KeyError, ValueError):
                continue  # a vector does not fit; solving it alone says so
            decisions = {outcome: self._decision_of(outcome) for outcome in set(outcomes)}
            for vector, outcome in zip(chunk, outcomes, strict=True):
                decision = decisions[outcome]
                if decision is not None:
                    self._decisions[vector] = decision

    def _decision_of(self, outcome: Outcome | None) -> Decision | None:
        """The decision of an outcome; None where the solver has to tell."""
        if outcome is None or (outcome.contradictory and self.knowledge.has_defaults):
            return None
        if outcome.contradictory:
            return Decision(None, Verdict.CONTRADICTION)
        return _decision(outcome.classes)

    def _decide(self, vector: FeatureVector) -> Decision:
        plain = self._plain
        assumed = plain.assume(vector)
        believed = plain.believed_classes([*assumed, plain.strict])
        if believed is None and self.knowledge.has_defaults:
            believed = self._believed_with_exceptions(vector)
        if believed is not None:
            return _decision(believed)
        consistent_otherwise = plain.believed_classes([*assumed, -plain.strict]) is not None
        return Decision(
            None, Verdict.CONTRADICTION if consistent_otherwise else Verdict.NO_ANSWER_SET
        )

    def _believed_with_exceptions(self, vector: FeatureVector) -> tuple[str, ...] | None:
        """Return the classes believed under every minimal set of exceptions."""
        explaining = self._explaining
        atoms = explaining.with_predicate("exception", 2)
        believed: set[str] | None = None
        for chosen in self.minimal_exceptions(vector):
            fixed = [literal if s in chosen else -literal for s, literal in atoms.items()]
            here = explaining.believed_classes(
                [*explaining.assume(vector), explaining.strict, *fixed]
            )
            if here is not None:
                believed = set(here) if believed is None else believed & set(here)
        if believed is None:
            return None
        return tuple(name for name in self.schema.classes if name in believed)

    def minimal_exceptions(self, vector: FeatureVector) -> list[frozenset[clingo.Symbol]]:
        """Return the minimal sets of exceptions that restore consistency.

        The empty set alone means that none is needed; an empty list that none suffices.
        """
        restoring = self._restoring

        def minimal(model: clingo.Model) -> frozenset[clingo.Symbol] | None:
            if self.minimality == "inclusion" or model.optimality_proven:
                return frozenset(model.symbols(shown=True))
            return None

        found = restoring.solve(
            [*restoring.assume(vector), restoring.strict],
            Search(opt_mode="optN")
            if self.minimality == "cardinality"
            else Search(enum_mode="domRec"),
            on_model=minimal,
        )
        return sorted(
            {exceptions for exceptions in found if exceptions is not None},
            key=lambda chosen: sorted(map(str, chosen)),
        )

    def answer_set(self, vector: FeatureVector) -> AnswerSet | None:
        """Return the first preferred answer set with what fired in it.

        Where the scene is contradictory, the contradictory beliefs are returned with
        ``conflict`` set; None where there is no answer set at all.
        """
        return next(iter(self.answer_sets(vector)), None)

    def answer_sets(self, vector: FeatureVector) -> tuple[AnswerSet, ...]:
        """Return the preferred answer sets, at most 16 of them, the first first.

        As :meth:`answer_set`, a contradictory scene has one, with ``conflict`` set.
        """
        known = self._answer_sets
        try:
            return known[vector]
        except KeyError:
            found = self._preferred(vector)
        if len(known) >= _REMEMBERED:
            known.clear()
        known[vector] = found
        return found

    def _preferred(self, vector: FeatureVector) -> tuple[AnswerSet, ...]:
        found: list[AnswerSet] = []
        for assumed in self._consistent_trials(vector):
            left = _MOST_ANSWER_SETS - len(found)
            if left <= 0:
                break
            found += map(answer_set_of, self._explaining.models(assumed, most=left))
            if found and not self._exceptions_assumed(assumed):
                break
        if not found:
            found += self._contradictory(vector)
        return tuple(found)

    def contradictory_beliefs(self, vector: FeatureVector) -> AnswerSet | None:
        """Return what would be believed if no exception to a default were assumed.

        It holds contradictory literals where exceptions are needed, or where nothing helps. None
        where there would be no answer set at all.
        """
        return next(iter(self._contradictory(vector)), None)

    def _contradictory(self, vector: FeatureVector) -> list[AnswerSet]:
        explaining = self._explaining
        assumed = [*explaining.assume(vector), -explaining.strict, *self._no_exceptions]
        return [answer_set_of(symbols) for symbols in explaining.models(assumed, most=1)]

    @cached_property
    def _no_exceptions(self) -> list[int]:
        return [-literal for literal in self._explaining.with_predicate("exception", 2).values()]

    def _exceptions_assumed(self, assumed: Sequence[int]) -> bool:
        exceptions = set(self._explaining.with_predicate("exception", 2).values())
        return not exceptions.isdisjoint(assumed)

    def _consistent_trials(self, vector: FeatureVector) -> Iterator[list[int]]:
        """What to assume for the answer sets without exceptions, then for each minimal set."""
        explaining = self._explaining
        exceptions = explaining.with_predicate("exception", 2)
        assumed = [*explaining.assume(vector), explaining.strict]
        yield [*assumed, *self._no_exceptions]
        if self.knowledge.has_defaults:
            for chosen in filter(None, self.minimal_exceptions(vector)):
                yield [*assumed, *(lit if s in chosen else -lit for s, lit in exceptions.items())]

    def odd_loop(self, vector: FeatureVector) -> tuple[Axiom, ...]:
        """Return the axioms by which a scene has no answer set; see :class:`OddLoops`."""
        return self._loops.of(vector)

    @cached_property
    def _loops(self) -> OddLoops:
        return OddLoops(self.knowledge, self.schema)

    def believed(self, vector: FeatureVector) -> frozenset[clingo.Symbol]:
        """Return the literals in every preferred answer set; empty where there is none.

        Those of a contradictory scene contradict each other.
        """
        known = self._believed
        try:
            return known[vector]
        except KeyError:
            found = self._shared(vector)
        if len(known) >= _REMEMBERED:
            known.clear()
        known[vector] = found
        return found

    def _shared(self, vector: FeatureVector) -> frozenset[clingo.Symbol]:
        found = self.answer_sets(vector)
        if not found:
            return frozenset()
        shared = frozenset.intersection(*(answer_set.holds for answer_set in found))
        if len(found) < _MOST_ANSWER_SETS:
            return shared
        for assumed in self._consistent_trials(vector):
            symbols = self._explaining.consequences(assumed)
            if symbols is not None:
                shared &= answer_set_of(symbols).holds
                if not self._exceptions_assumed(assumed):
                    break
        return shared


def _decision(believed: tuple[str, ...]) -> Decision:
    """The decision where these classes are believed in every preferred answer set."""
    if len(believed) == 1:
        return Decision(believed[0], Verdict.BELIEVED)
    return Decision(None, Verdict.SEVERAL if believed else Verdict.SILENT)
