"""What a person says to an answer: that it is wrong and why, or yes or no to a proposal."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from importlib import resources

from seewhy.dialogue.asked import Statement
from seewhy.dialogue.grammar import Chart, Form, Grammar, parse_form
from seewhy.dialogue.inflection import lemma
from seewhy.dialogue.question import Questions
from seewhy.dialogue.question_words import words_of
from seewhy.errors import QuestionError
from seewhy.induction.candidate import Candidate
from seewhy.revision.new_rule import reason_given, stated

__all__ = ["Remark", "Says", "plain_remark", "remark_of", "says_wrong"]

_NO = re.compile(r"^\s*(?:no|nope|wrong|but)\b[\s,;:.!–-]*", re.IGNORECASE)
_NO_AT_ONCE = re.compile(r"^\s*(?:no|nope|wrong|but)\s*[,;:.!–-]", re.IGNORECASE)
_ASKS = {
    "is", "are", "was", "were", "does", "do", "did", "has", "have", "can", "could", "would", "will",
    "should", "why", "what", "which", "where", "who", "when", "how", "if", "and", "or", "please",
    "tell", "show", "explain", "describe",
}  # fmt: skip
"""Words that a question or a request begins with."""

_SUBJECTS = {
    "it", "this", "that", "these", "those", "they", "its", "there", "the", "a", "an", "he", "she",
}  # fmt: skip
_PLACES = {"first": 1, "second": 2, "third": 3, "fourth": 4, "fifth": 5, "last": -1} | {
    name: number for number, name in enumerate(("one", "two", "three", "four", "five"), start=1)
}
_CHOICE = re.compile(
    r"(?:yes |take |please |do )*(?:the )?(?:number )?"
    r"(?:(\d+)(?:st|nd|rd|th)?|(\w+))(?: one| proposal)?$"
)
_NUMBERED = re.compile(r"(?:please )?(?:undo|revert|take back)(?: the)? revision (\d+)$")


class Says(StrEnum):
    """What a remark says."""

    WRONG = "wrong"
    RULE_WRONG = "rule_wrong"
    MISSING = "missing"
    OTHERWISE = "otherwise"
    BECAUSE = "because"
    TAKE_BACK = "take_back"
    AGREE = "agree"
    REFUSE = "refuse"
    CHOOSE = "choose"


@dataclass(frozen=True)
class Remark:
    """A remark that was understood.

    Attributes
    ----------
    says : Says
    statements : tuple of Statement
        For OTHERWISE: what the picture shows or is.
    reason : Candidate or None
        For BECAUSE: the rule that is stated.
    number : int or None
        For CHOOSE, the place of the proposal (-1: the last); for TAKE_BACK, the revision's
        number, None for the last.
    """

    says: Says
    statements: tuple[Statement, ...] = ()
    reason: Candidate | None = None
    number: int | None = None


def remark_of(questions: Questions, text: str, *, proposed: int = 0) -> Remark | None:
    """Return what a text says to an answer; None where it asks something.

    Parameters
    ----------
    questions : Questions
        Of the domain, whose words it is said in.
    text : str
    proposed : int, default 0
        How many proposals wait for a yes or a no.

    Raises
    ------
    QuestionError
        If the text says that something is otherwise, or why, and that is not understood.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> questions = Questions(load_domain("structure_stability"))
    >>> remark_of(questions, "No, that's wrong!").says.value
    'wrong'
    >>> [str(said) for said in remark_of(questions, "no, it is stable").statements]
    ['class=stable']
    >>> remark_of(questions, "it is unstable because it leans").reason.label
    'unstable'
    >>> remark_of(questions, "no, is it stable?") is None
    True
    """
    plain = plain_remark(text, proposed=proposed)
    if plain is not None:
        return plain
    if not words_of(text) or text.rstrip().endswith("?"):
        return None
    rest = _NO.sub("", text, count=1)
    told = words_of(rest)
    if not told or told[0] in _ASKS:
        return None
    if "because" in told[1:]:
        return Remark(Says.BECAUSE, reason=reason_given(questions, " ".join(told)))
    if rest == text or not (_NO_AT_ONCE.match(text) or told[0] in _SUBJECTS):
        return None
    try:
        return Remark(Says.OTHERWISE, stated(questions, rest))
    except QuestionError:
        if _NO_AT_ONCE.match(text):
            raise
        return None


def plain_remark(text: str, *, proposed: int = 0) -> Remark | None:
    """Return what a text says that names nothing of the domain: that something is wrong, yes, no.

    ``proposed`` is as for :func:`remark_of`.

    Raises
    ------
    QuestionError
        If a proposal is chosen that there is not.

    Examples
    --------
    >>> plain_remark("the rule is wrong").says.value, plain_remark("undo revision 3").number
    ('rule_wrong', 3)
    >>> plain_remark("the second one", proposed=2).number
    2
    """
    words = tuple(words_of(text))
    if not words or text.rstrip().endswith("?"):
        return None
    if proposed:
        answered = _to_proposal(" ".join(words), proposed)
        if answered is not None:
            return answered
    numbered = _NUMBERED.fullmatch(" ".join(words))
    if numbered is not None:
        return Remark(Says.TAKE_BACK, number=int(numbered[1]))
    for says in (Says.WRONG, Says.RULE_WRONG, Says.MISSING, Says.TAKE_BACK):
        if _is(says, words):
            return Remark(says)
    return None


def says_wrong(text: str) -> bool:
    """Whether a text says that an answer is wrong, and no more than that.

    Examples
    --------
    >>> says_wrong("No, that's wrong!"), says_wrong("is that wrong?"), says_wrong("why?")
    (True, False, False)
    """
    words = tuple(words_of(text))
    return bool(words) and not text.rstrip().endswith("?") and _is(Says.WRONG, words)


def _to_proposal(text: str, proposed: int) -> Remark | None:
    """A yes, a no or a choice, where proposals wait for one."""
    words = tuple(text.split())
    for says in (Says.AGREE, Says.REFUSE):
        if _is(says, words):
            return Remark(says)
    chosen = _CHOICE.fullmatch(text)
    if chosen is None:
        return None
    said = chosen[1] or chosen[2]
    number = int(said) if said.isdecimal() and len(said) < 4 else _PLACES.get(said)
    if number is None:
        return None
    if number > proposed or number == 0:
        raise QuestionError(
            f"there is no proposal {said}; say a number from 1 to {proposed}, or no",
        )
    return Remark(Says.CHOOSE, number=number)


def _is(says: Says, words: tuple[str, ...]) -> bool:
    return bool(Chart(_GRAMMAR, tuple(map(lemma, words))).whole(_forms()[says]))


_GRAMMAR = Grammar(phrases={}, lexicon={}, folds={})


@cache
def _forms() -> dict[str, Form]:
    text = resources.files("seewhy.revision").joinpath("remarks.toml").read_text(encoding="utf-8")
    table = tomllib.loads(text)["remarks"]
    return {name: parse_form("|".join(forms)) for name, forms in table.items()}
