"""Write a candidate in the knowledge language."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

from seewhy.induction.candidate import Candidate
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.scene import SceneSchema

__all__ = ["SCENE", "axiom_statement", "condition_text", "conjunctions"]

SCENE = "S"


def conjunctions(candidate: Candidate, schema: SceneSchema) -> tuple[Candidate, ...]:
    """Divide a candidate into candidates that are one axiom each: a body is a conjunction.

    Numbers can be compared, and where fewer values are excluded than allowed those can be denied;
    other alternatives are divided.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.induction.tree import PathCondition
    >>> schema = load_domain("traffic_signs").schema
    >>> either = Candidate("stop", (PathCondition("shape", ("circle", "octagon")),))
    >>> [part.conditions[0].values for part in conjunctions(either, schema)]
    [('circle',), ('octagon',)]
    """
    alternatives = [
        [condition]
        if len(condition.values) == 1 or _is_one(condition, schema)
        else [PathCondition(condition.feature, (value,)) for value in condition.values]
        for condition in candidate.conditions
    ]
    return tuple(Candidate(candidate.label, chosen) for chosen in product(*alternatives))


def axiom_statement(candidate: Candidate, schema: SceneSchema) -> str:
    """Return the axiom that says what one of :func:`conjunctions` says.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.induction.tree import PathCondition
    >>> schema = load_domain("structure_stability").schema
    >>> axiom_statement(Candidate("unstable", (PathCondition("num_blocks", ("4", "5")),
    ...                                        PathCondition("lean", ("yes",)))), schema)
    '-stable(S) if num_blocks(S, N), N > 3, lean(S).'
    """
    head = schema.of_any_scene(schema.classes[candidate.label])
    parts: list[str] = []
    variables = (f"N{n}" if n else "N" for n in range(len(candidate.conditions)))
    for condition in candidate.conditions:
        number = next(variables) if _is_compared(condition, schema) else "N"
        parts.append(condition_text(condition, schema, number=number))
    return f"{head} if {', '.join(parts or [f'{schema.scene}({SCENE})'])}."


def condition_text(condition: PathCondition, schema: SceneSchema, *, number: str = "N") -> str:
    """Return what a condition asks of the scene ``S``, as it stands in an axiom's body.

    ``number`` is the variable of a number that is compared.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.induction.tree import PathCondition
    >>> schema = load_domain("structure_stability").schema
    >>> condition_text(PathCondition("num_blocks", ("1", "2")), schema)
    'num_blocks(S, N), N < 3'
    """
    literals = schema.features[condition.feature]
    if len(condition.values) == 1:
        return str(schema.of_any_scene(literals[condition.values[0]]))
    if _is_compared(condition, schema):
        return _compared(condition.values, literals, number, schema)
    excluded = (literal for value, literal in literals.items() if value not in condition.values)
    return ", ".join(str(schema.of_any_scene(literal.complement)) for literal in excluded)


def _is_compared(condition: PathCondition, schema: SceneSchema) -> bool:
    return len(condition.values) > 1 and _are_numbers(schema.features[condition.feature])


def _is_one(condition: PathCondition, schema: SceneSchema) -> bool:
    """Whether one conjunction says that the value is among several."""
    literals = schema.features[condition.feature]
    return _are_numbers(literals) or len(literals) < 2 * len(condition.values)


def _are_numbers(values: Mapping[str, Literal]) -> bool:
    return all(value.lstrip("-").isdecimal() for value in values)


def _compared(
    values: Sequence[str], literals: Mapping[str, Literal], variable: str, schema: SceneSchema
) -> str:
    """The feature's literal with a variable, and what bounds it on either side or is left out."""
    everything = sorted(map(int, literals))
    allowed = sorted(map(int, values))
    some = literals[values[0]]
    asked = Literal(some.predicate, (*schema.of_any_scene(some).arguments[:-1], variable))
    parts = [str(asked)]
    below = [number for number in everything if number < allowed[0]]
    above = [number for number in everything if number > allowed[-1]]
    parts += [f"{variable} > {below[-1]}"] if below else []
    parts += [f"{variable} < {above[0]}"] if above else []
    between = [number for number in everything if allowed[0] < number < allowed[-1]]
    parts += [f"{variable} != {number}" for number in between if number not in allowed]
    return ", ".join(parts)
