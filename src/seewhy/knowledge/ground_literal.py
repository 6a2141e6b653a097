"""Read one literal without variables, as goals, histories and questions give it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal as OneOf

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import key_of, literal_of
from seewhy.knowledge.language import read_literal
from seewhy.knowledge.signature import Location, Predicate, PredicateKind, Signature
from seewhy.knowledge.statements import NumberError, one_line
from seewhy.text.nearest import did_you_mean

Kind = OneOf["fluent", "action", "static"]


def read_ground_literal(
    text: str, signature: Signature, *, of: Kind, place: Location | None = None
) -> Literal:
    """Read a literal about a fluent or a static, or an action, with all its arguments.

    ``place`` is where it stands, if it stands in a file.

    Raises
    ------
    KnowledgeError
        If it is no such literal, or names something that there is not; the nearest is offered.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort place = {library, kitchen}. #fluent basic robot_in(place).")
    >>> str(read_ground_literal("-robot_in(kitchen)", known.signature, of="fluent"))
    '-robot_in(kitchen)'
    """
    start = f"{place}: " if place else ""
    try:
        literal = read_literal(text.strip())
    except NumberError as problem:
        raise NumberError(f"{start}{problem}") from None
    except KnowledgeError:
        raise KnowledgeError(
            f"{start}'{one_line(text)}' is no {of}; write one such as {_example(signature, of)}"
        ) from None
    known = {candidate.name: candidate for candidate in _of_kind(signature, of)}
    predicate = known.get(literal.predicate)
    if predicate is None:
        declared = signature.predicates.get(literal.predicate)
        what = f"is a {declared.kind.value} and no {of}" if declared else f"is no {of}"
        raise KnowledgeError(
            f"{start}'{literal.predicate}' {what}; {did_you_mean(literal.predicate, known)}"
        )
    if of == "action" and not literal.positive:
        raise KnowledgeError(f"{start}an action happens or does not; remove '-' from '{literal}'")
    if len(predicate.sorts) != len(literal.arguments):
        raise KnowledgeError(
            f"{start}'{predicate.name}' takes {len(predicate.sorts)} "
            f"argument{'s' * (len(predicate.sorts) != 1)} ({', '.join(predicate.sorts)}), "
            f"got '{literal}'"
        )
    try:
        ground = literal_of(key_of(literal))
    except RuntimeError:
        raise KnowledgeError(
            f"{start}'{literal}' has an argument that is no name and no number; give each argument "
            "of it one value"
        ) from None
    for argument, sort in zip(ground.arguments, predicate.sorts, strict=True):
        members = signature.members(sort)
        if argument not in members:
            raise KnowledgeError(
                f"{start}'{argument}' is not of sort '{sort}', which '{predicate.name}' takes; "
                f"{did_you_mean(argument, members)}"
            )
    return ground


def _of_kind(signature: Signature, of: Kind) -> Iterable[Predicate]:
    kinds = {
        "fluent": (PredicateKind.FLUENT_BASIC, PredicateKind.FLUENT_DEFINED),
        "action": (PredicateKind.ACTION, PredicateKind.EXOGENOUS_ACTION),
        "static": (PredicateKind.STATIC,),
    }[of]
    return (found for found in signature.predicates.values() if found.kind in kinds)


def _example(signature: Signature, of: Kind) -> str:
    for predicate in _of_kind(signature, of):
        arguments = [next(iter(signature.members(sort)), sort) for sort in predicate.sorts]
        return str(Literal(predicate.name, tuple(arguments)))
    return "name(argument)"
