"""Speak as the robot: its own term becomes "I", clauses get a tense and are drawn together."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace

import clingo

from seewhy.domain.wording import join_words, say_one_of, sentence
from seewhy.planning.diagnosis.diagnosis import Surprise
from seewhy.planning.words import PlanningWords
from seewhy.text.predicate_words import base_form, past

_ME = "\x01"
_PLURAL = {"is": "are", "has": "have", "does": "do", "was": "were", "had": "had"}
_VERB = re.compile(rf"^(.+?) ({'|'.join(_PLURAL)}) (.+)$")
_SUBJECT = re.compile(rf"(^|\bthat |^perhaps ){_ME} (\w+)")
_OF_ME = re.compile(rf"\bthe (\w+(?: \w+)?) of {_ME}(?!\w|')")
_FIRST = {"is": "am", "has": "have", "does": "do", "was": "was", "goes": "go"}


class Speech:
    """The words of a domain in the mouth of whoever acts in it.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> speech = Speech(load_planning_domain("robot_assistant").words)
    >>> speech.say(clingo.parse_term("has(rob1,m1)"))
    'I have the first message'
    >>> speech.said(clingo.parse_term("loc(rob1,kitchen)"))
    'I was in the kitchen'
    >>> speech.say(clingo.parse_term("loc(sally,sallys_office)"))
    'Sally is in her office'
    """

    def __init__(self, words: PlanningWords) -> None:
        self._plain = words
        robot = {words.robot: _ME} if words.robot else {}
        self.words = replace(words, things={**words.things, **robot})

    def name(self, term: clingo.Symbol | str) -> str:
        """How a thing is called; the robot is "me"."""
        return self.words.name(term).replace(_ME, "me")

    def say(self, literal: clingo.Symbol) -> str:
        """A literal as a clause in the present tense."""
        return self._spoken(self.words.say(literal))

    def said(self, literal: clingo.Symbol) -> str:
        """A literal as a clause in the past tense; what never changes is said in the present."""
        return self._spoken(self.words.said(literal))

    def do(self, action: clingo.Symbol) -> str:
        """An action as what is to be done: "move to the kitchen"."""
        return self._spoken(self.words.do(action))

    def did(self, action: clingo.Symbol) -> str:
        """An action as what was done: "moved to the kitchen"."""
        return self._spoken(self.words.did(action))

    def act(self, action: clingo.Symbol) -> str:
        """An action as what whoever does it is to do."""
        return self._spoken(self.words.act(action))

    def subject(self, action: clingo.Symbol) -> str:
        """Whoever does an action: "I", or another robot by its name."""
        actor = self.words.actor(action)
        return "I" if actor is None else self.name(actor)

    def happened(self, action: clingo.Symbol) -> str:
        """What was done or happened as a clause: "I moved to the kitchen", "Bob walked away"."""
        table = self.words.actions.get(action.name)
        happened = table is not None and table.do is None
        return self.did(action) if happened else f"{self.subject(action)} {self.did(action)}"

    def surprise(self, surprise: Surprise) -> str:
        """What a diagnosis assumes, as a clause."""
        return self._spoken(self.words.surprise(surprise))

    def every(self, literals: Iterable[clingo.Symbol]) -> str:
        """Literals as one clause in the present tense."""
        return together([self.say(literal) for literal in literals])

    def every_past(self, literals: Iterable[clingo.Symbol]) -> str:
        """Literals as one clause in the past tense."""
        return together([self.said(literal) for literal in literals])

    def _spoken(self, clause: str) -> str:
        clause = _in_first_person(clause)
        for term, possessive in self._plain.possessives.items():
            name = self._plain.name(term)
            if clause.startswith(f"{name} "):
                clause = name + clause[len(name) :].replace(f"{name}'s", possessive)
        return re.sub(r"\b([Aa]) (?=[aeiou])", r"\1n ", clause)


def subjunctive(clause: str) -> str:
    """Put a clause into the form that follows "if".

    Examples
    --------
    >>> subjunctive("the kitchen is closed")
    'the kitchen were closed'
    """
    return past(clause).replace(" was ", " were ", 1)


def together(clauses: Sequence[str]) -> str:
    """Join clauses, saying once what they share.

    Examples
    --------
    >>> together(["a cup is here", "a sofa is here", "Sally is away"])
    'a cup and a sofa are here and Sally is away'
    >>> together(["Sally is not in the kitchen", "Sally is not in the library"])
    'Sally is not in the kitchen or library'
    """
    groups: dict[tuple[str, str], list[str]] = {}
    for clause in dict.fromkeys(clauses):
        found = _VERB.match(clause)
        if found and found.group(1) not in ("there", "it", "I"):
            groups.setdefault((found.group(2), found.group(3)), []).append(found.group(1))
        else:
            groups.setdefault((clause.split(" ")[0], ""), []).append(clause)
    said = []
    for (verb, rest), parts in groups.items():
        if not rest:
            said += parts
        elif len(parts) == 1:
            said.append(f"{parts[0]} {verb} {rest}")
        else:
            said.append(f"{join_words(parts)} {_PLURAL[verb]} {rest}")
    return join_words(_by_subject(said))


def _by_subject(clauses: Sequence[str]) -> list[str]:
    """Draw together neighbours that share at least three words at the beginning."""
    groups: list[list[str]] = []
    for clause in clauses:
        beginning = clause.split(" ")[:3]
        same = groups and groups[-1][0].split(" ")[:3] == beginning and len(beginning) == 3
        if same and "," not in clause:
            groups[-1].append(clause)
        else:
            groups.append([clause])
    return [
        say_one_of(group, word="or" if re.search(r"\b(not|no)\b", group[0]) else "and")
        for group in groups
    ]


def sentences(clauses: Iterable[str]) -> str:
    """Return clauses as sentences, empty ones left out.

    Examples
    --------
    >>> sentences(["it is so", "", "I saw it"])
    'It is so. I saw it.'
    """
    return " ".join(sentence(clause) for clause in clauses if clause)


def of_several(predicate: Sequence[str]) -> list[str]:
    """Return a predicate of one thing, its verb first, as it is said of several.

    Examples
    --------
    >>> of_several("is large".split()), of_several("works in".split())
    (['are', 'large'], ['work', 'in'])
    """
    verb, *rest = predicate or [""]
    return [_PLURAL.get(verb) or base_form(verb), *rest] if predicate else []


def _in_first_person(clause: str) -> str:
    def spoken(found: re.Match[str]) -> str:
        before, verb = found.groups()
        return f"{before}I {_FIRST.get(verb) or base_form(verb)}"

    clause = _SUBJECT.sub(spoken, clause)
    clause = _OF_ME.sub(r"my \1", clause)
    return clause.replace(f"{_ME}'s", "my").replace(_ME, "me")
