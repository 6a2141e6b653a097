"""Write a rule about things in the knowledge language."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, count

from seewhy.domain.things import CONCLUDED, Things
from seewhy.induction.axiom_text import SCENE
from seewhy.induction.things.conditions import (
    Alike,
    Alone,
    Atom,
    Condition,
    Grouped,
    HasValue,
    Pattern,
    Related,
    There,
    ThingRule,
)
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.scene import SceneSchema
from seewhy.knowledge.signature import Signature
from seewhy.knowledge.things import literals_about

__all__ = ["counted_condition", "thing_rule_statement"]

_THINGS = ("X", "Y", "Z")
"""Variables of an axiom's body; so many range over things, or it would have too many instances."""

_COUNTED = ("U", "V", "W")
"""Variables of what is counted, which are its own."""


def thing_rule_statement(
    rule: ThingRule, things: Things, schema: SceneSchema, signature: Signature
) -> str:
    """Return the axiom that a rule is.

    Things of which there are to be some are variables of the axiom, so that its reasons name them.
    What there is not, and what is counted, is an aggregate.

    Raises
    ------
    ValueError
        If a rule counts, or denies, things that are alone: it is not ``is_expressible``.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> schema = replace(domain.schema, classes={"good": Literal("good", ("picture",))})
    >>> ball = Pattern.of(2, [HasValue(0, "shape", "sphere"), Related(0, 1, "on")])
    >>> none = There(Pattern.of(1, [HasValue(0, "colour", "red")]), holds=False)
    >>> thing_rule_statement(ThingRule("good", (There(ball), none)), domain.things, schema,
    ...                      domain.knowledge.signature)
    'good(S) if picture(S), on(X, Y), shape(X, sphere), #count { U : colour(U, red) } = 0.'
    """
    writer = _Writer(things, schema, signature)
    head = writer.of_scene(schema.classes[rule.label])
    parts = [f"{schema.scene}({SCENE})"]
    free = list(_THINGS)
    for condition in sorted(rule.conditions, key=_first_those_alone):
        size = condition.pattern.things if isinstance(condition, There) else 0
        if not isinstance(condition, There):
            parts.append(writer.whole(condition.feature, condition.value, condition.holds))
        elif condition.holds and condition.least == 1 and size <= len(free):
            parts += writer.pattern(condition.pattern, free[:size])
            free = free[size:]
        else:
            parts.append(writer.counted(condition))
    parts += [f"not {writer.of_scene(schema.classes[other])}" for other in rule.unless]
    return f"{head} if {', '.join(parts)}."


def counted_condition(
    condition: There, things: Things, schema: SceneSchema, signature: Signature
) -> str:
    """Return what is asked as one condition of an axiom, which has no variable of its own.

    Raises
    ------
    ValueError
        As :func:`thing_rule_statement`.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> none = There(Pattern.of(1, [HasValue(0, "colour", "red")]), holds=False)
    >>> counted_condition(none, domain.things, domain.schema, domain.knowledge.signature)
    '#count { U : colour(U, red) } = 0'
    """
    return _Writer(things, schema, signature).counted(condition)


def _first_those_alone(condition: Condition) -> int:
    """What cannot be counted goes first, while there are variables for it."""
    if not isinstance(condition, There):
        return 0
    return 1 if any(isinstance(atom, Alone) for atom in condition.pattern.atoms) else 2


