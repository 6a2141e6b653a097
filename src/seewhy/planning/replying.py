"""Answer questions about a run: what is believed, what was done, why, and what else could be."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import clingo

from seewhy.errors import PlanningError, QuestionError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import complement_of, key_of, literal_of
from seewhy.knowledge.history import History, Observation
from seewhy.planning.action_reason import Against, Failing, Intentions
from seewhy.planning.asking import Asks, PlanningQuestions, Query
from seewhy.planning.belief_reason import Beliefs, has_sentence, tell
from seewhy.planning.describing import describe_place, say_counted
from seewhy.planning.diagnosis import SurpriseKind, diagnose
from seewhy.planning.execution import Decision, Outcome, Run, Step, execute
from seewhy.planning.following import state_after
from seewhy.planning.instances import Applied
from seewhy.planning.mutex import mutexes
from seewhy.planning.speech import Speech, subjunctive
from seewhy.planning.whereabouts import contents, places, whereabouts
from seewhy.planning_domain import PlanningDomain
from seewhy.wording import join_words, sentence


@dataclass(frozen=True)
class PlanningReply:
    """The answer to a question about a run.

    Attributes
    ----------
    text : str
    query : Query
        The question as it was understood.
    reasons : dict
        What the answer rests on, as values that JSON can hold.
    """

    text: str
    query: Query
    reasons: dict[str, Any] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """Return the reply as values that JSON can hold."""
        return {"text": self.text, "query": self.query.to_dict(), "reasons": self.reasons}


def answer(domain: PlanningDomain, run: Run, question: str) -> PlanningReply:
    """Answer a question in words about a run, as whoever acts in it.

    Parameters
    ----------
    domain : PlanningDomain
    run : Run
        Finished, interrupted or not yet begun.
    question : str
        Such as "why did you move to the kitchen at step 2?". A step is the number of actions
        done before it; what is asked of a step is answered as it was believed then.

    Raises
    ------
    QuestionError
        If the question is not understood, or asks of a step that there is not.

    Examples
    --------
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning_domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> run = Run(read_goal("loc(rob1, kitchen)", domain.knowledge), domain.history)
    >>> print(answer(domain, run, "what is your goal?").text)
    My goal is that I am in the kitchen.
    """
    query = PlanningQuestions(domain).understand(question)
    return _Replying(domain, run).reply(query)


class _Replying:
    """The answers about one run."""

    def __init__(self, domain: PlanningDomain, run: Run) -> None:
        self.domain = domain
        self.run = run
        self.speech = Speech(domain.words)
        self.intentions = Intentions(domain, run)

    def reply(self, query: Query) -> PlanningReply:
        last = self.run.history.last_step
        if query.step is not None and query.step > last:
            raise QuestionError(
                f"there is no step {query.step} yet: the run has come to step {last}; ask about "
                f"step {f'0 to {last}' if last else 0}"
            )
        asked: dict[Asks, Callable[[Query], tuple[str, dict[str, Any]]]] = {
            Asks.IS: self._is,
            Asks.WHERE: self._where,
            Asks.CONTENTS: self._contents,
            Asks.PLAN: self._plan,
            Asks.DONE: self._done,
            Asks.GOAL: self._goal,
            Asks.WHY_DID: self._why_did,
            Asks.WHY_NOT: self._why_not,
            Asks.WHY_BELIEVE: self._why_believe,
            Asks.WHAT_IF: self._what_if,
            Asks.WHY_CHANGED: self._why_changed,
        }
        text, reasons = asked[query.asks](query)
        return PlanningReply(text, query, reasons)

    # Beliefs

    def _is(self, query: Query) -> tuple[str, dict[str, Any]]:
        beliefs, step = self._beliefs(query)
        before: list[str] = []
        if query.whose is not None:
            thing = query.arguments[query.whose] or ""
            place = self._place_of(thing, beliefs, step)
            if place is None:
                return self._unknown_place(thing, beliefs, step)
            before = [self.speech.say(place[0])]
            query = replace(
                query,
                whose=None,
                arguments=tuple(
                    place[1] if n == query.whose else own for n, own in enumerate(query.arguments)
                ),
            )
        literal = query.symbol()
        known = self._known(literal, beliefs, step)
        reasons: dict[str, Any] = {"literal": str(literal), "believed": None}
        if known is None:
            return self._told([*before, self._not_known(literal)]), reasons
        reasons |= {"believed": known == literal, "why": beliefs.why(known, step).to_dict()}
        counted = say_counted(beliefs, known, step)
        if counted is not None:
            seen = [
                text
                for argument in known.arguments
                if self._is_place(str(argument))
                for text in describe_place(beliefs, str(argument), step, named=bool(before))
            ]
            return self._told([*before, *seen, counted]), reasons
        yes = "yes" if known == literal else "no"
        said = f"{yes}: {self.speech.say(known)}"
        return self._told([*before, said, *self._because(known, beliefs, step)]), reasons

    def _why_believe(self, query: Query) -> tuple[str, dict[str, Any]]:
        beliefs, step = self._beliefs(query)
        literal = query.symbol()
        known = self._known(literal, beliefs, step)
        if known is None:
            return self._told([self._not_known(literal)]), {"literal": str(literal)}
        why = beliefs.why(known, step)
        reasons = {"literal": str(literal), "believed": known == literal, "why": why.to_dict()}
        counted = say_counted(beliefs, known, step)
        because = [counted] if counted else tell(why, self.speech)
        if known != literal:
            said = f"I do not believe that; I believe that {self.speech.say(known)}"
            return self._told([said, *because]), reasons
        first = "" if counted else f"I believe that {self.speech.say(known)}"
        return self._told([first, *because]), reasons

    def _where(self, query: Query) -> tuple[str, dict[str, Any]]:
        beliefs, step = self._beliefs(query)
        thing = next(own for own in query.arguments if own is not None)
        place = self._place_of(thing, beliefs, step)
        if place is None:
            return self._unknown_place(thing, beliefs, step)
        literal = place[0]
        reasons = {"literal": str(literal), "why": beliefs.why(literal, step).to_dict()}
        said = [self.speech.say(literal), *self._because(literal, beliefs, step)]
        return self._told(said), reasons

    def _contents(self, query: Query) -> tuple[str, dict[str, Any]]:
        beliefs, step = self._beliefs(query)
        place = query.arguments[0] or ""
        found = contents(self.domain, beliefs.diagnosis.states[step], place)
        single = {own.predicate for own in places(self.domain) if own.single}
        who = self.speech.every(own for own in found if own.name in single)
        described = describe_place(beliefs, place, step, named=bool(who))
        said = [who, *described] if found else [f"I know of nothing in {self.speech.name(place)}"]
        return self._told(said), {"literals": [str(own) for own in found]}

    # Intentions

    def _plan(self, _: Query) -> tuple[str, dict[str, Any]]:
        run = self.run
        if run.outcome is Outcome.ACHIEVED:
            return "I have no plan any more: the goal is reached.", {"actions": []}
        if run.outcome is Outcome.IMPOSSIBLE:
            return self._told([self._gave_up(run.steps[-1])]), {"actions": []}
        step = self._present_step()
        if step.decision is Decision.GIVE_UP:
            return self._told([self._gave_up(step)]), {"actions": []}
        if not step.plan:
            return "I have nothing to do: the goal is reached.", {"actions": []}
        doubt = "This supposes that things have changed since I saw them" if step.doubted else ""
        said = [f"my plan is to {self._do(step.plan)}", doubt]
        return self._told(said), {"actions": [str(own) for own in step.plan]}

    def _done(self, _: Query) -> tuple[str, dict[str, Any]]:
        said: list[str] = []
        events: list[dict[str, Any]] = []
        failed = self._failures()
        did: list[str] = []
        for step in self.run.steps:
            noticed = [self.speech.surprise(own) for own in step.surprises
                       if own.kind is not SurpriseKind.FAILURE]  # fmt: skip
            if noticed:
                said += self._did(did)
                did = []
                said.append(f"at step {step.number} I found that {join_words(noticed)}")
            if step.action is not None:
                events.append({"step": step.number, "action": str(step.action),
                               "failed": (step.number, step.action) in failed})  # fmt: skip
                did.append(
                    f"tried to {self.speech.do(step.action)} and failed"
                    if (step.number, step.action) in failed
                    else self.speech.did(step.action)
                )
        said += self._did(did)
        if not events:
            said.append("I have not done anything yet" if self.run.outcome is None
                        else "I did not do anything")  # fmt: skip
        said.append(self._ended())
        return self._told(said), {"actions": events}

    def _goal(self, _: Query) -> tuple[str, dict[str, Any]]:
        return f"My goal is that {self._goal_said()}.", {"goal": self.run.goal.text}

    def _why_did(self, query: Query) -> tuple[str, dict[str, Any]]:
        done = [own for own in self.run.steps
                if own.action is not None and _fits(query, own.action)]  # fmt: skip
        chosen = [own for own in done if query.step in (None, own.number)]
        if not chosen:
            asked = f"I did not {self._asked(query)}"
            if done:
                when = join_words([str(own.number) for own in done])
                asked = f"{asked} at step {query.step}, but at step {when}"
                return self._told([asked]), {"steps": [own.number for own in done]}
            return self._told([asked]), {"steps": []}
        step = chosen[-1]
        action = step.action
        assert action is not None
        needs = self.intentions.needs(step)
        tried = (step.number, action) in self._failures()
        did = f"tried to {self.speech.do(action)}" if tried else self.speech.did(action)
        beginning = f"I {did} at step {step.number}"
        reasons = {"step": step.number, "action": str(action), "needed_by": self._needs(needs)}
        if not needs:
            return self._told([f"{beginning}, although my plan would have worked without"]), reasons
        wanted = [self.speech.do(own.action) for own in needs if own.action is not None]
        if not wanted:
            return self._told(
                [f"{beginning} because my goal was that {self._goal_said()}"]
            ), reasons
        then = f", in order to {wanted[-1]}" if len(wanted) > 1 else ""
        # What lies between is told by the tree of reasons.
        said = [f"{beginning} because I wanted to {wanted[0]}{then}"]
        obstacle = self._obstacle(needs[0].obstacles)
        if obstacle:
            said.append(f"Without that I could not have done it: {obstacle}")
        return self._told(said), reasons

    def _why_not(self, query: Query) -> tuple[str, dict[str, Any]]:
        step = self._step_asked(query)
        actions = self._actions(query)
        when = f"at step {step.number}"
        found = [(own, self.intentions.why_not(own, step)) for own in actions]
        ranks = list(Against)
        action, why = min(found, key=lambda own: ranks.index(own[1].against))
        if any(own.against is not Against.OBSTACLE for _, own in found):
            action, why = next(own for own in found if own[1].against is not Against.OBSTACLE)
        reasons: dict[str, Any] = {
            "step": step.number,
            "action": str(action),
            "against": why.against.value,
            "obstacles": [_obstacle_dict(own) for own in why.obstacles],
            "actions": [str(own) for own in why.actions],
        }
        do = self.speech.do(action)
        if why.against is Against.DONE:
            return self._told([f"but I did {do} {when}"]), reasons
        if why.against is Against.OBSTACLE:
            obstacle = self._obstacle(why.obstacles)
            could = f"I could not {do} {when}"
            return self._told([f"{could}: {obstacle}" if obstacle else could]), reasons
        if step.decision is Decision.STOP:
            return self._told(["there was nothing left to do: the goal was reached"]), reasons
        if why.against is Against.NO_PLAN:
            return self._told([f"I could have, but had I {self._had(action)} {when}, the goal "
                               "could not have been reached any more"]), reasons  # fmt: skip
        many = len(why.actions)
        if step.decision is Decision.GIVE_UP:
            return self._told([f"I could have: the goal can be reached by {_count(many)}"]), reasons
        if why.against is Against.AS_GOOD:
            return self._told([f"I could have as well: that plan has {_count(many)} too"]), reasons
        said = (
            f"the plan would have been longer: {_count(many)} ({self._do(why.actions)}) instead "
            f"of {len(step.plan)}"
        )
        return self._told([said]), reasons

    def _what_if(self, query: Query) -> tuple[str, dict[str, Any]]:
        literal = query.symbol()
        history = self._history(query.step)
        supposed = f"if {subjunctive(self.speech.say(literal))}"
        reasons: dict[str, Any] = {"literal": str(literal)}
        past = self._supposing(history, literal)
        if past is None:
            return self._told([f"{self.speech.say(literal)}: nothing that I know of could bring "
                               "that about"]), reasons  # fmt: skip
        step = self._decided(past)
        reasons |= {
            "decision": step.decision.value,
            "actions": [str(own) for own in step.plan],
            "because": [str(own) for own in step.because],
        }
        if step.decision is Decision.STOP:
            return self._told([f"{supposed}, I would do nothing: the goal is reached"]), reasons
        if step.decision is Decision.GIVE_UP:
            since = self.speech.every(own for own in step.because if own != literal)
            also = f", since {since} as well" if since else ""
            said = f"{supposed}, I would give up: the goal could not be reached{also}"
            return self._told([said]), reasons
        would = f"{supposed}, I would {self._do(step.plan)}"
        present = self._decided(history).plan
        if step.plan == present:
            would += ", as I would without it"
        elif len(step.plan) != len(present) and present:
            would += f": {_count(len(step.plan))} instead of {len(present)}"
        doubt = "I would hope that things have changed by then" if step.doubted else ""
        return self._told([would, doubt]), reasons

    def _why_changed(self, query: Query) -> tuple[str, dict[str, Any]]:
        changing = (Decision.REPLAN, Decision.SKIP, Decision.GIVE_UP)
        pairs = [
            (before, own)
            for before, own in zip(self.run.steps, self.run.steps[1:], strict=False)
            if own.decision in changing and query.step in (None, own.number)
        ]
        if not pairs:
            when = "" if query.step is None else f" at step {query.step}"
            return self._told([f"the plan did not change{when}"]), {"changes": []}
        told = [self._change(before, own) for before, own in pairs]
        return (
            " ".join(text for text, _ in told),
            {"changes": [reasons for _, reasons in told]},
        )

    def _change(self, before: Step, step: Step) -> tuple[str, dict[str, Any]]:
        assert before.action is not None
        seen = self._unexpected(before, step)
        noticed = [self.speech.surprise(own) for own in step.surprises]
        begin = f"at step {step.number} "
        said = []
        if seen:
            said.append(f"{begin}I saw that {self.speech.every_past(seen)}")
            begin = ""
        if noticed:
            said.append(f"{begin or 'so '}I concluded that {join_words(noticed)}")
            begin = ""
        reasons: dict[str, Any] = {
            "step": step.number,
            "decision": step.decision.value,
            "seen": [str(own) for own in seen],
            "surprises": [
                {"step": own.step, "kind": own.kind.value, "what": str(own.what)}
                for own in step.surprises
            ],
        }
        if step.decision is Decision.SKIP:
            said.append(f"{begin}it was no longer needed to {self._do(step.skipped)}")
            return self._told(said), reasons | {"skipped": [str(own) for own in step.skipped]}
        failing = self.intentions.failing(before.plan[1:], step.believed)
        if failing is not None:
            reasons["failing"] = self._needs([failing])[0]
            said.append(begin + self._no_longer(failing))
        if step.decision is Decision.GIVE_UP:
            said.append(self._gave_up(step))
        else:
            said.append(f"so I decided to {self._do(step.plan)}")
            reasons["actions"] = [str(own) for own in step.plan]
        return self._told(said), reasons

    # Parts of answers

    def _no_longer(self, failing: Failing) -> str:
        if failing.action is None:
            return "what was left of my plan would no longer have reached the goal"
        obstacle = self._obstacle(failing.obstacles)
        said = f"I could no longer {self.speech.do(failing.action)} as planned"
        return f"{said}: {obstacle}" if obstacle else said

    def _unexpected(self, before: Step, step: Step) -> list[clingo.Symbol]:
        assert before.action is not None
        expected = state_after(self.domain.knowledge, [before.action], start=before.believed)
        if expected is None:
            return []
        sensed = [clingo.parse_term(key_of(own)) for own in step.sensed]
        against = [own for own in sensed if complement_of(own) in expected.holds]
        open_before = [own for own in sensed if _fluent(own) in expected.unknown]
        found = against or [own for own in open_before if self._in_goal_or_plan(own, before)]
        return [own for own in found if own.positive] or found

    def _in_goal_or_plan(self, literal: clingo.Symbol, step: Step) -> bool:
        named = {str(own) for action in step.plan for own in action.arguments}
        return all(str(own) in named for own in literal.arguments)

    def _gave_up(self, step: Step) -> str:
        since = self.speech.every_past(step.because)
        return f"I gave up: the goal could not be reached{', since ' if since else ''}{since}"

    def _ended(self) -> str:
        if self.run.outcome is Outcome.ACHIEVED:
            return "the goal is reached"
        if self.run.outcome is Outcome.IMPOSSIBLE:
            return self._gave_up(self.run.steps[-1])
        if self.run.outcome is Outcome.OUT_OF_STEPS:
            return "I stopped because I had no more steps"
        return ""

    def _did(self, did: Sequence[str]) -> list[str]:
        return [f"I {join_words(list(did))}"] if did else []

    def _do(self, actions: Iterable[clingo.Symbol]) -> str:
        return join_words([self.speech.do(own) for own in actions])

    def _had(self, action: clingo.Symbol) -> str:
        return self.speech.did(action)

    def _obstacle(self, obstacles: Sequence[Applied]) -> str:
        """The first obstacle as a clause, those with a sentence before the others."""
        ranked = sorted(obstacles, key=lambda own: not has_sentence(own.axiom))
        if not ranked:
            return ""
        own = ranked[0]
        literals = [*own.holds, *own.counted]
        literals += [complement_of(absent) for absent in own.absent]
        said = self.speech.every_past(literals)
        text = f'"{own.axiom.text}"' if has_sentence(own.axiom) else ""
        return ", and ".join(filter(None, [text, said]))

    def _needs(self, needs: Sequence[Failing]) -> list[dict[str, Any]]:
        return [
            {
                "action": None if own.action is None else str(own.action),
                "goal": self.run.goal.text if own.action is None else None,
                "obstacles": [_obstacle_dict(applied) for applied in own.obstacles],
            }
            for own in needs
        ]

    def _because(self, literal: clingo.Symbol, beliefs: Beliefs, step: int) -> list[str]:
        said = self.speech.say(literal)
        return [
            own.replace(f"it is usual that {said}", "that is usual")
            for own in tell(beliefs.why(literal, step), self.speech)
        ]

    def _goal_said(self) -> str:
        clauses = []
        for own in self.run.goal.axiom.body:
            variable = own.literal is None or any(a[:1].isupper() for a in own.literal.arguments)
            if variable or own.literal is None:
                clauses.append(own.text)
            else:
                symbol = clingo.parse_term(key_of(own.literal))
                clauses.append(self.speech.say(complement_of(symbol) if own.absent else symbol))
        return join_words(clauses)

    def _asked(self, query: Query) -> str:
        named = re.sub(r"^why (did|do) you (not )?", "", query.text)
        return re.sub(r" at step \d+$", "", named)

    def _told(self, clauses: Iterable[str]) -> str:
        return " ".join(sentence(own) for own in clauses if own)

    # Beliefs at a step

    def _beliefs(self, query: Query) -> tuple[Beliefs, int]:
        history = self._history(query.step)
        beliefs = Beliefs(self.domain, history)
        return beliefs, history.last_step if query.step is None else query.step

    def _history(self, step: int | None) -> History:
        """What was known at a step."""
        history = self.run.history
        if step is None:
            return history
        return History(
            tuple(own for own in history.observations if own.step <= step),
            tuple(own for own in history.occurrences if own.step < step),
        )

    def _known(self, literal: clingo.Symbol, beliefs: Beliefs, step: int) -> clingo.Symbol | None:
        return next((own for own in (literal, complement_of(literal)) if beliefs.holds(own, step)),
                    None)  # fmt: skip

    def _not_known(self, literal: clingo.Symbol) -> str:
        return (
            f"I do not know whether {self.speech.say(_fluent(literal))}: I have not seen it, and "
            "nothing that I know tells"
        )

    def _place_of(
        self, thing: str, beliefs: Beliefs, step: int
    ) -> tuple[clingo.Symbol, str] | None:
        literal = whereabouts(self.domain, beliefs.diagnosis.states[step], thing)
        if literal is None:
            return None
        own = next(own for own in places(self.domain) if own.predicate == literal.name)
        return literal, str(literal.arguments[own.place])

    def _unknown_place(self, thing: str, beliefs: Beliefs, step: int) -> tuple[str, dict[str, Any]]:
        is_me = thing == self.domain.robot
        where = "I am" if is_me else f"{self.speech.name(thing)} is"
        ruled_out = [
            literal
            for own in places(self.domain)
            if own.single
            for literal in sorted(beliefs.diagnosis.states[step].holds)
            if literal.name == own.predicate
            and not literal.positive
            and str(literal.arguments[own.thing]) == thing
        ]
        said = [f"I do not know where {where}"]
        if ruled_out:
            said.append(f"I only know that {self.speech.every(ruled_out)}")
        return self._told(said), {"ruled_out": [str(own) for own in ruled_out]}

    def _is_place(self, term: str) -> bool:
        signature = self.domain.knowledge.signature
        return any(
            term in signature.members(signature.predicates[own.predicate].sorts[own.place])
            for own in places(self.domain)
        )

    def _supposing(self, history: History, literal: clingo.Symbol) -> History | None:
        """The history with the literal seen at its end, without what contradicts that."""
        step = history.last_step
        supposed = Observation(literal_of(str(literal)), step)
        others = [own for own in history.observations if own.step < step]
        present = [own for own in history.observations
                   if own.step == step and not self._excludes(own.literal, literal)]  # fmt: skip
        whole = replace(history, observations=(*others, *present, supposed))
        if self._explained(whole):
            return whole
        kept = replace(history, observations=(*others, supposed))
        if not self._explained(kept):
            return None
        for own in present:
            more = replace(kept, observations=(*kept.observations, own))
            kept = more if self._explained(more) else kept
        return kept

    def _excludes(self, seen: Literal, literal: clingo.Symbol) -> bool:
        symbol = clingo.parse_term(key_of(seen))
        if symbol == complement_of(literal):
            return True
        single = {own.predicate: own.position for own in mutexes(self.domain.knowledge)}
        if symbol.name != literal.name or symbol.name not in single:
            return False
        value = single[symbol.name]
        same = all(
            one == other
            for n, (one, other) in enumerate(zip(symbol.arguments, literal.arguments, strict=True))
            if n != value
        )
        return same and symbol.positive and symbol != literal

    def _explained(self, history: History) -> bool:
        try:
            diagnose(self.domain.knowledge, history)
        except PlanningError:
            return False
        return True

    # Steps and actions

    def _decided(self, history: History) -> Step:
        """What would be decided after a history."""
        domain = replace(self.domain, history=history)
        (run,) = [next(execute(domain, self.run.goal, sensed=[], act=lambda _: []))]
        return run.steps[0]

    def _present_step(self) -> Step:
        if not self.run.steps:
            return self._decided(self.run.history)
        last = self.run.steps[-1]
        return last if last.action is None else self._decided(self.run.history)

    def _step_asked(self, query: Query) -> Step:
        steps = self.run.steps
        if query.step is not None:
            for own in steps:
                if own.number == query.step:
                    return own
        acting = [own for own in steps if own.action is not None]
        if query.step is None and acting:
            same = [own for own in acting if own.action and own.action.name == query.predicate]
            return (same or acting)[-1]
        return self._decided(self._history(query.step))

    def _actions(self, query: Query) -> list[clingo.Symbol]:
        every = sorted(
            clingo.parse_term(key_of(Literal(query.predicate or "", arguments)))
            for arguments in self._argument_tuples(query)
        )
        return every

    def _argument_tuples(self, query: Query) -> list[tuple[str, ...]]:
        signature = self.domain.knowledge.signature
        found: list[tuple[str, ...]] = [()]
        for own, sort in zip(
            query.arguments, signature.predicates[query.predicate or ""].sorts, strict=True
        ):
            values = [own] if own is not None else signature.members(sort)
            found = [(*before, value) for before in found for value in values]
        return found

    def _failures(self) -> set[tuple[int, clingo.Symbol]]:
        errors = any(own.error for own in self.domain.sensing)
        found = diagnose(self.domain.knowledge, self.run.history, sensors_err=errors)
        return {(own.step, own.what) for own in found.surprises if own.kind is SurpriseKind.FAILURE}


def _fits(query: Query, action: clingo.Symbol) -> bool:
    return action.name == query.predicate and all(
        asked in (None, str(own))
        for asked, own in zip(query.arguments, action.arguments, strict=True)
    )


def _fluent(literal: clingo.Symbol) -> clingo.Symbol:
    return clingo.Function(literal.name, literal.arguments)


def _count(actions: int) -> str:
    return f"{actions} action{'s' * (actions != 1)}"


def _obstacle_dict(own: Applied) -> dict[str, Any]:
    return {
        "axiom": own.axiom.text,
        "holds": [str(literal) for literal in own.holds],
        "counted": [str(literal) for literal in own.counted],
        "absent": [str(literal) for literal in own.absent],
    }
