"""Refuse arithmetic that may leave the numbers that there are, which clingo would wrap around."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import product
from typing import Any

from clingo import ast

from seewhy.errors import KnowledgeError
from seewhy.knowledge.signature import Sort
from seewhy.knowledge.statements import LARGEST, Statement

__all__ = ["check_numbers"]

LONGEST_RANGE = 10_000
"""The numbers that a range may have; axioms are tried with each of them."""
_FAR = 10**40
"""So far from 0, it does not matter how far a number is."""

Bounds = tuple[int, int]
"""The least and the greatest number that a term may come to."""


def check_numbers(rule: ast.AST, sorts: Mapping[str, Sort], statement: Statement) -> None:
    """Refuse a rule whose arithmetic may come to numbers that there are not.

    Variables are as large as the members of their sorts; what a comparison with ``=`` computes is
    as large as what it is computed from. Of others nothing is known, and nothing is refused.

    Raises
    ------
    KnowledgeError
        With the place, the term, and what it may come to.
    """
    found = _collected(rule)
    terms = [*found["BinaryOperation"], *found["UnaryOperation"]]
    if not terms and not found["Interval"]:
        return
    known = {name: bounds for name, sort in sorts.items() if (bounds := _of_sort(sort)) is not None}
    computed = [*_computed(found["Comparison"])]
    for _ in computed:  # one may be computed from another, in any order
        for name, term in computed:
            if name not in known and (bounds := _bounds(term, known)) is not None:
                known[name] = bounds
    for term in terms:
        bounds = _bounds(term, known)
        if bounds is not None and max(map(abs, bounds)) > LARGEST:
            begin = term.location.begin
            furthest = max(bounds, key=abs)
            shown = furthest if abs(furthest) < _FAR else "more than 40 digits"
            raise KnowledgeError(
                f"{statement.place(begin.line, begin.column)}: '{term}' may come to {shown}, and "
                f"numbers go from -{LARGEST} to {LARGEST}; use smaller numbers"
            )

    for term in found["Interval"]:
        bounds = _bounds(term, known)
        if bounds is not None and bounds[1] - bounds[0] >= LONGEST_RANGE:
            begin = term.location.begin
            raise KnowledgeError(
                f"{statement.place(begin.line, begin.column)}: '{term}' may be a range of more "
                f"than {LONGEST_RANGE:,} numbers, each of which is tried; write a comparison"
            )


def _of_sort(sort: Sort) -> Bounds | None:
    numbers = [int(member) for member in sort.members or () if member.lstrip("-").isdecimal()]
    return (min(numbers), max(numbers)) if numbers else None


def _computed(comparisons: Iterable[ast.AST]) -> Iterator[tuple[str, ast.AST]]:
    """The variables that a comparison says the value of, with the term that is."""
    for comparison in comparisons:
        guards = comparison.guards
        if len(guards) == 1 and guards[0].comparison == ast.ComparisonOperator.Equal:
            for variable, term in (
                (comparison.term, guards[0].term),
                (guards[0].term, comparison.term),
            ):
                if variable.ast_type is ast.ASTType.Variable:
                    yield variable.name, term


_KINDS = ("BinaryOperation", "UnaryOperation", "Interval", "Comparison")


class _Collect(ast.Transformer):
    def __init__(self) -> None:
        self.found: dict[str, list[ast.AST]] = {kind: [] for kind in _KINDS}

    def visit(self, ast: ast.AST, *args: Any, **kwargs: Any) -> Any:
        of_kind = self.found.get(ast.ast_type.name)
        if of_kind is not None:
            of_kind.append(ast)
        return super().visit(ast, *args, **kwargs)


def _collected(node: ast.AST) -> dict[str, list[ast.AST]]:
    """The nodes that numbers come from, by kind."""
    collect = _Collect()
    collect.visit(node)
    # The innermost first: what is inside of a term that is too large says more.
    return {kind: nodes[::-1] for kind, nodes in collect.found.items()}


def _bounds(term: ast.AST, known: Mapping[str, Bounds]) -> Bounds | None:
    match term.ast_type:
        case ast.ASTType.Variable:
            return known.get(term.name)
        case ast.ASTType.SymbolicTerm:
            text = str(term)
            return (int(text), int(text)) if text.lstrip("-").isdecimal() else None
        case ast.ASTType.Interval:
            ends = _bounds(term.left, known), _bounds(term.right, known)
            return None if None in ends else _around(bound for end in ends if end for bound in end)
        case ast.ASTType.UnaryOperation:
            return _unary(term, known)
        case ast.ASTType.BinaryOperation:
            return _binary(term, known)
    return None


def _unary(term: ast.AST, known: Mapping[str, Bounds]) -> Bounds | None:
    inside = _bounds(term.argument, known)
    if inside is None:
        return None
    match term.operator_type:
        case ast.UnaryOperator.Minus:
            return -inside[1], -inside[0]
        case ast.UnaryOperator.Absolute:
            return 0, max(map(abs, inside))
    return None


def _binary(term: ast.AST, known: Mapping[str, Bounds]) -> Bounds | None:
    left, right = _bounds(term.left, known), _bounds(term.right, known)
    if left is None or right is None:
        return None
    pairs = [*product(left, right)]
    match term.operator_type:
        case ast.BinaryOperator.Plus:
            return _around(a + b for a, b in pairs)
        case ast.BinaryOperator.Minus:
            return _around(a - b for a, b in pairs)
        case ast.BinaryOperator.Multiplication:
            return _around(a * b for a, b in pairs)
        case ast.BinaryOperator.Division:
            return -max(map(abs, left)), max(map(abs, left))
        case ast.BinaryOperator.Modulo:
            return -max(map(abs, right)), max(map(abs, right))
        case ast.BinaryOperator.Power:
            return _power(left, right[1])
    return None


def _power(left: Bounds, exponent: int) -> Bounds:
    base = max(map(abs, left))
    if exponent <= 0 or base <= 1:
        return -1, 1
    most = min(base, _FAR) ** min(exponent, 200)
    return _around([0 if left[0] >= 0 else -most, most])


def _around(numbers: Iterable[int]) -> Bounds:
    every = [max(-_FAR, min(_FAR, number)) for number in numbers]
    return min(every), max(every)
