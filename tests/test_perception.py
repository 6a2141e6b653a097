"""Networks that grow, the loop that trains them, and the extractor that holds them."""

from __future__ import annotations

import dataclasses
import json
import multiprocessing
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from seewhy.errors import DatasetError, DomainError, ModelError, SeeWhyError
from seewhy.perception import fitting_extractor
from seewhy.perception.augmentation import augment
from seewhy.perception.calibration import fitted_temperature
from seewhy.perception.checkpoint import Checkpoint, Position
from seewhy.perception.course import Course
from seewhy.perception.events import TrainingEvent
from seewhy.perception.extractor import FeatureExtractor
from seewhy.perception.fitting_extractor import fit_extractor
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.network import GrowingNetwork
from seewhy.perception.options import TrainingOptions
from seewhy.perception.training import train_network
from seewhy.perception.validation import folds, split

VALUES = {"side": ["left", "right"], "count": ["1", "2", "3"]}
SHORT = TrainingOptions(max_epochs=4, growing_epochs=1, batch_size=32)
_OTHERS: set[int] = set()


@pytest.fixture(autouse=True)
def _other_processes() -> None:
    """Tests before these may have left processes of their own, for making pictures."""
    _OTHERS.clear()
    _OTHERS.update(process.pid or 0 for process in multiprocessing.active_children())


def workers() -> list[multiprocessing.Process]:
    """The processes that training has started and that still run."""
    return [p for p in multiprocessing.active_children() if p.pid not in _OTHERS]


def scenes(n: int, *, seed: int = 0, size: int = 16) -> tuple[np.ndarray, dict[str, list[str]]]:
    """Pictures of one to three light squares in one half of a noisy dark ground."""
    rng = np.random.default_rng(seed)
    pictures = rng.integers(0, 80, (n, size, size, 3), dtype=np.uint8)
    labels: dict[str, list[str]] = {"side": [], "count": []}
    for i in range(n):
        right, count = rng.integers(2), rng.integers(1, 4)
        column = rng.integers(1, size // 2 - 4) + right * size // 2
        for k in range(count):
            row = 1 + 5 * k
            pictures[i, row : row + 3, column : column + 3] = rng.integers(150, 256, 3)
        labels["side"].append(VALUES["side"][right])
        labels["count"].append(str(count))
    return pictures, labels


def weights(extractor: FeatureExtractor) -> dict[str, torch.Tensor]:
    return {
        f"{name}/{key}": tensor
        for name, network in extractor.networks.items()
        for key, tensor in network.state_dict().items()
    }


def assert_same_weights(one: FeatureExtractor, other: FeatureExtractor) -> None:
    first, second = weights(one), weights(other)
    assert first.keys() == second.keys()
    different = [name for name in first if not torch.equal(first[name], second[name])]
    assert different == []


@pytest.fixture(scope="module", autouse=True)
def one_thread() -> Iterator[None]:
    """On networks this small a second thread costs more than it brings."""
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(before)


@pytest.fixture(scope="module")
def trained() -> FeatureExtractor:
    pictures, labels = scenes(400)
    options = {
        "side": TrainingOptions(threshold=0.95, max_epochs=6),
        "count": TrainingOptions(threshold=0.95, max_epochs=8, flip=True),
    }
    return fit_extractor(
        LabelledPictures(pictures, labels, VALUES), options=options, course=Course(workers=1)
    )


# The network


def test_layers_in_words() -> None:
    network = GrowingNetwork(size=56, values=5)
    assert network.layers == "conv 3→8, pool, dense 64, dropout 0.5, logits 5"
    while network.depth < network.deepest:
        network.grow()
    assert network.layers == (
        "conv 3→8, pool, conv 8→16, pool, conv 16→32, pool, conv 32→64, pool, "
        "dense 64, dropout 0.5, logits 5"
    )
    with pytest.raises(ValueError, match="a network for 56 pixels has at most 4 layers"):
        network.grow()


@pytest.mark.parametrize("size", [8, 9, 15, 16, 56, 57, 112])
def test_every_depth_takes_pictures(size: int) -> None:
    network = GrowingNetwork(size=size, values=3)
    pictures = torch.zeros((2, size, size, 3), dtype=torch.uint8)
    while True:
        assert network(pictures).shape == (2, 3)
        if network.depth == network.deepest:
            break
        network.grow()
    assert size >> network.deepest in (2, 3)


def test_growing_keeps_the_convolutions() -> None:
    network = GrowingNetwork(size=16, values=3)
    before = network.blocks[0].state_dict()
    before = {name: tensor.clone() for name, tensor in before.items()}
    network.grow()
    for name, tensor in network.blocks[0].state_dict().items():
        assert torch.equal(tensor, before[name])


# Options, division and variation


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"threshold": 1.5}, "threshold must be 0 to 1, got 1.5"),
        ({"max_epochs": 0}, "max_epochs must be 1 to 10000, got 0"),
        ({"dropout": 1.0}, "dropout must be 0 to 0.95, got 1.0"),
        ({"validation_share": float("nan")}, "validation_share must be 0 to 0.5, got nan"),
    ],
)
def test_options_out_of_range(change: dict[str, float], sentence: str) -> None:
    with pytest.raises(DomainError) as caught:
        TrainingOptions(**change)
    assert str(caught.value) == sentence


