"""Tables as the text of CSV files."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

__all__ = ["csv_text"]


def csv_text(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    r"""Return the text of a CSV file: the names of its columns, then a line a row.

    Examples
    --------
    >>> csv_text(["image", "class"], [("a.png", "good, or not")])
    'image,class\na.png,"good, or not"\n'
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return text.getvalue()
