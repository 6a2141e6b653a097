"""A program grounded once, solved for one scene after another under assumptions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple, TypeVar

import clingo

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.grounding_size import GroundingSize
from seewhy.knowledge.program import UNKNOWN
from seewhy.knowledge.scene import FeatureVector, SceneSchema

_Read = TypeVar("_Read")
_NAMED = 20
"""So many features are named in an error."""


class Search(NamedTuple):
    """How answer sets are searched for: clingo's options of these names."""

    models: int = 0
    enum_mode: str = "auto"
    opt_mode: str = "opt"


FIRST = Search(models=1)
IN_COMMON = Search(enum_mode="cautious")


class Grounding:
    """clingo's ground program together with the solver literals of features and classes.

    Parameters
    ----------
    program : str
        As :func:`seewhy.knowledge.program.program_text` returns it.
    schema : SceneSchema
    size : GroundingSize
    arguments : sequence of str
        Options for clingo.
    """

    def __init__(
        self,
        program: str,
        schema: SceneSchema,
        *,
        size: GroundingSize,
        arguments: Sequence[str] = (),
    ) -> None:
        self.schema = schema
        self._control = BoundedControl(program, size=size, arguments=arguments)
        self._search: Search | None = None
        self._predicates: dict[tuple[str, int], dict[clingo.Symbol, int]] = {}
        self._observed = {
            feature: {
                value: self._needed(f"observed({feature}, {UNKNOWN if value is None else value})")
                for value in (None, *literals)
            }
            for feature, literals in schema.features.items()
        }
        self.strict = self._needed("strict")
        self.classes = tuple(
            (name, number)
            for name, literal in schema.classes.items()
            if (number := self.literal(f"holds({key_of(literal)})")) is not None
        )

    def observed(self, feature: str, value: str | None) -> int:
        """Return the solver literal that says what value of a feature was seen."""
        return self._observed[feature][value]

    def literal(self, atom: str) -> int | None:
        """Return the solver literal of an atom; None where it can never hold."""
        # While another thread adds rules, the table of atoms is not to be read.
        with self._control.lock:
            found = self._control.atoms[clingo.parse_term(atom)]
            # An atom that turned out to have no rule is listed still, with the literal 0.
            return found.literal or None if found is not None else None

    def _needed(self, atom: str) -> int:
        found = self.literal(atom)
        assert found is not None, f"the program has no {atom}"
        return found

    def assume(self, vector: FeatureVector) -> list[int]:
        """Return the solver literals that say what the features of a scene are.

        Raises
        ------
        ValueError
            If the vector does not fit the features of the schema.
        """
        try:
            tables = self._observed.values()
            return [table[value] for table, value in zip(tables, vector, strict=True)]
        except (KeyError, ValueError):
            features = list(self.schema.features)
            more = f" and {len(features) - _NAMED} more" * (len(features) > _NAMED)
            names = ", ".join(features[:_NAMED]) + more
            raise ValueError(
                f"{vector[:_NAMED]!r} is no feature vector: it must give one known value or None "
                f"for each of {names}"
            ) from None

    def solve(
        self,
        assumptions: Iterable[int],
        search: Search,
        *,
        on_model: Callable[[clingo.Model], _Read],
    ) -> list[_Read]:
        """Return what ``on_model`` returns of each model that is found."""
        with self._control.lock:
            if search != self._search:
                solve = self._control.configuration
                solve.models, solve.enum_mode, solve.opt_mode = search
                self._search = search
            return self._control.solve(assumptions, on_model=on_model)

    def with_predicate(self, name: str, arity: int) -> dict[clingo.Symbol, int]:
        """Return the atoms of a predicate with their solver literals."""
        if (name, arity) not in self._predicates:
            with self._control.lock:
                self._predicates[name, arity] = {
                    atom.symbol: atom.literal
                    for atom in self._control.by_signature(name, arity)
                    if atom.literal
                }
        return self._predicates[name, arity]

    def satisfiable(self, assumptions: Iterable[int]) -> bool:
        """Whether there is an answer set."""
        return bool(self.solve(assumptions, FIRST, on_model=lambda _: True))

    def first_model(self, assumptions: Iterable[int]) -> list[clingo.Symbol] | None:
        """Return the true atoms of the first answer set found, or None if there is none."""
        return next(iter(self.models(assumptions, most=1)), None)

    def models(self, assumptions: Iterable[int], *, most: int) -> list[list[clingo.Symbol]]:
        """Return the true atoms that the program shows of each answer set, of at most so many."""
        return self.solve(
            assumptions,
            Search(models=most),
            on_model=lambda model: list(model.symbols(shown=True)),
        )

    def consequences(self, assumptions: Iterable[int]) -> list[clingo.Symbol] | None:
        """Return the atoms that are true in every answer set, or None if there is none."""
        found = self.solve(
            assumptions, IN_COMMON, on_model=lambda model: list(model.symbols(shown=True))
        )
        return found[-1] if found else None

    def add(self, part: str, program: str) -> None:
        """Add rules, as a part of the program that has no parameters."""
        self._control.add(part, program)

    def believed_classes(self, assumptions: Iterable[int]) -> tuple[str, ...] | None:
        """Return the classes in every answer set, or None if there is no answer set."""

        def classes(model: clingo.Model) -> tuple[str, ...]:
            is_true = model.is_true
            return tuple([name for name, literal in self.classes if is_true(literal)])

        believed = self.solve(assumptions, IN_COMMON, on_model=classes)
        return believed[-1] if believed else None
