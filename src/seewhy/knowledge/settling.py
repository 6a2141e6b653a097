"""Which literals settle a condition that speaks of several: an aggregate, ``p : q``, ``not not``.

Such a condition is a Boolean function of literals. Some of them settle it where it is the same
whatever the others are; of these sets a smallest by inclusion is looked for.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property

import clingo

from seewhy.knowledge.axiom import denied_in, predicates_in
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.grounding_size import GroundingSize
from seewhy.knowledge.program import held, sort_facts
from seewhy.knowledge.scene import SceneSchema
from seewhy.knowledge.signature import Signature

_LOOKED_AT = 64
"""Of more literals that settle a condition together, no more are tried to be left out."""


class JointCondition:
    """A condition without free variables that speaks of several literals, or doubly denies one.

    Parameters
    ----------
    text : str
    signature : Signature
    schema : SceneSchema
    literals : mapping
        Predicate → the literals that some scene could have.
    size : GroundingSize
        What the knowledge may come to.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.knowledge.reasoner import Reasoner
    >>> domain = load_domain("structure_stability")
    >>> possible = Reasoner(domain.knowledge, domain.schema).possible
    >>> condition = JointCondition("#count { N : num_blocks(structure, N) } > 0",
    ...                            possible.signature, domain.schema, possible.literals,
    ...                            size=possible.size)
    >>> known = {key: key == "num_blocks(structure,3)" for key in condition.keys}
    >>> condition.holds({"num_blocks(structure,3)"})
    True
    >>> condition.settled_by(known, True)
    {'num_blocks(structure,3)': True}
    >>> condition.settled_by(known, False) is None
    True
    """

    def __init__(
        self,
        text: str,
        signature: Signature,
        schema: SceneSchema,
        literals: Mapping[str, tuple[clingo.Symbol, ...]],
        *,
        size: GroundingSize,
    ) -> None:
        self.size = size
        self.text = text
        self.signature = signature
        self.schema = schema
        self._possible = literals
        self._found: dict[tuple[bool, tuple[tuple[str, bool], ...]], dict[str, bool] | None] = {}

    @cached_property
    def _control(self) -> BoundedControl:
        signs = {}
        for name in sorted(predicates_in(self.text) - self.signature.given_sorts):
            for symbol in self._possible.get(name, ()):
                signs[str(symbol)] = symbol
        lines = list(sort_facts(self.signature, self.schema, scenes=(self.schema.scene,)))
        lines += [f"{{ holds({key}) }}." for key in signs]
        lines.append(f"condition__ :- {held(self.text, self.signature)}.")
        return BoundedControl("\n".join(lines), size=self.size)

    @cached_property
    def _literals(self) -> dict[str, int]:
        return {
            str(atom.symbol.arguments[0]): atom.literal
            for atom in self._control.by_signature("holds", 1)
        }

    @cached_property
    def _condition(self) -> int:
        """The solver literal of the condition; 0 where it never holds."""
        for atom in self._control.by_signature("condition__", 0):
            return int(atom.literal)
        return 0

    @property
    def keys(self) -> tuple[str, ...]:
        """The literals that it may depend on, as clingo prints them."""
        return tuple(self._literals)

    @cached_property
    def denied(self) -> frozenset[str]:
        """The literals of predicates that stand behind a ``not`` in it."""
        names = denied_in(self.text)
        return frozenset(str(symbol) for name in names for symbol in self._possible.get(name, ()))

    def holds(self, believed: Collection[str]) -> bool:
        """Whether the condition holds where these literals are believed and no others."""
        return self._is_settled({key: key in believed for key in self.keys}.items(), True)

    def settled_by(self, known: Mapping[str, bool], holds: bool) -> dict[str, bool] | None:
        """Return literals that settle that the condition holds, or that it does not.

        None of those returned can be left out (of more than 64, of the 64 that are told most
        readily). Of several such sets it is the one that is left where the first literals are left
        out first.

        Parameters
        ----------
        known : mapping
            Literal → whether it is believed. Nothing is known of the others.
        holds : bool

        Returns
        -------
        mapping or None
            Some of what is known; None where all of it settles nothing.
        """
        relevant = tuple((key, known[key]) for key in known if key in self._literals)
        place = (holds, relevant)
        if place not in self._found:
            self._found[place] = self._least(relevant, holds)
        return self._found[place]

    def _least(self, known: tuple[tuple[str, bool], ...], holds: bool) -> dict[str, bool] | None:
        if not self._is_settled(known, holds):
            return None
        needed = dict(known)
        together = len(needed)
        while together > 1 and len(needed) > _LOOKED_AT:
            together = (together + 1) // 2
            for parts in _parts(tuple(needed), together):
                needed = self._without(needed, parts, holds)
        for key in tuple(needed)[-_LOOKED_AT:]:
            needed = self._without(needed, (key,), holds)
        return needed

    def _without(
        self, needed: dict[str, bool], left_out: Sequence[str], holds: bool
    ) -> dict[str, bool]:
        """What is needed without some literals, if it settles it still."""
        fewer = {key: value for key, value in needed.items() if key not in left_out}
        return fewer if self._is_settled(fewer.items(), holds) else needed

    def _is_settled(self, known: Iterable[tuple[str, bool]], holds: bool) -> bool:
        if not self._condition:
            return not holds
        return not self._control.satisfiable(self._otherwise(known, holds))

    def _otherwise(self, known: Iterable[tuple[str, bool]], holds: bool) -> list[int]:
        """Assumptions that say what is known, and that it is otherwise with the condition."""
        said = [self._literals[key] if value else -self._literals[key] for key, value in known]
        return [*said, -self._condition if holds else self._condition]


def _parts(keys: Sequence[str], size: int) -> Iterator[Sequence[str]]:
    for start in range(0, len(keys), size):
        yield keys[start : start + size]
