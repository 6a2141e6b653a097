"""Networks of all features trained together, to tell annotated feature vectors apart."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from seewhy.perception.course import Course
from seewhy.perception.events import TrainingEvent
from seewhy.perception.extractor import FeatureExtractor
from seewhy.perception.fitting_extractor import fit_extractor
from seewhy.perception.joint_training import TOGETHER
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.options import TrainingOptions
from seewhy.perception.rehearsal import Rehearsal

VALUES = {"colour": ["red", "green", "blue"], "light": ["no", "yes"]}
# A lit scene is always blue: the light, hardly to be seen, follows from the colour.
VECTORS = (("red", "no"), ("green", "no"), ("blue", "yes"))
OPTIONS = TrainingOptions(max_epochs=4, growing_epochs=1, batch_size=16, depth=2, dropout=0.2)

Labels = dict[str, Sequence[str | None]]


def scenes(n: int, *, seed: int = 0, blurred: float = 0.0) -> tuple[np.ndarray, Labels]:
    """Noisy pictures of one colour, with a lamp that is lighter than the rest by very little."""
    rng = np.random.default_rng(seed)
    pictures = rng.integers(60, 120, (n, 8, 8, 3)).astype(np.int64)
    vectors = [VECTORS[i] for i in rng.integers(len(VECTORS), size=n)]
    for picture, (colour, light) in zip(pictures, vectors, strict=True):
        strength = 40 if rng.random() >= blurred else 0
        picture[..., VALUES["colour"].index(colour)] += strength
        picture[:2, :2] += 12 * (light == "yes")
    columns = zip(*vectors, strict=True)
    return pictures.astype(np.uint8), dict(zip(VALUES, map(list, columns), strict=True))


def fit(
    n: int = 60,
    *,
    labels: Labels | None = None,
    workers: int = 1,
    checkpoints: Path | None = None,
    on_progress: Callable[[TrainingEvent], None] | None = None,
    **changes: Any,
) -> FeatureExtractor:
    pictures, annotated = scenes(n)
    course = Course(checkpoints=checkpoints, workers=workers, on_progress=on_progress)
    options: dict[str, Any] = {"options": OPTIONS, "together": tuple(VALUES), **changes}
    return fit_extractor(
        LabelledPictures(pictures, labels or annotated, VALUES), course=course, **options
    )


def tensors(extractor: FeatureExtractor) -> list[torch.Tensor]:
    return [
        tensor
        for network in extractor.networks.values()
        for tensor in network.state_dict().values()
    ]


def assert_same_weights(one: FeatureExtractor, other: FeatureExtractor) -> None:
    assert list(one.networks) == list(other.networks)
    assert all(torch.equal(a, b) for a, b in zip(tensors(one), tensors(other), strict=True))


def vectors_read(extractor: FeatureExtractor, pictures: np.ndarray) -> list[tuple[str, str]]:
    """The most probable of the vectors that occur."""
    seen = extractor.probabilities(pictures)
    joint = [
        np.log(seen["colour"][:, VALUES["colour"].index(colour)])
        + np.log(seen["light"][:, VALUES["light"].index(light)])
        for colour, light in VECTORS
    ]
    return [VECTORS[n] for n in np.argmax(joint, axis=0)]


def test_together_they_read_the_vectors() -> None:
    extractor = fit(300, options=dataclasses.replace(OPTIONS, max_epochs=10))
    pictures, labels = scenes(200, seed=1)
    truth = list(zip(*labels.values(), strict=True))
    read = vectors_read(extractor, pictures)
    assert np.mean([vector == true for vector, true in zip(read, truth, strict=True)]) > 0.95
    record = extractor.records["colour"]
    assert (record.depth, record.epochs, record.training_pictures) == (2, 40, 255)


@pytest.fixture(scope="module")
def whole() -> FeatureExtractor:
    """What comes of a training that nothing interrupts; do not train it again."""
    return fit()


def test_the_number_of_threads_changes_nothing(whole: FeatureExtractor) -> None:
    assert_same_weights(whole, fit(workers=2))
    before = torch.get_num_threads()
    fit(workers=3)
    assert torch.get_num_threads() == before


class StoppedError(Exception):
    pass


@pytest.mark.parametrize("after", [1, 3, 16])
def test_an_interrupted_training_goes_on_where_it_was(
    tmp_path: Path, after: int, whole: FeatureExtractor
) -> None:
    def stop(event: TrainingEvent) -> None:
        if event.epoch == after:
            raise StoppedError

    with pytest.raises(StoppedError):
        fit(checkpoints=tmp_path, on_progress=stop)
    events: list[TrainingEvent] = []
    resumed = fit(checkpoints=tmp_path, on_progress=events.append)
    assert_same_weights(resumed, whole)
    assert resumed.summary() == whole.summary()
    assert [event.epoch for event in events if event.kind == "epoch"] == list(range(after + 1, 17))
    told: list[TrainingEvent] = []
    again = fit(checkpoints=tmp_path, on_progress=told.append)
    assert_same_weights(again, whole)
    assert again.summary() == whole.summary()
    assert [event.kind for event in told] == ["done"]  # nothing finished is done again


def test_other_data_begin_anew(tmp_path: Path) -> None:
    fit(checkpoints=tmp_path)
    assert_same_weights(fit(64, checkpoints=tmp_path), fit(64))


def test_progress_names_the_pass_and_the_accuracy() -> None:
    events: list[TrainingEvent] = []
    fit(on_progress=events.append)
    assert {event.feature for event in events} == {TOGETHER}
    assert events[-1].kind == "done"
    shown = events[0].message
    assert shown.startswith("all features together: ")
    assert shown.endswith("% on validation, epoch 1 of 16")


def test_unknown_values_are_left_out() -> None:
    pictures, labels = scenes(80)
    gaps: Labels = {
        "colour": [None if n % 3 == 0 else value for n, value in enumerate(labels["colour"])],
        "light": [None if n % 3 == 1 else value for n, value in enumerate(labels["light"])],
    }
    extractor = fit_extractor(
        LabelledPictures(pictures, gaps, VALUES),
        options=OPTIONS,
        together=VALUES,
        course=Course(workers=1),
    )
    assert all(bool(tensor.isfinite().all()) for tensor in tensors(extractor))
    truth = list(zip(*labels.values(), strict=True))
    right = [a == b for a, b in zip(vectors_read(extractor, pictures), truth, strict=True)]
    assert np.mean(right) > 0.9


def test_no_scene_whose_values_are_all_known() -> None:
    pictures, labels = scenes(40)
    halves: Labels = {
        "colour": [value if n % 2 else None for n, value in enumerate(labels["colour"])],
        "light": [None if n % 2 else value for n, value in enumerate(labels["light"])],
    }
    extractor = fit_extractor(
        LabelledPictures(pictures, halves, VALUES),
        options=OPTIONS,
        together=VALUES,
        course=Course(workers=1),
    )
    assert all(bool(tensor.isfinite().all()) for tensor in tensors(extractor))


def test_a_feature_of_one_value_only_stays_possible_otherwise() -> None:
    _, labels = scenes(60)
    extractor = fit(labels={**labels, "light": ["no"] * 60})
    assert extractor.records["light"].epochs == 0
    pictures, _ = scenes(10, seed=3)
    assert extractor.probabilities(pictures)["light"][:, 1].min() > 0.01


def test_networks_that_have_to_grow_grow_by_themselves_first() -> None:
    events: list[TrainingEvent] = []
    extractor = fit(options=dataclasses.replace(OPTIONS, depth=1), on_progress=events.append)
    names = [event.feature for event in events]
    assert set(names) == {"colour", "light", TOGETHER}
    first = names.index(TOGETHER)
    assert TOGETHER not in names[:first]
    assert set(names[first:]) == {TOGETHER}
    assert list(extractor.networks) == ["colour", "light"]


def test_earlier_networks_are_trained_on_and_left_as_they_are() -> None:
    earlier = fit()
    kept = [tensor.clone() for tensor in tensors(earlier)]
    pictures, labels = scenes(60)
    events: list[TrainingEvent] = []
    found = fit(
        40,
        labels={name: column[:40] for name, column in labels.items()},
        start_from=earlier,
        rehearsal=Rehearsal(
            pictures, {k: [str(v) for v in column] for k, column in labels.items()}
        ),
        on_progress=events.append,
    )
    assert {event.feature for event in events} == {TOGETHER}
    assert events[-1].epochs == 8  # half as many
    assert all(torch.equal(a, b) for a, b in zip(kept, tensors(earlier), strict=True))
    assert not all(torch.equal(a, b) for a, b in zip(kept, tensors(found), strict=True))
