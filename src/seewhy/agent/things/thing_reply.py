"""Answers about the things of a picture that was read, and how surely they may be said."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from seewhy.agent.things.thing_reading import ThingReading, named
from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.certainty import Certainty, Ground, certainty_of
from seewhy.dialogue.scene_beliefs import SceneBeliefs
from seewhy.dialogue.things.answering import ThingReply
from seewhy.dialogue.things.evaluating import Evaluation, UnclearReferenceError
from seewhy.dialogue.things.outcome import Outcome, outcome_of
from seewhy.dialogue.things.query import ClassIs, WhichClass
from seewhy.dialogue.things.supposing import NoOneWayError
from seewhy.dialogue.things.wording import ThingWords
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.domain.wording import as_clause, sentence
from seewhy.knowledge.justification import Node
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.things import of_things, things_of

__all__ = ["PictureReply", "ReadScene"]

_WORTH = 0.02
"""What is otherwise with less probability than this is not asked about."""


@dataclass(frozen=True)
class _Otherwise:
    """What may be otherwise: a feature of the vector, and the probability of another value."""

    feature: str
    value: str
    probability: float


class ReadScene:
    """The things of a picture as they were read, with what follows, to be asked about.

    Parameters
    ----------
    domain : Domain
    reading : ThingReading
    reasoner : Reasoner
        Of the domain's knowledge.
    """

    def __init__(self, domain: Domain, reading: ThingReading, reasoner: Reasoner) -> None:
        assert domain.things is not None, "the domain has no things"
        self.domain = domain
        self.things = domain.things
        self.reading = reading
        self.reasoner = reasoner

    @property
    def names(self) -> list[str]:
        """What the things are called in the knowledge."""
        return list(self.domain.schema.presence)[: len(self.reading.things)]

    @cached_property
    def beliefs(self) -> SceneBeliefs:
        """What is believed of the scene; things are called as they are described."""
        return SceneBeliefs(self.domain, self.reading.vector, self.names, reasoner=self.reasoner)

    @cached_property
    def scene(self) -> ThingScene:
        """The scene that questions are asked about."""
        reading = self.reading
        return replace(
            self.beliefs.scene,
            positions=self._positions(len(reading.things)),
            label=reading.label,
            label_seen=reading.method == "seen",
        )

    @cached_property
    def words(self) -> ThingWords:
        """How the things are called in answers."""
        return ThingWords(Evaluation(self.scene, self.things))

    @cached_property
    def seen(self) -> dict[str, tuple[str, float]]:
        """Feature of the vector → the value that was read, and how probable it is."""
        return named(self.reading, self.domain)

    def say(self, feature: str, value: str) -> str:
        """Return a value as a clause, with the things' names: "the red cube is a cube"."""
        if feature == CLASS:
            return self.things.whole.say(value)
        terms = list(self.domain.schema.presence)
        called = dict(zip(terms, self._called, strict=False))
        name, things = things_of(feature)
        if name == self.things.sort:
            denied = "" if value == "yes" else "not "
            return f"{called[things[0]]} is {denied}there"
        beliefs = SceneBeliefs(
            self.domain, self.reading.vector, self._called, reasoner=self.reasoner
        )
        return beliefs.say(self.domain.schema.features[feature][value])

    @cached_property
    def _called(self) -> list[str]:
        words = ThingWords(Evaluation(self._with_doubtful, self.things))
        return [words.name(number) for number in range(self._with_doubtful.count)]

    def notices(self) -> list[str]:
        """What has to be said of a reading that is not as it should be."""
        reading = self.reading
        found = []
        if reading.left_out:
            found.append(
                f"{reading.left_out} more may be there: the domain allows {self.things.most} at "
                "most, and the surest are read"
            )
        if not reading.settled:
            found.append(
                f"what is seen contradicts the knowledge, and so do the {reading.tried} likeliest "
                "readings: it is told as seen"
            )
        for number, thing in enumerate(reading.things):
            for key, seen in thing.values.items():
                if seen.overruled is not None:
                    value, probability = seen.overruled
                    found.append(
                        f"the knowledge overruled: {key} of {self.names[number]} seen as {value} "
                        f"({probability:.2f}), {seen.value} ({seen.probability:.2f}) is what fits"
                    )
        return found

    # What may be otherwise --------------------------------------------------------------------

    @cached_property
    def _with_doubtful(self) -> ThingScene:
        """The scene with the doubtful things behind the others, as if they were there."""
        count = len(self.reading.places)
        names = list(self.domain.schema.presence)[:count]
        beliefs = SceneBeliefs(
            self.domain, self.reading.with_doubtful, names, reasoner=self.reasoner
        )
        return replace(beliefs.scene, positions=self._positions(count))

    def _positions(self, count: int) -> tuple[tuple[float, float, float], ...]:
        """Where things are in the picture, to the right and downwards."""
        boxes = self.reading.sighting.boxes
        rows = (boxes[place] for place in self.reading.places[:count])
        return tuple((float(row[0] + row[2]) / 2, float(row[1] + row[3]) / 2, 0.0) for row in rows)

    def _otherwise(self) -> Iterator[_Otherwise]:
        """All that may be otherwise, each by itself."""
        reading, schema = self.reading, self.domain.schema
        terms = list(schema.presence)
        for number, thing in enumerate((*reading.things, *reading.doubtful)):
            there = number < len(reading.things)
            share = 1.0 - thing.probability if there else thing.probability
            yield _Otherwise(schema.presence[terms[number]], "no" if there else "yes", share)
            if not there:
                continue  # what it would be matters where it is there, and that is doubtful
            for key in self.things.features:
                row = reading.sighting.values[key][reading.places[number]]
                for value, probability in zip(self.things.features[key].values, row, strict=True):
                    if value != thing.values[key].value:
                        feature = of_things(key, terms[number])
                        yield _Otherwise(feature, value, float(probability))
        count = len(reading.things)
        for feature, (value, probability) in self.seen.items():
            name, of = things_of(feature)
            if name in self.things.relations and len(of) == 2 and count:
                yield _Otherwise(feature, "no" if value == "yes" else "yes", 1.0 - probability)

    def doubt(self, reply: ThingReply) -> tuple[float, Ground | None]:
        """How probable it is that an answer is right, and what it depends on that is least sure.

        What may be otherwise is taken so, each by itself, and what was asked is asked again: only
        what changes the answer counts. Where the question was about a scene that was supposed, or
        has no answer, nothing is doubted.
        """
        if reply.failed is not None or reply.words.evaluation.scene is not self.scene:
            return 1.0, None
        probability = self.reading.class_probability
        if self.scene.label_seen and isinstance(reply.query, ClassIs | WhichClass) and probability:
            return probability, Ground(CLASS, str(self.scene.label), probability)
        doubtful = ((1 << len(self.reading.doubtful)) - 1) << len(self.reading.things)
        base = self._asked(reply, *self._concluded(self._with_doubtful, doubtful))
        changing: dict[str, float] = {}
        for other in self._otherwise():
            if other.probability < _WORTH:
                continue
            if self._asked(reply, *self._concluded(*self._changed(other, doubtful))) != base:
                changing[other.feature] = changing.get(other.feature, 0.0) + other.probability
        if not changing:
            return 1.0, None
        probability = 1.0
        for share in self._each_once(changing).values():
            probability *= 1.0 - min(share, 1.0)
        weakest = max(changing, key=lambda feature: changing[feature])
        value = self.seen.get(weakest, ("no", 0.0))[0]
        return probability, Ground(weakest, value, 1.0 - min(1.0, changing[weakest]))

    def _each_once(self, changing: Mapping[str, float]) -> dict[str, float]:
        """Without what a converse says again."""
        kept: dict[str, float] = {}
        for feature, share in changing.items():
            name, of = things_of(feature)
            relation = self.things.relations.get(name)
            converse = relation.converse if relation else None
            if converse is None or of_things(converse, *reversed(of)) not in kept:
                kept[feature] = share
        return kept

    def _changed(self, other: _Otherwise, without: int) -> tuple[ThingScene, int]:
        """The scene as it may be otherwise, before anything follows; and what is not there."""
        scene = self._with_doubtful
        terms = list(self.domain.schema.presence)
        name, of = things_of(other.feature)
        numbers = [terms.index(term) for term in of]
        if name == self.things.sort:
            return scene, without ^ 1 << numbers[0]
        if name in self.things.features:
            column = list(scene.values[name])
            column[numbers[0]] = other.value
            return replace(scene, values={**scene.values, name: tuple(column)}), without
        related = {**scene.related, name: _flipped(scene.related[name], *numbers)}
        converse = self.things.relations[name].converse
        if converse is not None and converse in self.things.seen:
            related[converse] = _flipped(scene.related[converse], *reversed(numbers))
        return replace(scene, related=related), without

    def _concluded(self, scene: ThingScene, without: int) -> tuple[ThingScene, int]:
        """The scene with what follows in it."""
        if scene.conclusions is None or not self.domain.knowledge.axioms:
            return scene, without
        return scene.conclusions.conclude(scene, without), without

    def _asked(self, reply: ThingReply, scene: ThingScene, without: int) -> object:
        """What a query comes to in a scene; nothing where it speaks of what is not there."""
        try:
            found: Outcome = outcome_of(
                reply.query, Evaluation(scene, self.things, without=without)
            )
        except (UnclearReferenceError, NoOneWayError):
            return None
        return found.value


