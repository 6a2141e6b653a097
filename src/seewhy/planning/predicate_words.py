"""The clause that a predicate's name makes where a folder has no words for it."""

from __future__ import annotations

__all__ = ["PREPOSITIONS", "base_form", "named_clause"]

PREPOSITIONS = frozenset({"in", "at", "on", "under", "behind", "near", "inside", "beside", "to",
                          "of", "with", "by", "from", "for", "above", "below", "over", "into",
                          "between", "through", "against"})  # fmt: skip
_NO_VERBS = ("ss", "us", "is", "ous")


def named_clause(name: str, arity: int) -> tuple[str, str]:
    """Return the clauses that say that a predicate holds, and that it does not.

    A name is read as a verb where it begins with one of the third person, else as what something
    is, or, of two things, as a relation where it ends with a preposition and as a noun where not.

    Examples
    --------
    >>> named_clause("works_in", 2)
    ('{0} works in {1}', '{0} does not work in {1}')
    >>> named_clause("next_to", 2)[0], named_clause("colour", 2)[0], named_clause("closed", 1)[0]
    ('{0} is next to {1}', 'the colour of {0} is {1}', '{0} is closed')
    """
    words = name.split("_")
    said = " ".join(words)
    rest = [f"{{{number}}}" for number in range(1, arity)]
    if words[0] == "is" and len(words) > 1:
        return _is("{0}" if arity else "it", words[1:] + rest)
    if arity and _is_verb(words[0]):
        verb = " ".join(["{0}", *words, *rest])
        return verb, " ".join(["{0} does not", base_form(words[0]), *words[1:], *rest])
    if arity == 1 and words[-1] in PREPOSITIONS:
        return _is(" ".join(words[:-1]) or "it", [words[-1], "{0}"])
    if arity == 2 and words[-1] not in PREPOSITIONS:
        return _is(f"the {said} of {{0}}", rest)
    return _is("{0}" if arity else "it", [*words, *rest])


def base_form(verb: str) -> str:
    """Return a regular verb of the third person without its ending.

    Examples
    --------
    >>> base_form("holds"), base_form("carries"), base_form("reaches"), base_form("moved")
    ('hold', 'carry', 'reach', 'moved')
    >>> base_form("has")
    'have'
    """
    if verb == "has":
        return "have"
    if verb.endswith("ies"):
        return f"{verb[:-3]}y"
    if verb.endswith(("sses", "ches", "shes", "xes", "oes")):
        return verb[:-2]
    return verb[:-1] if verb.endswith("s") and not verb.endswith("ss") else verb


def _is(subject: str, words: list[str]) -> tuple[str, str]:
    predicate = " ".join(words)
    return f"{subject} is {predicate}", f"{subject} is not {predicate}"


def _is_verb(word: str) -> bool:
    return word.endswith("s") and len(word) > 2 and not word.endswith(_NO_VERBS)
