"""Likeness to pictures of training: what is kept of them, what is compared, and on disk."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.errors import ModelError
from seewhy.perception.familiarity import (
    Familiarity,
    NearPicture,
    TrainingPicture,
    fit_familiarity,
)

COLOURS = ["red", "green", "blue", "red", None, "green", "red", "blue"]
SHAPES = ["yes", "no", "yes", "yes", "no", "no", None, "no"]


WIDTHS = {"colour": 5, "round": 5}


def embeddings(count: int, *, seed: int, width: int = 5) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    return {
        key: np.maximum(rng.normal(size=(count, width)), 0).astype(np.float32)
        for key in ("colour", "round")
    }


def by_hand(trained: np.ndarray, values: list[str | None], shown: np.ndarray, value: str) -> float:
    """The greatest cosine with a training picture of the value, one after the other."""
    found = [0.0]
    for other, label in zip(trained, values, strict=True):
        lengths = np.linalg.norm(shown) * np.linalg.norm(other)
        if label == value and lengths:
            found.append(float(shown @ other / lengths))
    return max(found)


@given(seed=st.integers(0, 10_000), count=st.integers(0, 12))
def test_the_likeness_is_the_nearest_cosine_of_the_value_read(seed: int, count: int) -> None:
    trained, shown = embeddings(8, seed=seed), embeddings(count, seed=seed + 1)
    familiarity = fit_familiarity(trained, {"colour": COLOURS, "round": SHAPES})
    rng = np.random.default_rng(seed)
    colours = rng.choice(["red", "green", "blue", "never shown"], size=count).tolist()
    shapes = rng.choice(["yes", "no"], size=count).tolist()
    found = familiarity.likeness(shown, {"colour": colours, "round": shapes})
    expected = [
        (
            2 * by_hand(trained["colour"], COLOURS, shown["colour"][n], colours[n])
            + by_hand(trained["round"], SHAPES, shown["round"][n], shapes[n])
        )
        / 3
        for n in range(count)
    ]
    assert found.shape == (count,)
    np.testing.assert_allclose(found, expected, atol=2e-3)  # half precision


def test_many_pictures_are_compared_as_one_is() -> None:
    familiarity = fit_familiarity(embeddings(8, seed=0), {"colour": COLOURS, "round": SHAPES})
    shown = embeddings(600, seed=1)
    values = {"colour": ["red", "blue", "green"] * 200, "round": ["yes", "no"] * 300}
    together = familiarity.likeness(shown, values)
    for n in (0, 255, 256, 599):
        one = familiarity.likeness(
            {key: rows[n : n + 1] for key, rows in shown.items()},
            {key: column[n : n + 1] for key, column in values.items()},
        )
        assert one[0] == pytest.approx(together[n], abs=1e-6)


def test_at_most_so_many_pictures_of_every_vector_are_kept() -> None:
    labels = ["red"] * 70 + ["blue"] * 3 + ["green"] * 40
    trained = {"colour": embeddings(113, seed=0)["colour"]}

    def counts(**options: int) -> tuple[int, ...]:
        return fit_familiarity(trained, {"colour": labels}, **options).known["colour"].counts

    assert counts() == (3, 25, 25)
    assert counts(kept=5) == (3, 5, 5)
    # One of each first, then a second of each: rare vectors are not crowded out.
    assert counts(most=12) == (3, 4, 5) or counts(most=12) == (3, 5, 4)
    assert counts(most=3) == (1, 1, 1)


def test_the_seed_draws_what_is_kept() -> None:
    trained, labels = {"colour": embeddings(100, seed=0)["colour"]}, ["red", "blue"] * 50

    def kept(seed: int) -> np.ndarray:
        familiarity = fit_familiarity(trained, {"colour": labels}, seed=seed, kept=5)
        return familiarity.known["colour"].directions

    np.testing.assert_array_equal(kept(1), kept(1))
    assert not np.array_equal(kept(1), kept(2))


def test_a_feature_with_one_value_only_does_not_count() -> None:
    trained = embeddings(8, seed=0)
    familiarity = fit_familiarity(trained, {"colour": COLOURS, "round": ["yes"] * 8})
    assert list(familiarity.known) == ["colour"]
    # Unless there is no other.
    alone = fit_familiarity(trained, {"colour": ["red"] * 8, "round": [None] * 8})
    assert list(alone.known) == ["colour"]
    likeness = alone.likeness({"colour": trained["colour"][:2]}, {"colour": ["red", "blue"]})
    assert likeness.tolist() == [pytest.approx(1, abs=1e-3), 0.0]


def test_probabilities_and_embeddings_come_from_one_pass(agent: Agent, dataset: Dataset) -> None:
    assert agent.extractor is not None
    pictures = dataset.pictures(16)
    seen = agent.extractor.see(pictures)
    for key, network in agent.extractor.networks.items():
        np.testing.assert_array_equal(
            seen.probabilities[key], agent.extractor.probabilities(pictures)[key]
        )
        np.testing.assert_array_equal(
            seen.embeddings[key], agent.extractor.embeddings(pictures)[key]
        )
        assert seen.embeddings[key].shape == (len(pictures), network.dense)
        assert (seen.embeddings[key] >= 0).all()
        # The logits are the last layer's of the embeddings: nothing else is looked at.
        last = network.head[-1]
        logits = seen.embeddings[key] @ last.weight.detach().numpy().T + last.bias.detach().numpy()
        scaled = np.exp(logits / float(network.temperature))
        np.testing.assert_allclose(
            seen.probabilities[key], scaled / scaled.sum(axis=1, keepdims=True), atol=1e-5
        )
    assert agent.extractor.embeddings(pictures[:0])["colour"].shape == (0, 64)


# On disk ------------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    fit_familiarity(embeddings(8, seed=0), {"colour": COLOURS, "round": SHAPES}).save(tmp_path)
    return tmp_path


def test_what_is_saved_is_loaded_exactly(folder: Path) -> None:
    mine = fit_familiarity(embeddings(8, seed=0), {"colour": COLOURS, "round": SHAPES})
    shown = embeddings(20, seed=1)
    values = {"colour": ["red", "blue"] * 10, "round": ["yes"] * 20}
    again = Familiarity.load(folder, widths=WIDTHS)
    np.testing.assert_array_equal(again.likeness(shown, values), mine.likeness(shown, values))


def test_damaged_weights_are_refused(folder: Path) -> None:
    path = folder / "familiarity.safetensors"
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    with pytest.raises(ModelError) as problem:
        Familiarity.load(folder, widths=WIDTHS)
    assert str(problem.value) == (
        f"{path} is damaged or belongs to another familiarity.json: train the model again, or "
        "copy its folder again from where it is whole"
    )


REMEDY = "train the model again, or copy its folder again from where it is whole"


@pytest.mark.parametrize(
    ("counts", "wrong"),
    [
        ([2, 2, 2], " (colour must be of shape (6, 5), got (7, 5)): "),
        ([2, 2], "features.colour: Value error, there must be as many counts as values"),
        ([2, 2, 3, 0], "features.colour.counts.3: Input should be greater than or equal to 1"),
        ([8, -1, 0], "features.colour.counts.1: Input should be greater than or equal to 1"),
        ([2, 2, 10**12], "features.colour.counts.2: Input should be less than or equal to 4000"),
        ([2, 2, 3.0], "features.colour.counts.2: Input should be a valid integer"),
    ],
    ids=str,
)
def test_a_description_of_other_pictures_is_refused(
    folder: Path, counts: list[int], wrong: str
) -> None:
    path = folder / "familiarity.json"
    described = json.loads(path.read_text())
    assert described["features"]["colour"]["counts"] == [2, 2, 3]
    described["features"]["colour"]["counts"] = counts
    path.write_text(json.dumps(described))
    with pytest.raises(ModelError) as problem:
        Familiarity.load(folder, widths=WIDTHS)
    assert str(problem.value) == (
        f"{path} is damaged ({wrong}): {REMEDY}"
        if wrong.startswith("features")
        else f"{folder}/familiarity.safetensors does not hold the weights that {path} describes"
        f"{wrong}{REMEDY}"
    )


@pytest.mark.parametrize("widths", [{"colour": 5}, {"colour": 5, "round": 4}], ids=str)
def test_what_other_networks_made_is_refused(folder: Path, widths: dict[str, int]) -> None:
    with pytest.raises(
        ModelError, match=r"round(: nothing sees it| must be of shape \(7, 4\), got)"
    ):
        Familiarity.load(folder, widths=widths)


# Which pictures they are --------------------------------------------------------------------


def pictures_of(labels: list[str | None]) -> list[TrainingPicture]:
    return [
        TrainingPicture(f"images/{n}.png", "good", {"colour": value} if value else {})
        for n, value in enumerate(labels)
    ]


@given(seed=st.integers(0, 10_000), count=st.integers(1, 9))
def test_the_nearest_are_those_with_the_greatest_cosine(seed: int, count: int) -> None:
    trained, shown = embeddings(8, seed=seed)["colour"], embeddings(1, seed=seed + 1)["colour"][0]
    familiarity = fit_familiarity(
        {"colour": trained}, {"colour": COLOURS}, pictures=pictures_of(COLOURS)
    )
    found = familiarity.known["colour"].nearest(shown, count=count)
    # Each picture is compared by itself: that nothing is known of it keeps the fifth away.
    alone = {
        f"images/{n}.png": by_hand(trained[n : n + 1], ["any"], shown, "any")
        for n in range(8)
        if COLOURS[n] is not None
    }
    best = sorted(alone.values(), reverse=True)[:count]
    np.testing.assert_allclose([near.likeness for near in found], best, atol=2e-3)
    for near in found:
        assert near.likeness == pytest.approx(alone[near.picture.name], abs=2e-3)
        number = int(near.picture.name[len("images/") : -len(".png")])
        assert near.picture.features == {"colour": COLOURS[number]}


def test_which_pictures_they_are_is_kept_on_disk(tmp_path: Path) -> None:
    mine = fit_familiarity(
        {"colour": embeddings(8, seed=0)["colour"]},
        {"colour": COLOURS},
        pictures=pictures_of(COLOURS),
    )
    mine.save(tmp_path)
    again = Familiarity.load(tmp_path, widths=WIDTHS)
    assert again.known["colour"].pictures == mine.known["colour"].pictures
    shown = embeddings(1, seed=1)["colour"][0]
    assert again.known["colour"].nearest(shown, count=3) == mine.known["colour"].nearest(
        shown, count=3
    )


def test_nothing_is_named_where_names_are_not_kept() -> None:
    known = fit_familiarity(embeddings(8, seed=0), {"colour": COLOURS, "round": SHAPES}).known
    assert known["colour"].nearest(embeddings(1, seed=1)["colour"][0], count=3) == ()


def test_names_that_are_not_those_of_the_pictures_are_no_names(folder: Path) -> None:
    path = folder / "familiarity.json"
    described = json.loads(path.read_text())
    described["features"]["colour"]["pictures"] = [{"name": "a.png", "label": None, "features": {}}]
    path.write_text(json.dumps(described))
    with pytest.raises(ModelError, match="there must be as many pictures as are counted"):
        Familiarity.load(folder, widths=WIDTHS)


COMPARING = """\
import time
import numpy as np
from seewhy.perception.familiarity import fit_familiarity

