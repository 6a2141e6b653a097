"""Questions about a run: golden answers in the office, and in a domain of two lamps."""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable
from dataclasses import replace

import clingo
import pytest

from seewhy.errors import QuestionError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import literal_of
from seewhy.knowledge.history import read_history
from seewhy.knowledge.language import read_knowledge
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.dialogue.run_answers import answer
from seewhy.planning.dialogue.surface_realisation import Speech
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.execution import Run, execute
from seewhy.planning.execution.transition_function import TransitionFunction, World
from seewhy.planning.goal import read_goal
from seewhy.planning.tables import ActionTable, FluentTable
from seewhy.planning.words import PlanningWords
from tower import TOWER

OFFICE = load_planning_domain("robot_assistant")
TO_SALLY = read_goal("message_status(m1, sally, delivered)", OFFICE.knowledge)
SEEN = ("loc", "present", "closed", "has")
CLUTTER = ("present(cup,sallys_office)", "present(large_box,sallys_office)",
           "present(sofa,sallys_office)")  # fmt: skip


def term(text: str) -> clingo.Symbol:
    return clingo.parse_term(text)


@pytest.fixture(scope="module")
def transitions() -> TransitionFunction:
    return TransitionFunction(OFFICE.knowledge)


def seen_in(state: World) -> list[Literal]:
    """What the robot sees: all that is at its place, the doors, and its messages."""
    (here,) = [atom.arguments[1] for atom in state if atom.positive and atom.match("loc", 2)
               and str(atom.arguments[0]) == "rob1"]  # fmt: skip
    return [
        literal_of(str(atom))
        for atom in sorted(state)
        if atom.name in SEEN and (atom.name not in ("loc", "present") or atom.arguments[1] == here)
    ]


def office_run(
    transitions: TransitionFunction,
    *literals: str,
    script: Callable[[int, World], World] = lambda _, state: state,
) -> Run:
    """A run to Sally in a world in which these hold and else what is usual."""
    usual = sorted(diagnose(OFFICE.knowledge, OFFICE.history).states[0].holds)
    state = transitions.complete([*map(term, literals), *usual])
    steps = itertools.count(1)

    def act(action: clingo.Symbol) -> list[Literal]:
        nonlocal state
        state = script(next(steps), transitions.after(state, [action]) or state)
        return seen_in(state)

    *_, last = execute(OFFICE, TO_SALLY, sensed=seen_in(state), act=act)
    return last


@pytest.fixture(scope="module")
def not_begun() -> Run:
    return Run(TO_SALLY, OFFICE.history)


@pytest.fixture(scope="module")
def delivered(transitions: TransitionFunction) -> Run:
    return office_run(transitions, *CLUTTER)


@pytest.fixture(scope="module")
def met(transitions: TransitionFunction) -> Run:
    return office_run(transitions, "loc(sally,kitchen)")


@pytest.fixture(scope="module")
def lost(transitions: TransitionFunction) -> Run:
    def lose(step: int, state: World) -> World:
        return transitions.after(state, [term("lose(m1)")]) or state if step == 1 else state

    return office_run(transitions, script=lose)


@pytest.fixture(scope="module")
def shut_in(transitions: TransitionFunction) -> Run:
    return office_run(
        transitions,
        "closed(kitchen)",
        "closed(bobs_office)",
        "closed(johns_office)",
    )


def asked(run: Run, question: str, domain: PlanningDomain = OFFICE) -> str:
    reply = answer(domain, run, question)
    json.dumps(reply.to_dict())
    return reply.text


DELIVERED = {
    "Is Sally's location cluttered?": (
        "Sally is in her office. Objects detected are a chair, a computer, a cup, a desk, a "
        "large box and a sofa. Sally's office is cluttered because a cup, a large box and a "
        "sofa are not usually there."
    ),
    "is the kitchen cluttered?": (
        "No, the kitchen is not cluttered: I know of nothing that would make it otherwise, and "
        '"a place is cluttered where three or more objects are that are not usually there".'
    ),
    "is the bathroom cluttered?": (
        "I do not know whether the bathroom is cluttered: I have not seen it, and nothing that "
        "I know tells."
    ),
    "is Sally in the kitchen?": (
        "No, Sally is in her office. I saw at step 3 that Sally was in her office."
    ),
    "is the kitchen open?": "Yes, the kitchen is open. I saw at step 3 that the kitchen was open.",
    "do you have the first message?": (
        "Yes, I have the first message. I saw at step 3 that I had the first message."
    ),
    "are you in the kitchen at step 1?": (
        "Yes, I was in the kitchen. I saw at step 1 that I was in the kitchen."
    ),
    "where is Sally?": "Sally is in her office. I saw at step 3 that Sally was in her office.",
    "where is Bob?": (
        'Bob is in his office. That is usual: "people are in their own office unless they are '
        'elsewhere"; nothing that I know of has changed it since.'
    ),
    "where are you at step 1?": "I was in the kitchen. I saw at step 1 that I was in the kitchen.",
    "what is in Sally's office?": (
        "I am in Sally's office and Sally is in her office. Objects detected are a chair, a "
        "computer, a cup, a desk, a large box and a sofa."
    ),
    "what is in the bathroom?": "I know of nothing in the bathroom; I have not looked there.",
    "what is your plan?": "I have no plan any more: the goal is reached.",
    "what was your plan at step 1?": (
        "At step 1 my plan was to move to Sally's office and deliver the first message to Sally."
    ),
    "what did you do?": (
        "I moved to the kitchen, moved to Sally's office and delivered the first message to "
        "Sally. The goal is reached."
    ),
    "what is your goal?": "My goal is that the first message for Sally is delivered.",
    "why did you move to the kitchen?": (
        "I moved to the kitchen at step 0 because I wanted to move to Sally's office, in order "
        'to deliver the first message to Sally. Otherwise I could not have done that: "the '
        'robot moves to places next to its own", and I was in the library and the library is not '
        "next to Sally's office."
    ),
    "why did you move to Sally's office at step 1?": (
        "I moved to Sally's office at step 1 because I wanted to deliver the first message to "
        'Sally. Otherwise I could not have done that: "a message is delivered to somebody who '
        'is where the robot is", and I was in the kitchen and Sally was in her office.'
    ),
    "why did you deliver the first message to Sally?": (
        "I delivered the first message to Sally at step 2 because my goal was that the first "
        "message for Sally is delivered."
    ),
    "why did you move to the library?": "I did not move to the library.",
    "why did you move to the kitchen at step 1?": (
        "I did not move to the kitchen at step 1, but at step 0."
    ),
    "why did you not move to Bob's office at step 0?": (
        "The plan would have been longer: 5 actions (move to Bob's office, move to the "
        "library, move to the kitchen, move to Sally's office and deliver the first message to "
        "Sally) instead of 3."
    ),
    "why didn't you go to Sally's office instead at step 0?": (
        "I could not move to Sally's office at step 0: \"the robot moves to places next to its "
        "own\", and I was in the library and the library is not next to Sally's office."
    ),
    "why did you not deliver the first message to Sally at step 1?": (
        'I could not deliver the first message to Sally at step 1: "a message is delivered to '
        'somebody who is where the robot is", and I was in the kitchen and Sally was in her '
        "office."
    ),
    "why did you not move to the kitchen at step 0?": "But I did move to the kitchen at step 0.",
    "why do you believe that Sally is in her office at step 1?": (
        'At step 1 I believed that Sally was in her office. That is usual: "people are in '
        'their own office unless they are elsewhere"; nothing that I know of has changed it '
        "since."
    ),
    "why do you believe that Sally is in the kitchen?": (
        "I do not believe that; I believe that Sally is not in the kitchen. I saw at step 1 "
        "that Sally was not in the kitchen; nothing that I know of has changed it since."
    ),
    "why do you believe that Sally is not in the library at step 2?": (
        "At step 2 I believed that Sally was not in the library. I saw at step 0 that Sally "
        "was not in the library; nothing that I know of has changed it since."
    ),
    "why is the first message for Sally delivered?": (
        "I believe that the first message for Sally is delivered. I delivered the first "
        'message to Sally at step 2, and "who delivers a message to a person has delivered it".'
    ),
    "why is the first message for Bob not delivered?": (
        'I believe that the first message for Bob is not delivered. It follows from "a message '
        'is delivered or is not": the first message for Bob is undelivered. It is usual that '
        'the first message for Bob is undelivered: "messages are not yet delivered"; nothing '
        "that I know of has changed it since."
    ),
    "why is Sally's office cluttered?": (
        "Sally's office is cluttered because a cup, a large box and a sofa are not usually there."
    ),
    "what would you do if the kitchen were closed?": (
        "If the kitchen were closed, I would do nothing: the goal is reached."
    ),
    "what would you do if the kitchen were closed at step 0?": (
        "If the kitchen were closed, I would move to Bob's office and deliver the first "
        "message to Sally, hoping that Sally is in Bob's office. No plan would be sure."
    ),
    "what would you do if Sally were in the library at step 1?": (
        "If Sally were in the library, I would move to the library and deliver the first "
        "message to Sally."
    ),
    "why did the plan change?": "The plan did not change.",
}


