"""What may stand under ``[things]`` in domain.toml."""

from __future__ import annotations

import re
from typing import Annotated
from typing import Literal as OneOf

from pydantic import AfterValidator, Field

from seewhy.domain.table_texts import Clause, Key, Spoken, StrictTable, Word
from seewhy.text.slots import wrong_slot

Measure = OneOf[
    "left",
    "right",
    "above",
    "below",
    "inside",
    "touching",
    "nearer",
    "larger",
    "in_front",
    "behind",
    "seen",
    "axioms",
]
"""Where a relation comes from: measured from boxes or positions, seen on the pair, concluded."""


def _with_two_things(text: str) -> str:
    ordinary = text.replace("{0}", "").replace("{1}", "")
    if wrong_slot(ordinary, ()) is not None or not ("{0}" in text and "{1}" in text):
        raise ValueError(f"must have the slots {{0}} and {{1}} and no others, got '{text}'")
    return text


def _with_them(text: str) -> str:
    if wrong_slot(text, ("them",)) is not None or "{them}" not in text:
        raise ValueError(f"must have the slot {{them}} and no others, got '{text}'")
    return text


GroupClause = Annotated[Spoken, AfterValidator(_with_them)]


def _beside_the_domain(name: str) -> str:
    if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*\.onnx", name):
        raise ValueError(
            f"must be the name of an ONNX file in this folder, such as 'boxes.onnx', got '{name}'; "
            "what lies elsewhere is not read, and Python functions are given in Python"
        )
    return name


OnnxFile = Annotated[str, AfterValidator(_beside_the_domain)]

RelationClause = Annotated[Spoken, AfterValidator(_with_two_things)]


class ThingValueTable(StrictTable):
    """``[things.features.NAME.values.VALUE]``: how a value of a thing's feature is said."""

    say: Clause | None = Field(
        default=None,
        description="The clause that says it, as in `{it} is gray`; {it} stands for the thing. "
        "Where left out, `{it} is` with the first of its words, or `{it} is a` with its first "
        "noun.",
    )
    words: tuple[Word, ...] = Field(
        default=(),
        description="Adjectives by which questions may name the value, as in `shiny`; its own "
        "name is one, too, where it has no nouns.",
    )
    nouns: tuple[Word, ...] = Field(
        default=(),
        description="Nouns, in the singular, by which questions may name a thing of this value, "
        "as in `cube` and `block`; answers use the first.",
    )
    behind: Word | None = Field(
        default=None,
        description="What stands behind the noun for a thing of this value, as in `with two "
        "symbols`, where no adjective in front of it says the value well.",
    )


class ThingFeatureTable(StrictTable):
    """``[things.features.NAME]``: a feature of every thing, a static of things in knowledge.al."""

    name: Word | None = Field(
        default=None,
        description="What the feature is called in answers; where left out, its name in "
        "knowledge.al.",
    )
    words: tuple[Word, ...] = Field(
        default=(),
        description="Other words for the feature in questions, as in `color` beside `colour`.",
    )
    how: tuple[Word, ...] = Field(
        default=(),
        description="Adjectives that ask for it behind `how`, as in `big` for `how big is it?`.",
    )
    participles: tuple[Word, ...] = Field(
        default=(),
        description="Words between a thing and its value, as in `made of` for `what is it made "
        "of?` and `made of the same material`.",
    )
    ordered: bool = Field(
        default=False,
        description="Whether its values stand in knowledge.al from the least to the most, so "
        "that things can be compared (`larger than`, `the smallest`).",
    )
    values: dict[Key, ThingValueTable] = Field(
        default={},
        max_length=2000,
        description="A table for each value whose name alone does not say it.",
    )


