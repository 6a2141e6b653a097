"""The smallest change of a scene after which a question has another answer.

Changes are looked for in order of how many there are: another value of a thing, another place, a
relation that holds or not, one thing less, one more. What a question does not speak of cannot
change its answer, and is left as it is; so the search is exact, within its bound. A scene that
contradicts the knowledge is none that there could be.

:mod:`seewhy.knowledge.change` looks for the smallest change, too, but of other things: it wants a
literal believed of a scene's features, and asks the reasoner of every candidate. What is wanted
here is an answer, a number or a colour, for which the knowledge has no literal; changes are moves
in an order besides; and a question is put to a scene without an answer set.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import comb

from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.things.edits import Add, Edit, edited, scene_after
from seewhy.dialogue.things.evaluating import Evaluation, UnclearReferenceError
from seewhy.dialogue.things.fixing import fixed
from seewhy.dialogue.things.outcome import Value, outcome_of
from seewhy.dialogue.things.possible_edits import are_apart, possible_edits
from seewhy.dialogue.things.query import Query
from seewhy.dialogue.things.saying_edits import say_edit
from seewhy.dialogue.things.wording import ThingWords
from seewhy.domain.things import Things

__all__ = ["Found", "smallest_change"]

MOST_LOOKED_AT = 30_000
"""Changed scenes that are looked at."""
MOST_CONCLUDED = 1_000
"""Changed scenes of which it is concluded anew what follows."""
MOST_CHANGES = 3


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


def smallest_change(query: Query, aim: Value, words: ThingWords) -> Found:
    """Return the smallest change after which a query comes to what is wanted.

    Where the number of changes that are possible is beyond :data:`MOST_LOOKED_AT`, only smaller
    ones are looked for, and ``looked_at`` says up to how many.
    """
    scene, things = words.evaluation.scene, words.things
    query = fixed(query, words.evaluation)
    possible = possible_edits(query, scene, things)
    most = MOST_CONCLUDED if possible.concluded else MOST_LOOKED_AT
    plain, additions = possible.plain, possible.additions or ()
    left_out = possible.additions is None
    looked_at = 0
    for size in range(1, MOST_CHANGES + 1):
        more = comb(len(plain), size - 1) * len(additions)
        if more and looked_at + comb(len(plain), size) + more > most:
            more, additions, left_out = 0, (), True
        looked_at += comb(len(plain), size) + more
        if looked_at > most:
            return Found(None, looked_at=size - 1, without_additions=left_out)
        reaching: list[tuple[Edit, ...]] = []
        for edits in _together(plain, additions, size):
            if not are_apart(edits):
                continue
            changed, without = (
                scene_after(scene, things, edits)
                if possible.concluded
                else edited(scene, things, edits)
            )
            if _reaches(query, aim, Evaluation(changed, things, without=without)) and (
                changed.consistent or not scene.consistent
            ):
                reaching.append(edits)
        if not possible.concluded:
            reaching = _that_can_be(reaching, scene, things)
        if reaching:
            first = reaching[0]
            said = tuple(say_edit(edit, words) for edit in first)
            return Found(said, len(reaching) - 1, size, first, left_out)
    return Found(None, looked_at=MOST_CHANGES, without_additions=left_out)


def _that_can_be(
    reaching: Sequence[tuple[Edit, ...]], scene: ThingScene, things: Things
) -> list[tuple[Edit, ...]]:
    """Those changes that do not contradict the knowledge, of as many as can be looked at."""
    if scene.conclusions is None or not scene.consistent:
        return list(reaching)
    some = reaching[:MOST_CONCLUDED]
    return [edits for edits in some if scene_after(scene, things, edits)[0].consistent]


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
