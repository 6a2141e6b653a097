"""Recognise signs of which no training picture shows one: by their features, from the knowledge.

Every class whose feature values all occur in other classes is withheld in turn, some classes at a
time such that this still holds, from the photographs and from the drawn signs alike; the withheld
photographs are then classified. The classes that the knowledge leaves open are withheld in every
turn: nothing says what they are, so the right answer is "I don't know". A network trained end to
end on the same pictures is beside it.

    python -m seewhy_lab signs_zero_shot PHOTOS --out runs/zero_shot --drawn 3100
"""

from __future__ import annotations

import argparse
import json
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np

from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.files.whole_files import write_whole
from seewhy.knowledge.scene import FeatureVector
from seewhy_lab.commands.signs_against_end_to_end import DOMAIN, end_to_end
from seewhy_lab.experiments.drawing import in_fold

TURNS = 4
COLUMNS = ("SeeWhy", "not known", "SeeWhy, all answered", "end to end")


def decided_vectors(domain: Domain, scenes: Dataset) -> dict[str, FeatureVector]:
    """The feature vector of every class that the knowledge decides."""
    reasoner = Agent(domain).reasoner
    by_class = dict(zip(scenes.classes, scenes.vectors, strict=True))
    return {
        label: by_class[label] for label in domain.classes if reasoner.decide(by_class[label]).label
    }


def turns(decided: dict[str, FeatureVector]) -> list[list[str]]:
    """Divide the classes that others can stand in for; all their values occur in classes kept."""

    def shown_without(withheld: list[str]) -> bool:
        kept = [vector for label, vector in decided.items() if label not in withheld]
        return all(
            any(vector[n] == decided[label][n] for vector in kept)
            for label in withheld
            for n in range(len(decided[label]))
        )

    groups: list[list[str]] = [[] for _ in range(TURNS)]
    for label in decided:
        if shown_without([label]):
            fitting = [group for group in groups if shown_without([*group, label])]
            min(fitting, key=len).append(label)
    return groups


def turn(
    scenes: Dataset,
    withheld: list[str],
    left_open: list[str],
    *,
    drawn: int,
    seed: int,
    model: Path,
) -> dict[str, dict[str, float]]:
    """Train without some classes; return what happens to the photographs of each class.

    The model is kept: signs_unknown.py says more about what it refuses.
    """
    domain = scenes.domain
    tested = in_fold(scenes, seed)
    hidden = {*withheld, *left_open}
    agent = Agent(domain, seed=seed)
    train = replace(
        scenes,
        scenes=tuple(scene for scene, out in zip(scenes.scenes, tested, strict=True) if not out),
    )
    agent.fit(train, without=sorted(hidden), drawn=drawn, answers=False)
    agent.save(model)
    baseline = end_to_end(train.without_classes(sorted(hidden)), seed=seed)
    chosen = tuple(
        scene
        for scene, out in zip(scenes.scenes, tested, strict=True)
        if out or scene.label in hidden
    )
    test = replace(scenes, scenes=chosen)
    pixels = test.pictures(domain.pictures.size)
    found = agent.classify_all(pixels)
    agent.known_share = 1.0
    answered = agent.classify_all(pixels)
    classes = list(domain.classes)
    other = baseline.probabilities(pixels)["sign"].argmax(axis=1)
    rows: dict[str, dict[str, list[bool]]] = defaultdict(lambda: defaultdict(list))
    for scene, classification, ungated, end in zip(
        test.scenes, found, answered, other, strict=True
    ):
        group = scene.label if scene.label in hidden else "classes trained on"
        rows[group]["SeeWhy"].append(classification.label == scene.label)
        rows[group]["not known"].append(classification.label is None)
        rows[group]["SeeWhy, all answered"].append(ungated.label == scene.label)
        rows[group]["end to end"].append(classes[int(end)] == scene.label)
    return {
        group: {
            **{key: float(np.mean(column)) for key, column in columns.items()},
            "photographs": len(columns["SeeWhy"]),
        }
        for group, columns in rows.items()
    }


def main() -> None:
    """Run the turns that are missing and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("photographs", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--drawn", type=int, default=0)
    options = parser.parse_args()
    domain = load_domain(DOMAIN)
    scenes = Dataset.load(options.photographs, domain)
    decided = decided_vectors(domain, scenes)
    left_open = [label for label in domain.classes if label not in decided]
    options.out.mkdir(parents=True, exist_ok=True)
    results = []
    for number, withheld in enumerate(turns(decided)):
        file = options.out / f"turn-{options.drawn}-{number}.json"
        if not file.exists():
            rows = turn(
                scenes,
                withheld,
                left_open,
                drawn=options.drawn,
                seed=number,
                model=options.out / f"model-{options.drawn}-{number}",
            )
            write_whole(file, json.dumps(rows, indent=1))
        results.append(json.loads(file.read_text()))
    print(f"| withheld | photographs | {' | '.join(COLUMNS)} |")
    print("|---|---" + "|---" * len(COLUMNS) + "|")
    for label in [*domain.classes, "classes trained on"]:
        for rows in results:
            if label in rows:
                row = rows[label]
                note = " (left open)" if label in left_open else ""
                shares = (f"{100 * row[key]:.1f} %" for key in COLUMNS)
                print(f"| {label}{note} | {row['photographs']} | {' | '.join(shares)} |")
    shown = [rows[label] for rows in results for label in rows if label in decided]
    total = sum(row["photographs"] for row in shown)
    for key in COLUMNS:
        share = sum(row[key] * row["photographs"] for row in shown) / total
        print(f"{key}: {100 * share:.1f} % of {total} photographs of withheld classes")


if __name__ == "__main__":
    main()
