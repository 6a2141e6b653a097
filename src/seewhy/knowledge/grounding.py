"""A program grounded once, solved for one scene after another under assumptions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import clingo

from seewhy.knowledge.program import UNKNOWN
from seewhy.knowledge.scene import FeatureVector, SceneSchema


class Grounding:
    """clingo's ground program together with the solver literals of features and classes.

    Parameters
    ----------
    program : str
        As :func:`seewhy.knowledge.program.program_text` returns it.
    schema : SceneSchema
    arguments : sequence of str
        Options for clingo.
    """

    def __init__(self, program: str, schema: SceneSchema, *, arguments: Sequence[str] = ()) -> None:
        self.schema = schema
        self.control = clingo.Control(["--warn=none", *arguments], logger=lambda *_: None)
        self.control.add("base", [], program)
        self.control.ground([("base", [])])
        # An atom that turned out to have no rule is listed still, with the literal 0.
        self._literals = {
            str(a.symbol): a.literal for a in self.control.symbolic_atoms if a.literal
        }
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

    def configure(self, *, models: int = 0, enum_mode: str = "auto", opt_mode: str = "") -> None:
        """Set how the next calls of :meth:`solve` search."""
        solve: Any = self.control.configuration.solve
        solve.models = models
        solve.enum_mode = enum_mode
        if opt_mode:
            solve.opt_mode = opt_mode

    def with_predicate(self, name: str) -> dict[clingo.Symbol, int]:
        """Return the atoms of a predicate with their solver literals."""
        if name not in self._predicates:
            self._predicates[name] = {
                atom.symbol: atom.literal
                for atom in self.control.symbolic_atoms
                if atom.literal and atom.symbol.name == name and atom.symbol.arguments
            }
        return self._predicates[name]

    def first_model(self, assumptions: Iterable[int]) -> list[clingo.Symbol] | None:
        """Return the true atoms of the first answer set found, or None if there is none."""
        found: list[list[clingo.Symbol]] = []
        self.control.solve(
            list(assumptions), on_model=lambda model: found.append(list(model.symbols(atoms=True)))
        )
        return found[-1] if found else None

    def believed_classes(self, assumptions: Iterable[int]) -> tuple[str, ...] | None:
        """Return the classes in every answer set, or None if there is no answer set.

        The enumeration mode must be ``cautious``.
        """
        believed: list[tuple[str, ...]] = []

        def on_model(model: clingo.Model) -> None:
            is_true = model.is_true
            believed.append(tuple([name for name, literal in self.classes if is_true(literal)]))

        self.control.solve(list(assumptions), on_model=on_model)
        return believed[-1] if believed else None