def test_split_gives_every_label_its_share() -> None:
    labels = ["a"] * 100 + ["b"] * 40 + ["c"]
    train, validation = split(labels, share=0.15, seed=1)
    assert sorted([*train, *validation]) == list(range(141))
    assert [[labels[i] for i in validation].count(x) for x in "abc"] == [15, 6, 0]
    again = split(labels, share=0.15, seed=1)
    np.testing.assert_array_equal(validation, again[1])
    assert validation.tolist() != split(labels, share=0.15, seed=2)[1].tolist()


def test_split_keeps_groups_whole() -> None:
    rng = np.random.default_rng(0)
    groups = rng.integers(0, 60, 300).tolist()
    labels = [("a", "b")[group % 2] for group in groups]
    train, validation = split(labels, share=0.2, seed=0, groups=groups)
    assert not {groups[i] for i in train} & {groups[i] for i in validation}
    assert 45 <= len(validation) <= 75


@pytest.mark.parametrize("n", [1, 2, 3, 10])
def test_split_of_few(n: int) -> None:
    train, validation = split([str(i % 5) for i in range(n)], share=0.5, seed=0)
    assert len(train) >= min(n, 5)
    assert len(train) + len(validation) == n


def plain(**changes: object) -> TrainingOptions:
    still = {"shift": 0.0, "brightness": 0.0, "contrast": 0.0, "colour": 0.0, "noise": 0.0}
    return TrainingOptions(**{**still, **changes})  # type: ignore[arg-type]


def test_without_variation_pictures_stay() -> None:
    pictures = torch.from_numpy(scenes(8)[0])
    torch.testing.assert_close(augment(pictures, plain()), pictures.float())


def test_flip_mirrors_some() -> None:
    pictures = torch.from_numpy(scenes(40)[0])
    varied = augment(pictures, plain(flip=True))
    same = [torch.equal(a, b.float()) for a, b in zip(varied, pictures, strict=True)]
    mirrored = [torch.equal(a, b.flip(1).float()) for a, b in zip(varied, pictures, strict=True)]
    assert all(a != b for a, b in zip(same, mirrored, strict=True))
    assert 5 < sum(mirrored) < 35


def test_shift_moves_by_no_more_than_its_share() -> None:
    pictures = torch.zeros((50, 20, 20, 3), dtype=torch.uint8)
    pictures[:, 10, 10] = 255
    found = augment(pictures, plain(shift=0.15))[..., 0].nonzero()[:, 1:] - 10
    assert found.abs().max() == 3  # 0.15 × 20
    assert found.min() == -3


def test_light_and_noise_vary_and_leave_the_original() -> None:
    pictures = torch.full((30, 8, 8, 3), 100, dtype=torch.uint8)
    bright = augment(pictures, plain(brightness=0.2))
    assert 80 <= bright.min() < 90
    assert 110 < bright.max() <= 120
    tinted = augment(pictures, plain(colour=0.2))
    assert (tinted[..., 0] - tinted[..., 1]).abs().max() > 5
    torch.testing.assert_close(augment(pictures, plain(contrast=0.5)), pictures.float())
    assert 1 < augment(pictures, plain(noise=2.0)).std() < 3
    assert (pictures == 100).all()


def test_temperature_makes_overconfident_logits_honest() -> None:
    rng = np.random.default_rng(0)
    truth = rng.integers(0, 2, 2000)
    said = np.where(rng.random(2000) < 0.8, truth, 1 - truth)  # right in 80 of 100 …
    logits = np.zeros((2000, 2))
    logits[np.arange(2000), said] = 8.0  # … but sure as if in 2999 of 3000
    temperature = fitted_temperature((torch.from_numpy(logits), torch.from_numpy(truth)))
    assert 1 / (1 + np.exp(-8.0 / temperature)) == pytest.approx(0.8, abs=0.02)


