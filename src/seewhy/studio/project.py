"""A studio's project: one folder with pictures, a domain, the dataset, a model and the record."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from threading import RLock
from typing import Any

from seewhy.data.dataset import TABLE, Dataset
from seewhy.data.importers.annotation import Notes
from seewhy.data.importers.folder_files import FolderFiles
from seewhy.data.importers.picture_files import is_picture_name
from seewhy.data.thing import THINGS
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.tables import CLASS
from seewhy.domain.things import Things
from seewhy.errors import DomainError, KnowledgeError, RevisionError, SeeWhyError
from seewhy.revision.edit import KNOWLEDGE, Edit
from seewhy.studio.drawn_things import BOXES, require_possible
from seewhy.studio.labels import LABEL, REASONS, ROWS, Labels, labels_of
from seewhy.studio.record import Entry, Record
from seewhy.studio.revised_domain import revised_domain
from seewhy.studio.thing_writing import changes_in_tables, things_tables
from seewhy.studio.writing import (
    FILES,
    changed_outside,
    folder_texts,
    outside_body,
    read_text,
    revision_body,
    scenes_table,
    write_text,
)

__all__ = ["Project"]

_RECORD = "studio.sqlite"
_DOMAIN_FILE = "domain.toml"
_MODEL_FILE = "model.json"
_OF_DOMAIN = (_DOMAIN_FILE, KNOWLEDGE, "questions.toml", "classes.csv")
_OUTSIDE = "another program"


class Project:
    """A folder that the studio works on.

    The folder is a dataset: pictures, and ``scenes.csv`` beside them. In it lie the domain (the
    first folder with a ``domain.toml``), the model (``model/``) and ``studio.sqlite``, the record.
    The record says what holds; the files are written from it.

    Parameters
    ----------
    folder : Path
        Made where it is missing.

    Attributes
    ----------
    on_change : callable
        Called after whatever changed the record or the pictures.

    Raises
    ------
    SeeWhyError
        If the folder is a model, whose files are not to be changed, or no folder.
    """

    def __init__(self, folder: Path) -> None:
        if (folder / _MODEL_FILE).is_file():
            raise SeeWhyError(
                f"{folder} is a model, whose files are not to be changed; give the studio a folder "
                "of its own ('seewhy studio NAME') and open the model there"
            )
        if folder.exists() and not folder.is_dir():
            raise SeeWhyError(f"{folder} is no folder; name one, new or with pictures")
        folder.mkdir(parents=True, exist_ok=True)
        self.folder = folder.resolve()
        self.record = Record(self.folder / _RECORD)
        self._lock = RLock()
        self._domain: tuple[Mapping[str, str], Domain] | None = None
        self._labels: tuple[Sequence[Entry], Labels] | None = None
        self._pictures: tuple[str, ...] | None = None
        self.on_change: Callable[[], None] = lambda: None
        self.refresh()

    # What there is ----------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """How the project is called."""
        return self.folder.name

    @property
    def domain_folder(self) -> Path | None:
        """The domain's folder; None where there is no domain yet."""
        if (self.folder / _DOMAIN_FILE).is_file():
            return self.folder
        found = sorted(
            place.parent
            for place in self.folder.glob(f"*/{_DOMAIN_FILE}")
            if not place.parent.is_symlink() and not place.parent.name.startswith(".")
        )
        return found[0] if found else None

    @property
    def model_folder(self) -> Path:
        """Where the model lies, or will lie."""
        return self.folder / "model"

    @property
    def has_model(self) -> bool:
        """Whether a model has been trained, or opened."""
        return (self.model_folder / _MODEL_FILE).is_file()

    def domain(self) -> Domain:
        """The domain as its files say it now.

        Raises
        ------
        SeeWhyError
            If there is none yet.
        DomainError, KnowledgeError
            If its files are wrong.
        """
        folder = self.domain_folder
        if folder is None:
            raise SeeWhyError("there is no domain yet; begin with one")
        with self._lock:
            texts = _texts_in(folder)
            if self._domain is None or self._domain[0] != texts:
                self._domain = (texts, load_domain(folder))
            return self._domain[1]

    @property
    def has_things(self) -> bool:
        """Whether the domain's pictures show several things; not where its files are wrong."""
        domain = None if self.domain_folder is None else self._usable_domain()
        return domain is not None and domain.things is not None

    def pictures(self) -> Sequence[str]:
        """The names of the pictures, as scenes.csv has them: paths from the folder."""
        with self._lock:
            if self._pictures is None:
                apart = [f"{self.model_folder.name}/"]
                domain = self.domain_folder
                if domain is not None and domain != self.folder:
                    apart.append(f"{domain.name}/")
                files = FolderFiles(self.folder, Notes())
                self._pictures = tuple(
                    name
                    for name in files.names
                    if is_picture_name(name)
                    and not name.startswith((".", *apart))
                    and "/." not in name
                )
            return self._pictures

    def picture_file(self, name: str) -> Path:
        """The file of a picture of the project.

        Raises
        ------
        LookupError
            If it is none: only names that :meth:`pictures` lists are looked for.
        """
        if name not in set(self.pictures()):
            raise LookupError(f"'{name}' is no picture of the project")
        return self.folder / name

    def labels(self) -> Labels:
        """What is annotated of the pictures."""
        with self._lock:
            entries = self.record.holding()
            if self._labels is None or self._labels[0] != entries:
                self._labels = (entries, labels_of(entries))
            return self._labels[1]

    def dataset(self) -> Dataset:
        """The dataset as the command line sees it."""
        with self._lock:
            return Dataset.load(self.folder, self.domain())

    # What is done -----------------------------------------------------------------------------

    def note(self, kind: str, body: Mapping[str, Any], *, who: str) -> Entry:
        """Add to the record what was done, and write the files that it changes."""
        with self._lock:
            self._take_in_changes()
            entry = self.record.add(kind, body, who=who)
            self._write()
        self.on_change()
        return entry

    def label(
        self, values: Mapping[str, Mapping[str, str | None]], *, who: str, how: str = "typed"
    ) -> Entry:
        """Annotate pictures: picture → feature or ``class`` → value (None: nobody knows)."""
        return self.note(LABEL, {"values": values, "how": how}, who=who)

    def revise(self, edits: Iterable[Edit], *, why: str, who: str) -> Entry:
        """Edit files of the domain, as one revision that can be taken back.

        Raises
        ------
        RevisionError, DomainError, KnowledgeError
            If what an edit replaces does not stand in its file; if the knowledge would be broken.
        """
        body = revision_body(edits, why=why)
        with self._lock:
            self._take_in_changes()
            held = (*self.record.holding(FILES), Entry(0, "", who, FILES, body))
            self._require_readable(folder_texts(held))
            return self.note(FILES, body, who=who)

    def take_back(self, number: int, *, who: str) -> Entry:
        """Take an entry of the record back, and write the files as they were without it.

        Raises
        ------
        SeeWhyError
            If it does not hold, or the knowledge would be broken without it.
        """
        with self._lock:
            self._take_in_changes()
            self._require_without(number)
            entry = self.record.take_back(number, who=who)
            self._write()
        self.on_change()
        return entry

    def refresh(self, *, who: str = _OUTSIDE, why: str = "changed outside") -> None:
        """Look at the folder anew: pictures that came, and files that somebody changed.

        Parameters
        ----------
        who, why : str
            Who wrote the domain's files that the record does not know yet, and why.
        """
        with self._lock:
            self._pictures = None
            self._take_in_changes(who=who, why=why)
            self._write()
        self.on_change()

    def _require_without(self, number: int) -> None:
        """Refuse to take back what a later revision, or a later box, builds on."""
        self._require_boxes_without(number)
        before = self.record.holding(FILES)
        after = self.record.holding(FILES, but=number)
        if after == before:
            return
        try:
            self._require_readable(folder_texts(after))
        except (RevisionError, DomainError, KnowledgeError) as problem:
            raise RevisionError(
                f"entry {number} cannot be taken back: {problem}; take back first what was "
                "revised later"
            ) from None

    def _require_boxes_without(self, number: int) -> None:
        domain = self._usable_domain()
        if domain is None or domain.things is None:
            return
        known = self.labels()
        without = labels_of(self.record.holding(but=number))
        try:
            for picture, here in without.drawn.items():
                if here != known.drawn_in(picture):
                    require_possible(picture, here, domain.things)
        except SeeWhyError as problem:
            raise SeeWhyError(f"entry {number} cannot be taken back: {problem}") from None

    def _require_readable(self, texts: Mapping[str, str]) -> None:
        folder = self.domain_folder
        if folder is not None:
            revised_domain(folder, texts)

    # Files ------------------------------------------------------------------------------------

    def _usable_domain(self) -> Domain | None:
        """The domain, unless its files are wrong: then the table waits until they are mended."""
        try:
            return self.domain()
        except (DomainError, KnowledgeError):
            return None

    def _write(self) -> None:
        folder = self.domain_folder
        if folder is None:
            return
        for name, text in folder_texts(self.record.holding(FILES)).items():
            write_text(folder / name, text, record=self.record, name=name)
        domain = self._usable_domain()
        if domain is None:
            return
        labels, record = self.labels(), self.record
        if labels.of or labels.rows or labels.drawn or record.written(TABLE):
            write_text(self.folder / TABLE, scenes_table(labels, domain), record=record, name=TABLE)
        if domain.things is None:
            return
        for name, text in things_tables(labels.drawn, domain.things).items():
            is_said = name == THINGS or any(here.related for here in labels.drawn.values())
            if (labels.drawn and is_said) or record.written(name):
                write_text(self.folder / name, text, record=record, name=name)

    def _take_in_changes(self, *, who: str = _OUTSIDE, why: str = "changed outside") -> None:
        """Note what another program wrote, so that nothing of it is written over."""
        folder = self.domain_folder
        if folder is None:
            return
        said = folder_texts(self.record.holding(FILES))
        found = _texts_in(folder)
        changed = {
            name: text
            for name, text in found.items()
            if changed_outside(folder / name, said, record=self.record, name=name)
        }
        if changed:
            self.record.add(FILES, outside_body(said, changed, why=why), who=who)
        table, domain = self.folder / TABLE, self._usable_domain()
        none: dict[str, bool] = {}
        if domain is not None and table.is_file():
            texts = {TABLE: scenes_table(self.labels(), domain)}
            if changed_outside(table, texts, record=self.record, name=TABLE):
                none = self._take_in_table()
        if domain is not None and domain.things is not None:
            self._take_in_things(domain, domain.things)
        if none:
            self.record.add(BOXES, {"none": none, "how": "table"}, who=_OUTSIDE)

    def _take_in_table(self) -> dict[str, bool]:
        """Take in scenes.csv; of which pictures it says otherwise whether anything is there.

        What is there stands in things.csv, which is taken in first.
        """
        dataset, labels = self.dataset(), self.labels()
        values: dict[str, dict[str, str | None]] = {}
        rows: dict[str, dict[str, str]] = {}
        reasons: dict[str, list[str]] = {}
        none: dict[str, bool] = {}
        for scene in dataset.scenes:
            name = scene.picture.relative_to(self.folder).as_posix()
            said = {CLASS: scene.label, **dataset.domain.named(scene.vector)}
            changed = {
                key: value for key, value in said.items() if labels.value(name, key) != value
            }
            if changed:
                values[name] = changed
            placed = {
                key: text for key, text in (("split", scene.split), ("group", scene.group)) if text
            }
            if placed != dict(labels.rows.get(name, {})):
                rows[name] = placed
            if scene.no_things != labels.drawn_in(name).none:
                none[name] = scene.no_things
            if scene.reasons != labels.reasons.get(name, ()):
                reasons[name] = list(scene.reasons)
        listed = {scene.picture.relative_to(self.folder).as_posix() for scene in dataset.scenes}
        for name in set(labels.of) - listed:
            values[name] = dict.fromkeys(labels.of[name])
        none |= {
            name: False for name, here in labels.drawn.items() if here.none and name not in listed
        }
        if values:
            self.record.add(LABEL, {"values": values, "how": "table"}, who=_OUTSIDE)
        if rows:
            self.record.add(ROWS, {"rows": rows}, who=_OUTSIDE)
        if reasons:
            self.record.add(REASONS, {"reasons": reasons}, who=_OUTSIDE)
        return none

    def _take_in_things(self, domain: Domain, things: Things) -> None:
        drawn = self.labels().drawn
        texts = things_tables(drawn, things)
        if not any(
            changed_outside(self.folder / name, texts, record=self.record, name=name)
            for name in texts
        ):
            return
        body = changes_in_tables(self.folder, self.pictures(), domain, drawn)
        if body is not None:
            self.record.add(BOXES, body, who=_OUTSIDE)


def _texts_in(folder: Path) -> dict[str, str]:
    texts = {name: read_text(folder / name) for name in _OF_DOMAIN}
    return {name: text for name, text in texts.items() if text is not None}
