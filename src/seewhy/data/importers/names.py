"""Names that a domain's files can hold, made of the words that people use."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterable

LONGEST_NAME = 80

_NUMBER = re.compile(r"0|-?[1-9][0-9]{0,8}")
_SIGNS = {"+": " plus ", "&": " and ", "%": " percent ", "<": " below ", ">": " above "}
_WORDS_OF_THE_LANGUAGE = frozenset({"not", "if", "causes", "default", "impossible"})


def valid_name(text: str) -> str:
    """Return a name that knowledge.al can hold: a small letter first, or a whole number.

    A name that begins with a digit and is no number gets an ``n`` in front.

    Examples
    --------
    >>> valid_name("2 Green Ovals!")
    'n2_green_ovals'
    >>> [valid_name(text) for text in ("< 5", "5-10", "> 10", "grade A+", "grade A-")]
    ['below_5', 'n5_10', 'above_10', 'grade_a_plus', 'grade_a_minus']
    >>> [valid_name(text) for text in ("Pomme d'été", "rolledInScale", "7.0", "007", "not", "猫")]
    ['pomme_d_ete', 'rolled_in_scale', '7', 'n007', 'not_', 'unnamed']
    """
    stripped = _whole(text.strip())
    if _NUMBER.fullmatch(stripped):
        return stripped
    apart = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", re.sub("-$", " minus", stripped))
    for sign, word in _SIGNS.items():
        apart = apart.replace(sign, word)
    plain = unicodedata.normalize("NFKD", apart.casefold())
    name = re.sub(
        r"[^a-z0-9]+",
        "_",
        "".join(character for character in plain if not unicodedata.combining(character)),
    )
    name = name.strip("_")[:LONGEST_NAME].rstrip("_") or "unnamed"
    if name[0].isdigit():
        return f"n{name}"
    return f"{name}_" if name in _WORDS_OF_THE_LANGUAGE else name


def predicate_name(text: str) -> str:
    """Return a name for a feature, which is never a number.

    Examples
    --------
    >>> [predicate_name(text) for text in ("Main colour", "2", "-3")]
    ['main_colour', 'n2', 'n_3']
    """
    name = valid_name(text)
    return f"n{name.replace('-', '_')}" if _NUMBER.fullmatch(name) else name


def same_words(text: str) -> str:
    """Return what two spellings share that mean the same: case and punctuation do not count.

    Examples
    --------
    >>> same_words(" Rolled-in Scale!") == same_words("rolled_in  scale")
    True
    >>> same_words("grade A+") == same_words("grade A-")
    False
    """
    apart = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", _whole(text.strip()))
    if apart[-1:] == "-":
        apart = f"{apart[:-1]} minus"
    return " ".join(re.split(r"[\s_\-!?.,;:'\"()\[\]/\\]+", apart.casefold())).strip()


def distinct_names(
    texts: Iterable[str], *, taken: Collection[str] = (), predicates: bool = False
) -> dict[str, str]:
    """Return text → name; texts that mean the same share one, others never do.

    Parameters
    ----------
    texts : iterable of str
        The words as they stand in a source, in the order in which they are to be named.
    taken : collection of str
        Names that are given away already.
    predicates : bool
        Whether they are to name features.

    Examples
    --------
    >>> distinct_names(["No. 1", "no 1", "n° 1", "class"], taken=["class"])
    {'No. 1': 'no_1', 'no 1': 'no_1', 'n° 1': 'n_1', 'class': 'class_2'}
    """
    name_of = predicate_name if predicates else valid_name
    names: dict[str, str] = {}
    meanings: dict[str, str] = {}
    used = set(taken)
    for text in texts:
        meaning = same_words(text)
        if meaning not in meanings:
            first = name_of(text)
            name, number = first, 2
            while name in used:
                name, number = f"{first}_{number}", number + 1
            # A number that is given away already becomes a name: 7, and the "7" of another kind.
            name = name if name == first else valid_name(name)
            used.add(name)
            meanings[meaning] = name
        names[text] = meanings[meaning]
    return names


def _whole(text: str) -> str:
    """A whole number without its decimals, as tables of numbers with gaps have them: 7.0 is 7."""
    return re.sub(r"(?<=\d)\.0+$", "", text) if re.fullmatch(r"-?\d+\.0+", text) else text