MET = {
    "was Sally in her office?": (
        'Yes, at step 0 I believed that Sally was in her office. That is usual: "people are in '
        'their own office unless they are elsewhere". Since step 1 I have believed that Sally is '
        "in the kitchen."
    ),
    "where was Sally?": (
        "At step 0 I believed that Sally was in her office and since step 1 I have believed that "
        "Sally is in the kitchen."
    ),
    "what did you do?": (
        "I moved to the kitchen. At step 1 I found that Sally was not in her office, other "
        "than usual. I delivered the first message to Sally. The goal is reached."
    ),
    "why did the plan change at step 1?": (
        "At step 1 I saw that Sally was in the kitchen. So I concluded that Sally was not in "
        "her office, other than usual. It was no longer needed to move to Sally's office."
    ),
    "why do you believe that Sally is not in her office?": (
        'I believe that Sally is not in her office. It follows from "nobody is at two places": '
        "Sally is in the kitchen. I saw at step 2 that Sally was in the kitchen."
    ),
}


LOST = {
    "what did you do?": (
        "I moved to the kitchen. At step 1 I found that the first message was lost after step "
        "0. I moved to the library, printed the first message, moved to the kitchen, moved to "
        "Sally's office and delivered the first message to Sally. The goal is reached."
    ),
    "why did your plan change?": (
        "At step 1 I saw that I did not have the first message. So I concluded that the first "
        "message was lost after step 0. I could no longer deliver the first message to Sally "
        'as planned: "a message that the robot does not have cannot be delivered", and I did '
        "not have the first message. So I decided to move to the library, print the first "
        "message, move to the kitchen, move to Sally's office and deliver the first message to "
        "Sally."
    ),
    "why did you print the first message?": (
        "I printed the first message at step 2 because I wanted to deliver the first message "
        'to Sally. Otherwise I could not have done that: "a message that the robot does not '
        'have cannot be delivered", and I did not have the first message.'
    ),
    "why do you believe that you do not have the first message at step 1?": (
        "At step 1 I believed that I did not have the first message. I saw at step 1 that I "
        "did not have the first message."
    ),
    "why did the plan change at step 2?": "The plan did not change at step 2.",
}


SHUT_IN = {
    "what did you do?": (
        "I did not do anything. I gave up: the goal could not be reached, since Bob's office, "
        "John's office and the kitchen were closed."
    ),
    "what is your plan?": (
        "I gave up: the goal could not be reached, since Bob's office, John's office and the "
        "kitchen were closed."
    ),
    "why did you not move to the kitchen?": (
        'I could not move to the kitchen at step 0: "nobody enters a place that is closed", '
        "and the kitchen was closed."
    ),
    "what would you do if the kitchen were open?": (
        "If the kitchen were open, I would move to the kitchen, move to Sally's office and "
        "deliver the first message to Sally."
    ),
}


BEFORE = {
    "what is your plan?": (
        "My plan is to move to the kitchen, move to Sally's office and deliver the first "
        "message to Sally."
    ),
    "what did you do?": "I have not done anything yet.",
    "where is Sally?": (
        'Sally is in her office. That is usual: "people are in their own office unless they '
        'are elsewhere".'
    ),
    "what would you do if you did not have the first message?": (
        "If I did not have the first message, I would print the first message, move to the "
        "kitchen, move to Sally's office and deliver the first message to Sally: 4 actions "
        "instead of 3."
    ),
}


LOSING = (
    "If the first message was lost, I would print the first message, move to the kitchen, move "
    "to Sally's office and deliver the first message to Sally: 4 actions instead of 3."
)
SUPPOSED_EVENTS = {
    "what would you do if the robot lost the first message?": LOSING,
    "what would you do if you lost the first message?": LOSING,
    "what if the first message was lost?": LOSING,
    "what if Sally walked to the library?": (
        "If Sally walked to the library, I would deliver the first message to Sally: 1 action "
        "instead of 3."
    ),
    "what if you moved to Bob's office?": (
        "If I moved to Bob's office, I would move to the library, move to the kitchen, move to "
        "Sally's office and deliver the first message to Sally: 4 actions instead of 3."
    ),
    "what would you do if you moved to the bathroom?": (
        'I cannot move to the bathroom now: "the robot moves to places next to its '
        'own", and I am in the library and the library is not next to the bathroom.'
    ),
    "what if somebody opened the kitchen?": (
        "It cannot be that somebody opened the kitchen: the kitchen is open."
    ),
}


