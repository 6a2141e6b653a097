"""The nodes of conditions that hold or fail, given the nodes of what they rest on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from seewhy.knowledge.axiom import Axiom, AxiomKind, Condition, Literal, substitute, variables_in
from seewhy.knowledge.evidence import Evidence
from seewhy.knowledge.foundation import Need
from seewhy.knowledge.ground import literal_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.possible import Belief
from seewhy.knowledge.settling import JointCondition

_NOT_THERE = "things that are not there"
"""What decides all needs that fail because some thing is not there."""


def plain_node(evidence: Evidence, condition: Condition, binding: Mapping[str, str]) -> Node | None:
    """Return the node of a comparison that holds; None for a sort, which needs no reason."""
    if condition.literal is not None:
        return None
    text = substitute(condition.text, binding)
    return Node(literal=text, text=evidence.say_comparison(text), basis=Basis.COMPARISON)


def failed_comparison(
    evidence: Evidence,
    condition: Condition,
    others: Iterable[Condition],
    binding: Mapping[str, str],
) -> Node:
    """Return the node of a comparison that fails, with the value that is seen and compared."""
    text = substitute(condition.text, binding)
    said = evidence.say_comparison(text)
    shared = set(variables_in(condition.text))
    for other in others:
        if (
            other.literal is not None
            and not other.absent
            and shared & set(variables_in(other.text))
            and (seen := evidence.seen(other.literal.substitute(binding))) is not None
        ):
            return Node(
                literal=text,
                text=f"{seen.text}, and not {said}",
                basis=Basis.COMPARISON,
                holds=False,
                feature=seen.feature,
                value=seen.value,
            )
    return Node(literal=text, text=said, basis=Basis.COMPARISON, holds=False)


def joint_node(
    evidence: Evidence,
    condition: Condition | None,
    need: tuple[JointCondition, bool],
    children: Sequence[Node],
) -> Node:
    """Return the node of a condition of several literals, given those that settle it."""
    joint, holds = need
    alike = once(_not_known_once(evidence, children))
    if len(alike) == 1 and condition is not None:
        (child,) = alike
        if condition.literal is not None:
            return child if holds else replace(child, literal=joint.text, holds=False)
        if joint.text.startswith("not not ") and not condition.is_local:
            return replace(child, literal=joint.text, holds=holds)
    return Node(
        literal=joint.text,
        text=evidence.say_condition(joint.text, holds=holds),
        basis=Basis.JOINTLY,
        holds=holds,
        children=alike,
    )


def _not_known_once(evidence: Evidence, children: Sequence[Node]) -> list[Node]:
    """Nodes of which those of a feature that is not known, if there are several, become one."""
    bare = Counter(
        child.feature for child in children if child.value is None and not child.children
    )
    return [
        evidence.feature_node(child.feature)
        if child.feature is not None
        and child.value is None
        and not child.children
        and bare[child.feature] > 1
        else child
        for child in children
    ]


def failed(evidence: Evidence, need: Belief, node: Node) -> Node:
    """Return the node of a condition that fails because of a belief or an absence.

    ``node`` says why there is that belief, or absence.
    """
    if need.holds:
        return replace(node, literal=f"not {node.literal}", holds=False)
    literal = literal_of(need.key)
    if (nothing := evidence.ruled_out(need.key)) is not None:
        return replace(nothing, literal=str(literal), holds=False)
    feature = evidence.schema.feature_of(literal)
    if feature is not None and evidence.vector[feature] is None:
        return replace(
            node,
            literal=str(literal),
            text=f"it is not known whether {evidence.say(literal)}",
            basis=Basis.FEATURE,
            holds=False,
            feature=feature,
        )
    if feature is not None:
        value = evidence.vector[feature]
        assert value is not None
        return Node(
            literal=str(literal),
            text=evidence.say(evidence.schema.features[feature][value]),
            basis=Basis.FEATURE,
            holds=False,
            feature=feature,
            value=value,
        )
    if node.literal == f"not {literal}" and node.basis in (Basis.ABSENCE, Basis.ASSUMED):
        basis = Basis.REASONS if node.children else Basis.UNFOUNDED
        return replace(
            node,
            literal=str(literal),
            text=f"it does not follow that {evidence.say(literal)}",
            basis=node.basis if node.basis is Basis.ASSUMED else basis,
            holds=False,
        )
    # The opposite is believed, which says more than that this is not.
    return replace(node, literal=str(literal), holds=False)


def axiom_failed(
    evidence: Evidence, axiom: Axiom, literal: Literal, children: Sequence[Node]
) -> Node:
    """Return the node of an axiom that does not apply, given the nodes of its conditions."""
    return Node(
        literal=str(literal),
        text=evidence.say(literal),
        basis=Basis.DEFAULT if axiom.kind is AxiomKind.DEFAULT else Basis.AXIOM,
        holds=False,
        axiom=axiom,
        children=tuple(children),
    )


def once(nodes: Sequence[Node]) -> tuple[Node, ...]:
    """Return nodes, of those that read alike the first."""
    return tuple({node.to_text(): node for node in reversed(nodes)}.values())[::-1]


def decided_by(evidence: Evidence, need: Need) -> object:
    """What decides a need: the feature where it is what a picture shows, else the need itself."""
    if not isinstance(need, Belief):
        return need[0].text
    if not need.holds and evidence.is_ruled_out(need.key):
        return _NOT_THERE
    literal = literal_of(need.key)
    feature = evidence.schema.feature_of(literal)
    if feature is not None and evidence.seen(literal if need.holds else literal.complement):
        return feature
    return need
