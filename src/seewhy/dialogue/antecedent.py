"""What an answer to "what if …?" supposes, which is not what is seen."""

from __future__ import annotations

from collections.abc import Mapping

from seewhy.dialogue.answer import AnswerType
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_clauses

__all__ = ["say_values", "supposed_values"]


def supposed_values(kind: AnswerType) -> dict[str, str]:
    """Return feature → value of what an answer supposes; empty where it supposes nothing.

    Examples
    --------
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
