"""The smallest change among things with several classes is the one that trying all finds."""

from __future__ import annotations

import random
from itertools import product

import pytest

from seewhy.errors import ReasoningError
from seewhy.knowledge import change as smallest_change
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.language import read_knowledge, read_literal
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.things import schema_with_things

DECLARED = """\
#sort picture.
#sort block = things.
#sort hue = {red, green, blue}.
#sort sort_of_picture = {bright, high, calm}.
#static colour(block, hue).
#static round(block).
#static on(block, block).
#static kind(picture, sort_of_picture).
#static loose(block).
#static tied(block).
#static held(block).
kind(P, bright) if picture(P), colour(X, red).
kind(P, bright) if picture(P), round(X), not colour(X, blue).
"""
STRATIFIED = """\
kind(P, high) if picture(P), on(X, Y).
kind(P, calm) if picture(P), block(X), not round(X).
"""
# A red block on another is not loose, or not tied: high or calm in one answer set each, and bright
# in both.
DEFAULT = """\
default loose(X) if block(X).
default tied(X) if block(X).
held(X) if loose(X).
-held(X) if tied(X), on(X, Y), colour(X, red).
kind(P, high) if picture(P), -loose(X).
kind(P, calm) if picture(P), -tied(X).
kind(P, calm) if picture(P), block(X), colour(X, green).
"""
CHOOSING = """\
kind(P, high) if picture(P), on(X, Y).
loose(X) if block(X), not -loose(X).
-loose(X) if block(X), on(X, Y), not loose(X).
kind(P, calm) if picture(P), loose(X), not round(X).
"""
CLASSES = {name: f"kind(picture, {name})" for name in ("bright", "high", "calm")}


def reasoner_of(source: str, most: int = 2) -> Reasoner:
    knowledge = read_knowledge(DECLARED + source).with_things(most)
    plain = SceneSchema("picture", {}, {n: read_literal(t) for n, t in CLASSES.items()}, {})
    seen = ("colour", "round", "on")
    return Reasoner(knowledge, schema_with_things(plain, knowledge.signature, seen))


def known_scenes(schema: SceneSchema) -> list[FeatureVector]:
    """Every scene in which all that is there is known."""
    scenes: list[FeatureVector] = []
    for there in product(("yes", "no"), repeat=len(schema.presence)):
        present = dict(zip(schema.presence.values(), there, strict=True))
        possible: list[tuple[str | None, ...]] = []
        for feature, literals in schema.features.items():
            if feature in present:
                possible.append((present[feature],))
            elif all(present[named] == "yes" for named in schema.requires[feature]):
                possible.append(tuple(literals))
            else:
                possible.append((None,))
        scenes += product(*possible)
    return scenes


def cost(schema: SceneSchema, before: FeatureVector, after: FeatureVector) -> int:
    """Every thing that leaves, and every other feature that differs."""
    differing = {
        name for name, old, new in zip(schema.features, before, after, strict=True) if old != new
    }
    return sum(1 for name in differing if differing.isdisjoint(schema.requires.get(name, ())))


@pytest.mark.parametrize("source", [STRATIFIED, DEFAULT, CHOOSING])
def test_a_class_comes_without_the_others_at_the_least_cost(source: str) -> None:
    reasoner = reasoner_of(source)
    schema = reasoner.schema
    finder = ChangeFinder(reasoner)
    scenes = known_scenes(schema)
    labels = dict(
        zip(scenes, [d.label for d in reasoner_of(source).decide_all(scenes)], strict=True)
    )
    whole = [scene for scene in scenes if None not in scene]
    tried = 0
    for before in random.Random(0).sample(whole, 25):
        for label in CLASSES:
            costs = {
                after: cost(schema, before, after) for after in scenes if labels[after] == label
            }
            nearest = {after for after, much in costs.items() if much == min(costs.values())}
            found = finder.smallest(before, label, limit=1000)
            assert {change.vector for change in found} == nearest
            tried += labels[before] != label
    assert tried > 50


def test_every_kind_of_knowledge_has_scenes_of_several_classes() -> None:
    for source in (STRATIFIED, DEFAULT, CHOOSING):
        reasoner = reasoner_of(source)
        found = [d.verdict.value for d in reasoner.decide_all(known_scenes(reasoner.schema))]
        assert "several classes" in found


def test_what_takes_too_long_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    reasoner = reasoner_of(CHOOSING)
    before = next(
        scene
        for scene in known_scenes(reasoner.schema)
        if reasoner.decide(scene).verdict.value == "several classes"
    )
    monkeypatch.setattr(smallest_change, "SOLVING_SECONDS", 0.0)
    with pytest.raises(ReasoningError) as error:
        [ChangeFinder(reasoner).smallest(before, label) for label in CLASSES]
    assert str(error.value) == (
        "knowledge.al:5:1: 'colour(block, hue)' has up to 6 instances; the search for the smallest "
        "change took longer than 0 s; give its sorts fewer members, or write it with fewer "
        "variables"
    )
