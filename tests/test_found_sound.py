"""What was checked and found sound is not checked again; what cannot be kept is."""

from __future__ import annotations

from pathlib import Path

import pytest

from knowledge_builders import schema_of
from seewhy.errors import KnowledgeError
from seewhy.files import found_sound
from seewhy.files.cache_folder import FOLDER
from seewhy.files.found_sound import FoundSound
from seewhy.knowledge import consistency
from seewhy.knowledge.language import read_knowledge

KNOWLEDGE = """\
#sort tile.
#static marked_twice_over(tile).
#static good(tile).
good(T) if marked_twice_over(T).
"""


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(FOLDER, str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_another_process_knows(cache: Path) -> None:
    FoundSound("a check 1").add("text")
    assert "text" in FoundSound("a check 1")
    assert "text" not in FoundSound("a check 2")
    assert "another text" not in FoundSound("a check 1")
    assert [file.stat().st_size for file in (cache / "sound").iterdir()] == [0]


def test_nothing_is_kept_where_there_is_no_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(FOLDER, "")
    sound = FoundSound("a check 1")
    sound.add("text")
    assert "text" in sound
    assert "text" not in FoundSound("a check 1")


def test_a_folder_that_cannot_be_written_is_in_nobodys_way(
    cache: Path, caplog: pytest.LogCaptureFixture
) -> None:
    cache.write_text("no folder", encoding="utf-8")
    sound = FoundSound("a check 1")
    sound.add("text")
    assert "text" in sound
    assert "what was checked cannot be kept" in caplog.text


def test_what_is_kept_does_not_grow_without_end(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(found_sound, "_AT_MOST", 4)
    for number in range(20):
        FoundSound("a check 1").add(f"text {number}")
        assert len(list((cache / "sound").iterdir())) <= 4
    assert "text 19" in FoundSound("a check 1")


def test_sound_knowledge_is_grounded_once(monkeypatch: pytest.MonkeyPatch) -> None:
    knowledge = read_knowledge(KNOWLEDGE)
    schema = schema_of(knowledge, ["marked_twice_over"], {"good": "good(tile)"}, scene="tile")
    consistency.check_consistency(knowledge, schema)

    def grounded(*_: object, **__: object) -> None:
        raise AssertionError("grounded again")

    wrong = read_knowledge(f"{KNOWLEDGE}-good(T) if marked_twice_over(T).\n")
    for _ in range(2):  # what is refused is refused again
        with pytest.raises(KnowledgeError, match="can never be used"):
            consistency.check_consistency(wrong, schema)
    monkeypatch.setattr(consistency, "Grounding", grounded)
    consistency.check_consistency(knowledge, schema)
