"""Ground literals and terms as clingo prints them."""

from __future__ import annotations

from functools import lru_cache

import clingo

from seewhy.knowledge.axiom import Literal


@lru_cache(maxsize=4096)
def term_of(text: str) -> str:
    """A term as clingo prints it; as written where it is not one term, as ``1..3`` and ``_``."""
    try:
        return str(clingo.parse_term(text, logger=lambda *_: None))
    except RuntimeError:
        return text


def key_of(literal: Literal) -> str:
    """The literal as clingo prints it, its arithmetic evaluated."""
    arguments = ",".join(term_of(argument) for argument in literal.arguments)
    sign = "" if literal.positive else "-"
    return f"{sign}{literal.predicate}({arguments})" if arguments else f"{sign}{literal.predicate}"


@lru_cache(maxsize=4096)
def literal_of(key: str) -> Literal:
    """The literal that :func:`key_of` names."""
    symbol = clingo.parse_term(key)
    return Literal(
        predicate=symbol.name,
        arguments=tuple(str(argument) for argument in symbol.arguments),
        positive=symbol.positive,
    )


@lru_cache(maxsize=65_536)
def text_of(symbol: clingo.Symbol) -> str:
    """A symbol as clingo prints it; of those that come again it is remembered."""
    return str(symbol)


def predicate_of(key: str) -> str:
    """The predicate of a literal as clingo prints it.

    Examples
    --------
    >>> predicate_of("-closed(kitchen)"), predicate_of("raining")
    ('closed', 'raining')
    """
    return key.removeprefix("-").split("(", 1)[0]


@lru_cache(maxsize=65_536)
def complement_of(symbol: clingo.Symbol) -> clingo.Symbol:
    """The same symbol with the opposite classical sign."""
    return clingo.Function(symbol.name, symbol.arguments, not symbol.positive)


def fluent_of(literal: clingo.Symbol) -> clingo.Symbol:
    """The fluent that a literal affirms or denies.

    Examples
    --------
    >>> str(fluent_of(clingo.parse_term("-closed(kitchen)")))
    'closed(kitchen)'
    """
    return literal if literal.positive else complement_of(literal)
