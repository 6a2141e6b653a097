"""Answer questions about a run: what is believed, what was done, why, and what else could be."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import clingo

from seewhy.domain.wording import join_words
from seewhy.errors import QuestionError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import complement_of, fluent_of, key_of, literal_of
from seewhy.knowledge.history import History
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.diagnosis import SurpriseKind, diagnose
from seewhy.planning.dialogue.action_reason import Against, Failing, Intentions
from seewhy.planning.dialogue.asking import Asks, PlanningQuestions, Query
from seewhy.planning.dialogue.belief_answers import BeliefAnswers
from seewhy.planning.dialogue.goal_words import say_goal
from seewhy.planning.dialogue.instances import Applied, has_sentence
from seewhy.planning.dialogue.recalling import recalled
from seewhy.planning.dialogue.speech import Speech, past, sentences, subjunctive
from seewhy.planning.dialogue.supposing import known_at, supposed_history
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Decision, Outcome, Run, Step, execute
from seewhy.planning.execution.plan_monitoring import state_after, suppositions


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
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> run = Run(read_goal("loc(rob1, kitchen)", domain.knowledge), domain.history)
    >>> print(answer(domain, run, "what is your goal?").text)
    My goal is that I am in the kitchen.
    """
    return RunAnswers(domain, run).answer(question)


