"""Every key of a domain's files, from the tables that read them."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any

from pydantic import BaseModel

from seewhy.dialogue.answer import SLOTS, default_answer_templates
from seewhy.domain.question_tables import QuestionsFile
from seewhy.domain.tables import DomainFile
from seewhy.planning.tables import PlanningFile

__all__ = [
    "FileReference",
    "KeyReference",
    "TableReference",
    "file_references",
    "reference_dict",
    "reference_page",
    "table_references",
]

_Schema = Mapping[str, Any]
_FILES: tuple[tuple[str, type[BaseModel], str], ...] = (
    ("domain.toml", DomainFile, "What pictures show, how it is said, how it is trained."),
    ("questions.toml", QuestionsFile, "What can be asked, and in which words."),
    ("planning.toml", PlanningFile, "Where a domain plans: words for what changes, and chance."),
)


@dataclass(frozen=True)
class KeyReference:
    """One key of a table.

    Attributes
    ----------
    name : str
    holds : str
        What type its value has and which values may stand there, in words.
    needed : bool
        Whether it must be given.
    default : str or None
        What holds where it is left out, as TOML; None where that is nothing, or where the meaning
        says what.
    meaning : str
        One sentence.
    """

    name: str
    holds: str
    needed: bool
    default: str | None
    meaning: str


@dataclass(frozen=True)
class TableReference:
    """One table of a file.

    Attributes
    ----------
    header : str
        As in the file, with NAME and VALUE for what a domain calls by names of its own; empty for
        what stands above all tables.
    needed : bool
        Whether a file must have it.
    meaning : str
        One sentence.
    keys : tuple of KeyReference
    """

    header: str
    needed: bool
    meaning: str
    keys: tuple[KeyReference, ...]


@dataclass(frozen=True)
class FileReference:
    """One file of a domain's folder."""

    name: str
    meaning: str
    tables: tuple[TableReference, ...]


def file_references() -> tuple[FileReference, ...]:
    """Return what may stand in each file of a domain, in the order of the tables that read it.

    Examples
    --------
    >>> first = file_references()[0]
    >>> first.name, first.tables[0].header, first.tables[0].keys[2].name
    ('domain.toml', '[domain]', 'scene')
    """
    return tuple(
        FileReference(name, meaning, table_references(schema)) for name, schema, meaning in _FILES
    )


@cache
def table_references(schema: type[BaseModel]) -> tuple[TableReference, ...]:
    """Return the tables that a file of some schema may have.

    Raises
    ------
    ValueError
        If a field of the schema has no description.

    Examples
    --------
    >>> dense = table_references(DomainFile)[2].keys[2]
    >>> dense.name, dense.holds, dense.needed, dense.default
    ('dense', 'whole number, 1 to 65,536', False, '64')
    """
    content = schema.model_json_schema()
    return tuple(_tables(content, content.get("$defs", {}), path=(), needed=True, meaning=""))


def reference_dict() -> dict[str, Any]:
    """Return the reference as values that JSON can hold: file → its tables."""
    return {file.name: [asdict(table) for table in file.tables] for file in file_references()}


def reference_page() -> str:
    """Return the reference as Markdown."""
    parts = [
        "# The keys of a domain's files",
        "`seewhy reference` prints this page from the tables that read the files. A key that is "
        "not here\nis refused by `seewhy check`, with file and line.",
        "NAME and VALUE stand for names of your own, as `[features.colour.values.red]`. What "
        "stands in\nknowledge.al is [the knowledge language](knowledge_language.md); columns of "
        "`scenes.csv` are in\n[tables of pictures](data.md).",
    ]
    for file in file_references():
        parts += [f"## {file.name}", file.meaning]
        for table in file.tables:
            if table.header:
                needed = "" if table.needed else " May be left out."
                parts += [f"### `{table.header}`", f"{table.meaning}{needed}"]
            if table.keys:
                parts.append(_markdown_rows(table.keys))
        if file.name == "questions.toml":
            parts.append(_wordings())
    return "\n\n".join(parts) + "\n"