def _flipped(rows: tuple[int, ...], number: int, to: int) -> tuple[int, ...]:
    """A relation that holds of a thing to another where it did not, or the other way round."""
    changed = list(rows)
    changed[to] ^= 1 << number
    return tuple(changed)


@dataclass(frozen=True, eq=False)
class PictureReply:
    """An answer about the things in a picture.

    Attributes
    ----------
    reply : ThingReply
        The answer about the scene as it was read.
    read : ReadScene
        What was read.
    probability : float
        How probable it is that the answer is right, by what was seen.
    least_sure : Ground or None
        What it depends on that is least sure.
    """

    reply: ThingReply
    read: ReadScene
    probability: float
    least_sure: Ground | None

    @property
    def certainty(self) -> Certainty:
        """Whether the answer is said as it is, with "probably" or with "perhaps"."""
        return certainty_of(
            None
            if self.least_sure is None
            else Ground(self.least_sure.feature, self.least_sure.value, self.probability)
        )

    @property
    def text(self) -> str:
        """The answer; what is not sure is not said as sure."""
        if self.reply.asks_how_sure:
            return self._how_sure()
        said, adverb = self.reply.text, self.certainty.adverb
        return f"{adverb.capitalize()} {as_clause(said)}" if adverb else said

    def _how_sure(self) -> str:
        if self.reply.value is None:
            return self.reply.text
        if self.least_sure is None:
            return "I am sure: nothing that it rests on is uncertain."
        sure = "I am sure" if self.certainty is Certainty.SURE else "I am not sure"
        least = self.read.say(self.least_sure.feature, self.least_sure.value)
        return sentence(
            f"{sure}: it is right with a probability of {self.probability:.2f}; the least sure is "
            f"that {least} ({self.least_sure.probability:.2f})"
        )

    @cached_property
    def justification(self) -> Node:
        """The reasons, with the probability of what was seen."""
        return self.reply.justification.with_probabilities(self.read.seen)

    def say_least_sure(self) -> str | None:
        """What the answer depends on that is least sure, as a clause; None where all is sure."""
        if self.least_sure is None or self.certainty is Certainty.SURE:
            return None
        clause = self.read.say(self.least_sure.feature, self.least_sure.value)
        return f"{clause} ({self.least_sure.probability:.2f})"

    def to_dict(self) -> dict[str, Any]:
        """Return the answer and the scene as values that JSON can hold."""
        return {
            **self.reply.to_dict(),
            "text": self.text,
            "probability": round(self.probability, 4),
            "certainty": self.certainty.value,
            "least_sure": self.say_least_sure(),
            "justification": self.justification.to_dict(),
            "scene": scene_to_dict(self.read),
        }


