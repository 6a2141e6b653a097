"""Typing errors: what is no word becomes the nearest word of the vocabulary."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib import resources
from itertools import islice, product

from rapidfuzz import process
from rapidfuzz.distance import DamerauLevenshtein, Postfix

from seewhy.dialogue.inflection import lemma

__all__ = ["Spelling", "english_words", "first_names", "prefixed_otherwise"]

_MOST_READINGS = 64


@cache
def english_words() -> frozenset[str]:
    """Return common English words: whoever writes one of them means it.

    Examples
    --------
    >>> "suitable" in english_words(), "unstabel" in english_words()
    (True, False)
    """
    return _listed("english_words.txt")


@cache
def first_names() -> frozenset[str]:
    """Return common first names: Joan is no misspelling of John.

    Examples
    --------
    >>> "joan" in first_names(), "jhon" in first_names()
    (True, False)
    """
    return _listed("first_names.txt")


def _listed(file: str) -> frozenset[str]:
    """The words of a list beside this module."""
    text = resources.files("seewhy.dialogue").joinpath(file)
    return frozenset(text.read_text(encoding="utf-8").split())


PREFIXES = frozenset({"un", "in", "im", "ir", "non", "dis", "mis", "re", "pre", "over", "under"})
"""What stands before a word to make another of it, often its opposite."""


def prefixed_otherwise(word: str, other: str) -> bool:
    """Whether two words differ only by what stands before them.

    Examples
    --------
    >>> prefixed_otherwise("unsteady", "steady"), prefixed_otherwise("redeliver", "undeliver")
    (True, True)
    >>> prefixed_otherwise("stady", "steady")
    False
    """
    same = Postfix.similarity(word, other)
    before = {word[: len(word) - same], other[: len(other) - same]} - {""}
    return bool(before) and before <= PREFIXES


class Spelling:
    """Mends words that are neither in a vocabulary nor English.

    Examples
    --------
    >>> spelling = Spelling(["stable", "unstable", "table", "lean"])
    >>> list(spelling.readings(["suitable", "unstabel", "learn", "ustable"]))
    ['suitable unstable learn stable', 'suitable unstable learn unstable']
    >>> list(spelling.readings(["tabel's"]))
    ["table's"]
    """

    def __init__(self, vocabulary: Iterable[str]) -> None:
        self._known = frozenset(vocabulary)
        self._lemmas = frozenset(map(lemma, self._known))
        self._sorted = sorted(word for word in self._known if len(word) > 2)

    def readings(self, words: Sequence[str]) -> Iterator[str]:
        """Yield the texts that words may stand for; the words themselves where nothing is amiss."""
        # A word is not mended into one that the question has already: "is the table stable".
        spellings = [
            [found for found in self._spellings(word) if found == word or found not in words]
            or [word]
            for word in words
        ]
        for chosen in islice(product(*spellings), _MOST_READINGS):
            yield " ".join(chosen)

    def knows(self, word: str) -> bool:
        """Whether a word, or an inflection of it, is in the vocabulary."""
        return word in self._known or lemma(word) in self._lemmas

    def _spellings(self, word: str) -> list[str]:
        if len(word) < 3 or word in self._known or lemma(word) in self._lemmas:
            return [word]
        if word.endswith("'s"):
            return [f"{found}'s" for found in self._spellings(word.removesuffix("'s"))]
        if not word.isalpha():
            return [word]
        turned = sorted(_letters_turned(word) & self._known)
        if word in english_words() or word in first_names():
            # A "stop sing" is a sign where nothing is understood of what sings.
            return [word, *(turned if len(word) > 3 else ())]
        if len(word) == 3:
            return turned[:1] or [word]
        allowed = 1 if len(word) < 7 else 2
        near = [known for known in self._sorted if known[0] == word[0] or len(known) > 4]
        close = process.extract(
            word,
            # "Unsteady" is no misspelling of "steady": it says the opposite.
            [known for known in near if not prefixed_otherwise(word, known)],
            scorer=DamerauLevenshtein.distance,
            score_cutoff=allowed,
            limit=None,
        )
        least = min((distance for _, distance, _ in close), default=0)
        return [found for found, distance, _ in close if distance == least] or self._parts(word)

    def _parts(self, word: str) -> list[str]:
        """Two known words that were written as one, or the word."""
        for cut in range(3, len(word) - 2):
            if word[:cut] in self._known and word[cut:] in self._known:
                return [f"{word[:cut]} {word[cut:]}"]
        return [word]


def _letters_turned(word: str) -> set[str]:
    """Every word with two neighbouring letters in the other order."""
    return {
        word[:place] + word[place + 1] + word[place] + word[place + 2 :]
        for place in range(len(word) - 1)
    }
