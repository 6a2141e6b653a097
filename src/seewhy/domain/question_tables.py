"""What may stand in questions.toml."""

from __future__ import annotations

from pydantic import Field

from seewhy.domain.table_texts import StrictTable


class QuestionTable(StrictTable):
    """``[[question]]``: what is asked, and the ways to ask it."""

    asks: str = Field(
        description="What is asked: class, is_class, why_class, why_not_class, change_to_class, "
        "difference_to_class, belief_value, feature_value, feature_is or explain; what else can be "
        "asked (docs/questions.md) needs no templates.",
    )
    feature: str | None = Field(
        default=None,
        description="The feature asked about, for feature_value and feature_is.",
    )
    value: str | None = Field(
        default=None,
        description="The value asked about, for feature_is where the patterns have no {value}.",
    )
    predicate: str | None = Field(
        default=None,
        description="The static asked about, for belief_value.",
    )
    patterns: tuple[str, ...] = Field(
        min_length=1,
        max_length=500,
        description="The ways to ask it: {it} stands for the subject, {class} for the words of a "
        "class, {value} for those of a value, and [...] may be left out.",
    )


class QuestionsFile(StrictTable):
    """The whole of ``questions.toml``."""

    synonyms: dict[str, tuple[str, ...]] = Field(
        default={},
        description="For a word or phrase of the patterns, others that mean the same.",
    )
    fillers: tuple[str, ...] = Field(
        default=(),
        description="Phrases that a question may have and that ask for nothing, as in `please`.",
    )
    answers: dict[str, str] = Field(
        default={},
        description="For a form of answer, the domain's own wording of it; `seewhy reference` "
        "lists the forms.",
    )
    question: tuple[QuestionTable, ...] = Field(
        default=(),
        max_length=2000,
        description="One table a thing that can be asked; none where the grammar says it all.",
    )