# Training


def test_learns_and_says_how_sure_it_is(trained: FeatureExtractor) -> None:
    pictures, labels = scenes(300, seed=1)
    for name, probabilities in trained.probabilities(pictures).items():
        assert probabilities.shape == (300, len(VALUES[name]))
        np.testing.assert_allclose(probabilities.sum(axis=1), 1.0, atol=1e-6)
        truth = np.array([VALUES[name].index(label) for label in labels[name]])
        accuracy = (probabilities.argmax(axis=1) == truth).mean()
        assert accuracy >= 0.95, name
        assert probabilities.max(axis=1).mean() == pytest.approx(accuracy, abs=0.05)


def test_summary(trained: FeatureExtractor) -> None:
    summary = trained.summary()["count"]
    assert list(summary) == [
        "layers",
        "depth",
        "parameters",
        "epochs",
        "validation_accuracy",
        "threshold",
        "temperature",
        "training_pictures",
        "validation_pictures",
    ]
    assert summary["training_pictures"] == 340
    assert summary["validation_pictures"] == 60
    assert summary["layers"] == trained.networks["count"].layers
    json.dumps(trained.summary())


def test_grows_only_as_far_as_it_must() -> None:
    pictures, labels = scenes(120)

    def depth(threshold: float, column: list[str]) -> int:
        options = dataclasses.replace(SHORT, threshold=threshold)
        network, record = train_network(
            LabelledPictures(pictures, {"side": column}, {"side": VALUES["side"]}),
            "side",
            options=options,
        )
        assert network.depth == record.depth
        return record.depth

    assert depth(0.2, labels["side"]) == 1
    events: list[TrainingEvent] = []
    train_network(
        LabelledPictures(
            pictures,
            {"count": np.random.default_rng(0).choice(VALUES["count"], 120).tolist()},
            {"count": VALUES["count"]},
        ),
        "count",
        options=dataclasses.replace(SHORT, threshold=1.0),
        course=Course(on_progress=events.append),
    )
    kinds = [event.kind for event in events]
    assert kinds.count("grown") >= 1
    assert kinds.count("settled") == kinds.count("done") == 1
    assert kinds[-1] == "done"
    first = events[0]
    assert (first.depth, first.epoch, first.epochs) == (1, 1, 4)  # few pictures: 4 times as many
    assert first.message.startswith("count: epoch 1 of 4, ")
    settled = next(event for event in events if event.kind == "settled")
    accuracies = [e.validation_accuracy for e in events[: events.index(settled)] if e.depth == 1]
    assert (settled.depth, settled.validation_accuracy) == (1, max(accuracies))
    assert settled.epochs == events[-1].epochs == 16
    grown = next(event for event in events if event.kind == "grown")
    assert grown.message.endswith(
        "grows to conv 3→8, pool, conv 8→16, pool, dense 64, dropout 0.5, logits 3"
    )


def test_same_seed_same_weights_and_the_callers_randomness_is_untouched() -> None:
    pictures, labels = scenes(80)
    torch.manual_seed(1)
    expected = torch.rand(3)
    torch.manual_seed(1)
    one = fit_extractor(LabelledPictures(pictures, {"side": labels["side"]}, VALUES), options=SHORT)
    assert torch.equal(torch.rand(3), expected)
    two = fit_extractor(LabelledPictures(pictures, {"side": labels["side"]}, VALUES), options=SHORT)
    assert_same_weights(one, two)
    other = dataclasses.replace(SHORT, seed=1)
    three = fit_extractor(
        LabelledPictures(pictures, {"side": labels["side"]}, VALUES), options=other
    )
    assert any(not torch.equal(a, weights(three)[k]) for k, a in weights(one).items())


def test_unlabelled_pictures_are_left_out() -> None:
    pictures, labels = scenes(80)
    misleading = np.zeros((20, 16, 16, 3), dtype=np.uint8)
    column: list[str | None] = [*labels["side"], *[None] * 20]
    with_them = fit_extractor(
        LabelledPictures(np.concatenate([pictures, misleading]), {"side": column}, VALUES),
        options=SHORT,
    )
    without = fit_extractor(
        LabelledPictures(pictures, {"side": labels["side"]}, VALUES), options=SHORT
    )
    assert_same_weights(with_them, without)


