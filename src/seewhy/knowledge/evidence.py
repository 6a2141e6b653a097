"""What a scene's answer sets offer to justify beliefs with: what was seen, what fired."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cached_property
from itertools import chain

import clingo

from seewhy.knowledge.answer_set import AnswerSet
from seewhy.knowledge.axiom import Axiom, Literal
from seewhy.knowledge.condition_words import say_condition
from seewhy.knowledge.foundation import Forced, Foundation, Need, opposite
from seewhy.knowledge.ground import key_of, literal_of, text_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.possible import Asked, Belief, Instance, instances_by_head
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.things import things_of

Say = Callable[[Literal], str]
"""How a literal is said in words."""
_COMPARED = re.compile(r"(\w+) (!=|=) (\w+)")
_COMPARES = {"!=": "is not", "=": "is"}


class Evidence:
    """One answer set of a scene, indexed for justifications.

    Attributes
    ----------
    holds : set of str
        The keys of the literals that are believed in this answer set.
    believed : frozenset of str
        Those that are believed in every preferred answer set.
    others : tuple of Evidence
        The other preferred answer sets.
    names : dict of str to str
        How terms that are compared are called.
    """

    def __init__(
        self,
        reasoner: Reasoner,
        scene: FeatureVector,
        answer_set: AnswerSet,
        say: Say,
        *,
        believed: Collection[clingo.Symbol] | None = None,
        others: tuple[Evidence, ...] = (),
        names: Mapping[str, str] | None = None,
    ) -> None:
        self.reasoner = reasoner
        self.schema = reasoner.schema
        self.signature = reasoner.knowledge.signature
        self.scene = scene
        self.vector = dict(zip(self.schema.features, scene, strict=True))
        self.answer_set = answer_set
        self.say = say
        self.names = names or {}
        self.holds = set(map(text_of, answer_set.holds))
        self.believed = frozenset(self.holds if believed is None else map(text_of, believed))
        self.others = others
        self._shown: dict[str, Node | None] = {}
        self._foundations: dict[Belief, Foundation] = {}
        self._conditions_said: dict[tuple[str, bool], str] = {}
        self._needs: dict[tuple[str, tuple[str, ...]], list[tuple[int, Need, bool]]] = {}

    @cached_property
    def _supports(self) -> dict[str, list[Instance]]:
        return instances_by_head(self.reasoner.knowledge.axioms, self.answer_set.firings)

    def firing(self, key: str) -> list[Instance]:
        """The instances that conclude a belief."""
        return self._supports.get(key, [])

    def concluding(self, key: str) -> list[Instance]:
        """The instances that could conclude a literal, in this scene or another."""
        return self.reasoner.possible.concluding(key)

    def needs(self, instance: Instance) -> list[tuple[int, Need, bool]]:
        """What each condition comes to here: its place, what it rests on, whether it holds."""
        place = (instance.axiom.identifier, instance.values)
        if place not in self._needs:
            self._needs[place] = [
                (number, *self.comes_to(asked))
                for number, asked in self.reasoner.possible.asked(instance)
            ]
        return self._needs[place]

    def comes_to(self, asked: Asked) -> tuple[Need, bool]:
        """What a condition rests on here, and whether it holds."""
        if isinstance(asked, Belief):
            here = Belief(asked.key, asked.key in self.holds)
            return here, here == asked
        holds = asked.holds(self.holds)
        return (asked, holds), holds

    def foundation(self, root: Belief, forced: Forced) -> Foundation:
        """What is founded of what a belief, or an absence, may rest on."""
        if root not in self._foundations:
            self._foundations[root] = Foundation(self, root, forced)
        return self._foundations[root]

    def exceptions(self, key: str) -> list[Instance]:
        """The instances of defaults that were given up so that the literal is believed."""
        return self._given_up.get(key, [])

    @cached_property
    def _given_up(self) -> dict[str, list[Instance]]:
        axioms: dict[str, Axiom] = {
            axiom.identifier: axiom for axiom in self.reasoner.knowledge.axioms
        }
        given_up: dict[str, list[Instance]] = {}
        for identifier, values in self.answer_set.exceptions:
            instance = Instance(axioms[identifier], values)
            denied = instance.axiom.head.substitute(instance.binding).complement
            given_up.setdefault(key_of(denied), []).append(instance)
        return given_up

    def is_seen(self, key: str) -> bool:
        """Whether the picture itself shows something."""
        return self._seen(key) is not None

    def is_ruled_out(self, key: str) -> bool:
        """Whether something cannot be believed, because a thing that it is about is not there."""
        return self.ruled_out(key) is not None

    def ruled_out(self, key: str) -> Node | None:
        """The node that says that the things are not there that a literal is about.

        What is not there has no features, and stands in no relation. The node speaks of all
        things that are not there at once, so that what fails by one of them is told once.
        """
        if self._nothing_else is None:
            return None
        arguments = literal_of(key).arguments
        return self._nothing_else if not self._absent.isdisjoint(arguments) else None

    @cached_property
    def things(self) -> tuple[str, ...]:
        """The things that are there, or may be."""
        return tuple(thing for thing in self.schema.presence if thing not in self._absent)

    @cached_property
    def _absent(self) -> frozenset[str]:
        """The things that are not there."""
        presence = self.schema.presence
        return frozenset(thing for thing, named in presence.items() if self.vector[named] == "no")

    @cached_property
    def _nothing_else(self) -> Node | None:
        return self.absent_things([self.schema.presence[thing] for thing in self._absent])

    def absent_things(self, presences: Collection[str]) -> Node | None:
        """The node of things that are not there, given the features that say so, if there are any.

        The features of all other things are known to be those of no thing.
        """
        ordered = [named for named in self.schema.presence.values() if named in presences]
        if not ordered:
            return None
        sort = literal_of(ordered[0]).predicate.replace("_", " ")
        every = len(ordered) == len(self.schema.presence)
        return Node(
            literal=f"-{ordered[0]}",
            text=f"there is no {sort}" if every else f"there is no other {sort}",
            basis=Basis.FEATURE,
            feature=ordered[0],
            value="no",
            beside=tuple(ordered[1:]),
        )

    def feature_nodes(self, features: Iterable[str]) -> tuple[Node, ...]:
        """The nodes of features of the scene; things that are not there have one together."""
        named = list(features)
        absent = [f for f in named if f in self._presences and self.vector[f] == "no"]
        nodes = [self.feature_node(feature) for feature in named if feature not in absent]
        together = self.absent_things(absent)
        return (*nodes, *([together] if together else []))

    @cached_property
    def _presences(self) -> frozenset[str]:
        return frozenset(self.schema.presence.values())

    def seen(self, literal: Literal) -> Node | None:
        """The node of a literal that the picture itself shows."""
        shown = self._seen(key_of(literal))
        return shown and Node(
            literal=str(literal),
            text=shown.text,
            basis=Basis.FEATURE,
            feature=shown.feature,
            value=shown.value,
        )

    def _seen(self, key: str) -> Node | None:
        if key not in self._shown:
            self._shown[key] = self._showing(key)
        return self._shown[key]

    def _showing(self, key: str) -> Node | None:
        """The node of the value of a feature by which the picture shows a literal."""
        for feature, values in reversed(self.schema.shown_by.get(key, {}).items()):
            value = self.vector[feature]
            if value in values:
                text = self.say(self.schema.features[feature][value])
                return Node(
                    literal=key, text=text, basis=Basis.FEATURE, feature=feature, value=value
                )
        return None

    def feature_node(self, feature: str) -> Node:
        """The node of a feature of the scene, whether its value is known or not."""
        value = self.vector[feature]
        if value is None:
            return Node(
                feature,
                f"the {_say_feature(feature)} is not known",
                Basis.ABSENCE,
                feature=feature,
            )
        literal = self.schema.features[feature][value]
        return Node(str(literal), self.say(literal), Basis.FEATURE, feature=feature, value=value)

    def say_condition(self, text: str, *, holds: bool) -> str:
        """Say in words that a condition of several literals holds, or what is so instead."""
        if (text, holds) not in self._conditions_said:
            said = say_condition(text, self.signature, self.say, holds=holds)
            self._conditions_said[text, holds] = said
        return self._conditions_said[text, holds]

    def say_comparison(self, text: str) -> str:
        """Say a comparison of two terms that have names in these: "the cup is not the box"."""
        compared = _COMPARED.fullmatch(text)
        if compared is None or not {compared[1], compared[3]} <= self.names.keys():
            return text
        return f"{self.names[compared[1]]} {_COMPARES[compared[2]]} {self.names[compared[3]]}"

    def worth(self, key: str) -> int:
        """How readily a literal is told, believed or not, where others would do as well.

        Least that nothing says so, then what follows, then what a picture rules out, and most
        what it shows.
        """
        if key in self.holds:
            return 3 if self._seen(key) is not None else 1
        return 2 if self._seen(opposite(key)) is not None or self.is_ruled_out(key) else 0


def _say_feature(feature: str) -> str:
    """A feature in words: ``on(block1,block2)`` is the on of block 1 and block 2."""
    name, things = things_of(feature)
    of_what = " and ".join(re.sub(r"(\d+)$", r" \1", thing) for thing in things)
    return f"{name} of {of_what}".replace("_", " ") if things else name.replace("_", " ")


def evidence_of(
    reasoner: Reasoner,
    vector: FeatureVector,
    *,
    say: Say = str,
    names: Mapping[str, str] | None = None,
) -> Evidence:
    """Return the evidence of a scene; where there is no answer set, what was seen alone."""
    first, *others = reasoner.answer_sets(vector) or (_seen_alone(reasoner.schema, vector),)
    believed = reasoner.believed(vector) if others else None
    return Evidence(
        reasoner,
        vector,
        first,
        say,
        believed=believed,
        others=tuple(
            Evidence(reasoner, vector, other, say, believed=believed, names=names)
            for other in others
        ),
        names=names,
    )


def _seen_alone(schema: SceneSchema, vector: FeatureVector) -> AnswerSet:
    seen = frozenset(chain.from_iterable(_observed(schema, vector)))
    return AnswerSet(seen, {}, (), conflict=False)


def _observed(schema: SceneSchema, vector: FeatureVector) -> Iterator[tuple[clingo.Symbol, ...]]:
    """For every feature the literals that are believed because of its value."""
    for feature, value in zip(schema.features, vector, strict=True):
        if value is not None:
            yield tuple(map(clingo.parse_term, schema.shown(feature, value)))
