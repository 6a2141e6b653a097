"""Read the knowledge language: declarations and axioms, checked against the signature.

The language is that of the paper (AL_d and answer set prolog) over clingo terms. ``if`` is
replaced by ``:-``, and ``causes`` by ``;`` and blanks, which are as long, so that the positions
that clingo's parser reports are those of the user's file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import clingo
from clingo import ast

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import Axiom, AxiomKind, Condition, Literal
from seewhy.knowledge.axiom_kinds import check_kinds
from seewhy.knowledge.declarations import Declarations
from seewhy.knowledge.number_range import check_numbers
from seewhy.knowledge.signature import Signature, Sort
from seewhy.knowledge.statements import NumberError, Statement, one_line, statements
from seewhy.text.nearest import did_you_mean

_WORD = re.compile(r"\"(?:[^\"\\]|\\.)*\"|[A-Za-z0-9_']+")
_CLINGO_ERROR = re.compile(r":(\d+):(\d+)(?:-[\d:]+)?: error: (.+)", re.DOTALL)
_FIRST_WORDS = {
    "default": AxiomKind.DEFAULT,
    "impossible": AxiomKind.EXECUTABILITY_CONDITION,
}
_HERE = re.compile(r"^:\d+:\d+: ")
_UNSAFE = re.compile(r":(\d+):(\d+)(?:-[\d:]+)?: note: '(\S+)' is unsafe")


@dataclass(frozen=True)
class Knowledge:
    """A domain's knowledge: the signature and the axioms in the order of the file."""

    signature: Signature
    axioms: tuple[Axiom, ...]
    file: str

    @property
    def without_change(self) -> Knowledge:
        """What stays as it is in every state: the axioms about statics."""
        changes = self.signature.changes
        return replace(
            self, axioms=tuple(axiom for axiom in self.axioms if not changes(axiom.head.predicate))
        )

    def without_sort(self, sort: str) -> Knowledge:
        """What is left without a sort, the predicates of it, and the axioms about these.

        Examples
        --------
        >>> known = read_knowledge('''
        ... #sort view. #sort place = {hall}. #static dark(view). #static large(place).
        ... -dark(V) if view(V), not dark(V). large(hall).
        ... ''')
        >>> [str(axiom) for axiom in known.without_sort("view").axioms]
        ['large(hall).']
        """
        predicates = self.signature.predicates
        gone = {sort, *(name for name, predicate in predicates.items() if sort in predicate.sorts)}
        signature = Signature(
            {name: declared for name, declared in self.signature.sorts.items() if name != sort},
            {name: predicate for name, predicate in predicates.items() if name not in gone},
        )
        return Knowledge(
            signature,
            tuple(axiom for axiom in self.axioms if not gone.intersection(axiom.predicates)),
            self.file,
        )


def read_knowledge_file(path: Path | str) -> Knowledge:
    """Read a ``.al`` file.

    Raises
    ------
    KnowledgeError
        Where the file is missing or a statement is wrong; the text names file, line and column.
    """
    path = Path(path)
    try:
        source = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise KnowledgeError(
            f"{path}: there is no such file; a domain needs its axioms in knowledge.al"
        ) from None
    except (OSError, UnicodeDecodeError) as problem:
        raise KnowledgeError(f"{path}: cannot be read as UTF-8 text ({problem})") from None
    return read_knowledge(source, file=str(path))


def read_knowledge(source: str, *, file: str = "knowledge.al") -> Knowledge:
    """Read knowledge from text; ``file`` is the name that errors and justifications give.

    Raises
    ------
    KnowledgeError
        Where a statement is wrong; the text names file, line, column and the remedy.

    Examples
    --------
    >>> knowledge = read_knowledge('''
    ... #sort structure.
    ... #sort num = 1..5.
    ... #static num_blocks(structure, num).
    ... #static stable(structure).
    ... stable(S) if num_blocks(S, N), N < 2.
    ... ''')
    >>> [str(axiom) for axiom in knowledge.axioms]
    ['stable(S) if num_blocks(S, N), N < 2.']
    """
    declared = Declarations()
    rules: list[Statement] = []
    for statement in statements(source, file=file):
        if statement.text.startswith("#"):
            declared.add(statement)
        else:
            rules.append(statement)
    signature = Signature(sorts=declared.sorts, predicates=declared.predicates)
    axioms = _read_axioms(rules, signature, letter="a")
    return Knowledge(signature=signature, axioms=axioms, file=file)


def read_axioms(
    source: str, signature: Signature, *, file: str = "learned.al", letter: str = "l"
) -> tuple[Axiom, ...]:
    """Read axioms alone, over a signature that stands elsewhere.

    ``letter`` begins their identifiers, so that they differ from those of other files.

    Raises
    ------
    KnowledgeError
        As :func:`read_knowledge`; also where something is declared.

    Examples
    --------
    >>> known = read_knowledge("#sort structure. #static stable(structure).")
    >>> [axiom.identifier for axiom in read_axioms("stable(S) if structure(S).", known.signature)]
    ['l1']
    """
    rules = list(statements(source, file=file))
    for statement in rules:
        if statement.text.startswith("#"):
            raise KnowledgeError(
                f"{statement.location}: found '{statement.line}', expected an axiom; what there "
                "is, is declared in knowledge.al"
            )
    return _read_axioms(rules, signature, letter=letter)


