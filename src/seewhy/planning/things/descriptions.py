"""The descriptions by which questions about a run may name the things of a scene."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from seewhy.dialogue.lexicon import NUMBERS
from seewhy.domain.things import ThingFeature
from seewhy.planning.things.initial_scene import SceneOfPlan

__all__ = ["descriptions", "which_is_meant"]

_MOST_FEATURES = 6
"""Features of which descriptions are made; of more there would be too many."""


def descriptions(at_first: SceneOfPlan) -> dict[str, tuple[str, ...]]:
    """Return what things may be called, each with those that it fits.

    A description has some of a thing's adjectives, in the order of the features, and a noun; what
    no adjective says stands behind it.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> called = descriptions(load_planning_domain("tabletop").at_first)
    >>> called["red block"], called["shiny ball"]
    (('thing1',), ('thing5', 'thing6'))
    """
    found: dict[str, dict[str, None]] = {}
    for number in range(at_first.scene.count):
        for said in _of_thing(at_first, number):
            found.setdefault(said, {})[at_first.term(number)] = None
    return {said: tuple(terms) for said, terms in found.items()}


def _of_thing(at_first: SceneOfPlan, number: int) -> Iterator[str]:
    things, scene = at_first.things, at_first.scene
    features = list(things.features.values())[:_MOST_FEATURES]
    values = [(feature, scene.values[feature.key][number]) for feature in features]
    adjectives = [_adjectives(feature, value) for feature, value in values]
    nouns = [
        noun for feature, value in values if value is not None for noun in feature.nouns[value]
    ]
    behind = [
        feature.behind[value]
        for feature, value in values
        if value is not None and value in feature.behind
    ]
    for chosen in product(*adjectives):
        before = [adjective for adjective in chosen if adjective]
        # "The thing" alone, of several, is no name.
        for noun in (*nouns, *(things.words if before else ())):
            for last in ("", *behind):
                yield " ".join(filter(None, [*before, noun, last]))


def _adjectives(feature: ThingFeature, value: str | None) -> tuple[str, ...]:
    """The adjectives for a value, and none."""
    return ("", *(feature.words[value] if value is not None else ()))


def which_is_meant(said: str, names: list[str]) -> str:
    """Return what who speaks of one of several things is asked.

    Examples
    --------
    >>> which_is_meant("cube", ["the red cube", "the blue cube"])
    'Which cube? There are two: the red cube and the blue cube.'
    """
    count = NUMBERS[len(names)] if len(names) < len(NUMBERS) else str(len(names))
    listed = f"{', '.join(names[:-1])} and {names[-1]}"
    return f"Which {said}? There are {count}: {listed}."
