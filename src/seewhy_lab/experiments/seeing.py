"""What networks make of a trial's pictures: trained once, kept on disk, shared by experiments."""

from __future__ import annotations

import json
import time
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from seewhy.agent.pretraining import Pretrained, pretrained
from seewhy.data.dataset import Dataset
from seewhy.domain.tables import CLASS
from seewhy.errors import ExperimentError
from seewhy.files.folders import whole_folder
from seewhy.files.locks import locked
from seewhy.files.whole_files import whole_file
from seewhy.perception import extractor
from seewhy.perception.course import Course
from seewhy.perception.domain_options import (
    class_options,
    seen_labels,
    seen_values,
    trained_together,
    training_options,
)
from seewhy.perception.extractor import FeatureExtractor
from seewhy.perception.fitting_extractor import fit_extractor
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.options import TrainingOptions
from seewhy.perception.rehearsal import Rehearsal
from seewhy_lab.experiments.drawing import divide
from seewhy_lab.experiments.experiment import Setting, Trial
from seewhy_lab.experiments.origin import here

__all__ = ["Remembered", "Seen", "Shown", "class_network", "drawings", "pretrain", "see"]

_FOLDER = "networks"
_LARGEST = 2 << 30  # bytes that the file of a trial may be unpacked to
_DRAWN, _FEATURES = "drawn", "features"

Probabilities = Mapping[str, npt.NDArray[np.float64]]


@dataclass(frozen=True)
class Shown:
    """Pictures with what the networks of the features, and that of the class, make of them."""

    scenes: Dataset
    features: Probabilities
    classes: npt.NDArray[np.float64]


@dataclass(frozen=True)
class Seen:
    """The pictures that a trial trains on and tests on, as its networks see them.

    Attributes
    ----------
    train, test : Shown
    seconds_features, seconds_class : float or None
        Processor time of training the networks of the features, and that of the class; None where
        another kind of machine trained them.
    weights, weights_class : int
        How many weights they have.
    classes_shown : frozenset of str
        The classes of the pictures that the network of the class was trained on.
    """

    train: Shown
    test: Shown
    seconds_features: float | None
    seconds_class: float | None
    weights: int
    weights_class: int
    classes_shown: frozenset[str]


class Remembered:
    """What networks saw in the pictures to test on, in place of the networks."""

    def __init__(self, seen: Seen) -> None:
        self._seen = seen

    def probabilities(self, pictures: npt.NDArray[np.uint8]) -> dict[str, Any]:
        """The probabilities of each feature's values, and of the classes.

        The pictures are always the same.
        """
        test = self._seen.test
        assert len(pictures) == len(test.scenes)
        return {**test.features, CLASS: test.classes}

    def see(self, pictures: npt.NDArray[np.uint8]) -> extractor.Seen:
        """The same, without embeddings: no trial asks how like training's pictures are."""
        return extractor.Seen(self.probabilities(pictures), {})

    def shown(self, name: str) -> frozenset[str]:
        """The values of a feature, or the classes, that training pictures showed."""
        if name == CLASS:
            return self._seen.classes_shown
        scenes = self._seen.train.scenes
        column = list(scenes.domain.features).index(name)
        values = (vector[column] for vector in scenes.vectors)
        return frozenset(value for value in values if value is not None)


def see(setting: Setting, trial: Trial) -> Seen:
    """Return what the networks of a trial make of its pictures; train them where none did.

    The networks of the features are trained as :meth:`seewhy.agent.agent.Agent.fit` trains them.
    """
    train, test = divide(setting, trial)
    file = setting.out / _FOLDER / f"{setting.drawn}-{trial.name}.npz"
    while not file.is_file():
        with locked(file) as ours:
            if not ours:
                time.sleep(1.0)  # another process trains them
            elif not file.is_file():
                _train(setting, trial, train, test, file)
    classes_shown = _classes_shown(setting, train)
    try:
        with zipfile.ZipFile(file) as packed:
            if sum(member.file_size for member in packed.infolist()) > _LARGEST:
                raise ValueError("it would be unpacked to more than networks say of pictures")
        with np.load(file) as kept:
            numbers = dict(json.loads(str(kept["numbers"])))
            shown_train, shown_test = [
                Shown(
                    scenes,
                    {key: kept[f"{part}/{key}"] for key in setting.domain.features},
                    kept[f"{part}-{CLASS}"],
                )
                for part, scenes in (("train", train), ("test", test))
            ]
        if numbers.pop("machine", "") != here().machine:
            numbers |= {"seconds_features": None, "seconds_class": None}
        return Seen(shown_train, shown_test, classes_shown=classes_shown, **numbers)
    except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile, zlib.error):
        raise ExperimentError(
            f"{file}: is not as it was written; delete it, and the same command trains the "
            "networks again"
        ) from None


