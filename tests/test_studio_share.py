"""Share: answers as a file that opens with no network."""

from __future__ import annotations

import re
from pathlib import Path

from fastapi.testclient import TestClient

from studio_tiles import studio_of, tiles_project


def test_answers_are_a_whole_file(
    tmp_path: Path, tiles_data: Path, tiles_folder: Path, model_folder: Path
) -> None:
    folder = tiles_project(
        tmp_path / "project", data=tiles_data, domain=tiles_folder, model=model_folder
    )
    with studio_of(folder) as client:
        nothing = client.get("/share/answers.html?picture=images/000.png")
        assert nothing.status_code == 422
        assert "nothing was asked of images/000.png yet" in nothing.text
        assert client.get("/share/answers.html?picture=../a.png").status_code == 422
        client.get("/ask?picture=images/000.png")
        assert "1 answer about images/000.png" in client.get("/share").text
        kept = is_whole(client, "/share/answers.html?picture=images/000.png", "000.html")
        assert "the tile is good" in kept
        assert "colour: red" in kept
        assert 'href="/evaluate">Evaluate</a>' in client.get("/share").text


def is_whole(client: TestClient, address: str, name: str) -> str:
    """A file to keep, which loads nothing."""
    kept = client.get(address)
    assert kept.status_code == 200, kept.text
    assert kept.headers["Content-Disposition"] == f"attachment; filename*=UTF-8''{name}"
    assert not re.search(r"(src|href)=[\"'](https?:)?//", kept.text)
    assert "<script src" not in kept.text
    return kept.text


def test_without_a_model_there_is_nothing_to_share(tmp_path: Path) -> None:
    with studio_of(tmp_path / "new") as client:
        assert "There is no domain yet" in client.get("/share").text
