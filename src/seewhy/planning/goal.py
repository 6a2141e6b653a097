"""A goal: a condition on fluents, as a person writes it."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from seewhy.errors import KnowledgeError, PlanningError
from seewhy.knowledge.axiom import STRING, Axiom, variables_in
from seewhy.knowledge.language import Knowledge, read_axioms
from seewhy.knowledge.signature import Location, Predicate, PredicateKind
from seewhy.knowledge.statements import statements

REACHED = "goal__"
"""The defined fluent that holds where the goal does."""
_READS = "an axiom reads 'head if condition, condition.'"
_PLACE = re.compile(r"goal:\d+:\d+: ")


@dataclass(frozen=True)
class Goal:
    """What shall hold: conditions as in an axiom's body, all of them.

    Variables stand for some one thing each: ``loc(P, kitchen), person(P)`` is reached when
    somebody is in the kitchen. ``axiom`` concludes :data:`REACHED` from the conditions.
    """

    text: str
    axiom: Axiom

    def __str__(self) -> str:
        return self.text

    @property
    def variables(self) -> tuple[str, ...]:
        """The variables of its conditions, in their order."""
        return variables_in(self.text)


def read_goal(text: str, knowledge: Knowledge) -> Goal:
    """Read a goal such as ``message_status(m1, sarah, delivered), not closed(kitchen)``.

    Raises
    ------
    PlanningError
        If it is no condition, speaks of actions, or names something that there is not; the
        nearest name is offered.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort place = {library, kitchen}. #fluent basic robot_in(place).")
    >>> str(read_goal("robot_in(kitchen)", known))
    'robot_in(kitchen)'
    """
    conditions = " ".join(text.split()).rstrip(".").strip()
    if not conditions:
        raise PlanningError(
            f'the goal is empty; say what shall hold, such as "{example_fluent(knowledge)}"'
        )
    try:
        _refuse_several(conditions)
        (axiom,) = read_axioms(
            f"{REACHED} if {conditions}.", with_goal(knowledge).signature, file="goal", letter="g"
        )
    except KnowledgeError as problem:
        said = _PLACE.sub("", str(problem)).replace(f"{REACHED} if ", "")
        said = said.replace(_READS, "conditions are separated by commas")
        raise PlanningError(f"the goal '{conditions}' cannot be used: {said}") from None
    return Goal(text=conditions, axiom=axiom)


def _refuse_several(conditions: str) -> None:
    """Refuse what is not the conditions of one axiom, before it is read as such."""
    plain = STRING.sub("", conditions)
    if "%" in plain:
        raise KnowledgeError("found '%', which begins a comment; remove it")
    if re.search(r"(?<![\w'])(if|causes)(?![\w'])", plain):
        raise KnowledgeError("found an axiom; give its conditions alone, separated by commas")
    found = [*statements(f"{conditions}.", file="goal")]
    if len(found) != 1:
        raise KnowledgeError(
            f"found {len(found)} statements; separate conditions by commas, not by full stops"
        )


def with_goal(knowledge: Knowledge, goal: Goal | None = None) -> Knowledge:
    """Return the knowledge with the fluent that says that the goal is reached."""
    signature = knowledge.signature
    reached = Predicate(
        REACHED, (), PredicateKind.FLUENT_DEFINED, Location(file="goal", line=1, column=1)
    )
    return replace(
        knowledge,
        signature=replace(signature, predicates={**signature.predicates, REACHED: reached}),
        axioms=(*knowledge.axioms, *([goal.axiom] if goal else [])),
    )


def example_fluent(knowledge: Knowledge) -> str:
    """Return a fluent with arguments, to be shown in an error.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> example_fluent(read_knowledge("#sort place = {hall}. #fluent basic closed(place)."))
    'closed(hall)'
    >>> example_fluent(
    ...     read_knowledge("#sort block = {red, blue}. #fluent basic on(block, block).")
    ... )
    'on(red, blue)'
    """
    signature = knowledge.signature
    for predicate in signature.predicates.values():
        if predicate.kind.is_fluent:
            arguments: list[str] = []
            for sort in predicate.sorts:
                members = signature.members(sort) or (sort,)
                other = (member for member in members if member not in arguments)
                arguments.append(next(other, members[0]))
            return f"{predicate.name}({', '.join(arguments)})" if arguments else predicate.name
    return "fluent(argument)"
