"""Read JSON that the program wrote into a checked schema: of the right types, within bounds."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import from_json

from seewhy.errors import ModelError
from seewhy.text.visible import visible

__all__ = ["LARGEST", "Strict", "read_bytes", "read_json", "read_object"]

LARGEST = 64 << 20
"""Bytes that a JSON file of a model may have; one of a hundred thousand pictures has a tenth."""


class Strict(BaseModel):
    """A schema that takes nothing for what it is not: no text for a number, no NaN."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


Schema = TypeVar("Schema", bound=BaseModel)


def read_json(path: Path, schema: type[Schema], *, remedy: str) -> Schema:
    """Read a JSON file of a model.

    Raises
    ------
    ModelError
        It is missing, too large, or not as it is written; the text names the file, the place in
        it, and the remedy.
    """
    try:
        return schema.model_validate_json(read_bytes(path, largest=LARGEST, remedy=remedy))
    except ValidationError as problem:
        first = problem.errors(include_url=False, include_input=False)[0]
        where = ".".join(map(visible, first["loc"])) or "its text"
        raise ModelError(f"{path} is damaged ({where}: {first['msg']}): {remedy}") from None


def read_object(path: Path, *, remedy: str) -> dict[str, Any]:
    """Read a JSON file as an object of anything, where its schema depends on what it says.

    Raises
    ------
    ModelError
        As :func:`read_json`.
    """
    content = read_bytes(path, largest=LARGEST, remedy=remedy)
    try:
        found = from_json(content, allow_inf_nan=False)
    except ValueError as problem:
        raise ModelError(f"{path} is damaged (its text: {problem}): {remedy}") from None
    if not isinstance(found, dict):
        raise ModelError(f"{path} is damaged (its text: it must be an object): {remedy}")
    return found


def read_bytes(path: Path, *, largest: int, remedy: str) -> bytes:
    """Read a file of a model that may have so many bytes at most.

    Raises
    ------
    ModelError
        It cannot be read, or has more.
    """
    try:
        with path.open("rb") as stream:
            content = stream.read(largest + 1)
    except OSError as problem:
        raise ModelError(f"{path} cannot be read ({problem.strerror}): {remedy}") from None
    if len(content) > largest:
        raise ModelError(f"{path} has more than {largest >> 20} MiB, which no model has: {remedy}")
    return content
