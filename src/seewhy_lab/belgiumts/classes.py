"""The classes of the photographs: a domain's classes.csv, with the features of every class."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass

from seewhy.domain.domain import Domain
from seewhy.errors import DomainError
from seewhy.text.nearest import did_you_mean

TABLE = "classes.csv"


@dataclass(frozen=True)
class SignClass:
    """One class: its key in the domain, and the value of every feature of the domain."""

    key: str
    features: Mapping[str, str]


def read_classes(domain: Domain) -> dict[int, SignClass]:
    """Return class id → class from the domain folder's classes.csv.

    The table has the columns ``class_id`` (the number in the photographs' class folders),
    ``class`` and one per feature of the domain; others are for readers.

    Raises
    ------
    DomainError
        If the table is missing, or a row does not fit the domain; the text names the line.

    Examples
    --------
    >>> import seewhy
    >>> read_classes(seewhy.load_domain("traffic_signs"))[21].features["shape"]
    'octagon'
    """
    path = domain.folder / TABLE
    if not path.is_file():
        raise DomainError(
            f"{path}: there is no such file; it says which class the photographs of a class "
            f"folder show, with the columns class_id, class, {', '.join(domain.features)}"
        )
    classes: dict[int, SignClass] = {}
    with path.open(newline="", encoding="utf-8-sig") as stream:
        try:
            reader = csv.DictReader(stream)
            for column in ("class_id", "class", *domain.features):
                if column not in (reader.fieldnames or ()):
                    raise DomainError(f"{path}:1: the column '{column}' is missing; add it")
            for row in reader:
                here = f"{path}:{reader.line_num}"
                class_id, sign_class = _read_row(row, domain, here)
                if class_id in classes:
                    raise DomainError(f"{here}: the class_id {class_id} stands twice; remove one")
                classes[class_id] = sign_class
        except (UnicodeDecodeError, csv.Error) as problem:
            raise DomainError(f"{path}: is no table ({problem}); save it as CSV in UTF-8") from None
    if not classes:
        raise DomainError(f"{path}: the table has no rows; add one per class")
    return classes


def _read_row(row: dict[str, str | None], domain: Domain, here: str) -> tuple[int, SignClass]:
    class_id, key = row["class_id"] or "", row["class"] or ""
    if not (class_id.isascii() and class_id.isdigit()):
        raise DomainError(f"{here}: class_id must be a whole number from 0, got '{class_id}'")
    if key not in domain.classes:
        raise DomainError(
            f"{here}: '{key}' is no class of the domain '{domain.name}'; "
            f"{did_you_mean(key, domain.classes)}"
        )
    features = {}
    for name, feature in domain.features.items():
        value = row[name] or ""
        if value not in feature.values:
            raise DomainError(
                f"{here}: '{value}' is no value of '{name}'; {did_you_mean(value, feature.values)}"
            )
        features[name] = value
    return int(class_id), SignClass(key, features)
