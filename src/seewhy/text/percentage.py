"""Shares as percentages."""

from __future__ import annotations

__all__ = ["percent"]


def percent(share: float) -> str:
    """Return a share as a percentage with one decimal.

    Examples
    --------
    >>> percent(0.9312)
    '93.1 %'
    """
    return f"{100 * share:.1f} %"
