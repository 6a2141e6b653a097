"""The documentation names what there is; its tutorials do what they say."""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Iterator
from importlib import import_module
from itertools import pairwise
from pathlib import Path

import pytest

import seewhy

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
ROOMS = DOCS / "architecture.md"
sys.path.insert(0, str(DOCS / "site"))
tutorials = import_module("tutorials")

# Training the backbone takes minutes: `make tutorials` runs all of this page.
TUTORIALS = {"your_own_pictures": "seewhy train", "your_own_rules": None, "your_own_robot": None}
_LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)\s]*)?\)")


@pytest.mark.parametrize("page", TUTORIALS)
def test_tutorials_print_what_they_say(page: str, tmp_path: Path) -> None:
    tutorial = tutorials.read_tutorial(DOCS / "start" / f"{page}.md")
    assert len(tutorial.parts) > 4
    differences = list(tutorials.run_tutorial(tutorial, tmp_path, until=TUTORIALS[page]))
    assert not differences, differences[0]


def test_a_tutorial_that_says_otherwise_is_found_out(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        '```python title="one.py"\nprint(1)\n```\n\n```sh\npython one.py\n```\n\n```text\n2\n```\n'
    )
    (difference,) = tutorials.run_tutorial(tutorials.read_tutorial(page), tmp_path)
    assert "python one.py" in difference


def rooms() -> Iterator[tuple[str, str]]:
    """Rooms of a heading of the page, each with a module named below it."""
    _, _, text = ROOMS.read_text(encoding="utf-8").partition("\n## Rooms\n")
    text, _, _ = text.partition("\n## ")
    for section in text.split("\n### ")[1:]:
        heading, _, body = section.partition("\n")
        for name in re.findall(r"`([a-z_]+\.(?:py|toml))`", body):
            if name not in ("domain.toml", "planning.toml"):
                yield heading, name


def test_the_modules_of_the_architecture_are_there() -> None:
    named = list(rooms())
    assert len(named) > 100
    for heading, name in named:
        folders = (
            [ROOT / "src" / "seewhy_lab"]
            if heading == "The laboratory"
            else [ROOT / "src" / "seewhy" / room for room in heading.split(", ")]
        )
        assert any(list(folder.rglob(name)) for folder in folders), f"{heading}: {name}"


def test_the_floors_of_the_architecture_are_those_that_are_held() -> None:
    held = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    layers = held["tool"]["importlinter"]["contracts"][0]["layers"]
    text = ROOMS.read_text(encoding="utf-8")
    rows = re.findall(r"^\| (`.*?`) \|", text.partition("## Floors")[2].partition("\n## ")[0], re.M)
    told = [name for row in rows for name in re.findall(r"`(\w+)`", row)]
    floors = [floor.strip() for layer in layers for floor in layer.split("|")]
    assert told == [floor.removeprefix("seewhy.") for floor in floors]


def test_every_public_name_has_its_place_on_the_page_of_python() -> None:
    text = (DOCS / "python.md").read_text(encoding="utf-8")
    public = {name for name in seewhy.__all__ if not name.startswith("__")}
    assert set(re.findall(r"^::: seewhy\.(\w+)$", text, re.M)) == public


def test_every_page_has_its_place_on_the_site() -> None:
    placed = set(re.findall(r": (\S+\.md)$", (ROOT / "mkdocs.yml").read_text("utf-8"), re.M))
    pages = {str(page.relative_to(DOCS).as_posix()) for page in DOCS.rglob("*.md")}
    made = {"commands.md", "repository/SECURITY.md", "repository/results/comparison/report.md"}
    assert placed == pages | made


@pytest.mark.parametrize(
    "page", [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))], ids=lambda page: page.stem
)
def test_links_lead_somewhere_in_the_repository(page: Path) -> None:
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    for link in _LINK.findall(text):
        if not link.startswith(("http:", "https:")):
            assert (page.parent / link).exists(), f"{page.name}: {link}"


def swallowed_by_lists(text: str) -> Iterator[str]:
    """Commands that a list above them makes text of: four spaces continue its last point."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    in_list = False
    for before, line in pairwise(["", *text.splitlines()]):
        if re.match(r"- |\d+\. ", line):
            in_list = True
        elif line and not line.startswith(" "):
            in_list = False
        elif in_list and not before.strip() and re.match(r" {4}\S", line):
            yield line.strip()


@pytest.mark.parametrize(
    "page", [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))], ids=lambda page: page.stem
)
def test_commands_below_a_list_stand_as_commands(page: Path) -> None:
    assert not list(swallowed_by_lists(page.read_text(encoding="utf-8")))


def test_a_command_that_a_list_swallows_is_found() -> None:
    assert list(swallowed_by_lists("- this\n\n    seewhy --help\n")) == ["seewhy --help"]
    assert not list(swallowed_by_lists("- this\n\nThen:\n\n    seewhy --help\n"))


def test_what_the_site_loads_is_its_own() -> None:
    configuration = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    assert "font: false" in configuration
    assert not re.search(r"https?://", configuration)
    assert all((DOCS / path).is_file() for path in re.findall(r"assets/[\w.-]+", configuration))