def _tables(
    table: _Schema,
    others: _Schema,
    *,
    path: tuple[str, ...],
    needed: bool,
    meaning: str,
    listed: bool = False,
) -> Iterator[TableReference]:
    """A table, and behind it those that lie in it."""
    keys: list[KeyReference] = []
    inner: list[TableReference] = []
    for name, key in table["properties"].items():
        required = name in table.get("required", ())
        if "description" not in key:
            raise ValueError(f"'{'.'.join([*path, name])}' says nowhere what it means")
        below = _table_below(key)
        if below is None:
            default = key.get("default")
            keys.append(
                KeyReference(
                    name=name,
                    holds=_holds(_chosen(key)),
                    needed=required,
                    default=None if default in (None, [], {}) else _toml(default),
                    meaning=key["description"],
                )
            )
            continue
        reference, repeated = below
        inner += _tables(
            others[reference.rsplit("/", 1)[1]],
            others,
            path=(*path, name, *(["VALUE" if path else "NAME"] if repeated == "named" else [])),
            needed=required,
            meaning=" ".join([key["description"], *_least(key)]),
            listed=repeated == "listed",
        )
    if keys or path:
        header = f"[{'.'.join(path)}]" if path else ""
        header = f"[{header}]" if listed else header
        yield TableReference(header, needed, meaning, tuple(keys))
    yield from inner


def _table_below(key: _Schema) -> tuple[str, str] | None:
    """Which table a key holds, and whether there is one, one a name, or a list of them."""
    chosen = _chosen(key)
    for repeated, inside in (
        ("once", chosen),
        ("named", chosen.get("additionalProperties", {})),
        ("listed", chosen.get("items", {})),
    ):
        if "$ref" in inside:
            return inside["$ref"], repeated
    return None


def _chosen(key: _Schema) -> _Schema:
    """What a key holds where it is not left out."""
    for choice in key.get("anyOf", ()):
        if choice.get("type") != "null":
            found: _Schema = choice
            return found
    return key


def _least(key: _Schema) -> list[str]:
    """How many tables there must be where one is not enough."""
    least = key.get("minProperties", 1)
    return [f"There are at least {least}."] if least > 1 else []


def _holds(value: _Schema, *, several: bool = False) -> str:
    """The type and the range of a value, or of several."""
    if "enum" in value:
        *others, last = (_toml(choice) for choice in value["enum"])
        return f"{', '.join(others)} or {last}"
    kind, s = value["type"], "s" * several
    if kind == "array":
        some = "one or more " if value.get("minItems") == 1 else ""
        return f"list{s} of {some}{_holds(value['items'], several=True)}"
    if kind == "object":
        some = "one or more " if value.get("minProperties") == 1 else ""
        return f"table{s} of {some}{_holds(value['additionalProperties'], several=True)}"
    words = {"string": f"text{s}", "boolean": "true or false", "integer": f"whole number{s}"}
    return ", ".join([words.get(kind, f"{kind}{s}"), *_range(value)])


def _range(value: _Schema) -> list[str]:
    if "pattern" in value:
        return [f"as `{value['pattern']}`"]
    low, high = value.get("minimum"), value.get("maximum")
    if low is not None and high is not None:
        return [f"{_number(low)} to {_number(high)}"]
    return [
        f"{words} {_number(value[limit])}"
        for limit, words in (
            ("exclusiveMinimum", "above"),
            ("minimum", "at least"),
            ("exclusiveMaximum", "below"),
            ("maximum", "at most"),
        )
        if limit in value
    ]


def _number(limit: float) -> str:
    return f"{int(limit):,}" if limit == int(limit) else f"{limit:g}"


def _toml(value: object) -> str:
    """A value as it stands in a TOML file."""
    if isinstance(value, list):
        return f"[{', '.join(_toml(member) for member in value)}]"
    return json.dumps(value, ensure_ascii=False)


def _markdown_rows(keys: Sequence[KeyReference]) -> str:
    rows = ["| key | value | where left out | meaning |", "|---|---|---|---|"]
    for key in keys:
        default = "must be given" if key.needed else f"`{key.default}`" if key.default else "–"
        rows.append(f"| `{key.name}` | {key.holds} | {default} | {key.meaning} |")
    return "\n".join(rows)


def _wordings() -> str:
    slots = ", ".join(f"`{{{slot}}}`" for slot in SLOTS)
    rows = "\n".join(f"| `{form}` | {text} |" for form, text in default_answer_templates().items())
    return (
        "### The forms of answer\n\n"
        f"What may stand under `[answers]`, with what holds where it does not. Slots: {slots}.\n\n"
        f"| form | wording |\n|---|---|\n{rows}"
    )
