"""A question that no template words, in words that are understood again."""

from __future__ import annotations

from dataclasses import replace

from seewhy.dialogue.antecedent import say_denied
from seewhy.dialogue.asked import Asks, Question, Statement
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words, say_literal

__all__ = ["PLAIN_WORDINGS", "say_question"]

PLAIN_WORDINGS = {
    Asks.EXPLAIN: "why",
    Asks.CLASS: "what is it",
    Asks.WHICH_RULE: "which rule did you use",
    Asks.WHAT_TO_CHECK: "what should I check",
    Asks.SIMILAR: "are there similar pictures",
    Asks.HOW_SURE: "how sure are you",
    Asks.DESCRIBE: "what do you see",
    Asks.MORE: "what else",
}
"""How questions are worded that name nothing."""


def say_question(domain: Domain, question: Question) -> str:
    """Return the wording of a question of the grammar, without a question mark.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> wide = Statement(feature="base", value="wide")
    >>> say_question(domain, Question(Asks.WHAT_IF, "", (), statements=(wide,)))
    'what if the structure has a wide base'
    """
    clauses = [_clause(domain, statement) for statement in question.statements]
    about = Statement(question.label, question.feature, question.value)
    match question.asks:
        case Asks.WHAT_IF:
            return f"what if {join_words(clauses)}"
        case Asks.ALL | Asks.EITHER:
            return "is it true that " + (" and " if question.asks is Asks.ALL else " or ").join(
                clauses
            )
        case Asks.CONTRAST:
            return f"why is it so that {clauses[0]} rather than {_bare(domain, question)}"
        case Asks.IS_CLASS | Asks.FEATURE_IS:
            return f"is it true that {_clause(domain, about)}"
        case Asks.WHY_CLASS | Asks.WHY_VALUE:
            return f"why do you say that {_clause(domain, about)}"
        case Asks.WHY_NOT_CLASS:
            return f"why is {domain.subject} not {domain.classes[question.label or ''].say}"
        case Asks.WHY_NOT_VALUE:
            return f"why do you not say that {_clause(domain, about)}"
        case Asks.CHANGE_TO_CLASS:
            return f"what would make {domain.subject} {domain.classes[question.label or ''].say}"
        case Asks.WHEN_CLASS:
            return f"when is {domain.subject} {domain.classes[question.label or ''].say}"
        case Asks.POSSIBLE:
            return f"what can the {domain.features[question.feature or ''].name} be"
        case Asks.MATTERS:
            return f"does the {domain.features[question.feature or ''].name} matter"
        case Asks.BECAUSE:
            label, feature = question.label, domain.features[question.feature or ""]
            is_it = f"{domain.subject} {domain.classes[label].say}" if label else "it"
            cause = (
                f"of the {feature.name}"
                if question.value is None
                else _clause(domain, replace(about, label=None))
            )
            return f"is {is_it} because {cause}"
        case Asks.DIFFERENCE_TO_CLASS:
            other = domain.classes[question.label or ""].say
            return f"how does {domain.subject} differ from one that is {other}"
        case Asks.FEATURE_VALUE:
            return f"what is the {domain.features[question.feature or ''].name}"
        case Asks.BELIEF_VALUE:
            return f"what is the {domain.beliefs[question.predicate or ''].name}"
        case Asks.BELIEF_IS:
            return f"is it true that {_static(domain, question)}"
        case Asks.WHY_BELIEF:
            return f"why do you say that {_static(domain, question)}"
        case Asks.WHY_NOT_BELIEF:
            return f"why do you not say that {_static(domain, question)}"
        case Asks.HOW_SURE if question.label or question.feature:
            if question.feature:
                return f"how sure are you about the {domain.features[question.feature].name}"
            return f"how sure are you that {_clause(domain, about)}"
        case Asks.WHERE:
            if question.label or question.value:
                return f"where do you see that {_clause(domain, about)}"
            return f"where is the {domain.features[question.feature or ''].name}"
        case Asks.HOW_MANY | Asks.WHICH:
            names = join_words([domain.features[key].name for key in question.group])
            value = question.value or ""
            states = domain.features[question.group[0]].words[value]
            asked = "how many" if question.asks is Asks.HOW_MANY else "which"
            return f"{asked} of {names} are {states[0]}"
        case Asks.DESCRIBE if question.group:
            names = join_words([domain.features[key].name for key in question.group], word="or")
            return f"who is there, {names}"
    return PLAIN_WORDINGS[question.asks]


def _static(domain: Domain, question: Question) -> str:
    belief = domain.beliefs[question.predicate or ""]
    return say_literal(domain, belief.literals[question.value or ""])


def _clause(domain: Domain, statement: Statement) -> str:
    if statement.label is not None:
        return f"{domain.subject} is {domain.classes[statement.label].say}"
    feature = domain.features[statement.feature or ""]
    if statement.denied:
        return say_denied(domain, feature.key, statement.value or "")
    return feature.say[statement.value or ""].replace("{it}", domain.subject)


def _bare(domain: Domain, question: Question) -> str:
    other = question.statements[-1]
    if other.label is not None:
        return domain.classes[other.label].say
    return domain.features[other.feature or ""].words[other.value or ""][0]
