"""A rule about things that is missing, from the reason that somebody gives."""

from __future__ import annotations

from seewhy.errors import RevisionError
from seewhy.induction.things.conditions import ThingRule
from seewhy.induction.things.rule_sentence import say_thing_rule
from seewhy.induction.things.rule_text import thing_rule_statement
from seewhy.knowledge.axiom import Axiom, Literal, substitute
from seewhy.knowledge.language import read_axioms
from seewhy.revision.edit import KNOWLEDGE
from seewhy.revision.knowledge_text import axiom_added
from seewhy.revision.proposal import Cause, Doubted, Proposal
from seewhy.revision.things.narrowed_rules import edit_of, giving_way

__all__ = ["new_thing_rule"]


def new_thing_rule(doubted: Doubted, rule: ThingRule) -> Proposal:
    """Propose a rule with what it would change.

    Where rules conclude another class of the scene, and it is better for the annotated scenes, they
    give way: each gets the exception that the scene is of the new rule's class.

    Raises
    ------
    RevisionError
        If the rule is known already, or can never be used because it contradicts what is known.
    """
    domain = doubted.known.domain
    assert domain.things is not None, "the domain has no things"
    signature = domain.knowledge.signature
    statement = thing_rule_statement(rule, domain.things, domain.schema, signature)
    said = say_thing_rule(domain, rule)
    (axiom,) = read_axioms(statement, signature)
    known = next((each for each in domain.knowledge.axioms if _form(each) == _form(axiom)), None)
    if known is not None:
        raise RevisionError(f'the rule is known already: "{known.text}"; say another reason')
    edit = axiom_added(doubted.texts[KNOWLEDGE], statement, said)
    found = [doubted.judged(Cause.MISSING, said, (edit,), statement=statement, label=rule.label)]
    given_way = giving_way(doubted, rule.label)
    if given_way:
        edits = (edit, *(each for asked in given_way for each in edit_of(asked, doubted)))
        found.append(
            doubted.judged(
                Cause.MISSING,
                said,
                edits,
                statement=statement,
                label=rule.label,
                exceptions=tuple(asked.sentence for asked in given_way),
            )
        )
    possible = [proposal for proposal in found if proposal is not None]
    if not possible:
        raise RevisionError(
            f"the rule '{said}' can never be used: whenever it applies, what is known already "
            "says otherwise; say first which rule is wrong"
        )
    return min(possible, key=lambda proposal: _cost(proposal, rule.label))


def _cost(proposal: Proposal, label: str) -> tuple[int, int, int]:
    """What speaks against a way to add a rule."""
    found = proposal.consequences
    lost = 0 if found is None else found.lost + len(found.contradictions)
    gained = 0 if found is None else found.gained
    return lost, int(proposal.decision.label != label), -gained


def _form(axiom: Axiom) -> tuple[Literal, frozenset[str]]:
    """An axiom whose variables are called by their order, to find the same one again."""
    names = {variable: f"V{place}" for place, variable in enumerate(axiom.variables)}
    body = frozenset(substitute(condition.text, names) for condition in axiom.body)
    return axiom.head.substitute(names), body
