"""Which of a scene's features suffice for a belief: whatever the others are, it is believed.

A reason in this sense is a prime implicant under the constraints that the knowledge itself makes
(Darwiche and Hirth, "On the reasons behind decisions", ECAI 2020; Gorji and Rubin, "Sufficient
reasons for classifier decisions in the presence of domain constraints", AAAI 2022): scenes without
an answer set are none that could speak against it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import cached_property
from itertools import count

import clingo

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.grounding import Grounding
from seewhy.knowledge.grounding_size import GroundingSize
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import CONTRADICTORY, UNKNOWN, program_text, without_exceptions
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.stratified import is_stratified

_LOOKED_AT = 64
"""So many scenes with exceptions are looked at before features count as too few."""


class SufficientFeatures:
    """Tells whether features suffice for a belief, and completes those that do not.

    The program is grounded once with its features left open. Without exceptions to defaults one
    call of the solver decides: is there an answer set that shares the features and lacks the
    belief? Scenes that need exceptions are proposed by the solver and confirmed by the reasoner,
    because only the smallest sets of exceptions count; where 64 were proposed in vain, the
    features are taken to be too few, so that what is said to suffice always does.

    Parameters
    ----------
    knowledge : Knowledge
    schema : SceneSchema
    grounding : Grounding
        Of the program with exceptions to defaults.
    believed : callable
        What is believed of a scene in every preferred answer set.
    size : GroundingSize

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.knowledge.reasoner import Reasoner
    >>> domain = load_domain("structure_stability")
    >>> sufficient = Reasoner(domain.knowledge, domain.schema).sufficient
    >>> vector = domain.vector({"num_blocks": "2", "base": "wide", "lean": "no",
    ...                         "block_displaced": "no"})
    >>> stable = domain.classes["stable"].literal
    >>> sufficient.suffice(vector, ["num_blocks", "lean"], stable)
    True
    >>> sufficient.suffice(vector, ["num_blocks"], stable)
    False
    >>> sufficient.completed(vector, ["num_blocks"], stable)
    ('num_blocks', 'lean')
    """

    def __init__(
        self,
        knowledge: Knowledge,
        schema: SceneSchema,
        grounding: Grounding,
        believed: Callable[[FeatureVector], Collection[clingo.Symbol]],
        *,
        size: GroundingSize,
    ) -> None:
        self.size = size
        self.knowledge = knowledge
        self.schema = schema
        self.features = tuple(schema.features)
        self._grounding = grounding
        self._believed = believed
        self._constraints = count()

    def suffice(self, vector: FeatureVector, features: Collection[str], literal: Literal) -> bool:
        """Whether every scene that shares the values of some features has the belief.

        A value that is unknown is shared where it is unknown as well. Scenes that have no answer
        set do not count.
        """
        grounding = self._grounding
        lacks = grounding.literal(f"holds({key_of(literal)})")
        shared = grounding.assume(vector)
        fixed = [
            is_shared
            for is_shared, name in zip(shared, self.features, strict=True)
            if name in features
        ]
        none = [-atom for atom in grounding.with_predicate("exception", 2).values()]
        assumed = [grounding.strict, *fixed, *([] if lacks is None else [-lacks])]
        if grounding.satisfiable([*assumed, *none]):
            return False
        return not none or self._suffice_with_exceptions(vector, features, literal)

    def completed(
        self, vector: FeatureVector, features: Sequence[str], literal: Literal
    ) -> tuple[str, ...]:
        """Return features that suffice for a belief: those given, and others that are needed.

        None of the others can be left out. All features suffice for what is believed.
        """
        added = [name for name in self.features if name not in features]
        for name in list(added):
            fewer = [other for other in added if other != name]
            if self.suffice(vector, [*features, *fewer], literal):
                added = fewer
        return (*features, *added)

    def _suffice_with_exceptions(
        self, vector: FeatureVector, features: Collection[str], literal: Literal
    ) -> bool:
        grounding = self._restoring
        key = f"holds({key_of(literal)})"
        lacks = grounding.literal(key)
        shared = grounding.assume(vector)
        fixed = [
            is_shared
            for is_shared, name in zip(shared, self.features, strict=True)
            if name in features
        ]
        assumed = [grounding.strict, *fixed, *([] if lacks is None else [-lacks])]
        believed = clingo.parse_term(key_of(literal))
        for _ in range(_LOOKED_AT):
            symbols = grounding.first_model(assumed)
            if symbols is None:
                return True
            scene = self._scene_of(symbols)
            if believed not in self._believed(scene):
                return False
            self._rule_out(scene, key)
        return False

    def _rule_out(self, scene: FeatureVector, key: str) -> None:
        """Forbid what lacks a belief in a scene that has it: it is no preferred answer set."""
        observed = ", ".join(
            f"observed({name}, {UNKNOWN if value is None else value})"
            for name, value in zip(self.features, scene, strict=True)
        )
        part = f"constraint_{next(self._constraints)}"
        self._restoring.add(part, f":- not {key}, {observed}.")

    def _scene_of(self, symbols: Sequence[clingo.Symbol]) -> FeatureVector:
        shown = {
            str(symbol.arguments[0]): str(symbol.arguments[1])
            for symbol in symbols
            if symbol.name == "observed"
        }
        return tuple(None if shown[name] == UNKNOWN else shown[name] for name in self.features)

    @cached_property
    def _restoring(self) -> Grounding:
        """The program with exceptions, for scenes that are contradictory without.

        Beside it stands the program without exceptions, which has to come to a contradiction;
        only where absences wait for each other in circles may it have no answer set instead.
        """
        text = program_text(self.knowledge, self.schema, exceptions=True)
        if is_stratified(self.knowledge):
            text += without_exceptions(self.knowledge, self.schema)
            text += f":- not {CONTRADICTORY}.\n"
        return Grounding(text, self.schema, size=self.size.times(2))
