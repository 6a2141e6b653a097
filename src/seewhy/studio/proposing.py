"""What is proposed for the pictures, from heads that are trained anew behind the pages' back."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from threading import Event, Lock, Thread
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.errors import PictureError, SeeWhyError
from seewhy.labelling.following import Following
from seewhy.labelling.labelling_order import (
    Landscape,
    WorthLabelling,
    labelling_order,
    landscape,
)
from seewhy.labelling.quick_heads import HeldOutCounts, QuickHeads
from seewhy.labelling.spread_order import spread_order
from seewhy.studio.labels import Labels
from seewhy.studio.project import Project

if TYPE_CHECKING:
    from seewhy.perception.backbones.backbone import Backbone

__all__ = ["Embed", "Proposals", "Proposer", "backbone_embedding"]

Embed = Callable[[Sequence[Path], Domain], npt.NDArray[np.floating]]
"""Picture files → what heads look at, a row each; a PictureError where one cannot be read."""

AT_ONCE = 16
"""Pictures that are looked at between two looks at the labels."""

_FEWEST = 2  # pictures: with fewer, nothing can be told apart
_GROWN = 1.5  # heads look at all pictures anew when there are so many times more

AHEAD = 60
"""Pictures that are put in order of what a label is worth."""


@dataclass(frozen=True, eq=False)
class Proposals:
    """What the heads say, at one moment.

    Attributes
    ----------
    version : int
        Counts up with every training.
    pictures : mapping of str to int
        Picture → its row.
    values : mapping of str to tuple of str
        Feature, or ``class``, → its values.
    probabilities : mapping of str to ndarray of float, shape (pictures, values)
        Of features that are told apart already.
    by_rules : mapping of str to str
        Picture → the class that the rules conclude from its most probable features.
    order : tuple of (str, WorthLabelling)
        The pictures that are worth most, the first first.
    judged : mapping of str to HeldOutCounts
        How well each feature is recognised where it was kept out.
    looked_at, in_all : int
        Pictures that were looked at, and all.
    problem : str
        What keeps the heads from being trained; empty where nothing does.
    """

    version: int = 0
    pictures: Mapping[str, int] = field(default_factory=dict)
    values: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    probabilities: Mapping[str, npt.NDArray[np.float32]] = field(default_factory=dict)
    by_rules: Mapping[str, str] = field(default_factory=dict)
    order: tuple[tuple[str, WorthLabelling], ...] = ()
    judged: Mapping[str, HeldOutCounts] = field(default_factory=dict)
    looked_at: int = 0
    in_all: int = 0
    problem: str = ""

    def of(self, picture: str, name: str) -> dict[str, float]:
        """Value → probability, the most probable first; empty where nothing is proposed."""
        row, table = self.pictures.get(picture), self.probabilities.get(name)
        if row is None or table is None:
            return {}
        shares = table[row]
        order = np.argsort(-shares, kind="stable")
        return {self.values[name][place]: float(shares[place]) for place in order}

    def best(self, picture: str, name: str) -> tuple[str, float] | None:
        """The most probable value with its probability; None where nothing is proposed."""
        return next(iter(self.of(picture, name).items()), None)


class Proposer:
    """Looks at pictures and trains heads in a thread of its own.

    Pages tell it that something changed (:meth:`wake`), and show what it says last
    (:meth:`latest`); nobody waits for it.

    Parameters
    ----------
    project : Project
    embed : callable
        See :data:`Embed`.
    """

    def __init__(self, project: Project, embed: Embed) -> None:
        self._project = project
        self._embed = embed
        self._latest = Proposals()
        self._lock = Lock()
        self._changed = Event()
        self._ended = Event()
        self._idle = Event()
        self._rows: dict[str, npt.NDArray[np.floating]] = {}
        self._unreadable: set[str] = set()
        self._lesson: _Lesson | None = None
        self._following: Following | None = None
        self._thread = Thread(target=self._run, name="proposer", daemon=True)

    def start(self) -> None:
        """Begin to look at pictures, and again after every change of the project."""
        self._project.on_change = self.wake
        self._changed.set()
        self._thread.start()

    def wake(self) -> None:
        """Say that labels, pictures or the domain changed."""
        self._idle.clear()
        self._changed.set()

    def latest(self) -> Proposals:
        """What was said last."""
        with self._lock:
            return self._latest

    def settle(self, seconds: float) -> bool:
        """Wait until nothing is left to do; whether it came to that."""
        return self._idle.wait(seconds)

    def close(self) -> None:
        """End, after the pictures at hand."""
        self._ended.set()
        self._changed.set()
        if self._thread.is_alive():
            self._thread.join(timeout=10)

    def _run(self) -> None:
        while not self._ended.is_set():
            self._changed.wait()
            self._changed.clear()
            if self._ended.is_set():
                return
            try:
                self._work()
            except SeeWhyError as problem:
                self._publish(Proposals(self.latest().version + 1, problem=str(problem)))
            except Exception as problem:
                # Labelling goes on without proposals, and whoever labels reads why.
                said = f"there are no proposals ({type(problem).__name__}: {problem})"
                self._publish(Proposals(self.latest().version + 1, problem=said))
            if not self._changed.is_set():
                self._idle.set()

    def _work(self) -> None:
        if self._project.domain_folder is None:
            return
        while not self._ended.is_set():
            pictures = self._project.pictures()
            self._train(pictures, thoroughly=False)
            new = [
                name
                for name in self._wanted(pictures)
                if name not in self._rows and name not in self._unreadable
            ]
            if not new:
                break
            self._look_at(new[:AT_ONCE])
        self._train(self._project.pictures(), thoroughly=True)

    def _wanted(self, pictures: Sequence[str]) -> Sequence[str]:
        """Labelled pictures first, then a few of everywhere: heads begin early, and so."""
        labelled = self._project.labels().of
        others = [name for name in pictures if name not in labelled]
        return [name for name in pictures if name in labelled] + [
            others[place] for place in spread_order(len(others))
        ]

    def _look_at(self, names: Sequence[str]) -> None:
        domain = self._project.domain()
        files = [self._project.folder / name for name in names]
        try:
            self._rows |= dict(zip(names, self._embed(files, domain), strict=True))
        except PictureError:
            for name, file in zip(names, files, strict=True):
                try:
                    self._rows[name] = self._embed([file], domain)[0]
                except PictureError:
                    self._unreadable.add(name)

    def _train(self, pictures: Sequence[str], *, thoroughly: bool) -> None:
        lesson = self._lesson_of([name for name in pictures if name in self._rows], thoroughly)
        if lesson is None:
            return
        names, heads = lesson.names, lesson.heads
        domain, labels = self._project.domain(), self._project.labels()
        values = {key: feature.values for key, feature in domain.features.items()}
        if domain.classes:
            values = {CLASS: tuple(domain.classes), **values}
        targets = {name: _targets(labels, names, name, known) for name, known in values.items()}
        probabilities = {
            name: heads.probabilities(name, targets[name], values=len(known))
            for name, known in values.items()
            if len(np.unique(targets[name][targets[name] >= 0])) > 1
        }
        by_rules = self._by_rules(domain, names, probabilities, values)
        order = labelling_order(
            lesson.lie,
            probabilities,
            [row for row, name in enumerate(names) if labels.is_complete(name, domain)],
            count=AHEAD,
            disputed=_disputed(names, by_rules, probabilities, values),
        )
        judged = self.latest().judged
        if thoroughly:
            judged = {
                name: heads.held_out(name, targets[name], values=len(known))
                for name, known in values.items()
            }
        self._publish(
            Proposals(
                version=self.latest().version + 1,
                pictures={name: row for row, name in enumerate(names)},
                values=values,
                probabilities=probabilities,
                by_rules=by_rules,
                order=tuple((names[found.place], found) for found in order),
                judged=judged,
                looked_at=len(self._rows),
                in_all=len(pictures),
            )
        )

    def _lesson_of(self, names: Sequence[str], thoroughly: bool) -> _Lesson | None:
        """Heads on the pictures that were looked at; made anew where there are many more."""
        known = self._lesson
        if len(names) < _FEWEST:
            return None
        grown = known is None or len(names) >= _GROWN * len(known.names)
        if known is None or grown or (thoroughly and tuple(names) != known.names):
            heads = QuickHeads(np.stack([self._rows[name] for name in names]).astype(np.float32))
            known = self._lesson = _Lesson(tuple(names), heads, landscape(heads.components))
        return known

    def _by_rules(
        self,
        domain: Domain,
        names: Sequence[str],
        probabilities: Mapping[str, npt.NDArray[np.float32]],
        values: Mapping[str, tuple[str, ...]],
    ) -> dict[str, str]:
        if not domain.features or any(name not in probabilities for name in domain.features):
            return {}
        if domain.things is not None:
            return {}  # the class rests on things, of which the heads know nothing
        if self._following is None or self._following.domain is not domain:
            self._following = Following(domain)
        columns = [
            [values[name][place] for place in probabilities[name].argmax(axis=1)]
            for name in domain.features
        ]
        try:
            decisions = self._following.reasoner.decide_all(list(zip(*columns, strict=True)))
        except SeeWhyError:
            return {}  # the page Rules says what is wrong with them
        return {
            name: decision.label
            for name, decision in zip(names, decisions, strict=True)
            if decision.label is not None
        }

    def _publish(self, proposals: Proposals) -> None:
        with self._lock:
            self._latest = proposals


@dataclass(frozen=True, eq=False)
class _Lesson:
    """Pictures that were looked at, what is trained on them, and how they lie."""

    names: tuple[str, ...]
    heads: QuickHeads
    lie: Landscape


def backbone_embedding() -> Embed:
    """What the domain's backbone makes of pictures, kept in the user's cache.

    Where a domain's networks grow from drawings (``eyes = "none"``), the embedded backbone looks.
    """

    def embed(files: Sequence[Path], domain: Domain) -> npt.NDArray[np.floating]:
        from seewhy.files.cache_folder import cache_folder
        from seewhy.perception.backbones import EMBEDDED, NONE, load_backbone
        from seewhy.perception.embedding import embed_pictures
        from seewhy.perception.embedding_cache import EmbeddingCache
        from seewhy.perception.picture import read_picture

        eyes = domain.eyes_after(0)
        eyes = EMBEDDED if eyes == NONE else eyes
        if eyes not in loaded:
            loaded[eyes] = load_backbone(eyes)
        backbone = loaded[eyes]
        shown = np.stack(
            [read_picture(file, size=backbone.side, fit=domain.pictures.fit) for file in files]
        )
        return embed_pictures(backbone, [shown], cache=EmbeddingCache(cache_folder())).pooled

    loaded: dict[str, Backbone] = {}
    return embed


def _targets(
    labels: Labels, pictures: Sequence[str], name: str, values: Sequence[str]
) -> npt.NDArray[np.int64]:
    places = {value: place for place, value in enumerate(values)}
    said = (labels.value(picture, name) for picture in pictures)
    return np.array([places.get(value or "", -1) for value in said], dtype=np.int64)


def _disputed(
    names: Sequence[str],
    by_rules: Mapping[str, str],
    probabilities: Mapping[str, npt.NDArray[np.float32]],
    values: Mapping[str, tuple[str, ...]],
) -> npt.NDArray[np.bool_]:
    """Where the rules conclude another class than the head of the class sees."""
    if CLASS not in probabilities:
        return np.zeros(len(names), dtype=bool)
    seen = (values[CLASS][place] for place in probabilities[CLASS].argmax(axis=1))
    return np.array(
        [by_rules.get(name, label) != label for name, label in zip(names, seen, strict=True)]
    )
