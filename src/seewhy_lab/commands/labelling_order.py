"""How many labels are needed if the studio says which picture to label next?

Labelled pictures are taken for unlabelled ones, some groups of them kept out to evaluate with. The
others are labelled one handful after the other, at random and in the studio's order, and the
studio's quick heads are trained after each. For the accuracy that random order has after so many
labels, it is said how many the studio's order needs.

    python -m seewhy_lab labelling_order PICTURES --features TABLE --group "^([^_]+)_"

PICTURES is what `seewhy data import` reads; a label is that of one picture: its class, from which
the features follow. Accuracy is the share of features that are right, the class being one of them
where --with-class is given. `--json FILE` keeps the curves.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from sklearn.isotonic import IsotonicRegression

from seewhy.data.importers import ImportRequest, read_source
from seewhy.data.importers.reading import ReadSource, detect_format
from seewhy.data.reading_ahead import read_ahead
from seewhy.domain.tables import CLASS
from seewhy.files.cache_folder import cache_folder
from seewhy.labelling.labelling_order import labelling_order, landscape
from seewhy.labelling.quick_heads import QuickHeads
from seewhy.perception.backbones import EMBEDDED, load_backbone
from seewhy.perception.embedding import embed_pictures
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.picture import read_picture

BATCH = 64
KEPT_OUT = 3
"""One group in so many is evaluated on."""

Rows = npt.NDArray[np.int64]
Curve = Sequence[tuple[int, float]]


@dataclass(frozen=True, eq=False)
class Lesson:
    """Pictures as a backbone sees them, and what is known of them.

    Attributes
    ----------
    pooled : ndarray of float, shape (n, width)
    targets : mapping of str to ndarray of int
        Feature or ``class`` → the index of each picture's value.
    sizes : mapping of str to int
        How many values there are.
    groups : ndarray, shape (n,)
    """

    pooled: npt.NDArray[np.floating]
    targets: Mapping[str, Rows]
    sizes: Mapping[str, int]
    groups: npt.NDArray[np.str_]


def lesson_of(read: ReadSource, *, with_class: bool) -> Lesson:
    """Look at the pictures of a source."""
    columns: dict[str, list[str]] = {}
    for picture in read.pictures:
        said = {CLASS: picture.class_name} if with_class else {}
        for name, value in {**said, **picture.features}.items():
            columns.setdefault(name, []).append(value)
    targets, sizes = {}, {}
    for name, column in columns.items():
        if len(column) == len(read.pictures):
            values, codes = np.unique(column, return_inverse=True)
            targets[name], sizes[name] = codes.astype(np.int64), len(values)
    backbone = load_backbone(EMBEDDED)
    names = [picture.file for picture in read.pictures]

    def shown(start: int) -> npt.NDArray[np.uint8]:
        pictures = []
        for name in names[start : start + BATCH]:
            path = read.files.on_disk(name)
            if path is None:
                raise SystemExit("unpack the archive: pictures are looked at where they lie")
            pictures.append(read_picture(path, size=backbone.side))
        return np.stack(pictures)

    batches = read_ahead(shown, range(0, len(names), BATCH), ahead=2)
    embedded = embed_pictures(backbone, batches, cache=EmbeddingCache(cache_folder()))
    groups = np.array([picture.group or picture.file for picture in read.pictures])
    return Lesson(embedded.pooled.astype(np.float32), targets, sizes, groups)


Chosen = Callable[[Mapping[str, npt.NDArray[np.floating]], Sequence[int]], Sequence[int]]
"""Probabilities of the pool and the rows labelled → the rows to be labelled next."""


def curve_of(lesson: Lesson, pool: Rows, test: Rows, choose: Chosen, *, most: int) -> Curve:
    """Label the pool handful by handful; return labels and accuracy after each."""
    heads = QuickHeads(lesson.pooled[np.concatenate([pool, test])])
    labelled: list[int] = []
    probabilities: dict[str, npt.NDArray[np.floating]] = {}
    curve: list[tuple[int, float]] = []
    while len(labelled) < min(most, len(pool)):
        labelled += choose({name: p[: len(pool)] for name, p in probabilities.items()}, labelled)
        right = []
        for name, column in lesson.targets.items():
            known = np.full(len(pool) + len(test), -1, dtype=np.int64)
            known[labelled] = column[pool[labelled]]
            seen = heads.probabilities(name, known, values=lesson.sizes[name])
            if len(np.unique(column[pool[labelled]])) > 1:
                probabilities[name] = seen
            right.append(seen[len(pool) :].argmax(axis=1) == column[test])
        curve.append((len(labelled), float(np.mean(right))))
    return curve


def trial(lesson: Lesson, *, seed: int, step: int, most: int) -> tuple[Curve, Curve]:
    """The curves of random order and of the studio's, on the same pictures."""
    generator = np.random.default_rng(seed)
    names = np.unique(lesson.groups)
    kept = set(generator.permutation(names)[: len(names) // KEPT_OUT].tolist())
    is_test = np.array([group in kept for group in lesson.groups])
    pool, test = np.flatnonzero(~is_test), np.flatnonzero(is_test)
    shuffled: list[int] = generator.permutation(len(pool)).tolist()
    # Random order is blind to what lies where: the landscape is that of the pool alone.
    lie = landscape(QuickHeads(lesson.pooled[pool]).components)

    def at_random(_: Mapping[str, object], labelled: Sequence[int]) -> Sequence[int]:
        return shuffled[len(labelled) : len(labelled) + step]

    def by_worth(
        probabilities: Mapping[str, npt.NDArray[np.floating]], labelled: Sequence[int]
    ) -> Sequence[int]:
        order = labelling_order(lie, probabilities, labelled, count=step)
        return [found.place for found in order]

    return (
        curve_of(lesson, pool, test, at_random, most=most),
        curve_of(lesson, pool, test, by_worth, most=most),
    )


def smoothed(curves: Sequence[Curve]) -> Curve:
    """The mean of curves, made to rise (isotonic regression): chance alone lets them fall."""
    labels = [point[0] for point in curves[0]]
    mean = np.mean([[accuracy for _, accuracy in curve] for curve in curves], axis=0)
    risen = IsotonicRegression().fit_transform(labels, mean)
    return list(zip(labels, risen.tolist(), strict=True))


def needed(curve: Curve, accuracy: float) -> float | None:
    """The labels at which a rising curve reaches an accuracy, between its points if need be."""
    before = (0, 0.0)
    for labels, reached in curve:
        if reached >= accuracy:
            share = (accuracy - before[1]) / max(reached - before[1], 1e-9)
            return before[0] + share * (labels - before[0])
        before = (labels, reached)
    return None


def main() -> None:
    """Print what both orders need."""
    parser = argparse.ArgumentParser("python -m seewhy_lab labelling_order", description=__doc__)
    parser.add_argument("pictures", type=Path)
    parser.add_argument("--features", type=Path, help="a table class → features")
    parser.add_argument("--class-parts", help="what the names of classes are made of")
    parser.add_argument("--group", help="what finds the group in a picture's name")
    parser.add_argument("--with-class", action="store_true")
    parser.add_argument("--trials", type=int, default=3)
    parser.add_argument("--step", type=int, default=10, help="pictures labelled at a time")
    parser.add_argument("--most", type=int, default=400)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    request = ImportRequest(
        options.pictures,
        "",
        features=options.features,
        class_parts=options.class_parts,
        group=options.group,
    )
    request = ImportRequest(**{**vars(request), "format": detect_format(request)})
    with read_source(request) as read:
        lesson = lesson_of(read, with_class=options.with_class)
    both = []
    for seed in range(options.trials):
        both.append(trial(lesson, seed=seed, step=options.step, most=options.most))
        print(f"trial {seed + 1} of {options.trials} done", flush=True)
    random = smoothed([curve for curve, _ in both])
    ordered = smoothed([curve for _, curve in both])
    print(f"{len(lesson.pooled)} pictures, features: {', '.join(lesson.targets)}")
    print("labels at random   accuracy   labels in the studio's order   share")
    for labels, accuracy in random:
        if labels % max(options.most // 8, options.step) == 0:
            found = needed(ordered, accuracy)
            said = f"{found:28.0f}   {found / labels:5.2f}" if found is not None else "more"
            print(f"{labels:16}   {accuracy:8.3f}   {said}")
    if options.json:
        options.json.write_text(json.dumps({"random": random, "ordered": ordered}, indent=1))


if __name__ == "__main__":
    main()
