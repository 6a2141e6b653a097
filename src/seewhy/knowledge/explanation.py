"""The trees of one answer set: what a belief, an absence or a condition rests on.

No belief stands below itself. An absence stands below itself only through other absences: nothing
concludes any of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice
from weakref import WeakKeyDictionary

from seewhy.knowledge.axiom import AxiomKind, Condition, Literal
from seewhy.knowledge.condition_nodes import (
    axiom_failed,
    decided_by,
    failed,
    joint_node,
    once,
    plain_node,
)
from seewhy.knowledge.counterfactual import Counterfactual
from seewhy.knowledge.evidence import Evidence
from seewhy.knowledge.exchanged import without_exchanged
from seewhy.knowledge.failing import MOST_AXIOMS, Failing, by_axiom, fewest, told_ways
from seewhy.knowledge.foundation import Foundation, Need, opposite
from seewhy.knowledge.ground import literal_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.possible import Belief, Instance
from seewhy.knowledge.settling import JointCondition

_TOLD_AGAIN = 24
"""A tree of more nodes is told in full once, and after that by the features that it names."""

_NOTHING: frozenset[Belief] = frozenset()


def belief_node(evidence: Evidence, key: str) -> Node:
    """Return the justification of what is believed in an answer set."""
    return _Explanation(evidence, Belief(key)).belief(key, _NOTHING)


def absence_node(evidence: Evidence, key: str) -> Node:
    """Return the justification of what is not believed in an answer set."""
    return _Explanation(evidence, Belief(key, holds=False)).absence(key, _NOTHING, _NOTHING)


def need_node(evidence: Evidence, need: Need, condition: Condition | None) -> Node:
    """Return the node of what a condition comes to, by itself.

    Where the condition fails, the node says what is in the way.
    """
    if isinstance(need, Belief):
        return belief_node(evidence, need.key) if need.holds else absence_node(evidence, need.key)
    joint, holds = need
    known = {key: key in evidence.holds for key in sorted(joint.keys, key=evidence.worth)}
    settled = joint.settled_by(known, holds) or {}
    children = [need_node(evidence, Belief(*pair), None) for pair in settled.items()]
    return joint_node(evidence, condition, need, children)


def condition_node(
    evidence: Evidence, condition: Condition, binding: Mapping[str, str]
) -> Node | None:
    """Return the node of a condition that holds, by itself; None for a sort."""
    asked = evidence.reasoner.possible.asked_by(condition, binding)
    if asked is None:
        return plain_node(evidence, condition, binding)
    need, _ = evidence.comes_to(asked)
    return need_node(evidence, need, condition)


@dataclass(frozen=True)
class _Place:
    """Where a node stands.

    ``above`` are the beliefs and absences that it may not rest on. ``chain`` are the absences
    directly above an absence: it may wait for what is in ``waits``, and they may be in it.
    """

    above: frozenset[Belief]
    chain: frozenset[Belief] = _NOTHING
    waits: frozenset[Belief] = _NOTHING

    @property
    def apart(self) -> frozenset[Belief]:
        """What something may not rest on that is to be founded apart from the chain."""
        return self.above | self.chain


class _Explanation:
    """Builds the trees of what one foundation founds."""

    def __init__(self, evidence: Evidence, root: Belief) -> None:
        self.evidence = evidence
        self.foundation = foundation_of(evidence, root)
        self._built: dict[tuple[Belief, frozenset[Belief], frozenset[Belief]], Node] = {}

    def belief(self, key: str, above: frozenset[Belief]) -> Node:
        belief = Belief(key)
        place = (belief, self.foundation.relevant(above), _NOTHING)
        if place in self._built:
            return self._again(self._built[place])
        self._built[place] = self._belief(key, above | {belief})
        return self._built[place]

    def _belief(self, key: str, without: frozenset[Belief]) -> Node:
        evidence = self.evidence
        literal = literal_of(key)
        seen = evidence.seen(literal)
        nodes: list[Node] = [] if seen is None else [seen]
        founded = self.foundation.stages(without)
        supporting = [
            instance
            for instance in evidence.firing(key)
            if all(
                self.foundation.is_founded(need, founded) for _, need, _ in evidence.needs(instance)
            )
        ]
        nodes += [
            self._support(instance, _Place(without))
            for instance in without_exchanged(supporting, evidence.holds)
        ]
        nodes += [
            self._exception(instance, literal, _Place(without))
            for instance in evidence.exceptions(key)
            if self.foundation.is_forced(instance, founded)
        ]
        if len(nodes) == 1:
            return nodes[0]
        return Node(
            literal=str(literal),
            text=evidence.say(literal),
            basis=Basis.REASONS if nodes else Basis.FACT,
            children=tuple(nodes),
        )

    def _support(self, instance: Instance, place: _Place) -> Node:
        """The node of an axiom that concludes a belief."""
        axiom = instance.axiom
        literal = axiom.head.substitute(instance.binding)
        children = self._conditions(instance, place)
        is_default = axiom.kind is AxiomKind.DEFAULT
        if is_default:
            _, need, _ = self.evidence.needs(instance)[-1]
            node = self._need(need, None, place)
            # That nothing at all concludes the opposite goes without saying.
            if node.children or node.feature or node.basis is not Basis.ABSENCE:
                children.append(node)
        return Node(
            literal=str(literal),
            text=self.evidence.say(literal),
            basis=Basis.DEFAULT if is_default else Basis.AXIOM,
            axiom=axiom,
            children=tuple(children),
        )

    def _conditions(self, instance: Instance, place: _Place) -> list[Node]:
        """The nodes of the conditions of an instance, which hold."""
        needs = {number: need for number, need, _ in self.evidence.needs(instance)}
        children: list[Node] = []
        for number, condition in enumerate(instance.axiom.body):
            if number in needs:
                children.append(self._need(needs[number], condition, place))
            elif (node := plain_node(self.evidence, condition, instance.binding)) is not None:
                children.append(node)
        return self._without_plain_presence(children)

    def _without_plain_presence(self, children: list[Node]) -> list[Node]:
        """Nodes without those that say of a thing only that it is there, if others speak of it."""
        schema = self.evidence.schema
        if not schema.presence:
            return children
        shown = {named for node in children for named in node.features()}
        known = {other for named in shown for other in schema.requires.get(named, ())}
        return [node for node in children if node.feature not in known or node.value != "yes"]

    def _exception(self, instance: Instance, literal: Literal, place: _Place) -> Node:
        """The node of a default that was given up."""
        conditions = self._conditions(instance, place)
        founded = self.foundation.stages(place.apart)
        told = (
            both.sides
            for both in contradictions(self.evidence, instance)
            if all(belief in founded for belief in both.beliefs)
        )
        return Node(
            literal=str(literal),
            text=f"{self.evidence.say(literal)}: an exception, without which the beliefs "
            "would contradict each other",
            basis=Basis.EXCEPTION,
            axiom=instance.axiom,
            children=(*conditions, *next(told, ())),
        )

    def _need(self, need: Need, condition: Condition | None, place: _Place) -> Node:
        """The node of what is founded: apart from the chain where it is, else waiting."""
        apart = self.foundation.stages(place.apart)
        if isinstance(need, Belief):
            if need in place.waits and need not in apart:
                return self.absence(need.key, place.above, place.chain)
            if need.holds:
                return self.belief(need.key, place.apart)
            return self.absence(need.key, place.apart, _NOTHING)
        joint, holds = need
        children = [
            self._need(belief, None, place)
            if belief in apart or belief in place.waits
            else self._supposed(belief)
            for belief in self._settling(joint, holds, place)
        ]
        return joint_node(self.evidence, condition, need, children)

    def _settling(self, joint: JointCondition, holds: bool, place: _Place) -> list[Belief]:
        """Beliefs and absences that settle a condition: founded ones where they are enough."""
        apart = self.foundation.stages(place.apart)
        for waits in (_NOTHING, place.waits):
            known = self.foundation.known(joint, apart, waits)
            if (settled := joint.settled_by(known, holds)) is not None:
                return [Belief(*pair) for pair in settled.items()]
        # It is assumed. Of what settles it, that stands first which is not founded.
        everything = sorted(self.foundation.literals(joint), key=lambda belief: belief in apart)
        settled = joint.settled_by(dict(everything), holds)
        return [Belief(*pair) for pair in (settled or {}).items()]

    def _supposed(self, belief: Belief) -> Node:
        """The node of what is neither founded nor waited for, and an answer set supposes."""
        literal = literal_of(belief.key)
        said = self.evidence.say(literal)
        if belief.holds:
            return Node(str(literal), f"supposing that {said}", Basis.ASSUMED)
        return Node(
            f"not {literal}",
            f"supposing that nothing says that {said}",
            Basis.ASSUMED,
            feature=self.evidence.schema.feature_of(literal),
        )

    def absence(self, key: str, above: frozenset[Belief], chain: frozenset[Belief]) -> Node:
        belief = Belief(key, holds=False)
        place = (belief, self.foundation.relevant(above), chain)
        if place in self._built:
            return self._again(self._built[place])
        self._built[place] = self._absence(belief, above, chain)
        return self._built[place]

    def _again(self, node: Node) -> Node:
        """A node that was told before."""
        if sum(1 for _ in islice(node.walk(), _TOLD_AGAIN + 1)) <= _TOLD_AGAIN:
            return node
        leaves = self.evidence.feature_nodes(node.features())
        return replace(node, basis=Basis.TOLD_BEFORE, children=leaves)

    def _absence(self, belief: Belief, above: frozenset[Belief], chain: frozenset[Belief]) -> Node:
        evidence, foundation = self.evidence, self.foundation
        literal, against = literal_of(belief.key), opposite(belief.key)
        seen = evidence.seen(literal_of(against)) or evidence.ruled_out(belief.key)
        if seen is not None:
            return replace(seen, literal=f"not {literal}")
        text = f"nothing says that {evidence.say(literal)}"
        feature = evidence.schema.feature_of(literal)
        if belief in foundation.assumed:
            said = text if belief == foundation.root else f"supposing that {text}"
            return Node(f"not {literal}", said, Basis.ASSUMED, feature=feature)
        apart = foundation.stages(above | chain | {belief})
        if Belief(against) in apart:
            return replace(self.belief(against, above | chain | {belief}), literal=f"not {literal}")
        together = foundation.stages(above)
        children: Sequence[Node] = ()
        if belief in together and belief not in chain:
            waits = frozenset(
                other
                for other, stage in together.items()
                if isinstance(other, Belief) and not other.holds and stage <= together[belief]
            )
            children = tuple(self._failing(belief.key, _Place(above, chain | {belief}, waits)))
        return Node(
            f"not {literal}", text, Basis.ABSENCE, feature=feature, children=tuple(children)
        )

    def _failing(self, key: str, place: _Place) -> Iterator[Node]:
        """A node for every axiom that could conclude a literal; its children are ways it fails."""
        apart = self.foundation.stages(place.apart)
        groups: dict[frozenset[object], Failing] = {}
        for instance in self.evidence.concluding(key):
            ways = [
                (number, need)
                for number, need, holds in self.evidence.needs(instance)
                if not holds and self.foundation.is_founded(need, apart, place.waits)
            ]
            ways = told_ways(self.evidence, ways)
            decided = (decided_by(self.evidence, need) for _, need in ways)
            groups.setdefault(frozenset((instance.axiom.identifier, *decided)), (instance, ways))
        told: set[str] = set()
        named: set[str] = set()
        for number, together in enumerate(by_axiom(fewest(groups), self.evidence)):
            node = self._failing_axiom(together, place)
            features = set(node.features())
            if node.to_text() not in told and (number < MOST_AXIOMS or not features <= named):
                told.add(node.to_text())
                named |= features
                yield node

    def _failing_axiom(self, together: Sequence[Failing], place: _Place) -> Node:
        children: list[Node] = []
        axiom = together[0][0].axiom
        for number, need in chain.from_iterable(ways for _, ways in together):
            condition = axiom.body[number] if number < len(axiom.body) else None
            node = self._need(need, condition, place)
            if isinstance(need, Belief):
                node = failed(self.evidence, need, node)
            children.append(node)
        head = literal_of(together[0][0].head)
        return axiom_failed(self.evidence, axiom, head, once(children))


@dataclass(frozen=True)
class Contradiction:
    """What would be believed both ways if a default were not given up.

    Attributes
    ----------
    sides : (Node, Node)
        Why each is believed; what rests on the default is marked as what would be so otherwise.
    beliefs : frozenset of Belief
        Those in the sides that are so anyway.
    """

    sides: tuple[Node, Node]
    beliefs: frozenset[Belief]


_CONTRADICTIONS: WeakKeyDictionary[Evidence, dict[Instance, tuple[Contradiction, ...]]] = (
    WeakKeyDictionary()
)


def contradictions(evidence: Evidence, exception: Instance) -> tuple[Contradiction, ...]:
    """Return the contradictions that force a default to be given up, the shortest first."""
    found = _CONTRADICTIONS.setdefault(evidence, {})
    if exception not in found:
        found[exception] = _contradictions(evidence, exception)
    return found[exception]


def _contradictions(evidence: Evidence, exception: Instance) -> tuple[Contradiction, ...]:
    beliefs = evidence.reasoner.contradictory_beliefs(evidence.scene)
    if beliefs is None or not beliefs.conflict or evidence.answer_set.conflict:
        return ()
    without = Evidence(
        evidence.reasoner, evidence.scene, beliefs, evidence.say, names=evidence.names
    )
    otherwise = Counterfactual(exception.axiom, evidence.holds, without.holds)
    found: list[tuple[int, Contradiction]] = []
    for key in sorted(without.holds):
        if not key.startswith("-") and opposite(key) in without.holds:
            nodes = [belief_node(without, side) for side in (key, opposite(key))]
            if any(map(otherwise.uses_default, nodes)):
                first, second = sorted(
                    map(otherwise.marked, nodes), key=lambda node: node.basis is Basis.OTHERWISE
                )
                so_anyway = frozenset(chain(*map(otherwise.beliefs, (first, second))))
                size = sum(1 for node in nodes for _ in node.walk())
                found.append((size, Contradiction((first, second), so_anyway)))
    return tuple(both for _, both in sorted(found, key=lambda pair: pair[0]))


def foundation_of(evidence: Evidence, root: Belief) -> Foundation:
    """What is founded of what a belief, or an absence, may rest on."""
    return evidence.foundation(
        root, lambda exception: [both.beliefs for both in contradictions(evidence, exception)]
    )
