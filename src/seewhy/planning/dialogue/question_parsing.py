"""A question about a run in words becomes a query; the words come from the planning domain."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, islice

from rapidfuzz import fuzz

from seewhy.dialogue.question_words import words_of
from seewhy.dialogue.spelling import Spelling
from seewhy.errors import QuestionError
from seewhy.planning.dialogue.clause_forms import SLOT
from seewhy.planning.dialogue.named_things import Marked, NamedThings, Thing
from seewhy.planning.dialogue.query import Asks, Query
from seewhy.planning.dialogue.question_templates import (
    HOLE,
    KNOWN_WORDS,
    Template,
    plain_words,
    question_templates,
)
from seewhy.planning.dialogue.template_similarity import TELLING, VERBS, likeness, telling_words
from seewhy.planning.domain import PlanningDomain
from seewhy.text.predicate_words import base_form

LONGEST_QUESTION = 300
"""Characters; nothing in a controlled vocabulary is nearly as long."""
_MOST_READINGS = 64
_STEP = re.compile(r"(?: (?:at|in|during|after))? step (\d{1,6})\b")
_AT_FIRST = re.compile(
    r" (?:(?:at|in|from)(?: the)? (?:first|start|beginning|outset)|initially|to begin with)\b"
)
_FIRST = re.compile(r"^(?:why )?(?:did|have|will|would|are) you .*\w( first| before all else)$")
"""What was done first of all, or for the first time."""
_CONTRAST = re.compile(r" (?:rather than|instead of|as opposed to|and not) ")
_CONTRASTED = (Asks.WHY_DID, Asks.WHY_BELIEVE)
_PAST = {"is": "was", "are": "were", "am": "was", "do": "did", "does": "did", "has": "had"}
_TENSED = (Asks.IS, Asks.WHERE, Asks.CONTENTS, Asks.WHICH, Asks.PLAN, Asks.GOAL, Asks.WHY_BELIEVE,
           Asks.WHY_DISBELIEVE)  # fmt: skip
"""What is asked of the past where its verb is in the past: the rest says itself when."""
_NOT_YOU = re.compile(r"\b(do|did|would|have|are|can|could) not you\b")
_POLITE = re.compile(
    r"^(?:please )?(?:(?:can|could|will|would|do)(?: not)?(?: you)?(?: not)?(?: please)? )?"
    r"tell me(?: please)? (?=(?:wh\w+|how|if|is|are|was|were|do|does|did|has|have)\b)"
)
_ADDRESSED = (("is you", "are you"), ("you is", "you are"), ("does you", "do you"),
              ("you has", "you have"), ("you does", "you do"))  # fmt: skip


class PlanningQuestions:
    """The questions that can be asked about runs in a domain.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> questions = PlanningQuestions(load_planning_domain("robot_assistant"))
    >>> query = questions.understand("WHY did you go to the kichen at step 2??")
    >>> query.asks.value, str(query.symbol()), query.step
    ('why_did', 'move(rob1,kitchen)', 2)
    """

    def __init__(self, domain: PlanningDomain) -> None:
        self.domain = domain
        self.templates = question_templates(domain)
        self._skeletons = [(template, template.words) for template in self.templates]
        self._things = NamedThings(domain)
        self._spelling = Spelling(
            {word for _, words in self._skeletons for word in words}
            | {*KNOWN_WORDS, *TELLING, "step"}.union(*VERBS)
            | self._things.vocabulary
        )

    def understand(self, text: str) -> Query:
        """Return the query that a question in words asks for.

        Case, punctuation, articles and typing errors are forgiven.

        Raises
        ------
        QuestionError
            If the question is empty, too long or not understood; it names the nearest ones.
        """
        if not text.strip():
            raise self._refusal("the question is empty", [])
        if len(text) > LONGEST_QUESTION:
            raise self._refusal(
                f"the question has {len(text)} characters, at most {LONGEST_QUESTION} are read", []
            )
        plain = _NOT_YOU.sub(r"\1 you not", _POLITE.sub("", " ".join(words_of(text))))
        words = plain.split()
        if words[:1] in (["whether"], ["if"]):
            words = ["is", "it", "so", "that", *words[1:]]
        contrast = _CONTRAST.search(" ".join(words))
        if contrast is None:
            return self._understood(words, text)
        before, after = (part.split() for part in contrast.string.split(contrast.group(), 1))
        return self._contrasted(before, after, text)

    def examples(self) -> list[str]:
        """Return a question of each kind, for whoever does not know what can be asked."""
        first: dict[Asks, str] = {}
        for template in self.templates:
            first.setdefault(template.asks, f"{self._filled(template, {})}?")
        return list(first.values())

    def _contrasted(self, before: list[str], after: list[str], text: str) -> Query:
        """Read a question with a contrast, whose words take the place of the ones before it."""
        *_, step = [None, *_STEP.finditer(f" {' '.join(after)}")]
        when = step.group().split() if step else []
        for length in range(len(after) - len(when), 0, -1):
            foil, rest = after[:length], after[length:]
            asked = self._readable([*before, *rest], text)
            if asked is None or asked.asks not in _CONTRASTED:
                continue
            verbs = [["why", "did", "you"], ["why", "are", "you"]]
            beginnings = [*(before[:place] for place in range(len(before), 0, -1)), *verbs]
            for beginning in beginnings:
                other = self._readable([*beginning, *foil, *rest], text)
                if other is not None and other.asks is asked.asks and _differ(asked, other):
                    return replace(asked, foil=other)
        return self._understood([*before, "rather", *after], text)

    def _readable(self, words: Sequence[str], text: str) -> Query | None:
        try:
            return self._understood(words, text)
        except QuestionError:
            return None

    def _understood(self, read_words: Sequence[str], text: str) -> Query:
        said = " ".join(text.split())
        marked: list[str | Thing] = []
        for spelt in self._spelling.readings(read_words):
            joined = _AT_FIRST.sub(" step 0", spelt.replace("first plan", "plan at first"))
            first = _FIRST.search(joined)
            joined = joined if first is None else joined[: first.start(1)]
            step = _STEP.search(joined)
            words = plain_words(_STEP.sub("", joined).split())
            marked = self._things.marked(self._things.written_out(words))
            found = self._readings(marked, step and int(step.group(1)))
            found = [replace(query, first=first is not None) for query in found]
            if len(found) == 1:
                return _in_its_tense(found[0], spelt.split())
            if found:
                nearest = [f"{query.text}?" for query in found][:3]
                raise self._refusal(f"'{said}' can be read in several ways", marked, nearest)
        raise self._refusal(f"'{said}' is not understood", marked)

    def _readings(self, marked: Marked, step: int | None) -> list[Query]:
        """The queries whose templates are most like a question."""
        best: dict[tuple[object, ...], Query] = {}
        score = 0.0
        for template, skeleton in self._skeletons:
            for chosen in self._fillings(template, marked):
                read = [w if isinstance(w, str) else HOLE for w in _chosen(marked, chosen)]
                alike = likeness(template.asks, read, skeleton)
                if alike is None or alike < score:
                    continue
                query = self._query(template, chosen, step)
                best = best if alike == score else {}
                best.setdefault(
                    (query.asks, query.predicate, query.arguments, query.positive), query
                )
                score = alike
        return list(best.values())

    def _fillings(
        self, template: Template, marked: Marked
    ) -> Iterator[tuple[tuple[int, Thing], ...]]:
        """The ways to fill the slots with things of the question, in their order."""
        things = [
            (place, thing)
            for place, thing in enumerate(marked)
            # What "you" did is asked without a name.
            if isinstance(thing, Thing) and not (thing.acts and template.asks is Asks.DONE)
        ]
        for chosen in islice(combinations(things, len(template.slots)), _MOST_READINGS):
            if all(
                template.sorts[slot] in (self._things.located if thing.located else thing.sorts)
                for slot, (_, thing) in zip(template.slots, chosen, strict=True)
            ):
                yield chosen

    def _query(
        self, template: Template, chosen: Sequence[tuple[int, Thing]], step: int | None
    ) -> Query:
        arguments: list[str | None] = [None] * template.arity
        whose = None
        for slot, (_, thing) in zip(template.slots, chosen, strict=True):
            arguments[slot] = thing.term
            whose = slot if thing.located else whose
        actor = self.domain.words.actors.get(template.predicate or "")
        if actor is not None and arguments[actor] is None:
            # Whoever is asked is the one who acts.
            arguments[actor] = self.domain.robot
        filling = zip(template.slots, chosen, strict=True)
        text = self._filled(template, {slot: thing for slot, (_, thing) in filling})
        when = "" if step is None else f" at step {step}"
        return Query(
            asks=template.asks,
            text=f"{text}{when}",
            predicate=template.predicate,
            arguments=tuple(arguments),
            positive=template.positive,
            whose=whose,
            step=step,
        )

    def _filled(self, template: Template, things: dict[int, Thing]) -> str:
        things = dict(things)

        def named(slot: re.Match[str]) -> str:
            number = int(slot.group(1))
            thing = things.get(number)
            if thing is None:
                members = self.domain.knowledge.signature.members(template.sorts[number])
                # Nobody asks whether a thing is on itself.
                named_too = {self.domain.robot, *(other.term for other in things.values())}
                others = [term for term in members if term not in named_too] or list(members)
                if not others:
                    return self.domain.words.name(template.sorts[number])
                things[number] = Thing(others[0], self._things.sorts[others[0]])
                return self.domain.words.name(others[0])
            if thing.term == self.domain.robot:
                return "your location" if thing.located else "you"
            name = self.domain.words.name(thing.term)
            return f"{name}'s location" if thing.located else name

        text = SLOT.sub(named, template.raw)
        for said, meant in _ADDRESSED:
            text = re.sub(rf"\b{said}\b", meant, text)
        return re.sub(r"\b(?:if|that) you \w+s\b", lambda found: base_form(found.group()), text)

    def _refusal(self, problem: str, marked: Marked, nearest: Sequence[str] = ()) -> QuestionError:
        suggested = tuple(nearest or self._nearest(marked))
        return QuestionError(
            f"{problem}; ask for instance: {' · '.join(suggested)}", nearest=suggested
        )

    def _nearest(self, marked: Marked) -> list[str]:
        read = " ".join(word if isinstance(word, str) else HOLE for word in marked)
        things = [word for word in marked if isinstance(word, Thing)]

        told = telling_words(read.split())
        alike = [pair for pair in self._skeletons if telling_words(pair[1]) == told]

        def unlikeness(pair: tuple[Template, list[str]]) -> float:
            return -fuzz.ratio(read, " ".join(pair[1]))

        ranked = sorted(alike or self._skeletons, key=unlikeness) if marked else self._skeletons
        texts: dict[str, None] = {}
        asked: set[tuple[Asks, str | None]] = set()
        for template, _ in ranked:
            left = list(things)
            filling = {}
            for slot in template.slots:
                fits = [thing for thing in left if template.sorts[slot] in thing.sorts]
                if fits:
                    filling[slot] = fits[0]
                    left.remove(fits[0])
            kind = (template.asks, template.predicate if marked else None)
            if kind not in asked:
                asked.add(kind)
                texts[f"{self._filled(template, filling)}?"] = None
            if len(texts) == 3:
                break
        return list(texts)


def _chosen(marked: Marked, chosen: Sequence[tuple[int, Thing]]) -> Iterator[str | Thing]:
    """The question with only the chosen things marked; the others are words again."""
    kept = {place for place, _ in chosen}
    for place, word in enumerate(marked):
        if isinstance(word, str) or place in kept:
            yield word
        elif word.acts:
            yield "you"
        else:
            yield word.said or word.term.replace("_", " ")


def _in_its_tense(query: Query, words: Sequence[str]) -> Query:
    """The query as one about the past, where the question is in the past and names no step."""
    past = query.asks in _TENSED and query.step is None and {*_PAST.values()} & {*words}
    if not past:
        return query
    said = query.text.split(" ")
    verb = next((place for place, word in enumerate(said) if word in _PAST), None)
    if verb is not None:
        said[verb] = _PAST[said[verb]]
    return replace(query, past=True, text=" ".join(said))


def _differ(asked: Query, other: Query) -> bool:
    """Whether two queries are about different things, none of which was only left open."""
    if asked.predicate != other.predicate:
        return True
    pairs = list(zip(asked.arguments, other.arguments, strict=True))
    return any(one != two for one, two in pairs) and all(
        one is None or two is not None for one, two in pairs
    )
