"""Which bundled domain a dataset folder is of, told by the columns of its tables."""

from __future__ import annotations

from pathlib import Path

from seewhy.data.dataset import TABLE
from seewhy.data.scene_rows import OPTIONAL, columns_of
from seewhy.data.table import read_table
from seewhy.data.thing import THINGS
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.folder import bundled_domains
from seewhy.errors import DatasetError


def domain_of(folder: Path) -> Domain:
    """Return the bundled domain all of whose features are columns of the folder's tables.

    Those of things are columns of things.csv.

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
    of_things = _columns_of_things(folder / THINGS)
    for domain in domains:
        features = set(domain.things.features) if domain.things else set()
        has_any = bool(domain.features or features)
        if has_any and set(domain.features) <= columns and features <= of_things:
            return domain
    raise DatasetError(
        f"{file}: the columns fit none of the bundled domains ({', '.join(bundled_domains())}); "
        "name the domain or its folder with --domain"
    )


def _columns_of_things(file: Path) -> set[str]:
    """Those of a table of things; none where there is none."""
    return set(read_table(file, known=(), optional=()).columns) if file.is_file() else set()
