"""Which bundled domain a dataset folder is of, told by the columns of its table."""

from __future__ import annotations

import csv
from pathlib import Path

from seewhy.data.dataset import TABLE
from seewhy.domain import Domain, bundled_domains, load_domain
from seewhy.errors import DatasetError


def domain_of(folder: Path) -> Domain:
    """Return the bundled domain all of whose features are columns of the folder's table.

    Raises
    ------
    DatasetError
        If there is no table, or no bundled domain fits.
    """
    table = folder / TABLE
    if not table.is_file():
        raise DatasetError(f"{folder}: there is no dataset here, a folder with a {TABLE}")
    with table.open(newline="", encoding="utf-8-sig", errors="replace") as stream:
        columns = {name.strip() for name in next(csv.reader(stream), [])}
    for name in bundled_domains():
        domain = load_domain(name)
        if set(domain.features) <= columns:
            return domain
    raise DatasetError(
        f"{table}: the columns fit none of the bundled domains ({', '.join(bundled_domains())}); "
        "name the domain or its folder with --domain"
    )
