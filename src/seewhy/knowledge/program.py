"""Translate a signature, axioms and a scene into one CR-Prolog program for clingo.

Literals become terms of ``holds/1``; ``-p(x)`` is classical negation, and a literal believed
together with its complement raises ``conflict``. A program is strict where ``conflict`` is
assumed false, and can still be looked into where it is not. Each feature of the picture is one
choice that is settled by an assumption, so that a program is grounded once for all pictures.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from clingo import ast

from seewhy.knowledge.axiom import Axiom, AxiomKind, variables_in
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.scene import SceneSchema
from seewhy.knowledge.signature import Signature

UNKNOWN = "unknown__"
"""The term that stands for a feature whose value was not seen."""
CONTRADICTORY = "contradictory__"
"""What is true in :func:`without_exceptions` where the beliefs contradict each other."""
_RENAMED = {"holds": "without_exceptions__", "conflict": CONTRADICTORY}
_STRICTLY = ":- strict, conflict."


def program_text(
    knowledge: Knowledge,
    schema: SceneSchema,
    *,
    exceptions: bool = False,
    firings: bool = False,
) -> str:
    """Return the program whose answer sets are the beliefs about a scene.

    Parameters
    ----------
    knowledge : Knowledge
    schema : SceneSchema
    exceptions : bool
        Add a consistency-restoring rule for every default: ``exception(axiom, (variables))``
        may be assumed and makes the default's conclusion false (section 3.2, statement (6)).
    firings : bool
        Add ``fires(axiom, (variables))`` for every instance of an axiom whose conditions hold,
        which justifications are built from.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> rule = "holds(-stable(S)) :- holds(block_displaced(S)); sort(structure, S)."
    >>> rule in program_text(domain.knowledge, domain.schema)
    True
    """
    lines = [
        *sort_facts(knowledge.signature, schema, scenes=(schema.scene,)),
        *_observations(schema),
        "conflict(L) :- holds(L), holds(-L).",
        "conflict :- conflict(L).",
        "{ strict }.",
        _STRICTLY,
    ]
    for axiom in knowledge.axioms:
        lines += axiom_rules(axiom, knowledge.signature, exceptions=exceptions, firings=firings)
    return "\n".join(lines) + "\n"


def without_exceptions(knowledge: Knowledge, schema: SceneSchema) -> str:
    """Return what is added to a program with exceptions to know whether a scene needs any.

    It is the program without exceptions, its beliefs renamed, over the same features. Of
    stratified knowledge, a scene needs exceptions where :data:`CONTRADICTORY` is true.
    """
    lines: list[str] = []
    rename = _Rename()
    ast.parse_string(
        program_text(knowledge, schema).replace(f"{_STRICTLY}\n", ""),
        lambda statement: lines.append(str(rename.visit(statement))),
    )
    return "\n".join(lines) + "\n"


class _Rename(ast.Transformer):
    """Renames the program's atoms, and none of the names of the domain that stand in them."""

    def visit_SymbolicAtom(self, atom: ast.AST) -> ast.AST:  # noqa: N802
        name = _RENAMED.get(atom.symbol.name)
        return atom if name is None else atom.update(symbol=atom.symbol.update(name=name))


def body_text(axiom: Axiom, signature: Signature) -> str:
    """Return an axiom's conditions over ``holds/1`` and ``sort/2``, without a final stop."""
    return "; ".join(held(condition.text, signature) for condition in axiom.body)


def held(condition: str, signature: Signature) -> str:
    """Wrap every literal of a condition: ``p(X)`` becomes ``holds(p(X))``, a sort ``sort(s, X)``.

    Examples
    --------
    >>> from seewhy.knowledge.signature import Signature
    >>> held("not -p(X)", Signature())
    'not holds(-p(X))'
    """
    return _held(condition, signature.given_sorts)


@lru_cache(maxsize=4096)
def _held(condition: str, sorts: frozenset[str]) -> str:
    found: list[ast.AST] = []
    ast.parse_string(f":- {condition}.", found.append)
    (element,) = _Wrap(sorts).visit(found[1]).body
    return str(element)


class _Wrap(ast.Transformer):
    def __init__(self, sorts: frozenset[str]) -> None:
        self.sorts = sorts

    def visit_SymbolicAtom(self, atom: ast.AST) -> ast.AST:  # noqa: N802
        symbol = atom.symbol
        if symbol.ast_type is ast.ASTType.Function and symbol.name in self.sorts:
            name = ast.Function(symbol.location, symbol.name, [], False)
            wrapped = ast.Function(symbol.location, "sort", [name, *symbol.arguments], False)
        else:
            wrapped = ast.Function(symbol.location, "holds", [symbol], False)
        return atom.update(symbol=wrapped)


def variable_tuple(axiom: Axiom) -> str:
    """The axiom's variables as one term; ``(X,)`` for a single one."""
    variables = axiom.variables
    return f"({', '.join(variables)}{',' if len(variables) == 1 else ''})"


def head_guards(axiom: Axiom, signature: Signature) -> list[str]:
    """Conditions that keep arithmetic in a head within its sort, so that grounding ends."""
    sorts = signature.predicates[axiom.head.predicate].sorts
    return [
        f"sort({sort}, {argument})"
        for argument, sort in zip(axiom.head.arguments, sorts, strict=True)
        if variables_in(argument)
    ]


def sort_facts(
    signature: Signature, schema: SceneSchema, *, scenes: tuple[str, ...]
) -> Iterator[str]:
    """Yield the members of every sort; ``scenes`` are those of the scene's."""
    for sort in signature.sorts.values():
        members = scenes if sort.name == schema.scene else sort.members or ()
        yield " ".join(f"sort({sort.name}, {member})." for member in members)


def _observations(schema: SceneSchema) -> Iterator[str]:
    for feature, literals in schema.features.items():
        values = "; ".join(f"observed({feature}, {value})" for value in (*literals, UNKNOWN))
        yield f"1 {{ {values} }} 1."
        for value, literal in literals.items():
            yield f"holds({literal}) :- observed({feature}, {value})."
        # Of a feature with several values, the value that is seen rules the others out.
        if all(literal.positive for literal in literals.values()):
            unseen = f"not observed({feature}, {UNKNOWN})"
            for value, literal in literals.items():
                # One rule a value: as many as there are pairs would be too many of hundreds.
                yield f"holds({literal.complement}) :- {unseen}, not observed({feature}, {value})."
    for feature, presences in schema.requires.items():
        for presence in presences:
            yield f":- not observed({presence}, yes), not observed({feature}, {UNKNOWN})."


def axiom_rules(
    axiom: Axiom, signature: Signature, *, exceptions: bool = False, firings: bool = False
) -> Iterator[str]:
    """Yield the rules of one axiom; the options are those of :func:`program_text`."""
    head = f"holds({axiom.head})"
    conditions = [part for part in (body_text(axiom, signature),) if part]
    conditions += head_guards(axiom, signature)
    is_default = axiom.kind is AxiomKind.DEFAULT
    instance = f"{axiom.identifier}, {variable_tuple(axiom)}"
    if exceptions and is_default:
        body = f" :- {'; '.join(conditions)}" if conditions else ""
        yield f"{{ exception({instance}) }}{body}."
        yield f"holds({axiom.head.complement}) :- exception({instance})."
    if is_default:
        conditions.append(f"not holds({axiom.head.complement})")
    tail = f" :- {'; '.join(conditions)}" if conditions else ""
    if firings:
        yield f"fires({instance}){tail}."
        yield f"{head} :- fires({instance})."
    else:
        yield f"{head}{tail}."