def _read_axioms(
    rules: Sequence[Statement], signature: Signature, *, letter: str
) -> tuple[Axiom, ...]:
    parsed: list[tuple[Statement, AxiomKind, ast.AST]] = []
    read: list[Axiom] = []
    for number, statement in enumerate(rules, start=1):
        try:
            kind, rule = _parse_rule(statement)
            read.append(_read_axiom(statement, kind, rule, signature, f"{letter}{number}"))
        except RecursionError:
            raise KnowledgeError(
                f"{statement.location}: the statement that begins here is nested too deeply; "
                "write it as several"
            ) from None
        parsed.append((statement, kind, rule))
    axioms = tuple(read)
    _check_safety(
        [
            (
                statement,
                rule,
                _bound_variables(axiom, signature),
            )
            for (statement, _, rule), axiom in zip(parsed, axioms, strict=True)
        ]
    )
    return axioms


def _bound_variables(axiom: Axiom, signature: Signature) -> tuple[str, ...]:
    """The variables that need no condition: those of fluents and actions range over a sort."""
    return axiom.ranging_variables if signature.changes(axiom.head.predicate) else ()


def read_literal(text: str) -> Literal:
    """Read one literal such as ``-stable(S)``.

    Raises
    ------
    KnowledgeError
        If the text is not a single literal.

    Examples
    --------
    >>> read_literal("-stable(S)")
    Literal(predicate='stable', arguments=('S',), positive=False)
    """
    found: list[ast.AST] = []
    try:
        (statement,) = statements(f"{text}.", file="")
        if statement.text.startswith("#"):
            raise ValueError(text)
        ast.parse_string(f"{statement.text}.", found.append, logger=lambda *_: None)
    except NumberError as problem:
        raise NumberError(_HERE.sub("", str(problem))) from None
    except (RuntimeError, ValueError):
        found = []
    rules = [node for node in found if node.ast_type is ast.ASTType.Rule]
    literal = _head_of(rules[0]) if len(rules) == 1 and not rules[0].body else None
    if literal is None:
        raise KnowledgeError(
            f"'{one_line(text)}' is not a literal; write one such as stable(S) or -stable(S)"
        )
    return literal


def _parse_rule(statement: Statement) -> tuple[AxiomKind, ast.AST]:
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
    match = next(filter(None, map(_CLINGO_ERROR.search, messages)), None)
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


def _read_axiom(
    statement: Statement, kind: AxiomKind, rule: ast.AST, signature: Signature, identifier: str
) -> Axiom:
    action, head = _action_and_head(statement, kind, rule)
    if head.predicate in signature.sorts:
        raise KnowledgeError(
            f"{statement.location}: '{head.predicate}' is a sort; its members are listed where "
            "it is declared, an axiom cannot add to them"
        )
    variable_sorts: dict[str, Sort] = {}
    for atom in _atoms(rule):
        _check_atom(atom, signature, statement, variable_sorts)
    for variable in sorted({node.name for node in _nodes(rule, ast.ASTType.Variable)}):
        if variable.endswith("__"):
            raise KnowledgeError(
                f"{statement.location}: '{variable}' is no variable: names that end in '__' are "
                f"kept for what is added to the knowledge; call it '{variable.rstrip('_')}'"
            )
    check_numbers(rule, variable_sorts, statement)
    body = tuple(_read_condition(element, statement) for element in rule.body)
    axiom = Axiom(
        identifier=identifier,
        kind=kind,
        head=head,
        body=body,
        text=statement.sentence,
        location=statement.location,
        action=action,
    )
    check_kinds(axiom, [_function_of(atom).name for atom in _body_atoms(rule)], signature)
    return axiom if axiom.text else Axiom(**{**axiom.__dict__, "text": str(axiom).rstrip(".")})


def _action_and_head(
    statement: Statement, kind: AxiomKind, rule: ast.AST
) -> tuple[Literal | None, Literal]:
    """The action that an axiom speaks of, if any, and the literal that it concludes."""
    if kind is AxiomKind.CAUSAL_LAW:
        parts = (
            [element.literal for element in rule.head.elements if not element.condition]
            if rule.head.ast_type is ast.ASTType.Disjunction
            else []
        )
        action, effect = (_single(part) for part in parts) if len(parts) == 2 else (None, None)
        if action is None or effect is None or not action.positive:
            raise KnowledgeError(
                f"{statement.location}: a causal law reads 'action causes fluent if condition, "
                f"condition.', with one action and one literal, got '{statement.line}'"
            )
        return action, effect
    head = _head_of(rule)
    if head is None:
        got = "none" if str(rule.head) == "#false" else f"'{rule.head}'"
        raise KnowledgeError(
            f"{statement.location}: the head of an axiom must be one literal such as stable(S) "
            f"or -stable(S), got {got}"
        )
    if kind is not AxiomKind.EXECUTABILITY_CONDITION:
        return None, head
    if not head.positive:
        raise KnowledgeError(
            f"{statement.location}: what is impossible is an action without '-', got '{head}'"
        )
    return head, head.complement


