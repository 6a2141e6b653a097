"""Tables of a user's own through the program: what is read, left out, remarked on, refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from conftest import TRUTH, Run, draw_tile, write_domain, write_tiles
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.evaluation import evaluate

KINDS = list(TRUTH)


def write_table(folder: Path, rows: list[str], *, head: str = "image,class,colour,round") -> Path:
    """Write pictures of tiles, a different one a row, and a table that calls them N.png."""
    folder.mkdir()
    for number in range(len(rows)):
        colour, is_round = KINDS[number % 6]
        image = draw_tile(colour, is_round, number)
        image.putpixel((0, 0), (number, number, number))
        image.save(folder / f"{number}.png")
    (folder / "scenes.csv").write_text("\n".join([head, *rows]) + "\n")
    return folder


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    write_domain(tmp_path / "tiles")
    monkeypatch.chdir(tmp_path)
    return tmp_path


TOO_LITTLE = {
    "one class": (
        ["0.png,good,red,yes", "1.png,good,red,no"],
        "data/scenes.csv: all 2 rows are of class 'good'; training needs scenes of at least two "
        "classes",
    ),
    "one picture a class": (
        ["0.png,good,red,yes", "1.png,bad,red,no"],
        "data/scenes.csv: every class has one picture only; training needs several of each that "
        "show different things, a few dozen if you can",
    ),
    "no class": (
        ["0.png,,red,yes", "1.png,,red,no"],
        "data/scenes.csv: no row has a class; fill the column 'class' of pictures of at least two "
        "classes, a few dozen of each if you can",
    ),
    "a feature that nobody labelled": (
        ["0.png,good,red,", "1.png,bad,red,", "2.png,bad,green,"],
        "data/scenes.csv: no row has a value of 'round', which training needs; fill the column "
        "'round', or remove the feature from the domain",
    ),
}


@pytest.mark.parametrize("kind", TOO_LITTLE)
def test_training_with_too_little(run: Run, here: Path, kind: str) -> None:
    rows, expected = TOO_LITTLE[kind]
    write_table(here / "data", rows)
    result = run("train", "tiles", "--data", "data", "--out", "model")
    assert (result.code, result.out, result.err) == (2, "", f"seewhy: {expected}\n")
    assert sorted(path.name for path in here.iterdir()) == ["data", "tiles"]


def test_one_picture_in_both_splits_proves_nothing(
    run: Run, here: Path, model_folder: Path
) -> None:
    rows = [f"0.png,good,red,yes,{split}" for split in ("train", "test")]
    write_table(here / "data", rows, head="image,class,colour,round,split")
    expected = (
        "seewhy: data/scenes.csv: 1 test row is of pictures that are trained on, too (line 3 as "
        "line 2), left out of evaluation, and nothing is left; give the split 'test' pictures of "
        "its own\n"
    )
    result = run("evaluate", model_folder, "--data", "data")
    assert (result.code, result.out, result.err) == (2, "", expected)
    result = run("learn", model_folder, "--data", "data", "--json")
    assert result.code == 0  # it needs no test pictures
    assert result.err.splitlines()[-1] == (
        "1 picture is too few to hold some back: nothing judges what is proposed"
    )


def test_contradictory_rows_end_every_command(run: Run, here: Path, model_folder: Path) -> None:
    write_table(here / "data", ["0.png,good,red,yes", "1.png,bad,red,no"])
    (here / "data" / "1.png").write_bytes((here / "data" / "0.png").read_bytes())
    expected = (
        "seewhy: data/scenes.csv:3: the picture '1.png', which is '0.png' of line 2 once more, has "
        "class 'bad' here and 'good' there; correct or remove one of the two rows\n"
    )
    for command in (
        ("train", "tiles", "--data", "data", "--out", "model"),
        ("evaluate", model_folder, "--data", "data"),
        ("learn", model_folder, "--data", "data"),
        ("check", "tiles", "--data", "data"),
    ):
        result = run(*command)
        assert (result.code, result.out, result.err) == (2, "", expected), command


def test_pictures_outside_only_with_the_option(run: Run, here: Path, model_folder: Path) -> None:
    write_table(here / "elsewhere", ["0.png,good,red,yes", "1.png,good,red,no"])
    (here / "data").mkdir()
    (here / "data" / "scenes.csv").write_text(
        "image,class,colour,round\n../elsewhere/0.png,good,red,yes\n../elsewhere/1.png,good,red,no\n"
    )
    commands = (
        ("train", "tiles", "--data", "data", "--out", "model"),
        ("evaluate", model_folder, "--data", "data"),
        ("learn", model_folder, "--data", "data", "--yes"),
        ("check", "tiles", "--data", "data"),
        ("data", "show", "data", "--domain", "tiles"),
    )
    for command in commands:
        result = run(*command)
        assert (result.code, result.out) == (2, ""), command
        assert result.err == (
            "seewhy: data/scenes.csv:2: the picture '../elsewhere/0.png' lies outside of data; "
            "copy it into the folder, or allow it with --outside (in Python: outside=True)\n"
        )
    for command in (commands[1], *commands[3:]):
        assert run(*command, "--outside").code == 0, command


def test_looking_at_a_table_that_names_only_pictures(run: Run, here: Path) -> None:
    write_table(here / "data", ["0.png", "1.png"], head="image")
    result = run("data", "show", "data", "--domain", "tiles")
    assert result.code == 0
    assert result.out.splitlines()[0] == "2 pictures, none of them with a class"
    record = json.loads(run("data", "show", "data", "--domain", "tiles", "--json").out)
    assert (record["scenes"], record["without_class"], record["determined"]) == (2, 2, None)
    for command in (("check", "tiles"),):
        result = run(*command, "--data", "data")
        assert (result.code, result.out) == (2, "")
        assert result.err == (
            "seewhy: data/scenes.csv: no row has a class, by which axioms are judged; fill the "
            "column 'class'\n"
        )


def test_looking_at_a_table_with_some_classes(run: Run, here: Path) -> None:
    rows = ["0.png,good,red,yes", "1.png,,red,no", "2.png,bad,green,no"]
    write_table(here / "data", rows)
    result = run("data", "show", "data", "--domain", "tiles")
    assert result.out.splitlines()[0] == (
        "2 pictures (good 50.0 %, bad 50.0 %); 100.0 % determined by their features, and 1 without "
        "a class"
    )


def test_evaluating_pictures_without_a_class(
    run: Run, here: Path, model_folder: Path, agent: Agent, tiles: Domain
) -> None:
    rows = [
        f"{n}.png,{'' if n % 2 else TRUTH[kind]},{','.join(kind)}" for n, kind in enumerate(KINDS)
    ]
    write_table(here / "data", rows)
    result = run("evaluate", model_folder, "--data", "data", "--json")
    assert result.code == 0
    assert (
        "3 more pictures have no class: they count for the features that they are annotated with, "
        "for nothing else\n"
    ) in result.err
    record = json.loads(result.out)
    assert (record["scenes"], record["without_class"]) == (3, 3)
    (here / "data" / "scenes.csv").write_text(
        "image,class,colour,round\n" + "".join(f"{row}\n" for row in rows if ",," not in row)
    )
    classed = evaluate(agent, Dataset.load(here / "data", tiles))
    assert record["classification_accuracy"] == classed.classification_accuracy
    assert record["answer_accuracy"] == classed.answer_accuracy
    (here / "data" / "scenes.csv").write_text("image,colour\n0.png,red\n")
    result = run("evaluate", model_folder, "--data", "data")
    assert (result.code, result.out) == (2, "")
    assert result.err == (
        "seewhy: data/scenes.csv: no picture to evaluate on has a class; fill the column 'class'\n"
    )


def test_a_feature_that_nobody_labelled_is_not_judged(
    run: Run, here: Path, model_folder: Path
) -> None:
    write_table(here / "data", ["0.png,good,red", "1.png,good,red"], head="image,class,colour")
    record = json.loads(run("evaluate", model_folder, "--data", "data", "--json").out)
    assert list(record["feature_accuracy"]) == ["colour"]


def test_learning_from_pictures_without_a_class(run: Run, here: Path, model_folder: Path) -> None:
    write_table(here / "data", ["0.png,,red,yes", "1.png,,green,no"])
    result = run("learn", model_folder, "--data", "data", "--yes")
    assert (result.code, result.out) == (2, "")
    assert result.err == (
        "seewhy: data/scenes.csv: no row has a class, of which axioms are learned; fill the column "
        "'class'\n"
    )


@pytest.mark.usefixtures("in_one_process")
def test_training_where_some_pictures_have_no_class(run: Run, here: Path, tiles: Domain) -> None:
    """Features are learned from all that shows them, the class only from what has one."""
    write_tiles(here / "data", count=36)
    table = here / "data" / "scenes.csv"
    head, *rows = table.read_text().splitlines()
    cells = [row.split(",") for row in rows]
    for number, row in enumerate(cells):
        if number % 3 == 1:
            row[1] = ""  # class; a colour and a shape are left
        if number in (0, 3):
            row[1:4] = ["", "", ""]
    table.write_text("\n".join([head, *(",".join(row) for row in cells)]))
    result = run("train", "tiles", "--data", "data", "--out", "model")
    assert result.code == 0, result.err
    assert (
        "data/scenes.csv: 12 of 24 pictures to train on have no class: they teach features only\n"
        "data/scenes.csv: 2 of 24 pictures to train on have neither a class nor a feature: they "
        "are left out\n"
    ) in result.err
    agent = Agent.load("model")
    assert sum(sum(counts.values()) for counts in agent.experience.values()) == 10
    assert len(agent.trained_on) == 22
    assert len(agent.without_class) == 12
    # What gets its class later counts from then on, and once.
    for row in cells:
        row[1] = row[1] or ("good" if row[2] == "red" else "bad")
    table.write_text("\n".join([head, *(",".join(row) for row in cells[4:])]))
    train = Dataset.load(here / "data", tiles).of_split("train")
    for _ in range(2):
        agent.learn(train, answers=False)
        assert sum(sum(counts.values()) for counts in agent.experience.values()) == 10 + 11
    assert not agent.without_class & frozenset(train.picture_digests())


def test_few_pictures_of_a_class_are_remarked_on(
    run: Run, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = [
        f"{n}.png,{'good' if n < 6 else 'bad'},red,{'yes' if n % 2 else 'no'}" for n in range(8)
    ]
    write_table(here / "data", rows)

    def stop(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Agent, "fit", stop)
    result = run("train", "tiles", "--data", "data", "--out", "model")
    assert (
        "data/scenes.csv: few pictures of some classes (bad: 2); a few dozen of each are better\n"
    ) in result.err
