"""What a domain's knowledge decides, and what its author may want to know."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from itertools import product
from math import prod
from typing import Any

import numpy as np

from seewhy.data.dataset import Dataset
from seewhy.data.laboratory import not_there
from seewhy.data.picture_source import check_source
from seewhy.dialogue.answer import answer_templates
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import Domain
from seewhy.domain.key_place import KeyPlace
from seewhy.domain.tables import NONE
from seewhy.errors import DatasetError, KnowledgeError
from seewhy.evaluation import AxiomRecord, axiom_records
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.consistency import never_applies
from seewhy.knowledge.doubled import doubled
from seewhy.knowledge.grounding_size import large_grounding
from seewhy.knowledge.odd_loop import say_odd_loop
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector, SceneSchema

MOST_VECTORS = 20_000
_SCENES_OF_THINGS = 500
RIGHT_ENOUGH = 0.9
"""Of the scenes that an axiom decides: a rule with fewer right is doubtful."""
_LOOKED_AT = 50  # feature vectors without an answer set, for the reasons why


@dataclass(frozen=True)
class DomainReport:
    """What was found; errors are raised, not reported.

    ``verdicts`` gives the share of each verdict among ``vectors`` feature vectors (all of them,
    a sample of 20,000, or 500 scenes of things). ``decided`` and ``decided_rightly`` are shares of
    a dataset's scenes by their annotated features.
    """

    questions: int
    wordings: int
    vectors: int
    verdicts: dict[str, float]
    warnings: tuple[str, ...]
    axioms: tuple[AxiomRecord, ...] = ()
    decided: float | None = None
    decided_rightly: float | None = None

    @property
    def doubtful(self) -> tuple[str, ...]:
        """What each axiom is wrong about that is right less often than nine times in ten."""
        return tuple(
            f'the rule "{record.text}" is right about {record.right} of the {record.decided} '
            f"scenes that it decides ({record.statement})"
            for record in self.axioms
            if record.accuracy is not None and record.accuracy < RIGHT_ENOUGH
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the report as values that JSON can hold."""
        return {
            **asdict(self),
            "doubtful": list(self.doubtful),
            "axioms": [{**asdict(record), "accuracy": record.accuracy} for record in self.axioms],
        }


def check_domain(domain: Domain, data: Dataset | None = None) -> DomainReport:
    """Check what :func:`~seewhy.domain.domain.load_domain` need not: questions and coverage.

    Raises
    ------
    DomainError, DatasetError, KnowledgeError
        If the questions, the source of pictures or the dataset are wrong, or if no picture has
        an answer set.
    """
    reasoner = Reasoner(domain.knowledge, domain.schema)
    report = _check_folder(domain, reasoner)
    return report if data is None else _with_axioms_judged(report, reasoner, data)


def _check_folder(domain: Domain, reasoner: Reasoner) -> DomainReport:
    """What there is to say of a domain without pictures."""
    questions = Questions(domain)
    answer_templates(domain)
    vectors = feature_vectors(domain)
    decisions = reasoner.decide_all(vectors)
    counted = Counter(decision.verdict.value for decision in decisions)
    without = [
        vector
        for vector, decision in zip(vectors, decisions, strict=True)
        if decision.verdict is Verdict.NO_ANSWER_SET
    ]
    loops = _odd_loops(reasoner, without)
    if loops and len(without) == len(vectors):
        raise KnowledgeError(f"{_said_odd(loops[0])}, so that no picture has an answer set")
    without_laboratory = not_there(domain.source)
    if domain.source is not None and without_laboratory is None:
        check_source(domain)
    warnings = [without_laboratory] if without_laboratory else []
    if domain.things is not None and domain.eyes == NONE:
        place = KeyPlace(domain.folder / "domain.toml").at("domain", "eyes")
        warnings.append(
            f"{place}: eyes = 'none' sees no things, so that nothing can be trained; leave the "
            "line out"
        )
    warnings += [
        f"{_said_odd(loop)}, so that {len(without)} of {len(vectors)} feature vectors have no "
        "answer set"
        for loop in loops
    ]
    # Where there is no answer set, no axiom applies; that is for the loop to answer for.
    apart = {axiom.identifier for loop in loops for axiom in loop}
    sound = tuple(axiom for axiom in domain.knowledge.axioms if axiom.identifier not in apart)
    warnings += [
        f"{axiom.location}: no feature vector satisfies the conditions of '{axiom}'"
        for axiom in never_applies(replace(domain.knowledge, axioms=sound), domain.schema)
    ]
    warnings += doubled(domain.knowledge.axioms)
    warnings += filter(None, [large_grounding(domain.knowledge)])
    covered = {question.feature for question in questions.all if question.feature}
    warnings += [
        f"no question asks about the feature '{key}'"
        for key in domain.features
        if questions.all and key not in covered  # without templates the grammar asks for all
    ]
    return DomainReport(
        questions=len(questions.one_of_each()),
        wordings=len(questions.all),
        vectors=len(vectors),
        verdicts={name: number / len(vectors) for name, number in counted.most_common()},
        warnings=tuple(warnings),
    )


