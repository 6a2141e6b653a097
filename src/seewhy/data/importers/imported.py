"""What an import has written."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from seewhy.data.importers.annotation import Note


@dataclass(frozen=True)
class ImportedDataset:
    """The dataset written, and what was found on the way.

    Attributes
    ----------
    folder : Path
    format : str
    pictures : int
    linked : bool
        Whether the pictures are the source's own files (hard links), not copies.
    classes : dict of str to int
        Class → how many pictures are of it; "" for those without one.
    features : dict of str to dict of str to int
        Feature → value → how many pictures have it.
    splits : dict of str to int
    groups : int
        0 where the source says none.
    kinds : dict of str to int
        Kind of thing → how many boxes are of it.
    notes : tuple of Note
        What was not as it should be, and where.
    """

    folder: Path
    format: str
    pictures: int
    linked: bool
    classes: dict[str, int]
    features: dict[str, dict[str, int]]
    splits: dict[str, int]
    groups: int
    kinds: dict[str, int]
    notes: tuple[Note, ...]

    @property
    def things(self) -> int:
        """How many boxes there are."""
        return sum(self.kinds.values())

    def as_json(self) -> dict[str, Any]:
        """Everything, for a program."""
        return {
            "folder": str(self.folder),
            "format": self.format,
            "pictures": self.pictures,
            "linked": self.linked,
            "classes": self.classes,
            "features": self.features,
            "splits": self.splits,
            "groups": self.groups,
            "things": self.things,
            "kinds": self.kinds,
            "notes": [{"text": note.text, "places": list(note.places)} for note in self.notes],
        }
