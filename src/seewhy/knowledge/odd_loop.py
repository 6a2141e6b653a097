"""Axioms through which a literal needs, by ``not``, that it is not believed itself.

Such an odd loop leaves no answer set, wherever its conditions hold.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import clingo

from seewhy.knowledge.axiom import Axiom, Condition
from seewhy.knowledge.grounding import Grounding
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import program_text
from seewhy.knowledge.scene import FeatureVector, SceneSchema

__all__ = ["OddLoops", "say_odd_loop"]

_KEPT = "kept__"


class OddLoops:
    """Finds the axioms by which a scene has no answer set, contradictions apart.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.knowledge.language import read_axioms
    >>> domain = load_domain("structure_stability")
    >>> odd = "stable(S) if base(S, narrow), not stable(S)."
    >>> known = replace(domain.knowledge, axioms=read_axioms(odd, domain.knowledge.signature))
    >>> loops = OddLoops(known, domain.schema)
    >>> [str(axiom) for axiom in loops.of(domain.vector({"base": "narrow"}))]
    ['stable(S) if base(S, narrow), not stable(S).']
    >>> loops.of(domain.vector({"base": "wide"}))
    ()
    """

    def __init__(self, knowledge: Knowledge, schema: SceneSchema) -> None:
        self.axioms = knowledge.axioms
        guarded = [replace(axiom, body=(*axiom.body, _kept(axiom))) for axiom in knowledge.axioms]
        choices = "".join(f"{{ holds({_kept(axiom)}) }}.\n" for axiom in knowledge.axioms)
        text = program_text(replace(knowledge, axioms=tuple(guarded)), schema) + choices
        self.grounding = Grounding(text, schema, size=grounding_size(knowledge))
        self._literals = {
            axiom.identifier: self.grounding.literal(f"holds({_kept(axiom)})")
            for axiom in self.axioms
        }

    def of(self, vector: FeatureVector) -> tuple[Axiom, ...]:
        """Return axioms that leave no answer set together, and without any of them leave one.

        There are none where the scene has an answer set, be it a contradictory one.
        """
        needed = list(self.axioms)
        if self._has_answer_set(vector, needed):
            return ()
        for axiom in self.axioms:
            fewer = [need for need in needed if need is not axiom]
            if not self._has_answer_set(vector, fewer):
                needed = fewer
        return tuple(needed)

    def _has_answer_set(self, vector: FeatureVector, axioms: list[Axiom]) -> bool:
        kept = {axiom.identifier for axiom in axioms}
        return self.grounding.satisfiable(
            [
                *self.grounding.assume(vector),
                -self.grounding.strict,
                *(
                    literal if name in kept else -literal
                    for name, literal in self._literals.items()
                    if literal is not None
                ),
            ]
        )


def say_odd_loop(loop: Sequence[Axiom]) -> str:
    """Return what axioms that form an odd loop do, with their lines.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> say_odd_loop(read_knowledge("#static p. p if not p.").axioms)
    "'p if not p.' (line 1) needs, through 'not', that its own conclusion is not believed"
    """
    said = " and ".join(f"'{member}' (line {member.location.line})" for member in loop)
    if len(loop) == 1:
        return f"{said} needs, through 'not', that its own conclusion is not believed"
    return f"{said} need, through 'not', that what they conclude is not believed"


def _kept(axiom: Axiom) -> Condition:
    return Condition(str(clingo.Function(_KEPT, [clingo.Function(axiom.identifier)])))