# None of these words is known; without them, each is a question that says the opposite.
OPPOSITE = (
    "what would you do if the robot dropped the first message?",
    "what would you do if the robot lost the message?",
    "what would you do if Sally left her office?",
    "what if Sally avoided the kitchen?",
    "do you lack the first message?",
    "why did you leave the kitchen?",
    "why did you not leave the kitchen?",
    "did you avoid the kitchen?",
    "why do you believe that Sally left her office?",
    "why did you move from the kitchen?",
    "did you come from the kitchen?",
    "did you move in the kitchen?",
    "what if Sally walked from the kitchen?",
    "why did you deliver the first message by Sally?",
    "what is by the kitchen?",
    "what is unusual in the kitchen?",
    "who will be in the kitchen?",
    "what will you see in the kitchen?",
    "did you paint the first message?",
    "did you reprint the first message?",
    "why did you redeliver the first message to Sally?",
    "what if Sally talked to the kitchen?",
    "is the kitchen closer?",
    "what is your plant?",
    "why did your plan charge?",
)


@pytest.mark.parametrize("question", OPPOSITE)
def test_a_word_that_is_not_known_is_never_passed_over(delivered: Run, question: str) -> None:
    with pytest.raises(QuestionError, match="is not understood"):
        answer(OFFICE, delivered, question)


@pytest.fixture(scope="module")
def begun(transitions: TransitionFunction) -> Run:
    """A run that has come no further than its first action."""
    usual = sorted(diagnose(OFFICE.knowledge, OFFICE.history).states[0].holds)
    state = transitions.complete(usual)
    after = transitions.after(state, [term("move(rob1,kitchen)")]) or state
    goal = read_goal("message_status(m1, P, delivered), loc(rob1, kitchen), P != bob",
                     OFFICE.knowledge)  # fmt: skip
    return next(execute(OFFICE, goal, sensed=seen_in(state), act=lambda _: seen_in(after)))


BEGUN = {
    "why was Sarah in the library?": (
        "I do not believe that; I believe that Sarah is not in the library. I saw at step 0 that "
        "Sarah was not in the library; nothing that I know of has changed it since."
    ),
    "why were you in the library?": (
        "At step 0 I believed that I was in the library. I saw at step 0 that I was in the library."
    ),
    "why is Bob's office not closed?": (
        "I believe that Bob's office is open. I saw at step 1 that Bob's office was open."
    ),
    "why don't you have the first message?": (
        "I do not believe that; I believe that I have the first message. I saw at step 1 that I "
        "had the first message."
    ),
    "what is your goal?": (
        "My goal is that the first message for some person is delivered, I am in the kitchen "
        "and that person is not Bob."
    ),
    "what is your plan?": (
        "My plan is to move to Sarah's office, deliver the first message to Sarah and move to "
        "the kitchen."
    ),
    "what did you do?": "I moved to the kitchen.",
    "why do you not print the first message?": (
        'I cannot print the first message now: "messages are printed where a printer '
        'is", and I am in the kitchen and no printer is in the kitchen.'
    ),
    "why will you deliver the first message to Sarah?": (
        "I would deliver the first message to Sarah as action 2 of my plan because my goal is that "
        "the first message for some person is delivered and that person is not Bob."
    ),
    "why did you deliver the first message to Sarah?": (
        "I have not delivered the first message to Sarah yet: it is action 2 of my plan."
    ),
    "why will you move to the kitchen?": (
        "I would move to the kitchen as action 3 of my plan because my goal is that the first "
        "message for some person is delivered, I am in the kitchen and that person is not Bob."
    ),
    "why can you not deliver the first message to Sarah?": (
        'I cannot deliver the first message to Sarah now: "a message is delivered to somebody who '
        'is where the robot is", and I am in the kitchen and Sarah is in her office; it is action '
        "2 of my plan."
    ),
    "why will you not move to Sarah's office?": (
        "But I would move to Sarah's office: my plan goes on with that."
    ),
    "why will you not move to the library?": (
        "The plan would be longer: 5 actions (move to the library, move to the kitchen, move to "
        "Sarah's office, deliver the first message to Sarah and move to the kitchen) instead of 3."
    ),
    "what if you moved to Bob's office?": (
        'I cannot move to Bob\'s office now: "the robot moves to places next to its own", and I am '
        "in the kitchen and the kitchen is not next to Bob's office."
    ),
    "why did you stop?": "I did not. I am still on my way.",
    "are you done?": "No, I am still on my way.",
    "what would you do if Sarah were in the bathroom?": (
        "If Sarah were in the bathroom, I would move to Sally's office, deliver the first "
        "message to Sally and move to the kitchen."
    ),
}


def failed_once(transitions: TransitionFunction) -> Run:
    """A run in which the second action has no effect at first."""
    kept: list[World] = []

    def keep(step: int, state: World) -> World:
        kept.append(state)
        return kept[0] if step == 2 else state

    return office_run(transitions, script=keep)


@pytest.fixture(scope="module")
def failed(transitions: TransitionFunction) -> Run:
    return failed_once(transitions)


FAILED = {
    "what did you do?": (
        "I moved to the kitchen, tried to move to Sally's office and failed, moved to Sally's "
        "office and delivered the first message to Sally. The goal is reached."
    ),
    "why did the plan change?": (
        "At step 2 I saw that I was in the kitchen. So I concluded that the attempt to move to "
        "Sally's office at step 1 failed. I could no longer deliver the first message to Sally "
        'as planned: "a message is delivered to somebody who is where the robot is", and I was '
        "in the kitchen and Sally was in her office. So I decided to move to Sally's office "
        "and deliver the first message to Sally."
    ),
    "why did you move to Sally's office at step 1?": (
        "I tried to move to Sally's office at step 1 because I wanted to deliver the first "
        'message to Sally. Otherwise I could not have done that: "a message is delivered to '
        'somebody who is where the robot is", and I was in the kitchen and Sally was in her '
        "office."
    ),
    "are you in the kitchen at step 2?": (
        "Yes, I was in the kitchen. I saw at step 2 that I was in the kitchen."
    ),
}


# The same in other words

