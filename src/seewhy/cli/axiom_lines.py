"""How commands tell of axioms: those that are known, and those that are known no more."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.knowledge.axiom import Axiom
    from seewhy.knowledge.learned_file import Withdrawn

__all__ = ["axiom_dict", "rests", "withdrawn_dict", "withdrawn_line"]


def rests(axiom: Axiom) -> str:
    """What a learned axiom rests on."""
    origin = axiom.origin
    return f"{origin.support} {origin.things}, {percent(origin.precision)} of them rightly"


def axiom_dict(axiom: Axiom) -> dict[str, Any]:
    """An axiom as values that JSON can hold."""
    origin = axiom.origin
    return {
        "identifier": axiom.identifier,
        "statement": str(axiom),
        "text": axiom.text,
        "learned": origin.learned,
        **(
            {
                "support": origin.support,
                "precision": origin.precision,
                "pictures": list(origin.pictures),
            }
            if origin.learned
            else {}
        ),
    }


def withdrawn_dict(agent: Agent, gone: Withdrawn) -> dict[str, Any]:
    """An axiom that is known no more, as values that JSON can hold."""
    found = {"statement": gone.statement, "reason": gone.reason, "given": gone.given}
    return {**found, "identifier": _identifier(agent, gone)} if gone.given else found


def withdrawn_line(agent: Agent, gone: Withdrawn) -> str:
    """An axiom that is known no more, and why; given ones with the name to restore them by."""
    name = f" {_identifier(agent, gone)}" if gone.given else ""
    return f"{gone.fate}{name}: {gone.statement} {gone.reason}"


def _identifier(agent: Agent, gone: Withdrawn) -> str:
    axioms = agent.given.knowledge.axioms
    return next((axiom.identifier for axiom in axioms if str(axiom) == gone.statement), "")
