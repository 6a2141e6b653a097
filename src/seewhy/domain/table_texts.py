"""What all tables of a domain's files have in common, and what their texts may be."""

from __future__ import annotations

import re
from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict

from seewhy.text.slots import wrong_slot

_SLOT = re.compile(r"\{\w*\}")


def with_letters(text: str) -> str:
    """Return a text that says something by itself, beside what its slots are filled with.

    Raises
    ------
    ValueError
        If it does not.

    Examples
    --------
    >>> with_letters("{it} leans")
    '{it} leans'
    """
    if not any(character.isalnum() for character in _SLOT.sub("", text)):
        beside = " beside its slots" if _SLOT.search(text) else ""
        raise ValueError(f"must have a letter or a digit{beside}, got '{text}'")
    return text


def _without_control(name: str) -> str:
    if not name.isprintable() or name != name.strip() or not name:
        raise ValueError(f"a name must be of visible characters, got {name!r}")
    return name


def _with_it_alone(text: str) -> str:
    if wrong_slot(with_letters(text), ("it",)) is not None:
        raise ValueError(f"{{it}} is the only slot that there is, got '{text}'")
    return text


def _with_value(text: str) -> str:
    if wrong_slot(text, ("it", "value")) is not None or "{value}" not in text:
        raise ValueError(f"must have the slot {{value}} and may have {{it}}, got '{text}'")
    return text


def _without_braces(text: str) -> str:
    if set("{}") & set(text):
        raise ValueError(f"must have no braces, got '{text}'")
    return text


Spoken = Annotated[str, AfterValidator(with_letters)]
Word = Annotated[Spoken, AfterValidator(_without_braces)]
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
