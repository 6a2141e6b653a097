"""Classes of which no picture was trained on: recognised by what the knowledge says of them."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from conftest import draw_tile, one_process, write_domain, write_tiles
from seewhy.agent.agent import Agent
from seewhy.cli.evaluation_tables import print_classes
from seewhy.cli.main import main
from seewhy.cli.training import trained_already
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DatasetError
from seewhy.evaluation import evaluate

KNOWLEDGE = """\
#sort tile.
#sort hue = {red, green, blue}.
#static colour(tile, hue).
#static round(tile).
#static coin(tile).
#static leaf(tile).
#static brick(tile).
#static wave(tile).

%% a round red tile is a coin
coin(T) if colour(T, red), round(T).
%% a red tile with corners is a brick
brick(T) if colour(T, red), -round(T).
%% a green tile is a leaf
leaf(T) if colour(T, green).
%% a blue tile is a wave
wave(T) if colour(T, blue).
"""
KINDS = {("red", "yes"): "coin", ("red", "no"): "brick"}


@pytest.fixture(scope="module")
def kinds(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    """Tiles of four classes, each of which the knowledge tells from the others."""
    folder = write_domain(tmp_path_factory.mktemp("kinds") / "tiles", knowledge=KNOWLEDGE)
    path = folder / "domain.toml"
    text = path.read_text().partition("[classes.good]")[0]
    for name in ("coin", "brick", "leaf", "wave"):
        text += f'[classes.{name}]\nliteral = "{name}(T)"\nsay = "a {name}"\n\n'
    path.write_text(text)
    return load_domain(folder)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Pictures annotated with the four classes."""
    folder = write_tiles(tmp_path_factory.mktemp("data") / "pictures", count=90)
    table = folder / "scenes.csv"
    with table.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    others = {"green": "leaf", "blue": "wave"}
    for row in rows:
        row["class"] = KINDS.get((row["colour"], row["round"]), others.get(row["colour"], ""))
    with table.open("w", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    return folder


@pytest.fixture(scope="module")
def agent_without_coins(kinds: Domain, data: Path) -> Agent:
    with one_process():
        return Agent(kinds, seed=2).fit(Dataset.load(data, kinds), without=["coin"])


def test_a_class_that_was_never_shown_is_recognised(
    agent_without_coins: Agent, kinds: Domain, data: Path
) -> None:
    dataset = Dataset.load(data, kinds)
    agent = agent_without_coins
    assert agent.without == ("coin",)
    coins = [d for s, d in zip(dataset.scenes, dataset.picture_digests(), strict=True)
             if s.label == "coin"]  # fmt: skip
    assert len(coins) == 15
    assert not agent.trained_on & set(coins)
    assert ("red", "yes") not in agent.experience
    reply = agent.ask(draw_tile("red", "yes", 3), "why is it a coin?")
    assert (reply.label, reply.method) == ("coin", "knowledge")
    result = evaluate(agent, dataset, questions_per_scene=1)
    assert result.without == ("coin",)
    assert result.class_accuracy == {"coin": 1.0, "brick": 1.0, "leaf": 1.0, "wave": 1.0}
    assert json.loads(json.dumps(result.to_dict()))["without"] == ["coin"]


def test_the_model_says_what_was_left_out(agent_without_coins: Agent, tmp_path: Path) -> None:
    agent_without_coins.save(tmp_path / "model")
    assert Agent.load(tmp_path / "model").without == ("coin",)


def test_the_accuracy_of_every_class(
    agent_without_coins: Agent, kinds: Domain, data: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Pictures annotated as something else are wrong in their class, and in no other."""
    dataset = Dataset.load(data, kinds)
    chosen = [n for n, scene in enumerate(dataset.scenes) if scene.split == "test"]
    bricks = [n for n in chosen if dataset.scenes[n].label == "brick"]
    leaves = [n for n in chosen if dataset.scenes[n].label == "leaf"]
    table = data.parent / "wrong.csv"
    lines = (data / "scenes.csv").read_text().splitlines()
    wrong = [lines[n + 1].replace(",brick,", ",leaf,") for n in bricks[:1]]
    table.write_text(
        "\n".join([lines[0], *wrong, *(lines[n + 1] for n in [*bricks[1:3], *leaves[:3]])])
    )
    folder = data.parent / "mixed"
    folder.mkdir()
    (folder / "images").symlink_to(data / "images")
    table.rename(folder / "scenes.csv")
    mixed = Dataset.load(folder, kinds, outside=True)
    result = evaluate(agent_without_coins, mixed, questions_per_scene=1)
    assert result.class_accuracy == {"brick": 1.0, "leaf": 0.75}
    print_classes(result, most=1)
    assert [line.split() for line in capsys.readouterr().out.splitlines()] == [
        ["class", "pictures", "classified", "rightly"],
        ["leaf", "4", "75.0", "%"],
        ["1", "more,", "each", "at", "least", "100.0", "%"],
    ]


# Errors -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("without", "said"),
    [
        (["con"], "'con' is no class of the domain 'tiles'; did you mean 'coin'?"),
        (["coin", "brick", "leaf", "wave"],
         "{}/scenes.csv: without the classes coin, brick, leaf, wave nothing is left; leave out "
         "fewer"),
        (["coin", "brick", "leaf"],
         "{}/scenes.csv: all 20 rows are of class 'wave'; training needs scenes of at least two "
         "classes"),
    ],
)  # fmt: skip
def test_classes_that_cannot_be_left_out(
    kinds: Domain, data: Path, without: list[str], said: str
) -> None:
    with pytest.raises(DatasetError) as problem:
        Agent(kinds).fit(Dataset.load(data, kinds), without=without)
    assert str(problem.value) == said.format(data)


def test_the_command_line(
    kinds: Domain,
    data: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def run(*arguments: object) -> tuple[int, str, str]:
        monkeypatch.setattr("sys.argv", ["seewhy", *map(str, arguments)])
        with pytest.raises(SystemExit) as ended:
            main()
        return (int(ended.value.code or 0), *capsys.readouterr())

    given = ("train", kinds.folder, "--data", data, "--out", tmp_path / "model", "--json")
    with one_process():
        code, out, _ = run(*given, "--without-class", "leaf", "--without-class", "coin")
    assert (code, json.loads(out)["without"]) == (0, ["leaf", "coin"])
    loaded = Agent.load(tmp_path / "model")
    assert loaded.without == ("leaf", "coin")
    code, out, _ = run("evaluate", tmp_path / "model", "--data", data, "--questions", 1)
    assert code == 0
    assert "leaf (left out of training)" in out
    assert "coin (left out of training)" in out
    code, out, err = run(*given, "--without-class", "con")
    assert (code, err) == (
        2,
        "seewhy: 'con' is no class of the domain 'tiles'; did you mean 'coin'?\n",
    )


def test_a_model_without_a_class_is_not_the_one_that_the_demo_looks_for(
    agent_without_coins: Agent, kinds: Domain, data: Path, tmp_path: Path
) -> None:
    """Of the same pictures, with other options than the domain's: it is trained again."""
    left = Dataset.load(data, kinds).of_split("train").without_classes(["coin"])
    agent_without_coins.save(tmp_path / "model")
    assert trained_already(tmp_path / "model", left, seed=2) is None
    for without, gate, same in (((), None, True), ((), 0.5, False)):
        agent = Agent.load(tmp_path / "model", gate=gate)
        agent.without = without
        agent.save(tmp_path / "other")
        assert (trained_already(tmp_path / "other", left, seed=2) is not None) == same
