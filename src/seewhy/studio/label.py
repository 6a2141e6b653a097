"""What somebody said: the value of a feature, or the class, of a picture or a thing."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Label"]


@dataclass(frozen=True)
class Label:
    """The value of a feature, or the class, of one picture; or of a feature of one thing.

    Attributes
    ----------
    value : str
    who, at : str
        By whom and when, as the record has it.
    how : str
        ``typed``, ``confirmed`` (it was proposed), ``sheet`` (many at once), ``follows`` (from the
        class), ``corrected`` (an answer was wrong), or ``table`` (it stood in a table).
    entry : int
        The number of the record's entry.
    """

    value: str
    who: str
    at: str
    how: str
    entry: int
