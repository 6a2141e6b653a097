"""The things of a scene as the constants, statics and first observations of planning."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import permutations

from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.scene_conclusions import SceneConclusions
from seewhy.dialogue.things.evaluating import Evaluation
from seewhy.dialogue.things.wording import ThingWords
from seewhy.domain.domain import Domain
from seewhy.domain.thing_wording import denied
from seewhy.domain.things import CONCLUDED, Things
from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge, read_axioms
from seewhy.knowledge.signature import PredicateKind
from seewhy.knowledge.things import literals_about
from seewhy.planning.tables import FluentTable

__all__ = ["SceneOfPlan", "thing_clauses", "with_scene"]

_SEEN = "seen"


@dataclass(frozen=True)
class SceneOfPlan:
    """The scene in which a plan begins.

    Attributes
    ----------
    domain : Domain
        With things.
    scene : ThingScene
    """

    domain: Domain
    scene: ThingScene

    @property
    def things(self) -> Things:
        """What the domain says of things."""
        assert self.domain.things is not None, "the domain has no things"
        return self.domain.things

    @cached_property
    def conclusions(self) -> SceneConclusions:
        """What concludes what follows in scenes of these things."""
        return SceneConclusions(self.domain)

    @cached_property
    def concluded(self) -> ThingScene:
        """The scene with what follows in it."""
        return self.conclusions.conclude(self.scene)

    def term(self, number: int) -> str:
        """What a thing is called in the knowledge; things count from 0."""
        return f"{self.things.sort}{number + 1}"

    def number(self, term: str) -> int | None:
        """The number of the thing of that name; None of what is no thing."""
        digits = term.removeprefix(self.things.sort)
        known = digits != term and digits.isdecimal() and 0 < int(digits) <= self.scene.count
        return int(digits) - 1 if known else None

    def names(self) -> dict[str, str]:
        """What the things are called in answers, by what is seen of them."""
        words = ThingWords(Evaluation(self.scene, self.things))
        return {self.term(number): words.name(number) for number in range(self.scene.count)}


def with_scene(knowledge: Knowledge, at_first: SceneOfPlan) -> tuple[Knowledge, list[Literal]]:
    """Return the knowledge of a scene's things, and what is seen of them that may change.

    What is seen of a static is known; of a fluent it is an observation. Relations that are measured
    in the picture are left out: they say where things stand in it, which no axiom about actions
    keeps true.

    Raises
    ------
    PlanningError
        If the scene has no things.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.knowledge.language import read_knowledge
    >>> domain = load_domain("tabletop")
    >>> scene = thing_scene(domain.things, [{"shape": "cube"}, {}], relations={"on": [(0, 1)]})
    >>> known = read_knowledge('''
    ... #sort thing = things. #sort form = {cube, sphere}. #static shape(thing, form).
    ... #fluent basic on(thing, thing).''')
    >>> known, seen = with_scene(known, SceneOfPlan(domain, scene))
    >>> list(map(str, known.axioms))
    ['shape(thing1, cube).', '-shape(thing1, sphere).']
    >>> list(map(str, seen))
    ['on(thing1, thing2)', '-on(thing2, thing1)']
    """
    things, scene = at_first.things, at_first.scene
    if not scene.count:
        raise PlanningError(
            f"{scene.image or 'the picture'}: shows no {things.one}, so nothing can be planned; "
            "take another picture"
        )
    measured = {
        key
        for key, relation in things.relations.items()
        if relation.measure not in (_SEEN, CONCLUDED)
    }
    predicates = knowledge.signature.predicates
    stale = {key for key in measured & predicates.keys() if not predicates[key].kind.is_fluent}
    kept = knowledge.without_names(frozenset(stale))
    sort = replace(
        kept.signature.sorts[things.sort],
        members=tuple(map(at_first.term, range(scene.count))),
        of_things=False,
    )
    signature = replace(kept.signature, sorts={**kept.signature.sorts, things.sort: sort})
    counted = replace(kept, signature=signature)
    fixed: list[Literal] = []
    changing: list[Literal] = []
    for literal in _seen(counted, at_first):
        kind = signature.kind(literal.predicate)
        if kind is PredicateKind.STATIC:
            fixed.append(literal)
        elif kind is PredicateKind.FLUENT_BASIC:
            changing.append(literal)
    facts = "\n".join(f"{literal}." for literal in fixed)
    axioms = read_axioms(facts, signature, file=scene.image or "scene", letter="s")
    return replace(counted, axioms=(*counted.axioms, *axioms)), changing


def _seen(knowledge: Knowledge, at_first: SceneOfPlan) -> Iterator[Literal]:
    """What is seen of each thing and of each two, as literals; what is not known is left out."""
    things, scene, signature = at_first.things, at_first.scene, knowledge.signature
    numbers = range(scene.count)
    for key in filter(signature.predicates.__contains__, things.features):
        for number in numbers:
            about = literals_about(signature.predicates[key], (at_first.term(number),), signature)
            value = scene.values[key][number]
            if value is not None:
                yield about[value]
                yield from _others(about, value)
    for key, relation in things.relations.items():
        if relation.measure == CONCLUDED or key not in signature.predicates:
            continue
        unknown = scene.unknown.get(key)
        for number, to in permutations(numbers, 2):
            literal = Literal(key, (at_first.term(number), at_first.term(to)))
            if scene.related[key][to] >> number & 1:
                yield literal
            elif not (unknown and unknown[to] >> number & 1):
                yield literal.complement


def _others(about: dict[str, Literal], value: str) -> Iterator[Literal]:
    """That a thing has no other value of a feature that has more than yes and no."""
    for other, literal in about.items():
        if other != value and literal.arguments != about[value].arguments:
            yield literal.complement


def thing_clauses(things: Things, knowledge: Knowledge) -> dict[str, FluentTable]:
    """Return how relations and conclusions of a domain are said, as planning.toml would say it.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> tabletop = load_domain("tabletop")
    >>> clauses = thing_clauses(tabletop.things, tabletop.knowledge)
    >>> clauses["on"].say, clauses["on"].deny, clauses["falls"].deny
    ('{0} is on {1}', '{0} is not on {1}', '{0} would not fall')
    """
    found = {
        key: FluentTable(say=relation.say, deny=denied(relation.say))
        for key, relation in things.relations.items()
    }
    for key, conclusion in things.conclusions.items():
        found[key] = FluentTable(
            say=conclusion.say.replace("{it}", "{0}"), deny=conclusion.deny.replace("{it}", "{0}")
        )
    return {key: table for key, table in found.items() if key in knowledge.signature.predicates}