_CONDITIONS = (
    ast.ASTType.SymbolicAtom,
    ast.ASTType.Comparison,
    ast.ASTType.BooleanConstant,
    ast.ASTType.BodyAggregate,
    ast.ASTType.Aggregate,
)


def _read_condition(element: ast.AST, statement: Statement) -> Condition:
    inner = element.literal if element.ast_type is ast.ASTType.ConditionalLiteral else element
    if inner.ast_type is not ast.ASTType.Literal or inner.atom.ast_type not in _CONDITIONS:
        begin = element.location.begin
        raise KnowledgeError(
            f"{statement.place(begin.line, begin.column)}: '{element}' is no condition; write a "
            "literal, a comparison, or a count of literals"
        )
    if element.ast_type is not ast.ASTType.Literal:
        return Condition(text=str(element))
    text = _spaced(element)
    if element.sign == ast.Sign.DoubleNegation:
        return Condition(text=text)
    return Condition(
        text=text,
        literal=_literal_of(element),
        absent=element.sign == ast.Sign.Negation and _literal_of(element) is not None,
    )


def _spaced(element: ast.AST) -> str:
    """The text of a body element in the language's own spelling."""
    literal = _literal_of(element)
    if literal is None:
        return str(element)
    signs = {ast.Sign.Negation: "not ", ast.Sign.DoubleNegation: "not not "}
    return f"{signs.get(element.sign, '')}{literal}"


def _head_of(rule: ast.AST) -> Literal | None:
    """The head where it is one literal: neither ``not …`` nor the several of a range or pool."""
    return _single(rule.head)


def _single(node: ast.AST) -> Literal | None:
    head = _literal_of(node)
    if head is None or node.sign != ast.Sign.NoSign:
        return None
    return None if _nodes(node, ast.ASTType.Interval, ast.ASTType.Pool) else head


def _literal_of(node: ast.AST) -> Literal | None:
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


def _atoms(node: ast.AST) -> list[ast.AST]:
    return _nodes(node, ast.ASTType.SymbolicAtom)


def _nodes(node: ast.AST, *kinds: ast.ASTType) -> list[ast.AST]:
    """The nodes of some kinds, those inside of such left out, in the order of the text."""
    found: list[ast.AST] = []

    class Collect(ast.Transformer):
        def visit(self, ast: ast.AST, *args: Any, **kwargs: Any) -> Any:
            if ast.ast_type in kinds:
                found.append(ast)
                return ast
            return super().visit(ast, *args, **kwargs)

    Collect().visit(node)
    return found


def _body_atoms(rule: ast.AST) -> Iterator[ast.AST]:
    for element in rule.body:
        yield from _atoms(element)


def _function_of(atom: ast.AST) -> ast.AST:
    """The predicate with its arguments, without classical negation."""
    symbol: ast.AST = atom.symbol
    while symbol.ast_type is ast.ASTType.UnaryOperation:
        symbol = symbol.argument
    return symbol


def _check_atom(
    atom: ast.AST, signature: Signature, statement: Statement, variable_sorts: dict[str, Sort]
) -> None:
    symbol = _function_of(atom)
    begin = symbol.location.begin
    here = statement.place(begin.line, begin.column)
    if symbol.ast_type is not ast.ASTType.Function:
        raise KnowledgeError(f"{here}: '{symbol}' is no literal; write predicate(argument, …)")
    if symbol.name in signature.sorts:
        sorts: tuple[str, ...] = (symbol.name,)
    elif symbol.name in signature.predicates:
        sorts = signature.predicates[symbol.name].sorts
    else:
        names = [*signature.predicates, *signature.sorts]
        known = [name for name in names if not name.endswith("__")]
        raise KnowledgeError(
            f"{here}: '{symbol.name}' is not declared; {did_you_mean(symbol.name, known)}"
        )
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
        if sort.members is None:
            raise KnowledgeError(
                f"{here}: '{predicate}' takes the {sort.name} of the picture here, got "
                f"'{value}'; use a variable such as S"
            )
        if value not in sort.members:
            raise KnowledgeError(
                f"{here}: '{value}' is not of sort '{sort.name}', which '{predicate}' takes "
                f"here; {did_you_mean(value, sort.members)}"
            )


def _check_safety(rules: list[tuple[Statement, ast.AST, tuple[str, ...]]]) -> None:
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
        found = [pattern.search(m) for pattern in (_UNSAFE, _CLINGO_ERROR) for m in messages]
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
        if match.re is _CLINGO_ERROR:
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
