"""What follows in a scene of things: what is concluded, why, why not, and what would change it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import permutations

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.dialogue.scene_conclusions import SceneConclusions
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words, say_literal
from seewhy.errors import QuestionError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.change import Change, ChangeFinder, FeatureChange
from seewhy.knowledge.ground import key_of, literal_of
from seewhy.knowledge.justification import Node
from seewhy.knowledge.language import read_literal
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.things import of_things, things_of
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not
from seewhy.text.nearest import did_you_mean

__all__ = ["SceneBeliefs"]

_CHANGES = 8
"""Of changes that are equally small, so many are told."""


class SceneBeliefs:
    """What is believed of a scene whose things have names.

    Parameters
    ----------
    domain : Domain
    vector : FeatureVector
    names : sequence of str
        How the things that are there are called, in their order.
    reasoner : Reasoner, optional
        Of the domain's knowledge, where there is one.

    Examples
    --------
    >>> from seewhy.data.named_things import named_scene
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> vector, things = named_scene(domain, ["cup.colour=red"])
    >>> beliefs = SceneBeliefs(domain, vector, [thing.name for thing in things])
    >>> beliefs.say(beliefs.read("colour(cup, red)"))
    'cup is red'
    """

    def __init__(
        self,
        domain: Domain,
        vector: FeatureVector,
        names: Sequence[str],
        *,
        reasoner: Reasoner | None = None,
    ) -> None:
        self.domain = domain
        self.vector = vector
        self.reasoner = reasoner or Reasoner(domain.knowledge, domain.schema)
        self.names = dict(zip(domain.schema.presence, names, strict=False))
        self.decision = self.reasoner.decide(vector)

    def say(self, literal: Literal) -> str:
        """Return a literal as a clause, with the things' names."""
        return say_literal(self.domain, literal, names=self.names)

    def named(self, literal: Literal) -> str:
        """Return a literal as it is written, with the things' names."""
        return str(_renamed(literal, self.names))

    def read(self, text: str) -> Literal:
        """Read a literal about the scene: its arguments are names of things, or values.

        The name of the sort of the picture stands for the picture.

        Raises
        ------
        KnowledgeError
            If it is no literal.
        QuestionError
            If it speaks of what there is not.
        """
        literal = read_literal(text)
        signature = self.domain.knowledge.signature
        predicates = signature.predicates
        if literal.predicate not in predicates:
            raise QuestionError(
                f"'{literal.predicate}' is not declared in knowledge.al; "
                f"{did_you_mean(literal.predicate, predicates)}"
            )
        sorts = predicates[literal.predicate].sorts
        if len(sorts) != len(literal.arguments):
            raise QuestionError(
                f"'{literal.predicate}' takes {len(sorts)} arguments ({', '.join(sorts)}), got "
                f"'{text}'"
            )
        terms = {name: term for term, name in self.names.items()}
        arguments: list[str] = []
        for argument, sort in zip(literal.arguments, sorts, strict=True):
            if signature.sorts[sort].of_things:
                known: Sequence[str] = list(terms)
            else:
                known = signature.members(sort) or (self.domain.scene,)
            if argument not in known:
                raise QuestionError(
                    f"'{argument}' is no {sort} here; {did_you_mean(argument, known)}"
                )
            arguments.append(terms.get(argument, argument))
        return Literal(literal.predicate, tuple(arguments), literal.positive)

    @cached_property
    def concluded(self) -> tuple[Literal, ...]:
        """What is believed and neither seen nor a class."""
        schema = self.domain.schema
        classes = {key_of(literal) for literal in schema.classes.values()}
        found = (literal_of(str(symbol)) for symbol in sorted(self.reasoner.believed(self.vector)))
        return tuple(
            literal
            for literal in found
            if schema.feature_of(literal) is None and key_of(literal) not in classes
        )

    @property
    def scene(self) -> ThingScene:
        """The things with what is seen of them, and what is measured, seen or concluded of two."""
        things = self.domain.things
        assert things is not None, "the domain has no things"
        terms = list(self.names)
        shown = dict(zip(self.domain.schema.features, self.vector, strict=True))
        seen = [key for key in things.relations if key in things.seen]
        related: dict[str, list[tuple[int, int]]] = {key: [] for key in seen}
        unknown: dict[str, list[tuple[int, int]]] = {key: [] for key in seen}
        for key in seen:
            for pair in permutations(range(len(terms)), 2):
                value = shown[of_things(key, *(terms[number] for number in pair))]
                if value == "yes":
                    related[key].append(pair)
                elif value is None:
                    unknown[key].append(pair)
        scene = thing_scene(
            things,
            [{key: shown[of_things(key, term)] for key in things.features} for term in terms],
            relations=related,
            not_known=unknown,
        )
        whole = {key: shown[key] for key in self.domain.features}
        conclusions = SceneConclusions(self.domain, reasoner=self.reasoner, whole=whole)
        return conclusions.taken(scene, self.reasoner.believed(self.vector))

    def is_believed(self, literal: Literal) -> bool:
        """Whether a literal is believed."""
        return key_of(literal) in set(map(str, self.reasoner.believed(self.vector)))

    def why(self, literal: Literal) -> Node:
        """Return why a literal is believed, or why it is not."""
        node = why(self.reasoner, self.vector, literal, say=self.say, names=self.names)
        return node or why_not(self.reasoner, self.vector, literal, say=self.say, names=self.names)

    def changes(self, literal: Literal) -> tuple[Change, ...]:
        """Return the smallest changes that make a literal believed."""
        return self._finder.smallest_for(self.vector, literal, limit=_CHANGES)

    @cached_property
    def _finder(self) -> ChangeFinder:
        return ChangeFinder(self.reasoner)

    def say_change(self, change: Change) -> str:
        """Return a change as a clause behind "it would be so if"."""
        presences = {named: thing for thing, named in self.domain.schema.presence.items()}
        come = {presences[c.feature] for c in change.changes if c.feature in presences}
        clauses = [
            self._say_moved(presences[c.feature], c, change.changes)
            if c.feature in presences
            else self.say(self.domain.schema.features[c.feature][c.after])
            for c in change.changes
            if c.feature in presences or come.isdisjoint(things_of(c.feature)[1])
        ]
        return join_words(clauses)

    def _say_moved(self, thing: str, moved: FeatureChange, changes: Sequence[FeatureChange]) -> str:
        """That a thing is taken away, or that one comes in, with what it has to be like."""
        things = self.domain.things
        assert things is not None, "the domain has no things"
        if moved.after == "no":
            return f"{self.names.get(thing, thing)} were not there"
        names = {**self.names, thing: "it"}
        like = [
            say_literal(self.domain, self.domain.schema.features[c.feature][c.after], names=names)
            for c in changes
            if thing in things_of(c.feature)[1] and c is not moved
        ]
        whose = f" ({join_words(like)})" if like else ""
        return f"there were another {things.one}{whose}"


def _renamed(literal: Literal, names: dict[str, str]) -> Literal:
    arguments = tuple(names.get(argument, argument) for argument in literal.arguments)
    return Literal(literal.predicate, arguments, literal.positive)
