"""Whether the literals of a rule are declared, and their arguments of the sorts declared."""

from __future__ import annotations

from clingo import ast

from seewhy.errors import KnowledgeError
from seewhy.knowledge.rule_nodes import function_of
from seewhy.knowledge.signature import Signature, Sort
from seewhy.knowledge.statements import Statement
from seewhy.text.nearest import did_you_mean

__all__ = ["check_atom"]


def check_atom(
    atom: ast.AST, signature: Signature, statement: Statement, variable_sorts: dict[str, Sort]
) -> None:
    """Raise a KnowledgeError where an atom is not declared so.

    ``variable_sorts`` are the sorts of the rule's variables as far as they are known; the atom's
    are added.
    """
    symbol = function_of(atom)
    begin = symbol.location.begin
    here = statement.place(begin.line, begin.column)
    if symbol.ast_type is not ast.ASTType.Function:
        raise KnowledgeError(f"{here}: '{symbol}' is no literal; write predicate(argument, …)")
    if symbol.name not in signature.sorts and symbol.name not in signature.predicates:
        names = [*signature.predicates, *signature.sorts]
        known = [name for name in names if not name.endswith("__")]
        raise KnowledgeError(
            f"{here}: '{symbol.name}' is not declared; {did_you_mean(symbol.name, known)}"
        )
    sorts = signature.argument_sorts(symbol.name)
    if len(symbol.arguments) != len(sorts):
        shown = f" ({', '.join(sorts)})" if sorts else ""
        raise KnowledgeError(
            f"{here}: '{symbol.name}' takes {len(sorts)} argument{'s' * (len(sorts) != 1)}"
            f"{shown}, got {len(symbol.arguments)}"
        )
    for argument, sort in zip(symbol.arguments, sorts, strict=True):
        _check_argument(argument, signature.sorts[sort], symbol.name, statement, variable_sorts)


def _check_argument(
    argument: ast.AST,
    sort: Sort,
    predicate: str,
    statement: Statement,
    variable_sorts: dict[str, Sort],
) -> None:
    begin = argument.location.begin
    here = statement.place(begin.line, begin.column)
    if argument.ast_type is ast.ASTType.Variable and argument.name != "_":
        known = variable_sorts.setdefault(argument.name, sort)
        disjoint = known.name != sort.name and not (
            set(known.members or ()) & set(sort.members or ())
        )
        if disjoint:
            raise KnowledgeError(
                f"{here}: '{argument.name}' is of sort '{known.name}' elsewhere in this axiom, "
                f"but '{predicate}' takes '{sort.name}' here; use two variables"
            )
    elif argument.ast_type in (ast.ASTType.SymbolicTerm, ast.ASTType.Function):
        value = str(argument)
        if sort.members is None or sort.of_things:
            what, variable = ("a", "T") if sort.of_things else ("the", "S")
            raise KnowledgeError(
                f"{here}: '{predicate}' takes {what} {sort.name} of the picture here, got "
                f"'{value}'; use a variable such as {variable}"
            )
        if value not in sort.members:
            raise KnowledgeError(
                f"{here}: '{value}' is not of sort '{sort.name}', which '{predicate}' takes "
                f"here; {did_you_mean(value, sort.members)}"
            )
