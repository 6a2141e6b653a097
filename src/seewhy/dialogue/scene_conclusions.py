"""What axioms conclude of the things of a scene, also of one that is supposed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import permutations
from types import MappingProxyType
from weakref import WeakKeyDictionary

import clingo

from seewhy.data.thing_scene import ThingScene
from seewhy.domain.domain import Domain
from seewhy.domain.things import CONCLUDED, Things
from seewhy.domain.wording import say_literal
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.justification import Node
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.things import of_things
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not

__all__ = ["SceneConclusions"]

_SMALLER: WeakKeyDictionary[Reasoner, dict[int, Reasoner]] = WeakKeyDictionary()
"""A reasoner for the most things → those for fewer, made when they are needed first."""


class SceneConclusions:
    """Concludes what axioms say of scenes, and tells why.

    Parameters
    ----------
    domain : Domain
    reasoner : Reasoner, optional
        Of the domain's knowledge, where there is one.
    whole : mapping of str to str or None
        The values of the features of the picture as a whole.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> scene = thing_scene(
    ...     domain.things, [{"shape": "cube"}, {"shape": "sphere"}], relations={"on": [(0, 1)]})
    >>> conclusions = SceneConclusions(domain)
    >>> conclusions.conclude(scene).concluded["falls"]
    1
    >>> conclusions.why(scene, "falls", (0,), ("the block", "the ball")).text
    'the block would fall'
    """

    def __init__(
        self,
        domain: Domain,
        *,
        reasoner: Reasoner | None = None,
        whole: Mapping[str, str | None] = MappingProxyType({}),
    ) -> None:
        assert domain.things is not None, "the domain has no things"
        self.domain = domain
        self.things: Things = domain.things
        self.whole = whole
        self._terms = tuple(domain.schema.presence)
        whole_reasoner = reasoner or Reasoner(domain.knowledge, domain.schema)
        self._reasoners = _SMALLER.setdefault(whole_reasoner, {})
        self._whole_reasoner = whole_reasoner

    def conclude(self, scene: ThingScene, without: int = 0) -> ThingScene:
        """Return a scene with what follows from what is seen in it, anew.

        ``without`` are things that are taken as not there.
        """
        reasoner = self.reasoner_for(scene.count)
        vector = self._vector(scene, without, reasoner.schema)
        return self.taken(scene, reasoner.believed(vector))

    def vector(self, scene: ThingScene, without: int = 0) -> FeatureVector:
        """Return a scene as the domain reasons with it; ``without`` as for :meth:`conclude`."""
        return self._vector(scene, without, self.domain.schema)

    def shortest_vector(self, scene: ThingScene) -> FeatureVector:
        """Return what is seen in a scene as :meth:`reasoner_for` so many things takes it."""
        return self._vector(scene, 0, self.reasoner_for(scene.count).schema)

    def taken(self, scene: ThingScene, believed: Iterable[clingo.Symbol]) -> ThingScene:
        """Return a scene with what is believed of it by somebody who has reasoned already."""
        concluded = self._concluded(believed)
        related = {key: [0] * scene.count for key in self._relations}
        for key, rows in related.items():
            for one, to in concluded.get(key, ()):
                rows[to] |= 1 << one
        return replace(
            scene,
            related={**scene.related, **{key: tuple(rows) for key, rows in related.items()}},
            unknown={**scene.unknown, **dict.fromkeys(related, (0,) * scene.count)},
            concluded={
                key: sum(1 << one for (one,) in concluded.get(key, ()))
                for key in self.things.conclusions
            },
            groups={
                key: tuple(sorted({tuple(sorted(chosen)) for chosen in concluded.get(key, ())}))
                for key in self.things.groups
            },
            conclusions=self,
        )

    @property
    def _relations(self) -> list[str]:
        relations = self.things.relations.items()
        return [key for key, relation in relations if relation.measure == CONCLUDED]

    def _concluded(self, believed: Iterable[clingo.Symbol]) -> dict[str, list[tuple[int, ...]]]:
        """What is concluded → the things of which it is so, each combination once."""
        wanted = {*self._relations, *self.things.conclusions, *self.things.groups}
        numbers = {term: number for number, term in enumerate(self._terms)}
        found: dict[str, list[tuple[int, ...]]] = {}
        for symbol in believed:
            if symbol.positive and symbol.name in wanted:
                things = tuple(numbers[argument.name] for argument in symbol.arguments)
                if len(set(things)) == len(things):
                    found.setdefault(symbol.name, []).append(things)
        return found

    def why(
        self,
        scene: ThingScene,
        key: str,
        numbers: Sequence[int],
        names: Sequence[str],
        *,
        without: int = 0,
    ) -> Node:
        """Return why something is concluded of things, or why it is not.

        ``names`` says how all things of the scene are called.
        """
        called = dict(zip(self._terms, names, strict=False))
        reasoner = self.reasoner_for(scene.count)
        vector = self._vector(scene, without, reasoner.schema)

        def say(literal: Literal) -> str:
            return say_literal(self.domain, literal, names=called)

        literal = self._literal(key, numbers)
        found = why(reasoner, vector, literal, say=say, names=called)
        return found or why_not(reasoner, vector, literal, say=say, names=called)

    def rests_on(self, key: str) -> frozenset[str]:
        """Return the features and relations that are seen, and on which a conclusion rests."""
        needed, open_ = {key}, [key]
        while open_:
            head = open_.pop()
            for axiom in self.domain.knowledge.axioms:
                if axiom.head.predicate != head:
                    continue
                for name in axiom.predicates - needed:
                    needed.add(name)
                    open_.append(name)
        return frozenset(needed & set(self.things.seen))

    def _literal(self, key: str, numbers: Sequence[int]) -> Literal:
        return Literal(key, tuple(self._terms[number] for number in numbers))

    def reasoner_for(self, count: int) -> Reasoner:
        """Return what reasons about so many things: the fewer, the faster."""
        if count >= len(self._terms):
            return self._whole_reasoner
        if count not in self._reasoners:
            few = self.domain.with_most_things(max(1, count))
            self._reasoners[count] = Reasoner(few.knowledge, few.schema)
        return self._reasoners[count]

    def _vector(self, scene: ThingScene, without: int, schema: SceneSchema) -> FeatureVector:
        values: dict[str, str | None] = dict(self.whole)
        for number, presence in enumerate(schema.presence.values()):
            there = number < scene.count and not without >> number & 1
            values[presence] = "yes" if there else "no"
        values |= self._seen(scene, [n for n in range(scene.count) if not without >> n & 1])
        return schema.vector(values)

    def _seen(self, scene: ThingScene, here: Sequence[int]) -> dict[str, str | None]:
        terms = self._terms
        found: dict[str, str | None] = {
            of_things(key, terms[number]): column[number]
            for key, column in scene.values.items()
            for number in here
        }
        for key, relation in self.things.relations.items():
            if relation.measure != CONCLUDED:
                for one, to in permutations(here, 2):
                    found[of_things(key, terms[one], terms[to])] = _seen_of(scene, key, one, to)
        return found


def _seen_of(scene: ThingScene, key: str, one: int, to: int) -> str | None:
    if scene.related[key][to] >> one & 1:
        return "yes"
    unknown = scene.unknown.get(key)
    return None if unknown and unknown[to] >> one & 1 else "no"