WORDINGS = {
    "where's Sally?": "where is Sally?",
    "where was Sally at first": "where is Sally at step 0?",
    "what do you see in Sally's office?": "what is in Sally's office?",
    "why are you going to the kitchen?": "why did you move to the kitchen?",
    "why didn't you go straight to Bob's office at step 0?": (
        "why did you not move to Bob's office at step 0?"
    ),
    "what would happen if the kitchen were closed?": (
        "what would you do if the kitchen were closed?"
    ),
    "what if the kitchen was closed?": "what would you do if the kitchen were closed?",
    "what did you plan at first?": "what was your plan at step 0?",
    "what was your plan in the beginning?": "what was your plan at step 0?",
    "what was your first plan?": "what was your plan at step 0?",
    "why did you change your mind?": "why did the plan change?",
    "did you walk to the kitchen?": "did you move to the kitchen?",
    "have you brought the first message to Sally?": (
        "have you delivered the first message to Sally?"
    ),
    "what's next?": "what is your plan?",
}
ALSO_ASKED = {
    "what did you do at step 1?": "I moved to Sally's office.",
    "what happened at step 3?": "The goal is reached.",
    "did you move to the kitchen?": "Yes, I moved to the kitchen at step 0.",
    "did you move to the kitchen at step 1?": "No, I did not move to the kitchen at step 1.",
    "did you go to the bathroom?": "No, I did not move to the bathroom.",
    "have you delivered the first message?": (
        "Yes, I delivered the first message to Sally at step 2."
    ),
    "have you delivered the second message?": "No, I have not delivered the second message.",
    "what do you have?": "I have the first and second message.",
    "what is closed?": "Nothing that I know of.",
    "what was cluttered at step 3?": "Sally's office is cluttered.",
    "are you done?": "Yes, the goal is reached.",
    "why did you give up?": "I did not. The goal is reached.",
    "why did you stop?": "The goal is reached.",
}


@pytest.mark.parametrize("question", WORDINGS)
def test_the_same_in_other_words(delivered: Run, question: str) -> None:
    assert asked(delivered, question) == asked(delivered, WORDINGS[question])


TO_THE_KITCHEN = DELIVERED["why did you move to the kitchen?"]
BY_BOB = (
    f"{TO_THE_KITCHEN} Had I chosen to move to Bob's office, the plan would have been longer: 5 "
    "actions (move to Bob's office, move to the library, move to the kitchen, move to Sally's "
    "office and deliver the first message to Sally) instead of 3."
)
PRINTING = (
    f'{TO_THE_KITCHEN} I could not print the first message at step 0: "a message that the robot '
    'has needs no printing", and I had the first message.'
)
CONTRASTS = {
    "why did you move to the kitchen rather than to Bob's office?": BY_BOB,
    "why did you move to the kitchen instead of Bob's office?": BY_BOB,
    "why to the kitchen and not to Bob's office?": BY_BOB,
    "why to the kitchen as opposed to Bob's office?": BY_BOB,
    "why did you go to the kitchen instead of going to Bob's office?": BY_BOB,
    "why did you move to the kitchen rather than to Bob's office at step 0?": BY_BOB,
    "why did you move to the kitchen rather than print the first message?": PRINTING,
    "why did you move to the kitchen rather than printing the first message?": PRINTING,
    "why to the bathroom rather than to the kitchen?": "I did not move to the bathroom.",
    "why is Sally in her office rather than in the kitchen?": (
        "I believe that Sally is in her office. I saw at step 3 that Sally was in her office. I "
        "believe that Sally is not in the kitchen. I saw at step 1 that Sally was not in the "
        "kitchen; nothing that I know of has changed it since."
    ),
    "why is Sally in the kitchen rather than in her office?": (
        "I do not believe that; I believe that Sally is not in the kitchen. I saw at step 1 that "
        "Sally was not in the kitchen; nothing that I know of has changed it since."
    ),
}


WAS = {
    "was the kitchen closed?": (
        "No, at no step did I believe that the kitchen was closed. All along I have believed that "
        "the kitchen is open. I saw at step 3 that the kitchen was open."
    ),
    "were you in the kitchen?": (
        "Yes, at step 1 I believed that I was in the kitchen. I saw at step 1 that I was in the "
        "kitchen. Since step 2 I have believed that I am in Sally's office."
    ),
    "did you believe that you were in the kitchen?": (
        "Yes, at step 1 I believed that I was in the kitchen. I saw at step 1 that I was in the "
        "kitchen. Since step 2 I have believed that I am in Sally's office."
    ),
    "where were you?": (
        "At step 0 I believed that I was in the library, at step 1 I believed that I was in the "
        "kitchen and since step 2 I have believed that I am in Sally's office."
    ),
    "was Sally's location cluttered?": (
        "Yes, since step 2 I have believed that Sally's office is cluttered. Sally's office is "
        "cluttered because a cup, a large box and a sofa are not usually there."
    ),
    "did you have the first message?": (
        "Yes, all along I have believed that I have the first message. I saw at step 3 that I had "
        "the first message."
    ),
    "was the first message for Bob not delivered?": (
        "No, at no step did I believe that the first message for Bob was delivered. All along I "
        "have believed that the first message for Bob is undelivered. That is usual: "
        '"messages are not yet delivered"; nothing that I know of has changed it since.'
    ),
    "what was closed?": "Nothing that I knew of, at any step.",
    "what was cluttered?": (
        "From step 0 to step 1 I knew of nothing and since step 2 I have believed that Sally's "
        "office is cluttered."
    ),
    "where was the sofa?": (
        "From step 0 to step 1 I knew of no such place and since step 2 I have believed that there "
        "is a sofa in Sally's office."
    ),
    "was the bathroom cluttered?": DELIVERED["is the bathroom cluttered?"],
    "what was your plan?": (
        "At step 0 I planned to move to the kitchen, move to Sally's office and deliver the first "
        "message to Sally."
    ),
    "what was your goal?": "My goal was that the first message for Sally is delivered.",
}


