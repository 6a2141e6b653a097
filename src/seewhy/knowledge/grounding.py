"""A program grounded once, solved for one scene after another under assumptions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple, TypeVar

import clingo

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.grounding_size import GroundingSize
from seewhy.knowledge.program import UNKNOWN
from seewhy.knowledge.scene import FeatureVector, SceneSchema

_Read = TypeVar("_Read")


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
        # An atom that turned out to have no rule is listed still, with the literal 0.
        self._literals = {str(a.symbol): a.literal for a in self._control.atoms if a.literal}
        self._predicates: dict[str, dict[clingo.Symbol, int]] = {}
        self._observed = tuple(
            {
                None: self._literals[f"observed({feature},{UNKNOWN})"],
                **{v: self._literals[f"observed({feature},{v})"] for v in literals},
            }
            for feature, literals in schema.features.items()
        )
        self.strict = self._literals["strict"]
        self.classes = tuple(
            (name, self._literals[atom])
            for name, literal in schema.classes.items()
            if (atom := f"holds({literal})".replace(", ", ",")) in self._literals
        )

    def assume(self, vector: FeatureVector) -> list[int]:
        """Return the solver literals that say what the features of a scene are.

        Raises
        ------
        ValueError
            If the vector does not fit the features of the schema.
        """
        try:
            return [table[value] for table, value in zip(self._observed, vector, strict=True)]
        except (KeyError, ValueError):
            names = ", ".join(self.schema.features)
            raise ValueError(
                f"{vector!r} is no feature vector: it must give one known value or None "
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

    def with_predicate(self, name: str) -> dict[clingo.Symbol, int]:
        """Return the atoms of a predicate with their solver literals."""
        if name not in self._predicates:
            self._predicates[name] = {
                atom.symbol: atom.literal
                for atom in self._control.atoms
                if atom.literal and atom.symbol.name == name and atom.symbol.arguments
            }
        return self._predicates[name]

    def first_model(self, assumptions: Iterable[int]) -> list[clingo.Symbol] | None:
        """Return the true atoms of the first answer set found, or None if there is none."""
        found = self.solve(
            assumptions, FIRST, on_model=lambda model: list(model.symbols(atoms=True))
        )
        return found[-1] if found else None

    def believed_classes(self, assumptions: Iterable[int]) -> tuple[str, ...] | None:
        """Return the classes in every answer set, or None if there is no answer set."""

        def classes(model: clingo.Model) -> tuple[str, ...]:
            is_true = model.is_true
            return tuple([name for name, literal in self.classes if is_true(literal)])

        believed = self.solve(assumptions, IN_COMMON, on_model=classes)
        return believed[-1] if believed else None
