"""Numbers as words."""

from __future__ import annotations

__all__ = ["NUMBERS", "number_word"]

NUMBERS = (
    "zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
    "eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen",
    "nineteen", "twenty",
)  # fmt: skip


def number_word(number: int) -> str:
    """Return a number as a word, where it has one.

    Examples
    --------
    >>> number_word(3), number_word(144)
    ('three', '144')
    """
    return NUMBERS[number] if 0 <= number < len(NUMBERS) else str(number)
