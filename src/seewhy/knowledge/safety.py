"""Whether every variable of a rule is bound by one of its conditions."""

from __future__ import annotations

import re
from collections.abc import Sequence

import clingo
from clingo import ast

from seewhy.errors import KnowledgeError
from seewhy.knowledge.rule_syntax import CLINGO_ERROR
from seewhy.knowledge.statements import Statement, one_line

__all__ = ["check_safety"]


_UNSAFE = re.compile(r":(\d+):(\d+)(?:-[\d:]+)?: note: '(\S+)' is unsafe")


def check_safety(rules: list[tuple[Statement, ast.AST, tuple[str, ...]]]) -> None:
    """Ask clingo whether every variable is bound by a positive condition.

    The variables that a rule comes with are bound: they range over their sort.
    """
    messages: list[str] = []
    control = clingo.Control(logger=lambda _, m: messages.append(m))
    # No instance of a rule is ever built: the added condition holds nowhere.
    never = _parse_condition("never__")
    try:
        with ast.ProgramBuilder(control) as builder:
            for _, rule, bound in rules:
                builder.add(rule.update(body=[*rule.body, never, _bound(bound)]))
        control.ground([("base", [])])
    except RuntimeError:
        found = [pattern.search(m) for pattern in (_UNSAFE, CLINGO_ERROR) for m in messages]
        match = next(filter(None, found), None)
        if match is None:
            raise
        line, column, what = int(match.group(1)), int(match.group(2)), match.group(3)
        begun = [
            statement
            for statement, *_ in rules
            if (statement.location.line, statement.location.column) <= (line, column)
        ]
        place = begun[-1].place(line, column)
        if match.re is CLINGO_ERROR:
            raise KnowledgeError(f"{place}: {one_line(what)}; remove it") from None
        if what.startswith("#Anon"):
            what = "_"
        raise KnowledgeError(
            f"{place}: nothing says what '{what}' ranges over; use it in a condition without "
            "'not', a sort such as structure(S) for instance"
        ) from None


def _bound(variables: Sequence[str]) -> ast.AST:
    return _parse_condition(f"bound__({', '.join(variables)})" if variables else "never__")


def _parse_condition(text: str) -> ast.AST:
    found: list[ast.AST] = []
    ast.parse_string(f":- {text}.", found.append)
    condition: ast.AST = found[1].body[0]
    return condition