STATICS = {
    "where does Sally work?": "Sally works in her office.",
    "where does saly work?": "Sally works in her office.",
    "who works in the kitchen?": "Nobody that I know of.",
    "which person works in Bob's office?": "Bob works in his office.",
    "does Sally work in the kitchen?": (
        "Not as far as I know: nothing tells me that Sally works in the kitchen. I only know that "
        "Sally works in her office."
    ),
    "is the library next to the kitchen?": (
        "Yes, the library is next to the kitchen. It follows from what I know: the map shows the "
        "kitchen beside the library."
    ),
    "was the library next to the kitchen at step 1?": (
        "Yes, the library is next to the kitchen. It follows from what I know: the map shows the "
        "kitchen beside the library."
    ),
    "what is next to the kitchen?": (
        "The bathroom, the library, Sally's office and Sarah's office are next to the kitchen."
    ),
    "which places is the library next to?": (
        "The library is next to Bob's office, John's office and the kitchen."
    ),
    "where is a printer?": "A printer is in the library.",
    "is there a printer in the library?": (
        "Yes, a printer is in the library. I know that from the beginning."
    ),
    "why do you believe that Sally works in her office?": (
        "I believe that Sally works in her office. I know that from the beginning."
    ),
    "who has the first message?": "I have the first message.",
    "where is the sofa?": "There is a sofa in Sally's office.",
    "why can't you move to Bob's office?": (
        'I could not move to Bob\'s office at step 3: "the robot moves to places next to its own", '
        "and I was in Sally's office and Sally's office is not next to Bob's office."
    ),
}


IN_HER_OFFICE = DELIVERED["is Sally in the kitchen?"]
DENIALS = {
    "why do you not believe that Sally is in her office?": (
        "But I do believe that Sally is in her office. I saw at step 3 that Sally was in her "
        "office."
    ),
    "why don't you think that Sally is in the kitchen?": (
        "I believe that Sally is not in the kitchen. I saw at step 1 that Sally was not in the "
        "kitchen; nothing that I know of has changed it since."
    ),
    "why do you not believe that the bathroom is cluttered?": DELIVERED[
        "is the bathroom cluttered?"
    ],
    "why did you not believe that you were in the kitchen at step 1?": (
        "But at step 1 I did believe that I was in the kitchen. I saw at step 1 that I was in "
        "the kitchen."
    ),
    "isn't Sally in the kitchen?": IN_HER_OFFICE,
    "is Sally not in the kitchen?": IN_HER_OFFICE,
    "don't you believe that Sally is in the kitchen?": IN_HER_OFFICE,
    "can't you tell me is Sally in the kitchen?": IN_HER_OFFICE,
    "would you please tell me whether Sally is in the kitchen?": IN_HER_OFFICE,
    "can't you tell me where Bob is?": DELIVERED["where is Bob?"],
    "don't you have the first message?": DELIVERED["do you have the first message?"],
    "is the kitchen not open?": DELIVERED["is the kitchen open?"],
}


PAST = {
    "why did you believe that you were in the kitchen?": (
        "At step 1 I believed that I was in the kitchen. I saw at step 1 that I was in the kitchen."
    ),
    "why did you believe that the first message for Sally was undelivered?": (
        "At step 2 I believed that the first message for Sally was undelivered. That is usual: "
        '"messages are not yet delivered"; nothing that I know of has changed it since.'
    ),
    "why did you not believe that you were in the kitchen?": (
        'At step 2 I believed that I was not in the kitchen. It follows from "nobody is at two '
        "places\": I was in Sally's office. I saw at step 2 that I was in Sally's office."
    ),
    "why did you believe that Bob was in the kitchen?": (
        "I do not believe that; I believe that Bob is not in the kitchen. I saw at step 1 that "
        "Bob was not in the kitchen; nothing that I know of has changed it since."
    ),
    "why do you believe that you are in the kitchen?": (
        'I do not believe that; I believe that I am not in the kitchen. It follows from "nobody '
        "is at two places\": I am in Sally's office. I saw at step 3 that I was in Sally's office."
    ),
}


ABOUT = {
    "not_begun": (BEFORE, SUPPOSED_EVENTS),
    "begun": (BEGUN,),
    "delivered": (DELIVERED, ALSO_ASKED, CONTRASTS, WAS, STATICS, DENIALS, PAST),
    "met": (MET,),
    "lost": (LOST,),
    "failed": (FAILED,),
    "shut_in": (SHUT_IN,),
}


@pytest.mark.parametrize(
    ("fixture", "question", "right"),
    [
        (fixture, question, right)
        for fixture, tables in ABOUT.items()
        for table in tables
        for question, right in table.items()
    ],
)
def test_answers_about_runs_in_the_office(
    request: pytest.FixtureRequest, fixture: str, question: str, right: str
) -> None:
    assert asked(request.getfixturevalue(fixture), question) == right


RECORDED = (
    "what did you do?",
    "what did you do at step 1?",
    "did you move to the kitchen?",
    "why did you move to the kitchen?",
    "why did you deliver the first message to Sally?",
    "why did you not move to Bob's office at step 0?",
    "are you done?",
)


@pytest.mark.parametrize("question", RECORDED)
def test_a_recorded_history_is_asked_as_its_run_is(delivered: Run, question: str) -> None:
    recorded = Run(TO_SALLY, read_history(str(delivered.history), OFFICE.knowledge.signature))
    assert asked(recorded, question) == asked(delivered, question)


@pytest.mark.parametrize("question", LOST)
def test_a_record_tells_why_its_plan_changed(lost: Run, question: str) -> None:
    recorded = Run(TO_SALLY, read_history(str(lost.history), OFFICE.knowledge.signature))
    assert asked(recorded, question) == LOST[question]


@pytest.fixture(scope="module")
def tower() -> tuple[PlanningDomain, Run]:
    domain = load_planning_domain(TOWER)
    goal = read_goal("height(b1, 3)", domain.knowledge)
    *_, run = execute(domain, goal, sensed=[], act=lambda _: [])
    return domain, run


ON_THE_SECOND = (
    "I put the first small box on the second small box at step 3 because my goal was that the "
    "height of the first small box is 3. "
)
ON_THE_TABLE = (
    f"{ON_THE_SECOND}Had I chosen to put the first small box on the table, the plan would have "
    "been longer: 3 actions (put the first small box on the table, pick up the first small box "
    "and put the first small box on the second small box) instead of 1."
)
ROLES = {
    "why did you put the first small box on the second small box rather than on the table?": (
        ON_THE_TABLE
    ),
    "why on the second small box rather than on the table?": ON_THE_TABLE,
    "why on the second small box rather than the table?": ON_THE_TABLE,
    "why on the second small box instead of on the table?": ON_THE_TABLE,
    "why on the second small box and not on the table?": ON_THE_TABLE,
    "why did you put the first small box rather than the ball on the second small box?": (
        f'{ON_THE_SECOND}I could not put the ball on the second small box at step 3: "only a box '
        'that is held can be put somewhere", and I did not hold the ball.'
    ),
    "why on the table?": "I did not put anything on the table.",
}


