"""Whether justifications hold for random knowledge, by trying every scene.

For each random program some scenes are asked about. Of what is believed in all preferred answer
sets by the book, and of nothing else, there has to be a justification, and

- every reason suffices: each scene that shares the values of the features that it names has the
  belief, or no answer set, so that what depends on features has no reason without features;
- of stratified knowledge without defaults, so does every choice among alternatives inside it;
- features that were added for consistency are needed, each of them, and so are those that are said
  to be the fewest that suffice;
- no belief stands below itself, unless an answer set supposes it, and none is given no reason;
- every literal and condition that is said to hold, or to fail, does.

Of what is not believed, every axiom that could conclude it is told with each of its conditions,
and at least one of them fails, so that the axiom applies once they are repaired. The smallest
change is the smallest of all.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product

from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.ground import literal_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.stratified import is_stratified
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not
from seewhy_lab.experiments.random_knowledge import (
    FEATURES,
    Beliefs,
    RandomKnowledge,
    holding,
    random_knowledge,
)

__all__ = ["Tally", "check", "selected_features"]

_SELECTIONS = 8
_ASKED = ("p(scene)", "-p(scene)", "q(scene)", "-q(scene)", "r(scene)", "m(scene,a)")
_NOT_SAID_TO_BE_SO = (Basis.CONSISTENCY, Basis.OTHERWISE)


@dataclass
class Tally:
    """How much was checked, and what was wrong with it, a sentence a fault."""

    beliefs: int = 0
    refusals: int = 0
    changes: int = 0
    faults: list[str] = field(default_factory=list)


def check(seed: int, *, scenes: int = 3) -> Tally:
    """Check the justifications of one random program in some scenes.

    Examples
    --------
    >>> check(0).faults
    []
    """
    generator = random.Random(seed)
    known = random_knowledge(generator)
    tally = Tally()
    reasoner = Reasoner(known.knowledge, known.schema)
    finder = ChangeFinder(reasoner)
    for scene in generator.sample(known.scenes, scenes):
        sets = known.preferred(scene)
        believed = known.believed(scene)
        for belief in sorted(frozenset[str]().union(*sets)):
            tally.beliefs += 1
            faults = _faults_of_belief(known, reasoner, scene, belief, generator)
            tally.faults += [f"{scene}, {belief}: {fault}" for fault in faults]
        for asked in _ASKED:
            if believed is not None and asked not in believed:
                tally.refusals += 1
                node = why_not(reasoner, scene, literal_of(asked))
                faults = _faults_of_refusal(node, sets)
                tally.faults += [f"{scene}, not {asked}: {fault}" for fault in faults]
        for label in known.schema.classes:
            tally.changes += 1
            faults = _faults_of_change(known, finder, scene, label)
            tally.faults += [f"{scene}, to {label}: {fault}" for fault in faults]
    return tally


def _faults_of_belief(
    known: RandomKnowledge,
    reasoner: Reasoner,
    scene: FeatureVector,
    belief: str,
    generator: random.Random,
) -> Iterator[str]:
    node = why(reasoner, scene, literal_of(belief))
    by_the_book = belief in (known.believed(scene) or ())
    if node is None or not by_the_book:
        if (node is not None) != by_the_book:
            yield f"believed by the book: {by_the_book}, told: {node is not None}"
        return
    for reason in node.children if node.basis is Basis.REASONS else (node,):
        if not known.suffices(scene, reason.features(), belief):
            yield f"{reason.features()} do not suffice\n{node.to_text()}"
        yield from _needless(known, scene, belief, reason)
    least = reasoner.sufficient.completed(scene, (), literal_of(belief))
    for left_out in (None, *least):
        chosen = [name for name in least if name != left_out]
        if known.suffices(scene, chosen, belief) is not (left_out is None):
            yield f"the least sufficient features are not {least}, see {chosen}"
    if is_stratified(known.knowledge) and not any(axiom.default for axiom in known.axioms):
        for _ in range(_SELECTIONS):
            selected = sorted(selected_features(node, generator))
            if not known.suffices(scene, selected, belief):
                yield f"the selection {selected} does not suffice\n{node.to_text()}"
                break
    yield from _circles(node, ())
    sets = known.preferred(scene)
    if len(sets) == 1:
        yield from _untrue(node, sets[0])


def _needless(
    known: RandomKnowledge, scene: FeatureVector, belief: str, reason: Node
) -> Iterator[str]:
    """Features that were added for consistency, though they may be left out."""
    for node in reason.children:
        if node.basis is Basis.CONSISTENCY:
            for added in node.features():
                fewer = [name for name in reason.features() if name != added]
                if known.suffices(scene, fewer, belief):
                    yield f"{added} is not needed\n{reason.to_text()}"


def selected_features(node: Node, generator: random.Random) -> set[str]:
    """Return the features of a reason in which one of all alternatives is chosen everywhere."""
    named = {node.feature} if node.feature is not None else set()
    children = node.children
    if children and (node.is_refuted or (node.basis is Basis.REASONS and node.holds)):
        children = (generator.choice(children),)
    return named.union(*(selected_features(child, generator) for child in children))


def _circles(node: Node, above: tuple[str, ...]) -> Iterator[str]:
    """Beliefs that stand below themselves, or that nothing stands below."""
    if node.basis is Basis.CONSISTENCY:
        return
    if node.holds or (node.is_in_the_way and node.axiom is not None):
        if node.basis is Basis.FACT:
            yield f"{node.literal} is given no reason"
        key = _believed(node)
        # What an answer set supposes is told as that, and as no reason.
        if key in above and node.basis is not Basis.ASSUMED:
            yield f"{key} is its own reason"
        # Several reasons have the literal of each.
        above = above if node.axiom is None else (*above, key)
    for child in node.children:
        yield from _circles(child, above)


def _believed(node: Node) -> str:
    """The literal that a node says is believed; the opposite of what is absent is."""
    literal = node.literal.removeprefix("not ")
    if node.axiom is None:
        return literal
    positive = node.axiom.head.positive is not (node.basis is Basis.EXCEPTION)
    return ("" if positive else "-") + literal.removeprefix("-")


def _untrue(node: Node, beliefs: Beliefs) -> Iterator[str]:
    """Literals and conditions that are not as they are said to be."""
    told = [said for said in _said_to_be_so(node) if any(sign in said.literal for sign in "(<>=")]
    for part, holds in zip(told, holding([node.literal for node in told], beliefs), strict=True):
        if holds is not part.holds:
            how = "hold" if part.holds else "fail"
            yield f"'{part.literal}' is said to {how}\n{node.to_text()}"


def _said_to_be_so(node: Node) -> Iterator[Node]:
    if node.basis not in _NOT_SAID_TO_BE_SO:
        yield node
        for child in node.children:
            yield from _said_to_be_so(child)


def _faults_of_refusal(node: Node, sets: list[Beliefs]) -> Iterator[str]:
    if node.holds:
        yield f"told as believed\n{node.to_text()}"
    elif len(sets) == 1:
        yield from _untrue(node, sets[0])
        for refused in node.children:
            assert refused.axiom is not None
            given_up = refused.axiom.kind.value == "default" and all(
                child.holds for child in refused.children
            )
            # Of the conditions, that the scene is a scene is not told.
            if len(refused.children) != len(refused.axiom.body) - 1 + given_up:
                yield f"a condition is missing of {refused.axiom}\n{node.to_text()}"
            if not given_up and all(child.holds for child in refused.children):
                yield f"nothing fails in {refused.axiom}\n{node.to_text()}"


def _faults_of_change(
    known: RandomKnowledge, finder: ChangeFinder, scene: FeatureVector, label: str
) -> Iterator[str]:
    told = {change.vector for change in finder.smallest(scene, label, limit=100)}
    # What is known stays known; what is unknown may stay so.
    choices = [
        values if value is not None else (*values, None)
        for values, value in zip(FEATURES.values(), scene, strict=True)
    ]
    ranked = {
        other: _distance(scene, other)
        for other in product(*choices)
        if _class_of(known, other) == label
    }
    least = min(ranked.values(), default=None)
    smallest = {other for other, distance in ranked.items() if distance == least}
    if told != smallest:
        yield f"told {sorted(map(str, told))}, smallest are {sorted(map(str, smallest))}"


def _distance(scene: FeatureVector, other: FeatureVector) -> tuple[int, int]:
    """How many values differ, and how far the number is moved."""
    changed = sum(old != new for old, new in zip(scene, other, strict=True))
    old, new = scene[2], other[2]
    return changed, abs(int(old) - int(new)) if old is not None and new is not None else 0


def _class_of(known: RandomKnowledge, scene: FeatureVector) -> str | None:
    believed = known.believed(scene) or frozenset()
    classes = [name for name, literal in known.schema.classes.items() if str(literal) in believed]
    return classes[0] if len(classes) == 1 else None
