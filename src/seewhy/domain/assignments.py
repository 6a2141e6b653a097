"""Values that somebody writes as FEATURE=VALUE."""

from __future__ import annotations

from collections.abc import Sequence

from seewhy.domain.domain import Domain
from seewhy.errors import DomainError
from seewhy.text.nearest import did_you_mean

__all__ = ["named_values"]


def named_values(domain: Domain, assignments: Sequence[str]) -> dict[str, str]:
    """Return feature → value of assignments such as ``colour=brown``.

    Raises
    ------
    DomainError
        If one is none, names no feature or value, or a feature that another names as well.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> named_values(load_domain("structure_stability"), ["base=wide", "lean=no"])
    {'base': 'wide', 'lean': 'no'}
    """
    found: dict[str, str] = {}
    for assignment in assignments:
        name, sign, value = assignment.partition("=")
        name, value = name.strip(), value.strip()
        if not sign:
            raise DomainError(
                f"'{assignment}' gives no value; write FEATURE=VALUE, as in "
                f"{next(iter(domain.features))}={next(iter(domain.features.values())).values[0]}"
            )
        if name not in domain.features:
            raise DomainError(
                f"'{name}' is no feature of {domain.name}; {did_you_mean(name, domain.features)}"
            )
        values = domain.features[name].values
        if value not in values:
            raise DomainError(f"'{value}' is no value of '{name}'; {did_you_mean(value, values)}")
        if found.setdefault(name, value) != value:
            raise DomainError(f"'{name}' is given twice, {found[name]} and {value}; leave one out")
    return found
