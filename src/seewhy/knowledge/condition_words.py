"""Say in words a condition of several literals: an aggregate, ``p : q``, ``not not``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from clingo import ast

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.signature import Signature

_COUNTED = {
    ">": "fewer than {n}",
    ">=": "at most {n}",
    "<": "more than {n}",
    "<=": "at least {n}",
    "=": "exactly {n}",
    "!=": "not {n}",
}
_MEASURED = {**_COUNTED, ">": "less than {n}", "=": "{n}"}
_SIGNS = (">", "<", "<=", ">=", "!=", "=")  # as clingo numbers them
_MIRRORED = {">": "<", "<": ">", "<=": ">=", ">=": "<=", "=": "=", "!=": "!="}
_OPPOSITE = {">": "<=", "<=": ">", "<": ">=", ">=": "<", "=": "!=", "!=": "="}
_FUNCTIONS = ("number", "sum of", "sum of", "least", "greatest")
_DENIED = "it is not so that "


def say_condition(
    text: str, signature: Signature, say: Callable[[Literal], str], *, holds: bool = True
) -> str:
    """Return a condition as a clause; variables are said by the names of their sorts.

    Where the condition does not hold, the clause says the opposite, which is so.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort box. #sort mark = {dent, scratch}. #static has(box, mark).")
    >>> say_condition("#count { M : has(box, M) } >= 2", known.signature, str)
    'for at least 2 values of mark, has(box, mark)'
    >>> say_condition("#count { M : has(box, M) } >= 2", known.signature, str, holds=False)
    'for fewer than 2 values of mark, has(box, mark)'
    >>> say_condition("has(box, M) : mark(M)", known.signature, str)
    'has(box, mark) for every mark'
    >>> say_condition("not not has(box, dent)", known.signature, str, holds=False)
    'it is not so that has(box, dent)'
    """
    found: list[ast.AST] = []
    ast.parse_string(f":- {text}.", found.append)
    (element,) = found[1].body
    words = _Words(signature, say, _sorts_of_variables(element, signature))
    if element.ast_type is ast.ASTType.ConditionalLiteral:
        said = words.every(element)
        return said if holds else f"{_DENIED}{said}"
    return words.atom(element.atom, holds=holds is not (element.sign == ast.Sign.Negation))


class _Words:
    def __init__(
        self, signature: Signature, say: Callable[[Literal], str], sorts: Mapping[str, str]
    ) -> None:
        self.signature = signature
        self.say = say
        self.sorts = sorts

    def atom(self, atom: ast.AST, *, holds: bool = True) -> str:
        if atom.ast_type is ast.ASTType.BodyAggregate:
            elements = [self.joined(element.condition) for element in atom.elements]
            terms = [element.terms for element in atom.elements]
            function = _FUNCTIONS[atom.function]
            return self.compared(atom, function, elements, terms, holds=holds)
        if atom.ast_type is ast.ASTType.Aggregate:
            elements = [
                self.joined([element.literal, *element.condition]) for element in atom.elements
            ]
            return self.compared(atom, "number", elements, (), holds=holds)
        said = self.symbol(atom) if atom.ast_type is ast.ASTType.SymbolicAtom else str(atom)
        return said if holds else f"{_DENIED}{said}"

    def compared(
        self,
        aggregate: ast.AST,
        function: str,
        elements: Sequence[str],
        terms: Sequence[Sequence[ast.AST]],
        *,
        holds: bool,
    ) -> str:
        guards = list(_guards(aggregate))
        denied = "" if holds or len(guards) == 1 else _DENIED
        words = _COUNTED if function == "number" else _MEASURED
        bounds = " and ".join(
            words[sign if holds or denied else _OPPOSITE[sign]].replace("{n}", str(term))
            for sign, term in guards
        )
        what = " or ".join(elements)
        if function != "number":
            # What '#sum { W, D : … }' adds up is the first of its terms.
            summed = " or ".join(dict.fromkeys(self.term(term[0]) for term in terms))
            return f"{denied}the {function} {summed} where {what} is {bounds}"
        counted = {self.term(term[0]) for term in terms if len(term) == 1}
        named = len(terms) == 1 and len(counted) == 1
        several = "" if [str(term) for _, term in guards] == ["1"] else "s"
        cases = f"value{several} of {counted.pop()}" if named else f"case{several}"
        return f"{denied}for {bounds} {cases}, {what}"

    def every(self, conditional: ast.AST) -> str:
        said = self.literal(conditional.literal)
        if not conditional.condition:
            return said
        sorts = [
            literal.atom.symbol.name.replace("_", " ")
            for literal in conditional.condition
            if _is_sort(literal, self.signature)
        ]
        others = [
            literal for literal in conditional.condition if not _is_sort(literal, self.signature)
        ]
        if others:
            return f"{said} whenever {self.joined(others)}"
        return f"{said} for every {' and '.join(sorts)}"

    def joined(self, literals: Iterable[ast.AST]) -> str:
        told = [
            self.literal(literal) for literal in literals if not _is_sort(literal, self.signature)
        ]
        return " and ".join(told) or "any"

    def literal(self, literal: ast.AST) -> str:
        said = self.atom(literal.atom)
        return f"{_DENIED}{said}" if literal.sign == ast.Sign.Negation else said

    def symbol(self, atom: ast.AST) -> str:
        symbol, positive = atom.symbol, True
        while symbol.ast_type is ast.ASTType.UnaryOperation:
            symbol, positive = symbol.argument, not positive
        arguments = tuple(self.term(argument) for argument in symbol.arguments)
        return self.say(Literal(symbol.name, arguments, positive))

    def term(self, term: ast.AST) -> str:
        if term.ast_type is ast.ASTType.Variable:
            return self.sorts.get(term.name, term.name)
        return str(term)


def _guards(aggregate: ast.AST) -> Iterable[tuple[str, ast.AST]]:
    """What an aggregate is compared with, as ``term sign aggregate``."""
    if aggregate.left_guard is not None:
        yield _SIGNS[aggregate.left_guard.comparison], aggregate.left_guard.term
    if aggregate.right_guard is not None:
        sign = _SIGNS[aggregate.right_guard.comparison]
        yield _MIRRORED[sign], aggregate.right_guard.term


def _is_sort(literal: ast.AST, signature: Signature) -> bool:
    atom = literal.atom
    return (
        atom.ast_type is ast.ASTType.SymbolicAtom
        and atom.symbol.ast_type is ast.ASTType.Function
        and atom.symbol.name in signature.sorts
    )


def _sorts_of_variables(element: ast.AST, signature: Signature) -> dict[str, str]:
    sorts: dict[str, str] = {}

    class Find(ast.Transformer):
        def visit_Function(self, function: ast.AST) -> ast.AST:  # noqa: N802
            name = function.name
            places: tuple[str, ...] = ()
            if name in signature.sorts:
                places = (name,)
            elif name in signature.predicates:
                places = signature.predicates[name].sorts
            for argument, sort in zip(function.arguments, places, strict=False):
                if argument.ast_type is ast.ASTType.Variable:
                    said = "anything" if argument.name == "_" else sort.replace("_", " ")
                    sorts.setdefault(argument.name, said)
            return function

    Find().visit(element)
    return sorts
