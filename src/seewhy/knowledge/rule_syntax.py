"""One statement of the knowledge language becomes a rule of clingo's syntax.

``if`` is replaced by ``:-``, and ``causes`` by ``;`` and blanks, which are as long, so that the
positions that clingo's parser reports are those of the user's file.
"""

from __future__ import annotations

import re

from clingo import ast

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import AxiomKind
from seewhy.knowledge.statements import Statement, one_line

__all__ = ["CLINGO_ERROR", "parse_rule"]


_WORD = re.compile(r"\"(?:[^\"\\]|\\.)*\"|[A-Za-z0-9_']+")
CLINGO_ERROR = re.compile(r":(\d+):(\d+)(?:-[\d:]+)?: error: (.+)", re.DOTALL)
"""What clingo's parser says: line, column and what is wrong."""
_FIRST_WORDS = {
    "default": AxiomKind.DEFAULT,
    "impossible": AxiomKind.EXECUTABILITY_CONDITION,
}


def parse_rule(statement: Statement) -> tuple[AxiomKind, ast.AST]:
    """Turn a statement into clingo's syntax tree without moving any character."""
    text, location = statement.text, statement.location
    kind = AxiomKind.STATE_CONSTRAINT
    if ":-" in re.sub(r'"(?:[^"\\]|\\.)*"', "", text):
        raise KnowledgeError(f"{location}: found ':-'; write 'if' between head and body")
    words = [m for m in _WORD.finditer(text) if not m.group().startswith('"')]
    if words and words[0].group() in _FIRST_WORDS:
        kind = _FIRST_WORDS[words[0].group()]
        text = " " * words[0].end() + text[words[0].end() :]
        if text.lstrip().startswith("#"):
            raise KnowledgeError(
                f"{location}: found '{statement.line}', expected a literal after "
                f"'{words[0].group()}'"
            )
    causes = [word for word in words if word.group() == "causes"]
    if len(causes) > 1 or (causes and kind is not AxiomKind.STATE_CONSTRAINT):
        other = "causes" if len(causes) > 1 else words[0].group()
        raise KnowledgeError(
            f"{location}: found '{other}' and 'causes' in one statement; a causal law reads "
            "'action causes fluent if condition, condition.'"
        )
    if causes:
        kind = AxiomKind.CAUSAL_LAW
        text = f"{text[: causes[0].start()]};     {text[causes[0].end() :]}"
    ifs = [word for word in words if word.group() == "if"]
    if len(ifs) > 1:
        raise KnowledgeError(
            f"{location}: found 'if' {len(ifs)} times in one statement; "
            "end the statement before the second with a full stop"
        )
    if ifs:
        text = f"{text[: ifs[0].start()]}:-{text[ifs[0].end() :]}"
    padded = "\n" * (location.line - 1) + " " * (location.column - 1) + text + "."
    messages: list[str] = []
    found: list[ast.AST] = []
    try:
        ast.parse_string(padded, found.append, logger=lambda _, m: messages.append(m))
    except RuntimeError:
        raise KnowledgeError(_syntax_message(messages, statement)) from None
    rules = [node for node in found if node.ast_type is ast.ASTType.Rule]
    if len(rules) != 1 or len(found) != 2:
        raise KnowledgeError(
            f"{location}: found '{statement.line}', expected an axiom: head, 'if', conditions"
        )
    return kind, rules[0]


def _syntax_message(messages: list[str], statement: Statement) -> str:
    match = next(filter(None, map(CLINGO_ERROR.search, messages)), None)
    if match is None:
        return (
            f"{statement.location}: the statement that begins here cannot be read; "
            "check its spelling"
        )
    what = one_line(match.group(3))
    place = statement.place(int(match.group(1)), int(match.group(2)))
    what = (
        what.replace(":-", "if")
        .replace("<IDENTIFIER>", "a name")
        .replace("<VARIABLE>", "a variable")
        .replace("EOF", "the end")
    )
    return f"{place}: {what}; an axiom reads 'head if condition, condition.'"
