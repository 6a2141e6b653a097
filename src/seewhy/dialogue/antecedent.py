"""What an answer to "what if …?" supposes, which is not what is seen."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_clauses

if TYPE_CHECKING:
    from seewhy.dialogue.answer import AnswerType

__all__ = ["say_denied", "say_values", "supposed_values"]


def supposed_values(kind: AnswerType) -> dict[str, str]:
    """Return feature → value of what an answer supposes; empty where it supposes nothing.

    Examples
    --------
    >>> from seewhy.dialogue.answer import AnswerType
    >>> supposed_values(AnswerType("what_if", ("base",), ((("base", "wide"),),)))
    {'base': 'wide'}
    """
    return dict(kind.changes[0]) if kind.form == "what_if" and kind.changes else {}


def say_values(domain: Domain, values: Mapping[str, str]) -> str:
    """Return clauses that say values of features, in the order of the domain.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> say_values(load_domain("structure_stability"), {"lean": "yes", "base": "wide"})
    'the structure has a wide base, and it leans to one side'
    """
    clauses = [domain.features[key].say[values[key]] for key in domain.features if key in values]
    return join_clauses(clauses, subject=domain.subject)


def say_denied(domain: Domain, feature: str, value: str, *, given: bool = False) -> str:
    """Return a clause that says that a feature does not have a value.

    ``given`` says that the subject was just named.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> say_denied(load_domain("traffic_signs"), "shape", "circle")
    'the sign is not round'
    """
    clause = domain.features[feature].say[value]
    subject = "it" if given else domain.subject
    if clause.startswith("{it} is "):
        return f"{subject} is not {clause.removeprefix('{it} is ')}"
    return f"it is not so that {clause.replace('{it}', subject)}"
