"""The way of the README's second section, by the real program: labelled pictures to answers."""

from __future__ import annotations

import csv
import json
import zipfile
from pathlib import Path

import pytest

from conftest import RGB, Run, draw_tile

FEATURES = "class,colour,round\n" + "".join(
    f"{colour}_{shape},{colour},{'yes' if shape == 'disc' else 'no'}\n"
    for colour in RGB
    for shape in ("disc", "square")
)


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ninety tiles in a folder a class, fifteen makers of one of each class."""
    folder = tmp_path_factory.mktemp("first") / "tiles"
    for colour in RGB:
        for shape in ("disc", "square"):
            of_class = folder / f"{colour}_{shape}"
            of_class.mkdir(parents=True)
            for maker in range(15):
                picture = draw_tile(colour, "yes" if shape == "disc" else "no", maker)
                picture.save(of_class / f"{maker:02d}_{colour}.jpg", quality=95)
    file = folder.with_suffix(".zip")
    with zipfile.ZipFile(file, "w") as stream:
        for picture in sorted(folder.rglob("*.jpg")):
            stream.write(picture, picture.relative_to(folder.parent))
    return file


def test_the_first_try(
    archive: Path, tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("features.csv").write_text(FEATURES)
    new = run(
        *("new", "tiles", "--from", archive, "--features", "features.csv", "--data", "data"),
        *("--group", r"^(\d+)_", "--test-share", "0.2", "--subject", "the tile"),
    )
    assert new.code == 0, new.err
    assert "6 classes and 2 features, 6 axioms" in new.out
    rows = list(csv.DictReader(Path("data/scenes.csv").read_text().splitlines()))
    makers = {row["group"] for row in rows if row["split"] == "test"}
    assert {row["group"] for row in rows if row["split"] == "train"}.isdisjoint(makers)
    checked = run("check", "tiles", "--data", "data")
    assert (checked.code, checked.out.splitlines()[-1]) == (0, "nothing is wrong")
    assert run("data", "show", "data", "--domain", "tiles", "--out", "sheet.png").code == 0

    trained = run("train", "tiles", "--data", "data", "--out", "model")
    assert trained.code == 0, trained.err
    assert "tuned layers" in trained.out
    assert "the knowledge decides all" in trained.out

    evaluated = run("evaluate", "model", "--data", "data", "--page", "page.html", "--json")
    figures = json.loads(evaluated.out)
    assert figures["classification_accuracy"] == 1.0
    assert Path("page.html").read_text(encoding="utf-8").startswith("<!doctype html>")

    picture = next(f"data/{row['image']}" for row in rows if row["class"] == "red_disc")
    asked = run("ask", "model", picture, "why is it a red disc?", "--picture", "answer.svg")
    assert asked.code == 0, asked.err
    answer = asked.out.splitlines()[0]
    assert "colour" in answer
    assert "red" in answer
    assert "<svg" in Path("answer.svg").read_text(encoding="utf-8")

    learned = run("learn", "model", "--data", "data", "--yes")
    assert learned.code == 0, learned.err
    assert "no axiom is to be learned from these pictures" in learned.out
