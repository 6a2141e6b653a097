"""Parts of a rule in clingo's syntax tree: its atoms, its literals, its head."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from clingo import ast

from seewhy.knowledge.axiom import Literal

__all__ = [
    "atoms",
    "body_atoms",
    "function_of",
    "head_of",
    "literal_of",
    "nodes",
    "single",
    "spaced",
]


def spaced(element: ast.AST) -> str:
    """The text of a body element in the language's own spelling."""
    literal = literal_of(element)
    if literal is None:
        return str(element)
    signs = {ast.Sign.Negation: "not ", ast.Sign.DoubleNegation: "not not "}
    return f"{signs.get(element.sign, '')}{literal}"


def head_of(rule: ast.AST) -> Literal | None:
    """The head where it is one literal: neither ``not …`` nor the several of a range or pool."""
    return single(rule.head)


def single(node: ast.AST) -> Literal | None:
    """The literal that a node is, where it is one: neither ``not …`` nor a range or pool."""
    head = literal_of(node)
    if head is None or node.sign != ast.Sign.NoSign:
        return None
    return None if nodes(node, ast.ASTType.Interval, ast.ASTType.Pool) else head


def literal_of(node: ast.AST) -> Literal | None:
    """The literal of a node without its ``not``; None where it is none."""
    if node.ast_type is not ast.ASTType.Literal or node.atom.ast_type is not (
        ast.ASTType.SymbolicAtom
    ):
        return None
    symbol, positive = node.atom.symbol, True
    while symbol.ast_type is ast.ASTType.UnaryOperation:
        symbol, positive = symbol.argument, not positive
    if symbol.ast_type is not ast.ASTType.Function:
        return None
    return Literal(
        predicate=symbol.name,
        arguments=tuple(str(argument) for argument in symbol.arguments),
        positive=positive,
    )


def atoms(node: ast.AST) -> list[ast.AST]:
    """The atoms of a node, in the order of the text."""
    return nodes(node, ast.ASTType.SymbolicAtom)


def nodes(node: ast.AST, *kinds: ast.ASTType) -> list[ast.AST]:
    """The nodes of some kinds, those inside of such left out, in the order of the text."""
    collect = _Collect(kinds)
    collect.visit(node)
    return collect.found


class _Collect(ast.Transformer):
    def __init__(self, kinds: tuple[ast.ASTType, ...]) -> None:
        self.kinds = kinds
        self.found: list[ast.AST] = []

    def visit(self, ast: ast.AST, *args: Any, **kwargs: Any) -> Any:
        if ast.ast_type in self.kinds:
            self.found.append(ast)
            return ast
        return super().visit(ast, *args, **kwargs)


def body_atoms(rule: ast.AST) -> Iterator[ast.AST]:
    """The atoms of a rule's conditions."""
    for element in rule.body:
        yield from atoms(element)


def function_of(atom: ast.AST) -> ast.AST:
    """The predicate with its arguments, without classical negation."""
    symbol: ast.AST = atom.symbol
    while symbol.ast_type is ast.ASTType.UnaryOperation:
        symbol = symbol.argument
    return symbol
