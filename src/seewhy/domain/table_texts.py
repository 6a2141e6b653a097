"""What all tables of a domain's files have in common, and what their texts may be."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict

from seewhy.text.slots import wrong_slot


def _with_letters(word: str) -> str:
    if not any(character.isalnum() for character in word):
        raise ValueError(f"must have a letter or a digit, got '{word}'")
    return word


def _without_control(name: str) -> str:
    if not name.isprintable() or name != name.strip() or not name:
        raise ValueError(f"a name must be of visible characters, got {name!r}")
    return name


def _with_it_alone(text: str) -> str:
    if wrong_slot(_with_letters(text), ("it",)) is not None:
        raise ValueError(f"{{it}} is the only slot that there is, got '{text}'")
    return text


def _with_value(text: str) -> str:
    if wrong_slot(_with_letters(text), ("it", "value")) is not None or "{value}" not in text:
        raise ValueError(f"must have the slot {{value}} and may have {{it}}, got '{text}'")
    return text


def _without_braces(text: str) -> str:
    if set("{}") & set(text):
        raise ValueError(f"must have no braces, got '{text}'")
    return text


Word = Annotated[str, AfterValidator(_with_letters), AfterValidator(_without_braces)]
Label = Annotated[str, AfterValidator(_without_braces)]
Key = Annotated[str, AfterValidator(_without_control)]
Clause = Annotated[str, AfterValidator(_with_it_alone)]
BeliefClause = Annotated[str, AfterValidator(_with_value)]


LONGEST_TEXT = 2000
"""Characters of a text or a name in a domain's tables."""


class StrictTable(BaseModel):
    """A table in which nothing may stand that it does not know, nor texts without end."""

    model_config = ConfigDict(
        extra="forbid", frozen=True, populate_by_name=True, str_max_length=LONGEST_TEXT
    )