def _classes_shown(setting: Setting, train: Dataset) -> frozenset[str]:
    """The classes of the pictures that the network of the class was trained on."""
    drawn = pretrain(setting)[1].labels if setting.drawn else ()
    return frozenset((*train.classes, *drawn))


def _train(setting: Setting, trial: Trial, train: Dataset, test: Dataset, file: Path) -> None:
    domain = setting.domain
    pixels = {
        "train": train.pictures(domain.pictures.size),
        "test": test.pictures(domain.pictures.size),
    }
    first, first_class = pretrain(setting) if setting.drawn else (None, None)
    began = time.process_time()
    features = fit_extractor(
        LabelledPictures(
            pixels["train"],
            seen_labels(domain, train.vectors, train.classes),
            seen_values(domain),
            groups=train.groups,
        ),
        options=training_options(domain, seed=trial.seed),
        start_from=first.networks if first else None,
        rehearsal=first.rehearsal if first else None,
        together=trained_together(domain),
        course=Course(workers=1),
    )
    middle = time.process_time()
    classes = class_network(
        train,
        class_options(domain, seed=trial.seed),
        start_from=first_class.networks if first_class else None,
        rehearsal=first_class.rehearsal if first_class else None,
    )
    ended = time.process_time()
    kept: dict[str, Any] = {
        "numbers": json.dumps(
            {
                "seconds_features": round(middle - began, 2),
                "seconds_class": round(ended - middle, 2),
                "weights": sum(network.parameters_count for network in features.networks.values()),
                "weights_class": classes.networks[CLASS].parameters_count,
                "machine": here().machine,
            }
        )
    }
    for part, pictures in pixels.items():
        for key, found in features.probabilities(pictures).items():
            kept[f"{part}/{key}"] = found
        kept[f"{part}-{CLASS}"] = classes.probabilities(pictures)[CLASS]
    with whole_file(file) as temporary, temporary.open("wb") as stream:
        np.savez_compressed(stream, **kept)


def class_network(
    scenes: Dataset,
    options: TrainingOptions,
    *,
    start_from: FeatureExtractor | None = None,
    rehearsal: Rehearsal | None = None,
) -> FeatureExtractor:
    """Train one network from the picture to the class, like the network of a feature."""
    return fit_extractor(
        LabelledPictures(
            scenes.pictures(scenes.domain.pictures.size),
            {CLASS: scenes.classes},
            {CLASS: tuple(scenes.domain.classes)},
            groups=scenes.groups,
        ),
        options=options,
        start_from=start_from,
        rehearsal=rehearsal,
        course=Course(workers=1),
    )


def pretrain(setting: Setting) -> tuple[Pretrained, Pretrained]:
    """Return what both architectures learned from drawings; train them where nobody did.

    The networks of the features, and that of the class, on pictures of the domain's source; once
    for all trials.
    """
    folder = _folder_of_drawings(setting)
    while not (folder / CLASS).is_dir():
        with locked(folder) as ours:
            if not ours:
                time.sleep(1.0)  # another process trains them
            elif not (folder / CLASS).is_dir():
                _pretrain(setting, folder)
    domain = setting.domain
    scenes = _drawn_scenes(setting)
    pixels = scenes.pictures(domain.pictures.size)
    columns = {
        key: [str(value) for value in column]
        for key, column in seen_labels(domain, scenes.vectors, scenes.classes).items()
    }
    vectors, labels = tuple(scenes.vectors), tuple(scenes.classes)
    return (
        Pretrained(
            FeatureExtractor.load(folder / _FEATURES), Rehearsal(pixels, columns), vectors, labels
        ),
        Pretrained(
            FeatureExtractor.load(folder / CLASS),
            Rehearsal(pixels, {CLASS: scenes.classes}),
            vectors,
            labels,
        ),
    )


def drawings(setting: Setting) -> Dataset:
    """The drawings that networks are trained on before."""
    pretrain(setting)
    return _drawn_scenes(setting)


def _folder_of_drawings(setting: Setting) -> Path:
    return setting.out / f"{_DRAWN}-{setting.drawn}"


def _drawn_scenes(setting: Setting) -> Dataset:
    return Dataset.load(_folder_of_drawings(setting) / "drawn", setting.domain)


def _pretrain(setting: Setting, folder: Path) -> None:
    """Draw pictures, and train both on them; what was finished before is not done again."""
    domain = setting.domain
    if not (folder / _FEATURES).is_dir():
        first = pretrained(
            domain,
            count=setting.drawn,
            course=Course(workers=1, checkpoints=folder),
        )
        _save(first.networks, folder / _FEATURES)
    scenes = Dataset.load(folder / "drawn", domain)
    _save(class_network(scenes, class_options(domain, seed=0)), folder / CLASS)


def _save(networks: FeatureExtractor, folder: Path) -> None:
    """Write networks to a folder that is there when it is whole."""
    with whole_folder(folder) as begun:
        networks.save(begun)
