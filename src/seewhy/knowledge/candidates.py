"""Which feature vectors the knowledge decides, and the most probable of them."""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

import clingo
import numpy as np
from numpy.typing import NDArray

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.program import UNKNOWN, program_text
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema

__all__ = ["decided_vectors", "most_probable_decided"]

TRIED = 8
"""Vectors tried in falling order of probability before clingo searches for the best one."""

_SCALE = 1e6  # clingo minimises integers: so many of them to one unit of log-probability

LogProbabilities = Sequence[NDArray[np.float64]]
"""One array per feature, in the order of the schema and of the feature's values."""


def decided_vectors(reasoner: Reasoner, *, limit: int) -> tuple[FeatureVector, ...] | None:
    """Return all feature vectors without unknown values that the knowledge decides.

    clingo enumerates the vectors under which some class holds in some answer set; the reasoner
    keeps those of which one class is believed in every preferred one.

    Parameters
    ----------
    reasoner : Reasoner
    limit : int
        Where clingo finds more vectors than this, they are not listed.

    Returns
    -------
    tuple of FeatureVector, or None
        In the order of the features' values; None where there are too many.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> vectors = decided_vectors(reasoner, limit=1000)
    >>> len(vectors), vectors[0]
    (30, ('1', 'wide', 'yes', 'yes'))
    """
    schema = reasoner.schema
    control = _control(reasoner, "--project=show")
    control.configuration.models = limit + 1
    found = control.solve(on_model=lambda model: _vector(model, schema))
    if len(found) > limit:
        return None
    places = [{value: n for n, value in enumerate(values)} for values in schema.features.values()]
    found.sort(key=lambda vector: [place[v or ""] for place, v in zip(places, vector, strict=True)])
    decisions = reasoner.decide_all(found)
    return tuple(
        v for v, decision in zip(found, decisions, strict=True) if decision.label is not None
    )


def most_probable_decided(
    reasoner: Reasoner,
    probabilities: LogProbabilities,
    *,
    class_scores: Mapping[str, float] | None = None,
    above: float = -np.inf,
    tried: int = TRIED,
) -> tuple[FeatureVector, float] | None:
    """Return the feature vector that the knowledge decides and that has the highest score.

    The score is the vector's log-probability, and that of its class where there are such scores.

    For knowledge that decides too many vectors to list. They are tried in falling order of
    probability; if ``tried`` of them are not decided, clingo minimises the cost over those that
    may be, and the reasoner confirms what it finds.

    Parameters
    ----------
    reasoner : Reasoner
    probabilities : sequence of ndarray
        Finite log-probabilities of every feature's values; features count as independent.
    class_scores : mapping of str to float, optional
        What is added for a vector of a class, at most 0; 0 for a class without.
    above : float
        Vectors of at most this score are of no interest.
    tried : int
        How many are tried before clingo searches. What is returned does not depend on it, but
        for vectors whose log-probabilities differ by less than a millionth a feature.

    Returns
    -------
    (FeatureVector, float) or None
        The vector and its score; None where there is none above ``above``.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> sure = [[0.1, 0.6, 0.1, 0.1, 0.1], [0.4, 0.6], [0.7, 0.3], [0.2, 0.8]]
    >>> vector, joint = most_probable_decided(reasoner, [np.log(shares) for shares in sure])
    >>> vector, round(float(np.exp(joint)), 4)
    (('2', 'wide', 'yes', 'no'), 0.1344)
    """
    scores = class_scores or {}
    best: tuple[FeatureVector, float] | None = None
    seen: list[FeatureVector] = []
    for vector, joint in islice(_falling(reasoner.schema, probabilities), tried):
        if joint <= above:
            return best
        label = reasoner.decide(vector).label
        if label is not None and (score := joint + scores.get(label, 0.0)) > above:
            best, above = (vector, score), score
        seen.append(vector)
    return _cheapest(reasoner, probabilities, scores, above, seen) or best