BOXES = {
    "why do you believe that the ball is round?": (
        "I believe that the ball is round. I know that from the beginning."
    ),
    "which boxes are large?": "The first large box and the second large box are large.",
    "is the roof round?": "Not as far as I know: nothing tells me that the roof is round.",
    "why does the second large box not stay on the ball?": (
        "I believe that the second large box does not stay on the ball. It follows from "
        '"nothing stays on a ball": the ball is round.'
    ),
    "who holds the ball?": "Nobody that I know of.",
    "what is the height of the first small box?": "The height of the first small box is 3.",
}


@pytest.mark.parametrize("question", [*ROLES, *BOXES])
def test_answers_about_boxes(tower: tuple[PlanningDomain, Run], question: str) -> None:
    domain, run = tower
    assert asked(run, question, domain) == (ROLES | BOXES)[question]


def test_an_action_is_also_done_for_what_it_removes() -> None:
    domain = load_planning_domain(TOWER)
    goal = read_goal("holding(rob1, b3)", domain.knowledge)
    *_, run = execute(domain, goal, sensed=[], act=lambda _: [])
    reply = answer(domain, run, "why did you pick up the ball?")
    assert reply.text == (
        "I picked up the ball at step 0 because I wanted to put the ball on the table, in order to "
        'pick up the first large box. Otherwise I could not have done that: "only a box that is '
        'held can be put somewhere", and I did not hold the ball. It also removed what stood in '
        'the way of picking up the first large box: "a box that carries another cannot be picked '
        'up", and the ball was on the first large box.'
    )
    removed = reply.reasons["removed"]
    assert (removed["action"], removed["changed"]) == ("pick_up(rob1,b3)", ["on(b5,b3)"])
    # What is told as what the next action needs is not told again.
    assert asked(run, "why did you put the ball on the table?", domain) == (
        "I put the ball on the table at step 1 because I wanted to pick up the first large box. "
        'Otherwise I could not have done that: "the gripper picks up one box at a time", and I '
        "held the ball."
    )


@pytest.mark.parametrize(
    "question",
    ["where is Sally rather than Bob?", "why did you move to the kitchen rather than to Harry?"],
)
def test_a_contrast_that_is_not_understood_is_not_passed_over(
    delivered: Run, question: str
) -> None:
    with pytest.raises(QuestionError, match="is not understood"):
        answer(OFFICE, delivered, question)


def test_a_robot_says_why_it_gave_up(shut_in: Run) -> None:
    said = (
        "I gave up: the goal could not be reached, since Bob's office, John's office and the "
        "kitchen were closed."
    )
    assert asked(shut_in, "why did you give up?") == said
    assert asked(shut_in, "did you reach your goal?") == f"No, {said}"


def test_who_fails_says_so_when_asked(failed: Run) -> None:
    assert asked(failed, "did you move to Sally's office at step 1?") == (
        "No, I tried to move to Sally's office at step 1 and failed."
    )
    assert asked(failed, "did you move to Sally's office?") == (
        "Yes, I moved to Sally's office at step 2."
    )


def test_a_plan_that_was_as_short_is_no_worse(begun: Run) -> None:
    assert asked(begun, "why did you not move to Sally's office at step 1?") == (
        "I could as well: that plan has 3 actions too."
    )


BECAUSE_OF_SALLY = (
    "I have not done anything yet. I would move to the kitchen because I want to move to Sally's "
    'office, in order to deliver the first message to Sally. Otherwise I could not do that: "the '
    'robot moves to places next to its own", and I am in the library and the library is not next '
    "to Sally's office."
)
LONGER = (
    "plan would be longer: 5 actions (move to Bob's office, move to the library, move to the "
    "kitchen, move to Sally's office and deliver the first message to Sally) instead of 3."
)
ONLY_PLANNED = {
    "why did you move to the kitchen?": BECAUSE_OF_SALLY,
    "why did you deliver the first message to Sally?": (
        "I have not done anything yet. I would deliver the first message to Sally as action 3 of "
        "my plan because my goal is that the first message for Sally is delivered."
    ),
    "why did you move to the library?": (
        "I have not done anything yet, and I would not move to the library."
    ),
    "did you move to the kitchen?": "No, I have not done anything yet.",
    "why did you not move to the kitchen?": (
        "But I would move to the kitchen: nothing is done yet, and my plan begins with that."
    ),
    "why did you not deliver the first message to Sally?": (
        "But I would deliver the first message to Sally later: it is action 3 of my plan."
    ),
    "why not the library instead?": (
        'I cannot move to the library now: "the robot does not move to where it is", and I am in '
        "the library."
    ),
    "why don't you go to Bob's office?": f"The {LONGER}",
    "why to the kitchen rather than to Bob's office?": (
        f"{BECAUSE_OF_SALLY} If I chose to move to Bob's office, the {LONGER}"
    ),
}


ONLY_PLANNED |= {
    "are you done?": "No, I have not done anything yet.",
    "why did you stop?": "I did not. I have not done anything yet.",
    "why did you give up?": "I did not. I have not done anything yet.",
    "why did the plan change?": "I have not done anything yet, and my plan has not changed.",
    "why can you not move to Sally's office?": (
        'I cannot move to Sally\'s office now: "the robot moves to places next to its own", and I '
        "am in the library and the library is not next to Sally's office; it is action 2 of my "
        "plan."
    ),
}


def test_who_has_nothing_to_do_is_done() -> None:
    there = Run(read_goal("loc(rob1, library)", OFFICE.knowledge), OFFICE.history)
    assert asked(there, "are you done?") == "Yes, the goal is reached."
    assert asked(there, "why did you stop?") == "I did not. The goal is reached."


def test_who_sees_no_way_says_so_before_anything_is_done() -> None:
    shut = "observed loc(rob1, library) at 0. observed -loc(sally, library) at 0."
    shut += "".join(
        f" observed closed({place}) at 0." for place in ("kitchen", "bobs_office", "johns_office")
    )
    run = Run(TO_SALLY, read_history(shut, OFFICE.knowledge.signature))
    no_way = (
        "the goal cannot be reached, since Bob's office, John's office and the kitchen are closed "
        "and Sally is not in the library."
    )
    assert asked(run, "what is your plan?") == f"I have no plan: {no_way}"
    assert asked(run, "are you done?") == f"No, {no_way}"


@pytest.mark.parametrize("question", ONLY_PLANNED)
def test_of_a_plan_nothing_is_said_to_be_done(not_begun: Run, question: str) -> None:
    assert asked(not_begun, question) == ONLY_PLANNED[question]


MELTING = """
#fluent basic key. #fluent basic open. #action unlock. #action melt.
unlock causes open. melt causes -key.
%% who has no key opens nothing
impossible unlock if not key.
"""


