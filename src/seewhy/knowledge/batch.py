"""Decide many scenes at once.

Most of the time that clingo takes for a scene is the call itself, and what follows from one
assumption after the other. So the ground program is evaluated layer by layer, each rule for all
scenes together. Scenes whose answer set that does not settle, because an answer set has to choose,
are left to be solved one by one.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import clingo
import numpy as np
from numpy.typing import NDArray

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.ground_rules import GroundRules, layers_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import UNKNOWN, program_text
from seewhy.knowledge.scene import FeatureVector, SceneSchema

SCENES = 1024
"""So many scenes are evaluated together; with more, the numbers outgrow the processor's cache."""


class Outcome(NamedTuple):
    """What is believed in a scene's only answer set.

    Attributes
    ----------
    classes : tuple of str
    contradictory : bool
        Whether something is believed together with its opposite.
    """

    classes: tuple[str, ...]
    contradictory: bool


class Batch:
    """The ground program, evaluated for many scenes at once.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> batch = Batch(domain.knowledge, domain.schema)
    >>> batch.outcomes([domain.vector({"block_displaced": "yes"}), domain.vector({})])
    [Outcome(classes=('unstable',), contradictory=False), Outcome(classes=(), contradictory=False)]
    """

    def __init__(self, knowledge: Knowledge, schema: SceneSchema) -> None:
        ground = GroundRules()
        BoundedControl(
            program_text(knowledge, schema), size=grounding_size(knowledge), observer=ground
        )
        atoms = {str(symbol): atom for symbol, atom in ground.atoms.items()}
        self._observed = [
            {
                value: atoms[f"observed({feature},{UNKNOWN if value is None else value})"]
                for value in (None, *literals)
            }
            for feature, literals in schema.features.items()
        ]
        self._given = {atom for table in self._observed for atom in table.values()}
        self._classes = [
            (name, atoms[key])
            for name, literal in schema.classes.items()
            if (key := f"holds({key_of(literal)})") in atoms
        ]
        self._conflict = ground.atoms.get(clingo.Function("conflict"))
        self._layers = layers_of(ground.rules, self._given)
        named = {
            abs(literal)
            for rules in ground.rules.values()
            for rule in rules
            for literal in rule.body
        }
        self._never = named - set(ground.rules) - self._given

    def outcomes(self, vectors: Sequence[FeatureVector]) -> list[Outcome | None]:
        """Return the outcome of each scene; None where an answer set has to choose.

        Raises
        ------
        ValueError, KeyError
            If a vector does not fit the features.
        """
        all_scenes = (1 << len(vectors)) - 1
        true = dict.fromkeys(self._never | self._given, 0)
        true[0] = all_scenes
        for table, values in zip(self._observed, zip(*vectors, strict=True), strict=True):
            atoms = np.array([table[value] for value in values])
            for atom in table.values():
                true[atom] = _number(atoms == atom)
        unsettled = 0
        for layer in self._layers:
            unsettled |= layer.settle(true, all_scenes)
        conflict = 0 if self._conflict is None else true[self._conflict]
        told = [unsettled, conflict, *(true[atom] for _, atom in self._classes)]
        digits = np.stack([_digits(number, len(vectors)) for number in told], axis=1)
        # Few outcomes differ, of however many scenes.
        different, which = np.unique(digits, axis=0, return_inverse=True)
        outcomes = [self._outcome(row) for row in different.tolist()]
        return [outcomes[place] for place in which.ravel().tolist()]

    def _outcome(self, told: Sequence[int]) -> Outcome | None:
        unsettled, conflict, *believed = told
        if unsettled:
            return None
        classes = (name for (name, _), holds in zip(self._classes, believed, strict=True) if holds)
        return Outcome(tuple(classes), contradictory=bool(conflict))


def _number(digits: NDArray[np.bool_]) -> int:
    """The whole number of some binary digits, the least first."""
    return int.from_bytes(np.packbits(digits, bitorder="little").tobytes(), "little")


def _digits(number: int, count: int) -> NDArray[np.uint8]:
    """The binary digits of a whole number, the least first."""
    data = np.frombuffer(number.to_bytes((count + 7) // 8, "little"), dtype=np.uint8)
    return np.unpackbits(data, count=count, bitorder="little")
