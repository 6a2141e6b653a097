"""What is to be imported, and how, as data."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from seewhy.data.importers.boxes import ClassRule


@dataclass(frozen=True)
class ImportRequest:
    """What is to be imported, and how.

    Attributes
    ----------
    source : Path
        A folder, a zip archive, or the file that a tool exported.
    format : str
        One of :data:`~seewhy.data.annotation_formats.FORMATS`.
    pictures : Path or None
        The folder or archive of the pictures, where they lie elsewhere.
    features : Path or None
        A table class → features, which fills what a source does not say itself.
    class_parts : str or None
        What the names of classes are made of, such as ``number-colour-shape``.
    group : str or None
        A regular expression; what its first group (or all of it) finds in a picture's file name
        names the group of the picture.
    class_rule : {"only", "largest", "none"}
        The class that boxes give their picture, see
        :func:`~seewhy.data.importers.boxes.class_of_boxes`.
    image_column, class_column : str or None
        The columns (or controls) of the picture's path and of its class.
    inside : str or None
        The folder of a source whose folders are the classes.
    test_share : float
        The share of pictures that is kept for evaluation where the source has no splits.
    copy : bool
        Whether pictures are copied even where they could be linked.
    outside : bool
        Whether links are followed that lead out of the folders of the source and the pictures.
    """

    source: Path
    format: str
    pictures: Path | None = None
    features: Path | None = None
    class_parts: str | None = None
    group: str | None = None
    class_rule: ClassRule = "only"
    image_column: str | None = None
    class_column: str | None = None
    inside: str | None = None
    test_share: float = 0.0
    copy: bool = False
    outside: bool = False

    def settings(self) -> dict[str, str]:
        """What makes two imports the same one, as text."""
        return {
            "source": str(self.source.resolve()),
            "format": self.format,
            **{
                key: str(value)
                for key, value in (
                    ("pictures", self.pictures and self.pictures.resolve()),
                    ("features", self.features and self.features.resolve()),
                    ("class_parts", self.class_parts),
                    ("group", self.group),
                    ("class_rule", self.class_rule),
                    ("image_column", self.image_column),
                    ("class_column", self.class_column),
                    ("inside", self.inside),
                    ("test_share", self.test_share or None),
                    ("outside", self.outside or None),
                )
                if value is not None
            },
        }
