"""Learn concepts of one to three things from scenes: SeeWhy, FOLD-R++, scikit-learn's tree.

Scenes and concepts are drawn by the recipe of ``seewhy_lab.concepts.recipe``: as many concepts of
each family as ``--count`` says, the kinds in turn. Labels of training scenes are wrong as often as
the noise says, those of the testing scenes never. FOLD-R++ and the tree learn from conditions
written out as columns (``seewhy_lab.concepts.learners``), and their seconds include that; those of
the tree, that its pruning is chosen by cross-validation.

    pip install foldrpp
    python -m seewhy_lab concepts_learned --count 26 --seed 0
"""

from __future__ import annotations

import argparse
import csv
import time
import warnings
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.things.thing_table import ThingTable, thing_table
from seewhy_lab.concepts.learners import LEARNERS
from seewhy_lab.concepts.recipe import (
    FAMILIES,
    Concept,
    Family,
    family_called,
    random_concept,
    random_scene,
)

__all__ = ["main", "rows_of"]

NOISE = (0.0, 0.05, 0.1)
SCENES, TESTED = 200, 500
COLUMNS = (
    "family", "kind", "concept", "asked", "noise", "learner", "accuracy", "literals", "seconds",
    "ended",
)  # fmt: skip

Row = dict[str, str | float]


def _scenes(
    family: Family, concept: Concept, count: int, rng: np.random.Generator
) -> tuple[ThingTable, NDArray[np.bool_]]:
    """Scenes, and which of them fall under a concept."""
    drawn = [random_scene(family, rng) for _ in range(count)]
    domain = family.domain
    assert domain.things is not None, "the domain has things"
    table = thing_table(domain.things, domain.schema, list(map(family.vector, drawn)))
    return table, np.array([concept.holds(scene) for scene in drawn])


def rows_of(
    name: str, family: Family, number: int, learners: list[str], *, seed: int, scenes: int
) -> list[Row]:
    """Return a row for each noise and learner, of one concept."""
    rng = np.random.default_rng([seed, FAMILIES.index(name), number])
    concept = random_concept(family, rng, family.kinds[number % len(family.kinds)])
    table, good = _scenes(family, concept, scenes, rng)
    others, truth = _scenes(family, concept, TESTED, rng)
    lots = rng.random(scenes)
    found: list[Row] = []
    for noise in NOISE:
        shown = np.where(lots < noise, ~good, good)
        for learner in learners:
            began = time.process_time()
            fitted = LEARNERS[learner](table, shown, seed)
            seconds = time.process_time() - began
            accuracy = float((fitted.predict(others) == truth).mean())
            values = (
                name, concept.kind, concept.text, concept.literals, noise, learner,
                round(accuracy, 4), fitted.literals, round(seconds, 2),
                "yes" if fitted.ended else "no",
            )  # fmt: skip
            found.append(dict(zip(COLUMNS, values, strict=True)))
    return found


def _print_table(rows: list[Row], learners: list[str]) -> None:
    print(f"| scenes | noise | {' | '.join(learners)} |")
    print("|---|---" + "|---" * len(learners) + "|")
    for family in dict.fromkeys(row["family"] for row in rows):
        for noise in NOISE:
            cells = []
            for learner in learners:
                some = [
                    row
                    for row in rows
                    if (row["family"], row["noise"], row["learner"]) == (family, noise, learner)
                ]
                accuracy, literals, seconds = (
                    np.mean([float(row[key]) for row in some])
                    for key in ("accuracy", "literals", "seconds")
                )
                exact = sum(row["accuracy"] == 1.0 for row in some)
                unended = sum(row["ended"] == "no" for row in some)
                cells.append(
                    f"{100 * accuracy:.1f} %, {exact} of {len(some)}, {literals:.1f}, "
                    f"{seconds:.1f} s{f', {unended} not ended' if unended else ''}"
                )
            print(f"| {family} | {100 * noise:.0f} % | {' | '.join(cells)} |", flush=True)


def main() -> None:
    """Print, for each family and noise, what each learner comes to."""
    warnings.filterwarnings("ignore")
    parser = argparse.ArgumentParser(
        "python -m seewhy_lab concepts_learned",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", type=int, default=13, help="Concepts of each family.")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--scenes", type=int, default=SCENES, help="Scenes to learn from.")
    parser.add_argument("--families", nargs="*", default=list(FAMILIES), choices=FAMILIES)
    parser.add_argument("--learners", nargs="*", default=list(LEARNERS), choices=list(LEARNERS))
    parser.add_argument("--out", type=Path, help="A CSV file for the rows.")
    options = parser.parse_args()
    if "FOLD-R++" in options.learners and find_spec("foldrpp") is None:
        parser.error(
            "FOLD-R++ is not installed; 'pip install foldrpp', or leave it out: "
            "--learners SeeWhy tree"
        )
    rows: list[Row] = []
    for name in options.families:
        for number in range(options.count):
            rows += rows_of(
                name, family_called(name), number, options.learners, seed=options.seed,
                scenes=options.scenes,
            )  # fmt: skip
            if options.out is not None:
                _write(rows, options.out)
    _print_table(rows, options.learners)


def _write(rows: list[Row], file: Path) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
