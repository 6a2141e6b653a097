"""Axioms that a table class → features implies: by which few values each class is told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

_MOST_TRIED = 10_000
Values = Mapping[str, str]


@dataclass(frozen=True)
class Proposals:
    """What tells classes apart.

    Attributes
    ----------
    told_by : mapping of str to mapping
        Class → the fewest values that it alone has.
    alike : mapping of str to str
        Class → another that has the same values, or may have them.
    """

    told_by: Mapping[str, Values]
    alike: Mapping[str, str]


def proposals(classes: Mapping[str, Values]) -> Proposals:
    """Return by which fewest values each class is told from all others.

    A value that nobody knows of a class tells nothing from it. Of several choices that are as
    few, the one with the fewest "no" is taken, then the one of earlier features. Where there are
    too many choices to try, values are added one by one, each the one that excludes most.

    Examples
    --------
    >>> fingers = {"0": {"thumb": "no", "index": "no"}, "1": {"thumb": "no", "index": "yes"},
    ...            "2": {"thumb": "yes", "index": "yes"}}
    >>> proposals(fingers).told_by
    {'0': {'index': 'no'}, '1': {'thumb': 'no', 'index': 'yes'}, '2': {'thumb': 'yes'}}
    """
    names = list(classes)
    excluded = _excluded_by(classes)
    told_by: dict[str, Values] = {}
    alike: dict[str, str] = {}
    for number, (name, values) in enumerate(classes.items()):
        others = (1 << len(names)) - 1 - (1 << number)
        masks = {feature: excluded[feature, value] for feature, value in values.items()}
        everything = 0
        for mask in masks.values():
            everything |= mask
        left = others & ~everything
        if left:
            alike[name] = names[left.bit_length() - 1]
            continue
        told_by[name] = _fewest(values, masks, others)
    return Proposals(told_by, alike)


def _excluded_by(classes: Mapping[str, Values]) -> dict[tuple[str, str], int]:
    """(Feature, value) → the classes, as bits, that have another value."""
    bits: dict[str, dict[str, int]] = {}
    for number, values in enumerate(classes.values()):
        for feature, value in values.items():
            by_value = bits.setdefault(feature, {})
            by_value[value] = by_value.get(value, 0) | (1 << number)
    return {
        (feature, value): sum(mask for other, mask in by_value.items() if other != value)
        for feature, by_value in bits.items()
        for value in by_value
    }


def _fewest(values: Values, masks: Mapping[str, int], others: int) -> Values:
    features = [feature for feature in values if masks[feature]]
    tried = 0
    for size in range(1, len(features) + 1):
        best: tuple[int, tuple[str, ...]] | None = None
        for chosen in combinations(features, size):
            tried += 1
            if tried > _MOST_TRIED:
                return _greedily(values, masks, others)
            mask = 0
            for feature in chosen:
                mask |= masks[feature]
            if mask & others == others:
                denials = sum(values[feature] == "no" for feature in chosen)
                if best is None or denials < best[0]:
                    best = (denials, chosen)
        if best is not None:
            return {feature: values[feature] for feature in best[1]}
    return dict(values)


def _greedily(values: Values, masks: Mapping[str, int], others: int) -> Values:
    chosen: list[str] = []
    left = others
    while left:
        best = max(masks, key=lambda feature: (masks[feature] & left).bit_count())
        chosen.append(best)
        left &= ~masks[best]
    return {feature: values[feature] for feature in values if feature in chosen}
