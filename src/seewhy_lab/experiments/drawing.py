"""The pictures of an experiment, and which of them a trial trains and tests on."""

from __future__ import annotations

import hashlib
import time
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import numpy.typing as npt

from seewhy.data.dataset import TABLE, Dataset
from seewhy.data.making import make_dataset
from seewhy.data.picture_source import load_source
from seewhy.data.training_needs import require_two_classes
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import ExperimentError
from seewhy.files.locks import locked
from seewhy.files.whole_files import whole_file
from seewhy_lab.experiments.experiment import ALL, Setting, Trial, say_size
from seewhy_lab.experiments.settings import SETTINGS

__all__ = [
    "FOLDS",
    "POOL",
    "available",
    "divide",
    "in_fold",
    "load_pictures",
    "pool_of",
    "require_enough",
]

FOLDS = 5
"""Where pictures have groups, a fifth of the groups of every class is tested on."""

POOL = "pictures"
"""The folder of the pictures that are drawn for the experiments in a folder."""

Indices = npt.NDArray[np.int64]


def pool_of(
    domain: Domain,
    data: Path | None,
    out: Path,
    *,
    count: int,
    workers: int,
    on_picture: Callable[[int], None] | None = None,
) -> Path:
    """Return the folder of pictures that trials draw from; draw them where the user gave none.

    Where several processes share the folder, one of them draws.

    Raises
    ------
    ExperimentError
        If there is no folder and the domain has no source of pictures.
    """
    if data is not None:
        return data
    if domain.source is None:
        raise ExperimentError(
            f"the domain '{domain.name}' has no source of pictures; name a folder of annotated "
            "pictures with --data"
        )
    load_source(domain)
    pool, finished = out / POOL, False
    found = _drawn(pool)
    if (out / SETTINGS).exists() and found not in (0, count):
        raise ExperimentError(
            f"{pool}: holds {found:,} pictures, and {count:,} are asked for; choose another folder "
            "with --out"
        )
    while not finished:
        with locked(pool) as finished:  # its table is locked by what draws
            if not finished:
                time.sleep(1.0)  # another process draws them
                continue
            make_dataset(
                domain, pool, count=count, workers=workers, test_share=0.0, on_progress=on_picture
            )
    return pool


def _drawn(pool: Path) -> int:
    """How many pictures the table of a pool names."""
    try:
        return max(0, (pool / TABLE).read_bytes().count(b"\n") - 1)
    except FileNotFoundError:
        return 0


@lru_cache(maxsize=1)
def load_pictures(domain: str, folder: Path, out: Path) -> Dataset:
    """Read a dataset with all its pictures, once a process.

    The pixels are kept in ``out``, where the next process finds them in an instant.
    """
    loaded = load_domain(domain)
    scenes = Dataset.load(folder, loaded).with_class()
    require_two_classes(scenes)
    scenes = replace(scenes, scenes=tuple(replace(scene, split="") for scene in scenes.scenes))
    size = loaded.pictures.size
    digest = hashlib.sha256((folder / TABLE).read_bytes()).hexdigest()[:16]
    file = out / f"pixels-{size}-{loaded.pictures.fit}-{digest}.npy"
    if not file.is_file():
        with whole_file(file) as temporary, temporary.open("wb") as stream:
            np.save(stream, scenes.pictures(size))
    try:
        pixels = np.load(file, mmap_mode="r")
        sound = pixels.shape == (len(scenes), size, size, 3) and pixels.dtype == np.uint8
    except (ValueError, EOFError, AttributeError):
        sound = False
    if not sound:
        raise ExperimentError(
            f"{file}: is not as it was written; delete it, and the same command makes it again"
        )
    return scenes.with_pictures(pixels)


def require_enough(setting: Setting, trial: Trial) -> None:
    """Raise an ExperimentError if there are too few pictures for a trial."""
    total = len(setting.scenes)
    left = available(setting, trial.seed)
    if trial.size > left or left < 1:
        raise ExperimentError(
            f"{setting.scenes.folder}: {total} pictures are too few to train on "
            f"{say_size(trial.size)} and test on {total - left} of them; choose a smaller size, "
            "or give more pictures"
        )


def available(setting: Setting, seed: int) -> int:
    """The number of pictures that a seed does not test on."""
    return len(setting.scenes) - len(_tested(setting, seed))


def has_groups(scenes: Dataset) -> bool:
    """Whether several pictures show one thing."""
    return len(set(scenes.groups)) < len(scenes)


def divide(setting: Setting, trial: Trial) -> tuple[Dataset, Dataset]:
    """Return the pictures that a trial trains on, and those that it tests on.

    What is tested on depends on the seed alone, what is trained on is drawn anew for each size.
    Where pictures have groups these stay whole: every fifth of the groups of each class is
    tested on, and five seeds in a row test on all.
    """
    scenes = setting.scenes
    tested = _tested(setting, trial.seed)
    rest = np.setdiff1d(np.arange(len(scenes)), tested)
    drawn = np.random.default_rng([trial.seed, trial.size, 1]).permutation(rest)
    train = drawn if trial.size == ALL else drawn[: trial.size]
    return scenes.take(np.sort(train).tolist()), scenes.take(tested.tolist())


def _tested(setting: Setting, seed: int) -> npt.NDArray[np.int64]:
    """The numbers of the pictures that a seed tests on."""
    scenes = setting.scenes
    if has_groups(scenes):
        return np.flatnonzero(in_fold(scenes, seed % FOLDS, seed=seed // FOLDS))
    order = np.random.default_rng(seed).permutation(len(scenes))
    return np.sort(order[: setting.tested])


def in_fold(scenes: Dataset, fold: int, *, seed: int = 0) -> npt.NDArray[np.bool_]:
    """Which scenes are in one of five folds: every class gives its share of groups."""
    groups: dict[str, dict[str, None]] = {}
    for label, group in zip(scenes.classes, scenes.groups, strict=True):
        groups.setdefault(label, {}).setdefault(group, None)
    rng = np.random.default_rng(seed)
    tested: set[tuple[str, str]] = set()
    for label in sorted(groups):
        shuffled = [str(group) for group in rng.permutation(list(groups[label]))]
        first = int(rng.integers(FOLDS))  # or rare classes would all fall into the first folds
        tested |= {
            (label, group) for n, group in enumerate(shuffled) if (n + first) % FOLDS == fold
        }
    return np.array(
        [
            (label, group) in tested
            for label, group in zip(scenes.classes, scenes.groups, strict=True)
        ],
        dtype=bool,
    )
