"""What the words of a static mean in questions: its name, its clause, the sentences of axioms."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from seewhy.dialogue.grammar import Binding
from seewhy.dialogue.inflection import lemma
from seewhy.dialogue.question_words import words_of
from seewhy.domain.belief import Belief
from seewhy.domain.domain import Domain
from seewhy.knowledge.axiom import Literal

__all__ = ["Add", "add_statics", "static_clauses"]

Add = Callable[[str, tuple[str, ...], Binding], None]
"""Let a row of normalised words of a category of the grammar mean something."""

_AFTER_THE_CLAUSE = re.compile(r"[,;:]| (?:if|when|unless|since|because|where|while|so)\b.*")
_DENIED = re.compile(r"^(is|are|has|have|can|may|must|should) not |^(can)not ")
_LONGEST = 6
"""Words of a sentence about a static that a question may repeat."""


def add_statics(domain: Domain, normalise: Callable[[str], tuple[str, ...]], add: Add) -> None:
    """Add the words by which statics may be asked for that are no classes."""
    of_classes = {scene_class.literal.predicate for scene_class in domain.classes.values()}
    for key, belief in domain.beliefs.items():
        if key in of_classes:
            continue
        for value, clause in static_clauses(domain, belief):
            _add_clause(clause, Binding("fact", (key, value)), normalise, add)
        if not belief.is_yes_or_no:
            _add_open(domain, belief, normalise, add)


def static_clauses(domain: Domain, belief: Belief) -> Iterator[tuple[str, str]]:
    """Yield a static's values with what follows "it" where they are said, undenied where it can be.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("traffic_signs")
    >>> next(static_clauses(domain, domain.beliefs["message"]))[1].split(":")[0]
    'tells the driver'
    """
    for value, words in belief.words.items():
        if belief.say.startswith("{it} "):
            said = belief.say.replace("{value}", words).removeprefix("{it} ")
            yield _undenied(belief, value, said)
    for axiom in domain.knowledge.axioms:
        if axiom.head.predicate != belief.key or not axiom.has_sentence:
            continue
        said = _said_of(domain, axiom.text)
        if said and len(said.split()) <= _LONGEST:
            for value in _concluded(belief, axiom.head):
                yield _undenied(belief, value, said)


def _concluded(belief: Belief, head: Literal) -> list[str]:
    """The value of a static that an axiom's head stands for; none where it has a variable."""
    return [
        value
        for value, literal in belief.literals.items()
        if literal.positive == head.positive and literal.arguments[1:] == head.arguments[1:]
    ]


def _said_of(domain: Domain, text: str) -> str:
    """What a sentence says of the picture's subject: "can be eaten" of "a good apple can be …"."""
    noun = words_of(domain.subject)[-1]
    words = _AFTER_THE_CLAUSE.sub("", text).split()
    places = [place for place, word in enumerate(words) if lemma(word) == lemma(noun)]
    return " ".join(words[places[0] + 1 :]) if places else ""


def _undenied(belief: Belief, value: str, said: str) -> tuple[str, str]:
    """A clause without its "not", which questions have by themselves, with the value it means."""
    if not belief.is_yes_or_no or not _DENIED.match(said):
        return value, said
    other = "no" if value == "yes" else "yes"
    return other, _DENIED.sub(lambda found: f"{found.group(1) or found.group(2)} ", said)


def _add_clause(
    clause: str, meaning: Binding, normalise: Callable[[str], tuple[str, ...]], add: Add
) -> None:
    verb, _, rest = clause.partition(" ")
    words = normalise(rest)
    match verb:
        case _ if "not" in words:
            return
        case "is" | "are":
            add("adjective", words, meaning)
        case "has" | "have":
            add("possession", words, meaning)
        case "can" | "may" | "could" | "might":
            add("able", words, meaning)
        case "must" | "should":
            add("obliged", words, meaning)
        case _:
            add("verb", (lemma(verb), *words), meaning)


def _add_open(
    domain: Domain, belief: Belief, normalise: Callable[[str], tuple[str, ...]], add: Add
) -> None:
    """What asks for the value: "need" of "it needs {value}", "made of" of "it is made of"."""
    found = re.fullmatch(r"\{it\} (\w+)( [^{}]*)? \{value\}", belief.say)
    if found is None:
        return
    verb, more = found.group(1), normalise(found.group(2) or "")
    meaning = Binding("belief", belief.key)
    if verb in ("is", "are"):
        add("static_relation", more, meaning)
    else:
        asked = "have" if verb == "has" else lemma(verb)
        add("static_verb", (asked, *more), meaning)
    sort = domain.knowledge.signature.predicates[belief.key].sorts[1]
    add("static_sort", normalise(sort.replace("_", " ")), meaning)