def _with_axioms_judged(report: DomainReport, reasoner: Reasoner, data: Dataset) -> DomainReport:
    """The report with what annotated pictures say of the axioms."""
    scenes = data.with_class()
    if not len(scenes):
        raise DatasetError(
            f"{data.table.name}: no row has a class, by which axioms are judged; fill the column "
            "'class'"
        )
    decisions = reasoner.decide_all(scenes.vectors)
    decided = [
        decision.label == label
        for decision, label in zip(decisions, scenes.classes, strict=True)
        if decision.label is not None
    ]
    return replace(
        report,
        axioms=axiom_records(reasoner, scenes.vectors, scenes.classes),
        decided=len(decided) / len(scenes),
        decided_rightly=float(np.mean(decided)) if decided else 0.0,
    )


def _scenes_of_things(schema: SceneSchema, count: int) -> list[FeatureVector]:
    """Scenes with things, whose features and relations are as chance has it."""
    generator = np.random.default_rng(0)
    things = list(schema.presence.values())
    shown: dict[int, list[str]] = {}
    found: list[FeatureVector] = []
    for _ in range(count):
        there = int(generator.integers(len(things) + 1))
        if there not in shown:
            shown[there] = _of_so_many(schema, things[:there])
        sizes = [len(schema.features[feature]) for feature in shown[there]]
        values: dict[str, str | None] = dict.fromkeys(things[:there], "yes")
        for feature, number in zip(shown[there], generator.integers(sizes).tolist(), strict=True):
            values[feature] = tuple(schema.features[feature])[number]
        found.append(schema.vector(values))
    return found


def _of_so_many(schema: SceneSchema, there: Sequence[str]) -> list[str]:
    """What is seen where these things are there, beside that they are."""
    absent = set(schema.presence.values()) - set(there)
    return [
        feature
        for feature in schema.features
        if feature not in schema.presence.values()
        and absent.isdisjoint(schema.requires.get(feature, ()))
    ]


def _odd_loops(reasoner: Reasoner, vectors: Sequence[FeatureVector]) -> list[tuple[Axiom, ...]]:
    """The odd loops behind feature vectors without an answer set, each once."""
    found: dict[tuple[str, ...], tuple[Axiom, ...]] = {}
    for vector in vectors[:_LOOKED_AT]:
        loop = reasoner.odd_loop(vector)
        found.setdefault(tuple(axiom.identifier for axiom in loop), loop)
    return list(found.values())


def _said_odd(loop: Sequence[Axiom]) -> str:
    """An odd loop in words, with the place of its first axiom."""
    return f"{loop[0].location}: {say_odd_loop(loop)}"


def feature_vectors(domain: Domain) -> list[FeatureVector]:
    """Return all feature vectors of a domain, or a sample where there are too many.

    Of a domain with things it is always a sample: of scenes with any number of things.
    """
    if domain.things is not None:
        return _scenes_of_things(domain.schema, min(MOST_VECTORS, _SCENES_OF_THINGS))
    values = [feature.values for feature in domain.features.values()]
    if prod(map(len, values)) <= MOST_VECTORS:
        return [tuple(vector) for vector in product(*values)]
    generator = np.random.default_rng(0)
    return [
        tuple(possible[int(generator.integers(len(possible)))] for possible in values)
        for _ in range(MOST_VECTORS)
    ]
