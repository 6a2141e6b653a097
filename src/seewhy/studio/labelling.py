"""What is done to labels: a value said, with what follows from it; undone; done again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any
from weakref import WeakKeyDictionary

from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.errors import SeeWhyError
from seewhy.labelling.following import Following
from seewhy.studio.drawn_things import BOXES
from seewhy.studio.labels import LABEL, REASONS
from seewhy.studio.project import Project
from seewhy.studio.record import UNDO, Entry
from seewhy.studio.writing import FILES
from seewhy.text.nearest import did_you_mean

__all__ = [
    "bring_back",
    "choose",
    "class_comes_first",
    "last_undone",
    "pictures_of",
    "reasons_with",
    "take_back_last",
]

KINDS = (LABEL, REASONS, BOXES)
"""Kinds of entries that the page Label makes, and takes back; revisions of rules, too."""

_following: WeakKeyDictionary[Project, Following] = WeakKeyDictionary()


def choose(
    project: Project,
    values: Mapping[str, Mapping[str, str | None]],
    *,
    who: str,
    how: str,
) -> Entry:
    """Annotate pictures, and fill in what follows; what no longer follows is open again.

    Parameters
    ----------
    project : Project
    values : mapping
        Picture → feature or ``class`` → value, None for nobody knows.
    who, how : str
        See :class:`~seewhy.studio.labels.Label`.

    Raises
    ------
    SeeWhyError
        If a feature or a value is none of the domain.
    """
    domain, labels = project.domain(), project.labels()
    following = _following_of(project)
    follows: dict[str, dict[str, str | None]] = {}
    for picture, said in values.items():
        for name, value in said.items():
            _check(domain, name, value)
        known = labels.of.get(picture, {})
        kept = {name: label.value for name, label in known.items() if label.how != "follows"}
        for name, value in said.items():
            if value is None:
                kept.pop(name, None)
            else:
                kept[name] = value
        now: dict[str, str | None] = dict(following.features_of(kept))
        before = {name: label.value for name, label in known.items() if label.how == "follows"}
        gone = dict.fromkeys(name for name in before if name not in now and name not in said)
        changed = {name: value for name, value in now.items() if before.get(name) != value}
        if changed or gone:
            follows[picture] = {**gone, **changed}
    body: dict[str, Any] = {"values": {name: dict(said) for name, said in values.items()}}
    if follows:
        body["follows"] = follows
    return project.note(LABEL, {**body, "how": how}, who=who)


def class_comes_first(project: Project) -> bool:
    """Whether features follow from the class by a table, so that it is asked for first."""
    return bool(_following_of(project).table)


def reasons_with(project: Project, picture: str, feature: str) -> list[str]:
    """The features that a class rests on, after one was added or removed.

    Raises
    ------
    SeeWhyError
        If it is no feature.
    """
    features = project.domain().features
    if feature not in features:
        raise SeeWhyError(f"'{feature}' is no feature; {did_you_mean(feature, features)}")
    before = set(project.labels().reasons.get(picture, ()))
    return [name for name in features if name in before ^ {feature}]


def take_back_last(project: Project, *, who: str) -> Entry | None:
    """Take back the last thing that was done to labels or rules; None where nothing is left.

    Raises
    ------
    SeeWhyError
        If something that came later builds on it.
    """
    entry = next(filter(_is_act, reversed(project.record.holding())), None)
    if entry is not None:
        project.take_back(entry.number, who=who)
    return entry


def last_undone(project: Project) -> Entry | None:
    """The last undoing of what was done to labels or rules, if nothing was done to them since."""
    by_number = {entry.number: entry for entry in project.record.all()}
    for entry in reversed(project.record.holding(*KINDS, FILES, UNDO)):
        if _is_act(entry):
            return None
        if entry.kind == UNDO and _is_act(by_number[entry.takes_back or 0]):
            return entry
    return None


def _is_act(entry: Entry) -> bool:
    """Whether somebody did it here; what another program wrote has whole files."""
    return entry.kind in KINDS or (entry.kind == FILES and "files" not in entry.body)


def bring_back(project: Project, undoing: Entry, *, who: str) -> Entry:
    """Take an undoing back; return what holds again."""
    project.take_back(undoing.number, who=who)
    return next(e for e in project.record.all() if e.number == undoing.takes_back)


def pictures_of(entry: Entry) -> tuple[str, ...]:
    """The pictures that an entry is about."""
    keys = ("values", "reasons", "boxes", "related", "none")
    return tuple(dict.fromkeys(name for key in keys for name in entry.body.get(key, ())))


def _following_of(project: Project) -> Following:
    domain = project.domain()
    found = _following.get(project)
    if found is None or found.domain is not domain:
        found = _following[project] = Following(domain)
    return found


def _check(domain: Domain, name: str, value: str | None) -> None:
    if name == CLASS:
        known, what = tuple(domain.classes), "class"
    elif name in domain.features:
        known, what = domain.features[name].values, f"value of '{name}'"
    else:
        raise SeeWhyError(f"'{name}' is no feature; {did_you_mean(name, domain.features)}")
    if value is not None and value not in known:
        raise SeeWhyError(f"'{value}' is no {what}; {did_you_mean(value, known)}")
