"""Axioms as data: literals, conditions, kinds and origins."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property, lru_cache

from clingo import ast

from seewhy.knowledge.signature import Location

STRING = re.compile(r'"(?:[^"\\]|\\.)*"')
_BRACES = re.compile(r"\{.*\}")
_VARIABLE = re.compile(r'"(?:[^"\\]|\\.)*"|(?<![A-Za-z0-9_\'])_*[A-Z][A-Za-z0-9_\']*')


def variables_in(text: str) -> tuple[str, ...]:
    """Return the variables of a term or condition, each once, in order of appearance.

    Examples
    --------
    >>> variables_in('num_blocks(S, N), N > 2, name("Bob")')
    ('S', 'N')
    """
    found = (match.group() for match in _VARIABLE.finditer(text))
    return tuple(dict.fromkeys(name for name in found if not name.startswith('"')))


def substitute(text: str, binding: Mapping[str, str]) -> str:
    """Replace the variables of ``text`` that ``binding`` names.

    Examples
    --------
    >>> substitute("num_blocks(S, N+1)", {"S": "scene", "N": "2"})
    'num_blocks(scene, 2+1)'
    """
    if text in binding:
        return binding[text]
    return _VARIABLE.sub(lambda match: binding.get(match.group(), match.group()), text)


@lru_cache(maxsize=4096)
def predicates_in(text: str) -> frozenset[str]:
    """Return the predicates that a condition speaks of, those inside aggregates included.

    Examples
    --------
    >>> sorted(predicates_in("#count { X : on(X, Y), not loose(X) } > 2"))
    ['loose', 'on']
    """
    return frozenset(name for name, _ in _named_in(text))


@lru_cache(maxsize=4096)
def denied_in(text: str) -> frozenset[str]:
    """Return the predicates that stand behind a ``not`` in a condition, or in what it denies.

    Examples
    --------
    >>> sorted(denied_in("#count { X : on(X, Y), not loose(X) } > 2"))
    ['loose']
    >>> sorted(denied_in("not #count { X : on(X, Y), not loose(X) } > 2"))
    ['loose', 'on']
    """
    return frozenset(name for name, is_denied in _named_in(text) if is_denied)


def _named_in(text: str) -> set[tuple[str, bool]]:
    """The predicates of a condition, each with whether a ``not`` stands before it."""
    found: list[ast.AST] = []
    ast.parse_string(f":- {text}.", found.append)
    named: set[tuple[str, bool]] = set()

    class Collect(ast.Transformer):
        is_denied = False

        def visit_Literal(self, literal: ast.AST) -> ast.AST:  # noqa: N802
            outside = self.is_denied
            self.is_denied = outside or literal.sign != ast.Sign.NoSign
            self.visit_children(literal)
            self.is_denied = outside
            return literal

        def visit_SymbolicAtom(self, atom: ast.AST) -> ast.AST:  # noqa: N802
            symbol = atom.symbol
            while symbol.ast_type is ast.ASTType.UnaryOperation:
                symbol = symbol.argument
            named.add((symbol.name, self.is_denied))
            return atom

    Collect().visit(found[1])
    return named


@dataclass(frozen=True)
class Literal:
    """A predicate with its arguments, affirmed or denied by classical negation.

    Examples
    --------
    >>> str(Literal(predicate="stable", arguments=("S",), positive=False))
    '-stable(S)'
    """

    predicate: str
    arguments: tuple[str, ...]
    positive: bool = True

    def __str__(self) -> str:
        arguments = f"({', '.join(self.arguments)})" if self.arguments else ""
        return f"{'' if self.positive else '-'}{self.predicate}{arguments}"

    @property
    def complement(self) -> Literal:
        """The same literal with the opposite classical sign."""
        return replace(self, positive=not self.positive)

    def substitute(self, binding: Mapping[str, str]) -> Literal:
        """Return the literal with variables replaced as ``binding`` says."""
        arguments = tuple([substitute(argument, binding) for argument in self.arguments])
        return Literal(self.predicate, arguments, self.positive)


@dataclass(frozen=True)
class Condition:
    """One element of an axiom's body, as written.

    ``literal`` is None for comparisons and aggregates, which clingo evaluates as they stand.
    ``absent`` is True for ``not …``: the condition holds when the literal is not believed.
    """

    text: str
    literal: Literal | None = None
    absent: bool = False

    def __str__(self) -> str:
        return self.text

    @cached_property
    def is_local(self) -> bool:
        """Whether the condition has variables of its own, as ``#count {…}`` and ``p(X) : q(X)``."""
        return self.literal is None and re.search("[{:]", STRING.sub("", self.text)) is not None


