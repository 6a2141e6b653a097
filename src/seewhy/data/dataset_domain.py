"""Which bundled domain a dataset folder is of, told by the columns of its table."""

from __future__ import annotations

from pathlib import Path

from seewhy.data.dataset import TABLE
from seewhy.data.scene_rows import OPTIONAL, columns_of
from seewhy.data.table import read_table
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.folder import bundled_domains
from seewhy.errors import DatasetError


def domain_of(folder: Path) -> Domain:
    """Return the bundled domain all of whose features are columns of the folder's table.

    Raises
    ------
    DatasetError
        If there is no table, or no bundled domain fits.
    """
    file = folder / TABLE
    if not file.is_file():
        raise DatasetError(f"{folder}: there is no dataset here, a folder with a {TABLE}")
    domains = [load_domain(name) for name in bundled_domains()]
    known = dict.fromkeys(column for domain in domains for column in columns_of(domain))
    columns = set(read_table(file, known=known, optional=OPTIONAL).columns)
    for domain in domains:
        if domain.features and set(domain.features) <= columns:
            return domain
    raise DatasetError(
        f"{file}: the columns fit none of the bundled domains ({', '.join(bundled_domains())}); "
        "name the domain or its folder with --domain"
    )
