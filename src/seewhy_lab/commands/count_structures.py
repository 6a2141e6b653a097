"""Print how often each feature value and each feature vector occurs, and how often it is stable.

These are the tables of docs/pictures.md: python -m seewhy_lab count_structures runs/pictures
"""

from __future__ import annotations

import sys
from collections import Counter

from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain


def main(folder: str) -> None:
    """Count the scenes of the dataset in ``folder``."""
    domain = load_domain("structure_stability")
    scenes = Dataset.load(folder, domain)
    for position, (name, feature) in enumerate(domain.features.items()):
        counts = Counter(vector[position] for vector in scenes.vectors)
        shares = (f"{value} {100 * counts[value] / len(scenes):.1f} %" for value in feature.values)
        print(f"{name}: {', '.join(shares)}")
    seen = Counter(scenes.vectors)
    stable = Counter(
        vector
        for vector, label in zip(scenes.vectors, scenes.classes, strict=True)
        if label == "stable"
    )
    print(", ".join(domain.features))
    for vector, count in sorted(seen.items(), key=str):
        values = ", ".join(map(str, vector))
        print(f"{values}: stable {100 * stable[vector] / count:.1f} % of {count}")


if __name__ == "__main__":
    main(sys.argv[1])