class AxiomKind(StrEnum):
    """The statements of the action language AL_d (section 3.2 of the paper).

    A default with a fluent as its head is about the initial state.
    """

    STATE_CONSTRAINT = "state constraint"
    DEFAULT = "default"
    CAUSAL_LAW = "causal law"
    EXECUTABILITY_CONDITION = "executability condition"


@dataclass(frozen=True)
class Origin:
    """Where an axiom comes from: given by a person, or learned from scenes.

    ``support`` counts the scenes that a learned axiom speaks about; ``precision`` is the share of
    them on which it is right, ``pictures`` are theirs, and ``things`` is what they are called.
    """

    learned: bool = False
    support: int = 0
    precision: float = 1.0
    pictures: tuple[str, ...] = ()
    things: str = "scenes"


@dataclass(frozen=True)
class Axiom:
    """One statement of the knowledge: the head is believed where all conditions hold.

    ``action`` is what a causal law or an executability condition speaks of; the head is then its
    effect in the next state, or the action denied.

    ``text`` is the sentence that the author put above it (``%%``), or the statement itself.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> knowledge = read_knowledge('''
    ... #sort structure.
    ... #static stable(structure).
    ... #static block_displaced(structure).
    ... %% a displaced block falls
    ... -stable(S) if block_displaced(S).
    ... ''')
    >>> axiom = knowledge.axioms[0]
    >>> str(axiom)
    '-stable(S) if block_displaced(S).'
    >>> axiom.text, axiom.location.line
    ('a displaced block falls', 6)
    """

    identifier: str
    kind: AxiomKind
    head: Literal
    body: tuple[Condition, ...]
    text: str
    location: Location
    origin: Origin = Origin()
    action: Literal | None = None

    def __str__(self) -> str:
        head = {
            AxiomKind.STATE_CONSTRAINT: f"{self.head}",
            AxiomKind.DEFAULT: f"default {self.head}",
            AxiomKind.CAUSAL_LAW: f"{self.action} causes {self.head}",
            AxiomKind.EXECUTABILITY_CONDITION: f"impossible {self.action}",
        }[self.kind]
        # After 'p(X) : q(X)' a comma would go on with what stands behind the colon.
        ends = [
            "; " if condition.is_local and "{" not in condition.text else ", "
            for condition in self.body
        ]
        body = "".join(f"{condition}{end}" for condition, end in zip(self.body, ends, strict=True))
        return f"{head}{' if ' if body else ''}{body[:-2]}."

    @property
    def has_sentence(self) -> bool:
        """Whether its author says it in words, or its text is the statement itself."""
        return self.text.rstrip(".") != str(self).rstrip(".")

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """The variables of head and body, those of local conditions left out, in order.

        What an aggregate is compared with is no variable of its own.
        """
        parts = [str(self.action or ""), str(self.head)]
        parts += [
            _BRACES.sub("", condition.text) if "{" in condition.text else condition.text
            for condition in self.body
            if "{" in condition.text or not condition.is_local
        ]
        return variables_in(" ".join(parts))

    @property
    def ranging_variables(self) -> tuple[str, ...]:
        """The variables of head and action, which range over the sorts of their places."""
        return variables_in(f"{self.action or ''} {self.head}")

    @property
    def predicates(self) -> frozenset[str]:
        """The predicates that it speaks of, sorts that are used as such included."""
        named = {self.head.predicate, *([self.action.predicate] if self.action else [])}
        return frozenset(named.union(*(predicates_in(condition.text) for condition in self.body)))
