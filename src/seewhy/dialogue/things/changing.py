"""The smallest change of a scene after which a question has another answer.

Changes are looked for in order of how many there are: another value of a thing, another place, a
relation that holds or not, one thing less, one more. What a question does not speak of cannot
change its answer, and is left as it is; so the search is exact, within its bound.

:mod:`seewhy.knowledge.change` looks for the smallest change, too, but of other things: it wants a
literal believed of a scene's features, and asks the reasoner of every candidate. What is wanted
here is an answer, a number or a colour, for which the knowledge has no literal; changes are moves
in an order besides; and a question is put to a scene without an answer set.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from itertools import combinations, product
from math import comb

from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.things.edits import (
    Add,
    Edit,
    Move,
    Recolour,
    Relate,
    Remove,
    edited,
    is_in_order,
    values_to_try,
)
from seewhy.dialogue.things.evaluating import Evaluation, UnclearReferenceError
from seewhy.dialogue.things.outcome import Value, outcome_of
from seewhy.dialogue.things.query import (
    Compares,
    Concluded,
    Corner,
    Description,
    Extreme,
    Groups,
    HasValue,
    MostCommon,
    Occurring,
    PartOf,
    Query,
    Ranked,
    Related,
    SameValue,
    Shares,
    Together,
    ValueOf,
)
from seewhy.dialogue.things.wording import ThingWords
from seewhy.domain.things import CONCLUDED, Things
from seewhy.text.nouns import with_article

__all__ = ["Found", "say_edit", "smallest_change"]

MOST_LOOKED_AT = 30_000
"""Changed scenes that are looked at."""
MOST_CONCLUDED = 250
"""Changed scenes of which it is concluded anew what follows."""
MOST_CHANGES = 3
_MOST_ADDED = 20_000


@dataclass(frozen=True)
class Found:
    """What was found.

    Attributes
    ----------
    changes : tuple of str or None
        Clauses behind "if"; None where no change was found.
    others : int
        How many other changes are as small.
    looked_at : int
        The most changes at once that were all looked at.
    without_additions : bool
        Whether one thing more was not tried, because it might be like too many.
    """

    changes: tuple[str, ...] | None
    others: int = 0
    looked_at: int = 0
    edits: tuple[Edit, ...] = ()
    without_additions: bool = False


@dataclass
class _Spoken:
    """What a question speaks of."""

    values: dict[str, set[str]] = field(default_factory=dict)
    compared: set[str] = field(default_factory=set)
    relations: set[str] = field(default_factory=set)
    concluded: set[str] = field(default_factory=set)

    def read(self, part: object) -> None:
        match part:
            case HasValue(feature=feature, value=value):
                self.values.setdefault(feature, set()).add(value)
            case Shares(feature=feature) | Compares(feature=feature) | Ranked(feature=feature):
                self.compared.add(feature)
            case ValueOf(feature=feature) | SameValue(feature=feature):
                self.compared.add(feature)
            case MostCommon(feature=feature) | Occurring(feature=feature):
                self.compared.add(feature)
            case Related(relation=relation) | Extreme(relation=relation):
                self.relations.add(relation)
            case Corner(relations=relations):
                self.relations.update(relations)
            case Concluded(conclusion=key) | PartOf(group=key):
                self.concluded.add(key)
            case Groups(group=key) | Together(group=key):
                self.concluded.add(key)
        if is_dataclass(part):
            for name in fields(part):
                self.read(getattr(part, name.name))
        elif isinstance(part, tuple):
            for inner in part:
                self.read(inner)

    def resting(self, scene: ThingScene, things: Things) -> None:
        """Take what is concluded for what it rests on."""
        relations = {key for key in self.relations if things.relations[key].measure == CONCLUDED}
        self.concluded |= relations
        self.relations -= relations
        if scene.conclusions is None:
            return
        for key in self.concluded:
            seen = scene.conclusions.rests_on(key)
            self.compared |= seen & set(things.features)
            self.relations |= seen & set(things.relations)


def smallest_change(query: Query, aim: Value, words: ThingWords) -> Found:
    """Return the smallest change after which a query comes to what is wanted.

    Where the number of changes that are possible is beyond :data:`MOST_LOOKED_AT`, only smaller
    ones are looked for, and ``looked_at`` says up to how many.
    """
    scene, things = words.evaluation.scene, words.things
    spoken = _Spoken()
    spoken.read(query)
    spoken.resting(scene, things)
    concluding = scene.conclusions if spoken.concluded else None
    most = MOST_CONCLUDED if concluding else MOST_LOOKED_AT
    tried = dict(values_to_try(things, spoken.values, spoken.compared))
    orders = _one_way(words, {key for key in spoken.relations if is_in_order(scene, key)})
    loose = _one_way(words, {r for r in spoken.relations if not is_in_order(scene, r)})
    plain = [*_edits(scene, tried, orders, loose)]
    full = concluding is not None and scene.count >= things.most
    adding = None if full else _additions(scene, tried, orders, loose)
    additions = [] if adding is None else [*adding]
    left_out = adding is None
    looked_at = 0
    for size in range(1, MOST_CHANGES + 1):
        looked_at += comb(len(plain), size) + comb(len(plain), size - 1) * len(additions)
        if looked_at > most:
            return Found(None, looked_at=size - 1, without_additions=left_out)
        reaching: list[tuple[Edit, ...]] = []
        for edits in _together(plain, additions, size):
            if not _apart(edits):
                continue
            changed, without = edited(scene, things, edits)
            if concluding is not None:
                changed = concluding.conclude(changed, without)
            if _reaches(query, aim, Evaluation(changed, things, without=without)):
                reaching.append(edits)
        if reaching:
            first = reaching[0]
            said = tuple(say_edit(edit, words) for edit in first)
            return Found(said, len(reaching) - 1, size, first, left_out)
    return Found(None, looked_at=MOST_CHANGES, without_additions=left_out)


def _together(
    plain: Sequence[Edit], additions: Sequence[Add], size: int
) -> Iterator[tuple[Edit, ...]]:
    """So many changes at once, of which one at most adds a thing."""
    yield from combinations(plain, size)
    for others in combinations(plain, size - 1):
        for addition in additions:
            yield (*others, addition)


def _reaches(query: Query, aim: Value, evaluation: Evaluation) -> bool:
    try:
        value = outcome_of(query, evaluation).value
    except UnclearReferenceError:
        return False
    return value == aim and isinstance(value, bool) == isinstance(aim, bool)


def _apart(edits: tuple[Edit, ...]) -> bool:
    """Whether changes are of different things or features: nothing is changed twice."""
    touched: set[object] = set()
    removed = {edit.number for edit in edits if isinstance(edit, Remove)}
    for edit in edits:
        match edit:
            case Recolour(number=number, feature=what) | Move(number=number, relation=what):
                key: object = (number, what)
            case Relate(number=number, relation=what, to=to):
                key = (number, what, to)
            case Remove(number=number):
                key = number
            case _:
                key = "add"  # one thing more at a time keeps the search small
        if key in touched or (not isinstance(edit, Remove | Add) and edit.number in removed):
            return False
        touched.add(key)
    return True


def _edits(
    scene: ThingScene, tried: Mapping[str, tuple[str, ...]], orders: list[str], loose: list[str]
) -> Iterator[Edit]:
    for feature, values in tried.items():
        for number in range(scene.count):
            for value in values:
                if scene.values[feature][number] != value:
                    yield Recolour(number, feature, value)
    for relation in orders:
        for number in range(scene.count):
            here = scene.related[relation][number].bit_count()
            for place in range(scene.count):
                if place != here:
                    yield Move(number, relation, place)
    for relation in loose:
        for to in range(scene.count):
            for number in range(scene.count):
                if number != to:
                    holds = not scene.related[relation][to] >> number & 1
                    yield Relate(number, relation, to, holds)
    for number in range(scene.count):
        yield Remove(number)


def _one_way(words: ThingWords, relations: set[str]) -> list[str]:
    """Relations without the converses of others: to move one is to move the other."""
    kept: list[str] = []
    for key, relation in words.things.relations.items():
        if key in relations and relation.converse not in kept:
            kept.append(key)
    return kept


def _additions(
    scene: ThingScene, tried: Mapping[str, tuple[str, ...]], orders: list[str], loose: list[str]
) -> Iterator[Add] | None:
    """The things that may be added; None where there are too many of them to try."""
    features = list(tried)
    places = [range(scene.count + 1) for _ in orders]
    related: list[tuple[tuple[str, int], ...]] = [()]
    related += [((relation, to),) for relation in loose for to in range(scene.count)]
    count = len(related)
    for values in tried.values():
        count *= len(values)
    for place in places:
        count *= len(place)
    if count > _MOST_ADDED:
        return None
    return (
        Add(
            tuple(zip(features, values, strict=True)),
            tuple(zip(orders, where, strict=True)),
            links,
        )
        for values in product(*tried.values())
        for where in product(*places)
        for links in related
    )


def say_edit(edit: Edit, words: ThingWords) -> str:
    """Return a change as a clause behind "if"; ``words`` are those of the scene before it."""
    scene = words.evaluation.scene
    match edit:
        case Recolour(number=number, feature=feature, value=value):
            clause = words.clause(feature, value, words.name(number))
            return clause.replace(f"{words.name(number)} is ", f"{words.name(number)} were ", 1)
        case Move(number=number, relation=relation, place=place):
            return _moved(number, relation, place, words)
        case Relate(number=number, relation=relation, to=to, holds=holds):
            said = words.things.relations[relation].say.format(words.name(number), words.name(to))
            return said if holds else f"it were not so that {said}"
        case Remove(number=number):
            return f"{words.name(number)} were not there"
        case Add(values=values, places=places):
            conditions = tuple(HasValue(feature, value) for feature, value in values)
            one = with_article(words.phrase(Description(conditions), many=False))
            where = [_beside(scene.count, key, place, words) for key, place in places]
            named = dict(edit.related)
            where += [
                words.predicate_of(relation, words.name(to)) for relation, to in named.items()
            ]
            return " ".join([f"there were {one}", *filter(None, where), "as well"])


def _moved(number: int, relation: str, place: int, words: ThingWords) -> str:
    scene = words.evaluation.scene
    rows = scene.related[relation]
    order = sorted(range(scene.count), key=lambda other: rows[other].bit_count())
    order.remove(number)
    here = rows[number].bit_count()
    name = words.name(number)
    if place < here:
        return f"{name} were {words.predicate_of(relation, words.name(order[place]))}"
    converse = words.things.relations[relation].converse
    passed = words.name(order[place - 1])
    if converse is None:
        return f"{name} were not {words.predicate_of(relation, passed)}"
    return f"{name} were {words.predicate_of(converse, passed)}"


def _beside(number: int, relation: str, place: int, words: ThingWords) -> str:
    """Where a new thing is in an order: before the one that it is put in front of."""
    scene = words.evaluation.scene
    rows = scene.related[relation]
    order = sorted(range(scene.count), key=lambda other: rows[other].bit_count())
    if place < number and order:
        return words.predicate_of(relation, words.name(order[place]))
    converse = words.things.relations[relation].converse
    return words.predicate_of(converse, words.name(order[-1])) if converse and order else ""
