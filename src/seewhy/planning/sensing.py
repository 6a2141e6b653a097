"""What a robot senses: of some fluents, where a condition holds, whether they do."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import clingo

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import Condition, Literal, substitute, variables_in
from seewhy.knowledge.dynamics import at_step, fixed_rules, rule
from seewhy.knowledge.language import Knowledge, read_axioms
from seewhy.planning.world import World

_PLACE = re.compile(r"^sensing:\d+:\d+: ")


@dataclass(frozen=True)
class Sensing:
    """The literal whose fluent is sensed where the conditions hold, and how often wrongly."""

    literal: Literal
    conditions: tuple[Condition, ...]
    error: float = 0.0


def read_sensing(literal: str, where: str, knowledge: Knowledge, *, error: float = 0.0) -> Sensing:
    """Read what is sensed, and where; see :class:`Sensing`.

    Raises
    ------
    KnowledgeError
        If either speaks of something that there is not, or the literal is about no fluent.
    """
    try:
        (axiom,) = read_axioms(f"{literal} if {where}.", knowledge.signature, file="sensing")
    except KnowledgeError as problem:
        raise KnowledgeError(_PLACE.sub("", str(problem))) from None
    if not knowledge.signature.kind(axiom.head.predicate).is_fluent or not axiom.head.positive:
        raise KnowledgeError(
            f"'{literal}' is no fluent; what is sensed is whether a fluent such as loc(P, L) holds"
        )
    return Sensing(literal=axiom.head, conditions=axiom.body, error=error)


def condition_to_sense(sensing: Sensing, literal: clingo.Symbol) -> str | None:
    """Return where a literal can be sensed by this rule, as a goal; None where it cannot.

    Examples
    --------
    >>> from seewhy.planning_domain import load_planning_domain
    >>> office = load_planning_domain("robot_assistant")
    >>> condition_to_sense(office.sensing[0], clingo.parse_term("loc(sally,kitchen)"))
    'loc(rob1, kitchen)'
    """
    if sensing.literal.predicate != literal.name:
        return None
    binding: dict[str, str] = {}
    for argument, value in zip(sensing.literal.arguments, literal.arguments, strict=True):
        if binding.setdefault(argument, str(value)) != str(value):
            return None
        if not variables_in(argument) and argument != str(value):
            return None
    return ", ".join(substitute(own.text, binding) for own in sensing.conditions)


class Sensors:
    """The fluents that are sensed in a state, with the probability that each is misread.

    Examples
    --------
    >>> from seewhy.planning_domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> sensors = Sensors(domain.knowledge, domain.sensing)
    >>> in_library = frozenset({clingo.parse_term("loc(rob1,library)")})
    >>> sorted(str(own) for own, error in sensors.sensed(in_library) if own.name == "closed")
    ['closed(bobs_office)', 'closed(johns_office)', 'closed(kitchen)']
    """

    def __init__(self, knowledge: Knowledge, sensing: Sequence[Sensing]) -> None:
        self.knowledge = knowledge
        self.sensing = sensing
        lines = list(fixed_rules(knowledge))
        for number, own in enumerate(sensing):
            body = [
                part
                for place, condition in enumerate(own.conditions)
                for part in at_step(condition, knowledge.signature, "0", number=place)
            ]
            sorts = knowledge.signature.predicates[own.literal.predicate].sorts
            body += [
                f"sort({sort}, {argument})"
                for argument, sort in zip(own.literal.arguments, sorts, strict=True)
            ]
            lines.append(rule(f"sensed({number}, {own.literal})", body))
        self._program = "\n".join([*lines, "at(0, 0).", "#show sensed/2."])
        self._remembered: dict[World, list[tuple[clingo.Symbol, float]]] = {}

    def sensed(self, state: World) -> list[tuple[clingo.Symbol, float]]:
        """Return the fluents sensed in a state, each with its probability of error."""
        known = self._remembered.get(state)
        if known is None:
            known = self._remembered[state] = sorted(self._sensed(state))
        return known

    def _sensed(self, state: World) -> Iterator[tuple[clingo.Symbol, float]]:
        control = clingo.Control(["--warn=none"], logger=lambda *_: None)
        facts = " ".join(f"holds({own}, 0)." for own in sorted(state))
        control.add("base", [], f"{self._program}\n{facts}")
        control.ground([("base", [])])
        errors: dict[clingo.Symbol, float] = {}
        for atom in control.symbolic_atoms.by_signature("sensed", 2):
            number, fluent = atom.symbol.arguments
            errors[fluent] = max(errors.get(fluent, 0.0), self.sensing[number.number].error)
        yield from errors.items()