def test_rare_values_are_found_more_often_when_balanced() -> None:
    rng = np.random.default_rng(0)
    light = rng.random(400) < 0.1
    # The two values overlap, so it pays to say the frequent one always unless weights forbid.
    level = rng.normal(100, 25, 400) + 25 * light
    pictures = np.clip(level, 0, 255).astype(np.uint8)[:, None, None, None]
    pictures = np.ascontiguousarray(np.broadcast_to(pictures, (400, 8, 8, 3)))
    column = np.where(light, "yes", "no").tolist()

    def found(balance: float) -> int:
        options = dataclasses.replace(plain(balance=balance), max_epochs=4, growing_epochs=1)
        extractor = fit_extractor(
            LabelledPictures(pictures, {"light": column}, {"light": ["yes", "no"]}), options=options
        )
        return int((extractor.probabilities(pictures)["light"].argmax(axis=1) == 0).sum())

    assert found(1.0) > found(0.0) + 20


# Interruption


class StoppedError(Exception):
    """Raised by the progress callback, as an interruption would be."""


def stop_after(events: int):
    seen = 0

    def on_progress(_: TrainingEvent) -> None:
        nonlocal seen
        seen += 1
        if seen == events:
            raise StoppedError

    return on_progress


@pytest.mark.parametrize("start", ["from nothing", "from a model"])
def test_killed_training_ends_with_the_same_weights(
    tmp_path: Path, start: str, trained: FeatureExtractor
) -> None:
    pictures, labels = scenes(60)
    options = dataclasses.replace(SHORT, threshold=1.0, max_epochs=2)
    start_from = trained if start == "from a model" else None

    def fit(checkpoints: Path | None, on_progress=None) -> FeatureExtractor:
        return fit_extractor(
            LabelledPictures(pictures, labels, VALUES),
            options=options,
            start_from=start_from,
            course=Course(checkpoints=checkpoints, workers=1, on_progress=on_progress),
        )

    events: list[TrainingEvent] = []
    whole = fit(None, events.append)
    # Killed again and again, after every third event: in growing, in settling, between features.
    kills = 0
    while True:
        try:
            resumed = fit(tmp_path, stop_after(3))
            break
        except StoppedError:
            kills += 1
            assert kills < len(events)
    assert kills >= 3
    assert_same_weights(resumed, whole)
    assert resumed.summary() == whole.summary()

    finished: list[TrainingEvent] = []
    torch.manual_seed(1)
    expected = torch.rand(3)
    torch.manual_seed(1)
    assert_same_weights(fit(tmp_path, finished.append), whole)
    assert torch.equal(torch.rand(3), expected)
    assert [(event.feature, event.kind) for event in finished] == [
        ("side", "done"),
        ("count", "done"),
    ]
    assert [event.message for event in finished] == [
        event.message for event in events if event.kind == "done"
    ]


def test_checkpoints_of_other_data_or_options_are_not_mixed_in(tmp_path: Path) -> None:
    pictures, labels = scenes(60)
    column = {"side": labels["side"]}
    with pytest.raises(StoppedError):
        fit_extractor(
            LabelledPictures(pictures, column, VALUES),
            options=SHORT,
            course=Course(checkpoints=tmp_path, on_progress=stop_after(3)),
        )
    other_options = dataclasses.replace(SHORT, learning_rate=0.001)
    other_pictures = pictures.copy()
    other_pictures[0, 0, 0, 0] += 1
    for data, options in ((pictures, other_options), (other_pictures, SHORT)):
        first: list[TrainingEvent] = []
        found = fit_extractor(
            LabelledPictures(data, column, VALUES),
            options=options,
            course=Course(checkpoints=tmp_path, on_progress=first.append),
        )
        assert (first[0].depth, first[0].epoch) == (1, 1)
        assert_same_weights(
            found, fit_extractor(LabelledPictures(data, column, VALUES), options=options)
        )


