"""Answers about statics that are no features: whether they are so, and why or why not."""

from __future__ import annotations

from dataclasses import replace

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.asked import Asks, Question
from seewhy.dialogue.belief import believed_values, with_basis
from seewhy.dialogue.certainty import least_sure
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reply import Classification
from seewhy.dialogue.told import Told
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words, say_features, say_literal, sentence
from seewhy.knowledge.evidence import Evidence
from seewhy.knowledge.ground import key_of, literal_of
from seewhy.knowledge.justification import Node
from seewhy.knowledge.why import justify
from seewhy.knowledge.why_not import refuse

__all__ = ["tell_static"]


def tell_static(
    domain: Domain, reasoned: ReasonedAnswers, scene: Classification, question: Question, why: Node
) -> Told:
    """Answer whether a static is so, or why it is so or not.

    ``why`` is the justification of the scene's class.
    """
    belief = domain.beliefs[question.predicate or ""]
    literal = belief.literals[question.value or ""]
    evidence = (
        reasoned.evidence(scene.vector)
        if scene.label is None
        else reasoned.about(scene.vector, scene.label)
    )
    if scene.label is not None:
        class_literal = domain.classes[scene.label].literal
        why = replace(why, literal=str(literal_of(key_of(class_literal))))
    for side in (literal, literal.complement):
        if key_of(side) not in evidence.believed:
            continue
        node = justify(evidence, side)
        if node is None:
            continue
        node = with_basis(node, why)
        form = "static" if question.asks is Asks.BELIEF_IS else "static_reasons"
        kind = AnswerType(form, node.features())
        text = f"{_begun(question, so=side == literal)}{say_literal(domain, side)}"
        if question.asks is not Asks.BELIEF_IS:
            text += _because(domain, scene, node)
        return Told(kind, sentence(text), node, least_sure(kind, scene, node))
    node = refuse(evidence, literal)
    kind = AnswerType("static_unfounded", node.features())
    text = f"nothing that is known says that {say_literal(domain, literal)}"
    if question.asks is not Asks.BELIEF_IS:
        text += _not_applying(node)
    instead = _instead(domain, evidence, question)
    text += f"; {instead}" if instead else ""
    return Told(kind, sentence(text), node, least_sure(kind, scene, node))


def _begun(question: Question, *, so: bool) -> str:
    """What stands before the clause that says what is so."""
    if question.asks is Asks.BELIEF_IS:
        return "yes, " if so else "no, "
    return "" if so == (question.asks is Asks.WHY_BELIEF) else "but "


def _because(domain: Domain, scene: Classification, node: Node) -> str:
    """The features that a belief rests on, and the sentence of its axiom."""
    reasons = say_features(domain, scene.vector, node.features(), subject="it")
    since = f", since {reasons}" if reasons else ""
    rule = node.axiom
    return f'{since}: "{rule.text}"' if rule is not None and rule.has_sentence else since


def _not_applying(node: Node) -> str:
    """Which axiom is nearest, and what it misses."""
    nearest = next((child for child in node.children if child.is_refuted), None)
    missing = (
        [] if nearest is None else [child.text for child in nearest.children if not child.holds]
    )
    if nearest is None or nearest.axiom is None or not missing:
        return ""
    return f': "{nearest.axiom.text}" does not apply, since {join_words(missing)}'


def _instead(domain: Domain, evidence: Evidence, question: Question) -> str:
    """What else is believed of a static with several values."""
    belief = domain.beliefs[question.predicate or ""]
    if belief.is_yes_or_no:
        return ""
    values = believed_values(domain, evidence, belief.key)
    return join_words([say_literal(domain, belief.literals[value]) for value in values])
