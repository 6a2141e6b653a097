"""The most probable scene of things that the knowledge allows.

Every value, every relation that is seen, and whether a doubtful thing is there, is a choice. The
readings are tried in falling order of probability, beginning with each choice's most probable, and
the first that contradicts no axiom is taken: no more probable one is consistent. Only alternatives
that are probable enough are tried, and only so many readings; where none of them is consistent,
each choice's most probable is taken, and that is said.

What a thing is counts only where it is there: a reading without it is as probable as that it is
not there, whatever it would be. Relations that boxes measure are no choices; they follow from them.
"""

from __future__ import annotations

import heapq
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from seewhy.agent.things.thing_lessons import box_of, seen_once
from seewhy.agent.things.thing_seeing import Sighting, Table
from seewhy.data.scene_vector import vector_with_things
from seewhy.data.thing import BoundingBox, Related, Thing
from seewhy.dialogue.reply import FeatureReading
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.things import of_things

__all__ = ["NEAR", "SceneReader", "SeenThing", "ThingReading"]

NEAR = 0.02
"""Alternatives that are less probable than this share of the most probable are not tried."""

TRIED = 400
"""Readings of a picture that are tried at most."""

SECONDS = 2.0
"""How long they are tried at most; where fewer are tried, that is said."""

_INCONSISTENT = (Verdict.CONTRADICTION, Verdict.NO_ANSWER_SET)
_YES = "yes"


@dataclass(frozen=True)
class SeenThing:
    """A thing that was found in a picture.

    Attributes
    ----------
    box : BoundingBox
        In pixels of the upright picture.
    probability : float
        That it is there.
    values : mapping of str to FeatureReading
    """

    box: BoundingBox
    probability: float
    values: Mapping[str, FeatureReading]


@dataclass(frozen=True, eq=False)
class ThingReading:
    """What a picture is taken to show.

    Attributes
    ----------
    things : tuple of SeenThing
        From the left to the right.
    doubtful : tuple of SeenThing
        What may be a thing, too, but is taken to be none.
    vector : FeatureVector
        Of the picture, its things and what holds between two, as it is reasoned with.
    whole : mapping of str to FeatureReading
        Of the features of the picture as a whole.
    label : str or None
        The class; None where there are no classes, or none is concluded or seen.
    method : str or None
        "knowledge" or "seen".
    class_probability : float or None
        What the eyes give that class, where they see it.
    verdict : Verdict or None
        What the knowledge says of the class; None where it has none.
    settled : bool
        False where no reading that was tried is consistent, and this one is not.
    tried : int
        Readings that were tried.
    left_out : int
        Things that were found beyond the most that the domain allows.
    sighting : Sighting
        What it was read from.
    """

    things: tuple[SeenThing, ...]
    doubtful: tuple[SeenThing, ...]
    vector: FeatureVector
    whole: Mapping[str, FeatureReading]
    label: str | None
    method: str | None
    class_probability: float | None
    verdict: Verdict | None
    settled: bool
    tried: int
    left_out: int
    sighting: Sighting = field(repr=False)
    places: tuple[int, ...] = ()
    """Where each of ``things``, and then of ``doubtful``, stands in the sighting."""
    with_doubtful: FeatureVector = ()
    """The vector with the doubtful things behind the others, as if they were there."""


@dataclass(frozen=True)
class _Choice:
    """Something that is read, and what it may be: values in falling order of probability.

    ``of`` are the things that must be there for it to matter.
    """

    what: tuple[str | int, ...]
    of: tuple[int, ...]
    values: tuple[str, ...]
    costs: tuple[float, ...]


