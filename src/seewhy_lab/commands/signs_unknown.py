"""How well SeeWhy says that it does not know what a photograph shows.

The model is trained, where there is none yet, on the photographs of the poles outside the fold
that its seed names, without the classes that the knowledge leaves open: nothing says what those
are. It is then shown the photographs of the fold, those of the classes left out, and drawings
that show no known sign.

    python -m seewhy_lab signs_unknown MODEL PHOTOS
    python -m seewhy_lab signs_unknown MODEL PHOTOS --seed 1 --drawn 3100
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from sklearn.metrics import roc_auc_score

from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.dialogue.reply import UNKNOWN, Classification
from seewhy.domain.domain import Domain, load_domain
from seewhy.perception.picture import as_picture
from seewhy_lab.commands.signs_against_end_to_end import DOMAIN
from seewhy_lab.commands.signs_zero_shot import decided_vectors
from seewhy_lab.experiments.drawing import FOLDS, in_fold
from seewhy_lab.simulators.traffic_signs.non_signs import draw_non_sign

BINS = (0.0, 0.5, 0.7, 0.9, 0.99, 1.0)


def train(scenes: Dataset, *, seed: int, drawn: int) -> Agent:
    """Train on the photographs outside a fold, without the classes that are left open."""
    domain = scenes.domain
    decided = decided_vectors(domain, scenes)
    tested = in_fold(scenes, seed % FOLDS)
    kept = (scene for scene, out in zip(scenes.scenes, tested, strict=True) if not out)
    return Agent(domain, seed=seed).fit(
        replace(scenes, scenes=tuple(kept)),
        without=[label for label in domain.classes if label not in decided],
        drawn=drawn,
        answers=False,
        workers=1,
    )


def photographs(agent: Agent, scenes: Dataset) -> dict[str, Dataset]:
    """The photographs that the model was not trained on, by what is to be said of them."""
    withheld = set(agent.without)
    decided = set(decided_vectors(agent.domain, scenes))
    tested = in_fold(scenes, agent.seed % FOLDS)

    def those(wanted: Sequence[bool]) -> Dataset:
        chosen = (
            scene for scene, is_wanted in zip(scenes.scenes, wanted, strict=True) if is_wanted
        )
        return replace(scenes, scenes=tuple(chosen))

    labels = scenes.classes
    found = {
        "classes trained on": those(
            [out and label not in withheld for label, out in zip(labels, tested, strict=True)]
        ),
        "classes withheld, decided": those([label in withheld & decided for label in labels]),
        "classes withheld, left open": those([label in withheld - decided for label in labels]),
    }
    trained = sum(
        digest in agent.trained_on for group in found.values() for digest in group.picture_digests()
    )
    if trained:
        sys.exit(
            f"the model was trained on {trained} of the photographs to test on: train it with "
            "this script, or give another seed"
        )
    return {name: group for name, group in found.items() if len(group)}


def non_signs(domain: Domain, *, count: int, seed: int) -> np.ndarray:
    """Drawings that show no known sign, as photographs of the domain are made."""
    shown = domain.pictures
    drawn = (draw_non_sign(seed=seed, index=n, size=2 * shown.size) for n in range(count))
    return np.stack([as_picture(drawing, size=shown.size, fit=shown.fit) for drawing in drawn])


def unfamiliarity(genuine: Sequence[float], others: Sequence[float]) -> float:
    """AUROC: how often a picture to be refused has a lower score than one to be answered."""
    truth = [0] * len(genuine) + [1] * len(others)
    return float(roc_auc_score(truth, [-score for score in (*genuine, *others)]))


def reliability(found: Sequence[Classification], labels: Sequence[str]) -> list[str]:
    """A table of how often a class is right that is given with some probability."""
    answered = [
        (classification.probability, classification.label == label)
        for classification, label in zip(found, labels, strict=True)
        if classification.probability is not None
    ]
    said, right = (np.array(column, dtype=float) for column in zip(*answered, strict=True))
    bins = np.clip(np.digitize(said, BINS) - 1, 0, len(BINS) - 2)
    lines = ["| probability said | photographs | mean said | right |", "|---|---|---|---|"]
    error = 0.0
    for number in range(len(BINS) - 1):
        in_bin = bins == number
        if in_bin.any():
            error += in_bin.mean() * abs(said[in_bin].mean() - right[in_bin].mean())
            lines.append(
                f"| {BINS[number]:g} to {BINS[number + 1]:g} | {in_bin.sum()} | "
                f"{said[in_bin].mean():.3f} | {right[in_bin].mean():.3f} |"
            )
    return [*lines, f"expected calibration error: {error:.4f}"]


def main() -> None:
    """Train the model if it is missing, and print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("photographs", type=Path)
    parser.add_argument(
        "--seed", type=int, default=0, help="of a model that is still to be trained"
    )
    parser.add_argument("--drawn", type=int, default=0, help="signs drawn before the photographs")
    parser.add_argument("--non-signs", type=int, default=1000)
    options = parser.parse_args()
    scenes = Dataset.load(options.photographs, load_domain(DOMAIN))
    if not options.model.exists():
        train(scenes, seed=options.seed, drawn=options.drawn).save(options.model)
    agent = Agent.load(options.model)
    groups = photographs(agent, scenes)
    size = agent.domain.pictures.size
    pixels = {name: group.pictures(size) for name, group in groups.items()}
    pixels["drawn, no sign"] = non_signs(agent.domain, count=options.non_signs, seed=agent.seed)
    found = {name: agent.classify_all(pictures) for name, pictures in pixels.items()}
    scores = {
        name: [classification.score or 0.0 for classification in classifications]
        for name, classifications in found.items()
    }
    before = {
        name: [reading.score for reading in agent.read(pictures)]
        for name, pictures in pixels.items()
    }
    first = next(iter(groups))
    print(f"threshold for {agent.known_share:.1%}: {agent.unknown_below}")
    print("| pictures | number | answered | right | not known | AUROC | of log-probability |")
    print("|---|---|---|---|---|---|---|")
    for name, classifications in found.items():
        unknown = np.array(
            [classification.verdict == UNKNOWN for classification in classifications]
        )
        right = "–"
        if name in groups:
            labels = groups[name].classes
            pairs = zip(classifications, labels, strict=True)
            right = f"{np.mean([given.label == label for given, label in pairs]):.1%}"
        separated = (
            "– | –"
            if name == first
            else f"{unfamiliarity(scores[first], scores[name]):.3f} | "
            f"{unfamiliarity(before[first], before[name]):.3f}"
        )
        print(
            f"| {name} | {len(classifications)} | {1 - unknown.mean():.1%} | {right} "
            f"| {unknown.mean():.1%} | {separated} |"
        )
    print("\n".join(["", *reliability(found[first], groups[first].classes)]))


if __name__ == "__main__":
    main()