@pytest.mark.parametrize("damage", ["cut short", "not safetensors", "one number changed"])
def test_damaged_checkpoints_are_started_over(tmp_path: Path, damage: str) -> None:
    pictures, labels = scenes(60)
    column = {"side": labels["side"]}
    with pytest.raises(StoppedError):
        fit_extractor(
            LabelledPictures(pictures, column, VALUES),
            options=SHORT,
            course=Course(checkpoints=tmp_path, on_progress=stop_after(2)),
        )
    (file,) = tmp_path.iterdir()
    assert file.name == "side.checkpoint.safetensors"
    content = file.read_bytes()
    if damage == "cut short":
        content = content[: len(content) // 2]
    elif damage == "not safetensors":
        content = b"nothing"
    else:
        content = content[:-2] + bytes([content[-2] ^ 1]) + content[-1:]
    file.write_bytes(content)
    events: list[TrainingEvent] = []
    fit_extractor(
        LabelledPictures(pictures, column, VALUES),
        options=SHORT,
        course=Course(checkpoints=tmp_path, on_progress=events.append),
    )
    assert (events[0].depth, events[0].epoch) == (1, 1)


def test_a_checkpoint_that_is_no_use_is_logged(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "side").write_bytes(b"nothing")
    assert Checkpoint(tmp_path / "side", "of these pictures").read(Position) is None
    (said,) = caplog.messages
    assert "side: is damaged; the training begins anew" in said


def test_checkpoints_of_odd_feature_names_stay_in_the_folder(tmp_path: Path) -> None:
    pictures, labels = scenes(20)
    folder = tmp_path / "checkpoints"
    name = "../is it left?"
    fit_extractor(
        LabelledPictures(pictures, {name: labels["side"]}, {name: VALUES["side"]}),
        options=SHORT,
        course=Course(checkpoints=folder),
    )
    assert [path.name for path in tmp_path.iterdir()] == ["checkpoints"]
    assert len(list(folder.iterdir())) == 1


def test_what_a_killed_process_left_half_written_is_removed(tmp_path: Path) -> None:
    pictures, labels = scenes(20)
    (tmp_path / ".side.checkpoint-new.safetensors").write_bytes(b"half")
    fit_extractor(
        LabelledPictures(pictures, {"side": labels["side"]}, VALUES),
        options=SHORT,
        course=Course(checkpoints=tmp_path),
    )
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["side.checkpoint.safetensors"]


# Several features at the same time


def fit_two(
    workers: int,
    *,
    labels: Mapping[str, Sequence[str | None]] | None = None,
    options: TrainingOptions = SHORT,
    **course: Any,
) -> FeatureExtractor:
    pictures, annotated = scenes(60)
    shown = LabelledPictures(pictures, labels or annotated, VALUES)
    return fit_extractor(shown, options=options, course=Course(workers=workers, **course))


def test_workers_change_neither_weights_nor_events() -> None:
    alone: list[TrainingEvent] = []
    one = fit_two(1, on_progress=alone.append)
    together: list[TrainingEvent] = []
    two = fit_two(2, on_progress=together.append)
    assert_same_weights(one, two)
    assert list(two.networks) == list(one.networks) == ["side", "count"]
    assert two.summary() == one.summary()
    for name in VALUES:
        expected = [event for event in alone if event.feature == name]
        assert [event for event in together if event.feature == name] == expected
    assert workers() == []


@pytest.mark.parametrize("error", [StoppedError, KeyboardInterrupt])
def test_an_interruption_ends_the_workers_and_keeps_what_they_did(
    tmp_path: Path, error: type[BaseException]
) -> None:
    def interrupt(event: TrainingEvent) -> None:
        if event.epoch == 2:
            assert len(workers()) == 2
            raise error

    with pytest.raises(error):
        fit_two(2, checkpoints=tmp_path, on_progress=interrupt)
    assert workers() == []
    assert list(tmp_path.iterdir())
    events: list[TrainingEvent] = []
    resumed = fit_two(1, checkpoints=tmp_path, on_progress=events.append)
    whole: list[TrainingEvent] = []
    assert_same_weights(resumed, fit_two(1, on_progress=whole.append))
    assert len(events) < len(whole)


def test_an_error_in_a_worker_arrives_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    # Labels are checked before any worker starts; here only the workers check them.
    monkeypatch.setattr(fitting_extractor, "labelled", lambda *_, **__: None)
    labels = {"side": ["left"] * 60, "count": ["1", "7"] * 30}
    with pytest.raises(DatasetError) as caught:
        fit_two(2, labels=labels)
    assert str(caught.value) == (
        "count must be one of 1, 2, 3, got '7': correct the label, or leave it empty if it is "
        "unknown"
    )
    assert workers() == []


@pytest.mark.parametrize("workers", [1, 2])
def test_all_labels_are_checked_before_anything_is_trained(workers: int) -> None:
    events: list[TrainingEvent] = []
    labels = {"side": ["left", "right"] * 30, "count": ["1", "7"] * 30}
    with pytest.raises(DatasetError, match="count must be one of 1, 2, 3, got '7'"):
        fit_two(workers, labels=labels, on_progress=events.append)
    assert events == []


def test_a_killed_worker_is_one_sentence() -> None:
    def kill(_: TrainingEvent) -> None:
        for process in workers():
            process.terminate()

    with pytest.raises(SeeWhyError, match="a training process was ended from outside, most often"):
        fit_two(2, options=dataclasses.replace(SHORT, max_epochs=400), on_progress=kill)
    assert workers() == []


SCRIPT = """
import multiprocessing
import numpy as np
from seewhy.perception.course import Course
from seewhy.perception.fitting_extractor import fit_extractor
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.options import TrainingOptions

def tell(_):
    print(*(p.pid for p in multiprocessing.active_children()), flush=True)

print("started", flush=True)
fit_extractor(
    LabelledPictures(
        np.random.default_rng(0).integers(0, 256, (60, 16, 16, 3), dtype=np.uint8),
        {"one": ["a", "b"] * 30, "other": ["a", "b"] * 30},
        {"one": ["a", "b"], "other": ["a", "b"]},
    ),
    options=TrainingOptions(max_epochs=9999),
    course=Course(workers=2, on_progress=tell),
)
"""


@pytest.mark.skipif(os.name == "nt", reason="a process on Windows does not see its parent end")
def test_a_script_needs_no_main_guard_and_its_workers_do_not_outlive_it(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    with subprocess.Popen(
        [sys.executable, script], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as parent:
        assert parent.stdout is not None
        assert parent.stdout.readline() == "started\n"
        workers = [int(number) for number in parent.stdout.readline().split()]
        parent.kill()
    assert len(workers) == 2
    deadline = time.monotonic() + 20
    while any(is_running(worker) for worker in workers) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert [worker for worker in workers if is_running(worker)] == []


def is_running(process: int) -> bool:
    shown = subprocess.run(
        ["ps", "-o", "stat=", "-p", str(process)], capture_output=True, text=True, check=False
    )
    return shown.stdout.strip()[:1] not in ("", "Z")  # Z: ended, and nobody has asked how


# Starting from earlier weights


def test_training_on_needs_fewer_epochs(trained: FeatureExtractor) -> None:
    pictures, labels = scenes(40, seed=5)
    fresh_pictures, fresh_labels = scenes(200, seed=6)

    def outcome(start_from: FeatureExtractor | None) -> tuple[float, int]:
        options = TrainingOptions(max_epochs=2, growing_epochs=1, threshold=1.0)
        extractor = fit_extractor(
            LabelledPictures(pictures, {"count": labels["count"]}, VALUES),
            options=options,
            start_from=start_from,
        )
        said = extractor.probabilities(fresh_pictures)["count"].argmax(axis=1)
        truth = [int(label) - 1 for label in fresh_labels["count"]]
        return float((said == truth).mean()), extractor.records["count"].epochs

    scratch_accuracy, scratch_epochs = outcome(None)
    accuracy, epochs = outcome(trained)
    assert accuracy >= 0.95 > scratch_accuracy
    assert epochs < scratch_epochs


def test_start_from_other_values_and_size_keeps_the_convolutions(
    trained: FeatureExtractor,
) -> None:
    pictures, labels = scenes(40, size=24)
    values = {"side": ["right", "middle", "left"], "new": ["left", "right"]}
    column = labels["side"]
    extractor = fit_extractor(
        LabelledPictures(pictures, {"side": column, "new": column}, values),
        options=SHORT,
        start_from=trained,
        course=Course(workers=1),
    )
    assert extractor.networks["side"].depth == trained.networks["side"].depth
    assert extractor.networks["side"].values == 3
    assert extractor.shown("side") == {"left", "right"}


def test_a_network_is_shown_what_it_is_trained_on(tmp_path: Path) -> None:
    """Not what it is only validated on, nor what nobody showed."""
    pictures, labels = scenes(40)
    sides = ["middle", *labels["side"][1:]]
    values = {**VALUES, "side": ["left", "right", "middle", "none"]}
    options = dataclasses.replace(SHORT, threshold=1.0)
    extractor = fit_extractor(
        LabelledPictures(
            pictures, {"side": sides, "count": labels["count"]}, values, validation=np.arange(6)
        ),
        options=options,
        course=Course(workers=1),
    )
    assert extractor.shown("side") == {"left", "right"}
    assert extractor.shown("other") == frozenset()
    extractor.save(tmp_path)
    assert FeatureExtractor.load(tmp_path).shown("side") == {"left", "right"}


# Small and broken data


def test_one_value_only() -> None:
    pictures, _ = scenes(10)
    events: list[TrainingEvent] = []
    extractor = fit_extractor(
        LabelledPictures(pictures, {"side": ["left"] * 10}, VALUES),
        course=Course(on_progress=events.append),
    )
    probabilities = extractor.probabilities(pictures)["side"]
    np.testing.assert_allclose(probabilities, [[11 / 12, 1 / 12]] * 10, rtol=1e-5)
    assert extractor.shown("side") == {"left"}
    assert [event.message for event in events] == [
        "side is left in every picture: nothing to learn"
    ]


@pytest.mark.parametrize("n", [1, 2, 3, 5, 10])
def test_few_pictures(n: int) -> None:
    pictures, _ = scenes(n)
    values = {"kind": list("abcdefg")}
    column = ["abcdefg"[i % 7] for i in range(n)]
    extractor = fit_extractor(LabelledPictures(pictures, {"kind": column}, values), options=SHORT)
    probabilities = extractor.probabilities(pictures)["kind"]
    assert probabilities.shape == (n, 7)
    assert np.isfinite(probabilities).all()
    assert extractor.records["kind"].validation_pictures == 0


def test_black_pictures() -> None:
    pictures = np.zeros((12, 8, 8, 3), dtype=np.uint8)
    extractor = fit_extractor(
        LabelledPictures(pictures, {"side": ["left", "right"] * 6}, VALUES), options=SHORT
    )
    assert np.isfinite(extractor.probabilities(pictures)["side"]).all()


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            {"labels": {"side": [None] * 4}},
            "no picture has a label for side: label some pictures (a few hundred are better), "
            "or remove the feature from the domain",
        ),
        (
            {"labels": {"side": ["left", "up", "left", "right"]}},
            "side must be one of left, right, got 'up': correct the label, or leave it empty if "
            "it is unknown",
        ),
        (
            {"labels": {"side": ["left"]}},
            "side must have one label a picture (4), got 1",
        ),
        (
            {"labels": {"mood": ["left"] * 4}},
            "the values of mood are not given: list them in the domain",
        ),
        ({"labels": {}}, "there is no feature to learn: name at least one in the domain"),
        ({"groups": [1]}, "groups must have one entry a picture (4), got 1"),
        (
            {"pictures": np.zeros((0, 16, 16, 3), dtype=np.uint8)},
            "there is no picture to learn from: add labelled pictures",
        ),
        (
            {"pictures": np.zeros((4, 16, 16, 3))},
            "pictures must be uint8 of shape (n, size, size, 3), got float64 of shape "
            "(4, 16, 16, 3): make them with as_picture",
        ),
        (
            {"pictures": np.zeros((4, 4, 4, 3), dtype=np.uint8)},
            "pictures must be at least 8 pixels wide, got 4",
        ),
    ],
)
def test_what_does_not_fit_is_refused(change: dict[str, object], sentence: str) -> None:
    arguments: dict[str, object] = {
        "pictures": np.zeros((4, 16, 16, 3), dtype=np.uint8),
        "labels": {"side": ["left", "right"] * 2},
        "groups": None,
        **change,
    }
    with pytest.raises(DatasetError) as caught:
        fit_extractor(
            LabelledPictures(
                arguments["pictures"], arguments["labels"], VALUES, groups=arguments["groups"]
            )
        )
    assert str(caught.value) == sentence


