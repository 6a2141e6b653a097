"""Plain English for names that nobody has worded yet; whoever edits the domain says it better."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from importlib import resources

_ADJECTIVE_ENDINGS = ("ed", "ing", "able", "ible", "ful", "less", "ous", "ive", "ish", "ular")
_MASS_ENDINGS = ("ness", "age", "tion", "sion", "ism", "ity", "ware")
_BOOLEAN_WORDS = ("has", "have", "is", "are", "shows", "with", "contains")


def plain_words(text: str) -> str:
    """Return a name as words: underscores become blanks, and so do hyphens that part a code.

    Examples
    --------
    >>> [plain_words(text) for text in ("main_colour", "rolled-in scale", "1-red-oval", "a{b}")]
    ['main colour', 'rolled-in scale', '1 red oval', 'a(b)']
    """
    words = text.replace("_", " ")
    if " " not in text.strip() and words.count("-") > 1:
        words = words.replace("-", " ")
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z][a-z])", " ", words)
    words = words.translate(str.maketrans("{}[]", "()()"))
    return " ".join(
        "".join(character if character.isprintable() else " " for character in words).split()
    )


def in_a_sentence(text: str) -> str:
    """Return plain words with small letters where capitals only begin words.

    Examples
    --------
    >>> [in_a_sentence(text) for text in ("Main Colour", "DNA", "SHAPE")]
    ['main colour', 'DNA', 'shape']
    """
    words = plain_words(text)
    if words.isupper() and len(words) < 5:
        return words
    return words.lower()


def is_adjective(words: str) -> bool:
    """Whether one says "it is …" of a word without an article.

    Examples
    --------
    >>> [is_adjective(word) for word in ("spotted", "ripe", "thumb", "red and round")]
    [True, True, False, True]
    """
    first = re.split(r"[ -]", words.casefold())[0]
    ends_so = (
        len(first) > 4 and first.endswith(_ADJECTIVE_ENDINGS) and first not in _listed("nouns")
    )
    known = first in _listed("adjectives") or ends_so
    return known and (" " not in words or " and " in words)


def as_predicate(words: str) -> str:
    """Return what follows "it is": an adjective as it is, a noun with its article.

    Examples
    --------
    >>> [as_predicate(word) for word in ("cat", "apple", "good", "3", "stop sign", "rust", "OK")]
    ['a cat', 'an apple', 'good', '3', 'a stop sign', 'rust', 'OK']
    """
    last = words.split()[-1].casefold() if words.split() else ""
    first = words.split()[0].casefold() if words.split() else ""
    is_plural = last.endswith("s") and not last.endswith(("ss", "us", "is"))
    if (
        not first[:1].isalpha()
        or not first.isascii()
        or words.isupper()
        or first in ("a", "an", "the", "no", "not", "non", "without", "with")
        or is_adjective(words)
        or is_plural
        or last in _listed("without_article")
        or last.endswith(_MASS_ENDINGS)
    ):
        return words
    return f"{'an' if first[0] in 'aeiou' else 'a'} {words}"


def boolean_clauses(words: str) -> tuple[str, str]:
    """Return the clauses for yes and for no, with {it} for the subject.

    Examples
    --------
    >>> boolean_clauses("has spots")
    ('{it} has spots', '{it} has no spots')
    >>> boolean_clauses("ripe")
    ('{it} is ripe', '{it} is not ripe')
    >>> boolean_clauses("thumb")
    ('{it} shows thumb', '{it} shows no thumb')
    """
    first, _, rest = words.partition(" ")
    if rest and first.casefold() in _BOOLEAN_WORDS:
        if first.casefold() in ("is", "are"):
            return (f"{{it}} is {rest}", f"{{it}} is not {rest}")
        verb = {"have": "has", "with": "has"}.get(first.casefold(), first.casefold())
        return (f"{{it}} {verb} {rest}", f"{{it}} {verb} no {rest}")
    if is_adjective(words):
        return (f"{{it}} is {words}", f"{{it}} is not {words}")
    return (f"{{it}} shows {words}", f"{{it}} shows no {words}")


def boolean_changes(words: str) -> tuple[str, str]:
    """Return what would have to be done to make a yes-or-no feature hold, and not hold.

    Examples
    --------
    >>> boolean_changes("has spots"), boolean_changes("ripe")
    (('let it have spots', 'let it have no spots'), ('let it be ripe', 'let it not be ripe'))
    """
    yes, no = (clause.removeprefix("{it} ") for clause in boolean_clauses(words))
    bare = {"is not ": "not be ", "is ": "be ", "has ": "have "}
    changes = []
    for clause in (yes, no):
        start = next((form for form in bare if clause.startswith(form)), None)
        if start is not None:
            changes.append(f"let it {bare[start]}{clause[len(start) :]}")
        else:
            verb, _, rest = clause.partition(" ")
            changes.append(f"let it {verb.removesuffix('s')} {rest}")
    return (changes[0], changes[1])


def boolean_questions(words: str) -> tuple[str, ...]:
    """Return the ways to ask whether a yes-or-no feature holds.

    Examples
    --------
    >>> boolean_questions("ripe")
    ('is {it} ripe', 'is it ripe')
    """
    first, _, rest = words.partition(" ")
    bare = rest if rest and first.casefold() in _BOOLEAN_WORDS else words
    if is_adjective(words) or first.casefold() in ("is", "are"):
        return (f"is {{it}} {bare}", f"is it {bare}")
    return (
        f"does {{it}} show {bare}",
        f"does {{it}} have {bare}",
        f"is there {bare}",
        f"can you see {bare}",
    )


def look_clause(words: str) -> str:
    """Return the clause that a picture looks like one of a class.

    Examples
    --------
    >>> look_clause("cat"), look_clause("good")
    ('{it} looks like a cat', '{it} looks good')
    """
    said = as_predicate(words)
    return f"{{it}} looks {said}" if is_adjective(words) else f"{{it}} looks like {said}"


@cache
def _listed(kind: str) -> frozenset[str]:
    """The words of words.toml that are of a kind."""
    text = resources.files("seewhy.new_domain").joinpath("words.toml").read_text(encoding="utf-8")
    return frozenset(tomllib.loads(text)[kind].split())
