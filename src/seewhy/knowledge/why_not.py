"""Why a literal is not believed: the axioms that could conclude it, and what fails in each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from seewhy.knowledge.axiom import Axiom, AxiomKind, Condition, Literal
from seewhy.knowledge.condition_nodes import axiom_failed, failed_comparison, once
from seewhy.knowledge.condition_nodes import failed as failed_by
from seewhy.knowledge.evidence import Evidence, Say, evidence_of
from seewhy.knowledge.explanation import belief_node, condition_node, need_node
from seewhy.knowledge.foundation import opposite
from seewhy.knowledge.ground import key_of, literal_of, term_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.nearest_instances import candidates_for, nearest_instances
from seewhy.knowledge.possible import Belief
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.why import either_or, justify

_NESTING = 4


def why_not(
    reasoner: Reasoner,
    vector: FeatureVector,
    literal: Literal,
    *,
    say: Say = str,
    names: Mapping[str, str] | None = None,
) -> Node:
    """Return why a literal is not believed: for every axiom that could conclude it, what failed.

    The children are the axioms, the one with the fewest failed conditions first; their children
    are all their conditions, each marked as holding or not. ``say`` words literals, ``names`` says
    how terms that are compared are called.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> node = why_not(reasoner, domain.vector({"block_displaced": "no"}),
    ...                domain.classes["unstable"].literal)
    >>> node.holds
    False
    """
    return refuse(evidence_of(reasoner, vector, say=say, names=names), literal)


def refuse(evidence: Evidence, literal: Literal) -> Node:
    """Return why a literal is not believed.

    Where several answer sets are preferred and say it differently, the children of a node of basis
    "several answer sets" are what each says.
    """
    literal = replace(literal, arguments=tuple(map(term_of, literal.arguments)))
    key = key_of(literal)
    if key in evidence.believed:
        opposed = opposite(key) in evidence.believed
        sides = (literal, literal.complement)
        return Node(
            literal=str(literal),
            text=f"{evidence.say(literal)}, and also not" if opposed else evidence.say(literal),
            basis=Basis.CONFLICT if opposed else Basis.FACT,
            children=tuple(node for side in sides if (node := justify(evidence, side)) is not None),
        )
    each = (evidence, *evidence.others)
    nodes = [
        belief_node(case, key) if key in case.holds else _refused(case, literal, ())
        for case in each
    ]
    cases = once(nodes)
    if len(cases) == 1:
        return cases[0]
    may_be = ": it may be so or not" if any(node.holds for node in cases) else ""
    return Node(
        literal=str(literal),
        text=f"it does not follow that {evidence.say(literal)}{may_be}",
        basis=Basis.CASES,
        holds=False,
        children=either_or(cases),
    )


def _refused(evidence: Evidence, literal: Literal, above: tuple[str, ...]) -> Node:
    """Why a literal is not in an answer set; ``above`` are the literals that it was needed for."""
    tried = _failures(evidence, literal, (*above, key_of(literal)))
    children = [node for _, node in sorted(tried, key=lambda pair: pair[0])]
    return Node(
        literal=str(literal),
        text=f"it does not follow that {evidence.say(literal)}",
        basis=Basis.REASONS if children else Basis.UNFOUNDED,
        holds=False,
        children=tuple(children),
    )


def shortfall(evidence: Evidence, literal: Literal) -> int | None:
    """Return the fewest failed conditions of an axiom that could conclude a literal.

    None where no axiom could. It says how near a literal is to being believed, and costs a
    fraction of :func:`refuse`.
    """
    literal = replace(literal, arguments=tuple(map(term_of, literal.arguments)))
    candidates = candidates_for(evidence, literal)
    bodies = {axiom.identifier: axiom.body for _, axiom, _ in candidates}
    nearest = nearest_instances(evidence, candidates, literal)
    return min((len(bodies[name]) - len(held) for name, (_, held) in nearest.items()), default=None)


def _failures(
    evidence: Evidence, literal: Literal, above: tuple[str, ...]
) -> list[tuple[tuple[int, int], Node]]:
    """One node per axiom that could conclude the literal, with how far it is from it."""
    candidates = candidates_for(evidence, literal)
    nearest = nearest_instances(evidence, candidates, literal)
    found: list[tuple[tuple[int, int], Node]] = []
    for position, axiom, _ in candidates:
        if axiom.identifier not in nearest:
            continue
        binding, held_conditions = nearest[axiom.identifier]
        children: list[Node] = []
        failed = 0
        for number, condition in enumerate(axiom.body):
            if number in held_conditions:
                node = condition_node(evidence, condition, binding)
            else:
                failed += 1
                node = _failed_condition(evidence, condition, axiom, binding, above)
            if node is not None:
                children.append(node)
        if axiom.kind is AxiomKind.DEFAULT and failed == 0:
            failed = 1
            against = key_of(literal.complement)
            if against in evidence.holds:
                children.append(belief_node(evidence, against))
        node = axiom_failed(evidence, axiom, literal, children)
        found.append(((failed, position), node))
    return found


def _failed_condition(
    evidence: Evidence,
    condition: Condition,
    axiom: Axiom,
    binding: dict[str, str],
    above: tuple[str, ...],
) -> Node:
    asked = evidence.reasoner.possible.asked_by(condition, binding)
    if asked is None:
        return failed_comparison(evidence, condition, axiom.body, binding)
    need, _ = evidence.comes_to(asked)
    if not isinstance(need, Belief):
        return need_node(evidence, need, condition)
    if need.holds:
        return failed_by(evidence, need, belief_node(evidence, need.key))
    literal = literal_of(need.key)
    if (absent := evidence.ruled_out(need.key)) is not None:
        return failed_by(evidence, need, absent)
    nothing = Node(f"not {literal}", "", Basis.ABSENCE)
    if evidence.schema.feature_of(literal) is not None:
        return failed_by(evidence, need, nothing)
    if need.key in above or len(above) > _NESTING:
        return failed_by(evidence, need, nothing)
    return _refused(evidence, literal, above)
