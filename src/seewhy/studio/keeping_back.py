"""Which pictures are kept for evaluation: a quarter of each class, and none that has trained."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from hashlib import sha256

from seewhy.domain.tables import CLASS
from seewhy.studio.labels import ROWS, Labels
from seewhy.studio.project import Project

__all__ = ["Kept", "keep_back", "kept", "place", "splits"]

_SHARE = 4
"""One of so many is kept."""

TRAIN, TEST = "train", "test"
Kept = Counter[str]
"""How many labelled pictures are trained on (``train``) and evaluated on (``test``)."""


def splits(labels: Labels) -> dict[str, str]:
    """Picture → split, for labelled pictures that have none yet; groups stay together.

    What is kept is spread over the classes: of each every fourth, in an order that follows from
    the pictures' names alone.

    Examples
    --------
    >>> from seewhy.studio.labels import Label
    >>> said = {f"{n}.png": {"class": Label("good", "Ada", "", "typed", n)} for n in range(8)}
    >>> sorted(splits(Labels(said)).values())
    ['test', 'test', 'train', 'train', 'train', 'train', 'train', 'train']
    """
    groups: dict[str, list[str]] = {}
    for picture in labels.of:
        group = labels.rows.get(picture, {}).get("group") or f"/{picture}"
        groups.setdefault(group, []).append(picture)
    shown: Counter[tuple[str | None, str]] = Counter()
    found: dict[str, str] = {}
    for group in sorted(groups, key=lambda name: sha256(name.encode()).digest()):
        pictures = groups[group]
        given = {split for name in pictures if (split := _split(labels.rows, name))}
        label = labels.value(pictures[0], CLASS)
        if given:
            split = TRAIN if TRAIN in given else TEST
        else:
            # What has no class tells nothing of classes: it trains.
            few = (
                _SHARE * (shown[label, TEST] + 1)
                <= sum(shown[label, one] for one in (TRAIN, TEST)) + 1
            )
            split = TEST if few and label is not None else TRAIN
        shown[label, split] += 1
        found |= {name: split for name in pictures if not _split(labels.rows, name)}
    return found


def kept(labels: Labels) -> Kept:
    """How many labelled pictures are of each split; all train where none is kept."""
    return Counter(_split(labels.rows, picture) or TRAIN for picture in labels.of)


def keep_back(project: Project, *, who: str) -> None:
    """Keep a quarter of the labelled pictures for evaluation."""
    labels = project.labels()
    found = splits(labels)
    if found:
        rows = {
            name: {**labels.rows.get(name, {}), "split": split} for name, split in found.items()
        }
        project.note(ROWS, {"rows": rows}, who=who)


def place(project: Project, *, who: str) -> None:
    """Where pictures are kept for evaluation, give those labelled since a split, too.

    Without one they would neither be trained nor evaluated on.
    """
    labels = project.labels()
    if any(_split(labels.rows, picture) for picture in labels.of):
        keep_back(project, who=who)


def _split(rows: Mapping[str, Mapping[str, str]], picture: str) -> str:
    return rows.get(picture, {}).get("split", "")
