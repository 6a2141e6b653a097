"""Words of a domain that cannot be said, asked or told apart are refused with their place."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from seewhy.check.domain import check_domain
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import load_domain
from seewhy.domain.folder import domain_folder
from seewhy.errors import QuestionError, SeeWhyError


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return Path(shutil.copytree(domain_folder("structure_stability"), tmp_path / "blocks"))


@pytest.mark.parametrize(
    ("file", "before", "after", "error"),
    [
        (
            "questions.toml",
            '"is {it} {class}",',
            '"is {it} {colour} {class}",',
            "questions.toml:#: 'is {it} {colour} {class}' has a slot that does not exist; there "
            "are {it}, {class} and {value}",
        ),
        (
            "questions.toml",
            '"is {it} {class}",',
            '"is {it] {class}",',
            "questions.toml:#: 'is {it] {class}' has a slot that does not exist; there are {it}, "
            "{class} and {value}",
        ),
        (
            "questions.toml",
            '"is {it} {class}",',
            '"is [it {class}",',
            "questions.toml:#: the brackets of 'is [it {class}' do not pair; [...] is what may be "
            "left out",
        ),
        (
            "domain.toml",
            'say = "{it} has one block"',
            'say = "{foo} has one block"',
            "domain.toml:#: 'features.num_blocks.values.1.say': {it} is the only slot that there "
            "is, got '{foo} has one block'",
        ),
        (
            "domain.toml",
            'words = ["narrow"]',
            'words = ["!!"]',
            "domain.toml:#: 'features.base.values.narrow.words.0': must have a letter or a digit, "
            "got '!!'",
        ),
        (
            "domain.toml",
            'words = ["narrow"]',
            'words = ["Wide"]',
            "domain.toml:#: 'Wide' stands for 'narrow' and for 'wide'; let it stand for one",
        ),
        (
            "domain.toml",
            'words = ["stable", "steady"]',
            'words = ["stable", "unsteady"]',
            "domain.toml:#: 'unsteady' stands for 'unstable' and for 'stable'; let it stand for "
            "one",
        ),
        (
            "domain.toml",
            "seewhy_lab.simulators.structure_stability.source",
            "nowhere.py",
            "domain.toml: source = 'nowhere.py' must be a file of this folder that has a function "
            "draw(seed=, index=, size=) (No such file or directory)",
        ),
    ],
)
def test_words_that_cannot_be_used(
    folder: Path, file: str, before: str, after: str, error: str
) -> None:
    text = (folder / file).read_text()
    assert before in text
    (folder / file).write_text(text.replace(before, after, 1))
    with pytest.raises(SeeWhyError) as problem:
        check_domain(load_domain(folder))
    found = str(problem.value).removeprefix(f"{folder}/")
    start, _, rest = found.partition(": ")
    if "#" in error:
        assert start.startswith(file)
        assert int(start.rsplit(":", 1)[1]) > 1
        assert rest == error.partition(": ")[2]
    else:
        assert found.startswith(error)


def test_knowledge_without_any_answer_set(folder: Path) -> None:
    path = folder / "knowledge.al"
    text = path.read_text().replace("#static stable", "#static odd(structure).\n#static stable", 1)
    path.write_text(f"{text}\nodd(S) if structure(S), not odd(S).\n")
    line = len(path.read_text().splitlines())
    with pytest.raises(SeeWhyError) as problem:
        check_domain(load_domain(folder))
    assert str(problem.value) == (
        f"{folder}/knowledge.al:{line}:1: 'odd(S) if structure(S), not odd(S).' (line {line}) "
        "needs, through 'not', that its own conclusion is not believed, so that no picture has an "
        "answer set"
    )


@pytest.mark.parametrize(
    "text", ["what would not make it stable", "are there -3 blocks", "is the table stable"]
)
def test_near_questions_that_ask_something_else_are_asked_back(text: str) -> None:
    with pytest.raises(QuestionError):
        Questions(load_domain("structure_stability")).understand(text)
