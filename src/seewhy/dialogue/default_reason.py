"""That an answer rests on what is usual: the default behind a conclusion, in words."""

from __future__ import annotations

from seewhy.dialogue.answer import AnswerType
from seewhy.domain.wording import sentence
from seewhy.knowledge.justification import Basis, Node

__all__ = ["say_usual", "usual_steps"]

_TELLS_REASONS = {
    "reasons",
    "no_reasons",
    "false_premise",
    "denied_not",
    "against",
    "contrast",
    "what_if",
    "static_reasons",
}
"""Forms that say why something is so, or is not."""


def say_usual(kind: AnswerType, justification: Node) -> str:
    """Return that what an answer tells the reasons of is usual; empty where it is more than that.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #sort apple. #static edible(apple).
    ... %% apples can be eaten
    ... default edible(A) if apple(A).
    ... ''')
    >>> node = Node("edible(apple)", "the apple is edible", Basis.DEFAULT, axiom=known.axioms[0])
    >>> print(say_usual(AnswerType("reasons"), node))  # doctest: +ELLIPSIS
    It is usual that the apple is edible: "apples can be eaten". Nothing that is known ...
    """
    if kind.form not in _TELLS_REASONS:
        return ""
    told = dict.fromkeys(map(_say_step, usual_steps(justification)))
    if not told:
        return ""
    nothing = f"nothing that is known speaks against {'it' if len(told) == 1 else 'them'}"
    return " ".join(map(sentence, (*told, nothing)))


def usual_steps(justification: Node) -> tuple[Node, ...]:
    """Return the defaults that a conclusion rests on; none where other reasons suffice for it.

    What something is refused by rests on defaults where what is believed instead does.
    """
    if justification.holds:
        return _rests_on(justification)
    for child in justification.children:
        if child.holds:
            return _rests_on(child)
    return ()


def _rests_on(node: Node) -> tuple[Node, ...]:
    below = [_rests_on(child) for child in node.children if child.holds]
    if node.basis is Basis.REASONS and not all(below):
        return ()  # one of the reasons is more than usual
    mine = (node,) if node.basis is Basis.DEFAULT else ()
    return (*mine, *(step for steps in below for step in steps))


def _say_step(step: Node) -> str:
    axiom = step.axiom
    said = f"it is usual that {step.text}"
    return f'{said}: "{axiom.text}"' if axiom is not None and axiom.has_sentence else said