def test_pictures_of_another_size_are_refused(trained: FeatureExtractor) -> None:
    with pytest.raises(DatasetError, match=r"shape \(n, 16, 16, 3\), got uint8 of shape"):
        trained.probabilities(np.zeros((1, 24, 24, 3), dtype=np.uint8))


def test_one_picture_and_none(trained: FeatureExtractor) -> None:
    pictures, _ = scenes(3)
    one = trained.probabilities(pictures[0])["count"]
    np.testing.assert_allclose(one, trained.probabilities(pictures)["count"][:1], atol=1e-5)
    assert trained.probabilities(pictures[:0])["count"].shape == (0, 3)


def test_one_picture_takes_milliseconds(trained: FeatureExtractor) -> None:
    pictures, _ = scenes(1)
    trained.probabilities(pictures)
    spent = []
    for _ in range(20):
        start = time.process_time()
        trained.probabilities(pictures)
        spent.append(time.process_time() - start)
    assert min(spent) < 0.02


# On disk


def test_a_feature_of_one_value_is_saved_at_its_depth(tmp_path: Path) -> None:
    pictures = np.zeros((6, 16, 16, 3), dtype=np.uint8)
    made = fit_extractor(
        LabelledPictures(pictures, {"light": ["on"] * 6}, {"light": ["on", "off"]}),
        options=TrainingOptions(depth=3),
        course=Course(workers=1),
    )
    made.save(tmp_path)
    loaded = FeatureExtractor.load(tmp_path)
    assert made.records["light"].depth == loaded.networks["light"].depth == 3
    seen = [extractor.probabilities(pictures)["light"] for extractor in (made, loaded)]
    assert np.array_equal(*seen)


