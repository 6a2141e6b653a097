"""Whatever a variable stands for is named by what it is: none is called ``own``."""

from __future__ import annotations

import ast
import doctest
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
FOLDERS = ("src", "benchmarks", "tests")
REFUSED = "own"


def lines_naming(name: str, text: str) -> list[int]:
    """The lines of a module in which something is called so, in examples of docstrings too."""
    return sorted(set(_lines(name, text)))


def _lines(name: str, text: str) -> Iterator[int]:
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant):
            if isinstance(node.value, str) and ">>>" in node.value:
                for example in doctest.DocTestParser().get_examples(node.value):
                    for line in _lines(name, example.source):
                        yield node.lineno + example.lineno + line - 1
        elif any(name == called or name in _listed(called) for _, called in ast.iter_fields(node)):
            yield getattr(node, "lineno", 1)


def _listed(field: object) -> list[object]:
    return field if isinstance(field, list) else []


def places_naming(name: str, folder: str) -> list[str]:
    """FILE:LINE wherever something is called so in the modules of a folder and those below it."""
    return [
        f"{file.relative_to(ROOT).as_posix()}:{line}"
        for file in sorted((ROOT / folder).rglob("*.py"))
        for line in lines_naming(name, file.read_text(encoding="utf-8"))
    ]


@pytest.mark.parametrize("folder", FOLDERS)
def test_nothing_is_called_own(folder: str) -> None:
    found = places_naming(REFUSED, folder)
    assert not found, f"say what it is (scene, axiom, column): {', '.join(found)}"


@pytest.mark.parametrize(
    "code",
    [
        "for own in range(3): pass",
        "[own for own in 'ab']",
        "sorted('ab', key=lambda own: 0)",
        "lengths = f'{len(own)} of {0}'",
        "def mean(own): ...",
        "class Scene:\n    own: int",
        "scene.own = 1",
        "replace(scene, own=1)",
        "import numpy as own",
        "def own(): ...",
        "def count():\n    global own",
        "match 1:\n    case own: ...",
        "try: ...\nexcept ValueError as own: ...",
    ],
)
def test_every_kind_of_name_is_found(code: str) -> None:
    assert lines_naming(REFUSED, code)


def test_an_example_of_a_docstring_is_found_at_its_line() -> None:
    example = f'[{REFUSED} for {REFUSED} in "ab"]'
    code = f'def mean():\n    """Its own mean.\n\n    >>> {example}\n    """\n'
    assert lines_naming(REFUSED, code) == [4]


def test_prose_may_have_the_word() -> None:
    assert lines_naming(REFUSED, '"""A table of its own."""\nsaid = "own"  # its own\n') == []
