"""Values that mean yes and no."""

from __future__ import annotations

from collections.abc import Iterable

_YES = frozenset({"yes", "true", "y", "t", "1"})
_NO = frozenset({"no", "false", "n", "f", "0"})


def yes_or_no(values: Iterable[str]) -> dict[str, str] | None:
    """Return value → yes or no where that is what all values of a feature mean; None else.

    A word says so alone; letters and digits only where there are both.

    Examples
    --------
    >>> yes_or_no(["True", "false"]), yes_or_no(["1", "0"]), yes_or_no(["Yes"])
    ({'True': 'yes', 'false': 'no'}, {'1': 'yes', '0': 'no'}, {'Yes': 'yes'})
    >>> yes_or_no(["1", "0", "2"]) is None, yes_or_no(["1"]) is None
    (True, True)
    """
    plain = {value: value.casefold() for value in values}
    said = {value: "yes" if word in _YES else "no" for value, word in plain.items()}
    words = set(plain.values())
    if not words or not words <= _YES | _NO:
        return None
    both = bool(words & _YES) and bool(words & _NO)
    return said if both or any(len(word) > 1 for word in words) else None
