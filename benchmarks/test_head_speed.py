"""One more label, and all heads again: 300 pictures of seven features and a class, embeddings kept.

make bench
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from seewhy.perception.backbones import load_backbone
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.fitting_eyes import fit_eyes
from seewhy.perception.lesson import Lesson

COUNT, FEATURES, CLASSES = 300, 7, 10


@pytest.fixture(scope="module")
def lesson() -> Lesson:
    generator = np.random.default_rng(0)
    pictures = generator.integers(0, 256, (COUNT, 112, 112, 3), dtype=np.uint8)
    values = {f"feature_{n}": ("a", "b", "c") for n in range(FEATURES)}
    classes = tuple(f"class_{n}" for n in range(CLASSES))
    labels = {name: list(generator.choice(row, COUNT)) for name, row in values.items()}
    labels["class"] = list(generator.choice(classes, COUNT))
    return Lesson(
        batches=lambda: iter(np.array_split(pictures, 5)),
        labels=labels,
        values={**values, "class": classes},
        strata=labels["class"],
        groups=[str(number) for number in range(COUNT)],
    )


def test_one_more_label(benchmark, lesson: Lesson, tmp_path: Path) -> None:
    backbone, cache = load_backbone("efficientnet-lite0", device="cpu"), EmbeddingCache(tmp_path)
    fit_eyes(backbone, lesson, tune=False, cache=cache)
    column = list(lesson.labels["feature_0"])
    column[0] = next(value for value in ("a", "b") if value != column[0])
    relabelled = replace(lesson, labels={**lesson.labels, "feature_0": column})
    fitted = benchmark(fit_eyes, backbone, relabelled, tune=False, cache=cache)
    assert len(fitted.eyes.heads) == FEATURES + 1
