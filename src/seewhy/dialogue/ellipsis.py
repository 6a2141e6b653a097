"""Questions that leave out what was just spoken of: "and why?", "and the base?"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from seewhy.dialogue.asked import Asks, Question, Statement
from seewhy.dialogue.inflection import lemma
from seewhy.dialogue.readings import Readings

__all__ = ["completed"]

_LINKS = ("and", "but", "so", "or")
_WHY = {
    tuple(map(lemma, words.split())): denied
    for words, denied in {
        "why": False, "why so": False, "why that": False, "why is that": False, "why not": True,
    }.items()
}  # fmt: skip
_WHAT_ABOUT = tuple(map(lemma, ("what", "about")))
_OF_A_CLASS = {
    Asks.IS_CLASS, Asks.WHY_CLASS, Asks.WHY_NOT_CLASS, Asks.CHANGE_TO_CLASS,
    Asks.DIFFERENCE_TO_CLASS,
}  # fmt: skip
_OF_A_FEATURE = {Asks.HOW_SURE, Asks.WHERE}


def completed(readings: Readings, words: Sequence[str], previous: Question) -> list[Question]:
    """Return what a question means that leaves something out; none where it leaves out nothing.

    Parameters
    ----------
    readings : Readings
    words : sequence of str
        The question, normalised for the grammar.
    previous : Question
        What was asked before.
    """
    linked = bool(words) and words[0] in _LINKS
    rest = tuple(words[1:] if linked else words)
    if rest in _WHY:
        return _why(previous, denied=_WHY[rest])
    if rest[:2] == _WHAT_ABOUT:
        rest = rest[2:]
    elif not linked:
        return []
    return [
        follow_up for question in readings.read(rest) for follow_up in _carried(question, previous)
    ]


def _why(previous: Question, *, denied: bool) -> list[Question]:
    """Why what was asked about is so; "why not?" of what was asked about and denied."""
    if not denied:
        return [Question(Asks.EXPLAIN, "", ())]
    if previous.asks in _OF_A_CLASS and previous.label is not None:
        return [Question(Asks.WHY_NOT_CLASS, "", (), label=previous.label)]
    if previous.asks is Asks.FEATURE_IS:
        return [
            Question(Asks.WHY_NOT_VALUE, "", (), feature=previous.feature, value=previous.value)
        ]
    return []


def _carried(question: Question, previous: Question) -> list[Question]:
    """What is said now, asked as it was asked before."""
    if question.asks is Asks.IS_CLASS and previous.asks in _OF_A_CLASS:
        return [replace(previous, text="", words=(), label=question.label)]
    if question.asks is Asks.FEATURE_VALUE and previous.asks in _OF_A_FEATURE:
        return [Question(previous.asks, "", (), feature=question.feature)]
    if question.asks is Asks.FEATURE_IS and previous.asks is Asks.WHAT_IF:
        statement = Statement(feature=question.feature, value=question.value)
        return [Question(Asks.WHAT_IF, "", (), statements=(statement,))]
    if question.asks is Asks.FEATURE_IS and previous.asks in (Asks.WHY_VALUE, Asks.WHERE):
        return [Question(previous.asks, "", (), feature=question.feature, value=question.value)]
    return [question]
