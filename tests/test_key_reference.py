"""The reference of every key: complete, as the tables that read the files say, and committed."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from pydantic import BaseModel, Field

from conftest import Run, write_tiles
from seewhy.dialogue.question import Asks, Question
from seewhy.domain.domain import load_domain
from seewhy.domain.question_tables import QuestionsFile, QuestionTable
from seewhy.domain.tables import DomainFile, DomainTable, PictureTable
from seewhy.planning.tables import PlanningFile
from seewhy.report.key_reference import (
    TableReference,
    file_references,
    reference_page,
    table_references,
)

PAGE = Path(__file__).parent.parent / "docs" / "reference.md"
SCHEMAS = {
    "domain.toml": DomainFile,
    "questions.toml": QuestionsFile,
    "planning.toml": PlanningFile,
}


def models(schema: type[BaseModel]) -> set[type[BaseModel]]:
    """A table and all tables that may lie in it."""
    found, left = set(), [schema]
    while left:
        annotation = left.pop()
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            if annotation not in found:
                found.add(annotation)
                left += [field.annotation for field in annotation.model_fields.values()]
        else:
            left += getattr(annotation, "__args__", ())
    return found


@pytest.mark.parametrize("schema", SCHEMAS.values())
def test_every_field_says_what_it_means(schema: type[BaseModel]) -> None:
    fields = {
        f"{table.__name__}.{name}": field.description
        for table in models(schema)
        for name, field in table.model_fields.items()
    }
    assert len(fields) > 5
    for name, description in fields.items():
        assert description, f"{name} has no description"
        assert re.fullmatch(r"[A-Z][^\n|]*\.", description), (name, description)
        assert description.count(". ") < 2, f"{name} is described by more than two sentences"


@pytest.mark.parametrize(("name", "schema"), SCHEMAS.items())
def test_the_reference_has_every_field_of_every_table(name: str, schema: type[BaseModel]) -> None:
    (file,) = [reference for reference in file_references() if reference.name == name]
    keys = {key.name for table in file.tables for key in table.keys}
    headers = {part for table in file.tables for part in re.findall(r"\w+", table.header)}
    assert {name for table in models(schema) for name in table.model_fields} == keys | headers - {
        "NAME",
        "VALUE",
    }


class _Leaf(BaseModel):
    share: float = Field(default=0.5, gt=0.0, le=1.0, description="A share.")
    tags: tuple[str, ...] | None = Field(default=None, description="Tags.")


class _Branch(BaseModel):
    kind: str = Field(pattern="^a+$", description="A kind.")
    leaves: dict[str, _Leaf] = Field(min_length=2, description="Leaves.")


class _Tree(BaseModel):
    height: int = Field(default=0, ge=0, description="Of the tree.")
    branch: dict[str, _Branch] = Field(default={}, description="Branches.")
    bird: tuple[_Leaf, ...] = Field(default=(), description="Birds.")


def lines(table: TableReference) -> list[str]:
    return [
        f"{key.name}: {key.holds} ({'needed' if key.needed else key.default})" for key in table.keys
    ]


def test_a_reference_follows_the_tables_that_it_is_made_from() -> None:
    tables = table_references(_Tree)
    assert {table.header: lines(table) for table in tables} == {
        "": ["height: whole number, at least 0 (0)"],
        "[branch.NAME]": ["kind: text, as `^a+$` (needed)"],
        "[branch.NAME.leaves.VALUE]": [
            "share: number, above 0, at most 1 (0.5)",
            "tags: list of texts (None)",
        ],
        "[[bird]]": ["share: number, above 0, at most 1 (0.5)", "tags: list of texts (None)"],
    }
    assert [table.meaning for table in tables[1:]] == [
        "Branches.",
        "Leaves. There are at least 2.",
        "Birds.",
    ]
    assert [table.needed for table in tables[1:]] == [False, True, False]


def test_a_key_without_a_meaning_is_refused() -> None:
    class Mute(BaseModel):
        size: int

    with pytest.raises(ValueError, match="'size' says nowhere what it means"):
        table_references(Mute)


def test_the_committed_page_is_what_the_command_prints(run: Run) -> None:
    printed = run("reference").out
    assert printed == reference_page()
    assert PAGE.read_text(encoding="utf-8") == printed, "seewhy reference --out docs/reference.md"


def test_the_command_writes_a_file_and_prints_json(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "some" / "page.md"
    assert run("reference", "--out", file).out == f"written: {file}\n"
    assert file.read_text(encoding="utf-8") == reference_page()
    found = json.loads(run("reference", "--json").out)
    first = found["domain.toml"][0]
    assert (first["header"], first["keys"][0]["name"]) == ("[domain]", "name")
    assert first["keys"][0]["needed"] is True


def test_a_file_that_cannot_be_written_ends_with_one_sentence(run: Run, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    result = run("reference", "--out", tmp_path / "file" / "page.md")
    assert (result.code, result.err.count("\n")) == (2, 1)
    assert "page.md" in result.err or "file" in result.err


@pytest.mark.parametrize("source", ["template", "pictures"])
def test_the_commented_keys_of_a_new_domain_work(source: str, run: Run, tmp_path: Path) -> None:
    """Each is described as in the reference, and its example does something that check accepts."""
    folder = tmp_path / "pears"
    if source == "pictures":
        write_tiles(tmp_path / "data", count=4)
        run("new", folder, "--from", tmp_path / "data")
    else:
        run("new", folder)
    text = (folder / "domain.toml").read_text(encoding="utf-8")
    examples = re.findall(r"^# (\w+) = \S+$", text, re.MULTILINE)
    assert {"eyes", "reading", "known_share", "rotate", "size"} <= set(examples)
    sentences = " ".join(re.sub(r"^# ", "", line) for line in text.splitlines())
    for table in (DomainTable, PictureTable):
        for name, field in table.model_fields.items():
            assert (name in examples) <= (str(field.description) in sentences), name
    used = re.sub(r"^# (\w+ = \S+|\[\w+\])$", r"\1", text, flags=re.MULTILINE)
    (folder / "domain.toml").write_text(used, encoding="utf-8")
    domain = load_domain(folder)
    assert (domain.eyes, domain.known_share, domain.pictures.rotate) == ("none", 0.95, 15)
    assert run("check", folder).code == 0


def test_what_can_be_asked_is_named() -> None:
    described = QuestionTable.model_fields["asks"].description or ""
    assert set(re.findall(r"\w+", described)) >= {
        asks.value for asks in Asks if Question(asks, "", ()).is_of_templates
    }
