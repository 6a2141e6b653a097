"""What axioms conclude of the things of a scene, also of one that is supposed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import permutations
from types import MappingProxyType
from weakref import WeakKeyDictionary

import clingo

from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.losses import loss_of, with_losses
from seewhy.domain.domain import Domain
from seewhy.domain.things import CONCLUDED, Things
from seewhy.domain.wording import say_literal
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import complement_of, key_of, text_of
from seewhy.knowledge.justification import Node
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.things import of_things
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not

__all__ = ["SceneConclusions"]

_SMALLER: WeakKeyDictionary[Reasoner, dict[int, Reasoner]] = WeakKeyDictionary()
"""A reasoner for the most things → those for fewer, made when they are needed first."""
_LOSING: WeakKeyDictionary[Reasoner, tuple[Domain, Reasoner]] = WeakKeyDictionary()
"""A reasoner → that of the same domain in which things may lose what they need."""


class SceneConclusions:
    """Concludes what axioms say of scenes, and tells why.

    Parameters
    ----------
    domain : Domain
    reasoner : Reasoner, optional
        Of the domain's knowledge, where there is one.
    whole : mapping of str to str or None
        The values of the features of the picture as a whole.
    lost : mapping of str to int
        What follows where a thing loses what it needs → the set of those that do.

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
        lost: Mapping[str, int] = MappingProxyType({}),
    ) -> None:
        assert domain.things is not None, "the domain has no things"
        self.domain = domain
        self.things: Things = domain.things
        self.whole = whole
        self.lost = lost
        self._terms = tuple(domain.schema.presence)
        whole_reasoner = reasoner or Reasoner(domain.knowledge, domain.schema)
        self._reasoners = _SMALLER.setdefault(whole_reasoner, {})
        self.reasoner = whole_reasoner

    def conclude(self, scene: ThingScene, without: int = 0) -> ThingScene:
        """Return a scene with what follows from what is seen in it, anew.

        ``without`` are things that are taken as not there.
        """
        reasoner = self.reasoner_for(scene.count)
        vector = self._vector(scene, without, reasoner.schema)
        return self.taken(scene, reasoner.believed(vector))

    def when_taken_away(self, scene: ThingScene, without: int) -> ThingScene:
        """Return a scene from which things are taken away, with what then follows.

        Other than where they never were, what would fall without them falls; as where it comes to
        lie nobody knows, nothing else is known of it.

        Examples
        --------
        >>> from seewhy.data.thing_scene import thing_scene
        >>> from seewhy.domain.domain import load_domain
        >>> domain = load_domain("tabletop")
        >>> scene = thing_scene(
        ...     domain.things, [{"shape": "cube"}, {"shape": "cube"}], relations={"on": [(0, 1)]})
        >>> conclusions = SceneConclusions(domain)
        >>> conclusions.conclude(scene, 0b10).concluded["falls"]
        0
        >>> conclusions.when_taken_away(scene, 0b10).concluded["falls"]
        1
        """
        lost = self._losing(scene, without) if without else {}
        if not lost:
            return self.conclude(scene, without)
        return self._with_losses(lost).conclude(scene, without)

    def _losing(self, scene: ThingScene, without: int) -> dict[str, int]:
        """What follows of things → those of which it does, since what they need is taken away."""
        removed = {key: r.removed for key, r in self.things.relations.items() if r.removed}
        lost: dict[str, int] = {}
        before = self.conclude(scene) if removed else scene
        for key, conclusion in removed.items():
            for number in range(scene.count):
                if without >> number & 1:
                    left = before.related[key][number] & ~without
                    lost[conclusion] = lost.get(conclusion, 0) | left
        return {conclusion: left for conclusion, left in lost.items() if left}

    def _with_losses(self, lost: Mapping[str, int]) -> SceneConclusions:
        if self.reasoner not in _LOSING:
            domain = with_losses(self.domain)
            _LOSING[self.reasoner] = domain, Reasoner(domain.knowledge, domain.schema)
        domain, reasoner = _LOSING[self.reasoner]
        return SceneConclusions(domain, reasoner=reasoner, whole=self.whole, lost=lost)

    def vector(self, scene: ThingScene, without: int = 0) -> FeatureVector:
        """Return a scene as the domain reasons with it; ``without`` as for :meth:`conclude`."""
        return self._vector(scene, without, self.domain.schema)

    def shortest_vector(self, scene: ThingScene) -> FeatureVector:
        """Return what is seen in a scene as :meth:`reasoner_for` so many things takes it."""
        return self._vector(scene, 0, self.reasoner_for(scene.count).schema)

    def taken(self, scene: ThingScene, believed: Iterable[clingo.Symbol]) -> ThingScene:
        """Return a scene with what is believed of it by somebody who has reasoned already."""
        believed = frozenset(believed)
        contradicted = any(complement_of(symbol) in believed for symbol in believed)
        consistent = bool(believed) and not contradicted
        unsettled = 0
        for lost in self.lost.values():
            unsettled |= lost
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
            unsettled=unsettled,
            label=self._label(believed) if consistent else None,
            label_seen=False,
            consistent=consistent,
            conclusions=self,
        )

    def _label(self, believed: frozenset[clingo.Symbol]) -> str | None:
        """The one class that is believed."""
        if not self.domain.classes:
            return None
        keys = set(map(text_of, believed))
        found = [
            label
            for label, literal in self.domain.schema.classes.items()
            if key_of(literal) in keys
        ]
        return found[0] if len(found) == 1 else None

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
        return self._why(scene, self._literal(key, numbers), names, without)

    def why_class(
        self, scene: ThingScene, label: str, names: Sequence[str], *, without: int = 0
    ) -> Node:
        """Return why the picture as a whole is of a class, or why it is not."""
        return self._why(scene, self.domain.schema.classes[label], names, without)

    def _why(self, scene: ThingScene, literal: Literal, names: Sequence[str], without: int) -> Node:
        called = dict(zip(self._terms, names, strict=False))
        reasoner = self.reasoner_for(scene.count)
        vector = self._vector(scene, without, reasoner.schema)

        def say(literal: Literal) -> str:
            return say_literal(self.domain, literal, names=called)

        found = why(reasoner, vector, literal, say=say, names=called)
        return found or why_not(reasoner, vector, literal, say=say, names=called)

    def rests_on(self, key: str) -> frozenset[str]:
        """Return the features and relations that are seen, and on which a predicate rests."""
        losses = set(map(loss_of, self.lost))
        return frozenset(self._needed_for(key) & set(self.things.seen) - losses)

    def rest_on(self, keys: Iterable[str], predicate: str) -> bool:
        """Whether one of some predicates is a predicate, or rests on it."""
        return any(predicate in self._needed_for(key) for key in keys)

    def _needed_for(self, key: str) -> set[str]:
        needed, open_ = {key}, [key]
        while open_:
            head = open_.pop()
            for axiom in self.domain.knowledge.axioms:
                if axiom.head.predicate != head:
                    continue
                for name in axiom.predicates - needed:
                    needed.add(name)
                    open_.append(name)
        return needed

    def _literal(self, key: str, numbers: Sequence[int]) -> Literal:
        return Literal(key, tuple(self._terms[number] for number in numbers))

    def reasoner_for(self, count: int) -> Reasoner:
        """Return what reasons about so many things: the fewer, the faster."""
        if count >= len(self._terms):
            return self.reasoner
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
        for conclusion, lost in self.lost.items():
            for number in here:
                loses = "yes" if lost >> number & 1 else "no"
                found[of_things(loss_of(conclusion), terms[number])] = loses
        return found


def _seen_of(scene: ThingScene, key: str, one: int, to: int) -> str | None:
    if scene.related[key][to] >> one & 1:
        return "yes"
    unknown = scene.unknown.get(key)
    return None if unknown and unknown[to] >> one & 1 else "no"