def _falling(
    schema: SceneSchema, probabilities: LogProbabilities
) -> Iterator[tuple[FeatureVector, float]]:
    """Yield all feature vectors, the most probable first.

    A vector is a step for every feature down its values in falling order. The vector before it
    has one step less in the last feature that has any, so that each is reached once.
    """
    orders = [np.argsort(-distribution, kind="stable") for distribution in probabilities]
    values = [list(possible) for possible in schema.features.values()]

    def entry(steps: tuple[int, ...]) -> tuple[float, tuple[int, ...]]:
        chosen = zip(probabilities, orders, steps, strict=True)
        return -sum(float(distribution[order[step]]) for distribution, order, step in chosen), steps

    heap = [entry((0,) * len(values))]
    while heap:
        cost, steps = heapq.heappop(heap)
        yield (
            tuple(v[o[step]] for v, o, step in zip(values, orders, steps, strict=True)),
            -cost,
        )
        last = max((n for n, step in enumerate(steps) if step), default=0)
        for n in range(last, len(steps)):
            if steps[n] + 1 < len(values[n]):
                heapq.heappush(heap, entry((*steps[:n], steps[n] + 1, *steps[n + 1 :])))


def _cheapest(
    reasoner: Reasoner,
    probabilities: LogProbabilities,
    class_scores: Mapping[str, float],
    above: float,
    seen: Sequence[FeatureVector],
) -> tuple[FeatureVector, float] | None:
    """Minimise the cost of the vectors that may be decided until none can be better.

    The classes that an answer set holds need not be what the vector is decided as; its cost is a
    bound of what the vector's can be.
    """
    schema = reasoner.schema
    places = [{value: n for n, value in enumerate(values)} for values in schema.features.values()]
    control = _control(reasoner, "--opt-mode=opt")
    control.add(
        "costs",
        "".join(
            f":~ observed({feature}, {value}). "
            f"[{round(_SCALE * (distribution.max() - distribution[n]))}, {feature}]"
            for feature, distribution in zip(schema.features, probabilities, strict=True)
            for n, value in enumerate(schema.features[feature])
        )
        + "".join(
            f":~ holds({schema.classes[label]}). [{round(-_SCALE * score)}, class({number})]"
            for number, (label, score) in enumerate(class_scores.items())
        ),
    )
    control.configuration.models = 0
    for number, vector in enumerate(seen):
        _rule_out(control, schema, vector, number)
    number = len(seen)
    best: tuple[FeatureVector, float] | None = None
    most = sum(float(distribution.max()) for distribution in probabilities)
    rounded = (len(probabilities) + 1) / _SCALE
    while (optimum := _optimum(control, schema)) is not None:
        vector, cost = optimum
        bound = most - cost / _SCALE
        if bound + rounded <= above or (best is not None and bound - rounded <= above):
            break
        chosen = zip(probabilities, places, vector, strict=True)
        joint = sum(
            float(distribution[place[value or ""]]) for distribution, place, value in chosen
        )
        label = reasoner.decide(vector).label
        if label is not None and (score := joint + class_scores.get(label, 0.0)) > above:
            best, above = (vector, score), score
            if bound - rounded <= above:
                break
        _rule_out(control, schema, vector, number)
        number += 1
    return best


def _control(reasoner: Reasoner, *arguments: str) -> BoundedControl:
    """The program whose answer sets hold a class, with every feature seen.

    A vector that is decided has such an answer set: the class is believed in all preferred ones.
    """
    schema = reasoner.schema
    lines = [program_text(reasoner.knowledge, schema, exceptions=True), ":- not strict."]
    lines += [f":- observed({feature}, {UNKNOWN})." for feature in schema.features]
    lines.append(f":- {', '.join(f'not holds({literal})' for literal in schema.classes.values())}.")
    lines.append("#show observed/2.")
    return BoundedControl(
        "\n".join(lines), size=grounding_size(reasoner.knowledge), arguments=arguments
    )


def _vector(model: clingo.Model, schema: SceneSchema) -> FeatureVector:
    shown = {str(s.arguments[0]): str(s.arguments[1]) for s in model.symbols(shown=True)}
    return tuple(shown[feature] for feature in schema.features)


def _optimum(control: BoundedControl, schema: SceneSchema) -> tuple[FeatureVector, int] | None:
    found = control.solve(on_model=lambda model: (_vector(model, schema), sum(model.cost)))
    return found[-1] if found else None


def _rule_out(
    control: BoundedControl, schema: SceneSchema, vector: FeatureVector, number: int
) -> None:
    observed = ", ".join(
        f"observed({feature}, {value})"
        for feature, value in zip(schema.features, vector, strict=True)
    )
    control.add(f"ruled_out_{number}", f":- {observed}.")
