"""What a robot senses: of some fluents, where a condition holds, whether they do."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import clingo

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import Condition, Literal, substitute, variables_in
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import at_step, fixed_rules, rule
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge, read_axioms, read_literal
from seewhy.planning.execution.transition_function import World
from seewhy.planning.goal import example_fluent

_PLACE = re.compile(r"^sensing:\d+:\d+: ")


@dataclass(frozen=True)
class Sensing:
    """The literal whose fluent is sensed where the conditions hold, and how often wrongly."""

    literal: Literal
    conditions: tuple[Condition, ...]
    error: float = 0.0


class SensingError(KnowledgeError):
    """What is sensed, or where, cannot be read; ``part`` says which of the two."""

    def __init__(self, text: str, *, part: str) -> None:
        super().__init__(text)
        self.part = part


def read_sensing(literal: str, where: str, knowledge: Knowledge, *, error: float = 0.0) -> Sensing:
    """Read what is sensed, and where; see :class:`Sensing`.

    Raises
    ------
    SensingError
        If either speaks of something that there is not, or the literal is about no fluent.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort place = {hall}. #fluent basic dark(place). "
    ...     "#fluent basic at(place).")
    >>> sensing = read_sensing("dark(L)", "at(L)", known, error=0.1)
    >>> str(sensing.literal), [str(part) for part in sensing.conditions], sensing.error
    ('dark(L)', ['at(L)'], 0.1)
    """
    signature, example = knowledge.signature, example_fluent(knowledge)
    try:
        sensed = read_literal(literal)
    except KnowledgeError:
        sensed = None
    if sensed is None or (
        sensed.predicate in signature.predicates
        and not (signature.kind(sensed.predicate).is_fluent and sensed.positive)
    ):
        raise SensingError(
            f"'{literal}' is no fluent; what is sensed is whether a fluent such as {example} holds",
            part="literal",
        )
    if not where.strip():
        raise SensingError(
            f"nothing is said; write where the robot senses this, such as {example}", part="where"
        )
    try:
        axioms = read_axioms(f"{literal} if {where}.", signature, file="sensing")
    except KnowledgeError as problem:
        part, said = "where", str(problem)
        try:  # the literal by itself: what is not wrong with it is wrong with the conditions
            read_axioms(f"{literal}.", signature, file="sensing")
        except KnowledgeError as of_literal:
            part, said = "literal", str(of_literal)
        raise SensingError(_PLACE.sub("", said), part=part) from None
    if len(axioms) != 1:
        raise SensingError(
            f"found {len(axioms)} statements in '{where}'; write conditions with commas between "
            "them and no full stop",
            part="where",
        )
    return Sensing(literal=axioms[0].head, conditions=axioms[0].body, error=error)


def condition_to_sense(sensing: Sensing, literal: clingo.Symbol) -> str | None:
    """Return where a literal can be sensed by this rule, as a goal; None where it cannot.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
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
    return ", ".join(substitute(condition.text, binding) for condition in sensing.conditions)


class Sensors:
    """The fluents that are sensed in a state, with the probability that each is misread.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> sensors = Sensors(domain.knowledge, domain.sensing)
    >>> in_library = frozenset({clingo.parse_term("loc(rob1,library)")})
    >>> sensed = [fluent for fluent, error in sensors.sensed(in_library)]
    >>> sorted(str(fluent) for fluent in sensed if fluent.name == "closed")
    ['closed(bobs_office)', 'closed(johns_office)', 'closed(kitchen)']
    """

    def __init__(self, knowledge: Knowledge, sensing: Sequence[Sensing]) -> None:
        self.knowledge = knowledge
        self.sensing = sensing
        lines = list(fixed_rules(knowledge))
        for number, entry in enumerate(sensing):
            body = [
                part
                for place, condition in enumerate(entry.conditions)
                for part in at_step(condition, knowledge.signature, "0", number=place)
            ]
            sorts = knowledge.signature.predicates[entry.literal.predicate].sorts
            body += [
                f"sort({sort}, {argument})"
                for argument, sort in zip(entry.literal.arguments, sorts, strict=True)
            ]
            lines.append(rule(f"sensed({number}, {entry.literal})", body))
        self._program = "\n".join([*lines, "at(0, 0).", "#show sensed/2."])
        self._size = grounding_size(knowledge)
        self._remembered: dict[World, list[tuple[clingo.Symbol, float]]] = {}

    def sensed(self, state: World) -> list[tuple[clingo.Symbol, float]]:
        """Return the fluents sensed in a state, each with its probability of error."""
        known = self._remembered.get(state)
        if known is None:
            known = self._remembered[state] = sorted(self._sensed(state))
        return known

    def _sensed(self, state: World) -> Iterator[tuple[clingo.Symbol, float]]:
        facts = " ".join(f"holds({literal}, 0)." for literal in sorted(state))
        control = BoundedControl(f"{self._program}\n{facts}", size=self._size)
        errors: dict[clingo.Symbol, float] = {}
        for atom in control.by_signature("sensed", 2):
            number, fluent = atom.symbol.arguments
            errors[fluent] = max(errors.get(fluent, 0.0), self.sensing[number.number].error)
        yield from errors.items()
