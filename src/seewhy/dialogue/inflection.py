"""Words without their inflection: "leaning" and "leant" are one, "is" and "was" are two."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise

import snowballstemmer

__all__ = ["ARTICLES", "forbidden", "lemma", "lemmas", "stem_of"]

ARTICLES = frozenset({"a", "an", "the", "any", "some"})
"""Words that change nothing of what is asked about a picture."""

# Auxiliaries tell the tense, and words of one syllable are no inflections of each other.
_AS_THEY_ARE = {
    "is", "are", "was", "were", "be", "been", "being", "am", "do", "did", "have",
    "had", "having", "will", "would", "can", "could", "may", "might", "must", "shall", "should",
    "this", "these", "that", "those", "it", "its", "his", "her", "i", "you", "we", "one", "ones",
    "no", "not", "nor", "none", "nothing", "as", "us", "left", "people", "sure", "mostly",
    "leaving",
}  # fmt: skip
_IRREGULAR = {
    "leant": "lean", "stood": "stand", "fell": "fall", "fallen": "fall", "gave": "give",
    "given": "give", "made": "make", "built": "build", "saw": "see", "seen": "see",
    "shown": "show", "knew": "know", "known": "know", "thought": "think", "said": "say",
    "told": "tell", "found": "find", "took": "take", "taken": "take", "bent": "bend",
    "broke": "break", "broken": "break", "meant": "mean", "kept": "keep", "held": "hold",
    "grew": "grow", "grown": "grow", "hid": "hide", "hidden": "hide", "began": "begin",
    "became": "become", "came": "come", "went": "go", "gone": "go", "goes": "go", "does": "do",
    "has": "have", "led": "lead", "brought": "bring", "felt": "feel", "lost": "lose",
    "chose": "choose",
    "chosen": "choose", "drew": "draw", "drawn": "draw", "written": "write", "wrote": "write",
    "worn": "wear", "wore": "wear", "sat": "sit", "lay": "lie", "lain": "lie", "lying": "lie",
    "torn": "tear", "persons": "person", "children": "child", "feet": "foot", "men": "man",
    "women": "woman", "building": "building", "based": "based",
}  # fmt: skip
_DERIVING = ("ful", "fully", "ness", "ist", "ists", "ism", "ery")
"""Endings that make another word of a word: what is useful need not be used."""
_SNOWBALL = lru_cache(maxsize=16_384)(snowballstemmer.stemmer("english").stemWord)


def stem_of(word: str) -> str:
    """Return the stem of a word, which is the word itself where an ending made another of it.

    Examples
    --------
    >>> stem_of("used"), stem_of("useful")
    ('use', 'useful')
    """
    return word if word.endswith(_DERIVING) else str(_SNOWBALL(word))


def lemma(word: str) -> str:
    """Return what the inflections of a word have in common.

    Examples
    --------
    >>> [lemma(word) for word in ("leaning", "leant", "blocks", "is", "was")]
    ['lean', 'lean', 'block', 'is', 'was']
    >>> lemma("stable") == lemma("stability")
    False
    """
    if word in _AS_THEY_ARE:
        return word
    if word.endswith(("ered", "ering", "ers")):
        word = word[: word.rindex("er") + 2]  # "considered" is of "consider"
    stem = stem_of(word)
    # "Narrower" compares, which "narrow" does not.
    compares = word.endswith(("er", "est")) and not stem.endswith(("er", "est"))
    return _IRREGULAR.get(word) or (word if compares else stem)


def lemmas(words: Sequence[str]) -> list[str]:
    """Return the lemmas of words; what "no" forbids stays a gerund, as in "no stopping".

    Examples
    --------
    >>> lemmas(["no", "stopping", "sign"]), lemmas(["no", "stop", "sign"])
    (['no', 'stopping', 'sign'], ['no', 'stop', 'sign'])
    """
    kept = forbidden(words)
    return [word if word in kept else lemma(word) for word in words]


def forbidden(words: Sequence[str]) -> frozenset[str]:
    """Return the gerunds behind "no": "no stopping" forbids, "no stop sign" denies.

    Examples
    --------
    >>> sorted(forbidden("is this a no overtaking sign".split()))
    ['overtaking']
    """
    return frozenset(
        word
        for before, word in pairwise(words)
        if before == "no" and word.endswith("ing") and lemma(word) != word
    )
