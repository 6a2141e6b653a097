"""What was done, as a page says it."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Done"]


@dataclass(frozen=True)
class Done:
    """What was done, in words, and the number of the entry by which it can be taken back."""

    said: str
    number: int | None
