"""Compare SeeWhy with one network trained end to end, on photographs of traffic signs.

Every trial trains both on the same pictures, varied in the same way, and classifies photographs
of poles that neither has seen: the fold of a five-fold cross-validation over classes and poles
that the trial's seed names. Trials are rows on disk; a run that is stopped goes on where it was.

    python -m seewhy_lab signs_against_end_to_end PHOTOS --out runs/signs
    python -m seewhy_lab signs_against_end_to_end PHOTOS --out runs/signs --drawn 9300
    python -m seewhy_lab signs_against_end_to_end PHOTOS --out runs/signs --report
"""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from joblib import Parallel, delayed
from scipy.stats import ttest_1samp

from seewhy.agent.agent import Agent
from seewhy.agent.pretraining import Pretrained, pretrained
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain
from seewhy.domain.reading_rule import ReadingRule
from seewhy.evaluation import evaluate
from seewhy.files.whole_files import write_whole
from seewhy.perception.course import Course
from seewhy.perception.domain_options import training_options
from seewhy.perception.extractor import FeatureExtractor
from seewhy.perception.fitting_extractor import fit_extractor
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.rehearsal import Rehearsal
from seewhy.perception.validation import split
from seewhy_lab.experiments.drawing import FOLDS, in_fold

DOMAIN = "traffic_signs"
SIZES = (100, 200, 500, 1000, 2000, 0)  # 0: all
READINGS: tuple[ReadingRule, ...] = ("argmax", "consistent")  # no network of ours sees the class
# The convolutions of the largest of the seven networks, and a dense layer twice as wide: nearly as
# many weights as the seven have together (the rows say how many).
CHANNELS, DENSE = (24, 48, 96, 192), 384


def trial_data(data: Path, *, seed: int, size: int) -> Dataset:
    """The photographs with those to train on and those to test on marked."""
    scenes = Dataset.load(data, load_domain(DOMAIN))
    tested = in_fold(scenes, seed % FOLDS)
    order = np.random.default_rng([seed, 1]).permutation(np.flatnonzero(~tested))
    chosen = set(order[: size or None].tolist())
    kept = [
        replace(scene, split="test" if tested[n] else "train")
        for n, scene in enumerate(scenes.scenes)
        if tested[n] or n in chosen
    ]
    return replace(scenes, scenes=tuple(kept))


def end_to_end(scenes: Dataset, *, seed: int, first: Pretrained | None = None) -> FeatureExtractor:
    """Train one network from the picture to the class."""
    domain = scenes.domain
    options = training_options(domain, seed=seed)["primary_symbol"]
    _, validation = split(scenes.classes, share=0.15, seed=seed, groups=scenes.groups)
    return fit_extractor(
        LabelledPictures(
            scenes.pictures(domain.pictures.size),
            {"sign": scenes.classes},
            {"sign": tuple(domain.classes)},
            groups=scenes.groups,
            validation=validation,
        ),
        options=replace(options, channels=CHANNELS, dense=DENSE),
        start_from=_networks(first.extractor) if first else None,
        rehearsal=first.rehearsal if first else None,
        course=Course(workers=1),
    )


def trial(
    data: Path, out: Path, *, seed: int, size: int, drawn: int, answers: bool
) -> dict[str, Any]:
    """Train both on one set of photographs and test them; return one row."""
    scenes = trial_data(data, seed=seed, size=size)
    domain = scenes.domain
    train, test = scenes.of_split("train"), scenes.of_split("test")
    first, baseline_first = pretrain(out, drawn=drawn) if drawn else (None, None)
    began = time.perf_counter()
    agent = Agent(domain, seed=seed, known_share=1.0)
    agent.fit(train, drawn=0, start_from=first, answers=answers, workers=1)
    trained = time.perf_counter()
    baseline = end_to_end(train, seed=seed, first=baseline_first)
    finished = time.perf_counter()
    pixels = test.pictures(domain.pictures.size)
    labels = np.array(test.classes)
    row: dict[str, Any] = {
        "seed": seed,
        "size": len(train),
        "asked": size or "all",
        "drawn": drawn,
        "tested": len(test),
        "seconds": round(trained - began, 1),
        "seconds_end_to_end": round(finished - trained, 1),
        "weights": sum(
            network.parameters_count for network in _networks(agent.extractor).networks.values()
        ),
        "weights_end_to_end": baseline.networks["sign"].parameters_count,
    }
    for rule in READINGS:
        agent.reading = rule
        classified = np.array([scene.label for scene in agent.classify_all(pixels)])
        row[rule] = float(np.mean(classified == labels))
    classes = np.array(list(domain.classes))
    row["end_to_end"] = float(
        np.mean(classes[baseline.probabilities(pixels)["sign"].argmax(axis=1)] == labels)
    )
    if answers:
        agent.reading = "consistent"  # as the domain says
        found = evaluate(agent, scenes, seed=seed)
        row["answers"] = found.answer_accuracy
        row["answers_strict"] = found.answer_accuracy_strict
        row["features"] = found.feature_accuracy
    return row


