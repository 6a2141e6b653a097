"""Pictures of several things, from training to answers; what is wrong with the data is said."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from conftest import EYES_SIDE, Run, Shelf, trained_shelf
from seewhy.agent.agent import Agent
from seewhy.agent.things import thing_fitting
from seewhy.agent.things.thing_agent import ThingAgent
from seewhy.data.dataset import Dataset
from seewhy.data.thing import BoundingBox
from seewhy.domain.domain import load_domain
from seewhy.errors import DatasetError, DomainError, ModelError, NotFittedError
from seewhy.evaluation.things_seen import evaluate_things
from seewhy.perception.backbones import EMBEDDED, sides_of
from seewhy.perception.things import regions
from things_builder import draw_shapes


@pytest.fixture(scope="module")
def agent(shelf: Shelf) -> ThingAgent:
    return ThingAgent.load(shelf.model)


def test_things_are_found_and_read(shelf: Shelf, agent: ThingAgent) -> None:
    result = evaluate_things(agent, Dataset.load(shelf.data, agent.domain))
    total = result.found + result.missed
    assert total == sum(len(s.things) for s in _test_scenes(shelf, agent))
    assert result.found >= 0.9 * total
    assert result.imagined <= 0.1 * total
    for key in ("colour", "form", "size"):
        assert result.features[key].right.value >= 0.9 > result.features[key].majority
    assert result.relations["left"].right.value >= 0.9
    assert "right" not in result.relations  # the converse says it already
    assert result.relations["on"].right.value > result.relations["on"].majority
    assert result.classes is not None
    assert result.pictures == result.scenes.of == 12
    assert len(result.wrong) == 12 - result.scenes_with_relations.right
    assert result.known == 0


def test_a_picture_without_things_is_right_where_none_is_imagined(
    agent: ThingAgent, tmp_path: Path
) -> None:
    folder = tmp_path / "data"
    folder.mkdir()
    draw_shapes([]).save(folder / "blank.png")
    (folder / "scenes.csv").write_text("image,things\nblank.png,none\n")
    result = evaluate_things(agent, Dataset.load(folder, agent.domain))
    assert (result.pictures, result.found, result.missed) == (1, 0, 0)
    assert result.scenes.right == (result.imagined == 0)


def test_pictures_that_taught_the_model_are_counted_and_said(
    shelf: Shelf, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    agent = ThingAgent.load(shelf.model)
    tested = Dataset.load(shelf.data, agent.domain).of_split("test")
    agent.trained_on = frozenset(tested.picture_digests()[:3])
    monkeypatch.setattr(ThingAgent, "load", lambda *_, **__: agent)
    judged = run("evaluate", str(shelf.model), "--data", str(shelf.data))
    assert "3 of the pictures taught the model" in judged.err


def _test_scenes(shelf: Shelf, agent: ThingAgent) -> tuple[object, ...]:
    return Dataset.load(shelf.data, agent.domain).of_split("test").scenes


def test_a_model_reads_as_before_it_was_saved(shelf: Shelf, agent: ThingAgent) -> None:
    scene = Dataset.load(shelf.data, agent.domain).of_split("test").scenes[0]
    first, second = agent.read(scene.picture), ThingAgent.load(shelf.model).read(scene.picture)
    assert first.vector == second.vector
    assert [thing.box for thing in first.things] == [thing.box for thing in second.things]


def test_things_of_many_pixels_are_seen_in_larger_regions(
    agent: ThingAgent, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert agent.trained.eyes.side == EYES_SIDE
    monkeypatch.setattr(regions, "_REDUCED", 0.1)  # as if the pictures had many more pixels
    shelf = trained_shelf(tmp_path)
    larger = ThingAgent.load(shelf.model)
    assert larger.trained.eyes.side == sides_of(EMBEDDED)[-1] > EYES_SIDE
    scene = Dataset.load(shelf.data, larger.domain).of_split("test").scenes[0]
    assert larger.read(scene.picture).things


def test_boxes_that_are_given_are_taken(shelf: Shelf, agent: ThingAgent) -> None:
    scene = Dataset.load(shelf.data, agent.domain).of_split("test").scenes[0]
    given = [thing.box for thing in scene.things if thing.box]
    reading = agent.read(scene.picture, boxes=list(reversed(given)))
    ordered = sorted(given, key=lambda box: box.middle)
    assert [thing.box for thing in reading.things] == ordered
    assert all(thing.probability == 1.0 for thing in reading.things)


def test_nothing_is_found_where_nothing_is(agent: ThingAgent) -> None:
    noise = np.random.default_rng(1).normal(200, 5, (96, 128, 3)).clip(0, 255).astype(np.uint8)
    reply = agent.ask(Image.fromarray(noise), "how many shapes are there?")
    assert reply.read.reading.things == ()
    assert reply.reply.value == 0


def test_the_surest_are_read_where_there_are_more_than_the_most(shelf: Shelf) -> None:
    agent = ThingAgent.load(shelf.model)
    scenes = Dataset.load(shelf.data, agent.domain).scenes
    two = [Image.open(scene.picture) for scene in scenes if len(scene.things) == 4][:2]
    both = Image.new("RGB", (128, 192))
    for at, image in enumerate(two):
        both.paste(image, (0, 96 * at))
    reading = agent.read(both)
    assert len(reading.things) <= 5
    assert reading.left_out >= 1


def test_commands(shelf: Shelf, run: Run, tmp_path: Path) -> None:
    picture = shelf.data / "images" / "003.png"
    asked = run("ask", str(shelf.model), str(picture), "how many shapes are there?", "--json")
    told = json.loads(asked.out)
    assert {"text", "probability", "scene", "justification"} <= told.keys()
    card = tmp_path / "card.svg"
    plain = run(
        *("ask", str(shelf.model), str(picture), "what is left of the rightmost shape?"),
        *("--picture", str(card), "--things", str(shelf.data / "things.csv")),
    )
    assert plain.code == 0
    assert "because:" in plain.out
    assert "<svg" in card.read_text(encoding="utf-8")
    page = tmp_path / "page.html"
    judged = run("evaluate", str(shelf.model), "--data", str(shelf.data), "--page", str(page))
    assert "scenes wholly right" in judged.out
    assert "majority" in judged.out
    assert f"page: {page}" in judged.out
    assert "<h1>Shapes on a shelf, evaluated</h1>" in page.read_text(encoding="utf-8")
    table = tmp_path / "found.csv"
    assert run("classify", str(shelf.model), str(picture), "--out", str(table)).code == 0
    with table.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert {"image", "thing", "left", "colour", "form"} <= rows[0].keys()


def test_options_for_one_thing_are_refused(shelf: Shelf, run: Run) -> None:
    picture = str(shelf.data / "images" / "003.png")
    refused = run("ask", str(shelf.model), picture, "what is there?", "--gate", "0.9")
    assert refused.code == 2
    assert "--gate is not for pictures of several things" in refused.err
    refused = run(
        *("train", str(shelf.domain), "--data", str(shelf.data), "--out", "m"),
        *("--without-class", "tidy"),
    )
    assert refused.code == 2
    assert "--without-class" in refused.err


def test_each_kind_of_model_names_the_other(shelf: Shelf) -> None:
    with pytest.raises(ModelError, match=r"several things.*ThingAgent"):
        Agent.load(shelf.model)
    with pytest.raises(DomainError, match="has no things; load it with"):
        ThingAgent(load_domain("structure_stability"))
    dataset = Dataset.load(shelf.data, load_domain(shelf.domain))
    with pytest.raises(DatasetError, match=r"train a seewhy\.ThingAgent"):
        Agent(load_domain(shelf.domain)).fit(dataset)
    with pytest.raises(DomainError, match="see one thing in a picture"):
        ThingAgent(load_domain(shelf.domain), eyes="none")
    with pytest.raises(NotFittedError):
        ThingAgent(load_domain(shelf.domain)).read(np.zeros((40, 40, 3)))


@pytest.mark.parametrize("name", ["things/detector.json", "things/things.safetensors"])
def test_a_damaged_model_is_refused(shelf: Shelf, tmp_path: Path, name: str) -> None:
    import shutil

    copy = tmp_path / "model"
    shutil.copytree(shelf.model, copy)
    with (copy / name).open("ab") as stream:
        stream.write(b" ")
    with pytest.raises(ModelError, match="has changed since"):
        ThingAgent.load(copy)
    (copy / name).unlink()
    with pytest.raises(ModelError, match="is missing"):
        ThingAgent.load(copy)


# What is wrong with the data ------------------------------------------------------------------


def _changed(
    shelf: Shelf, folder: Path, change: Callable[[list[dict[str, str]]], list[dict[str, str]]]
) -> Dataset:
    """The dataset with another things.csv."""
    import shutil

    shutil.copytree(shelf.data, folder)
    file = folder / "things.csv"
    with file.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    names = list(rows[0])
    (folder / "relations.csv").unlink()
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, names)
        writer.writeheader()
        writer.writerows(change(rows))
    return Dataset.load(folder, load_domain(shelf.domain))


def test_what_things_csv_lacks_is_said(shelf: Shelf, tmp_path: Path) -> None:
    corners = dict.fromkeys(("left", "top", "right", "bottom"), "")
    changes: dict[str, Callable[[list[dict[str, str]]], list[dict[str, str]]]] = {
        "has no boxes: fill the columns left, top": lambda rows: [row | corners for row in rows],
        "no thing with a box has a value of 'colour'": lambda rows: [
            row | {"colour": ""} for row in rows
        ],
        "4 pictures have a box around each thing; to find things, at least 10": lambda rows: [
            row for row in rows if row["image"] in {f"images/{n:03}.png" for n in (0, 1, 2, 4)}
        ],
        "has no things of the pictures to train on": lambda _: [],
    }
    for number, (said, change) in enumerate(changes.items()):
        dataset = _changed(shelf, tmp_path / str(number), change)
        with pytest.raises(DatasetError, match=said):
            ThingAgent(load_domain(shelf.domain)).fit(dataset)


def test_a_table_of_boxes_must_fit_the_picture(shelf: Shelf, run: Run, tmp_path: Path) -> None:
    picture = str(shelf.data / "images" / "003.png")
    for number, (rows, said) in enumerate(
        {
            "image,thing,colour\n003.png,1,red\n": "has no box; fill left",
            "image,thing,left,top,right,bottom\n003.png,1,0,0,900,10\n": "reaches out of its",
            "image,thing,left,top,right,bottom\n004.png,1,0,0,9,10\n": "has no things of a picture",
        }.items()
    ):
        file = tmp_path / f"{number}.csv"
        file.write_text(rows, encoding="utf-8")
        refused = run("ask", str(shelf.model), picture, "what is there?", "--things", str(file))
        assert refused.code == 2
        assert said in refused.err


def test_a_box_beyond_its_picture_has_a_region_all_the_same() -> None:
    from seewhy.perception.things.regions import regions_of

    image = Image.new("RGB", (40, 30), "red")
    boxes = np.array([[-1.0, -1, 4, 4], [38, 28, 41, 31], [0, 0, 40, 30]])
    found = regions_of(image, boxes, side=32)
    assert found.shape == (3, 32, 32, 3)
    assert (found[:, 16, 16] == [255, 0, 0]).all()


@pytest.mark.parametrize(
    ("values", "refusal"),
    [
        ([{}, {}], "'values' must have one entry for each of 1 boxes, got 2"),
        ([{"colours": "red"}], "'colours' is no feature of things; did you mean 'colour'"),
        ([{"colour": "rd"}], "'rd' is no value of 'colour'; did you mean 'red'"),
    ],
)
def test_what_is_said_of_boxes_is_checked(values: list[dict[str, str]], refusal: str) -> None:
    with pytest.raises(DatasetError, match=refusal):
        ThingAgent(load_domain("tabletop")).read(
            np.zeros((40, 40, 3)), boxes=[BoundingBox(0, 0, 20, 20)], values=values
        )


def test_boxes_are_in_pixels_of_the_picture_however_large_it_is(agent: ThingAgent) -> None:
    """A large picture is reduced before it is looked at, and its boxes are not."""
    large = Image.new("RGB", (2000, 1500), (200, 200, 200))
    large.paste((200, 40, 40), (800, 600, 1100, 900))
    reading = agent.read(large, boxes=[BoundingBox(800, 600, 1100, 900)])
    box = reading.things[0].box
    assert (box.left, box.top, box.right, box.bottom) == pytest.approx((800, 600, 1100, 900))
    assert reading.things[0].values["colour"].value == "red"


def test_a_detector_of_ones_own_finds_what_it_finds(
    shelf: Shelf, agent: ThingAgent, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    domain = load_domain(shelf.domain)
    dataset = Dataset.load(shelf.data, domain)
    asked: list[object] = []

    def find(picture: np.ndarray) -> tuple[list[list[int]], list[float]]:
        asked.append(picture)
        return [[0, 0, 60, 60], [70, 60, 150, 120]], [0.9, 0.8]

    monkeypatch.setattr(thing_fitting, "fit_thing_eyes", lambda *_, **__: agent.trained.eyes)
    monkeypatch.setattr(thing_fitting, "fit_eyes", lambda *_, **__: SimpleNamespace(eyes=None))
    taught = ThingAgent(domain).fit(dataset, detector=find)
    assert len(asked) == 36  # each picture to train on judges it
    taught.save(tmp_path / "model")
    picture = dataset.scenes[0].picture
    again = ThingAgent.load(tmp_path / "model", detector=find)
    assert len(again.trained.look([picture])[0].boxes) <= 2
    alone = ThingAgent.load(tmp_path / "model")
    with pytest.raises(ModelError, match="give it as detector=… in Python, or boxes with --things"):
        alone.read(picture)
    assert len(alone.read(picture, boxes=[BoundingBox(0, 0, 60, 60)]).things) == 1