class SceneReader:
    """Reads scenes of a domain, consistently with its knowledge.

    Parameters
    ----------
    domain : Domain
        With things.
    reasoner : Reasoner
        Of its knowledge.
    tried, seconds : optional
        Bounds of the search.
    """

    def __init__(
        self,
        domain: Domain,
        reasoner: Reasoner,
        *,
        tried: int = TRIED,
        seconds: float = SECONDS,
    ) -> None:
        assert domain.things is not None, "the domain has no things"
        self.domain = domain
        self.things = domain.things
        self.reasoner = reasoner
        self.tried = tried
        self.seconds = seconds
        self._seen_once = seen_once(domain.things)

    def read(self, sighting: Sighting) -> ThingReading:
        """Return the most probable reading that the knowledge allows."""
        choices = self._choices(sighting)
        best = tuple([0] * len(choices))
        until = time.monotonic() + self.seconds
        tried = 0
        for steps in _rising(choices):
            chosen = {
                choice.what: choice.values[n] for choice, n in zip(choices, steps, strict=True)
            }
            vector = self.vector(sighting, chosen)
            tried += 1
            if self._consistent(vector):
                return self._reading(sighting, chosen, vector, settled=True, tried=tried)
            if tried >= self.tried or time.monotonic() > until:
                break
        chosen = {choice.what: choice.values[n] for choice, n in zip(choices, best, strict=True)}
        vector = self.vector(sighting, chosen)
        return self._reading(sighting, chosen, vector, settled=False, tried=tried)

    def _consistent(self, vector: FeatureVector) -> bool:
        if not self.domain.knowledge.axioms:
            return True
        return self.reasoner.decide(vector).verdict not in _INCONSISTENT

    def _choices(self, sighting: Sighting) -> list[_Choice]:
        """All that is read, each with what it may be."""
        found = [
            _choice(("whole", key), (), tuple(feature.values), sighting.whole[key])
            for key, feature in self.domain.features.items()
            if key in sighting.whole
        ]
        for number, presence in enumerate(sighting.presence):
            shares = np.array([presence, 1.0 - presence])
            found.append(_choice(("there", number), (), ("yes", "no"), shares))
            for key, feature in self.things.features.items():
                row = sighting.values[key][number]
                found.append(_choice(("value", key, number), (number,), feature.values, row))
        count = len(sighting.presence)
        for key in self._seen_once:
            if key not in sighting.related:
                continue
            for first in range(count):
                for second in range(count):
                    if first != second:
                        share = sighting.related[key][first, second]
                        shares = np.array([share, 1.0 - share])
                        what = ("related", key, first, second)
                        found.append(_choice(what, (first, second), ("yes", "no"), shares))
        return found

    def vector(
        self,
        sighting: Sighting,
        chosen: Mapping[tuple[str | int, ...], str],
        *,
        places: Sequence[int] | None = None,
    ) -> FeatureVector:
        """Return what is reasoned with where it is read so.

        ``places`` are those of the sighting that are things, in their order; where left out, those
        that are read to be there.
        """
        if places is None:
            count = len(sighting.presence)
            places = [n for n in range(count) if chosen["there", n] == _YES]
        things = [
            Thing(
                str(n),
                {key: chosen["value", key, n] for key in self.things.features},
                box_of(sighting.boxes[n]),
            )
            for n in places
        ]
        related = [
            Related(key, str(first), str(second), chosen["related", key, first, second] == _YES)
            for key in self._seen_once
            if key in sighting.related
            for first in places
            for second in places
            if first != second
        ]
        whole = tuple(chosen.get(("whole", key)) for key in self.domain.features)
        return vector_with_things(self.domain, whole, things, related)

    def _reading(
        self,
        sighting: Sighting,
        chosen: Mapping[tuple[str | int, ...], str],
        vector: FeatureVector,
        *,
        settled: bool,
        tried: int,
    ) -> ThingReading:
        count = len(sighting.presence)
        present = [n for n in range(count) if chosen[("there", n)] == _YES]
        absent = [n for n in range(count) if n not in present]
        label, method, verdict, probability = self._label(sighting, vector)
        return ThingReading(
            things=tuple(self._seen(sighting, chosen, n) for n in present),
            doubtful=tuple(self._seen(sighting, chosen, n) for n in absent),
            vector=vector,
            whole={
                key: _reading_of(tuple(feature.values), sighting.whole[key], chosen[("whole", key)])
                for key, feature in self.domain.features.items()
                if key in sighting.whole
            },
            label=label,
            method=method,
            class_probability=probability,
            verdict=verdict,
            settled=settled,
            tried=tried,
            left_out=sighting.left_out,
            sighting=sighting,
            places=(*present, *absent),
            with_doubtful=self.vector(sighting, chosen, places=(*present, *absent))
            if absent
            else vector,
        )

    def _seen(
        self, sighting: Sighting, chosen: Mapping[tuple[str | int, ...], str], number: int
    ) -> SeenThing:
        values = {
            key: _reading_of(
                feature.values, sighting.values[key][number], chosen[("value", key, number)]
            )
            for key, feature in self.things.features.items()
        }
        return SeenThing(box_of(sighting.boxes[number]), float(sighting.presence[number]), values)

    def _label(
        self, sighting: Sighting, vector: FeatureVector
    ) -> tuple[str | None, str | None, Verdict | None, float | None]:
        """The class that the knowledge concludes, or else the one that is seen."""
        if not self.domain.classes:
            return None, None, None, None
        decision = self.reasoner.decide(vector)
        shares = dict(zip(self.domain.classes, sighting.whole.get(CLASS, ()), strict=False))
        if decision.label is not None:
            probability = shares.get(decision.label)
            return decision.label, "knowledge", decision.verdict, _number(probability)
        if not shares:
            return None, None, decision.verdict, None
        label = max(shares, key=lambda name: shares[name])
        return label, "seen", decision.verdict, _number(shares[label])


