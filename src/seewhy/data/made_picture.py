"""What a source of pictures says of one that it has made."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from seewhy.domain.domain import Domain
from seewhy.errors import DomainError

__all__ = ["Annotation", "annotation_of", "check_annotation"]


class Annotation(NamedTuple):
    """The values of a picture's features, its class, and what it shows.

    Attributes
    ----------
    features : dict of str to str
    label : str or None
        None in a domain without classes.
    things : list of dict
        A row of things.csv for each thing, without the picture's name: ``thing``, the box, values.
    related : list of (relation, thing, other)
        What holds of two of them and cannot be measured from their boxes. Of a relation that a
        domain sees, what is not listed is not so.
    """

    features: dict[str, str]
    label: str | None
    things: list[dict[str, str | int | float]]
    related: list[tuple[str, str, str]]


def annotation_of(
    features: Mapping[str, str],
    label: str | None,
    things: Sequence[Mapping[str, str | int | float]] = (),
    related: Sequence[tuple[str, str, str]] = (),
) -> Annotation:
    """Return what a source returns behind its picture.

    Examples
    --------
    >>> annotation_of({"lean": "no"}, "stable").label
    'stable'
    """
    rows = [dict(row) for row in things]
    pairs = [(relation, thing, other) for relation, thing, other in related]
    return Annotation(dict(features), label, rows, pairs)


def check_annotation(domain: Domain, made: Annotation) -> None:
    """Raise a DomainError if a source annotates in other words than its domain."""
    known = {key: feature.values for key, feature in domain.features.items()}
    # Where there are things, axioms may conclude the class, and nobody has to say it.
    unsaid = made.label is None and (not domain.classes or domain.things is not None)
    is_class = unsaid or made.label in domain.classes
    if is_class and made.features.keys() == known.keys():
        wrong = [
            f"{key} = {value}" for key, value in made.features.items() if value not in known[key]
        ]
    else:
        wrong = [f"class {made.label}, features {', '.join(made.features)}"]
    if wrong:
        among = f"a class among {', '.join(domain.classes)}" if domain.classes else "no class"
        among += ", or None" if domain.classes and domain.things is not None else ""
        raise DomainError(
            f"{domain.folder / 'domain.toml'}: the source '{domain.source}' must give values of "
            f"{', '.join(known) or 'no feature'} and {among}, got {wrong[0]}"
        )
    _check_things(domain, made)


def _check_things(domain: Domain, made: Annotation) -> None:
    """Refuse things in a domain that has none, and relations that it does not see.

    Whatever else is wrong with them is found where their tables are read.
    """
    things = domain.things
    if things is None:
        wrong = f"{len(made.things)} things" if made.things else ""
        expected = "no things: domain.toml has no [things]"
    else:
        seen = [key for key in things.relations if key in things.seen]
        wrong = next((f"'{key}'" for key, *_ in made.related if key not in seen), "")
        expected = f"relations among {', '.join(seen)}"
    if wrong:
        raise DomainError(
            f"{domain.folder / 'domain.toml'}: the source '{domain.source}' must give {expected}, "
            f"got {wrong}"
        )
