"""Of every axiom that could conclude a literal, the instance that comes nearest to it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import product
from math import prod
from weakref import WeakKeyDictionary

from seewhy.knowledge.axiom import Axiom, Literal, predicates_in, variables_in
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.evidence import Evidence
from seewhy.knowledge.ground import key_of, predicate_of, term_of, text_of
from seewhy.knowledge.grounding_size import axioms_size
from seewhy.knowledge.possible import Belief
from seewhy.knowledge.program import held, variable_tuple
from seewhy.knowledge.reasoner import Reasoner

__all__ = ["Candidate", "Nearest", "candidates_for", "nearest_instances"]

Candidate = tuple[int, Axiom, dict[str, str]]
"""An axiom with its position among all, and what its head binds."""
Nearest = tuple[dict[str, str], frozenset[int]]
"""The values of an axiom's variables, and the places of the conditions that hold."""

_LOOKED_UP = 2_000
"""So many instances are looked up one by one; for more, it pays to ask clingo."""
_Instance = tuple[tuple[str, ...], frozenset[int]]  # values of the variables, what holds
_Head = tuple[int, Axiom, tuple[tuple[int, str], ...]]  # position, axiom, constants of its head
_BY_HEAD: WeakKeyDictionary[Reasoner, dict[tuple[str, bool], list[_Head]]] = WeakKeyDictionary()
_CONSTANT = re.compile(r"_*[a-z][A-Za-z0-9_']*|0|-?[1-9][0-9]*")


def candidates_for(evidence: Evidence, literal: Literal) -> list[Candidate]:
    """Return the axioms that could conclude a literal, with their positions and what is bound."""
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


def nearest_instances(
    evidence: Evidence, candidates: Sequence[Candidate], literal: Literal
) -> dict[str, Nearest]:
    """Return for every axiom the instance with the fewest failed conditions."""
    instances: dict[str, list[_Instance]] = {}
    unsettled: list[Candidate] = []
    for position, axiom, bound in candidates:
        looked_up = _looked_up(evidence, axiom, bound)
        if looked_up is None:
            unsettled.append((position, axiom, bound))
        else:
            instances[axiom.identifier] = looked_up
    if unsettled:
        instances |= _solved(evidence, unsettled, literal)
    found = (
        (axiom.identifier, _nearest(evidence, axiom, instances[axiom.identifier]))
        for _, axiom, _ in candidates
    )
    return {identifier: nearest for identifier, nearest in found if nearest is not None}


def _looked_up(evidence: Evidence, axiom: Axiom, bound: dict[str, str]) -> list[_Instance] | None:
    """The instances, where looking the conditions up is enough; None where clingo must tell.

    It is where every condition is a literal over constants and variables that the head binds, or
    that range over a sort.
    """
    atoms = [condition.literal for condition in axiom.body if condition.literal is not None]
    if len(atoms) < len(axiom.body):
        return None
    ranges: dict[str, Sequence[str]] = {name: (value,) for name, value in bound.items()}
    for atom in (axiom.head, *atoms):
        sorts = evidence.signature.argument_sorts(atom.predicate)
        for argument, sort in zip(atom.arguments, sorts, strict=True):
            if variables_in(argument) == (argument,):
                if argument not in ranges:
                    ranges[argument] = _members(evidence, sort)
            elif not _CONSTANT.fullmatch(argument):
                return None
    variables = axiom.variables
    if prod(len(ranges[name]) for name in variables) > _LOOKED_UP:
        return None
    found: list[_Instance] = []
    for values in product(*(ranges[name] for name in variables)):
        binding = dict(zip(variables, values, strict=True))
        satisfied = frozenset(
            number
            for number, condition in enumerate(axiom.body)
            if _holds(evidence, atoms[number].substitute(binding)) is not condition.absent
        )
        found.append((values, satisfied))
    return found


def _holds(evidence: Evidence, literal: Literal) -> bool:
    """Whether a literal without variables is believed, or says the member of a sort."""
    if evidence.signature.is_given(literal.predicate):
        return literal.arguments[0] in _members(evidence, literal.predicate)
    return key_of(literal) in evidence.holds


def _members(evidence: Evidence, sort: str) -> Sequence[str]:
    """The members of a sort in this scene: the things that are there, or may be."""
    declared = evidence.signature.sorts[sort]
    if declared.of_things:
        return evidence.things or declared.members or ()
    return (evidence.schema.scene,) if declared.members is None else declared.members


def _solved(
    evidence: Evidence, candidates: Sequence[Candidate], literal: Literal
) -> dict[str, list[_Instance]]:
    """The instances by clingo.

    All conditions of all instances are evaluated over the beliefs as facts, so that comparisons
    and aggregates mean here what they mean in the program.
    """
    asked = set().union(
        *(predicates_in(condition.text) for _, axiom, _ in candidates for condition in axiom.body)
    )
    believed = sorted(key for key in evidence.holds if predicate_of(key) in asked)
    lines = [f"holds({key})." for key in believed]
    for sort in evidence.signature.sorts:
        lines += [f"sort({sort}, {member})." for member in _members(evidence, sort)]
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
    instances: dict[tuple[str, tuple[str, ...]], set[int]] = {}
    for kind, arity in (("instance", 2), ("ok", 3)):
        for atom in control.by_signature(kind, arity):
            if atom.is_fact:
                name, values, *places = atom.symbol.arguments
                key = (name.name, tuple(map(text_of, values.arguments)))
                instances.setdefault(key, set()).update(p.number for p in places)
    found: dict[str, list[_Instance]] = {axiom.identifier: [] for _, axiom, _ in candidates}
    for (identifier, given), satisfied in instances.items():
        found[identifier].append((given, frozenset(satisfied)))
    return found


def _nearest(evidence: Evidence, axiom: Axiom, instances: list[_Instance]) -> Nearest | None:
    """The instance with the fewest failed conditions, of those that can be where there are any."""
    ranked = sorted(instances, key=lambda instance: _distance(instance, axiom))
    for must_be_possible in (True, False):
        for values, satisfied in ranked:
            binding = dict(zip(axiom.variables, values, strict=True))
            if not must_be_possible or _can_be(evidence, axiom, binding):
                return binding, satisfied
    return None


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


def _distance(instance: _Instance, axiom: Axiom) -> tuple[int, int, tuple[str, ...]]:
    """Fewest failed conditions first; among those, failed comparisons rather than literals.

    A comparison that fails with the picture's own value says more than a literal that would
    hold for another value.
    """
    values, satisfied = instance
    body = axiom.body
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
