"""What pictures are annotated with, and what that is too little for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Sequence

from seewhy.data.dataset import Dataset

__all__ = ["FEW", "coverage_notices"]

FEW = 5
"""Of classes and values with fewer pictures it is said that they are few."""

SHOWN = 8
"""So many classes are named in a notice."""


def coverage_notices(scenes: Dataset, *, without: Collection[str] = ()) -> tuple[str, ...]:
    """Say which of the pictures to train on teach what, and of which classes there are few.

    Parameters
    ----------
    scenes : Dataset
        The pictures to train on.
    without : collection of str
        Classes that are left out on purpose.

    Examples
    --------
    >>> import seewhy
    >>> from pathlib import Path
    >>> from seewhy.data.scene import Scene
    >>> domain = seewhy.load_domain("structure_stability")
    >>> vector = ("3", "wide", "no", "no")
    >>> scenes = [Scene(Path("a.png"), vector, label) for label in (*["stable"] * 9, None)]
    >>> for notice in coverage_notices(Dataset(tuple(scenes), domain, Path("."))):
    ...     print(notice)
    scenes.csv: 1 of 10 pictures to train on has no class: it teaches features only
    scenes.csv: few pictures of some classes (unstable: 0); a few dozen of each are better
    """
    return (*_incomplete(scenes), *_few(scenes, without))


def _incomplete(scenes: Dataset) -> Iterator[str]:
    annotated = scenes.annotated()
    nothing, featured = len(scenes) - len(annotated), len(annotated) - len(annotated.with_class())
    for number, lack, so in (
        (featured, "no class", ("it teaches features only", "they teach features only")),
        (nothing, "neither a class nor a feature", ("it is left out", "they are left out")),
    ):
        if number:
            have, what = ("has", so[0]) if number == 1 else ("have", so[1])
            yield (
                f"{scenes.table.name}: {number:,} of {len(scenes):,} pictures to train on {have} "
                f"{lack}: {what}"
            )


def _few(scenes: Dataset, without: Collection[str]) -> Iterator[str]:
    counts = Counter(scenes.labels)
    few = sorted(
        (name for name in scenes.domain.classes if name not in without and counts[name] < FEW),
        key=lambda name: counts[name],
    )
    if few:
        yield (
            f"{scenes.table.name}: few pictures of some classes ({_listed(few, counts)}); a few "
            "dozen of each are better"
        )


def _listed(names: Sequence[str], counts: Counter[str | None]) -> str:
    said = ", ".join(f"{name}: {counts[name]}" for name in names[:SHOWN])
    return said if len(names) <= SHOWN else f"{said} and {len(names) - SHOWN} more"