class _Writer:
    """Writes conditions; variables of values are told apart by numbers."""

    def __init__(self, things: Things, schema: SceneSchema, signature: Signature) -> None:
        self.things, self.schema, self.signature = things, schema, signature
        self._numbers = count(1)

    def of_scene(self, literal: Literal) -> str:
        return str(self.schema.of_any_scene(literal))

    def whole(self, feature: str, value: str, holds: bool) -> str:
        literal = self.schema.features[feature][value]
        return self.of_scene(literal if holds else literal.complement)

    def counted(self, condition: There) -> str:
        pattern = condition.pattern
        if any(isinstance(atom, Alone) for atom in pattern.atoms):
            raise ValueError("things that are alone in some way cannot be counted")
        variables = _COUNTED[: pattern.things]
        inside = ", ".join(self.pattern(pattern, variables))
        if condition.least > 1:
            bound = f"{'>=' if condition.holds else '<'} {condition.least}"
        else:
            bound = "> 0" if condition.holds else "= 0"
        return f"#count {{ {', '.join(variables)} : {inside} }} {bound}"

    def pattern(self, pattern: Pattern, variables: Sequence[str]) -> list[str]:
        """What a pattern asks of things that are called by variables."""
        parts = [
            text
            for atom in pattern.atoms
            if not isinstance(atom, Alike)
            for text in [self._atom(atom, variables)]
        ]
        parts += self._alike([atom for atom in pattern.atoms if isinstance(atom, Alike)], variables)
        bound = {thing for atom in pattern.atoms if self._binds(atom) for thing in atom.things}
        unbound = [
            f"{self.things.sort}({variable})"
            for place, variable in enumerate(variables)
            if place not in bound
        ]
        different = [
            f"{variables[first]} != {variables[second]}"
            for first, second in combinations(range(pattern.things), 2)
            if not any(self._parts(atom, first, second) for atom in pattern.atoms)
        ]
        return [*unbound, *parts, *different]

    def _binds(self, atom: Atom) -> bool:
        """Whether an atom is a literal that is believed of its things."""
        if isinstance(atom, HasValue):
            return atom.feature in self.things.features or atom.value == "yes"
        return not isinstance(atom, Alone)

    def _parts(self, atom: Atom, first: int, second: int) -> bool:
        """Whether an atom holds of different things only."""
        if {first, second} != set(atom.things):
            return False
        if isinstance(atom, Related):
            return self.things.relations[atom.relation].measure != CONCLUDED
        return isinstance(atom, Alike) and not atom.holds

    def _atom(self, atom: Atom, variables: Sequence[str]) -> str:
        named = [variables[thing] for thing in atom.things]
        match atom:
            case HasValue():
                return self._value(atom, named[0])
            case Related(relation=relation):
                return str(Literal(relation, tuple(named)))
            case Grouped(group=group):
                return str(Literal(group, tuple(named)))
            case Alone(relation=relation, inverse=inverse):
                other = f"{_COUNTED[0]}{next(self._numbers)}"
                pair = (named[0], other) if inverse else (other, named[0])
                return f"#count {{ {other} : {Literal(relation, pair)} }} = 0"
        raise TypeError(f"must be an atom of things, got {atom!r}")

    def _value(self, atom: HasValue, variable: str) -> str:
        if atom.feature not in self.things.features:
            literal = Literal(atom.feature, (variable,))
            return str(literal) if atom.value == "yes" else f"not {literal}"
        predicate = self.signature.predicates[atom.feature]
        literal = literals_about(predicate, (variable,), self.signature)[atom.value]
        return str(literal if atom.holds else literal.complement)

    def _alike(self, atoms: Sequence[Alike], variables: Sequence[str]) -> Iterator[str]:
        """Values of things as variables: the same, or different ones."""
        for feature in dict.fromkeys(atom.feature for atom in atoms):
            called: dict[int, str] = {}
            of_feature = [atom for atom in atoms if atom.feature == feature]
            for atom in of_feature:
                if atom.holds:
                    self._called_alike(atom, called)
            for atom in of_feature:
                for thing in atom.things:
                    if thing not in called:
                        called[thing] = self._variable(feature)
            for thing, value in sorted(called.items()):
                yield str(Literal(feature, (variables[thing], value)))
            yield from (
                f"{called[atom.thing]} != {called[atom.other]}"
                for atom in of_feature
                if not atom.holds
            )

    def _called_alike(self, atom: Alike, called: dict[int, str]) -> None:
        """Give the value of two things, and of those that are like them already, one variable."""
        known = {called[thing] for thing in atom.things if thing in called}
        value = min(known) if known else self._variable(atom.feature)
        called.update((thing, value) for thing, other in called.items() if other in known)
        called.update((thing, value) for thing in atom.things)

    def _variable(self, feature: str) -> str:
        """A variable of a feature's values that the axiom does not have yet."""
        return f"{feature[:1].upper()}{feature[1:].rstrip('_')}{next(self._numbers)}"
