"""Which see better in a domain: eyes that have seen before, or networks that grow?

For a domain that draws its own pictures, whether its ``eyes = "none"`` is worth it:

    python -m seewhy_lab eyes_against_networks robot_assistant --made 900 --counts 100
    python -m seewhy_lab eyes_against_networks traffic_signs --data photos --counts 200

Both are trained on the same pictures (0: all) and judged on the same others, of other groups. With
--drawn both are taught by so many drawings of the domain before.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from dataclasses import replace
from pathlib import Path

from seewhy.agent.agent import Agent
from seewhy.agent.pretraining import Pretrained, pretrained
from seewhy.agent.settings import Settings
from seewhy.data.dataset import Dataset
from seewhy.data.making import make_dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.perception.backbones import EMBEDDED, NONE
from seewhy_lab.comparison.picture_sets import drawn_rows, is_tested

ONE_OF = 3  # groups that are judged on


def main() -> None:
    """Train both and print how many classes each reads rightly."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("domain")
    parser.add_argument("--data", type=Path, help="a dataset; drawn by the domain where left out")
    parser.add_argument("--made", type=int, default=900, help="pictures that are drawn then")
    parser.add_argument("--counts", default="100,500", help="to train on; 0 for all")
    parser.add_argument("--drawn", type=int, default=0, help="drawings before")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    domain = load_domain(options.domain)
    with tempfile.TemporaryDirectory() as folder:
        scenes = pictures_of(domain, options.data, Path(folder), count=options.made)
        judged = [
            is_tested(scene.group or scenes.name_of(scene), ONE_OF) for scene in scenes.scenes
        ]
        train = scenes.take([number for number, kept in enumerate(judged) if not kept])
        test = scenes.take([number for number, kept in enumerate(judged) if kept])
        for eyes in (NONE, EMBEDDED):
            first = None
            if options.drawn:
                settings = Settings(eyes=eyes, reading="argmax")
                first = pretrained(domain, count=options.drawn, settings=settings)
            for count in map(int, options.counts.split(",")):
                compare(train, test, count, eyes=eyes, first=first, seed=options.seed)


def pictures_of(domain: Domain, data: Path | None, folder: Path, *, count: int) -> Dataset:
    """The pictures to learn from and to judge on, without the split that their table may have."""
    if data is None:
        make_dataset(domain, folder / "pictures", count=count, seed=0, test_share=0.0, workers=1)
    scenes = Dataset.load(data or folder / "pictures", domain).with_class()
    return replace(scenes, scenes=tuple(replace(scene, split="") for scene in scenes.scenes))


def compare(
    train: Dataset, test: Dataset, count: int, *, eyes: str, first: Pretrained | None, seed: int
) -> None:
    """Train an agent on so many pictures and print what it reads rightly of the others."""
    some = train.take(drawn_rows(train.classes, count, seed=seed))
    began = time.process_time()
    agent = Agent(train.domain, seed=seed, eyes=eyes)
    before = {"drawn": 0} if first is None else {"start_from": first}
    agent.fit(some, answers=False, workers=1, **before)
    took = time.process_time() - began
    found = agent.classify_all(test.pictures(agent.picture_size))
    right = sum(one.label == true for one, true in zip(found, test.classes, strict=True))
    unknown = sum(scene.label is None for scene in found)
    print(
        f"eyes {eyes}, {len(some)} pictures: {100 * right / len(test):.1f} % of {len(test)} right "
        f"({100 * unknown / len(test):.1f} % not known), {took:.0f} s of processor time",
        flush=True,
    )


if __name__ == "__main__":
    main()
