"""Answer what is believed at a step of a run, and why."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import clingo

from seewhy.knowledge.ground import complement_of, fluent_of
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.dialogue.belief_reason import Beliefs, tell
from seewhy.planning.dialogue.hypothetical_history import known_at
from seewhy.planning.dialogue.location_fluents import Place, place_of, places, whereabouts
from seewhy.planning.dialogue.location_fluents import contents as whats_at
from seewhy.planning.dialogue.place_description import describe_place, say_counted
from seewhy.planning.dialogue.query import Query, Told
from seewhy.planning.dialogue.surface_realisation import Speech, sentences
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Run
from seewhy.planning.planner.mutex import mutexes
from seewhy.text.predicate_words import past


class BeliefAnswers:
    """The answers about what is believed; each with its reasons as values for JSON.

    Examples
    --------
    >>> from seewhy.planning.dialogue.question_parsing import PlanningQuestions
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> run = Run(read_goal("loc(rob1, kitchen)", domain.knowledge), domain.history)
    >>> query = PlanningQuestions(domain).understand("is the kitchen open?")
    >>> BeliefAnswers(domain, run).is_so(query)[0]
    'Yes, the kitchen is open. That is usual: "doors are open".'
    """

    def __init__(self, domain: PlanningDomain, run: Run) -> None:
        self.domain = domain
        self.run = run
        self.speech = Speech(domain.words)

    def is_so(self, query: Query) -> Told:
        """Whether something is so, with the reason."""
        beliefs, step = self._beliefs(query)
        before: list[str] = []
        if query.whose is not None:
            thing = query.arguments[query.whose] or ""
            place = self._place_of(thing, beliefs, step)
            if place is None:
                return self._unknown_place(thing, beliefs, step)
            before = [self._saying(step)(place[0])]
            query = replace(
                query,
                whose=None,
                arguments=tuple(
                    place[1] if n == query.whose else argument
                    for n, argument in enumerate(query.arguments)
                ),
            )
        literal = query.symbol()
        known = self._known(literal, beliefs, step)
        reasons: dict[str, Any] = {"literal": str(literal), "believed": None}
        if known is None:
            return sentences([*before, *self._not_known(literal, beliefs, step)]), reasons
        yes = "yes" if known == literal else "no"
        if yes == "no":
            known = instead_of(self.domain, known, beliefs.diagnosis.states[step])
        reasons |= {"believed": yes == "yes", "why": beliefs.why(known, step).to_dict()}
        counted = say_counted(beliefs, known, step)
        if counted is not None:
            seen = [
                text
                for argument in known.arguments
                if self._is_place(str(argument))
                for text in describe_place(beliefs, str(argument), step, named=bool(before))
            ]
            counted = counted if step == self.run.history.last_step else past(counted)
            if not (before or seen):
                counted = f"{yes}, {counted}"
            return sentences([*before, *seen, counted]), reasons
        said = f"{yes}, {self._saying(step)(known)}"
        return sentences([*before, said, *self._because(known, beliefs, step)]), reasons

    def _saying(self, step: int) -> Callable[[clingo.Symbol], str]:
        """How literals of a step are said: what is past in the past tense."""
        return self.speech.say if step == self.run.history.last_step else self.speech.said

    def which(self, query: Query) -> Told:
        """Of what something is believed: what somebody has, what is closed."""
        beliefs, step = self._beliefs(query)
        found = [
            literal
            for literal in beliefs.positive(query.predicate, step)
            if all(
                asked in (None, str(argument))
                for asked, argument in zip(query.arguments, literal.arguments, strict=True)
            )
        ]
        reasons = {"literals": [str(literal) for literal in found]}
        if not found:
            return sentences([f"{none_of(query.text)} that I know of"]), reasons
        now = step == self.run.history.last_step
        return sentences([(self.speech.every if now else self.speech.every_past)(found)]), reasons

    def why_disbelieve(self, query: Query) -> Told:
        """Why something is not believed, where it is not."""
        query = self._when_it_mattered(replace(query, positive=not query.positive))
        denied = replace(query, positive=not query.positive)
        beliefs, step = self._beliefs(query)
        literal = denied.symbol()
        if not beliefs.holds(literal, step):
            return self.why_believe(query)
        why = beliefs.why(literal, step)
        reasons = {"literal": str(literal), "believed": True, "why": why.to_dict()}
        said = f"but I do believe that {self.speech.say(literal)}"
        if step != self.run.history.last_step:
            said = f"but at step {step} I did believe that {self.speech.said(literal)}"
        return sentences([said, *self._because(literal, beliefs, step)]), reasons

    def _when_it_mattered(self, query: Query) -> Query:
        """A question for a past belief, at the last step at which it was there to act on."""
        if query.step is not None or not query.past:
            return query
        literal = query.symbol()
        acting = [step for step in self.run.steps if step.action is not None]
        held = [step.number for step in acting if literal in step.believed.holds]
        return replace(query, step=held[-1]) if held else query

    def why_believe(self, query: Query) -> Told:
        """Why something is believed."""
        query = self._when_it_mattered(query)
        beliefs, step = self._beliefs(query)
        literal = query.symbol()
        known = self._known(literal, beliefs, step)
        if known is None:
            return sentences(self._not_known(literal, beliefs, step)), {"literal": str(literal)}
        why = beliefs.why(known, step)
        reasons = {"literal": str(literal), "believed": known == literal, "why": why.to_dict()}
        counted = say_counted(beliefs, known, step)
        because = [counted] if counted else self._because(known, beliefs, step)
        believe = f"I believe that {self.speech.say(known)}"
        not_that = "I do not believe that"
        if step != self.run.history.last_step:
            believe = f"at step {step} I believed that {self.speech.said(known)}"
            not_that = f"at step {step} I did not believe that"
        if known != literal:
            return sentences([f"{not_that}; {believe}", *because]), reasons
        first = "" if counted else believe
        return sentences([first, *because]), reasons

    def where(self, query: Query) -> Told:
        """Where a thing is."""
        beliefs, step = self._beliefs(query)
        thing = next(argument for argument in query.arguments if argument is not None)
        place = self._place_of(thing, beliefs, step)
        if place is None:
            return self._unknown_place(thing, beliefs, step)
        literal = place[0]
        reasons = {"literal": str(literal), "why": beliefs.why(literal, step).to_dict()}
        said = [self._saying(step)(literal), *self._because(literal, beliefs, step)]
        return sentences(said), reasons

    def contents(self, query: Query) -> Told:
        """What is at a place."""
        beliefs, step = self._beliefs(query)
        place = query.arguments[0] or ""
        found = whats_at(self.domain, beliefs.diagnosis.states[step], place)
        single = {fluent.predicate for fluent in places(self.domain) if fluent.single}
        who = self.speech.every(literal for literal in found if literal.name in single)
        described = describe_place(beliefs, place, step, named=bool(who))
        if query.text.startswith("who "):
            # Whoever is there is what can be at one place only.
            found = [literal for literal in found if literal.name in single]
            described = []
        said = [who, *described] if found else [self._nothing(place, beliefs, step, query)]
        return sentences(said), {"literals": [str(literal) for literal in found]}

    def _nothing(self, place: str, beliefs: Beliefs, step: int, query: Query) -> str:
        fluents = [fluent for fluent in places(self.domain) if self._can_be_at(fluent, place)]
        where = " or ".join(dict.fromkeys(fluent.preposition for fluent in fluents))
        looked = any(
            at <= step and str(seen.arguments[other.place]) == place
            for seen, at in beliefs.observations
            for other in places(self.domain)
            if seen.name == other.predicate
        )
        nothing = none_of(query.text)
        said = f"I know of {nothing} {where} {self.speech.name(place)}"
        return said if looked else f"{said}; I have not looked there"

    def _because(self, literal: clingo.Symbol, beliefs: Beliefs, step: int) -> list[str]:
        return reason_told(beliefs, literal, step, now=self.run.history.last_step)

    def _beliefs(self, query: Query) -> tuple[Beliefs, int]:
        history = known_at(self.run.history, query.step)
        beliefs = Beliefs(self.domain, history)
        return beliefs, history.last_step if query.step is None else query.step

    def _known(self, literal: clingo.Symbol, beliefs: Beliefs, step: int) -> clingo.Symbol | None:
        sides = (literal, complement_of(literal))
        return next((side for side in sides if beliefs.holds(side, step)), None)

    def _not_known(self, literal: clingo.Symbol, beliefs: Beliefs, step: int) -> list[str]:
        said = self.speech.say(fluent_of(literal))
        if literal.name not in self.speech.words.fixed:
            return [
                f"I do not know whether {said}: I have not seen it, and nothing that I know tells"
            ]
        # What is known of the first thing instead: where else somebody works.
        others = [
            other
            for other in beliefs.positive(literal.name, step)
            if len(other.arguments) > 1 and other.arguments[0] == literal.arguments[0]
        ]
        only = [f"I only know that {self.speech.every(others)}"] if others else []
        return [f"not as far as I know: nothing tells me that {said}", *only]

    def _place_of(
        self, thing: str, beliefs: Beliefs, step: int
    ) -> tuple[clingo.Symbol, str] | None:
        state = beliefs.diagnosis.states[step]
        literal, place = whereabouts(self.domain, state, thing), place_of(self.domain, state, thing)
        return None if literal is None or place is None else (literal, place)

    def _unknown_place(self, thing: str, beliefs: Beliefs, step: int) -> Told:
        is_me = thing == self.domain.robot
        where = "I am" if is_me else f"{self.speech.name(thing)} is"
        ruled_out = [
            literal
            for fluent in places(self.domain)
            if fluent.single
            for literal in sorted(beliefs.diagnosis.states[step].holds)
            if literal.name == fluent.predicate
            and not literal.positive
            and str(literal.arguments[fluent.thing]) == thing
        ]
        said = [f"I do not know where {where}"]
        if ruled_out:
            said.append(f"I only know that {self.speech.every(ruled_out)}")
        return sentences(said), {"ruled_out": [str(literal) for literal in ruled_out]}

    def _is_place(self, term: str) -> bool:
        return any(self._can_be_at(fluent, term) for fluent in places(self.domain))

    def _can_be_at(self, fluent: Place, term: str) -> bool:
        """Whether things can be at a place in the way of a fluent: in a room, on a shelf."""
        signature = self.domain.knowledge.signature
        return term in signature.members(signature.predicates[fluent.predicate].sorts[fluent.place])


def none_of(question: str) -> str:
    """What there is none of: nobody, nowhere, or nothing.

    Examples
    --------
    >>> none_of("who works in the kitchen")
    'nobody'
    """
    return {"who": "nobody", "where": "nowhere"}.get(question.split()[0], "nothing")


def reason_told(beliefs: Beliefs, literal: clingo.Symbol, step: int, *, now: int) -> list[str]:
    """The reason of a belief as clauses, after the belief itself; ``now`` is the present step."""
    said = beliefs.speech.say(literal)
    told = tell(beliefs.why(literal, step), beliefs.speech, now=now)
    return [clause.replace(f"it is usual that {said}", "that is usual") for clause in told]


def because(beliefs: Beliefs, literal: clingo.Symbol, step: int, *, now: int) -> list[str]:
    """The reason of a belief as clauses, or what is counted for it."""
    counted = say_counted(beliefs, literal, step)
    if counted is None:
        return reason_told(beliefs, literal, step, now=now)
    return [counted if step == now else past(counted)]


def instead_of(domain: PlanningDomain, denied: clingo.Symbol, state: State) -> clingo.Symbol:
    """What is so in a state instead of something that is not, where only one of them can be."""
    if denied.positive:
        return denied
    for mutex in mutexes(domain.knowledge):
        for literal in state.positive(mutex.predicate):
            if mutex.predicate == denied.name and all(
                one == other or place == mutex.position
                for place, (one, other) in enumerate(
                    zip(literal.arguments, denied.arguments, strict=True)
                )
            ):
                return literal
    return denied
