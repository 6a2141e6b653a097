"""Leave out of the knowledge what cannot matter to a goal."""

from __future__ import annotations

from dataclasses import replace

from seewhy.knowledge.axiom import Axiom, AxiomKind, predicates_in
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.goal import REACHED


def relevant(knowledge: Knowledge, *, consequences: bool = False) -> Knowledge:
    """Return the part of the knowledge that decides which plans reach its goal.

    Actions stay that may help, with all that they change, and every constraint that what they
    change could violate. With ``consequences``, defined fluents stay too that no condition asks
    about but that those actions may change.

    Parameters
    ----------
    knowledge : Knowledge
        With a goal, as :func:`seewhy.planning.goal.with_goal` returns it.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> from seewhy.planning.goal import read_goal, with_goal
    >>> known = read_knowledge('''
    ... #fluent basic lit. #fluent basic loud. #fluent defined calm. #action press. #action shout.
    ... press causes lit. shout causes loud. calm if -loud.
    ... ''')
    >>> part = relevant(with_goal(known, read_goal("lit", known)))
    >>> [name for name in part.signature.predicates if part.signature.changes(name)]
    ['lit', 'press', 'goal__']
    """
    signature = knowledge.signature
    change = [axiom for axiom in knowledge.axioms if signature.changes(axiom.head.predicate)]
    asked, touched, done = {REACHED}, set[str](), set[str]()
    size = -1
    while size != len(asked) + len(touched) + len(done):
        size = len(asked) + len(touched) + len(done)
        for axiom in change:
            body = fluents_in(axiom, knowledge)
            head = axiom.head.predicate
            action = axiom.action.predicate if axiom.action else ""
            if axiom.kind is AxiomKind.STATE_CONSTRAINT:
                if body & touched:
                    touched.add(head)
                basic = signature.kind(head) is PredicateKind.FLUENT_BASIC
                if head in asked or (head in touched and (basic or consequences)):
                    asked |= {head, *body}
            elif axiom.kind is AxiomKind.CAUSAL_LAW:
                if head in asked and signature.kind(action) is PredicateKind.ACTION:
                    done.add(action)
                if action in done:
                    touched.add(head)
                    asked |= {head, *body}
            elif axiom.kind is AxiomKind.EXECUTABILITY_CONDITION and action in done:
                asked |= body
    names = asked | done
    return replace(
        knowledge,
        signature=replace(
            signature,
            predicates={
                name: predicate
                for name, predicate in signature.predicates.items()
                if name in names or not signature.changes(name)
            },
        ),
        axioms=tuple(
            axiom
            for axiom in knowledge.axioms
            if not signature.changes(axiom.head.predicate)
            or (
                axiom.head.predicate in names
                and (axiom.action is None or axiom.action.predicate in done)
            )
        ),
    )


def fluents_in(axiom: Axiom, knowledge: Knowledge) -> set[str]:
    """Return the fluents that an axiom's conditions speak of."""
    names: set[str] = set()
    for condition in axiom.body:
        names |= (
            {condition.literal.predicate} if condition.literal else predicates_in(condition.text)
        )
    return {name for name in names if knowledge.signature.kind(name).is_fluent}
