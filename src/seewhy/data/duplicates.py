"""The same picture in several rows, and pictures that are nearly the same.

Rows of the same picture (of the same file, of the same bytes or of the same pixels) that are
annotated alike are one group, so that validation is never on a picture that was trained on. Where
such rows lie in both splits, those of the test half are left out: what was trained on proves
nothing, and training with fewer pictures would only do harm. Rows that say different things of
one picture are an error. Pictures that are nearly the same (:mod:`seewhy.data.likeness`) are one
group, too; across the split they stay, and it is said that they do.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from seewhy.data.contradiction import contradictions, require_agreement
from seewhy.data.dataset import Dataset
from seewhy.data.likeness import alike_pairs, described, same_pixels
from seewhy.errors import DatasetError

__all__ = ["Settled", "settle_duplicates"]

SHOWN = 3
"""So many cases are named in a notice."""

Pair = tuple[int, int]

_PAIR, _PAIRS, _SPLIT = "pair of pictures", "pairs of pictures", "one to train and one to test on"


@dataclass(frozen=True)
class Settled:
    """A dataset in which no picture counts twice.

    Attributes
    ----------
    dataset : Dataset
        Without the test rows of pictures that are trained on; groups are joined.
    notices : tuple of str
        What was found, a sentence each.
    left_out : int
        The number of test rows that are left out.
    """

    dataset: Dataset
    notices: tuple[str, ...]
    left_out: int

    def require_test_pictures(self) -> None:
        """Raise a DatasetError if all test rows were left out."""
        if self.left_out and not any(scene.split == "test" for scene in self.dataset.scenes):
            raise DatasetError(
                f"{self.notices[0]}, and nothing is left; give the split 'test' pictures of its own"
            )


def settle_duplicates(
    dataset: Dataset, *, on_progress: Callable[[int], None] | None = None
) -> Settled:
    """Join what shows the same, and leave out test rows of pictures that are trained on.

    Every file is read once: 4,575 photographs of 30 to 96 pixels a side take 6 s on two cores.

    Parameters
    ----------
    dataset : Dataset
        With all its splits.
    on_progress : callable, optional
        Called with the number of distinct pictures read so far.

    Raises
    ------
    DatasetError
        If two rows say different things of one picture.
    PictureError
        If a file is not a picture.

    Examples
    --------
    >>> import seewhy, tempfile
    >>> from seewhy.data.making import make_dataset
    >>> domain, folder = seewhy.load_domain("structure_stability"), tempfile.mkdtemp()
    >>> _ = make_dataset(domain, folder, count=4, workers=1)
    >>> settle_duplicates(Dataset.load(folder, domain)).notices
    ()
    """
    files: dict[str, list[int]] = {}
    for position, digest in enumerate(dataset.picture_digests()):
        files.setdefault(digest, []).append(position)
    first = [positions[0] for positions in files.values()]
    pictures = [dataset.scenes[position].picture for position in first]
    likeness = described(pictures, on_progress=on_progress)
    near: list[Pair] = []
    same: list[Pair] = [(rows[0], other) for rows in files.values() for other in rows[1:]]
    for one, other in alike_pairs(pictures, likeness):
        exact = same_pixels(pictures[one], pictures[other])
        (same if exact else near).append((first[one], first[other]))
    identical = _joined(len(dataset), same)
    require_agreement(dataset, identical)
    left_out = _test_copies(dataset, identical)
    gone = {position for position, _ in left_out}
    notices = (
        *_left_out_notice(dataset, left_out),
        *_same_notice(dataset, [[n for n in rows if n not in gone] for rows in identical]),
        *_near_notices(dataset, [pair for pair in near if not gone & set(pair)]),
    )
    grouped = _with_groups(dataset, [*same, *near])
    kept = tuple(scene for n, scene in enumerate(grouped.scenes) if n not in gone)
    return Settled(grouped.of_scenes(kept), notices, len(left_out))


def _joined(number: int, pairs: Iterable[Pair]) -> list[list[int]]:
    """The positions that pairs connect, ascending; those that nothing connects are left out."""
    found: dict[int, list[int]] = {}
    for position, component in enumerate(_components(number, pairs)):
        found.setdefault(int(component), []).append(position)
    return [positions for positions in found.values() if len(positions) > 1]


def _components(number: int, pairs: Iterable[Pair]) -> npt.NDArray[np.int32]:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    rows = np.array(list(pairs), dtype=np.int64).reshape(-1, 2)
    graph = coo_array((np.ones(len(rows)), (rows[:, 0], rows[:, 1])), shape=(number, number))
    found: npt.NDArray[np.int32] = connected_components(graph, directed=False)[1]
    return found


def _with_groups(dataset: Dataset, pairs: Sequence[Pair]) -> Dataset:
    """The dataset with one group for all that pairs, or groups before, connect."""
    if not pairs:
        return dataset
    members: dict[str, int] = {}
    before = [
        (members.setdefault(group, position), position)
        for position, group in enumerate(dataset.groups)
    ]
    scenes = list(dataset.scenes)
    for positions in _joined(len(dataset), [*before, *pairs]):
        named = next((scenes[n].group for n in positions if scenes[n].group), None)
        # No cell begins with a blank, so that no group of the table has this name.
        group = named or f" {dataset.name_of(scenes[positions[0]])}"
        for position in positions:
            scenes[position] = replace(scenes[position], group=group)
    return dataset.of_scenes(tuple(scenes))


def _test_copies(dataset: Dataset, identical: Iterable[Sequence[int]]) -> list[Pair]:
    """Test rows of pictures that are trained on, each with such a training row."""
    found = []
    for positions in identical:
        splits = {n: dataset.scenes[n].split for n in positions}
        trained = next((n for n in positions if splits[n] == "train"), None)
        if trained is not None:
            found += [(n, trained) for n in positions if splits[n] == "test"]
    return found


def _left_out_notice(dataset: Dataset, left_out: Sequence[Pair]) -> Iterable[str]:
    if left_out:
        place = dataset.table
        said = [
            f"{place.rows([dataset.scenes[test].line])} as "
            f"{place.rows([dataset.scenes[train].line])}"
            for test, train in left_out
        ]
        yield (
            f"{place.name}: {_count(left_out, 'test row', 'test rows')} of pictures that are "
            f"trained on, too ({_some(said)}), left out of evaluation"
        )


def _same_notice(dataset: Dataset, identical: Iterable[Sequence[int]]) -> Iterable[str]:
    repeated = [positions for positions in identical if len(positions) > 1]
    if repeated:
        said = [_rows(dataset, positions) for positions in repeated]
        yield (
            f"{dataset.table.name}: {_count(repeated, 'picture', 'pictures')} in several rows "
            f"({_some(said)}); the rows of a picture are one group"
        )


def _near_notices(dataset: Dataset, near: Sequence[Pair]) -> Iterable[str]:
    groups = dataset.groups
    across = [pair for pair in near if {dataset.scenes[n].split for n in pair} == {"train", "test"}]
    within = [
        pair for pair in near if pair not in set(across) and groups[pair[0]] != groups[pair[1]]
    ]
    name = dataset.table.name
    if across:
        said = [_named(dataset, pair) for pair in across]
        yield (
            f"{name}: {_count(across, f'{_PAIR}, {_SPLIT},', f'{_PAIRS}, {_SPLIT},')} "
            f"nearly the same ({_some(said)}); results on such pictures flatter, keep them in one "
            "split"
        )
    if within:
        said = [_named(dataset, pair) for pair in within]
        yield (
            f"{name}: {_count(within, _PAIR, _PAIRS)} nearly the same ({_some(said)}); such "
            "pictures are one group"
        )
    differing = list(contradictions(dataset, near))
    if differing:
        said = [
            f"{_rows(dataset, (pair.first, pair.second))}: {pair.column} {pair.said_first} and "
            f"{pair.said_second}"
            for pair in differing
        ]
        yield (
            f"{name}: {_count(differing, _PAIR, _PAIRS)} nearly the same, but annotated "
            f"differently ({_some(said)}); look whether that is meant"
        )


def _rows(dataset: Dataset, positions: Sequence[int]) -> str:
    return dataset.table.rows([dataset.scenes[n].line for n in positions])


def _named(dataset: Dataset, pair: Pair) -> str:
    names = " and ".join(dataset.name_of(dataset.scenes[n]) for n in pair)
    return f"{_rows(dataset, pair)}: {names}"


def _count(found: Sequence[object], one: str, several: str) -> str:
    """Say how many there are, with the verb that all notices have."""
    return f"1 {one} is" if len(found) == 1 else f"{len(found):,} {several} are"


def _some(said: Sequence[str]) -> str:
    return "; ".join(said[:SHOWN]) + ("; …" if len(said) > SHOWN else "")