def test_what_would_have_left_no_way_to_the_goal() -> None:
    known = read_knowledge(MELTING)
    words = PlanningWords(
        {},
        {"open": FluentTable(say="the door is open"), "key": FluentTable(say="the key is here")},
        {
            "unlock": ActionTable(do="unlock the door", did="unlocked the door"),
            "melt": ActionTable(do="melt the key", did="melted the key"),
        },
    )
    past = read_history("observed key at 0. observed -open at 0.", known.signature)
    domain = replace(
        OFFICE, knowledge=known, history=past, words=words, sensing=(), robot=None, map=None
    )
    *_, last = execute(domain, read_goal("open", known), sensed=[], act=lambda _: [])
    assert asked(last, "why did you not melt the key?", domain) == (
        "I could have, but had I melted the key at step 0, the goal could not have been reached "
        "any more."
    )
    assert asked(last, "did you melt the key?", domain) == "No, I did not melt the key."


def test_a_hope_that_was_disappointed_is_why_the_plan_changed(
    transitions: TransitionFunction,
) -> None:
    run = office_run(transitions, "loc(sally,johns_office)")
    told = asked(run, "why did the plan change?").split(" At step ")
    assert told[0].startswith("At step 2 I saw that Sally was not in her office. ")
    assert any(line[2:].startswith("I saw that Sally was not in ") for line in told[1:])
    assert all("Sally was in her office" not in line for line in told)


def test_what_a_sensor_got_wrong_is_said(transitions: TransitionFunction) -> None:
    state = transitions.complete(sorted(diagnose(OFFICE.knowledge, OFFICE.history).states[0].holds))
    erring = replace(OFFICE, sensing=tuple(replace(sensor, error=0.1) for sensor in OFFICE.sensing))
    steps = itertools.count()

    def act(action: clingo.Symbol) -> list[Literal]:
        nonlocal state
        state = transitions.after(state, [action]) or state
        if next(steps):
            return seen_in(state)
        right = [one for one in seen_in(state) if one.predicate != "loc"]
        return [*right, literal_of("loc(rob1, bathroom)")]

    *_, last = execute(erring, TO_SALLY, sensed=seen_in(state), act=act)
    (misread,) = last.steps[1].surprises
    assert (misread.kind.value, str(misread.what)) == ("misread", "loc(rob1,bathroom)")
    assert asked(last, "what did you do?", erring) == (
        "I moved to the kitchen. At step 1 I found that it was seen wrongly at step 1 that I was "
        "in the bathroom. I moved to Sally's office and delivered the first message to Sally. The "
        "goal is reached."
    )
    assert asked(last, "where were you at step 1?", erring) == (
        'I was in the kitchen. I moved to the kitchen at step 0, and "who moves to a place is '
        'there".'
    )


def test_spelling_case_and_articles_are_forgiven(delivered: Run) -> None:
    plain = asked(delivered, "why did you move to the kitchen at step 0?")
    assert asked(delivered, "WHY did you go to kichen, at step 0") == plain
    assert asked(delivered, "why did you move to kitchen?") == plain


def test_reasons_are_a_tree_down_to_a_default(delivered: Run) -> None:
    reply = answer(OFFICE, delivered, "why do you believe that Sally is in her office at step 1?")
    why = reply.reasons["why"]
    assert (why["basis"], why["step"]) == ("unchanged", 1)
    (usual,) = why["children"]
    assert (usual["basis"], usual["step"]) == ("usual", 0)
    assert usual["axiom"] == "people are in their own office unless they are elsewhere"


def test_what_needed_an_action_is_told_to_the_goal(delivered: Run) -> None:
    reply = answer(OFFICE, delivered, "why did you move to the kitchen?")
    assert [need["action"] for need in reply.reasons["needed_by"]] == [
        "move(rob1,sallys_office)",
        "deliver(rob1,m1,sally)",
        None,
    ]


REFUSED = {
    "": (
        "the question is empty; ask for instance: what is your plan? · what did you do? · how "
        "many actions did you do?"
    ),
    "where is Harry?": "'where is Harry?' is not understood; ask for instance: where is Bob? · "
    "where is a desk? · where is a printer?",
    "is the kitchen cosy?": (
        "'is the kitchen cosy?' is not understood; ask for instance: is the kitchen closed? · "
        "is the first message for Bob undelivered? · is Bob in the kitchen?"
    ),
    "tell me a joke": (
        "'tell me a joke' is not understood; ask for instance: is Bob's office open? · does Bob "
        "work in Bob's office? · do you have the first message?"
    ),
    "where is Sally at step 9?": (
        "there is no step 9 yet: the run has come to step 3; ask about step 0 to 3"
    ),
}


@pytest.mark.parametrize("question", REFUSED)
def test_what_is_not_understood_names_the_nearest_questions(delivered: Run, question: str) -> None:
    with pytest.raises(QuestionError) as refused:
        answer(OFFICE, delivered, question)
    assert str(refused.value) == REFUSED[question]


KNOWLEDGE = """
#sort lamp = {red_lamp, blue_lamp}.
#sort colour = {dim, bright}.
#static wired(lamp).
wired(red_lamp).
wired(blue_lamp).
#fluent basic power.
#fluent basic lit(lamp).
#fluent basic light(lamp, colour).
#fluent defined festive.
#action press(lamp).
#action turn(lamp, colour).
#action connect.
#action exogenous outage.
%% a wired lamp that is switched on is lit
press(L) causes lit(L) if wired(L).
turn(L, C) causes light(L, C).
%% connecting brings power
connect causes power.
outage causes -power.
%% a lamp has one brightness
-light(L, C2) if light(L, C1), C1 != C2.
%% no switch works without power
impossible press(L) if not power.
impossible press(L) if lit(L).
%% the red lamp is switched on after the blue one
impossible press(red_lamp) if not lit(blue_lamp).
%% a dark lamp cannot be turned
impossible turn(L, C) if not lit(L).
impossible connect if power.
impossible outage if not power.
default -power.
default -lit(L).
%% lamps are dim when they are bought
default light(L, dim).
%% it is festive where two lamps are lit
festive if #count { L : lit(L) } >= 2.
"""
WORDS = """
[planning]
name = "lamps"
title = "Two lamps"

[things]
red_lamp = "the red lamp"
blue_lamp = "the blue lamp"

[fluents.power]
say = "there is power"
deny = "there is no power"

[fluents.lit]
say = "{0} is lit"
deny = "{0} is dark"

[fluents.light]
say = "{0} shines {1}"

[fluents.festive]
say = "it is festive"
deny = "it is not festive"

[actions.press]
do = "switch on {0}"
did = "switched on {0}"

[actions.turn]
do = "turn {0} to {1}"
did = "turned {0} to {1}"

[actions.connect]
do = "connect the power"
did = "connected the power"

[actions.outage]
did = "the power failed"

[[sensing]]
literal = "lit(L)"
where = "lamp(L)"
"""


