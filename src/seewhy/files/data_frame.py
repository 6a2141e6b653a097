"""Tables as pandas data frames, where pandas is installed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from seewhy.errors import SeeWhyError

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["data_frame"]


def data_frame(columns: Mapping[str, Sequence[object]]) -> pd.DataFrame:
    """Return a data frame; text stays what it is, None is where there is none.

    Raises
    ------
    SeeWhyError
        If pandas is not installed.

    Examples
    --------
    >>> data_frame({"class": ["good", None], "support": [3, 4]}).shape
    (2, 2)
    """
    try:
        import pandas as pd
    except ModuleNotFoundError:
        raise SeeWhyError(
            "pandas is not installed, which data frames need; install it with "
            "pip install 'seewhy[tables]'"
        ) from None
    series = {
        name: pd.Series(list(cells), dtype=object if _is_text(cells) else None)
        for name, cells in columns.items()
    }
    return pd.DataFrame(series)


def _is_text(cells: Sequence[object]) -> bool:
    return any(cell is None or isinstance(cell, str) for cell in cells)
