"""How many of several things are so: most of them, the most common value, those that occur."""

from __future__ import annotations

from seewhy.dialogue.things.evaluating import Evaluation, Fits
from seewhy.dialogue.things.query import (
    Description,
    HasValue,
    Most,
    MostCommon,
    Occurring,
    SharedByMost,
)

__all__ = ["half_shared", "most_are", "most_common", "occurring", "shared_by_most", "tally"]


def tally(feature: str, described: Description, evaluation: Evaluation) -> dict[str, Fits]:
    """Return value → the things of a description that have it, of the values that may occur.

    Raises
    ------
    UnclearReferenceError
        If the description refers to a thing that is not there or not one.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> scene = thing_scene(things, [{"colour": "red"}, {"colour": "red"}], relations={})
    >>> tally("colour", Description(), Evaluation(scene, things))
    {'red': Fits(surely=3, maybe=3)}
    """
    fits = evaluation.fits(described)
    unknown = evaluation.without_value[feature]
    found = {}
    for value in evaluation.things.features[feature].values:
        having = evaluation.with_value[feature].get(value, 0)
        of_value = Fits(fits.surely & having, fits.maybe & (having | unknown))
        if of_value.maybe:
            found[value] = of_value
    return found


def most_are(query: Most, evaluation: Evaluation) -> bool | None:
    """Return whether something is so of more than half; None where that is not known.

    Raises
    ------
    UnclearReferenceError
        If the question refers to a thing that is not there or not one.
    """
    described, so = evaluation.fits(query.described), evaluation.holds(query.condition)
    ahead = (described.surely & so.surely).bit_count()
    ahead -= (described.surely & ~so.maybe).bit_count()
    settled = described.surely & (so.surely | ~so.maybe)
    open_ones = described.maybe & ~settled
    if ahead - (open_ones & ~so.surely).bit_count() > 0:
        return True
    return False if ahead + (open_ones & so.maybe).bit_count() <= 0 else None


def most_common(query: MostCommon, evaluation: Evaluation) -> tuple[str, ...] | None:
    """Return the values that occur most, or least, several where they tie; None: not known.

    Raises
    ------
    UnclearReferenceError
        If the question refers to a thing that is not there or not one.
    """
    counted = tally(query.feature, query.described, evaluation)
    if all(fits.known for fits in counted.values()):
        counts = {value: fits.surely.bit_count() for value, fits in counted.items()}
        best = (min if query.least else max)(counts.values(), default=0)
        return tuple(value for value, count in counts.items() if count == best)
    if query.least:
        return None
    for value, fits in counted.items():
        others = [other.maybe for key, other in counted.items() if key != value]
        if fits.surely.bit_count() > max((other.bit_count() for other in others), default=0):
            return (value,)
    return None


def shared_by_most(
    query: SharedByMost, evaluation: Evaluation
) -> tuple[tuple[str, str], ...] | None:
    """Return the features and values of more than half; None where that is not known.

    What the description says itself is left out: cubes are cubes.

    Raises
    ------
    UnclearReferenceError
        If the question refers to a thing that is not there or not one.
    """
    found = []
    for feature, value in _told(query, evaluation):
        so = most_are(Most(query.described, HasValue(feature, value)), evaluation)
        if so is None:
            return None
        if so:
            found.append((feature, value))
    return tuple(found)


def half_shared(query: SharedByMost, evaluation: Evaluation) -> tuple[tuple[str, str], ...]:
    """Return the features and values that just half of them have."""
    count = evaluation.fits(query.described).surely.bit_count()
    return tuple(
        (feature, value)
        for feature, value in _told(query, evaluation)
        if 2 * tally(feature, query.described, evaluation)[value].surely.bit_count() == count
    )


def _told(query: SharedByMost, evaluation: Evaluation) -> list[tuple[str, str]]:
    said = {c.feature for c in query.described.conditions if isinstance(c, HasValue)}
    return [
        (feature, value)
        for feature in evaluation.scene.values
        if feature not in said
        for value in tally(feature, query.described, evaluation)
    ]


def occurring(query: Occurring, evaluation: Evaluation) -> tuple[str, ...] | None:
    """Return the values that occur; None where that is not known.

    Raises
    ------
    UnclearReferenceError
        If the question refers to a thing that is not there or not one.
    """
    counted = tally(query.feature, query.described, evaluation)
    if any(fits.maybe and not fits.surely for fits in counted.values()):
        return None
    return tuple(counted)
