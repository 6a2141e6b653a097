"""Why a literal is not believed: the axioms that could conclude it, and what fails in each."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from weakref import WeakKeyDictionary

from seewhy.knowledge.axiom import (
    Axiom,
    AxiomKind,
    Condition,
    Literal,
    predicates_in,
    variables_in,
)
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.condition_nodes import axiom_failed, failed_comparison, once
from seewhy.knowledge.condition_nodes import failed as failed_by
from seewhy.knowledge.evidence import Evidence, Say, evidence_of
from seewhy.knowledge.explanation import belief_node, condition_node, need_node
from seewhy.knowledge.foundation import opposite
from seewhy.knowledge.ground import key_of, literal_of, predicate_of, term_of, text_of
from seewhy.knowledge.grounding_size import axioms_size
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.possible import Belief
from seewhy.knowledge.program import held, variable_tuple
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.why import either_or, justify

_NESTING = 4
_Place = tuple[str, tuple[str, ...]]  # an axiom and the values of its variables
_Head = tuple[int, Axiom, tuple[tuple[int, str], ...]]  # position, axiom, constants of its head
_BY_HEAD: WeakKeyDictionary[Reasoner, dict[tuple[str, bool], list[_Head]]] = WeakKeyDictionary()
_CONSTANT = re.compile(r"_*[a-z][A-Za-z0-9_']*|0|-?[1-9][0-9]*")


def why_not(reasoner: Reasoner, vector: FeatureVector, literal: Literal, *, say: Say = str) -> Node:
    """Return why a literal is not believed: for every axiom that could conclude it, what failed.

    The children are the axioms, the one with the fewest failed conditions first; their children
    are all their conditions, each marked as holding or not.

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
    return refuse(evidence_of(reasoner, vector, say=say), literal)


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
    candidates = _candidates(evidence, literal)
    bodies = {axiom.identifier: axiom.body for _, axiom, _ in candidates}
    nearest = _nearest_instances(evidence, candidates, literal)
    return min((len(bodies[name]) - len(held) for name, (_, held) in nearest.items()), default=None)


def _candidates(evidence: Evidence, literal: Literal) -> list[tuple[int, Axiom, dict[str, str]]]:
    """The axioms that could conclude a literal, with their positions and what is bound."""
    by_head = _BY_HEAD.get(evidence.reasoner)
    if by_head is None:
        by_head = _BY_HEAD[evidence.reasoner] = _heads(evidence.reasoner.knowledge.axioms)
    return [
        (position, axiom, bound)
        for position, axiom, constants in by_head.get((literal.predicate, literal.positive), ())
        if all(literal.arguments[n] == term for n, term in constants)
        and (bound := _unify(axiom.head, literal)) is not None
    ]


def _heads(axioms: Sequence[Axiom]) -> dict[tuple[str, bool], list[_Head]]:
    """Axioms by the predicate and the sign of their heads, so that few are looked at."""
    found: dict[tuple[str, bool], list[_Head]] = {}
    for position, axiom in enumerate(axioms):
        head = axiom.head
        constants = tuple(
            (n, term_of(argument))
            for n, argument in enumerate(head.arguments)
            if not variables_in(argument)
        )
        found.setdefault((head.predicate, head.positive), []).append((position, axiom, constants))
    return found


def _failures(
    evidence: Evidence, literal: Literal, above: tuple[str, ...]
) -> list[tuple[tuple[int, int], Node]]:
    """One node per axiom that could conclude the literal, with how far it is from it."""
    candidates = _candidates(evidence, literal)
    nearest = _nearest_instances(evidence, candidates, literal)
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


def _nearest_instances(
    evidence: Evidence, candidates: list[tuple[int, Axiom, dict[str, str]]], literal: Literal
) -> dict[str, tuple[dict[str, str], frozenset[int]]]:
    """For every axiom the instance with the fewest failed conditions."""
    nearest: dict[str, tuple[dict[str, str], frozenset[int]]] = {}
    unsettled: list[tuple[int, Axiom, dict[str, str]]] = []
    for position, axiom, bound in candidates:
        satisfied = _settled(evidence, axiom, bound)
        if satisfied is None:
            unsettled.append((position, axiom, bound))
        else:
            nearest[axiom.identifier] = (bound, satisfied)
    return {**nearest, **_solved(evidence, unsettled, literal)} if unsettled else nearest


def _settled(evidence: Evidence, axiom: Axiom, bound: dict[str, str]) -> frozenset[int] | None:
    """The conditions that hold, where looking them up is enough; None where clingo must tell.

    It is where the head leaves no variable open and every condition is a literal over constants.
    """
    computed = any(variables_in(a) not in ((), (a,)) for a in axiom.head.arguments)
    if computed or not set(axiom.variables) <= set(bound):
        return None
    satisfied: set[int] = set()
    for number, condition in enumerate(axiom.body):
        literal = condition.literal
        if literal is None:
            return None
        ground = literal.substitute(bound)
        if not all(map(_CONSTANT.fullmatch, ground.arguments)):
            return None
        if ground.predicate == evidence.schema.scene:
            holds = ground.arguments == (evidence.schema.scene,)
        elif evidence.signature.is_given(ground.predicate):
            return None
        else:
            holds = key_of(ground) in evidence.holds
        if holds is not condition.absent:
            satisfied.add(number)
    return frozenset(satisfied)


