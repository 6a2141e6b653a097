"""The questions that can be asked about runs in a domain, with slots for its things."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from seewhy.dialogue.question_words import words_of
from seewhy.knowledge.signature import Predicate, PredicateKind
from seewhy.planning.dialogue.clause_forms import (
    SLOT,
    asking_for,
    denies,
    gerund,
    question_form,
    with_not,
    without_first_words,
    without_last_thing,
)
from seewhy.planning.dialogue.location_fluents import places
from seewhy.planning.dialogue.query import Asks
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.tables import ActionTable

HOLE = "§"
"""Stands for a thing where questions are compared."""
_DROPPED = {"a", "an", "the", "any", "some", "instead", "now", "then", "please", "currently",
            "really", "just", "actually", "still", "so", "far", "straight", "directly"}  # fmt: skip
_SAME = {"are": "is", "am": "is", "was": "is", "were": "is", "be": "is", "think": "believe",
         "what's": "what", "altered": "change", "changed": "change", "replan": "change",
         "aim": "goal", "intention": "plan"}  # fmt: skip
KNOWN_WORDS = frozenset({*_DROPPED, *_SAME})
"""Words that any question may have."""
_SUPPOSING = ("what would you do if", "what would happen if", "what if")
_BEFORE_INSTRUCTIONS = (
    (Asks.WHY_DID, "why did you"),
    (Asks.WHY_DID, "why will you"),
    (Asks.WHY_DID, "why would you"),
    (Asks.WHY_NOT, "why did you not"),
    (Asks.WHY_NOT, "why do you not"),
    (Asks.WHY_NOT, "why will you not"),
    (Asks.WHY_NOT, "why would you not"),
    (Asks.WHY_NOT, "why can you not"),
    (Asks.WHY_NOT, "why could you not"),
    (Asks.WHY_NOT, "why not"),
    (Asks.DID, "did you"),
)
_UNFILLED = {
    Asks.PLAN: ("what is your plan", "what do you plan to do", "what will you do",
                "what will you do next", "what do you intend to do", "what do you plan",
                "what did you plan", "what did you plan to do", "what is next",
                "what are you doing"),
    Asks.DONE: ("what did you do", "what have you done", "what happened"),
    Asks.HOW_MANY_DONE: ("how many actions did you do", "how many actions have you done",
                         "how many actions did you need", "how many actions did it take",
                         "how many steps did you take", "how many steps have you taken",
                         "how many steps did you do", "how many steps did it take"),
    Asks.EXPECTED: ("what did you expect", "what did you expect and what happened",
                    "what did you expect and what did you see", "what surprised you",
                    "what was unexpected", "what did you not expect",
                    "what went wrong", "what went other than you expected"),
    Asks.GOAL: ("what is your goal", "what do you want to achieve", "what do you want"),
    Asks.WHY_CHANGED: ("why did the plan change", "why did your plan change",
                       "why did you change your plan", "why did you plan anew",
                       "why do you have a new plan", "why did you change your mind"),
    Asks.ENDED: ("did you reach your goal", "is the goal reached", "are you done",
                 "have you reached your goal", "did you succeed"),
    Asks.WHY_ENDED: ("why did you give up", "why do you give up", "why did you stop",
                     "why did you fail"),
}  # fmt: skip


@dataclass(frozen=True)
class Template:
    """A question with slots, and what it asks.

    Attributes
    ----------
    asks : Asks
    raw : str
        The question; ``{0}`` stands for the first argument.
    predicate : str or None
    arity : int
    sorts : tuple of str
        Of the arguments.
    positive : bool
    """

    asks: Asks
    raw: str
    predicate: str | None = None
    arity: int = 0
    sorts: tuple[str, ...] = ()
    positive: bool = True

    @property
    def slots(self) -> tuple[int, ...]:
        """The arguments that the question names, in its order."""
        return tuple(map(int, SLOT.findall(self.raw)))

    @property
    def words(self) -> list[str]:
        """The words that questions are compared by."""
        return plain_words(words_of(SLOT.sub(" SLOT ", self.raw)))


def plain_words(words: Sequence[str]) -> list[str]:
    """Return words without those that change nothing, and words of one meaning as one."""
    return [
        HOLE if word == "slot" else _SAME.get(word, word) for word in words if word not in _DROPPED
    ]


def question_templates(domain: PlanningDomain) -> list[Template]:
    """Return the questions of a domain.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> templates = question_templates(load_planning_domain("robot_assistant"))
    >>> [template.raw for template in templates if template.predicate == "work_place"][1:7:5]
    ['who works in {1}', 'which place does {0} work in']
    """
    return list(dict.fromkeys(_templates(domain)))


def _templates(domain: PlanningDomain) -> Iterator[Template]:
    for asks, texts in _UNFILLED.items():
        for text in texts:
            yield Template(asks, text)
    yield from _about_places(domain)
    for predicate in domain.knowledge.signature.predicates.values():
        table = domain.words.actions.get(predicate.name)
        if predicate.kind.is_fluent or predicate.kind is PredicateKind.STATIC:
            yield from _about_a_relation(domain, predicate)
        elif predicate.kind is PredicateKind.EXOGENOUS_ACTION:
            for text in _if_it_happened(None, table):
                yield _template(Asks.WHAT_IF, text, predicate)
        elif predicate.kind is PredicateKind.ACTION:
            yield from _about_an_action(predicate, table)
            actor = domain.words.actors.get(predicate.name)
            if actor is not None and table is not None:
                yield from _about_another_robot(domain, predicate, actor)


def _template(asks: Asks, text: str, about: Predicate, *, positive: bool = True) -> Template:
    return Template(asks, text, about.name, len(about.sorts), about.sorts, positive)


def _about_places(domain: PlanningDomain) -> Iterator[Template]:
    for place in places(domain):
        predicate = domain.knowledge.signature.predicates[place.predicate]
        if place.single:
            yield _template(Asks.WHERE, f"where is {{{place.thing}}}", predicate)
        for who in ("what", "who", "what objects", "what things"):
            for text in (f"{who} is", f"{who} do you see", f"{who} did you see"):
                text = f"{text} {place.preposition} {{0}}"
                yield Template(Asks.CONTENTS, text, arity=1, sorts=(predicate.sorts[place.place],))


def _about_a_relation(domain: PlanningDomain, predicate: Predicate) -> Iterator[Template]:
    say, deny = domain.words.clauses(predicate.name, len(predicate.sorts))
    place = next(
        (place_kind for place_kind in places(domain) if place_kind.predicate == predicate.name),
        None,
    )
    for slot, text in asking_for(say, predicate.sorts):
        # Where things are, and what is somewhere, is asked about above.
        is_asked = place is not None and (
            slot == place.thing or (place.single and text.startswith("where "))
        )
        if not is_asked:
            yield _template(Asks.WHICH, text, predicate)
    for positive, clause in ((True, say), (False, deny)):
        for asks, text in _about_a_clause(clause, positive):
            # What never changes cannot be supposed to be otherwise.
            if asks is not Asks.WHAT_IF or predicate.kind.is_fluent:
                yield _template(asks, text, predicate, positive=positive)
    if not denies(say):
        # "Why is the kitchen not closed?", where what is not closed is called open.
        for text in with_not(say):
            yield _template(Asks.WHY_BELIEVE, f"why {text}", predicate, positive=False)


def _about_a_clause(clause: str, positive: bool) -> Iterator[tuple[Asks, str]]:
    asked = question_form(clause)
    if positive or not denies(clause):
        yield Asks.IS, asked
        yield Asks.IS, f"is it so that {clause}"
        # "is Sally not in the kitchen" asks what "is Sally in the kitchen" does.
        for text in with_not(clause):
            yield Asks.IS, text
    for beginning in ("do you believe that", "do you not believe that"):
        yield Asks.IS, f"{beginning} {clause}"
    for beginning in ("why do you not believe that", "why did you not believe that"):
        yield Asks.WHY_DISBELIEVE, f"{beginning} {clause}"
    yield Asks.WHY_BELIEVE, f"why {asked}"
    for beginning in ("why do you believe that", "why did you believe that", "how do you know that",
                      "why do you believe"):  # fmt: skip
        yield Asks.WHY_BELIEVE, f"{beginning} {clause}"
    were = re.sub(r"\bis\b", "were", clause, count=1)
    for beginning in _SUPPOSING:
        yield Asks.WHAT_IF, f"{beginning} {were}"


def _about_an_action(predicate: Predicate, table: ActionTable | None) -> Iterator[Template]:
    if table is None:
        slots = " ".join(f"{{{number}}}" for number in range(len(predicate.sorts)))
        do = did = f"{_words(predicate.name)} {slots}"
    else:
        do, did = table.do or table.did, table.did
    for instruction in (do, *(table.also if table is not None else ())):
        for asks, beginning in _BEFORE_INSTRUCTIONS:
            yield _template(asks, f"{beginning} {instruction}", predicate)
        yield _template(Asks.WHY_DID, f"why are you {gerund(instruction)}", predicate)
    yield _template(Asks.DID, f"have you {did}", predicate)
    for beginning, text in (("did you", do), ("have you", did)):
        less = without_last_thing(text)
        if less is not None:
            yield _template(Asks.DID, f"{beginning} {less}", predicate)
    only = set(SLOT.findall(do))
    if len(only) == 1:
        # "Why not the library instead?" of what was moved to.
        yield _template(Asks.WHY_NOT, f"why not {{{only.pop()}}}", predicate)
    place = without_first_words(do)
    if place is not None:
        yield _template(Asks.WHY_DID, f"why {place}", predicate)
    for text in _if_it_happened(do, table):
        yield _template(Asks.WHAT_IF, text, predicate)


def _about_another_robot(
    domain: PlanningDomain, predicate: Predicate, actor: int
) -> Iterator[Template]:
    """The questions about an action that name whoever does it, where there are several."""
    sort = predicate.sorts[actor]
    table = domain.words.actions[predicate.name]
    if len(domain.knowledge.signature.members(sort)) < 2 or table.do is None:
        return
    who = f"{{{actor}}}"
    for asks, text in (
        (Asks.WHY_DID, f"why did {who} {table.do}"),
        (Asks.WHY_DID, f"why is {who} {gerund(table.do)}"),
        (Asks.WHY_NOT, f"why did {who} not {table.do}"),
        (Asks.WHY_NOT, f"why does {who} not {table.do}"),
        (Asks.WHY_NOT, f"why can {who} not {table.do}"),
        (Asks.DID, f"did {who} {table.do}"),
        (Asks.DID, f"has {who} {table.did}"),
        *((Asks.WHAT_IF, f"{beginning} {who} {table.did}") for beginning in _SUPPOSING),
    ):
        yield _template(asks, text, predicate)
    for text in ("what did {0} do", "what has {0} done"):
        yield Template(Asks.DONE, text, arity=1, sorts=(sort,))


def _if_it_happened(do: str | None, table: ActionTable | None) -> Iterator[str]:
    """Questions for what would be done after an action or event."""
    if table is None:
        return
    clauses = [table.did if do is None or table.do is None else f"you {table.did}"]
    # "the message was lost": "you lost the message"
    passive = re.fullmatch(r"(\{\d+\}) was (\w+)", table.did)
    if passive:
        clauses.append(f"you {passive.group(2)} {passive.group(1)}")
    for clause in clauses:
        for beginning in _SUPPOSING:
            yield f"{beginning} {clause}"


def _words(name: str) -> str:
    return name.replace("_", " ")
