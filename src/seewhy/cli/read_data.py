"""Read a dataset for a command: what is wrong with it is said before anything long begins."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy.cli.screen import progress, remark

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset
    from seewhy.domain.domain import Domain


def read_data(
    folder: Path,
    domain: Domain,
    *,
    outside: bool = False,
    evaluated: bool = False,
    before_notices: Callable[[Dataset], None] | None = None,
) -> Dataset:
    """Read a dataset, compare its pictures, and remark on what shows the same.

    Parameters
    ----------
    folder : Path
    domain : Domain
    outside : bool, default False
        See :meth:`~seewhy.data.dataset.Dataset.load`.
    evaluated : bool, default False
        Whether there must be pictures to test on that are not trained on.
    before_notices : callable, optional
        Called with the dataset before anything is remarked on, to say what matters more.

    Raises
    ------
    DatasetError, PictureError
        If the table is wrong, contradicts itself, or names what is no picture.
    """
    from seewhy.data.dataset import Dataset
    from seewhy.data.duplicates import settle_duplicates

    dataset = Dataset.load(folder, domain, outside=outside)
    with progress() as bars:
        task = bars.add_task("comparing pictures", total=len(dataset))
        settled = settle_duplicates(
            dataset, on_progress=lambda done: bars.update(task, completed=done)
        )
    if evaluated:
        settled.require_test_pictures()
    if before_notices is not None:
        before_notices(settled.dataset)
    for notice in settled.notices:
        remark(notice)
    return settled.dataset
