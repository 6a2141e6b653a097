"""What beliefs and absences rest on without circles: the well-founded part of an answer set.

A belief is founded where an axiom fires whose conditions are founded, or where a default is given
up because of a contradiction that rests on what is founded; an absence is founded where
the opposite is, or where every axiom that could conclude it fails by something founded. Absences
that only wait for each other are founded together: they are an unfounded set (Van Gelder, Ross and
Schlipf, "The well-founded semantics for general logic programs", JACM 1991). They wait only where
an axiom asks for the literal itself: with ``q if not not q`` an answer set chooses. What is left is
settled by no fact: an answer set chooses it, and absences have to be assumed (the assumptions of
off-line justifications: Pontelli, Son and Elkhatib, "Justifications for logic programs under answer
set semantics", TPLP 2009). Where absences do not found it, what was chosen is that a condition of
several literals holds, as with ``q if not not q``; then the condition is assumed. With all absences
and conditions of an answer set it is founded whole: they are all that its reduct takes for granted.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Protocol

from seewhy.knowledge.possible import Belief, Instance
from seewhy.knowledge.settling import JointCondition

_TRIED = 32
"""Of more assumptions, no more are tried to be left out."""

Need = Belief | tuple[JointCondition, bool]
"""What has to be founded: a belief or an absence, or that a condition holds or does not."""

Founded = Collection[Need]
"""What is founded, and the conditions that are assumed."""

Forced = Callable[[Instance], Sequence[frozenset[Belief]]]
"""The contradictions that force an exception, each as the beliefs that it rests on."""


class Beliefs(Protocol):
    """An answer set, as foundations look at it."""

    @property
    def holds(self) -> Collection[str]:
        """The keys of what is believed."""

    def is_seen(self, key: str) -> bool:
        """Whether the picture itself shows something."""

    def is_ruled_out(self, key: str) -> bool:
        """Whether the picture shows that something cannot be: a thing of it is not there."""

    def firing(self, key: str) -> list[Instance]:
        """The instances that conclude a belief."""

    def exceptions(self, key: str) -> list[Instance]:
        """The instances of defaults that were given up so that something is believed."""

    def concluding(self, key: str) -> list[Instance]:
        """The instances that could conclude a literal."""

    def worth(self, key: str) -> int:
        """How readily a literal is told, believed or not, where others would do as well."""

    def needs(self, instance: Instance) -> list[tuple[int, Need, bool]]:
        """What each condition comes to: its place, what has to be founded, whether it holds."""


def opposite(key: str) -> str:
    """Return the key of a literal with the other sign.

    Examples
    --------
    >>> opposite("lean(structure)"), opposite("-lean(structure)")
    ('-lean(structure)', 'lean(structure)')
    """
    return key[1:] if key.startswith("-") else f"-{key}"


class Foundation:
    """What is founded of all that a belief, or an absence, may rest on.

    Parameters
    ----------
    beliefs : Beliefs
    root : Belief
        What is to be explained.
    forced : callable
        The contradictions that force a default to be given up, each as the beliefs that are so
        though it is given up. One is enough; where there are none, nothing else is needed.

    Attributes
    ----------
    assumed : frozenset of Need
        The absences, and the conditions that hold, which have to be assumed so that the root is
        founded; none can be left out.
    """

    def __init__(self, beliefs: Beliefs, root: Belief, forced: Forced) -> None:
        self.beliefs = beliefs
        self.root = root
        self.forced = forced
        self.assumed: frozenset[Need] = frozenset()
        self._stages: dict[frozenset[Belief], dict[Need, int]] = {}
        self._literals: dict[JointCondition, list[Belief]] = {}
        self._rests_on: dict[Belief, list[list[Need]]] = {}
        if root not in self.stages(frozenset()):
            self.assumed = self._assumptions()

    def stages(self, without: frozenset[Belief]) -> Mapping[Need, int]:
        """Return what is founded without some beliefs and absences, each with its stage.

        What has a stage rests on what has a lower one, or, with absences, on absences of the
        same.
        """
        relevant = self.relevant(without)
        if relevant not in self._stages:
            self._stages[relevant] = self._founded(relevant, self.assumed)
        return self._stages[relevant]

    def relevant(self, beliefs: frozenset[Belief]) -> frozenset[Belief]:
        """Those without which something else may not be founded that is founded with them."""
        return beliefs & self._in_circles

    def is_founded(
        self, need: Need, founded: Founded, waits: Collection[Belief] = frozenset()
    ) -> bool:
        """Whether something follows from what is founded or assumed, and absences waited for."""
        if need in founded:
            return True
        if isinstance(need, Belief):
            return need in waits
        condition, holds = need
        return condition.settled_by(self.known(condition, founded, waits), holds) is not None

    def is_forced(self, exception: Instance, founded: Founded) -> bool:
        """Whether what is founded forces a default to be given up, and its conditions hold."""
        conditions = (need for _, need, holds in self.beliefs.needs(exception) if holds)
        if not all(self.is_founded(need, founded) for need in conditions):
            return False
        forced = self.forced(exception)
        return not forced or any(all(belief in founded for belief in beliefs) for beliefs in forced)

    def known(
        self,
        condition: JointCondition,
        founded: Founded,
        waits: Collection[Belief] = frozenset(),
    ) -> dict[str, bool]:
        """What is founded of a condition's literals; what had best be left out stands first.

        An absence that is waited for counts where the condition does not deny the literal.
        """
        return {
            belief.key: belief.holds
            for belief in self.literals(condition)
            if belief in founded or (belief in waits and belief.key not in condition.denied)
        }

    def literals(self, condition: JointCondition) -> Sequence[Belief]:
        """What is so with a condition's literals; what had best be left out stands first."""
        if condition not in self._literals:
            keys = sorted(condition.keys, key=self.beliefs.worth)
            self._literals[condition] = [Belief(key, key in self.beliefs.holds) for key in keys]
        return self._literals[condition]

    def _founded(self, without: frozenset[Belief], assumed: frozenset[Need]) -> dict[Need, int]:
        founded = dict.fromkeys(assumed - without, 0)
        believed = [belief for belief in self._cone if belief.holds and belief not in without]
        absent = [belief for belief in self._cone if not belief.holds and belief not in without]
        stage = 0
        while True:
            before = len(founded)
            while new := [
                belief
                for belief in believed
                if belief not in founded and self._has_support(belief, founded)
            ]:
                stage += 1
                founded.update(dict.fromkeys(new, stage))
            together = {absence for absence in absent if absence not in founded}
            while bare := {
                belief for belief in together if not self._fails(belief, founded, together)
            }:
                together -= bare
            stage += 1
            founded.update(
                dict.fromkeys((absence for absence in absent if absence in together), stage)
            )
            if len(founded) == before:
                return founded

    def _has_support(self, belief: Belief, founded: Founded) -> bool:
        return (
            self.beliefs.is_seen(belief.key)
            or any(
                all(self.is_founded(need, founded) for need in needs)
                for needs in self._instances(belief)
            )
            or any(
                self.is_forced(instance, founded)
                for instance in self.beliefs.exceptions(belief.key)
            )
        )

    def _fails(self, absence: Belief, founded: Founded, together: set[Belief]) -> bool:
        if Belief(opposite(absence.key)) in founded or self.beliefs.is_ruled_out(absence.key):
            return True
        return all(
            any(self.is_founded(need, founded, together) for need in needs)
            for needs in self._instances(absence)
        )

    def _instances(self, belief: Belief) -> Sequence[Sequence[Need]]:
        """What each instance rests on that concludes a belief, or fails by, of an absence."""
        if belief not in self._rests_on:
            conclude = self.beliefs.firing if belief.holds else self.beliefs.concluding
            self._rests_on[belief] = [
                [need for _, need, holds in self.beliefs.needs(instance) if holds is belief.holds]
                for instance in conclude(belief.key)
            ]
        return self._rests_on[belief]

    @cached_property
    def _cone(self) -> dict[Belief, tuple[Belief, ...]]:
        """All that the root may rest on, with what each of it may rest on next."""
        cone: dict[Belief, tuple[Belief, ...]] = {}
        waiting = [self.root]
        while waiting:
            belief = waiting.pop()
            if belief not in cone:
                cone[belief] = tuple(dict.fromkeys(self._next(belief)))
                waiting += reversed(cone[belief])
        return cone

    def _next(self, belief: Belief) -> Iterator[Belief]:
        if belief.holds:
            for exception in self.beliefs.exceptions(belief.key):
                for beliefs in self.forced(exception):
                    yield from sorted(beliefs)
                for _, need, holds in self.beliefs.needs(exception):
                    if holds:
                        yield from self._literals_of(need)
        else:
            if self.beliefs.is_ruled_out(belief.key):
                return
            against = opposite(belief.key)
            if against in self.beliefs.holds:
                yield Belief(against)
                if self.beliefs.is_seen(against):
                    return
        for needs in self._instances(belief):
            for need in needs:
                yield from self._literals_of(need)

    def _literals_of(self, need: Need) -> Sequence[Belief]:
        return (need,) if isinstance(need, Belief) else self.literals(need[0])

    @cached_property
    def _in_circles(self) -> frozenset[Belief]:
        """What rests on a circle and is rested on by one; all circles are in it."""
        forward = {belief: set(rests_on) for belief, rests_on in self._cone.items()}
        backward: dict[Belief, set[Belief]] = {belief: set() for belief in forward}
        for belief, rests_on in forward.items():
            for other in rests_on:
                backward[other].add(belief)
        return frozenset(_peeled(forward, backward) & _peeled(backward, forward))

    def _assumptions(self) -> frozenset[Need]:
        founded = self._founded(frozenset(), frozenset())
        absences = [belief for belief in self._cone if not belief.holds and belief not in founded]
        assumed: list[Need] = [*absences]
        if not self._found_root(assumed):
            assumed = [*self._conditions(), *absences]
        if not self._found_root(assumed):
            return frozenset()
        for left_out in assumed[:_TRIED]:
            fewer = [need for need in assumed if need != left_out]
            if self._found_root(fewer):
                assumed = fewer
        self._stages.clear()
        return frozenset(assumed)

    def _found_root(self, assumed: Collection[Need]) -> bool:
        """Whether the root is founded where some absences and conditions are assumed."""
        return self.root in self._founded(frozenset(), frozenset(assumed))

    def _conditions(self) -> list[Need]:
        """The conditions of several literals that hold, of what fired for all that is believed."""
        fired = (
            instance
            for belief in self._cone
            if belief.holds
            for instances in (self.beliefs.firing, self.beliefs.exceptions)
            for instance in instances(belief.key)
        )
        conditions = (
            need
            for instance in fired
            for _, need, holds in self.beliefs.needs(instance)
            if holds and not isinstance(need, Belief)
        )
        return list(dict.fromkeys(conditions))


def _peeled(
    graph: Mapping[Belief, set[Belief]], reversed_graph: Mapping[Belief, set[Belief]]
) -> set[Belief]:
    """What is left of a graph when what leads nowhere is taken away again and again."""
    left = {belief: len(leads_to) for belief, leads_to in graph.items()}
    ends = [belief for belief, count in left.items() if not count]
    for end in ends:
        for other in reversed_graph[end]:
            left[other] -= 1
            if not left[other]:
                ends.append(other)
    return set(graph) - set(ends)
