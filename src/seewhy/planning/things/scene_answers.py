"""Questions about the things of a run, answered of the scene as it is believed to be now."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import permutations
from typing import TYPE_CHECKING, Any

import clingo

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.dialogue.question_words import words_of
from seewhy.dialogue.things.answering import ThingAnswerer, ThingReply
from seewhy.domain.things import CONCLUDED
from seewhy.errors import QuestionError
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.things.initial_scene import SceneOfPlan

if TYPE_CHECKING:
    from seewhy.planning.dialogue.run_view import RunView

__all__ = ["SceneAnswer", "SceneAnswers", "believed_scene"]


@dataclass(frozen=True)
class SceneAnswer:
    """An answer about things, with what it rests on as values that JSON can hold."""

    text: str
    reasons: dict[str, Any] = field(default_factory=dict)


_OF_ANOTHER_TIME = frozenset({"was", "were", "had", "did", "been", "will", "shall"})
_Atom = tuple[str, ...]
"""A predicate with its arguments."""


@dataclass(frozen=True)
class _Believed:
    """What holds in a state, what does not, and what is open."""

    holds: frozenset[_Atom]
    denied: frozenset[_Atom]
    unknown: frozenset[_Atom]

    @classmethod
    def of(cls, state: State) -> _Believed:
        return cls(
            frozenset(_atom(literal) for literal in state.holds if literal.positive),
            frozenset(_atom(literal) for literal in state.holds if not literal.positive),
            frozenset(map(_atom, state.unknown)),
        )


def _atom(literal: clingo.Symbol) -> _Atom:
    return (literal.name, *map(str, literal.arguments))


def believed_scene(at_first: SceneOfPlan, state: State) -> ThingScene:
    """Return the scene of a state: what is seen may have changed, and follows anew.

    What was measured in the picture is told of no thing that has come to stand elsewhere since.

    Examples
    --------
    >>> import clingo
    >>> from seewhy.planning.domain import load_planning_domain
    >>> at_first = load_planning_domain("tabletop").at_first
    >>> state = State(frozenset({clingo.parse_term("on(thing1,thing2)")}))
    >>> believed_scene(at_first, state).related["on"]
    (0, 1, 0, 0, 0, 0)
    """
    things, scene = at_first.things, at_first.scene
    believed = _Believed.of(state)
    holds, open_ = believed.holds, believed.unknown
    spoken_of = {name for name, *_ in holds | believed.denied | open_}
    pairs = list(permutations(range(scene.count), 2))
    values = [
        {key: _value(at_first, key, number, believed) for key in things.features}
        for number in range(scene.count)
    ]
    relations: dict[str, list[tuple[int, int]]] = {}
    unknown: dict[str, list[tuple[int, int]]] = {}
    moved = _moved(at_first, holds)
    for key, relation in things.relations.items():
        if relation.measure == CONCLUDED or relation.converse in relations:
            continue
        if key in spoken_of:
            named = {(n, to): (key, at_first.term(n), at_first.term(to)) for n, to in pairs}
            relations[key] = [pair for pair, atom in named.items() if atom in holds]
            unknown[key] = [pair for pair, atom in named.items() if atom in open_]
            continue
        here = [(n, to) for n, to in pairs if not {n, to} & moved]
        relations[key] = [(n, to) for n, to in here if scene.related[key][to] >> n & 1]
        unknown[key] = [
            (n, to)
            for n, to in pairs
            if {n, to} & moved or (key in scene.unknown and scene.unknown[key][to] >> n & 1)
        ]
    found = thing_scene(things, values, relations=relations, not_known=unknown, image=scene.image)
    return at_first.conclusions.conclude(found)


def _value(at_first: SceneOfPlan, key: str, number: int, state: _Believed) -> str | None:
    """A feature's value now, where it is one that changes; else as it was seen."""
    here = (key, at_first.term(number))
    for atom in state.holds:
        if atom[:2] == here:
            return atom[2] if len(atom) > 2 else "yes"
    if here in state.denied:
        return "no"
    seen = at_first.scene.values[key][number]
    is_open = any(atom[:2] == here for atom in state.unknown)
    return None if is_open or (*here, seen) in state.denied else seen


def _moved(at_first: SceneOfPlan, holds: frozenset[_Atom]) -> set[int]:
    """The things that stand on something else than in the picture, or are held."""
    support, scene = at_first.things.support, at_first.scene
    if support is None:
        return set()
    moved = set()
    for number, to in permutations(range(scene.count), 2):
        stood = bool(scene.related[support][to] >> number & 1)
        if stood is not ((support, at_first.term(number), at_first.term(to)) in holds):
            moved.add(number)
    return moved


class SceneAnswers:
    """Answers about the things of a run, one conversation.

    Parameters
    ----------
    at_first : SceneOfPlan
    view : RunView
    """

    def __init__(self, at_first: SceneOfPlan, view: RunView) -> None:
        self.at_first = at_first
        self.view = view
        self._answerer = ThingAnswerer(at_first.things)
        self._scene: ThingScene | None = None
        self._before: ThingReply | None = None

    @property
    def scene(self) -> ThingScene:
        """The scene as it is believed to be now."""
        if self._scene is None:
            state = self.view.believed(self.view.run.history.last_step)
            self._scene = believed_scene(self.at_first, state)
        return self._scene

    def forget(self) -> None:
        """Let "why?" no longer go with the answer before."""
        self._before = None

    def answer(self, question: str, *, instead_of: QuestionError) -> SceneAnswer:
        """Return the answer of a question about things.

        Raises
        ------
        QuestionError
            ``instead_of``, if it is not understood as one either.
        """
        words = set(words_of(question))
        if words & _OF_ANOTHER_TIME and "if" not in words:
            raise instead_of  # the scene is as it is now
        try:
            reply = self._answerer.answer(question, self.scene, previous=self._before)
        except QuestionError:
            raise instead_of from None
        self._before = reply
        told = reply.to_dict()
        return SceneAnswer(
            reply.text, {"answer": told["answer"], "justification": told["justification"]}
        )