def _networks(extractor: object) -> FeatureExtractor:
    assert isinstance(extractor, FeatureExtractor)  # drawings come before: networks that grow
    return extractor


def pretrain(out: Path, *, drawn: int) -> tuple[Pretrained, Pretrained]:
    """Train both on drawn signs, once for all trials."""
    folder = out / f"drawn-{drawn}"
    domain = load_domain(DOMAIN)
    if not (folder / "features").is_dir():
        first = pretrained(domain, count=drawn, course=Course(checkpoints=folder))
        (folder / "features").mkdir()
        first.extractor.save(folder / "features")
    scenes = Dataset.load(folder / "drawn", domain)
    if not (folder / "end_to_end").is_dir():
        baseline = end_to_end(scenes, seed=0)
        (folder / "end_to_end").mkdir()
        baseline.save(folder / "end_to_end")
    pixels = scenes.pictures(domain.pictures.size)
    columns = dict(zip(domain.features, zip(*scenes.vectors, strict=True), strict=True))
    return (
        Pretrained(
            FeatureExtractor.load(folder / "features"),
            Rehearsal(pixels, columns),
            tuple(scenes.vectors),
            tuple(scenes.classes),
        ),
        Pretrained(
            FeatureExtractor.load(folder / "end_to_end"),
            Rehearsal(pixels, {"sign": scenes.classes}),
            tuple(scenes.vectors),
            tuple(scenes.classes),
        ),
    )


def report(out: Path) -> str:
    """The table over all rows: means over the seeds, and the difference in points.

    With its deviation, and with p of a paired t-test, two-sided.
    """
    rows = [json.loads(file.read_text()) for file in sorted(out.glob("trial-*.json"))]
    lines = []
    for drawn in sorted({row["drawn"] for row in rows}):
        lines += [
            "",
            f"drawn signs before: {drawn}",
            "| photographs | SeeWhy | features read separately | end to end | difference | p |",
            "|---|---|---|---|---|---|",
        ]
        for size in SIZES:
            of_size = [
                row for row in rows if row["drawn"] == drawn and row["asked"] == (size or "all")
            ]
            if not of_size:
                continue
            better = [100 * (row["consistent"] - row["end_to_end"]) for row in of_size]
            means = [
                f"{100 * np.mean([row[key] for row in of_size]):.2f} %"
                for key in ("consistent", "argmax", "end_to_end")
            ]
            spread, p = f"{np.mean(better):+.2f}", "–"
            if len(of_size) > 1:
                spread += f" ± {np.std(better, ddof=1):.2f}"
                p = f"{ttest_1samp(better, 0).pvalue:.2f}"
            lines.append(
                f"| {size or 'all'} ({len(of_size)}) | {' | '.join(means)} | {spread} | {p} |"
            )
    return "\n".join(lines)


def main() -> None:
    """Run what is missing and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("photographs", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--drawn", type=int, default=0)
    parser.add_argument("--sizes", type=int, nargs="*", default=list(SIZES))
    parser.add_argument("--seeds", type=int, default=FOLDS)
    parser.add_argument("--answers", action="store_true", help="train and score answers too")
    parser.add_argument("--jobs", type=int, default=-1)
    parser.add_argument("--report", action="store_true", help="print the table only")
    options = parser.parse_args()
    out: Path = options.out
    if not options.report:
        if options.drawn:
            pretrain(out, drawn=options.drawn)

        def run(seed: int, size: int) -> None:
            file = out / f"trial-{options.drawn}-{size or 'all'}-{seed}.json"
            if file.exists():
                return
            row = trial(
                options.photographs,
                out,
                seed=seed,
                size=size,
                drawn=options.drawn,
                answers=options.answers,
            )
            write_whole(file, json.dumps(row, indent=1))
            print(json.dumps(row), flush=True)

        out.mkdir(parents=True, exist_ok=True)
        trials = [(seed, size) for size in options.sizes for seed in range(options.seeds)]
        Parallel(n_jobs=options.jobs)(delayed(run)(*arguments) for arguments in trials)
    print(report(out))


if __name__ == "__main__":
    main()