def test_saved_and_loaded(trained: FeatureExtractor, tmp_path: Path) -> None:
    trained.save(tmp_path / "model")
    loaded = FeatureExtractor.load(tmp_path / "model")
    assert loaded.values == trained.values
    assert loaded.size == 16
    assert loaded.summary() == trained.summary()
    pictures, _ = scenes(5)
    for name, probabilities in trained.probabilities(pictures).items():
        np.testing.assert_array_equal(loaded.probabilities(pictures)[name], probabilities)


@pytest.mark.parametrize("file", ["perception.json", "perception.safetensors"])
def test_missing_model_file(trained: FeatureExtractor, tmp_path: Path, file: str) -> None:
    trained.save(tmp_path)
    (tmp_path / file).unlink()
    with pytest.raises(ModelError) as caught:
        FeatureExtractor.load(tmp_path)
    assert str(caught.value) == (
        f"{tmp_path / file} cannot be read (No such file or directory): train the model again, "
        "or copy its folder again from where it is whole"
    )


def test_damaged_weights(trained: FeatureExtractor, tmp_path: Path) -> None:
    trained.save(tmp_path)
    file = tmp_path / "perception.safetensors"
    file.write_bytes(file.read_bytes()[:-100])
    with pytest.raises(ModelError, match=r"perception\.safetensors is damaged or belongs to"):
        FeatureExtractor.load(tmp_path)


