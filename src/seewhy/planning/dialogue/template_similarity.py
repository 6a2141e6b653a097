"""Whether the words of a question are near enough to a template's to ask the same."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache

from rapidfuzz import fuzz

from seewhy.dialogue.inflection import lemma
from seewhy.dialogue.spelling import english_words, prefixed_otherwise
from seewhy.planning.dialogue.query import Asks
from seewhy.planning.dialogue.question_templates import HOLE

_ALIKE = 80.0
_ALIKE_ACTION = 68.0
"""An action may be called by another verb of the same meaning: to go is to move."""
TELLING = frozenset({"why", "what", "where", "who", "if", "not", "no", "how", "which"})
"""Words of which a question has as many as its template."""
_FREE = {"is", "does", "do", "did", "has", "have", "in", "at", "on", "of", "for", "to", "with",
         "by", "that", "it", "there", "you", "your", "would", "will", "happen", "up",
         HOLE} | TELLING  # fmt: skip
_PREPOSITIONS = (
    {"in", "at"}, {"to", "into"}, {"on", "onto"}, {"of"}, {"for"}, {"with"}, {"by"}, {"up"},
)  # fmt: skip
"""Prepositions, together where one may stand for the other: on the shelf is not in it."""
_COMING = frozenset({"will", "would"})
VERBS = (
    {"move", "go", "walk", "drive", "travel", "head", "come", "run", "enter"},
    {"moving", "going", "walking", "driving", "travelling", "heading", "coming", "running",
     "entering"},
    {"moved", "gone", "went", "walked", "driven", "travelled", "come", "run", "entered"},
    {"deliver", "bring", "give", "hand", "take", "carry"},
    {"delivering", "bringing", "giving", "handing", "taking", "carrying"},
    {"delivered", "brought", "gave", "given", "handed", "taken", "carried"},
    {"put", "place", "set", "lay", "stack", "drop"},
    {"putting", "placing", "setting", "laying", "stacking", "dropping"},
    {"put", "placed", "set", "laid", "stacked", "dropped"},
    {"pick", "take", "grab", "grasp", "lift", "raise"},
    {"picking", "taking", "grabbing", "grasping", "lifting", "raising"},
    {"picked", "taken", "grabbed", "grasped", "lifted", "raised"},
)  # fmt: skip
"""Verbs that may stand for one another where an action is asked about; no other verb may."""
_ACTIONS = (Asks.WHY_DID, Asks.WHY_NOT, Asks.DID)


def likeness(asks: Asks, read: Sequence[str], skeleton: Sequence[str]) -> float | None:
    """Return how alike a question's words are to a template's, from 0 to 100.

    None where they do not ask the same.

    Examples
    --------
    >>> asked = ["why", "did", "you", "go", "to", "§"]
    >>> likeness(Asks.WHY_DID, asked, ["why", "did", "you", "move", "to", "§"]) > 68
    True
    >>> likeness(Asks.WHY_DID, asked, ["why", "did", "you", "not", "go", "to", "§"]) is None
    True
    """
    if telling_words(read) != telling_words(skeleton):
        return None
    # "What do you do if …?" asks what you would do.
    if _is_ahead(read) != _is_ahead(skeleton) and (asks is not Asks.WHAT_IF or _is_ahead(read)):
        return None
    if not _same_prepositions(read, skeleton):
        return None
    alike = fuzz.ratio(" ".join(read), " ".join(skeleton))
    return alike if _near_enough(asks, read, skeleton, alike) else None


def _is_ahead(words: Sequence[str]) -> bool:
    """Whether it is asked of what will be, or would be."""
    return not _COMING.isdisjoint(words)


def _same_prepositions(read: Sequence[str], skeleton: Sequence[str]) -> bool:
    """Whether a question has no preposition but those of the template, or one like them."""
    return all(
        sum(word in alike for word in read) <= sum(word in alike for word in skeleton)
        for alike in _PREPOSITIONS
    )


def telling_words(words: Sequence[str]) -> list[str]:
    """Return the words of a question without which it asks something else, sorted."""
    return sorted(word for word in words if word in TELLING)


def _near_enough(asks: Asks, read: Sequence[str], skeleton: Sequence[str], alike: float) -> bool:
    if asks is Asks.DID and read[:2] != skeleton[:2]:
        return False
    # A word that the other side lacks may say the opposite: to lose is not to have.
    lacking = [*_lacking(read, skeleton), *_lacking(skeleton, read)]
    if asks in _ACTIONS:
        enough = (alike >= _ALIKE_ACTION and HOLE in read) or alike >= _ALIKE
        return enough and all(
            any(word in verbs and verbs.intersection(other) for verbs in VERBS)
            for word, other in lacking
        )
    return alike >= _ALIKE and not lacking


def _lacking(words: Sequence[str], others: Sequence[str]) -> Iterator[tuple[str, Sequence[str]]]:
    """The words that carry meaning and are none of the others, with the others."""
    for word in words:
        if word not in _FREE and not any(_same_word(word, other) for other in others):
            yield word, others


@lru_cache(maxsize=16_384)
def _same_word(word: str, other: str) -> bool:
    """Whether two words are forms of one, or one is mistyped.

    "Unusual" says the opposite of "usual", and whoever asks what was painted asks not what was
    printed.
    """
    if lemma(word) == lemma(other):
        return True
    if prefixed_otherwise(word, other) or {word, other} <= english_words():
        return False
    return fuzz.ratio(word, other) >= _ALIKE
