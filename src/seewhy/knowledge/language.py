"""Read the knowledge language: declarations and axioms, checked against the signature.

The language is that of the paper (AL_d and answer set prolog) over clingo terms.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from pathlib import Path

from clingo import ast

from seewhy.errors import KnowledgeError
from seewhy.knowledge.argument_sorts import check_atom
from seewhy.knowledge.axiom import Axiom, AxiomKind, Condition, Literal
from seewhy.knowledge.axiom_kinds import check_kinds
from seewhy.knowledge.declarations import Declarations
from seewhy.knowledge.number_range import check_numbers
from seewhy.knowledge.rule_nodes import (
    atoms,
    body_atoms,
    function_of,
    head_of,
    literal_of,
    nodes,
    single,
    spaced,
)
from seewhy.knowledge.rule_syntax import parse_rule
from seewhy.knowledge.safety import check_safety
from seewhy.knowledge.signature import Signature, Sort
from seewhy.knowledge.statements import NumberError, Statement, one_line, statements

_HERE = re.compile(r"^:\d+:\d+: ")


@dataclass(frozen=True)
class Knowledge:
    """A domain's knowledge: the signature and the axioms in the order of the file."""

    signature: Signature
    axioms: tuple[Axiom, ...]
    file: str

    @cached_property
    def has_defaults(self) -> bool:
        """Whether an axiom of it is a default, which may have exceptions."""
        return any(axiom.kind is AxiomKind.DEFAULT for axiom in self.axioms)

    @property
    def without_change(self) -> Knowledge:
        """What stays as it is in every state: the axioms about statics."""
        changes = self.signature.changes
        return replace(
            self, axioms=tuple(axiom for axiom in self.axioms if not changes(axiom.head.predicate))
        )

    def with_things(self, most: int) -> Knowledge:
        """Return the knowledge of pictures with at most so many things.

        The things are named after their sort: ``block1``, ``block2`` and so on.

        Raises
        ------
        KnowledgeError
            If there is no sort of things, or something else has the name of one.

        Examples
        --------
        >>> known = read_knowledge("#sort block = things. #static large(block).")
        >>> known.with_things(2).signature.members("block")
        ('block1', 'block2')
        """
        sorts = self.signature.sorts
        found = self.signature.sort_of_things
        if found is None:
            raise KnowledgeError(
                f"{self.file}: no sort is that of the things in a picture; declare one as "
                "'#sort thing = things.'"
            )
        names = tuple(f"{found.name}{number}" for number in range(1, most + 1))
        for sort in sorts.values():
            taken = {sort.name, *(sort.members or ())}.intersection(names)
            if taken and sort.name != found.name:
                raise KnowledgeError(
                    f"{sort.location}: '{min(taken)}' is how a thing of the picture is called; "
                    "call it otherwise"
                )
        counted = {**sorts, found.name: replace(found, members=names)}
        return replace(self, signature=replace(self.signature, sorts=counted))

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
        of_sort = (name for name, predicate in predicates.items() if sort in predicate.sorts)
        return self.without_names(frozenset({sort, *of_sort}))

    def without_names(self, gone: frozenset[str]) -> Knowledge:
        """What is left without some sorts and predicates, and the axioms about these.

        Examples
        --------
        >>> known = read_knowledge("#sort place = {hall}. #static dark(place). dark(hall).")
        >>> known.without_names(frozenset({"dark"})).axioms
        ()
        """
        declared = self.signature
        signature = Signature(
            {name: sort for name, sort in declared.sorts.items() if name not in gone},
            {name: found for name, found in declared.predicates.items() if name not in gone},
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
    return read_knowledge(knowledge_text(Path(path)), file=str(path))


def knowledge_text(path: Path) -> str:
    """Return the text of a ``.al`` file.

    Raises
    ------
    KnowledgeError
        If the file is missing, or is no text.
    """
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise KnowledgeError(
            f"{path}: there is no such file; a domain needs its axioms in knowledge.al"
        ) from None
    except (OSError, UnicodeDecodeError) as problem:
        raise KnowledgeError(f"{path}: cannot be read as UTF-8 text ({problem})") from None


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
    return _read(source, file)


# A domain is loaded by every command of a conversation and every trial of an experiment, and
# reading takes most of that time; what was read is never changed.
@lru_cache(maxsize=16)
def _read(source: str, file: str) -> Knowledge:
    declared = Declarations()
    rules: list[Statement] = []
    for statement in statements(source, file=file):
        if statement.text.startswith("#"):
            declared.add(statement)
        else:
            rules.append(statement)
    return knowledge_of(declared, rules, file=file)


def knowledge_of(declared: Declarations, rules: Sequence[Statement], *, file: str) -> Knowledge:
    """Return the knowledge of declarations and axioms that were read; errors as there."""
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
            kind, rule = parse_rule(statement)
            read.append(_read_axiom(statement, kind, rule, signature, f"{letter}{number}"))
        except RecursionError:
            raise KnowledgeError(
                f"{statement.location}: the statement that begins here is nested too deeply; "
                "write it as several"
            ) from None
        parsed.append((statement, kind, rule))
    axioms = tuple(read)
    check_safety(
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
    literal = head_of(rules[0]) if len(rules) == 1 and not rules[0].body else None
    if literal is None:
        raise KnowledgeError(
            f"'{one_line(text)}' is not a literal; write one such as stable(S) or -stable(S)"
        )
    return literal


def _read_axiom(
    statement: Statement, kind: AxiomKind, rule: ast.AST, signature: Signature, identifier: str
) -> Axiom:
    action, head = _action_and_head(statement, kind, rule)
    if head.predicate in signature.sorts:
        found = signature.sorts[head.predicate].of_things
        where = "found in the picture" if found else "listed where it is declared"
        raise KnowledgeError(
            f"{statement.location}: '{head.predicate}' is a sort; its members are {where}, an "
            "axiom cannot add to them"
        )
    variable_sorts: dict[str, Sort] = {}
    for atom in atoms(rule):
        check_atom(atom, signature, statement, variable_sorts)
    for variable in sorted({node.name for node in nodes(rule, ast.ASTType.Variable)}):
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
    check_kinds(axiom, [function_of(atom).name for atom in body_atoms(rule)], signature)
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
        action, effect = (single(part) for part in parts) if len(parts) == 2 else (None, None)
        if action is None or effect is None or not action.positive:
            raise KnowledgeError(
                f"{statement.location}: a causal law reads 'action causes fluent if condition, "
                f"condition.', with one action and one literal, got '{statement.line}'"
            )
        return action, effect
    head = head_of(rule)
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
    text = spaced(element)
    if element.sign == ast.Sign.DoubleNegation:
        return Condition(text=text)
    return Condition(
        text=text,
        literal=literal_of(element),
        absent=element.sign == ast.Sign.Negation and literal_of(element) is not None,
    )