def test_damaged_description(trained: FeatureExtractor, tmp_path: Path) -> None:
    trained.save(tmp_path)
    file = tmp_path / "perception.json"
    whole = json.loads(file.read_text())

    file.write_text(file.read_text()[:50])
    with pytest.raises(ModelError, match=r"perception\.json is damaged \(its text: "):
        FeatureExtractor.load(tmp_path)

    del whole["features"]["side"]["values"]
    file.write_text(json.dumps(whole))
    with pytest.raises(ModelError, match=r"is damaged \(features\.side\.values: Field required"):
        FeatureExtractor.load(tmp_path)

    whole["features"]["side"]["values"] = ["left", "right", "above"]
    file.write_text(json.dumps(whole))
    with pytest.raises(ModelError, match=r"safetensors does not hold the weights that .*json"):
        FeatureExtractor.load(tmp_path)

    file.write_text(json.dumps({**whole, "format": 99}))
    with pytest.raises(ModelError, match="has format 99, this version of SeeWhy reads 3"):
        FeatureExtractor.load(tmp_path)


@given(
    groups=st.lists(st.integers(0, 9), min_size=1, max_size=60),
    count=st.integers(2, 6),
    seed=st.integers(0, 3),
)
def test_folds_divide_pictures_and_no_group(groups: list[int], count: int, seed: int) -> None:
    labels = ["even" if group % 2 == 0 else "odd" for group in groups]
    parts = folds(labels, count=count, seed=seed, groups=groups)
    assert len(parts) == min(count, len(set(groups)))
    assert sorted(place for part in parts for place in part.tolist()) == list(range(len(groups)))
    shown = [{groups[place] for place in part.tolist()} for part in parts]
    assert sum(len(own_groups) for own_groups in shown) == len(set(groups))
    again = folds(labels, count=count, seed=seed, groups=groups)
    assert all((one == other).all() for one, other in zip(parts, again, strict=True))


def test_folds_give_every_part_its_share_of_each_label() -> None:
    labels = ["a"] * 40 + ["b"] * 20 + ["c"] * 5
    for part in folds(labels, count=5, seed=1):
        assert sorted(labels[place] for place in part) == ["a"] * 8 + ["b"] * 4 + ["c"]
