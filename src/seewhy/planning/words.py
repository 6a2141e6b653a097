"""Say fluents, actions and things in the words of a planning domain."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import clingo

from seewhy.knowledge.ground import complement_of
from seewhy.planning.diagnosis.diagnosis import Surprise, SurpriseKind
from seewhy.planning.tables import ActionTable, FluentTable
from seewhy.text.predicate_words import named_clause, past_clause, past_form

_SLOT = re.compile(r"\{(\d+)\}")


@dataclass(frozen=True)
class PlanningWords:
    """The words of planning.toml; what it leaves out is said by its name.

    ``fixed`` names the statics, whether or not there are words for them; ``actors`` says which
    argument of an action is whoever does it.

    Examples
    --------
    >>> words = PlanningWords({"sally": "Sally"}, {"loc": FluentTable(say="{0} is in {1}")}, {})
    >>> words.say(clingo.parse_term("loc(sally,kitchen)"))
    'Sally is in kitchen'
    >>> words.say(clingo.parse_term("-loc(sally,kitchen)"))
    'it is not so that Sally is in kitchen'
    """

    things: Mapping[str, str]
    fluents: Mapping[str, FluentTable]
    actions: Mapping[str, ActionTable]
    robot: str | None = None
    possessives: Mapping[str, str] = field(default_factory=dict)
    statics: Mapping[str, FluentTable] = field(default_factory=dict)
    fixed: frozenset[str] = frozenset()
    actors: Mapping[str, int] = field(default_factory=dict)

    def name(self, term: clingo.Symbol | str) -> str:
        """How a thing is called."""
        key = str(term)
        return self.things.get(key, key.strip('"').replace("_", " "))

    def table(self, predicate: str) -> FluentTable | None:
        """The words of planning.toml for a fluent or static; None where it has none."""
        return self.fluents.get(predicate) or self.statics.get(predicate)

    def clauses(self, predicate: str, arity: int) -> tuple[str, str]:
        """The clauses, with slots, that say that a fluent or static holds, and that it does not.

        Examples
        --------
        >>> PlanningWords({}, {}, {}).clauses("next_to", 2)
        ('{0} is next to {1}', '{0} is not next to {1}')
        """
        table = self.table(predicate)
        if table is None:
            return named_clause(predicate, arity)
        return table.say, table.deny or f"it is not so that {table.say}"

    def say(self, literal: clingo.Symbol) -> str:
        """A literal about a fluent or static as a clause."""
        holds, denied = self.clauses(literal.name, len(literal.arguments))
        return self._filled(holds if literal.positive else denied, literal.arguments)

    def said(self, literal: clingo.Symbol) -> str:
        """A literal as a clause in the past tense; what never changes is said in the present.

        Examples
        --------
        >>> words = PlanningWords({}, {"has": FluentTable(say="{0} holds {1}")}, {})
        >>> words.said(clingo.parse_term("has(bob,key)"))
        'bob held key'
        """
        holds, denied = self.clauses(literal.name, len(literal.arguments))
        clause = holds if literal.positive else denied
        clause = clause if literal.name in self.fixed else past_clause(clause)
        return self._filled(clause, literal.arguments)

    def actor(self, action: clingo.Symbol) -> str | None:
        """Whoever does an action, where it is another than the robot that speaks."""
        place = self.actors.get(action.name)
        if place is None or str(action.arguments[place]) == self.robot:
            return None
        return str(action.arguments[place])

    def do(self, action: clingo.Symbol) -> str:
        """An action as what is to be done: "move to the kitchen", "let the other robot move"."""
        actor, act = self.actor(action), self.act(action)
        return act if actor is None else f"let {self.name(actor)} {act}"

    def act(self, action: clingo.Symbol) -> str:
        """An action as what whoever does it is to do: "move to the kitchen"."""
        table = self.actions.get(action.name)
        if table is None:
            return _plain(action, self)
        return self._filled(table.do or table.did, action.arguments)

    def did(self, action: clingo.Symbol) -> str:
        """An action as what was done, "moved to the kitchen", or what happened as a clause."""
        table = self.actions.get(action.name)
        if table is None:
            verb, *rest = _plain(action, self).split(" ")
            return " ".join([past_form(verb), *rest])
        return self._filled(table.did, action.arguments)

    def happened(self, action: clingo.Symbol) -> str:
        """What was done or happened as a clause: "the robot moved to the kitchen"."""
        table = self.actions.get(action.name)
        if table is None or table.do is None:
            return self.did(action)
        actor = self.actor(action) or self.robot
        return f"{self.name(actor) if actor else 'the robot'} {self.did(action)}"

    def surprise(self, surprise: Surprise) -> str:
        """What a diagnosis assumes, as a clause: "Sally was not in the kitchen at first"."""
        what, step = surprise.what, surprise.step
        perhaps = "" if surprise.certain else "perhaps "
        if surprise.kind is SurpriseKind.EXCEPTION:
            opposite = complement_of(what)
            return f"{perhaps}{self.say(opposite)}, other than usual"
        if surprise.kind is SurpriseKind.EVENT:
            return f"{perhaps}{self.did(what)} after step {step}"
        if surprise.kind is SurpriseKind.FAILURE:
            return f"{perhaps}the attempt to {self.do(what)} at step {step} failed"
        return f"{perhaps}it was seen wrongly at step {step} that {self.say(what)}"

    def _filled(self, text: str, arguments: Sequence[clingo.Symbol]) -> str:
        return _SLOT.sub(lambda slot: self.name(arguments[int(slot.group(1))]), text)


def _plain(action: clingo.Symbol, words: PlanningWords) -> str:
    about = ", ".join(map(words.name, action.arguments))
    about = f"({about})" if len(action.arguments) > 1 else about
    return " ".join(filter(None, [action.name.replace("_", " "), about]))


def in_sequence(parts: Iterable[str]) -> str:
    """Join clauses: "a, b and c".

    Examples
    --------
    >>> in_sequence(["move to the kitchen", "stop"])
    'move to the kitchen and stop'
    """
    every = list(parts)
    return " and ".join(filter(None, [", ".join(every[:-1]), *every[-1:]]))