def _number(value: float | None) -> float | None:
    return None if value is None else float(value)


def _choice(
    what: tuple[str | int, ...], of: tuple[int, ...], values: Sequence[str], shares: Table
) -> _Choice:
    logs = np.log(np.maximum(np.asarray(shares, dtype=np.float64), 1e-12))
    order = np.argsort(-logs, kind="stable")
    costs = logs[order[0]] - logs[order]
    near = [n for n, cost in zip(order, costs, strict=True) if cost <= -np.log(NEAR)]
    return _Choice(
        what,
        of,
        tuple(values[n] for n in near),
        tuple(float(costs[at]) for at in range(len(near))),
    )


def _rising(choices: Sequence[_Choice]) -> Iterator[tuple[int, ...]]:
    """Yield the readings, the most probable first: for each choice, how many values it is down.

    A reading that differs only in what a thing would be that is not there is no other one.
    """
    order = sorted(
        (n for n, choice in enumerate(choices) if len(choice.values) > 1),
        key=lambda n: choices[n].costs[1],
    )
    presences = {choice.what[1]: n for n, choice in enumerate(choices) if choice.what[0] == "there"}
    heap: list[tuple[float, tuple[tuple[int, int], ...]]] = [(0.0, ())]
    while heap:
        cost, steps = heapq.heappop(heap)
        taken = [0] * len(choices)
        for place, step in steps:
            taken[order[place]] = step
        gone = {number for number, n in presences.items() if choices[n].values[taken[n]] == "no"}
        if not any(step and gone.intersection(choices[n].of) for n, step in enumerate(taken)):
            yield tuple(taken)
        # One value further down in the last choice that is not at its first, or in a later one.
        last = steps[-1][0] if steps else -1
        for place in range(max(last, 0), len(order)):
            choice = choices[order[place]]
            step = steps[-1][1] + 1 if place == last else 1
            if step < len(choice.costs):
                before = choice.costs[step - 1]
                kept = steps[:-1] if place == last else steps
                entry = (cost + choice.costs[step] - before, (*kept, (place, step)))
                heapq.heappush(heap, entry)


def _reading_of(values: Sequence[str], shares: Table, chosen: str) -> FeatureReading:
    """A value that was read, and the more probable one where the knowledge overruled that."""
    best = int(np.argmax(shares))
    taken = list(values).index(chosen)
    overruled = None if taken == best else (values[best], float(shares[best]))
    return FeatureReading(chosen, float(shares[taken]), overruled)


def named(reading: ThingReading, domain: Domain) -> dict[str, tuple[str, float]]:
    """Feature of the vector → the value that was read, and how probable it is.

    Of a relation, what is read and its opposite are weighed; what axioms conclude is not here.
    """
    terms = list(domain.schema.presence)
    found: dict[str, tuple[str, float]] = {
        key: (seen.value, seen.probability) for key, seen in reading.whole.items()
    }
    shown = dict(zip(domain.schema.features, reading.vector, strict=True))
    for number, thing in enumerate(reading.things):
        found[domain.schema.presence[terms[number]]] = (_YES, thing.probability)
        for key, seen in thing.values.items():
            found[of_things(key, terms[number])] = (seen.value, seen.probability)
    for key, table in reading.sighting.related.items():
        for first in range(len(reading.things)):
            for second in range(len(reading.things)):
                feature = of_things(key, terms[first], terms[second])
                value = shown.get(feature)
                if first != second and value is not None:
                    share = float(table[reading.places[first], reading.places[second]])
                    found[feature] = (value, share if value == _YES else 1.0 - share)
    return found