@pytest.fixture(scope="module")
def lamps(tmp_path_factory: pytest.TempPathFactory) -> tuple[PlanningDomain, Run]:
    folder = tmp_path_factory.mktemp("lamps")
    (folder / "knowledge.al").write_text(KNOWLEDGE, encoding="utf-8")
    (folder / "planning.toml").write_text(WORDS, encoding="utf-8")
    domain = load_planning_domain(folder)
    goal = read_goal("light(red_lamp, bright), lit(blue_lamp)", domain.knowledge)
    *_, run = execute(domain, goal, sensed=[], act=lambda _: [])
    return domain, run


LAMPS = {
    "is the red lamp lit?": (
        'Yes, the red lamp is lit. I switched on the red lamp at step 2, and "a wired lamp '
        'that is switched on is lit"; nothing that I know of has changed it since.'
    ),
    "is the red lamp dark?": (
        'No, the red lamp is lit. I switched on the red lamp at step 2, and "a wired lamp that '
        'is switched on is lit"; nothing that I know of has changed it since.'
    ),
    "is there power at step 0?": "No, there was no power. That is usual.",
    "is it festive?": "Yes, it is festive because the blue lamp and the red lamp are lit.",
    "is it festive at step 1?": (
        'No, it was not festive: I know of nothing that would make it otherwise, and "it is '
        'festive where two lamps are lit".'
    ),
    "does the red lamp shine bright?": (
        "Yes, the red lamp shines bright. I turned the red lamp to bright at step 3."
    ),
    "what was your plan at step 2?": (
        "At step 2 my plan was to switch on the red lamp and turn the red lamp to bright."
    ),
    "what did you do?": (
        "I connected the power, switched on the blue lamp, switched on the red lamp and turned "
        "the red lamp to bright. The goal is reached."
    ),
    "what is your goal?": "My goal is that the red lamp shines bright and the blue lamp is lit.",
    "why did you connect the power?": (
        "I connected the power at step 0 because I wanted to switch on the blue lamp, in order "
        "to turn the red lamp to bright. Otherwise I could not have done that: "
        '"no switch works without power", and there was no power.'
    ),
    "why did you switch on the blue lamp?": (
        "I switched on the blue lamp at step 1 because I wanted to switch on the red lamp, in "
        "order to turn the red lamp to bright. Otherwise I could not have done that: "
        '"the red lamp is switched on after the blue one", and the blue lamp was dark.'
    ),
    "why did you turn the red lamp to bright?": (
        "I turned the red lamp to bright at step 3 because my goal was that the red lamp "
        "shines bright."
    ),
    "why did you not switch on the blue lamp at step 0?": (
        'I could not switch on the blue lamp at step 0: "no switch works without power", and '
        "there was no power."
    ),
    "why did you not turn the red lamp to dim?": (
        "The plan would have been longer: 2 actions (turn the red lamp to dim and turn the red "
        "lamp to bright) instead of 1."
    ),
    "why is there power?": (
        'I believe that there is power. I connected the power at step 0, and "connecting '
        'brings power"; nothing that I know of has changed it since.'
    ),
    "why does the blue lamp shine dim?": (
        'I believe that the blue lamp shines dim. That is usual: "lamps are dim when they are '
        'bought"; nothing that I know of has changed it since.'
    ),
    "is the red lamp wired?": "Yes, the red lamp is wired. I know that from the beginning.",
    "what is wired?": "The blue lamp and the red lamp are wired.",
    "why is the red lamp wired?": (
        "I believe that the red lamp is wired. I know that from the beginning."
    ),
    "what would you do if there were no power at step 1?": (
        "If there were no power, I would connect the power, switch on the blue lamp, switch on "
        "the red lamp and turn the red lamp to bright: 4 actions instead of 3."
    ),
}


@pytest.mark.parametrize("question", LAMPS)
def test_answers_in_any_other_domain(lamps: tuple[PlanningDomain, Run], question: str) -> None:
    domain, run = lamps
    assert asked(run, question, domain) == LAMPS[question]


@pytest.mark.parametrize(
    ("question", "right"),
    [
        ("how many actions did you do?", "I did 5 actions."),
        ("how many actions did you do at step 2?", "I did 2 actions."),
        ("who is in the library?", "I know of nobody in the library."),
        (
            "what was your plan at step 2?",
            "At step 2 my plan was to move to the kitchen, move to the bathroom and deliver the "
            "first message to Sally. My plan only supposed that Sally was in the bathroom, which I "
            "did not know.",
        ),
        (
            "where was Sally at step 2?",
            "I do not know where Sally is. I only know that Sally is not in the kitchen, the "
            "library or her office.",
        ),
        (
            "why not Bob's office at step 2?",
            "I could not move to Bob's office at step 2: \"the robot moves to places next to its "
            "own\", and I was in Sally's office and Sally's office is not next to Bob's office.",
        ),
    ],
)
def test_a_search_tells_what_was_believed_and_what_was_supposed(
    transitions: TransitionFunction, question: str, right: str
) -> None:
    searched = office_run(transitions, "loc(sally,bathroom)")
    assert asked(searched, question) == right


def test_what_was_believed_otherwise_is_told_beside_what_a_plan_supposes(
    transitions: TransitionFunction,
) -> None:
    def late(step: int, state: World) -> World:
        walked = [term("walk(sally,library)")]
        return transitions.after(state, walked) or state if step == 12 else state

    run = office_run(transitions, "loc(sally,bathroom)", "closed(bathroom)", script=late)
    assert run.steps[9].doubted
    assert asked(run, "what was your plan at step 9?") == (
        "At step 9 my plan was to move to the library, move to the kitchen, move to Sally's office "
        "and deliver the first message to Sally. My plan only supposed that Sally was in her "
        "office: what I believed, that Sally was not in her office, might have changed."
    )


def test_what_is_mine_is_said_in_the_first_person() -> None:
    has = OFFICE.words.fluents["has"].model_copy(update={"say": "the bucket of {0} is empty"})
    words = replace(OFFICE.words, fluents={**OFFICE.words.fluents, "has": has})
    assert Speech(words).said(term("has(rob1,m1)")) == "my bucket was empty"
    assert Speech(words).say(term("has(sally,m1)")) == "the bucket of Sally is empty"
