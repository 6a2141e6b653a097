"""Which pictures are kept for evaluation: a quarter of each class, and none that has trained."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from hashlib import sha256

from seewhy.data.importers.groups import SUGGESTED, group_of, grouping, suggested_groups
from seewhy.domain.tables import CLASS
from seewhy.domain.things import Things
from seewhy.errors import DatasetError
from seewhy.studio.labels import ROWS, Labels
from seewhy.studio.project import Project

__all__ = ["Kept", "keep_back", "kept", "place", "splits", "suggested_pattern"]

_SHARE = 4
"""One of so many is kept."""

_PATTERN = "together"
"""In the record's entry: the expression by which pictures belong together."""

TRAIN, TEST = "train", "test"
Kept = Counter[str]
"""How many labelled pictures are trained on (``train``) and evaluated on (``test``)."""


def splits(
    labels: Labels, groups: Mapping[str, str] | None = None, *, things: Things | None = None
) -> dict[str, str]:
    """Picture → split, for labelled pictures that have none yet; groups stay together.

    Parameters
    ----------
    labels : Labels
    groups : mapping of str to str or None
        Picture → its group, beside those that the labels have.
    things : Things or None
        The domain's, where its pictures show several: those in which each has a box are kept.

    What is kept is spread over the classes: of each every fourth, in an order that follows from
    the pictures' names alone.

    Examples
    --------
    >>> from seewhy.studio.label import Label
    >>> said = {f"{n}.png": {"class": Label("good", "Ada", "", "typed", n)} for n in range(8)}
    >>> sorted(splits(Labels(said)).values())
    ['test', 'test', 'train', 'train', 'train', 'train', 'train', 'train']
    """
    together: dict[str, list[str]] = {}
    for picture in _annotated(labels, things):
        group = labels.rows.get(picture, {}).get("group") or (groups or {}).get(picture)
        together.setdefault(group or f"/{picture}", []).append(picture)
    shown: Counter[tuple[str | None, str]] = Counter()
    found: dict[str, str] = {}
    for group in sorted(together, key=lambda name: sha256(name.encode()).digest()):
        pictures = together[group]
        given = {split for name in pictures if (split := _split(labels.rows, name))}
        label = _stratum(labels, pictures, things)
        if given:
            split = TRAIN if TRAIN in given else TEST
        else:
            # What has no class, or no boxes where there are things, tells too little: it trains.
            few = (
                _SHARE * (shown[label, TEST] + 1)
                <= sum(shown[label, split] for split in (TRAIN, TEST)) + 1
            )
            split = TEST if few and label is not None else TRAIN
        shown[label, split] += 1
        found |= {name: split for name in pictures if not _split(labels.rows, name)}
    return found


def kept(labels: Labels, things: Things | None = None) -> Kept:
    """How many labelled pictures are of each split; all train where none is kept.

    Where the domain has things, only pictures count whose things have boxes.
    """
    counted = labels.of if things is None else filter(labels.is_boxed, labels.drawn)
    return Counter(_split(labels.rows, picture) or TRAIN for picture in counted)


def keep_back(project: Project, *, who: str, pattern: str | None = None) -> None:
    """Keep a quarter of the labelled pictures for evaluation.

    Parameters
    ----------
    project : Project
    who : str
    pattern : str or None
        An expression for the part of their names that pictures share which belong together; empty
        where none do, None for what was said the last time.

    Raises
    ------
    DatasetError
        If it is no regular expression, or in no picture's name.
    """
    labels, things = project.labels(), project.domain().things
    pattern = _pattern_said(project) if pattern is None else pattern.strip()
    groups = _groups(_annotated(labels, things), pattern)
    found = splits(labels, groups, things=things)
    if not found:
        return
    rows: dict[str, dict[str, str]] = {}
    for name, split in found.items():
        group = {"group": groups[name]} if groups.get(name) else {}
        rows[name] = {**group, **labels.rows.get(name, {}), "split": split}
    project.note(ROWS, {"rows": rows, _PATTERN: pattern}, who=who)


def suggested_pattern(project: Project) -> str:
    """The expression that the names of the labelled pictures suggest; empty where they do not."""
    labels = project.labels()
    if any(row.get("group") for row in labels.rows.values()):
        return ""
    things = project.domain().things
    named = ((name, labels.value(name, CLASS) or "") for name in _annotated(labels, things))
    return SUGGESTED if suggested_groups(named) else ""


def place(project: Project, *, who: str) -> None:
    """Where pictures are kept for evaluation, give those labelled since a split, too.

    Without one they would neither be trained nor evaluated on.
    """
    labels, things = project.labels(), project.domain().things
    if any(_split(labels.rows, picture) for picture in _annotated(labels, things)):
        keep_back(project, who=who)


def _annotated(labels: Labels, things: Things | None) -> Sequence[str]:
    """The pictures of which anything is said."""
    return tuple(labels.of if things is None else {**labels.of, **labels.drawn})


def _stratum(labels: Labels, pictures: Sequence[str], things: Things | None) -> str | None:
    """Over what pictures that belong together are spread: the class; None where they all train."""
    if things is None:
        return labels.value(pictures[0], CLASS)
    boxed = (labels.value(name, CLASS) or "" for name in pictures if labels.is_boxed(name))
    return next(boxed, None)


def _pattern_said(project: Project) -> str:
    entries = reversed(project.record.holding(ROWS))
    said: Iterable[str] = (entry.body[_PATTERN] for entry in entries if _PATTERN in entry.body)
    return next(iter(said), "")


def _groups(pictures: Iterable[str], pattern: str) -> dict[str, str]:
    """Picture → its group, by a pattern that has to be found in some name."""
    expression = grouping(pattern or None, option="")
    if expression is None:
        return {}
    found = {picture: group_of(picture, expression) for picture in pictures}
    if found and not any(found.values()):
        raise DatasetError(
            f"'{pattern}' is found in no picture's name, the first is '{min(found)}'; correct the "
            "expression, or leave it empty"
        )
    return found


def _split(rows: Mapping[str, Mapping[str, str]], picture: str) -> str:
    return rows.get(picture, {}).get("split", "")
