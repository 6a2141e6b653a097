"""What is annotated of a project's pictures: a fold over its record."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.studio.drawn_things import BOXES, PictureThings, fold_boxes
from seewhy.studio.label import Label
from seewhy.studio.record import Entry

__all__ = ["LABEL", "REASONS", "ROWS", "Labels", "labels_of"]

LABEL = "label"
"""Body: ``values``, picture → feature or ``class`` → value (None: nobody knows), and ``how``.

``follows`` has what follows from them, as ``values`` has what was said.
"""

REASONS = "reasons"
"""Body: ``reasons``, picture → the features that its class rests on."""

ROWS = "rows"
"""Body: ``rows``, picture → ``split`` and ``group`` as scenes.csv has them."""


@dataclass(frozen=True)
class Labels:
    """All that is annotated.

    Attributes
    ----------
    of : mapping of str to mapping
        Picture → feature or ``class`` → label.
    reasons : mapping of str to tuple of str
        Picture → features.
    rows : mapping of str to mapping
        Picture → ``split`` and ``group``.
    drawn : mapping of str to PictureThings
        Picture → the things in it.
    """

    of: Mapping[str, Mapping[str, Label]] = field(default_factory=dict)
    reasons: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    rows: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    drawn: Mapping[str, PictureThings] = field(default_factory=dict)

    def value(self, picture: str, name: str) -> str | None:
        """The value of a feature, or the class, of a picture; None where nobody said it."""
        label = self.of.get(picture, {}).get(name)
        return None if label is None else label.value

    def values(self, picture: str) -> dict[str, str]:
        """Feature or ``class`` → value, of those that somebody said."""
        return {name: label.value for name, label in self.of.get(picture, {}).items()}

    def drawn_in(self, picture: str) -> PictureThings:
        """The things in a picture."""
        return self.drawn.get(picture, PictureThings())

    def is_boxed(self, picture: str) -> bool:
        """Whether all things in a picture have a box, or it is said to show none."""
        here = self.drawn_in(picture)
        things = here.things.values()
        return here.none or (bool(things) and all(thing.box for thing in things))

    def is_complete(self, picture: str, domain: Domain) -> bool:
        """Whether everything is said of a picture that the domain asks for.

        Of a domain with things some have to be drawn, and each needs all its features; or it is
        said that there are none.
        """
        said = self.of.get(picture, {})
        if not (
            all(name in said for name in domain.features) and (CLASS in said or not domain.classes)
        ):
            return False
        if domain.things is None:
            return True
        if self.drawn_in(picture).none:
            return True
        things = self.drawn_in(picture).things.values()
        return bool(things) and all(
            domain.things.features.keys() <= thing.values.keys() for thing in things
        )


def labels_of(entries: Iterable[Entry]) -> Labels:
    """Fold entries that hold, in their order; kinds that say nothing of pictures are passed over.

    Examples
    --------
    >>> said = Entry(1, "", "Ada", LABEL, {"values": {"a.png": {"colour": "red"}}, "how": "typed"})
    >>> labels_of([said]).value("a.png", "colour")
    'red'
    """
    of: dict[str, dict[str, Label]] = {}
    reasons: dict[str, tuple[str, ...]] = {}
    rows: dict[str, Mapping[str, str]] = {}
    drawn: dict[str, PictureThings] = {}
    for entry in entries:
        if entry.kind == LABEL:
            for key, how in (("values", entry.body["how"]), ("follows", "follows")):
                for picture, values in entry.body.get(key, {}).items():
                    _say(of.setdefault(picture, {}), values, entry, how)
        elif entry.kind == REASONS:
            reasons |= {
                picture: tuple(features) for picture, features in entry.body["reasons"].items()
            }
        elif entry.kind == ROWS:
            rows |= entry.body["rows"]
        elif entry.kind == BOXES:
            drawn = fold_boxes(drawn, entry)
    return Labels(of, reasons, rows, drawn)


def _say(found: dict[str, Label], values: Mapping[str, str | None], entry: Entry, how: str) -> None:
    for name, value in values.items():
        found.pop(name, None)
        if value is not None:
            found[name] = Label(value, entry.who, entry.at, how, entry.number)