def _solved(
    evidence: Evidence, candidates: list[tuple[int, Axiom, dict[str, str]]], literal: Literal
) -> dict[str, tuple[dict[str, str], frozenset[int]]]:
    """The nearest instances by clingo.

    All conditions of all instances are evaluated over the beliefs as facts, so that comparisons
    and aggregates mean here what they mean in the program.
    """
    asked = set().union(
        *(predicates_in(condition.text) for _, axiom, _ in candidates for condition in axiom.body)
    )
    believed = sorted(key for key in evidence.holds if predicate_of(key) in asked)
    lines = [f"holds({key})." for key in believed]
    for sort in evidence.signature.sorts.values():
        members = (evidence.schema.scene,) if sort.members is None else sort.members
        if sort.of_things:
            members = evidence.things or members
        lines += [f"sort({sort.name}, {member})." for member in members]
    for _, axiom, bound in candidates:
        instance = f"{axiom.identifier}, {variable_tuple(axiom)}"
        guards = _ranges(evidence, axiom, bound)
        guards += [
            f"{argument} = {value}"
            for argument, value in zip(axiom.head.arguments, literal.arguments, strict=True)
            if variables_in(argument)
        ]
        lines.append(f"instance({instance}){' :- ' if guards else ''}{'; '.join(guards)}.")
        for number, condition in enumerate(axiom.body):
            lines.append(
                f"ok({instance}, {number}) :- instance({instance}), "
                f"{held(condition.text, evidence.signature)}."
            )
    size = axioms_size([axiom for _, axiom, _ in candidates], evidence.signature)
    control = BoundedControl("\n".join(lines), size=size)
    instances: dict[_Place, set[int]] = {}
    for kind, arity in (("instance", 2), ("ok", 3)):
        for atom in control.by_signature(kind, arity):
            if atom.is_fact:
                name, values, *places = atom.symbol.arguments
                key = (name.name, tuple(map(text_of, values.arguments)))
                instances.setdefault(key, set()).update(p.number for p in places)
    axioms = {axiom.identifier: axiom for _, axiom, _ in candidates}
    nearest: dict[str, tuple[dict[str, str], frozenset[int]]] = {}
    ranked = sorted(instances.items(), key=lambda item: _distance(item, axioms))
    for must_be_possible in (True, False):
        for (identifier, given), satisfied in ranked:
            if identifier not in nearest:
                axiom = axioms[identifier]
                binding = dict(zip(axiom.variables, given, strict=True))
                if not must_be_possible or _can_be(evidence, axiom, binding):
                    nearest[identifier] = (binding, frozenset(satisfied))
    return nearest


def _can_be(evidence: Evidence, axiom: Axiom, binding: dict[str, str]) -> bool:
    """Whether an instance asks nothing that no things can be, such as a block on itself."""
    if not evidence.schema.presence:
        return True
    possible = evidence.reasoner.possible
    asked = (
        possible.asked_by(condition, binding)
        for condition in axiom.body
        if condition.literal is not None and not condition.absent
    )
    return all(possible.can_hold(need) for need in asked if isinstance(need, Belief))


def _ranges(evidence: Evidence, axiom: Axiom, bound: dict[str, str]) -> list[str]:
    """Conditions that let every variable range over its sort."""
    sorts: dict[str, str] = {}
    computed: list[tuple[set[str], str]] = []
    for literal in (axiom.head, *(c.literal for c in axiom.body if c.literal)):
        literal_sorts = evidence.signature.argument_sorts(literal.predicate)
        for argument, sort in zip(literal.arguments, literal_sorts, strict=True):
            if (argument,) == variables_in(argument):
                sorts.setdefault(argument, sort)
            else:
                computed.append((set(variables_in(argument)), f"sort({sort}, {argument})"))
    ranges = [f"sort({sort}, {name})" for name, sort in sorts.items() if name not in bound]
    free = {name for name in axiom.variables if name not in sorts and name not in bound}
    # A variable of no sort is computed: by 'N = …', or so that 'N+1' is of the sort.
    for condition in axiom.body:
        outside = re.sub(r"\{.*\}", "", condition.text)
        if condition.literal is None and " = " in outside:
            computed.append((set(variables_in(outside)), held(condition.text, evidence.signature)))
    for names, text in computed:
        if names & free:
            ranges.append(text)
            free -= names
    return ranges


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


def _distance(
    item: tuple[_Place, set[int]], axioms: dict[str, Axiom]
) -> tuple[int, int, tuple[str, ...]]:
    """Fewest failed conditions first; among those, failed comparisons rather than literals.

    A comparison that fails with the picture's own value says more than a literal that would
    hold for another value.
    """
    (identifier, values), satisfied = item
    body = axioms[identifier].body
    failed = [number for number in range(len(body)) if number not in satisfied]
    return len(failed), sum(body[n].literal is not None for n in failed), values


def _unify(head: Literal, target: Literal) -> dict[str, str] | None:
    """Bind the variables of an axiom's head so that it becomes the target, if it can."""
    if (head.predicate, head.positive) != (target.predicate, target.positive):
        return None
    binding: dict[str, str] = {}
    for argument, value in zip(head.arguments, target.arguments, strict=True):
        if (argument,) == variables_in(argument):
            if binding.setdefault(argument, value) != value:
                return None
        elif not variables_in(argument) and term_of(argument) != value:
            return None
    return binding
