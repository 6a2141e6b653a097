"""A question about a run in words becomes a query; the words come from the planning domain."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import combinations, islice

import clingo
from rapidfuzz import fuzz, process
from rapidfuzz.distance import DamerauLevenshtein

from seewhy.dialogue.question_words import words_of
from seewhy.errors import QuestionError
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.dialogue.speech import base
from seewhy.planning.dialogue.whereabouts import places
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.tables import ActionTable

LONGEST_QUESTION = 300
"""Characters; nothing in a controlled vocabulary is nearly as long."""
_ALIKE = 80.0
_ALIKE_ACTION = 68.0
"""An action may be called by another verb of the same meaning: to go is to move."""
_MOST_READINGS = 64
_SLOT = re.compile(r"\{(\d+)\}")
_STEP = re.compile(r"(?: (?:at|in|during|after))? step (\d{1,6})\b")
_AT_FIRST = re.compile(
    r" (?:(?:at|in|from)(?: the)? (?:first|start|beginning|outset)|initially|to begin with)\b"
)
_CONTRAST = re.compile(r" (?:rather than|instead of|and not) ")
_NOT_YOU = re.compile(r"\b(do|did|would|have|are) not you\b")
_POLITE = re.compile(
    r"^(?:please )?(?:(?:can|could|will|would|do)(?: not)?(?: you)?(?: not)?(?: please)? )?"
    r"tell me(?: please)? (?=(?:wh\w+|how|if|is|are|was|were|do|does|did|has|have)\b)"
)
_HOLE = "§"
_DROPPED = {"a", "an", "the", "any", "some", "instead", "now", "then", "please", "currently",
            "really", "just", "actually", "still", "so", "far", "straight", "directly"}  # fmt: skip
_SAME = {"are": "is", "am": "is", "was": "is", "were": "is", "be": "is", "think": "believe",
         "what's": "what", "altered": "change", "changed": "change", "replan": "change",
         "aim": "goal", "intention": "plan"}  # fmt: skip
_TELLING = {"why", "what", "where", "who", "if", "not", "no", "how"}
_AUXILIARIES = {"is", "are", "has", "can", "was"}
_ADDRESSED = (("is you", "are you"), ("you is", "you are"), ("does you", "do you"),
              ("you has", "you have"), ("you does", "you do"))  # fmt: skip
_FREE = {"is", "does", "do", "did", "has", "have", "in", "at", "on", "of", "for", "to", "with",
         "from", "by", "that", "it", "there", "you", "your", "would", "will", "happen", "up",
         _HOLE} | _TELLING  # fmt: skip
_VERBS = (
    {"move", "go", "walk", "drive", "travel", "head", "come", "run", "enter"},
    {"moving", "going", "walking", "driving", "travelling", "heading", "coming", "running",
     "entering"},
    {"moved", "gone", "went", "walked", "driven", "travelled", "come", "run", "entered"},
    {"deliver", "bring", "give", "hand", "take", "carry"},
    {"delivering", "bringing", "giving", "handing", "taking", "carrying"},
    {"delivered", "brought", "gave", "given", "handed", "taken", "carried"},
    {"put", "place", "set", "lay", "stack", "drop"},
    {"putting", "placing", "setting", "laying", "stacking", "dropping"},
    {"put", "placed", "set", "laid", "stacked", "dropped"},
    {"pick", "take", "grab", "grasp", "lift", "raise"},
    {"picking", "taking", "grabbing", "grasping", "lifting", "raising"},
    {"picked", "taken", "grabbed", "grasped", "lifted", "raised"},
)  # fmt: skip
"""Verbs that may stand for one another where an action is asked about; no other verb may."""
_SELF = ("you", "yourself", "me")
_LOCATION = ("location", "position", "whereabouts")


class Asks(StrEnum):
    """What a question about a run asks for."""

    IS = "is"
    WHERE = "where"
    CONTENTS = "contents"
    PLAN = "plan"
    DONE = "done"
    GOAL = "goal"
    WHY_DID = "why_did"
    WHY_NOT = "why_not"
    WHY_BELIEVE = "why_believe"
    WHY_DISBELIEVE = "why_disbelieve"
    WHAT_IF = "what_if"
    WHY_CHANGED = "why_changed"
    WHICH = "which"
    DID = "did"
    ENDED = "ended"
    WHY_ENDED = "why_ended"


_SUPPOSING = ("what would you do if", "what would happen if", "what if")
_ACTIONS = (Asks.WHY_DID, Asks.WHY_NOT, Asks.DID)
_CONTRASTED = (Asks.WHY_DID, Asks.WHY_BELIEVE)
_UNFILLED = {
    Asks.PLAN: ("what is your plan", "what do you plan to do", "what will you do",
                "what will you do next", "what do you intend to do", "what do you plan",
                "what did you plan", "what did you plan to do", "what is next",
                "what are you doing"),
    Asks.DONE: ("what did you do", "what have you done", "what happened"),
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
class Query:
    """What a question asks, without the wording.

    Attributes
    ----------
    asks : Asks
    text : str
        The question as it was understood.
    predicate : str or None
        The fluent or action that it is about.
    arguments : tuple of (str or None)
        Its arguments, or the one thing that is asked for; None where the question leaves it open.
    positive : bool
    whose : int or None
        The argument that stands for the place of the thing: "Sally's location".
    step : int or None
    foil : Query or None
        What it is contrasted with: "rather than on the table".
    """

    asks: Asks
    text: str
    predicate: str | None = None
    arguments: tuple[str | None, ...] = ()
    positive: bool = True
    whose: int | None = None
    step: int | None = None
    foil: Query | None = None

    def symbol(self) -> clingo.Symbol:
        """The literal or action that is asked about; what is left open is ``_``."""
        assert self.predicate is not None
        arguments = [clingo.parse_term(own or '"_"') for own in self.arguments]
        return clingo.Function(self.predicate, arguments, self.positive)

    def to_dict(self) -> dict[str, object]:
        """Return the query as values that JSON can hold."""
        return {
            "asks": self.asks.value,
            "text": self.text,
            "about": None if self.predicate is None else str(self.symbol()),
            "step": self.step,
            "rather_than": None if self.foil is None else str(self.foil.symbol()),
        }


@dataclass(frozen=True)
class _Thing:
    """Something named in a question.

    ``located`` where its place is meant, ``acts`` where it is who is asked.
    """

    term: str
    sorts: frozenset[str]
    located: bool = False
    said: str = ""
    acts: bool = False


@dataclass(frozen=True)
class _Template:
    asks: Asks
    raw: str
    predicate: str | None = None
    arity: int = 0
    sorts: tuple[str, ...] = ()
    positive: bool = True

    @property
    def slots(self) -> tuple[int, ...]:
        return tuple(map(int, _SLOT.findall(self.raw)))

    @property
    def words(self) -> list[str]:
        return _plain(words_of(_SLOT.sub(" SLOT ", self.raw)))


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
        self.templates = list(dict.fromkeys(_templates(domain)))
        self._skeletons = [(own, own.words) for own in self.templates]
        signature = domain.knowledge.signature
        self._sorts: dict[str, frozenset[str]] = {}
        for sort in signature.sorts.values():
            for term in sort.members or ():
                self._sorts[term] = self._sorts.get(term, frozenset()) | {sort.name}
        self._names: dict[tuple[str, ...], str] = {}
        for term in self._sorts:
            for name in (domain.words.name(term), term.strip('"').replace("_", " ")):
                self._names.setdefault(tuple(_plain(words_of(name))), term)
        if domain.robot:
            self._names.update({(word,): domain.robot for word in _SELF})
        self._names.pop((), None)
        self._longest = max(map(len, self._names), default=1)
        self._vocabulary = sorted(
            {word for _, words in self._skeletons for word in words}
            | {word for name in self._names for word in name}
            | {*_DROPPED, *_SAME, *_TELLING, *_LOCATION, "step", "your"}.union(*_VERBS)
            | set(domain.words.possessives.values())
        )
        self._located = {
            signature.predicates[own.predicate].sorts[own.place]
            for own in places(domain)
            if own.single
        }

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
        joined = " ".join(self._mended(word) for word in read_words)
        joined = _AT_FIRST.sub(" step 0", joined.replace("first plan", "plan at first"))
        step = _STEP.search(joined)
        words = _STEP.sub("", joined).split()
        marked = self._marked(self._with_names(_plain(words)))
        best: dict[tuple[object, ...], Query] = {}
        score = 0.0
        for template, skeleton in self._skeletons:
            for chosen in self._fillings(template, marked):
                read = [w if isinstance(w, str) else _HOLE for w in _chosen(marked, chosen)]
                if _told(read) != _told(skeleton):
                    continue
                alike = fuzz.ratio(" ".join(read), " ".join(skeleton))
                if not _fits(template.asks, read, skeleton, alike):
                    continue
                query = self._query(template, chosen, step and int(step.group(1)))
                if alike >= score:
                    best = best if alike == score else {}
                    best.setdefault(
                        (query.asks, query.predicate, query.arguments, query.positive), query
                    )
                    score = alike
        if len(best) == 1:
            return next(iter(best.values()))
        said = " ".join(text.split())
        if best:
            nearest = [f"{own.text}?" for own in best.values()][:3]
            raise self._refusal(f"'{said}' can be read in several ways", marked, nearest)
        raise self._refusal(f"'{said}' is not understood", marked)

    def examples(self) -> list[str]:
        """Return a question of each kind, for whoever does not know what can be asked."""
        first: dict[Asks, str] = {}
        for template in self.templates:
            first.setdefault(template.asks, f"{self._filled(template, {})}?")
        return list(first.values())

    def _fillings(
        self, template: _Template, marked: Sequence[str | _Thing]
    ) -> Iterator[tuple[tuple[int, _Thing], ...]]:
        """The ways to fill the slots with things of the question, in their order."""
        things = [(place, own) for place, own in enumerate(marked) if isinstance(own, _Thing)]
        for chosen in islice(combinations(things, len(template.slots)), _MOST_READINGS):
            if all(
                template.sorts[slot] in own.sorts
                if not own.located
                else template.sorts[slot] in self._located
                for slot, (_, own) in zip(template.slots, chosen, strict=True)
            ):
                yield chosen

    def _query(
        self, template: _Template, chosen: Sequence[tuple[int, _Thing]], step: int | None
    ) -> Query:
        arguments: list[str | None] = [None] * template.arity
        whose = None
        for slot, (_, own) in zip(template.slots, chosen, strict=True):
            arguments[slot] = own.term
            whose = slot if own.located else whose
        robot = self.domain.robot
        if robot is not None:
            # Whoever is asked is the one who acts.
            arguments = [
                robot if own is None and template.sorts[place] in self._sorts[robot] else own
                for place, own in enumerate(arguments)
            ]
        filling = zip(template.slots, chosen, strict=True)
        text = self._filled(template, {slot: own for slot, (_, own) in filling})
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

    def _filled(self, template: _Template, things: dict[int, _Thing]) -> str:
        things = dict(things)

        def named(slot: re.Match[str]) -> str:
            number = int(slot.group(1))
            own = things.get(number)
            if own is None:
                members = self.domain.knowledge.signature.members(template.sorts[number])
                # Nobody asks whether a thing is on itself.
                named_too = {self.domain.robot, *(thing.term for thing in things.values())}
                others = [term for term in members if term not in named_too] or list(members)
                if not others:
                    return self.domain.words.name(template.sorts[number])
                things[number] = _Thing(others[0], self._sorts[others[0]])
                return self.domain.words.name(others[0])
            if own.term == self.domain.robot:
                return "your location" if own.located else "you"
            name = self.domain.words.name(own.term)
            return f"{name}'s location" if own.located else name

        text = _SLOT.sub(named, template.raw)
        for said, meant in _ADDRESSED:
            text = re.sub(rf"\b{said}\b", meant, text)
        return re.sub(r"\b(?:if|that) you \w+s\b", lambda found: base(found.group()), text)

    def _with_names(self, words: list[str]) -> list[str]:
        """The words with "her" said as "Sally's", where Sally was named before."""
        possessives = self.domain.words.possessives
        for place, word in enumerate(words):
            if word in possessives.values():
                for own in self._marked(words[:place]):
                    if isinstance(own, _Thing) and possessives.get(own.term) == word:
                        name = _plain(words_of(self.domain.words.name(own.term)))
                        words = [*words[:place], *name[:-1], f"{name[-1]}'s", *words[place + 1 :]]
        return words

    def _mended(self, word: str) -> str:
        if word in self._vocabulary or len(word) < 4 or word.removesuffix("'s") in self._vocabulary:
            return word
        found = process.extractOne(
            word,
            self._vocabulary,
            scorer=DamerauLevenshtein.distance,
            score_cutoff=1 if len(word) < 7 else 2,
        )
        return word if found is None or len(found[0]) < 3 else found[0]

    def _marked(self, words: Sequence[str]) -> list[str | _Thing]:
        """The words with the names in them replaced by the things, the longest first."""
        marked: list[str | _Thing] = []
        place = 0
        while place < len(words):
            for length in range(min(self._longest, len(words) - place), 0, -1):
                term = self._names.get(tuple(words[place : place + length]))
                if term is not None:
                    said = " ".join(words[place : place + length])
                    acts = term == self.domain.robot
                    marked.append(_Thing(term, self._sorts[term], said=said, acts=acts))
                    place += length
                    break
            else:
                located = self._locating(words, place)
                if located is not None:
                    marked.append(located[0])
                    place += located[1]
                else:
                    marked.append(words[place])
                    place += 1
        return marked

    def _locating(self, words: Sequence[str], place: int) -> tuple[_Thing, int] | None:
        """What "Sally's location" and "your location" mean, and how many words they are."""
        for length in range(min(self._longest, len(words) - place - 1), 0, -1):
            if words[place + length] not in (*_LOCATION, *self._located):
                continue
            *before, last = words[place : place + length]
            term = (
                self.domain.robot
                if (*before, last) == ("your",)
                else self._names.get((*before, last.removesuffix("'s")))
            )
            if term is not None:
                return _Thing(term, self._sorts[term], located=True), length + 1
        return None

    def _refusal(
        self, problem: str, marked: Sequence[str | _Thing], nearest: Sequence[str] = ()
    ) -> QuestionError:
        suggested = tuple(nearest or self._nearest(marked))
        return QuestionError(
            f"{problem}; ask for instance: {' · '.join(suggested)}", nearest=suggested
        )

    def _nearest(self, marked: Sequence[str | _Thing]) -> list[str]:
        read = " ".join(own if isinstance(own, str) else _HOLE for own in marked)
        things = [own for own in marked if isinstance(own, _Thing)]

        told = _told(read.split())
        alike = [own for own in self._skeletons if _told(own[1]) == told] if marked else []

        def unlikeness(own: tuple[_Template, list[str]]) -> float:
            return -fuzz.ratio(read, " ".join(own[1]))

        ranked = sorted(alike or self._skeletons, key=unlikeness) if marked else self._skeletons
        texts: dict[str, None] = {}
        asked: set[tuple[Asks, str | None]] = set()
        for template, _ in ranked:
            left = list(things)
            filling = {}
            for slot in template.slots:
                fits = [own for own in left if template.sorts[slot] in own.sorts]
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


def _chosen(
    marked: Sequence[str | _Thing], chosen: Sequence[tuple[int, _Thing]]
) -> Iterator[str | _Thing]:
    """The question with only the chosen things marked; the others are words again."""
    kept = {place for place, _ in chosen}
    for place, own in enumerate(marked):
        if isinstance(own, str) or place in kept:
            yield own
        elif own.acts:
            yield "you"
        else:
            yield own.said or own.term.replace("_", " ")


def _differ(asked: Query, other: Query) -> bool:
    """Whether two queries are about different things, none of which was only left open."""
    if asked.predicate != other.predicate:
        return True
    pairs = list(zip(asked.arguments, other.arguments, strict=True))
    return any(one != two for one, two in pairs) and all(
        one is None or two is not None for one, two in pairs
    )


def _fits(asks: Asks, read: Sequence[str], skeleton: Sequence[str], alike: float) -> bool:
    if asks is Asks.DID and read[:2] != skeleton[:2]:
        return False
    # A word that the other side lacks may say the opposite: to lose is not to have.
    lacking = [*_lacking(read, skeleton), *_lacking(skeleton, read)]
    if asks in _ACTIONS:
        enough = (alike >= _ALIKE_ACTION and _HOLE in read) or alike >= _ALIKE
        return enough and all(
            any(word in verbs and verbs.intersection(other) for verbs in _VERBS)
            for word, other in lacking
        )
    return alike >= _ALIKE and not lacking


def _lacking(words: Sequence[str], others: Sequence[str]) -> Iterator[tuple[str, Sequence[str]]]:
    """The words that carry meaning and are none of the others, with the others."""
    for word in words:
        if word not in _FREE and max(fuzz.ratio(word, other) for other in others) < _ALIKE:
            yield word, others


def _told(words: Sequence[str]) -> list[str]:
    return sorted(word for word in words if word in _TELLING)


def _plain(words: Sequence[str]) -> list[str]:
    return [
        _HOLE if word == "slot" else _SAME.get(word, word) for word in words if word not in _DROPPED
    ]


def _templates(domain: PlanningDomain) -> Iterator[_Template]:
    for asks, texts in _UNFILLED.items():
        for text in texts:
            yield _Template(asks, text)
    signature = domain.knowledge.signature
    for own in places(domain):
        sorts = signature.predicates[own.predicate].sorts
        if own.single:
            yield _Template(Asks.WHERE, f"where is {{{own.thing}}}", own.predicate, 2, sorts)
        for who in ("what", "who", "what objects", "what things"):
            for text in (f"{who} is", f"{who} do you see", f"{who} did you see"):
                text = f"{text} {own.preposition} {{0}}"
                yield _Template(Asks.CONTENTS, text, arity=1, sorts=(sorts[own.place],))
    for name, predicate in signature.predicates.items():
        if predicate.kind.is_fluent:
            say, deny = _said(domain, name, len(predicate.sorts))
            for text in _asking_which(say):
                yield _Template(Asks.WHICH, text, name, len(predicate.sorts), predicate.sorts)
            for positive, clause in ((True, say), (False, deny)):
                for asks, text in _about_a_fluent(clause, positive):
                    yield _Template(
                        asks, text, name, len(predicate.sorts), predicate.sorts, positive
                    )
        elif predicate.kind is PredicateKind.EXOGENOUS_ACTION:
            table = domain.words.actions.get(name)
            for asks, text in _if_it_happened(None, table):
                yield _Template(asks, text, name, len(predicate.sorts), predicate.sorts)
        elif predicate.kind is PredicateKind.ACTION:
            table = domain.words.actions.get(name)
            do = (table.do or table.did) if table else f"{_words(name)} {_all(predicate.sorts)}"
            for asks, beginning in (
                (Asks.WHY_DID, "why did you"),
                (Asks.WHY_NOT, "why did you not"),
                (Asks.WHY_NOT, "why do you not"),
                (Asks.WHY_NOT, "why not"),
                (Asks.DID, "did you"),
            ):
                yield _Template(
                    asks, f"{beginning} {do}", name, len(predicate.sorts), predicate.sorts
                )
            for asks, text in (
                (Asks.WHY_DID, f"why are you {gerund(do)}"),
                (Asks.DID, f"have you {table.did if table else do}"),
                *((Asks.DID, f"{start} {part}") for start, part in _less(do, table)),
                *((Asks.WHY_DID, short) for short in _elliptical(do)),
                *_if_it_happened(do, table),
            ):
                yield _Template(asks, text, name, len(predicate.sorts), predicate.sorts)


def _elliptical(do: str) -> Iterator[str]:
    """What is asked with the place of an action alone: "why on the table"."""
    found = re.fullmatch(r".* ([a-z]+ \{\d+\})", do)
    if found:
        yield f"why {found.group(1)}"


def _less(do: str, table: ActionTable | None) -> Iterator[tuple[str, str]]:
    """What is done without the last of what it is done to: "deliver the message"."""
    for start, text in (("did you", do), ("have you", table.did if table else do)):
        found = re.fullmatch(r"(.*\{\d+\}) [a-z ]+ \{\d+\}", text)
        if found:
            yield start, found.group(1)


def _if_it_happened(do: str | None, table: ActionTable | None) -> Iterator[tuple[Asks, str]]:
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
            yield Asks.WHAT_IF, f"{beginning} {clause}"


def _asking_which(clause: str) -> Iterator[str]:
    """Questions for what a clause ends or begins with: "what does Bob have", "what is closed"."""
    words = clause.split()
    slots = [place for place, word in enumerate(words) if _SLOT.fullmatch(word)]
    if slots == [0]:
        yield " ".join(["what", *words[1:]])
    elif slots == [0, len(words) - 1] and words[1] not in ("is", "are"):
        _, asked, *verb = question_form(" ".join(words[:-1])).split()
        yield " ".join(["what does", asked, *verb])
        if verb != ["have"]:
            yield " ".join(["what is", asked, gerund(" ".join(verb))])


def gerund(do: str) -> str:
    """Return what is to be done as what somebody is doing; of regular verbs.

    Examples
    --------
    >>> gerund("move to {1}"), gerund("put {1} on {2}"), gerund("pick up {1}")
    ('moving to {1}', 'putting {1} on {2}', 'picking up {1}')
    """
    verb, *rest = do.split(" ")
    if verb.endswith("e") and not verb.endswith("ee"):
        verb = verb[:-1]
    elif re.fullmatch("[^aeiou]*[aeiou][^aeiouwxy]", verb):
        verb += verb[-1]
    return " ".join([f"{verb}ing", *rest])


def _about_a_fluent(clause: str, positive: bool) -> Iterator[tuple[Asks, str]]:
    asked = question_form(clause)
    if positive or not re.search(r"\b(not|no)\b", clause):
        yield Asks.IS, asked
        yield Asks.IS, f"is it so that {clause}"
    if positive or not re.search(r"\b(not|no)\b", clause):
        # "is Sally not in the kitchen" asks what "is Sally in the kitchen" does.
        auxiliary, *rest = asked.split()
        for place in (0, 1):
            if place < len(rest) and auxiliary != "is it":
                yield Asks.IS, " ".join([auxiliary, *rest[:place], "not", *rest[place:]])
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


def question_form(clause: str) -> str:
    """Turn a clause into a question.

    Examples
    --------
    >>> question_form("{0} is in {1}"), question_form("{0} holds {1}")
    ('is {0} in {1}', 'does {0} hold {1}')
    """
    words = clause.split()
    for place, word in enumerate(words):
        if word in ("is", "are", "can", "was"):
            return " ".join([word, *words[:place], *words[place + 1 :]])
    after = next((n for n, word in enumerate(words) if _SLOT.fullmatch(word)), 0) + 1
    if after >= len(words):
        return f"is it so that {clause}"
    verb = "have" if words[after] == "has" else base(words[after])
    return " ".join(["does", *words[:after], verb, *words[after + 1 :]])


def _said(domain: PlanningDomain, name: str, arity: int) -> tuple[str, str]:
    table = domain.words.fluents.get(name)
    if table is not None:
        return table.say, table.deny or f"it is not so that {table.say}"
    slots = " ".join(f"{{{number}}}" for number in range(arity))
    return f"{slots} is {_words(name)}".strip(), f"{slots} is not {_words(name)}".strip()


def _words(name: str) -> str:
    return name.replace("_", " ")


def _all(sorts: Sequence[str]) -> str:
    return " ".join(f"{{{number}}}" for number in range(len(sorts)))
