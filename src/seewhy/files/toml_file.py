"""Read a TOML file into a checked schema; errors name the line of the user's own file."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from pathlib import Path
from types import NoneType
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from seewhy.errors import DomainError
from seewhy.text.nearest import did_you_mean
from seewhy.text.visible import visible

Schema = TypeVar("Schema", bound=BaseModel)
LONGEST_SENTENCE = 500

LARGEST = 4_000_000
"""Characters of a file; the largest of a bundled domain has a hundredth."""

_KEY = re.compile(r"\s*(\"[^\"]*\"|'[^']*'|[A-Za-z0-9_.-]+)\s*=")


def read_toml(path: Path, schema: type[Schema]) -> Schema:
    """Read ``path`` and check it against ``schema``.

    Raises
    ------
    DomainError
        Where the file is missing, is not TOML, or does not fit; the text names file and line,
        what was found, and the nearest valid name.
    """
    try:
        with path.open(encoding="utf-8-sig") as stream:
            source = stream.read(LARGEST + 1)
    except FileNotFoundError:
        raise DomainError(
            f"{path}: there is no such file; a domain is a folder with domain.toml, "
            "knowledge.al and questions.toml ('seewhy new NAME' writes one)"
        ) from None
    except (OSError, UnicodeDecodeError) as problem:
        raise DomainError(f"{path}: cannot be read as UTF-8 text ({problem})") from None
    if len(source) > LARGEST:
        raise DomainError(f"{path}: has more than {LARGEST:,} characters; say it in fewer")
    try:
        content = tomllib.loads(source)
    except tomllib.TOMLDecodeError as problem:
        match = re.search(r"(.+) \(at (?:line (\d+), column (\d+)|end of document)\)", str(problem))
        lines = source.splitlines() or [""]
        line, column = (match.group(2, 3) if match else None) or (None, None)
        place = f"{path}:{line or len(lines)}:{column or len(lines[-1]) + 1}"
        what = match.group(1) if match else str(problem)
        raise DomainError(f"{place}: not valid TOML: {what[0].lower()}{what[1:]}") from None
    except RecursionError:
        raise DomainError(f"{path}: has lists in lists in lists, which no table has") from None
    except ValueError:
        # Python turns only so many digits into a number; the library does not say where.
        raise DomainError(f"{path}: has a number of thousands of digits; write a smaller") from None
    try:
        return schema.model_validate(content)
    except ValidationError as problem:
        # A misspelt name is also missing; that it is unknown says more.
        first = min(problem.errors(), key=lambda error: error["type"] != "extra_forbidden")
        keys = [str(key) for key in first["loc"] if key != "[key]"]
        line = line_of(source, keys)
        said = _explain(first["type"], first["msg"], first["input"], keys, schema)
        raise DomainError(f"{path}:{line}: {visible(said, most=LONGEST_SENTENCE)}") from None


def line_of(source: str, keys: Sequence[str]) -> int:
    """Return the first line (from 1) of the longest known part of a key path.

    Numbers in ``keys`` count the tables of an array of tables.

    Examples
    --------
    >>> line_of("[a]\\nx = 1\\n[b]\\nx = 2\\n", ["b", "x"])
    4
    >>> line_of("[a]\\nx = 1\\n[b.c]\\nx = 2\\n", ["b"])
    3
    """
    best, best_length = 1, 0
    table: list[str] = []
    counts: dict[str, int] = {}
    for number, line in enumerate(source.splitlines(), start=1):
        heading = _heading(line)
        if heading:
            table = [part.strip().strip("\"'") for part in heading.split(".")]
            if line.lstrip().startswith("[["):
                name = ".".join(table)
                table.append(str(counts.get(name, 0)))
                counts[name] = counts.get(name, 0) + 1
            path = table
        else:
            key = _KEY.match(line)
            if key is None:
                continue
            path = [*table, *(part.strip("\"'") for part in key.group(1).split("."))]
        length = next(
            (n for n, (key, part) in enumerate(zip(keys, path, strict=False)) if key != part),
            min(len(keys), len(path)),
        )
        if length > best_length:
            best, best_length = number, length
    return best


def lines_of_tables(source: str, name: str) -> list[int]:
    """Return the line (from 1) at which each table of an array of tables begins.

    Examples
    --------
    >>> lines_of_tables("[[a]]\\nx = 1\\n[b]\\n[[ a ]]  # the second\\n", "a")
    [1, 4]
    """
    return [
        number
        for number, line in enumerate(source.splitlines(), start=1)
        if line.lstrip().startswith("[[") and _heading(line) == name
    ]


def _heading(line: str) -> str:
    """What stands between the brackets of a table's heading; empty where a line is none."""
    inside, bracket, rest = line.strip().removeprefix("[").removeprefix("[").partition("]")
    rest = rest.removeprefix("]").strip()
    is_heading = line.lstrip().startswith("[") and bracket and (not rest or rest.startswith("#"))
    return inside.strip() if is_heading else ""


def _explain(kind: str, message: str, got: object, keys: list[str], schema: type[BaseModel]) -> str:
    where = ".".join(visible(key) for key in keys)
    if kind == "missing":
        return f"'{where}' is missing; add it"
    if kind == "extra_forbidden":
        known = _fields_beside(schema, keys[:-1])
        return f"'{where}' is not known here; {did_you_mean(keys[-1], known)}"
    if kind == "too_short" and isinstance(got, (dict, list, tuple)):
        least = re.search(r"at least (\d+)", message)
        number = least.group(1) if least else "1"
        return f"'{where}' must have at least {number} of them, got {len(got)}"
    if kind in ("too_long", "string_too_long") and isinstance(got, (str, dict, list, tuple)):
        most = re.search(r"at most (\d+)", message)
        what = "characters" if isinstance(got, str) else "of them"
        return f"'{where}' may have at most {most.group(1) if most else ''} {what}, got {len(got)}"
    if kind == "tuple_type":
        return f"'{where}' must be a list such as [\"…\"], got {got!r}"
    message = message.removeprefix("Value error, ")
    if isinstance(got, (str, int, float)) and ", got " not in message:
        shown = f"'{visible(got)}'" if isinstance(got, str) else visible(got).lower()
        message = f"{message}, got {shown}"
    return f"'{where}': {message[0].lower()}{message[1:]}"


def _of_given(annotation: object) -> object:
    """The type of a field where it is given: that of one which may be None without it."""
    choices = getattr(annotation, "__args__", ())
    given = [choice for choice in choices if choice is not NoneType]
    return given[0] if len(given) == 1 < len(choices) else annotation


def _fields_beside(schema: type[BaseModel], keys: Sequence[str]) -> list[str]:
    """The names that the schema knows in the table that ``keys`` leads to."""
    current: object = schema
    for key in keys:
        if isinstance(current, type) and issubclass(current, BaseModel):
            field = next(
                (field for n, field in current.model_fields.items() if key in (n, field.alias)),
                None,
            )
            current = _of_given(field.annotation) if field else None
        else:
            arguments = getattr(current, "__args__", ())
            current = arguments[-1] if arguments and arguments[-1] is not Ellipsis else None
            if current is None and arguments:
                current = arguments[0]
    if isinstance(current, type) and issubclass(current, BaseModel):
        return [field.alias or n for n, field in current.model_fields.items()]
    return []
