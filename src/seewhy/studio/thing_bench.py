"""What the page Label shows of the things in one picture: boxes, and what is said of one."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from seewhy.data.thing import BoundingBox
from seewhy.domain.things import SEEN, Relation, Things
from seewhy.new_domain.words import plain_words
from seewhy.studio.drawn_things import DrawnThing, PictureThings
from seewhy.studio.thing_writing import said_first
from seewhy.studio.workbench import RESERVED, Question, letters_of, question

__all__ = ["RelationQuestion", "ShownThing", "ThingBench", "To", "thing_bench"]

_AFTER = {None: "yes", True: "no", False: "open"}
"""What is said of a relation → what a press says next."""

_KEYS = tuple("123456789")
"""Keys of other things; 0 says that the relation holds to no other."""


@dataclass(frozen=True)
class ShownThing:
    """A thing in the picture.

    Attributes
    ----------
    name : str
    words : str
        What is said of it so far.
    box : BoundingBox or None
    lacks : int
        Features of which nothing is said.
    """

    name: str
    words: str
    box: BoundingBox | None
    lacks: int


@dataclass(frozen=True)
class To:
    """Another thing, to which a relation may hold.

    Attributes
    ----------
    thing : ShownThing
    key : str
        The key that says so; empty behind the ninth.
    holds : bool or None
        What somebody said.
    after : str
        ``yes``, ``no`` or ``open``: what a press says.
    """

    thing: ShownThing
    key: str
    holds: bool | None
    after: str


@dataclass(frozen=True)
class RelationQuestion:
    """To which others a relation holds.

    Attributes
    ----------
    name : str
    before, behind : str
        The words around the other thing.
    key : str
        The letter that leads to it.
    to : tuple of To
    """

    name: str
    before: str
    behind: str
    key: str
    to: tuple[To, ...]

    @property
    def is_open(self) -> bool:
        """Whether nothing is said of some."""
        return any(pair.holds is None for pair in self.to)


@dataclass(frozen=True)
class ThingBench:
    """All that is shown of the things in one picture.

    Attributes
    ----------
    one, many : str
        The nouns for them.
    most : int
        So many may be drawn.
    size : tuple of (int, int) or None
        Width and height of the picture in its own pixels; None where it cannot be read.
    things : tuple of ShownThing
    chosen : ShownThing or None
        The one that keys speak of.
    questions : tuple of Question
        Of the chosen one.
    relations : tuple of RelationQuestion
    at : str
        The question or relation that number keys speak of.
    none : bool
        Whether somebody said that there are none.
    """

    one: str
    many: str
    most: int
    size: tuple[int, int] | None
    things: tuple[ShownThing, ...]
    chosen: ShownThing | None = None
    questions: tuple[Question, ...] = ()
    relations: tuple[RelationQuestion, ...] = ()
    at: str = ""
    none: bool = False


def thing_bench(
    here: PictureThings,
    things: Things,
    *,
    size: tuple[int, int] | None,
    chosen: str = "",
    at: str = "",
) -> ThingBench:
    """Return what is shown of the things in a picture.

    Parameters
    ----------
    here : PictureThings
    things : Things
    size : tuple of (int, int) or None
        Width and height of the picture.
    chosen : str
        The name of the thing that keys speak of; none where there is no such thing.
    at : str
        The question at hand; the first that is open where it is none.
    """
    shown = {name: _shown(thing, things) for name, thing in here.things.items()}
    bench = ThingBench(
        things.one, things.many, things.most, size, tuple(shown.values()), none=here.none
    )
    if chosen not in shown:
        return bench
    said = here.things[chosen].values
    seen = {key: relation for key, relation in things.relations.items() if relation.measure == SEEN}
    letters = letters_of([*things.features, *seen], taken=RESERVED)
    questions = tuple(
        question(key, feature.name, feature.values, key=letters[key], label=said.get(key))
        for key, feature in things.features.items()
    )
    others = [thing for name, thing in shown.items() if name != chosen]
    relations = tuple(
        _relation(key, relation, letters[key], chosen, others, here, things)
        for key, relation in seen.items()
    )
    relations = relations if others else ()
    return replace(
        bench,
        chosen=shown[chosen],
        questions=questions,
        relations=relations,
        at=_at_hand(at, questions, relations),
    )


def _at_hand(
    at: str, questions: Collection[Question], relations: Collection[RelationQuestion]
) -> str:
    """The one that is asked for, else the first that is open, else the first."""
    names = [*(question.name for question in questions), *(relation.name for relation in relations)]
    if at in names:
        return at
    open_ones = [question.name for question in questions if question.label is None]
    open_ones += [relation.name for relation in relations if relation.is_open]
    return next(iter((*open_ones, *names)), "")


def _shown(thing: DrawnThing, things: Things) -> ShownThing:
    words = []
    for key, feature in things.features.items():
        label = thing.values.get(key)
        if label is None:
            continue
        if set(feature.values) <= {"yes", "no"}:
            words.append(feature.name if label.value == "yes" else f"not {feature.name}")
        else:
            words.append(plain_words(label.value))
    lacks = sum(key not in thing.values for key in things.features)
    return ShownThing(thing.name, " ".join(words), thing.box, lacks)


def _relation(
    key: str,
    relation: Relation,
    letter: str,
    chosen: str,
    others: list[ShownThing],
    here: PictureThings,
    things: Things,
) -> RelationQuestion:
    before, _, behind = relation.say.replace("{0}", chosen).partition("{1}")
    # Where things are called 1, 2, 3, their names are their keys; else their places are.
    by_name = all(other.name in _KEYS for other in others)
    to = []
    for place, other in enumerate(others):
        number = other.name if by_name else "".join(_KEYS[place : place + 1])
        holds = here.related.get(said_first((key, chosen, other.name), things))
        to.append(To(other, number, holds, _AFTER[holds]))
    return RelationQuestion(key, before.strip(), behind.strip(), letter, tuple(to))
