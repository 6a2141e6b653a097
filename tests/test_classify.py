"""`seewhy classify` from the outside: tables of many pictures, interruptions, damaged files."""

from __future__ import annotations

import csv
import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from conftest import Run, draw_tile
from seewhy import classify_pictures
from seewhy.agent.agent import Agent
from seewhy.classification.rows import columns_of
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import SeeWhyError
from seewhy.induction.tree import DecisionTree

CUT_SHORT = "is damaged or cut short"


@pytest.fixture
def photos(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with three tiles, one of them below it, a damaged file, and what is no picture."""
    monkeypatch.chdir(tmp_path)
    folder = Path("photos")
    (folder / "more").mkdir(parents=True)
    draw_tile("blue", "no", 1).save(folder / "a.png")
    draw_tile("red", "yes", 2).save(folder / "c.png")
    draw_tile("green", "no", 3).save(folder / "more" / "d.jpg", quality=95)
    (folder / "b.png").write_bytes((folder / "a.png").read_bytes()[:150])
    (folder / "notes.txt").write_text("about the photos")
    return folder


@pytest.fixture
def many(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of 300 tiles, which are three batches."""
    monkeypatch.chdir(tmp_path)
    return links("many", 300)


def links(name: str, count: int) -> Path:
    """A folder of so many tiles, of six kinds."""
    folder = Path(name)
    folder.mkdir()
    for number in range(6):
        draw_tile(("red", "green", "blue")[number % 3], ("yes", "no")[number // 3], number).save(
            folder / f"{number:04d}.png"
        )
    for number in range(6, count):
        os.link(folder / f"{number % 6:04d}.png", folder / f"{number:04d}.png")
    return folder


def cells(table: Path) -> list[dict[str, str]]:
    with table.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


# Tables ----------------------------------------------------------------------------------------

GOLDEN = """\
image,class,probability,method,verdict,colour,colour_probability,round,round_probability,\
reasons,problem
photos/a.png,bad,#,knowledge,believed,blue,#,no,#,"The tile is blue, and it has corners.",
photos/b.png,,,,,,,,,,photos/b.png is damaged or cut short (…)
photos/c.png,good,#,knowledge,believed,red,#,yes,#,The tile is red.,
photos/more/d.jpg,bad,#,tree,silent,green,#,no,#,"The tile is green, and it has corners.",
"""


def test_a_folder_becomes_a_table(run: Run, model_folder: Path, photos: Path) -> None:
    result = run("classify", model_folder, photos, "--out", "table.csv")
    assert result.code == 0
    assert result.out == "4 pictures: good 1, bad 2, not read 1\ntable: table.csv\n"
    assert re.sub(r"\(.*\)", "(…)", result.err) == (
        "1 of 4 pictures could not be read; the column 'problem' says why:\n"
        "  photos/b.png is damaged or cut short (…): copy the picture again from its source\n"
    )
    text = re.sub(r"\b[01]\.\d+", "#", Path("table.csv").read_text())
    # How sure the networks are is not settled here.
    text = re.sub("(Probably|Perhaps) because the", "The", text)
    assert re.sub(r"\(.*\): .*", "(…)", text) == GOLDEN
    assert not Path("table.csv.part").exists()


def test_json_holds_the_same_as_csv(run: Run, model_folder: Path, photos: Path) -> None:
    run("classify", model_folder, photos, "--out", "table.csv")
    result = run("classify", model_folder, photos, "--out", "deep/table.json", "--json")
    assert json.loads(result.out) == {
        "table": "deep/table.json",
        "pictures": 4,
        "classes": {"good": 1, "bad": 2},
        "no_class": 0,
        "problems": 1,
    }
    rows = json.loads(Path("deep/table.json").read_text())
    said = [{key: "" if cell is None else str(cell) for key, cell in row.items()} for row in rows]
    assert said == cells(Path("table.csv"))
    assert 0.5 < rows[0]["probability"] <= 1.0
    assert rows[1]["class"] is None


def test_parquet_holds_the_same_as_json(run: Run, model_folder: Path, photos: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="the extra 'tables' is not installed")
    for name in ("table.json", "table.parquet"):
        assert run("classify", model_folder, photos, "--out", name).code == 0
    rows = parquet.read_table("table.parquet").to_pylist()
    assert rows == json.loads(Path("table.json").read_text())


def test_reasons_are_what_the_agent_answers(run: Run, model_folder: Path, many: Path) -> None:
    agent = Agent.load(model_folder)
    run("classify", model_folder, many, "--out", "table.csv")
    for row in cells(Path("table.csv"))[:6]:
        reply = agent.ask(row["image"], f"why is it {row['class']}?")
        assert (row["reasons"], row["method"]) == (reply.text, reply.method)
        assert row["probability"] == str(round(reply.classification.probability or 0.0, 4))


LEAF = (
    "Of the tiles that no rule decides, if the tile has corners, then it is bad "
    "(1 of 2 features tested, 100 % of 9 tiles)."
)
NOTHING = (
    "I cannot tell whether the tile is good or bad: the knowledge does not decide, and there was "
    "nothing to learn it from."
)


def without_answers(folder: Path) -> Agent:
    agent = Agent.load(folder)
    agent.answerer = None
    return agent


def without_tree(folder: Path) -> Agent:
    agent = without_answers(folder)
    agent.tree = DecisionTree(agent.tree.features)
    return agent


def without_questions(folder: Path) -> Agent:
    agent = Agent.load(folder)
    agent.questions.one_of_each = lambda: ()  # type: ignore[method-assign]
    return agent


@pytest.mark.parametrize(
    ("agent_of", "label", "reasons"),
    [
        (
            without_answers,
            "bad",
            LEAF,
        ),
        (
            without_questions,
            "bad",
            LEAF,
        ),
        (
            without_tree,
            None,
            NOTHING,
        ),
    ],
)
def test_reasons_where_nothing_answers(
    model_folder: Path, photos: Path, agent_of: object, label: str | None, reasons: str
) -> None:
    agent = agent_of(model_folder)  # type: ignore[operator]
    ((found,),) = classify_pictures(agent, [photos / "more/d.jpg"])
    assert found.classification is not None
    assert found.classification.label == label
    assert found.reasons == reasons


def test_pictures_that_are_not_known(model_folder: Path, photos: Path) -> None:
    agent = Agent.load(model_folder, known_share=0.9)
    agent.validation_scores = {agent.reading: [1000.0] * 50}
    ((found,),) = classify_pictures(agent, [photos / "a.png"])
    assert found.reasons == "I don't know: the picture shows no tile that I know."
    assert found.classification is not None
    assert (found.classification.label, found.classification.verdict) == (None, "unknown")


def test_features_that_are_called_like_columns(tiles_folder: Path, tmp_path: Path) -> None:
    folder = shutil.copytree(tiles_folder, tmp_path / "tiles")
    for name in ("domain.toml", "knowledge.al", "questions.toml"):
        text = (folder / name).read_text()
        text = text.replace("features.colour", "features.method").replace("colour(", "method(")
        (folder / name).write_text(text.replace('feature = "colour"', 'feature = "method"'))
    names = [column.name for column in columns_of(load_domain(folder))]
    assert names[3:7] == ["method", "verdict", "feature_method", "feature_method_probability"]
    assert len(set(names)) == len(names)


def test_help(run: Run) -> None:
    result = run("classify", "--help")
    assert (result.code, result.err) == (0, "")
    assert "Classify many pictures: a table with classes, probabilities" in result.out


# Which pictures --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("named", "images"),
    [
        (["photos/c.png", "photos/a.png"], ["photos/c.png", "photos/a.png"]),
        (["photos/*"], ["photos/a.png", "photos/b.png", "photos/c.png", "photos/more/d.jpg"]),
        (["photos/**/*.jpg"], ["photos/more/d.jpg"]),
        (["photos/c.png", "photos/?.png"], ["photos/c.png", "photos/a.png", "photos/b.png"]),
        (["photos/notes.txt", "photos/a.png"], ["photos/notes.txt", "photos/a.png"]),
    ],
)
def test_what_is_meant(
    run: Run, model_folder: Path, photos: Path, named: list[str], images: list[str]
) -> None:
    assert photos.is_dir()
    assert run("classify", model_folder, *named, "--out", "table.csv").code == 0
    assert [row["image"] for row in cells(Path("table.csv"))] == images


def test_a_file_whose_name_looks_like_a_pattern(run: Run, model_folder: Path, photos: Path) -> None:
    (photos / "a.png").rename(photos / "[a]*.png")
    assert run("classify", model_folder, photos / "[a]*.png", "--out", "t.csv").code == 0
    assert [row["image"] for row in cells(Path("t.csv"))] == ["photos/[a]*.png"]


def test_a_name_that_is_no_text(run: Run, model_folder: Path, photos: Path) -> None:
    (photos / "a.png").rename(photos / os.fsdecode(b"caf\xe9.png"))
    for name in ("t.csv", "t.json"):
        assert run("classify", model_folder, photos, "--out", name).code == 0
    assert cells(Path("t.csv"))[2]["image"] == "photos/caf\\xe9.png"
    assert json.loads(Path("t.json").read_text())[2]["image"] == "photos/caf\\xe9.png"


TABLE = """\
image;class;operator
a.png;;Ann
c.png;good;Bob
more/d.jpg;;Ann
"""


@pytest.mark.parametrize(
    ("options", "images", "said"),
    [
        ([], ["a.png", "more/d.jpg"], "rows that have a class are left out (1); --all "),
        (["--all"], ["a.png", "c.png", "more/d.jpg"], ""),
    ],
)
@pytest.mark.parametrize("name", ["scenes.csv", "others.csv"])
def test_tables(
    run: Run,
    model_folder: Path,
    photos: Path,
    name: str,
    options: list[str],
    images: list[str],
    said: str,
) -> None:
    """A folder with a scenes.csv is a dataset; in tables, what has no class is meant."""
    (photos / name).write_text(TABLE)
    named = photos if name == "scenes.csv" else photos / name
    result = run("classify", model_folder, named, "--out", "t.csv", *options)
    assert (result.code, result.err[: len(said)]) == (0, said)
    assert [row["image"] for row in cells(Path("t.csv"))] == [f"photos/{image}" for image in images]


def test_a_table_may_name_pictures_elsewhere(run: Run, model_folder: Path, photos: Path) -> None:
    Path("tables").mkdir()
    Path("tables/t.csv").write_text("image\n../photos/a.png\n")
    result = run("classify", model_folder, "tables/t.csv", "--out", "t.csv")
    assert result.code == 2
    assert result.err.startswith("seewhy: tables/t.csv:2: the picture '../photos/a.png' lies outsi")
    assert photos.is_dir()
    assert run("classify", model_folder, "tables/t.csv", "--out", "t.csv", "--outside").code == 0
    assert cells(Path("t.csv"))[0]["class"] == "bad"


def test_links_out_of_a_folder(run: Run, model_folder: Path, photos: Path) -> None:
    Path("secret").mkdir()
    (photos / "a.png").rename("secret/a.png")
    (photos / "link.png").symlink_to("../secret/a.png")
    (photos / "way").symlink_to("../secret")
    result = run("classify", model_folder, "photos", "--out", "t.csv")
    assert (
        "links that lead out of the folder, left out (--outside follows them) (2): " in result.err
    )
    assert len(cells(Path("t.csv"))) == 3
    result = run("classify", model_folder, "photos", "--out", "t.csv", "--outside")
    assert "links that lead out" not in result.err
    assert len(cells(Path("t.csv"))) == 5


@pytest.mark.parametrize(
    ("named", "out", "said"),
    [
        ("photos", "t.xls", "t.xls: must end in .csv, .json or .parquet; name it otherwise"),
        ("photos", "t", "t: must end in .csv, .json or .parquet; name it otherwise"),
        ("photos", "folder.csv", "folder.csv: is a folder; name a file for the table"),
        (
            "empty",
            "t.csv",
            "empty: holds no picture (.jpg, .png and others); name the folder that holds the "
            "pictures, or their files",
        ),
        (
            "photos/*.jgp",
            "t.csv",
            "photos/*.jgp: nothing fits the pattern; try it with ls, and put it in quotes if the "
            "shell changes it",
        ),
        (
            "photos/*.txt",
            "t.csv",
            "photos/*.txt: nothing that fits the pattern is a picture; try it with ls, and put it "
            "in quotes if the shell changes it",
        ),
        (
            "nowhere",
            "t.csv",
            "nowhere: there is no such picture, folder or table; check the spelling of the path",
        ),
        ("t.xlsx", "t.csv", "t.xlsx: is no picture, it is a table; save it as CSV"),
        (
            "t.zip",
            "t.csv",
            "t.zip: is no picture, it is an archive; unpack it and name the folder",
        ),
        (
            "photos/all.csv",
            "t.csv",
            "photos/all.csv: every row has a class, so that there is nothing to classify; --all "
            "(in Python: with_class=True) classifies these pictures, too",
        ),
        (
            "photos/gone.csv",
            "t.csv",
            "photos/gone.csv:2: there is no picture 'gone.png' in photos; correct the path or "
            "remove the row",
        ),
    ],
)
def test_one_sentence(
    run: Run, model_folder: Path, photos: Path, named: str, out: str, said: str
) -> None:
    for folder in ("empty", "folder.csv"):
        Path(folder).mkdir()
    for name in ("t.xlsx", "t.zip"):
        Path(name).touch()
    (photos / "all.csv").write_text("image,class\na.png,bad\n")
    (photos / "gone.csv").write_text("image\ngone.png\n")
    result = run("classify", model_folder, named, "--out", out)
    assert (result.code, result.out, result.err) == (2, "", f"seewhy: {said}\n")


def test_the_table_of_the_pictures_is_not_overwritten(
    run: Run, model_folder: Path, photos: Path
) -> None:
    (photos / "scenes.csv").write_text(TABLE)
    result = run("classify", model_folder, photos, "--out", photos / "more/../scenes.csv")
    assert (result.code, result.err) == (
        2,
        "seewhy: photos/more/../scenes.csv: is the table that names the pictures; name another for "
        "--out\n",
    )
    assert (photos / "scenes.csv").read_text() == TABLE


def test_parquet_without_its_library(
    run: Run, model_folder: Path, photos: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    result = run("classify", model_folder, photos, "--out", "t.parquet")
    assert (result.code, result.err) == (
        2,
        "seewhy: t.parquet: parquet tables need the package pyarrow; install it with "
        "pip install 'seewhy[tables]', or end the name in .csv\n",
    )


def test_no_picture_can_be_read(run: Run, model_folder: Path, photos: Path) -> None:
    result = run("classify", model_folder, photos / "b.png", photos / "notes.txt", "--out", "t.csv")
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith(
        "seewhy: t.csv: none of 2 pictures could be read, its column 'problem' says why; the first:"
        " photos/b.png is damaged or cut short"
    )
    assert result.err.count("\n") == 1
    assert [bool(row["problem"]) for row in cells(Path("t.csv"))] == [True, True]


# Interruptions ---------------------------------------------------------------------------------


def interrupted(run: Run, model: Path, pictures: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Classify two of three batches and be interrupted."""
    calls: Iterator[bool] = iter([False, False, True])
    whole = Agent.classify_all

    def classify_all(self: Agent, pixels: object) -> object:
        if next(calls):
            raise KeyboardInterrupt
        return whole(self, pixels)  # type: ignore[arg-type]

    with monkeypatch.context() as patch:
        patch.setattr(Agent, "classify_all", classify_all)
        result = run("classify", model, pictures, "--out", "t.csv")
    assert result.code == 130
    assert not Path("t.csv").exists()
    assert len(Path("t.csv.part").read_text().splitlines()) == 257


def test_an_interrupted_run_goes_on(
    run: Run, model_folder: Path, many: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run("classify", model_folder, many, "--out", "whole.csv")
    interrupted(run, model_folder, many, monkeypatch)
    part = Path("t.csv.part")
    part.write_bytes(part.read_bytes()[:-20])  # as a kill leaves it
    result = run("classify", model_folder, many, "--out", "t.csv")
    assert (result.code, result.err) == (
        0,
        "255 of 300 pictures are classified already (t.csv.part)\n",
    )
    assert Path("t.csv").read_bytes() == Path("whole.csv").read_bytes()
    assert not part.exists()


def another_model(model: Path, _: Path) -> tuple[Path, list[str]]:
    agent = Agent.load(model)
    agent.without = ("good",)
    agent.save("other")
    return Path("other"), []


def other_pictures(model: Path, pictures: Path) -> tuple[Path, list[str]]:
    (pictures / "0299.png").unlink()
    return model, []


def a_picture_that_changed(model: Path, pictures: Path) -> tuple[Path, list[str]]:
    (pictures / "0010.png").unlink()
    draw_tile("red", "no", 4, size=80).save(pictures / "0010.png")
    return model, []


def other_options(model: Path, _: Path) -> tuple[Path, list[str]]:
    return model, ["--reading", "consistent"]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (another_model, "another model"),
        (other_pictures, "other pictures"),
        (a_picture_that_changed, "other pictures"),
        (other_options, "other options"),
    ],
)
def test_what_else_is_classified_begins_anew(
    run: Run,
    model_folder: Path,
    many: Path,
    monkeypatch: pytest.MonkeyPatch,
    change: object,
    said: str,
) -> None:
    interrupted(run, model_folder, many, monkeypatch)
    model, options = change(model_folder, many)  # type: ignore[operator]
    result = run("classify", model, many, "--out", "t.csv", *options)
    assert (result.code, result.err) == (
        0,
        f"t.csv.part held rows of {said}; classifying begins anew\n",
    )
    assert len(cells(Path("t.csv"))) == len(list(many.iterdir()))


@pytest.mark.parametrize("content", ["", "nonsense", '{"format": 1', "[" * 100_000 + "\n"])
def test_a_file_that_is_no_unfinished_table(
    run: Run, model_folder: Path, photos: Path, content: str
) -> None:
    Path("t.csv.part").write_text(content)
    assert run("classify", model_folder, photos / "a.png", "--out", "t.csv").err == ""
    assert len(cells(Path("t.csv"))) == 1


def test_a_killed_program_goes_on(
    run: Run, model_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    folder = links("thousands", 4000)
    program = [sys.executable, "-m", "seewhy.cli.main", "classify", str(model_folder), str(folder)]
    running = subprocess.Popen([*program, "--out", "t.csv"], stderr=subprocess.DEVNULL)
    part = Path("t.csv.part")
    while running.poll() is None and not (part.exists() and part.stat().st_size > 10_000):
        time.sleep(0.002)
    running.kill()
    assert running.wait() != 0
    assert not Path("t.csv").exists()
    result = run("classify", model_folder, folder, "--out", "t.csv")
    (done,) = re.findall(r"^([\d,]+) of 4,000 pictures are classified already", result.err)
    assert 0 < int(done.replace(",", "")) < 4000
    rows = cells(Path("t.csv"))
    assert [row["image"] for row in rows] == [f"thousands/{n:04d}.png" for n in range(4000)]
    kinds = [(row["class"], row["colour"], row["round"]) for row in rows]
    assert kinds == kinds[:6] * 666 + kinds[:4]


# In Python -------------------------------------------------------------------------------------


def test_pictures_are_read_when_they_are_needed(model_folder: Path, many: Path) -> None:
    """Of any number of pictures, two batches are in the memory."""
    taken = []

    def endless() -> Iterator[Path]:
        while True:
            taken.append(1)
            yield many / "0001.png"

    found = classify_pictures(Agent.load(model_folder), endless(), batch=32)
    for _ in range(3):
        assert len(next(found)) == 32
    assert len(taken) <= 4 * 32
    found.close()  # type: ignore[attr-defined]


def test_an_agent_that_is_not_trained(tiles: Domain, photos: Path) -> None:
    assert Questions(tiles).one_of_each()
    with pytest.raises(SeeWhyError, match="the agent is not trained yet"):
        list(classify_pictures(Agent(tiles), [photos / "a.png"]))