draw = np.random.default_rng(0).random
trained = draw((300, 3000), dtype=np.float32)
familiarity = fit_familiarity({"colour": trained}, {"colour": ["red", "blue"] * 150}, kept=300)
shown = {"colour": draw((50, 3000), dtype=np.float32)}
of_all, of_this = time.process_time(), time.thread_time()
for _ in range(20):
    familiarity.likeness(shown, {"colour": ["red"] * 50})
print(time.process_time() - of_all, time.thread_time() - of_this)
"""


def test_comparing_few_pictures_keeps_no_other_core_busy() -> None:
    # Here all threads are forbidden: see conftest.
    free = {key: text for key, text in os.environ.items() if key != "OMP_NUM_THREADS"}
    told = subprocess.run(
        [sys.executable, "-c", COMPARING], env=free, capture_output=True, text=True, check=True
    )
    of_all, of_this = map(float, told.stdout.split())
    assert of_all - of_this < 0.02 + 0.1 * of_this


def test_a_near_picture_as_text_and_json() -> None:
    near = NearPicture(TrainingPicture("images/7.png", None, {"colour": "blue"}), 0.91236)
    assert near.to_text() == "images/7.png (0.91): colour blue"
    assert near.to_dict() == {
        "picture": "images/7.png",
        "likeness": 0.9124,
        "class": None,
        "features": {"colour": "blue"},
    }
    bare = NearPicture(TrainingPicture("images/8.png", None, {}), 0.5)
    assert bare.to_text() == "images/8.png (0.50): nothing annotated"
