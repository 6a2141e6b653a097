"""The nearest valid name, for errors that say what was probably meant."""

from __future__ import annotations

from collections.abc import Iterable

from rapidfuzz import fuzz, process


def nearest(name: str, names: Iterable[str], *, at_least: float = 60.0) -> str | None:
    """Return the name among ``names`` that is most like ``name``, or None where none is.

    ``at_least`` is a similarity from 0 to 100.

    Examples
    --------
    >>> nearest("num_block", ["num_blocks", "lean"])
    'num_blocks'
    >>> nearest("colour", ["num_blocks", "lean"]) is None
    True
    """
    found = process.extractOne(name, list(names), scorer=fuzz.ratio, score_cutoff=at_least)
    return None if found is None else str(found[0])


def did_you_mean(name: str, names: Iterable[str]) -> str:
    """Return a remedy: the nearest name, or the names that there are.

    Examples
    --------
    >>> did_you_mean("num_block", ["num_blocks", "lean"])
    "did you mean 'num_blocks'?"
    >>> did_you_mean("colour", ["num_blocks", "lean"])
    'it must be one of: num_blocks, lean'
    """
    known = list(names)
    close = nearest(name, known)
    if close is not None:
        return f"did you mean '{close}'?"
    if not known:
        return "there are none"
    shown = ", ".join(known[:12]) + (", …" if len(known) > 12 else "")
    return f"it must be one of: {shown}"