def scene_to_dict(read: ReadScene) -> dict[str, Any]:
    """Return what was read of a picture as values that JSON can hold."""
    reading, things = read.reading, read.things
    seen = read.seen
    relations = []
    for feature, (value, probability) in seen.items():
        name, of = things_of(feature)
        if name in things.relations:
            relations.append(
                {
                    "relation": name,
                    "thing": of[0],
                    "other": of[1],
                    "holds": value == "yes",
                    "probability": round(probability, 4),
                }
            )
    found: dict[str, Any] = {
        "things": [
            _thing(thing, name, read.words.name(number))
            for number, (thing, name) in enumerate(zip(reading.things, read.names, strict=True))
        ],
        "doubtful": [_thing(thing, None, None) for thing in reading.doubtful],
        "relations": relations,
        "features": {
            key: {"value": one.value, "probability": round(one.probability, 4)}
            for key, one in reading.whole.items()
        },
        "concluded": [
            {"literal": str(literal), "text": read.beliefs.say(literal)}
            for literal in read.beliefs.concluded
        ],
        "consistent": reading.settled,
        "left_out": reading.left_out,
    }
    if read.domain.classes:
        found["class"] = {
            "label": reading.label,
            "by": reading.method,
            "probability": reading.class_probability,
        }
    return found


def _thing(thing: Any, name: str | None, called: str | None) -> dict[str, Any]:
    box = thing.box
    return {
        "name": name,
        "called": called,
        "probability": round(thing.probability, 4),
        "box": [round(corner, 1) for corner in (box.left, box.top, box.right, box.bottom)],
        "values": {
            key: {
                "value": seen.value,
                "probability": round(seen.probability, 4),
                "overruled": None if seen.overruled is None else seen.overruled[0],
            }
            for key, seen in thing.values.items()
        },
    }
