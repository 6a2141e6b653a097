"""Wrong input gets one clear sentence on standard error, exit code 2 and no traceback."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import Run, draw_tile, write_domain, write_tiles


@pytest.fixture
def place(tmp_path: Path, model_folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with good and bad things by short names, as the working directory."""
    (tmp_path / "model").symlink_to(model_folder)
    draw_tile("red", "yes", 0).save(tmp_path / "tile.png")
    (tmp_path / "empty.png").touch()
    (tmp_path / "text.png").write_text("no picture at all\n" * 10)
    (tmp_path / "cut.png").write_bytes((tmp_path / "tile.png").read_bytes()[:90])
    write_domain(tmp_path / "tiles")
    write_tiles(tmp_path / "data", count=3)
    write_tiles(tmp_path / "one_class", count=1)
    (tmp_path / "broken").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


NEAREST = (
    "ask for instance: what can you say about the tile? · is the tile good? · is the tile bad?"
)
BAD = {
    "ask model nothing.png 'is it good?'": "nothing.png does not exist: check the spelling of the "
    "path, upper and lower case included",
    "ask model empty.png 'is it good?'": "empty.png is empty (0 bytes): copy the picture again "
    "from its source",
    "ask model text.png 'is it good?'": "text.png is not a picture of a known type: save it as "
    "PNG or JPEG",
    "ask model data 'is it good?'": "data is a folder, not a picture: give the path of a picture "
    "file",
    "chat model empty.png": "empty.png is empty (0 bytes): copy the picture again from its source",
    "ask nowhere tile.png 'is it good?'": "nowhere: there is no such model; 'seewhy train' makes "
    "one",
    "ask data tile.png 'is it good?'": "data: is not a model, it has no model.json; give the "
    "folder that 'seewhy train --out' wrote",
    "chat nowhere tile.png": "nowhere: there is no such model; 'seewhy train' makes one",
    "evaluate nowhere --data data": "nowhere: there is no such model; 'seewhy train' makes one",
    "evaluate model --data nowhere": "nowhere: there is no such folder; give one with a scenes.csv",
    "evaluate model --data tiles": "tiles: the folder has no scenes.csv; it lists the pictures "
    "with the columns image, class, colour, round",
    "train tiles --data nowhere --out out": "nowhere: there is no such folder; give one with a "
    "scenes.csv",
    "train tiles --data data --out tiles": "tiles: exists and is not a model; choose another "
    "folder for the model",
    "train tiles --data one_class --out out": "one_class/scenes.csv: the only row is of class "
    "'good'; training needs scenes of at least two classes",
    "train tiles --data data --out out --from nowhere": "nowhere: there is no such model; 'seewhy "
    "train' makes one",
    "train structure_stabilty --data data --out out": "'structure_stabilty' is neither a folder "
    "nor a bundled domain; did you mean 'structure_stability'?",
    "check structurestability": "'structurestability' is neither a folder nor a bundled domain; "
    "did you mean 'structure_stability'?",
    "check broken": "broken: the domain has no domain.toml; a domain is a folder with "
    "domain.toml, knowledge.al, questions.toml ('seewhy new NAME' writes one)",
    "check tiles --data nowhere": "nowhere: there is no such folder; give one with a scenes.csv",
    "ask model tile.png ''": f"the question is empty; {NEAREST}",
    "ask model tile.png '🙂'": "'🙂' has no word in the vocabulary's alphabet; ask for instance",
    "ask model tile.png 'how\nmany [red]:cat: moons?'": "'how many [red]:cat: moons?' is not "
    "understood; ask for instance",
    "ask model tile.png 'is it good?' --picture why.png": "why.png: figures are saved as .svg; "
    "choose a name that ends so",
    "new tiles": "tiles: exists already; choose another name",
    "new My-Domain": "'My-Domain' cannot name a domain; use small letters, digits and "
    "underscores, beginning with a letter",
    "new .": "'' cannot name a domain; use small letters, digits and underscores, beginning with "
    "a letter",
    "new tile.png/domain": "tile.png: File exists; check the path, its rights and the disk",
    "data make tiles --out out --count 3": "the domain 'tiles' has no source of pictures; put "
    "your own pictures beside a scenes.csv, or name a file with a function draw as 'source' in "
    "tiles/domain.toml",
    "data make structure_stability --out out --count 0": "invalid value for '--count': Input "
    "should be greater than or equal to 1; 'seewhy data make --help' says what there is",
    "data make structure_stability --out out --count many": "invalid value for '--count'",
    "data make structure_stability --out out --count 2 --workers 0": "--workers must be -1 or at "
    "least 1, got 0",
    "data make structure_stability --out data --count 2": "data: holds a dataset that was not "
    "made here; choose another folder",
    "data make structure_stability --out tile.png --count 2": "tile.png",
    "data show nowhere": "nowhere: there is no dataset here, a folder with a scenes.csv",
    "data show data": "data/scenes.csv: the columns fit none of the bundled domains",
    "data show data --domain structure_stability": "data/scenes.csv:1: 'colour' is no feature of "
    "the domain 'structure_stability'",
    "frobnicate": "no such command 'frobnicate'; 'seewhy --help' says what there is",
    "clasify model": "no such command 'clasify'; did you mean 'classify'? ('seewhy --help' says "
    "what there is)",
    "ask": "missing argument 'MODEL'; 'seewhy ask --help' says what there is",
    "ask model tile.png 'is it good?' --jsn": "no such option: --jsn",
    "train tiles --data data": "missing option '--out'; 'seewhy train --help' says what there is",
}


