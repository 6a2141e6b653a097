"""What each kind of axiom may speak of: which statics, fluents and actions stand where."""

from __future__ import annotations

from collections.abc import Iterable

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.signature import PredicateKind, Signature


def check_kinds(axiom: Axiom, body: Iterable[str], signature: Signature) -> None:
    """Check that predicates stand where the action language AL_d lets them stand.

    ``body`` names the predicates of the conditions, those inside aggregates included.

    Raises
    ------
    KnowledgeError
        If an action is concluded or a condition, a causal law has no action or an effect that is
        no basic fluent, or a static would change.
    """
    head = axiom.head.predicate
    kind = signature.kind(head)
    names = list(body)
    action = next((name for name in names if signature.kind(name).is_action), None)
    if action is not None:
        raise _error(
            axiom,
            f"the action '{action}' is a condition; actions stand before 'causes' or after "
            "'impossible' only",
        )
    if axiom.action is not None and not signature.kind(axiom.action.predicate).is_action:
        word = "before 'causes'" if axiom.kind is AxiomKind.CAUSAL_LAW else "after 'impossible'"
        raise _error(
            axiom,
            f"'{axiom.action.predicate}' is a {signature.kind(axiom.action.predicate).value}; "
            f"{word} stands an action, declared as '#action name(sort, sort).'",
        )
    if axiom.kind is AxiomKind.CAUSAL_LAW and kind is not PredicateKind.FLUENT_BASIC:
        raise _error(
            axiom,
            f"'{head}' is a {kind.value}; an action causes a basic fluent, declared as "
            "'#fluent basic name(sort, sort).'",
        )
    if axiom.action is None and kind.is_action:
        raise _error(
            axiom,
            f"'{head}' is an action, which no axiom concludes; write '{head}(…) causes …' or "
            f"'impossible {head}(…) if …'",
        )
    if kind is PredicateKind.FLUENT_DEFINED and not axiom.head.positive:
        raise _error(
            axiom,
            f"'{head}' is a defined fluent, which is false wherever no axiom concludes it; "
            "remove this axiom or declare it as '#fluent basic'",
        )
    if kind is PredicateKind.FLUENT_DEFINED and axiom.kind is AxiomKind.DEFAULT:
        raise _error(
            axiom,
            f"'{head}' is a defined fluent, and a default speaks of basic fluents; remove "
            "'default' or declare it as '#fluent basic'",
        )
    fluent = next((name for name in names if signature.kind(name).is_fluent), None)
    if fluent is not None and kind is PredicateKind.STATIC:
        raise _error(
            axiom,
            f"'{head}' is a static, which never changes, but is concluded from the fluent "
            f"'{fluent}'; declare '{head}' as '#fluent defined'",
        )


def _error(axiom: Axiom, text: str) -> KnowledgeError:
    return KnowledgeError(f"{axiom.location}: {text}")
