"""Is what a map marks what is seen by? Hide it, hide as much elsewhere, and compare.

For pictures that the model was not trained on, a tenth of the picture is hidden that the map of a
feature marks most, and for comparison the same shape at random other places. What was filled with
its surroundings to make the map is hidden in other ways here: blurred, and in one colour.

    python -m seewhy_lab maps_faithful DOMAIN PICTURES MODEL

trains a model on --train pictures where there is none yet at MODEL. For structures that
`seewhy data make` drew, it also says how often the map of block_displaced lies on the block that
the simulator displaced.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import numpy.typing as npt

from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain
from seewhy.perception.where import MATTERS, Where

HIDDEN = 0.1
"""The share of the picture that is hidden."""

OVERLAP = 0.25
"""At most so much of another place may be of the marked one."""

PLACES = 4
"""Other places for each marked one."""

Floats = npt.NDArray[np.float32]
Bytes = npt.NDArray[np.uint8]


def in_one_colour(picture: Bytes, masks: Floats) -> Bytes:
    """Hide places behind the mean colour of the whole picture."""
    return behind(np.broadcast_to(picture.mean(axis=(0, 1)), picture.shape), picture, masks)


def blurred(picture: Bytes, masks: Floats) -> Bytes:
    """Hide places behind the picture blurred by a Gaussian of an eighth of its side."""
    at = np.arange(len(picture))
    spread = np.exp(-0.5 * ((at[:, None] - at[None, :]) / (len(picture) / 8)) ** 2)
    spread /= spread.sum(axis=1, keepdims=True)
    return behind(
        np.einsum("yi,xj,ijc->yxc", spread, spread, picture, optimize=True), picture, masks
    )


def behind(other: npt.NDArray[np.float64], picture: Bytes, masks: Floats) -> Bytes:
    """Copies of a picture that show another where their mask is 1."""
    share = masks[..., None]
    return ((1 - share) * picture + share * other).round().astype(np.uint8)


WAYS: Mapping[str, Callable[[Bytes, Floats], Bytes]] = {
    "blurred": blurred,
    "in one colour": in_one_colour,
}


def marked_and_elsewhere(found: Floats, rng: np.random.Generator) -> Floats:
    """The tenth that a map marks most, then the same shape moved round the picture at random."""
    count = round(HIDDEN * found.size)
    marked = np.zeros(found.size, dtype=np.float32)
    marked[np.argsort(-found.ravel(), kind="stable")[:count]] = 1
    masks = [marked.reshape(found.shape)]
    allowed = OVERLAP
    while len(masks) <= PLACES:
        down, right = rng.integers(0, len(found), 2)
        other = np.roll(masks[0], (int(down), int(right)), (0, 1))
        if (other * masks[0]).sum() <= allowed * count:
            masks.append(other)
        else:
            allowed += 0.001  # a shape all over the picture overlaps wherever it is
    return np.array(masks)


def changes(agent: Agent, picture: Bytes, where: Where, rng: np.random.Generator) -> list[Floats]:
    """For each way: how far the probability moves, hidden where marked and then elsewhere."""
    assert agent.extractor is not None
    masks = marked_and_elsewhere(where.map, rng)
    copies = np.concatenate([hide(picture, masks) for hide in WAYS.values()])
    column = list(agent.extractor.values[where.feature]).index(where.value)
    seen = agent.extractor.see(copies).probabilities[where.feature][:, column]
    return list(np.abs(seen - where.probability).reshape(len(WAYS), len(masks)))


def held_out(agent: Agent, scenes: Dataset, *, count: int, seed: int) -> Dataset:
    """Pictures of groups that the agent saw none of."""
    digests = scenes.picture_digests()
    known = {
        group
        for group, digest in zip(scenes.groups, digests, strict=True)
        if digest in agent.trained_on
    }
    order = by_group(scenes, seed=seed)
    return scenes.take([n for n in order if scenes.groups[n] not in known][:count])


def by_group(scenes: Dataset, *, seed: int) -> list[int]:
    """Positions of scenes in random order, those of one group one after the other."""
    names = sorted(set(scenes.groups))
    shuffled = np.random.default_rng(seed).permutation(len(names)).tolist()
    place = dict(zip(names, shuffled, strict=True))
    groups = scenes.groups
    return sorted(range(len(scenes)), key=lambda n: (place[groups[n]], n))


def trained(domain: str, scenes: Dataset, *, train: int, count: int, seed: int) -> Agent:
    """An agent trained on pictures of other groups than the ``count`` that are held out."""
    order = by_group(scenes, seed=seed)
    held = {scenes.groups[n] for n in order[:count]}
    rows = [n for n in order[count:] if scenes.groups[n] not in held][:train]
    return Agent(load_domain(domain), seed=seed).fit(scenes.take(sorted(rows)), answers=False)


def mean_and_error(by_picture: list[list[float]]) -> str:
    """Mean over pictures of each one's mean, in hundredths, with its standard error."""
    means = 100 * np.array([np.mean(row) for row in by_picture if row])
    return f"{means.mean():.1f} ± {means.std(ddof=1) / np.sqrt(len(means)):.1f}"


