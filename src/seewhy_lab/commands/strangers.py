"""Does a model know what it does not know? Ask it about pictures that show something else.

    python -m seewhy_lab strangers DOMAIN PICTURES MODEL [OTHERS …]

says of how many pictures that the model was not trained on the answer is "I don't know": as they
are, turned by 90 and by 180 degrees; and of how many others: blank ones, noise, and those in the
folders OTHERS.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt

from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.dialogue.reply import UNKNOWN
from seewhy.domain.domain import load_domain
from seewhy.perception.picture import read_picture

MOST = 200
"""Pictures of each kind."""

Pictures = npt.NDArray[np.uint8]


def kinds(agent: Agent, new: Dataset, others: list[Path]) -> Iterator[tuple[str, Pictures]]:
    """What the pictures are, and the pictures."""
    size = agent.picture_size
    pictures = new.pictures(size)
    yield "pictures like those of training", pictures
    yield "the same, turned by 90 degrees", np.rot90(pictures, axes=(1, 2)).copy()
    yield "the same, turned by 180 degrees", np.rot90(pictures, 2, axes=(1, 2)).copy()
    levels = np.linspace(0, 255, 20).astype(np.uint8)
    yield "blank", np.broadcast_to(levels[:, None, None, None], (20, size, size, 3)).copy()
    generator = np.random.default_rng(0)
    yield "noise", generator.integers(0, 256, (20, size, size, 3), dtype=np.uint8)
    for folder in others:
        paths = sorted(path for path in folder.rglob("*") if path.suffix in (".jpg", ".png"))
        chosen = generator.permutation(len(paths))[:MOST]
        fit = agent.domain.pictures.fit
        read = [read_picture(paths[place], size=size, fit=fit) for place in chosen]
        yield str(folder), np.stack(read)


def main() -> None:
    parser = argparse.ArgumentParser(description="Of which pictures is it said 'I don't know'?")
    parser.add_argument("domain", help="A bundled domain's name or a domain folder.")
    parser.add_argument("pictures", type=Path, help="A dataset folder.")
    parser.add_argument("model", type=Path, help="A model of the domain.")
    parser.add_argument("others", type=Path, nargs="*", help="Folders of other pictures.")
    chosen = parser.parse_args()
    agent = Agent.load(chosen.model)
    scenes = Dataset.load(chosen.pictures, load_domain(chosen.domain))
    digests = scenes.picture_digests()
    groups = {
        group
        for group, digest in zip(scenes.groups, digests, strict=True)
        if digest in agent.trained_on
    }
    places = [place for place, group in enumerate(scenes.groups) if group not in groups]
    rows = np.random.default_rng(0).permutation(places)[:MOST]
    print('| pictures | of | "I don\'t know" |\n|---|---|---|')
    for kind, pictures in kinds(agent, scenes.take(sorted(rows.tolist())), chosen.others):
        unknown = [scene.verdict == UNKNOWN for scene in agent.classify_all(pictures)]
        print(f"| {kind} | {len(unknown)} | {100 * np.mean(unknown):.1f} % |")


if __name__ == "__main__":
    main()
