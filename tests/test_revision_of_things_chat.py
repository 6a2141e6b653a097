"""`seewhy chat` on a model of things: rules are revised, kept in the model, and taken back."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from conftest import Run, Shelf

TALK = """\
how many shapes are there?
the rule is wrong
no
it is tidy because a ball lies on a box
yes
no, it is tidy
something is missing
undo that
undo that
no, it is untidy
no, it is tidy
the last one
it is tidy because moo
"""


@pytest.fixture
def model(shelf: Shelf, tmp_path: Path) -> Path:
    return Path(shutil.copytree(shelf.model, tmp_path / "model"))


def test_rules_about_things_are_revised_in_a_talk(run: Run, shelf: Shelf, model: Path) -> None:
    picture = shelf.data / "images" / "003.png"  # a ball lies on a box
    before = (model / "domain" / "knowledge.al").read_text()
    answered = run("chat", model, picture, "--data", shelf.data, stdin=TALK)
    lines = answered.out.splitlines()
    assert lines[0].startswith("There are ")
    assert lines[1].startswith('1. An exception; the rule would read: "the picture is untidy')
    assert "Of 48 annotated pictures, " in lines[1]
    assert "Nothing is changed." in lines
    rule = next(line for line in lines if line.startswith("A new rule: "))
    assert '"if there is a ball that is on a box, then the picture is tidy"' in rule
    assert "To give way to it, a rule would read: " in rule
    at = lines.index('Taken as revision 1; "undo that" takes it back.')
    assert lines[at + 1] == "By the rules, the picture is tidy."
    assert lines[at + 2] == "I take the picture to be tidy, too."
    assert lines[at + 3].startswith('Say what is missing: "it is untidy because there is ')
    assert lines[at + 4].startswith("Taken back: revision 1, ")
    assert lines[at + 5] == "By the rules, the picture is untidy."
    assert lines[at + 6] == "There is nothing to take back."
    assert lines[at + 7] == "I take the picture to be untidy, too."
    assert lines[-2] == 'Taken as revision 2; "undo that" takes it back.'
    assert lines[-1] == "No rule says of which class the picture is."
    assert "'moo' is not understood as a reason" in answered.err
    # The model is whole, and knows what was taken.
    assert run("ask", model, picture, "what is there?").code == 0
    listed = json.loads(run("revisions", model, "--json").out)
    assert [bool(revision["taken_back"]) for revision in listed] == [True, False]
    assert ", not " in (model / "domain" / "knowledge.al").read_text()
    assert "taken back: revision 2" in run("revisions", model, "--undo", 2).out
    assert (model / "domain" / "knowledge.al").read_text() == before
    assert run("ask", model, picture, "what is there?").code == 0


def test_options_that_are_not_for_things_are_refused(run: Run, shelf: Shelf, model: Path) -> None:
    picture = shelf.data / "images" / "003.png"
    refused = run("chat", model, picture, "--gate", "0.5")
    assert refused.code == 2
    assert "--gate is not for pictures of several things" in refused.err