def main() -> None:
    """Compare on pictures that the model was not trained on."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("domain", help="a bundled domain's name or a domain folder")
    parser.add_argument("pictures", type=Path)
    parser.add_argument("model", type=Path)
    parser.add_argument("--train", type=int, default=300)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    scenes = Dataset.load(options.pictures, load_domain(options.domain))
    if not options.model.exists():
        new = trained(
            options.domain,
            scenes,
            train=options.train,
            count=options.count,
            seed=options.seed,
        )
        new.save(options.model)
    agent = Agent.load(options.model)
    assert agent.extractor is not None
    held = held_out(agent, scenes, count=options.count, seed=options.seed)
    pictures = held.pictures(agent.picture_size)
    found = agent.classify_all(pictures)
    right = np.mean([scene.label == label for scene, label in zip(found, held.labels, strict=True)])
    rng = np.random.default_rng(options.seed)
    began, maps = time.process_time(), []
    for picture, scene in zip(pictures, found, strict=True):
        maps.append(agent.where(picture, scene=scene))
    spent = (time.process_time() - began) / len(maps)
    every = [where for row in maps for where in row.values()]
    marking = np.mean([where.matters for where in every])
    print(f"{len(held)} pictures, {100 * right:.1f} % classified rightly, {len(every)} maps")
    print(f"{spent:.2f} s of processor time a picture, all features together")
    print(f"{100 * marking:.0f} % of the maps mark a place (some window takes {MATTERS} or more)")
    moved = {
        (number, name): changes(agent, pictures[number], where, rng)
        for number, row in enumerate(maps)
        for name, where in row.items()
        if where.matters
    }
    print("hundredths of the probability; in how many comparisons what is marked changes more")
    for feature in (None, *agent.extractor.values):
        for way, title in enumerate(WAYS):
            rows: dict[str, list[list[float]]] = {"marked": [], "elsewhere": [], "more": []}
            for number in range(len(held)):
                chosen = [
                    change[way]
                    for (picture, name), change in moved.items()
                    if picture == number and feature in (None, name)
                ]
                rows["marked"].append([float(losses[0]) for losses in chosen])
                rows["elsewhere"].append([float(losses[1:].mean()) for losses in chosen])
                rows["more"].append([float((losses[0] > losses[1:]).mean()) for losses in chosen])
            if sum(map(bool, rows["marked"])) < 2:
                continue
            told = {name: mean_and_error(values) for name, values in rows.items()}
            print(
                f"{feature or 'all'}, {title}: marked {told['marked']}, elsewhere "
                f"{told['elsewhere']}; more in {told['more']} % "
                f"(maps: {sum(map(len, rows['marked']))})"
            )
    made = options.pictures / "made.json"
    if made.is_file() and agent.domain.name == "structure_stability":
        every_held = held_out(agent, scenes, count=len(scenes), seed=options.seed)
        say_displaced(agent, every_held, drawn=json.loads(made.read_text()))


def say_displaced(agent: Agent, held: Dataset, *, drawn: Mapping[str, int]) -> None:
    """Print how often the block nearest to the best place of a map is the one displaced.

    Of all pictures held out with three blocks or more, where a block is displaced and seen to be.
    """
    from seewhy_lab.simulators.structure_stability.places import places

    found = []
    for scene in held.scenes:
        blocks, _, _, displaced = scene.vector
        if displaced != "yes" or blocks not in ("3", "4", "5"):
            continue
        where = agent.where(scene.picture)["block_displaced"]
        if where.value != "yes" or not where.matters:
            continue
        truth = places(seed=drawn["seed"], index=int(scene.picture.stem), size=len(where.map))
        places_of_blocks = np.argwhere(truth.blocks >= 0)
        best = np.unravel_index(where.map.argmax(), where.map.shape)
        far = np.linalg.norm(places_of_blocks - np.array(best), axis=1)
        nearest = int(truth.blocks[tuple(places_of_blocks[far.argmin()])])
        pair = {*truth.displaced, *(number - 1 for number in truth.displaced)}
        found.append(
            (
                nearest in truth.displaced,
                len(truth.displaced) / int(blocks),
                nearest in pair,
                len(pair) / int(blocks),
                far.min(),
            )
        )
    print(f"block_displaced: {len(found)} maps of three blocks or more, one seen to be displaced")
    if found:
        upper, upper_chance, either, either_chance, away = np.mean(found, axis=0)
        print(
            f"  nearest to the best place is the displaced block in {100 * upper:.0f} % (any block "
            f"as likely: {100 * upper_chance:.0f} %), it or the one that it should lie on in "
            f"{100 * either:.0f} % ({100 * either_chance:.0f} %); the place is "
            f"{away:.1f} pixels from the structure"
        )


if __name__ == "__main__":
    main()