class RelationTable(StrictTable):
    """``[things.relations.NAME]``: what may hold between two things, a static of both."""

    measure: Measure = Field(
        description="Where it comes from: measured from boxes or positions (`left`, `right`, "
        "`above`, `below`, `inside`, `touching`, `nearer`, `larger`, `in_front`, `behind`), "
        "`seen` by a head on the pair, or `axioms`, which conclude it.",
    )
    say: RelationClause = Field(
        description="The clause that says it, as in `{0} is left of {1}`.",
    )
    words: tuple[Word, ...] = Field(
        default=(),
        description="Prepositions, without `is`, by which questions name it, as in `left of` and "
        "`to the left of`.",
    )
    verbs: tuple[Word, ...] = Field(
        default=(),
        description="Verbs, without ending, by which questions name it, as in `touch` for `which "
        "block touches the ball?`.",
    )
    most: tuple[Word, ...] = Field(
        default=(),
        description="Adjectives for the thing that is so to all others, as in `leftmost`.",
    )
    side: tuple[Word, ...] = Field(
        default=(),
        description="Nouns for the side from which things are counted, as in `left` for `the "
        "second thing from the left`.",
    )
    converse: str | None = Field(
        default=None,
        description="The relation that holds the other way round, as `right` of `left`.",
    )
    removed: str | None = Field(
        default=None,
        description="The conclusion that comes true of {0} when {1} is taken away, as `falls`; "
        "for `what would happen if the ball were removed?`.",
    )


class ConclusionTable(StrictTable):
    """``[things.conclusions.NAME]``: what axioms conclude of a thing, a static of it."""

    say: Clause = Field(description="The clause that says it, as in `{it} would fall`.")
    deny: Clause | None = Field(
        default=None,
        description="The clause that denies it; where left out, `it is not so that` and `say`.",
    )
    words: tuple[Word, ...] = Field(
        default=(),
        description="Adjectives by which questions name it, as in `unstable`.",
    )
    verbs: tuple[Word, ...] = Field(
        default=(),
        description="Verbs, without ending, by which questions name it, as in `fall` for `which "
        "things would fall?`.",
    )


class GroupTable(StrictTable):
    """``[things.groups.NAME]``: what axioms conclude of several things together.

    It is a static of two things or more, and holds of them in whatever order.
    """

    one: Word | None = Field(
        default=None, description="The noun for such a group; where left out, NAME."
    )
    many: Word | None = Field(
        default=None,
        description="The noun for several; where left out, the regular plural.",
    )
    words: tuple[Word, ...] = Field(default=(), description="Other nouns for it, in the singular.")
    say: GroupClause | None = Field(
        default=None,
        description="The clause that says it, with {them}, as in `the colours of {them} fit`; "
        "where left out, that they are such a group.",
    )
    deny: GroupClause | None = Field(default=None, description="The clause that denies it.")


class ThingsTable(StrictTable):
    """``[things]``: what pictures show several of, their features and relations."""

    sort: str = Field(
        default="thing",
        description="The sort of knowledge.al that stands for things.",
    )
    most: int = Field(
        default=10,
        ge=1,
        le=100,
        description="The most things that a picture may show; what is reasoned with is made for "
        "so many.",
    )
    one: Word = Field(default="thing", description="The noun for any one of them.")
    many: Word | None = Field(
        default=None,
        description="The noun for several; where left out, the regular plural.",
    )
    words: tuple[Word, ...] = Field(
        default=(),
        description="Other nouns, in the singular, for any of them, as in `object`.",
    )
    support: str | None = Field(
        default=None,
        description="The relation of a thing to what it stands on. Where it is known, where things "
        "stand (`left`, `right`, `nearer`, `in_front`, `behind`) is measured from the box of what "
        "is at the foot of their stack.",
    )
    detector: OnnxFile | None = Field(
        default=None,
        description="An ONNX file of this folder that finds the boxes of things; where left out, "
        "a detector is trained on annotated boxes.",
    )
    features: dict[Key, ThingFeatureTable] = Field(
        min_length=1,
        max_length=100,
        description="A table for each feature of things; the order is that in which answers say "
        "adjectives.",
    )
    relations: dict[Key, RelationTable] = Field(
        default={},
        max_length=100,
        description="A table for each relation between two things.",
    )
    conclusions: dict[Key, ConclusionTable] = Field(
        default={},
        max_length=100,
        description="A table for each thing that axioms conclude of a thing and that can be asked "
        "about.",
    )
    groups: dict[Key, GroupTable] = Field(
        default={},
        max_length=20,
        description="A table for each thing that axioms conclude of several things together.",
    )
