"""Any bytes are read or refused with a sentence: a short run, the long one is run.py beside."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from readers import TARGETS, Target, inputs, surroundings

from seewhy.errors import SeeWhyError

NAMED = {target.name: target for target in TARGETS}


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return surroundings(tmp_path_factory.mktemp("fuzz"))


@pytest.mark.parametrize("name", NAMED)
def test_the_corpus_is_read(name: str, home: Path) -> None:
    """What the test below changes is right before it is changed."""
    corpus = NAMED[name].corpus()
    assert corpus
    for content in corpus:
        assert NAMED[name].survive(content, home) == ""


@pytest.mark.parametrize("name", NAMED)
@settings(max_examples=30, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_any_bytes(name: str, data: st.DataObject, home: Path) -> None:
    NAMED[name].survive(data.draw(inputs(NAMED[name].corpus())), home)


def test_what_is_found(home: Path) -> None:
    """Whatever is no sentence is found: another error, several lines, the text of an exception."""

    def decode(file: Path, _: Path) -> None:
        text = file.read_bytes().decode()
        if text:
            raise SeeWhyError(text)

    target = Target("wrong", ("label.txt",), "x.txt", decode)
    assert target.survive(b"x: is wrong; correct it", home) == "x: is wrong; correct it"
    for content in (b"\xff", b"x: is\nwrong", b"ValueError: is wrong"):
        with pytest.raises((AssertionError, UnicodeDecodeError)):
            target.survive(content, home)
