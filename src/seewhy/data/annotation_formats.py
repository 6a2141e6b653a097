"""The names of the formats that annotated pictures are imported from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, get_args

from seewhy.errors import DatasetError

__all__ = ["FORMATS", "SAID", "Format", "format_called"]

Format = Literal["folder", "coco", "voc", "yolo", "labelstudio", "cvat", "table"]
"""What a source may be in."""

FORMATS: tuple[Format, ...] = get_args(Format)

SAID = {
    "folder": "class folders",
    "coco": "COCO",
    "voc": "Pascal VOC",
    "yolo": "YOLO",
    "labelstudio": "Label Studio",
    "cvat": "CVAT for images",
    "table": "a table with a row a picture",
}
"""Format → how it is called in a sentence."""


def format_called(name: str, *, beside: Sequence[str] = ()) -> Format:
    """Return the format of a name.

    Parameters
    ----------
    name : str
    beside : sequence of str, optional
        Other names that may have been meant.

    Raises
    ------
    DatasetError
        If there is none; the text gives the nearest.

    Examples
    --------
    >>> format_called("coco")
    'coco'
    """
    for known in FORMATS:
        if known == name:
            return known
    from seewhy.text.nearest import did_you_mean  # slow to import, and most names are right

    nearest = did_you_mean(name, (*FORMATS, *beside))
    raise DatasetError(f"'{name}' is no format that is imported; {nearest}")
