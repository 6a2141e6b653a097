"""Why a literal is believed, and what a contradictory scene makes believed both ways."""

from __future__ import annotations

from seewhy.knowledge.axiom import AxiomKind, Condition, Literal, substitute
from seewhy.knowledge.evidence import Evidence, Say, Support, evidence_of
from seewhy.knowledge.ground import complement_of, key_of, literal_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.language import read_literal
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector


def why(
    reasoner: Reasoner, vector: FeatureVector, literal: Literal, *, say: Say = str
) -> Node | None:
    """Return the justification of a belief, or None if the literal is not believed.

    Every axiom instance that supports the literal without circularity is given; where there are
    several, they are the children of a node of basis "several reasons".

    Examples
    --------
    >>> from seewhy.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> node = why(reasoner, domain.vector({"block_displaced": "yes"}),
    ...            domain.classes["unstable"].literal)
    >>> node.features()
    ('block_displaced',)
    """
    if reasoner.answer_set(vector) is None:
        return None
    return justify(evidence_of(reasoner, vector, say=say), literal)


def contradiction(reasoner: Reasoner, vector: FeatureVector, *, say: Say = str) -> Node | None:
    """Return what a contradictory scene makes believed both ways, or None if it is consistent."""
    answer_set = reasoner.answer_set(vector)
    if answer_set is None or not answer_set.conflict:
        return None
    evidence = evidence_of(reasoner, vector, say=say)
    both = sorted(
        str(symbol)
        for symbol in answer_set.holds
        if symbol.positive and complement_of(symbol) in answer_set.holds
    )
    children: list[Node] = []
    for text in both:
        literal = read_literal(text)
        for side in (literal, literal.complement):
            node = justify(evidence, side)
            if node is not None:
                children.append(node)
    return Node(
        literal="conflict",
        text="the knowledge contradicts itself here",
        basis=Basis.CONFLICT,
        children=tuple(children),
    )


def justify(evidence: Evidence, literal: Literal) -> Node | None:
    """Return the justification of a literal, or None if it is not believed."""
    key = key_of(literal)
    if key not in evidence.holds:
        return None
    return belief_node(evidence, literal_of(key), frozenset())


def belief_node(evidence: Evidence, literal: Literal, above: frozenset[str]) -> Node:
    """Return the justification of a belief that does without the literals above it."""
    key = key_of(literal)
    nodes: list[Node] = []
    seen = evidence.seen(literal)
    if seen is not None:
        nodes.append(seen)
    for support in evidence.supports.get(key, ()):
        if evidence.rests_on(support, evidence.founded(above | {key})):
            nodes.append(_support_node(evidence, literal, support, above | {key}))
    nodes += [
        Node(
            literal=str(literal),
            text=f"{evidence.say(literal)}: an exception, without which the beliefs "
            "would contradict each other",
            basis=Basis.EXCEPTION,
            axiom=axiom,
        )
        for axiom in evidence.exceptions(key)
    ]
    if len(nodes) == 1:
        return nodes[0]
    return Node(
        literal=str(literal),
        text=evidence.say(literal),
        basis=Basis.REASONS if nodes else Basis.FACT,
        children=tuple(nodes),
    )


def _support_node(
    evidence: Evidence, literal: Literal, support: Support, above: frozenset[str]
) -> Node:
    axiom = support.axiom
    children = [
        condition_node(evidence, condition, support.binding, above) for condition in axiom.body
    ]
    is_default = axiom.kind is AxiomKind.DEFAULT
    return Node(
        literal=str(literal),
        text=evidence.say(literal),
        basis=Basis.DEFAULT if is_default else Basis.AXIOM,
        axiom=axiom,
        children=tuple(child for child in children if child is not None),
    )


def condition_node(
    evidence: Evidence, condition: Condition, binding: dict[str, str], above: frozenset[str]
) -> Node | None:
    """Return the node of a condition that holds; None for a sort, which needs no reason."""
    if condition.literal is None:
        text = substitute(condition.text, binding)
        return Node(literal=text, text=text, basis=Basis.COMPARISON)
    literal = condition.literal.substitute(binding)
    if literal.predicate in evidence.signature.sorts:
        return None
    if condition.absent:
        return _absence(evidence, literal)
    matching = evidence.matching(literal)
    founded = evidence.founded(above)
    key = next((own for own in matching if own in founded), next(iter(matching), None))
    return belief_node(evidence, literal_of(key) if key else literal, above)


def _absence(evidence: Evidence, literal: Literal) -> Node:
    """The node of ``not literal`` where the literal is not believed."""
    opposite = literal.complement
    if key_of(opposite) in evidence.holds:
        seen = evidence.seen(literal_of(key_of(opposite)))
        if seen is not None:
            return Node(
                literal=f"not {literal}",
                text=seen.text,
                basis=Basis.FEATURE,
                feature=seen.feature,
                value=seen.value,
            )
        return Node(f"not {literal}", evidence.say(opposite), Basis.ABSENCE)
    feature = evidence.schema.feature_of(literal)
    return Node(
        literal=f"not {literal}",
        text=f"nothing says that {evidence.say(literal)}",
        basis=Basis.ABSENCE,
        feature=feature,
    )
