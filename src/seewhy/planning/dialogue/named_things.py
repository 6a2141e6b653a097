"""The things of a domain that a question names, and what stands for them, such as "her"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from seewhy.dialogue.question_words import words_of
from seewhy.errors import QuestionError
from seewhy.planning.dialogue.location_fluents import places
from seewhy.planning.dialogue.question_templates import plain_words
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.things.descriptions import descriptions, which_is_meant

LOCATION = ("location", "position", "whereabouts")
_SELF = ("you", "yourself", "me")


class UnclearThingError(QuestionError):
    """A question speaks of one thing where there are several that it may mean."""


@dataclass(frozen=True)
class Thing:
    """Something named in a question.

    Attributes
    ----------
    term : str
    sorts : frozenset of str
    located : bool
        Whether its place is meant.
    said : str
        The words that name it.
    acts : bool
        Whether it is who is asked.
    """

    term: str
    sorts: frozenset[str]
    located: bool = False
    said: str = ""
    acts: bool = False


Marked = Sequence[str | Thing]
"""The words of a question, with things in the place of their names."""


class NamedThings:
    """The names of a domain's things.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> things = NamedThings(load_planning_domain("robot_assistant"))
    >>> [word if isinstance(word, str) else word.term for word in things.marked(["is", "sally"])]
    ['is', 'sally']
    """

    def __init__(self, domain: PlanningDomain) -> None:
        self.robot = domain.robot
        self.words = domain.words
        signature = domain.knowledge.signature
        self.sorts: dict[str, frozenset[str]] = {}
        for sort in signature.sorts.values():
            for term in sort.members or ():
                self.sorts[term] = self.sorts.get(term, frozenset()) | {sort.name}
        self._names: dict[tuple[str, ...], str] = {}
        for term in self.sorts:
            for words in self._called(term):
                self._names.setdefault(words, term)
        self._several: dict[tuple[str, ...], tuple[str, ...]] = {}
        if domain.at_first is not None:
            self._describe(descriptions(domain.at_first))
        if domain.robot:
            self._names.update({(word,): domain.robot for word in _SELF})
        self._longest = max(map(len, (*self._names, *self._several)), default=1)
        self.located = {
            signature.predicates[place.predicate].sorts[place.place]
            for place in places(domain)
            if place.single
        }

    def _describe(self, called: Mapping[str, tuple[str, ...]]) -> None:
        """Take descriptions as names; of those that fit several things it is asked which."""
        for said, terms in called.items():
            words = tuple(plain_words(words_of(said)))
            if not words:
                continue
            # "Cube" is a thing of that shape rather than the shape.
            if len(terms) == 1:
                self._names[words] = terms[0]
            else:
                self._names.pop(words, None)
                self._several[words] = terms

    def _called(self, term: str) -> list[tuple[str, ...]]:
        """What a thing is called in questions, its name first.

        A name of which nothing is left there, such as "the", is none.
        """
        names = (self.words.name(term), term.strip('"').replace("_", " "))
        called = (tuple(plain_words(words_of(name))) for name in names)
        return [words for words in called if words]

    @property
    def vocabulary(self) -> set[str]:
        """The words of all names."""
        return {word for name in (*self._names, *self._several) for word in name} | {
            *LOCATION,
            "your",
            *self.words.possessives.values(),
        }

    def marked(self, words: Sequence[str]) -> list[str | Thing]:
        """The words with the names in them replaced by the things, the longest first."""
        marked: list[str | Thing] = []
        place = 0
        while place < len(words):
            thing, length = self._named(words, place) or self._located(words, place) or (None, 1)
            marked.append(words[place] if thing is None else thing)
            place += length
        return marked

    def written_out(self, words: list[str]) -> list[str]:
        """The words with "her" said as "Sally's", where Sally was named before."""
        possessives = self.words.possessives
        for place, word in enumerate(words):
            if word in possessives.values():
                for thing in self.marked(words[:place]):
                    if isinstance(thing, Thing) and possessives.get(thing.term) == word:
                        *name, last = self._called(thing.term)[0]
                        words = [*words[:place], *name, f"{last}'s", *words[place + 1 :]]
        return words

    def _named(self, words: Sequence[str], place: int) -> tuple[Thing, int] | None:
        for length in range(min(self._longest, len(words) - place), 0, -1):
            term = self._names.get(tuple(words[place : place + length]))
            if term is None:
                self._refuse_several(tuple(words[place : place + length]))
            else:
                said = " ".join(words[place : place + length])
                thing = Thing(term, self.sorts[term], said=said, acts=term == self.robot)
                return thing, length
        return None

    def _refuse_several(self, words: tuple[str, ...]) -> None:
        terms = self._several.get(words)
        if terms is not None:
            names = [self.words.name(term) for term in terms]
            raise UnclearThingError(which_is_meant(" ".join(words), names), nearest=tuple(names))

    def _located(self, words: Sequence[str], place: int) -> tuple[Thing, int] | None:
        """What "Sally's location" and "your location" mean, and how many words they are."""
        for length in range(min(self._longest, len(words) - place - 1), 0, -1):
            if words[place + length] not in (*LOCATION, *self.located):
                continue
            *before, last = words[place : place + length]
            term = (
                self.robot
                if (*before, last) == ("your",)
                else self._names.get((*before, last.removesuffix("'s")))
            )
            if term is not None:
                return Thing(term, self.sorts[term], located=True), length + 1
        return None
