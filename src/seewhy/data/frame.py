"""Tables of pictures as pandas data frames."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

from seewhy.errors import DatasetError

__all__ = ["cells_of_frame"]


def cells_of_frame(frame: Any) -> tuple[tuple[str, ...], Iterator[tuple[str, ...]]]:
    """Return the columns of a data frame and its rows, as the cells that a table would have.

    What has named columns that can be gone through will do (pandas, polars).

    Raises
    ------
    DatasetError
        If it is no data frame.

    Examples
    --------
    >>> class Frame(dict):
    ...     columns = property(lambda self: list(self))
    >>> columns, rows = cells_of_frame(Frame(image=["a.png"], num_blocks=[3.0], lean=[None]))
    >>> columns, list(rows)
    (('image', 'num_blocks', 'lean'), [('a.png', '3', '')])
    """
    names = getattr(frame, "columns", None)
    if names is None:
        raise DatasetError(
            f"frame must be a data frame with named columns, got {type(frame).__name__}: read the "
            "table with pandas, or a folder with Dataset.load"
        )
    columns = tuple(str(name).strip() for name in names)
    if len(set(columns)) < len(columns):
        twice = next(name for name in columns if columns.count(name) > 1)
        raise DatasetError(f"the frame: the column '{twice}' stands twice; remove one")
    cells = [[_cell(value) for value in frame[name]] for name in names]
    return columns, zip(*cells, strict=True)


def _cell(value: Any) -> str:
    if value is None or _is_missing(value):
        return ""
    if isinstance(value, str):
        return value.strip()
    if type(value).__name__ in ("bool", "bool_"):
        return "yes" if value else "no"
    if isinstance(value, float) and value.is_integer():
        return str(int(value))  # pandas makes fractions of whole numbers where some are missing
    return str(value).strip()


def _is_missing(value: Any) -> bool:
    if isinstance(value, float):
        return value != value
    pandas = sys.modules.get("pandas")
    return pandas is not None and (value is pandas.NA or value is pandas.NaT)