class RunAnswers:
    """The answers about one run; for many questions, where :func:`answer` is for one.

    Examples
    --------
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> run = Run(read_goal("loc(rob1, kitchen)", domain.knowledge), domain.history)
    >>> answers = RunAnswers(domain, run)
    >>> [answers.answer(own).query.asks.value for own in ("where are you?", "what is your plan?")]
    ['where', 'plan']
    """

    def __init__(self, domain: PlanningDomain, run: Run) -> None:
        # Without errors there may be no explanation of what networks read.
        domain = replace(domain, seen_by_networks=run.sensors_err)
        run = recalled(domain, run)
        self.domain = domain
        self.run = run
        self.questions = PlanningQuestions(domain)
        self.speech = Speech(domain.words)
        self.intentions = Intentions(domain, run)
        self.beliefs = BeliefAnswers(domain, run)

    def answer(self, question: str) -> PlanningReply:
        """Answer a question in words.

        Raises
        ------
        QuestionError
            As :func:`answer`.
        """
        return self.reply(self.questions.understand(question))

    def reply(self, query: Query) -> PlanningReply:
        """Answer a question that was understood."""
        last = self.run.history.last_step
        if query.step is not None and query.step > last:
            raise QuestionError(
                f"there is no step {query.step} yet: the run has come to step {last}; ask about "
                f"step {f'0 to {last}' if last else 0}"
            )
        asked: dict[Asks, Callable[[Query], tuple[str, dict[str, Any]]]] = {
            Asks.IS: self.beliefs.is_so,
            Asks.WHERE: self.beliefs.where,
            Asks.CONTENTS: self.beliefs.contents,
            Asks.PLAN: self._plan,
            Asks.DONE: self._done,
            Asks.GOAL: self._goal,
            Asks.WHY_DID: self._why_did,
            Asks.WHY_NOT: self._why_not,
            Asks.WHY_BELIEVE: self.beliefs.why_believe,
            Asks.WHY_DISBELIEVE: self.beliefs.why_disbelieve,
            Asks.WHAT_IF: self._what_if,
            Asks.WHY_CHANGED: self._why_changed,
            Asks.WHICH: self.beliefs.which,
            Asks.DID: self._did_so,
            Asks.ENDED: self._has_ended,
            Asks.WHY_ENDED: self._why_ended,
        }
        text, reasons = asked[query.asks](query)
        if query.foil is not None:
            also, against = self._rather_than(query, query.foil, reasons)
            text = " ".join(filter(None, [text, also]))
            reasons = reasons | {"rather_than": against}
        return PlanningReply(text, query, reasons)

    def _plan(self, query: Query) -> tuple[str, dict[str, Any]]:
        run = self.run
        if query.step is not None:
            then = self._step_at(query.step)
            had = f"to {self._do(then.plan)}" if then.plan else "to do nothing more"
            was = f"at step {query.step} my plan was {had}"
            return sentences([was]), {"actions": [str(own) for own in then.plan]}
        if run.outcome is Outcome.ACHIEVED:
            return "I have no plan any more: the goal is reached.", {"actions": []}
        if run.outcome is Outcome.IMPOSSIBLE:
            return sentences([self._gave_up(run.steps[-1])]), {"actions": []}
        step = self._present_step()
        if step.decision is Decision.GIVE_UP:
            return sentences([self._gave_up(step)]), {"actions": []}
        if not step.plan:
            return "I have nothing to do: the goal is reached.", {"actions": []}
        supposed = self._supposed(self.run, step)
        said = [f"my plan is to {self._do(step.plan)}", supposed and f"I suppose that {supposed}"]
        return sentences(said), {"actions": [str(own) for own in step.plan]}

    def _done(self, query: Query) -> tuple[str, dict[str, Any]]:
        said: list[str] = []
        events: list[dict[str, Any]] = []
        failed = self._failures()
        did: list[str] = []
        asked = [own for own in self.run.steps if query.step in (None, own.number)]
        for step in asked:
            noticed = [
                past(self.speech.surprise(own))
                for own in step.surprises
                if own.kind is not SurpriseKind.FAILURE
            ]
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
        if query.step is not None and asked and not asked[-1].action:
            return sentences([*said, self._ended()]), {"actions": events}
        if query.step is not None and asked:
            return sentences(said), {"actions": events}
        if not events:
            said.append("I have not done anything yet" if self.run.outcome is None
                        else "I did not do anything")  # fmt: skip
        said.append(self._ended())
        return sentences(said), {"actions": events}

    def _did_so(self, query: Query) -> tuple[str, dict[str, Any]]:
        failed = self._failures()
        done = [
            own
            for own in self.run.steps
            if own.action is not None
            and _fits(query, own.action)
            and query.step in (None, own.number)
        ]
        worked = [own for own in done if (own.number, own.action) not in failed]
        reasons = {"steps": [own.number for own in worked]}
        if not done:
            when = "" if query.step is None else f" at step {query.step}"
            have = query.text.startswith("have ")
            return sentences(
                [f"no, I {'have' if have else 'did'} not {self._asked(query)}{when}"]
            ), reasons
        steps = join_words([str(own.number) for own in worked or done])
        when = f"at step{'s' * (len(worked or done) > 1)} {steps}"
        action = (worked or done)[-1].action
        assert action is not None
        if not worked:
            return sentences(
                [f"no, I tried to {self.speech.do(action)} {when} and failed"]
            ), reasons
        return sentences([f"yes, I {self.speech.did(action)} {when}"]), reasons

    def _has_ended(self, _: Query) -> tuple[str, dict[str, Any]]:
        outcome = self.run.outcome
        yes = "yes" if outcome is Outcome.ACHIEVED else "no"
        said = self._ended() or "I am still on my way"
        return sentences([f"{yes}, {said}"]), {"outcome": outcome.value if outcome else None}

    def _why_ended(self, query: Query) -> tuple[str, dict[str, Any]]:
        outcome = self.run.outcome
        reasons: dict[str, Any] = {"outcome": outcome.value if outcome else None}
        if outcome is Outcome.IMPOSSIBLE:
            last = self.run.steps[-1]
            reasons["because"] = [str(own) for own in last.because]
            said = [self._gave_up(last)]
            if not last.because:
                said.append("nothing that I saw there, had it alone been otherwise, would have "
                            "left a plan")  # fmt: skip
            return sentences(said), reasons
        gave_up = "give up" in query.text or "fail" in query.text
        return sentences(["I did not" if gave_up else "", self._ended()]), reasons

    def _goal(self, _: Query) -> tuple[str, dict[str, Any]]:
        return f"My goal is that {say_goal(self.run.goal, self.domain, self.speech)}.", {
            "goal": self.run.goal.text
        }

    def _why_did(self, query: Query) -> tuple[str, dict[str, Any]]:
        done = [own for own in self.run.steps
                if own.action is not None and _fits(query, own.action)]  # fmt: skip
        chosen = [own for own in done if query.step in (None, own.number)]
        if not chosen:
            asked = f"I did not {self._asked(query)}"
            if done:
                when = join_words([str(own.number) for own in done])
                asked = f"{asked} at step {query.step}, but at step {when}"
                return sentences([asked]), {"steps": [own.number for own in done]}
            return sentences([asked]), {"steps": []}
        step = chosen[-1]
        action = step.action
        assert action is not None
        needs = self.intentions.needs(step)
        tried = (step.number, action) in self._failures()
        did = f"tried to {self.speech.do(action)}" if tried else self.speech.did(action)
        beginning = f"I {did} at step {step.number}"
        reasons = {"step": step.number, "action": str(action), "needed_by": self._needs(needs)}
        if not needs:
            return sentences([f"{beginning}, although my plan would have worked without"]), reasons
        wanted = [self.speech.do(own.action) for own in needs if own.action is not None]
        if not wanted:
            wish = say_goal(self.run.goal, self.domain, self.speech, end=needs[0].state)
            return sentences([f"{beginning} because my goal was that {wish}"]), reasons
        then = f", in order to {wanted[-1]}" if len(wanted) > 1 else ""
        # What lies between is told by the tree of reasons.
        said = [f"{beginning} because I wanted to {wanted[0]}{then}"]
        obstacle = self._obstacle(needs[0].obstacles)
        if obstacle:
            said.append(f"otherwise I could not have done that: {obstacle}")
        return sentences(said), reasons

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
            return sentences([f"but I did {do} {when}"]), reasons
        if why.against is Against.OBSTACLE:
            obstacle = self._obstacle(why.obstacles)
            could = f"I could not {do} {when}"
            return sentences([f"{could}: {obstacle}" if obstacle else could]), reasons
        if step.decision is Decision.STOP:
            return sentences(["there was nothing left to do: the goal was reached"]), reasons
        if why.against is Against.NO_PLAN:
            return sentences([f"I could have, but had I {self.speech.did(action)} {when}, the goal "
                               "could not have been reached any more"]), reasons  # fmt: skip
        many = len(why.actions)
        if step.decision is Decision.GIVE_UP:
            return sentences([f"I could have: the goal can be reached by {_count(many)}"]), reasons
        if why.against is Against.AS_GOOD:
            return sentences([f"I could have as well: that plan has {_count(many)} too"]), reasons
        said = (
            f"the plan would have been longer: {_count(many)} ({self._do(why.actions)}) instead "
            f"of {len(step.plan)}"
        )
        return sentences([said]), reasons

    def _rather_than(
        self, query: Query, foil: Query, reasons: dict[str, Any]
    ) -> tuple[str, dict[str, Any]]:
        """What speaks against the other of a contrast, where the one is so."""
        if query.asks is Asks.WHY_BELIEVE:
            if not reasons.get("believed"):
                return "", {}
            return self.beliefs.why_believe(replace(foil, positive=not foil.positive))
        if "action" not in reasons:
            return "", {}
        if foil.predicate == query.predicate:
            # What the contrast does not name is as it was.
            done = clingo.parse_term(reasons["action"]).arguments
            named = zip(foil.arguments, done, strict=True)
            foil = replace(foil, arguments=tuple(own or str(term) for own, term in named))
        foil = replace(foil, asks=Asks.WHY_NOT, step=reasons["step"])
        text, against = self._why_not(foil)
        do = self.speech.do(clingo.parse_term(against["action"]))
        if against["against"] == Against.LONGER.value:
            text = text.replace("The plan would", f"Had I chosen to {do}, the plan would", 1)
        elif against["against"] == Against.AS_GOOD.value:
            text = text.replace("I could have as well", f"I could as well have chosen to {do}", 1)
        return text, against

    def _what_if(self, query: Query) -> tuple[str, dict[str, Any]]:
        literal = query.symbol()
        if not self.domain.knowledge.signature.kind(literal.name).is_fluent:
            return self._what_if_it_happened(query, literal)
        history = known_at(self.run.history, query.step)
        supposed = f"if {subjunctive(self.speech.say(literal))}"
        reasons: dict[str, Any] = {"literal": str(literal)}
        supposing = supposed_history(
            self.domain.knowledge, history, literal, sensors_err=self.domain.sensors_err
        )
        if supposing is None:
            clause = self.speech.say(literal)
            said = f"nothing that I know of could bring it about that {clause}"
            return sentences([said]), reasons
        return self._would(supposing, supposed, reasons, present=history, literal=literal)

    def _what_if_it_happened(
        self, query: Query, event: clingo.Symbol
    ) -> tuple[str, dict[str, Any]]:
        """What would be done after an action or event that was not."""
        history = known_at(self.run.history, query.step)
        state = self._step_at(history.last_step).believed
        reasons: dict[str, Any] = {"action": str(event)}
        supposed = f"if {self.speech.happened(event)}"
        if state_after(self.domain.knowledge, [event], start=state) is None:
            obstacle = self._obstacle(self.intentions.obstacles(event, state))
            said = f"it cannot be that {self.speech.happened(event)}"
            return sentences([f"{said}: {obstacle}" if obstacle else said]), reasons
        supposing = history.with_occurrence(literal_of(str(event)), step=history.last_step)
        return self._would(supposing, supposed, reasons, present=history)

    def _would(
        self,
        supposing: History,
        supposed: str,
        reasons: dict[str, Any],
        *,
        present: History,
        literal: clingo.Symbol | None = None,
    ) -> tuple[str, dict[str, Any]]:
        """What would be done after a supposed history."""
        step = self._decided(supposing)
        reasons |= {
            "decision": step.decision.value,
            "actions": [str(own) for own in step.plan],
            "because": [str(own) for own in step.because],
        }
        if step.decision is Decision.STOP:
            return sentences([f"{supposed}, I would do nothing: the goal is reached"]), reasons
        if step.decision is Decision.GIVE_UP:
            since = self.speech.every(own for own in step.because if own != literal)
            also = f", since {since} as well" if since else ""
            said = f"{supposed}, I would give up: the goal could not be reached{also}"
            return sentences([said]), reasons
        would = f"{supposed}, I would {self._do(step.plan)}"
        if step.doubted:
            hoped = self._supposed(Run(self.run.goal, supposing, [step]), step)
            hoped = hoped or "something changes that I saw before"
            return sentences([f"{would}, hoping that {hoped}", "no plan would be sure"]), reasons
        otherwise = self._step_at(present.last_step).plan
        if step.plan == otherwise:
            would += ", just as otherwise"
        elif otherwise and len(step.plan) != len(otherwise):
            would += f": {_count(len(step.plan))} instead of {len(otherwise)}"
        return sentences([would]), reasons

    def _why_changed(self, query: Query) -> tuple[str, dict[str, Any]]:
        changing = (Decision.REPLAN, Decision.SKIP, Decision.GIVE_UP)
        pairs = [
            (before, own)
            for before, own in zip(self.run.steps, self.run.steps[1:], strict=False)
            if own.decision in changing and query.step in (None, own.number)
        ]
        if not pairs:
            when = "" if query.step is None else f" at step {query.step}"
            return sentences([f"the plan did not change{when}"]), {"changes": []}
        told = [self._change(before, own) for before, own in pairs]
        return (
            " ".join(text for text, _ in told),
            {"changes": [reasons for _, reasons in told]},
        )

    def _change(self, before: Step, step: Step) -> tuple[str, dict[str, Any]]:
        assert before.action is not None
        hoped_for = self._disappointed(step)
        seen = hoped_for or self._unexpected(before, step)
        noticed = [
            past(self.speech.surprise(own))
            for own in step.surprises
            if complement_of(own.what) not in seen
        ]
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
            return sentences(said), reasons | {"skipped": [str(own) for own in step.skipped]}
        failing = self.intentions.failing(before.plan[1:], step.believed)
        if failing is not None:
            reasons["failing"] = self._needs([failing])[0]
        if failing is not None and not hoped_for:
            said.append(begin + self._no_longer(failing))
        if step.decision is Decision.GIVE_UP:
            said.append(self._gave_up(step))
        else:
            said.append(f"so I decided to {self._do(step.plan)}")
            reasons["actions"] = [str(own) for own in step.plan]
        return sentences(said), reasons

    def _supposed(self, run: Run, step: Step) -> str:
        """What is not known and must be so for a step's plan."""
        start = Intentions(self.domain, run).start(step)
        knowledge = self.domain.knowledge
        needed = [
            own
            for own in suppositions(knowledge, run.goal, step.plan, start=start)
            if knowledge.signature.kind(own.name) is PredicateKind.FLUENT_BASIC
            and own not in step.believed.holds
        ]
        return self.speech.every([own for own in needed if own.positive] or needed)

    def _no_longer(self, failing: Failing) -> str:
        if failing.action is None:
            return "what was left of my plan would no longer have reached the goal"
        obstacle = self._obstacle(failing.obstacles)
        said = f"I could no longer {self.speech.do(failing.action)} as planned"
        return f"{said}: {obstacle}" if obstacle else said

    def _disappointed(self, step: Step) -> list[clingo.Symbol]:
        """What is seen at a step instead of what the plan before it supposed."""
        made = [own for own in self.run.plans if own.number < step.number]
        supposed = made[-1].supposed if made else ()
        sensed = {clingo.parse_term(key_of(own)) for own in step.sensed}
        return [complement_of(own) for own in supposed if complement_of(own) in sensed]

    def _unexpected(self, before: Step, step: Step) -> list[clingo.Symbol]:
        assert before.action is not None
        expected = state_after(self.domain.knowledge, [before.action], start=before.believed)
        if expected is None:
            return []
        sensed = [clingo.parse_term(key_of(own)) for own in step.sensed]
        against = [own for own in sensed if complement_of(own) in expected.holds]
        open_before = [own for own in sensed if fluent_of(own) in expected.unknown]
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

    def _asked(self, query: Query) -> str:
        if re.match(r"(why )?(did|do|have|are) you", query.text) is None:
            # Of "why on the table", what is to be done to anything.
            return self._anything(query)
        named = re.sub(r"^(why )?(did|do|have|are) you (not )?", "", query.text)
        if query.text.startswith("why are you "):
            # Of "are you moving", what is to be done.
            return self.speech.do(self._actions(query)[0])
        return re.sub(r" at step \d+$", "", named)

    def _anything(self, query: Query) -> str:
        terms = [clingo.parse_term(own or '"anything"') for own in query.arguments]
        return self.speech.do(clingo.Function(query.predicate or "", terms))

    def _decided(self, history: History) -> Step:
        """What would be decided after a history."""
        domain = replace(self.domain, history=history)
        last = history.last_step
        seen = [own.literal for own in history.observations if own.step == last]
        run = next(execute(domain, self.run.goal, sensed=seen, act=lambda _: []))
        return run.steps[0]

    def _present_step(self) -> Step:
        last = self.run.steps[-1] if self.run.steps else None
        return last if last and last.action is None else self._decided(self.run.history)

    def _step_at(self, number: int) -> Step:
        """The run's own step where it has one, else what would be decided there."""
        own = next((own for own in self.run.steps if own.number == number), None)
        return own or self._decided(known_at(self.run.history, number))

    def _step_asked(self, query: Query) -> Step:
        if query.step is not None:
            return self._step_at(query.step)
        if query.text.startswith(("why do ", "why not ")):
            return self._present_step()
        acting = [own for own in self.run.steps if own.action is not None]
        same = [own for own in acting if own.action and own.action.name == query.predicate]
        return (same or acting)[-1] if acting else self._present_step()

    def _actions(self, query: Query) -> list[clingo.Symbol]:
        return sorted(
            clingo.parse_term(key_of(Literal(query.predicate or "", arguments)))
            for arguments in self._argument_tuples(query)
        )

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
        errors = self.domain.sensors_err
        found = diagnose(self.domain.knowledge, self.run.history, sensors_err=errors)
        return {(own.step, own.what) for own in found.surprises if own.kind is SurpriseKind.FAILURE}


def _fits(query: Query, action: clingo.Symbol) -> bool:
    return action.name == query.predicate and all(
        asked in (None, str(own))
        for asked, own in zip(query.arguments, action.arguments, strict=True)
    )


def _count(actions: int) -> str:
    return f"{actions} action{'s' * (actions != 1)}"


def _obstacle_dict(own: Applied) -> dict[str, Any]:
    return {
        "axiom": own.axiom.text,
        "holds": [str(literal) for literal in own.holds],
        "counted": [str(literal) for literal in own.counted],
        "absent": [str(literal) for literal in own.absent],
    }
