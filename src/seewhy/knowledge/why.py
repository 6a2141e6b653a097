"""Why a literal is believed, and what a contradictory scene makes believed both ways."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.condition_nodes import once
from seewhy.knowledge.evidence import Evidence, Say, evidence_of
from seewhy.knowledge.explanation import belief_node, foundation_of
from seewhy.knowledge.foundation import opposite
from seewhy.knowledge.ground import key_of, literal_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.possible import Belief
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector


def why(
    reasoner: Reasoner,
    vector: FeatureVector,
    literal: Literal,
    *,
    say: Say = str,
    names: Mapping[str, str] | None = None,
) -> Node | None:
    """Return the justification of a belief, or None if the literal is not believed.

    ``say`` words literals, ``names`` says how terms that are compared are called.

    Every axiom instance that supports the literal without circularity is given; where there are
    several, they are the children of a node of basis "several reasons". Each of them suffices:
    every scene that shares the values of the features that it names has the belief, unless it
    contradicts the knowledge. Where several answer sets are preferred and the belief has other
    reasons in each, these are the children of a node of basis "several answer sets"; all of them
    together suffice. docs/justifications.md has the definitions.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> node = why(reasoner, domain.vector({"block_displaced": "yes"}),
    ...            domain.classes["unstable"].literal)
    >>> node.features()
    ('block_displaced',)
    """
    if reasoner.answer_set(vector) is None:
        return None
    return justify(evidence_of(reasoner, vector, say=say, names=names), literal)


def contradiction(reasoner: Reasoner, vector: FeatureVector, *, say: Say = str) -> Node | None:
    """Return what a contradictory scene makes believed both ways, or None if it is consistent."""
    answer_set = reasoner.answer_set(vector)
    if answer_set is None or not answer_set.conflict:
        return None
    evidence = evidence_of(reasoner, vector, say=say)
    both = sorted(
        key for key in evidence.holds if not key.startswith("-") and opposite(key) in evidence.holds
    )
    return Node(
        literal="conflict",
        text="the knowledge contradicts itself here",
        basis=Basis.CONFLICT,
        children=tuple(
            belief_node(evidence, side) for key in both for side in (key, opposite(key))
        ),
    )


def justify(evidence: Evidence, literal: Literal) -> Node | None:
    """Return the justification of a literal, or None if it is not believed.

    It is believed where it is in every preferred answer set.
    """
    key = key_of(literal)
    if key not in evidence.believed:
        return None
    literal = literal_of(key)
    settled = (
        not foundation_of(evidence, Belief(key)).assumed and not evidence.answer_set.exceptions
    )
    if settled or not evidence.others:
        node = belief_node(evidence, key)
    else:
        node = _in_each(
            evidence,
            literal,
            [belief_node(each, key) for each in (evidence, *evidence.others)],
        )
    if evidence.answer_set.conflict or (
        settled and not evidence.reasoner.possible.can_have_exceptions
    ):
        return node
    return _completed(evidence, literal, node)


def _in_each(evidence: Evidence, literal: Literal, nodes: Sequence[Node]) -> Node:
    """Why a literal is believed, given why it is in each answer set."""
    cases = once(nodes)
    if len(cases) == 1:
        return cases[0]
    return Node(
        literal=str(literal),
        text=f"{evidence.say(literal)}, whichever is so",
        basis=Basis.CASES,
        children=either_or(cases),
    )


def either_or(cases: Sequence[Node]) -> tuple[Node, ...]:
    """Return alternatives, each of them worded as one, in an order that no solver decides."""
    words = ("either", *("or" for _ in cases[1:]))
    ordered = sorted(cases, key=Node.to_text)
    return tuple(
        replace(node, text=f"{word} {node.text}") for word, node in zip(words, ordered, strict=True)
    )


def _completed(evidence: Evidence, literal: Literal, node: Node) -> Node:
    """Add to every reason the features without which another answer set would be preferred."""
    if node.basis is Basis.REASONS:
        children = tuple(_completed(evidence, literal, child) for child in node.children)
        return replace(node, children=children)
    named = node.features()
    sufficient = evidence.reasoner.sufficient
    if sufficient.suffice(evidence.scene, named, literal):
        return node
    added = sufficient.completed(evidence.scene, named, literal)[len(named) :]
    agreeing = Node(
        literal=f"not {literal.complement}",
        text="nothing else would agree with what is known",
        basis=Basis.CONSISTENCY,
        children=evidence.feature_nodes(added),
    )
    if node.basis is Basis.FEATURE:
        return node
    return replace(node, children=(*node.children, agreeing))
