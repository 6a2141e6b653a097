"""What a question asks for, apart from its wording."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

__all__ = ["Asks", "Query", "Question", "Statement"]


class Asks(StrEnum):
    """What a question asks for."""

    CLASS = "class"
    IS_CLASS = "is_class"
    WHY_CLASS = "why_class"
    WHY_NOT_CLASS = "why_not_class"
    CHANGE_TO_CLASS = "change_to_class"
    DIFFERENCE_TO_CLASS = "difference_to_class"
    BELIEF_VALUE = "belief_value"
    FEATURE_VALUE = "feature_value"
    FEATURE_IS = "feature_is"
    EXPLAIN = "explain"
    WHY_VALUE = "why_value"
    WHY_NOT_VALUE = "why_not_value"
    ALL = "all"
    EITHER = "either"
    WHAT_IF = "what_if"
    CONTRAST = "contrast"
    HOW_SURE = "how_sure"
    WHICH_RULE = "which_rule"
    WHAT_TO_CHECK = "what_to_check"
    SIMILAR = "similar"
    WHERE = "where"
    DESCRIBE = "describe"
    HOW_MANY = "how_many"
    WHICH = "which"
    BELIEF_IS = "belief_is"
    WHY_BELIEF = "why_belief"
    WHY_NOT_BELIEF = "why_not_belief"
    WHEN_CLASS = "when_class"
    MATTERS = "matters"
    BECAUSE = "because"
    MORE = "more"
    POSSIBLE = "possible"


Query = tuple[str | None, ...]
"""What is asked, the class, the feature or static, and the value that it is about; behind them what
else the question states, and the features that it is about together."""


@dataclass(frozen=True)
class Statement:
    """That the picture is of a class, or that a feature has a value; or not, where it is denied.

    Examples
    --------
    >>> str(Statement(feature="base", value="wide")), str(Statement(label="stable"))
    ('base=wide', 'class=stable')
    """

    label: str | None = None
    feature: str | None = None
    value: str | None = None
    denied: bool = False

    def __str__(self) -> str:
        equals = "!=" if self.denied else "="
        return f"class={self.label}" if self.label else f"{self.feature}{equals}{self.value}"


@dataclass(frozen=True)
class Question:
    """A question that was understood.

    Attributes
    ----------
    asks : Asks
    text : str
        The question in the words of the domain's template, or of the grammar.
    words : tuple of str
        Its normalised words, which the recurrent network reads.
    label, feature, value, predicate : str or None
        The class, the feature and the value, or the static that it is about.
    statements : tuple of Statement
        What it supposes, contrasts, or joins by "and" or "or".
    group : tuple of str
        The features that it is about together, as in "which fingers are folded?".
    """

    asks: Asks
    text: str
    words: tuple[str, ...]
    label: str | None = None
    feature: str | None = None
    value: str | None = None
    predicate: str | None = None
    statements: tuple[Statement, ...] = ()
    group: tuple[str, ...] = ()

    @property
    def query(self) -> Query:
        """What is asked, without the wording; equal for questions that mean the same."""
        more = (*map(str, self.statements), *self.group)
        return (self.asks.value, self.label, self.feature or self.predicate, self.value, *more)

    @property
    def is_of_templates(self) -> bool:
        """Whether domains word it by templates, and its answers can be learned."""
        return self.asks in _OF_TEMPLATES


_OF_TEMPLATES = frozenset(list(Asks)[: list(Asks).index(Asks.EXPLAIN) + 1])