@pytest.mark.parametrize("command", BAD)
def test_wrong_input_is_one_sentence(run: Run, place: Path, command: str) -> None:
    before = sorted(place.rglob("*"))
    result = run(*_words(command))
    assert result.code == 2
    assert result.out == ""
    assert result.err.endswith("\n")
    assert result.err.count("\n") == 1
    assert result.err.startswith(f"seewhy: {BAD[command]}")
    assert sorted(place.rglob("*")) == before


def _words(command: str) -> list[str]:
    """The words of a command; a quoted part is one word."""
    parts = command.split("'")
    words: list[str] = []
    for number, part in enumerate(parts):
        words += [part] if number % 2 else part.split()
    return words


@pytest.mark.usefixtures("place")
def test_a_picture_that_is_cut_short(run: Run) -> None:
    result = run("ask", "model", "cut.png", "is it good?")
    assert result.code == 2
    assert result.err.startswith("seewhy: cut.png is ")
    assert result.err.count("\n") == 1


def seewhy(*arguments: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "seewhy.cli.main", *arguments],
        capture_output=True,
        check=False,
        env={**os.environ, **environment},
    )


@pytest.mark.usefixtures("place")
def test_a_name_that_is_no_text() -> None:
    """Names are bytes; those that the terminal cannot show are escaped."""
    found = seewhy("check", os.fsdecode(b"caf\xe9"), PYTHONIOENCODING="utf-8:strict")
    assert (found.returncode, found.stdout) == (2, b"")
    assert found.stderr.decode().startswith("seewhy: 'caf\\udce9' is neither a folder nor a ")


def test_an_encoding_without_our_characters(place: Path) -> None:
    path = place / "tiles" / "domain.toml"
    path.write_text(path.read_text().replace('"Tiles"', '"Größe"'), encoding="utf-8")
    found = seewhy("check", "tiles", PYTHONIOENCODING="ascii")
    assert found.returncode == 0, found.stderr.decode()
    assert found.stdout.decode("ascii").startswith("Gr\\xf6\\xdfe (tiles) in tiles\n")


@pytest.mark.usefixtures("place")
def test_nobody_reads_the_output() -> None:
    """`seewhy … | head -1` ends quietly."""
    found = subprocess.run(
        f"{sys.executable} -m seewhy.cli.main check tiles --json | true",
        shell=True,
        capture_output=True,
        check=False,
    )
    assert b"Traceback" not in found.stderr


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        (
            "domain.toml",
            'scene = "tile"',
            'scene = "tiel"',
            "domain.toml:4: scene = 'tiel' is no sort of knowledge.al; did you mean 'tile'?",
        ),
        (
            "domain.toml",
            "[features.round]",
            "[features.roundd]",
            "domain.toml:",
        ),
        (
            "domain.toml",
            'red = { say = "{it} is red"',
            'read = { say = "{it} is red"',
            "domain.toml:17: 'read' is no value of 'colour' in knowledge.al; did you mean 'red'?",
        ),
        ("domain.toml", "size = 16", "size = 8", "domain.toml:9: 'pictures.size': input should be"),
        ("domain.toml", "[domain]", "[domain", "domain.toml:1:"),
        (
            "questions.toml",
            'feature = "colour"',
            'feature = "color"',
            "questions.toml:23: 'color' is no feature of domain.toml; did you mean 'colour'?",
        ),
        ("knowledge.al", "colour(T, red)", "color(T, red)", "knowledge.al:8:"),
        ("knowledge.al", "good(T) if", "good(T) iff", "knowledge.al:8:"),
    ],
)
def test_a_wrong_domain_is_named_with_its_line(
    run: Run, place: Path, file: str, old: str, new: str, message: str
) -> None:
    path = place / "tiles" / file
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    for command in (("check", "tiles"), ("train", "tiles", "--data", "data", "--out", "out")):
        result = run(*command)
        assert (result.code, result.out) == (2, "")
        assert result.err.startswith(f"seewhy: tiles/{message}"), result.err
        assert result.err.count("\n") == 1
    assert not (place / "out").exists()


DAMAGED = (b"", b"\xff\xfe\x00", b"[[[[", b"\x00")


@pytest.mark.parametrize(
    ("name", "content"),
    [
        (name, content)
        for name in ("domain.toml", "knowledge.al", "questions.toml")
        for content in DAMAGED
        if (name, content) != ("questions.toml", b"")  # the grammar's questions are asked then
    ],
)
def test_a_damaged_domain_is_no_traceback(run: Run, place: Path, name: str, content: bytes) -> None:
    (place / "tiles" / name).write_bytes(content)
    result = run("check", "tiles")
    assert result.code == 2
    assert result.err.count("\n") == 1
    assert result.err.startswith("seewhy: tiles/")


@pytest.mark.usefixtures("place")
def test_a_file_that_may_not_be_written(run: Run) -> None:
    result = run("ask", "model", "tile.png", "is it good?", "--picture", "tile.png/why.svg")
    assert result.code == 2
    assert result.err.count("\n") == 1
    assert "check the path, its rights and the disk" in result.err
