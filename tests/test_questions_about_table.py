"""Questions about a run of the hand: things by descriptions, expectations, the table as it is."""

from __future__ import annotations

from pathlib import Path

import clingo
import pytest

from conftest import Run as RunCommand
from desk_builder import write_domain
from seewhy.data.thing_scene import thing_scene
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import literal_of
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.dialogue.run_answers import RunAnswers
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.execution import Run, execute
from seewhy.planning.execution.transition_function import TransitionFunction
from seewhy.planning.spoken_goals import goal_of
from seewhy.planning.things.initial_scene import SceneOfPlan
from seewhy.planning.things.scene_answers import believed_scene


@pytest.fixture(scope="module")
def table() -> PlanningDomain:
    return load_planning_domain("tabletop")


@pytest.fixture(scope="module")
def answers(table: PlanningDomain) -> RunAnswers:
    """A run in which the green cube falls off once, and is put there again."""
    transitions = TransitionFunction(table.knowledge)
    state = transitions.complete([_symbol(seen.literal) for seen in table.history.observations])
    acted = 0

    def act(action: object) -> list[Literal]:
        nonlocal state, acted
        acted += 1
        names = {str(event): event for event in transitions.events}
        happening = [names["drop(thing3)"]] if acted == 4 else [action]
        following = transitions.after(state, happening)
        assert following is not None
        state = following
        return [
            literal_of(str(fluent)) if fluent in state else literal_of(str(fluent)).complement
            for fluent in transitions.fluents
            if fluent.name in ("on", "holding")
        ]

    goal = goal_of("put the small ball on the table and the green cube is on the cylinder", table)
    *_, run = execute(table, goal, sensed=[], act=act)
    return RunAnswers(table, run)


def _symbol(literal: Literal) -> object:
    import clingo

    return clingo.parse_term(str(literal).replace(" ", ""))


GREEN = "the large green rubber cube"
BALL = "the small purple metal sphere"
CYLINDER = "the large yellow rubber cylinder"
ANSWERS = {
    "why did you move the small ball first?": (
        f"I picked up {BALL} at step 0 because I wanted to put {BALL} on the table, in order to "
        f'put {GREEN} on {CYLINDER}. Otherwise I could not have done that: "only a thing that is '
        f'held can be put on the table", and I did not hold {BALL}. It also removed what stood in '
        f'the way of picking up {GREEN}: "a thing that carries another is not picked up", and '
        f"{BALL} was on {GREEN}."
    ),
    "what did you expect, and what happened?": (
        f"I tried to put {GREEN} on {CYLINDER} at step 3 and expected that {GREEN} is on "
        f"{CYLINDER}. Instead I saw that {GREEN} was not on {CYLINDER}. So I concluded that the "
        f"attempt to put {GREEN} on {CYLINDER} at step 3 failed and {GREEN} fell on the table "
        "after step 3."
    ),
    "what did you expect at step 2?": "All that I saw at step 2 was as I expected.",
    "why did you pick up the green block first?": (
        f"I picked up {GREEN} at step 2 because I wanted to put {GREEN} on {CYLINDER}. Otherwise "
        f'I could not have done that: "only a thing that is held can be put on another", and I '
        f"did not hold {GREEN}."
    ),
    "did you move the green cube?": f"Yes, I picked up {GREEN} at steps 2 and 4.",
    "why did you not put the green cube on the gray ball?": (
        f'I could not put {GREEN} on the large gray metal sphere at step 5: "a thing is not put '
        'on a ball, on which nothing stays", and the large gray metal sphere is a sphere.'
    ),
    # What is asked of things is asked of the table as it is now.
    "what would happen if the yellow cylinder were removed?": f"The {GREEN[4:]} would fall.",
    "why would the green cube fall if the cylinder were removed?": None,
    "how many cubes are on the cylinder?": f"There is one cube on {CYLINDER}: {GREEN}.",
    "is the small ball on a cube?": f"No, {BALL} is not on a cube.",
    "what colour is the thing on the cylinder?": f"The {GREEN[4:]} is green.",
    "is the small ball left of the cylinder?": "I don't know",
    "is the red cube left of the blue cube?": (
        "Yes, the small red metal cube is left of the small blue rubber cube."
    ),
}


@pytest.mark.parametrize("question", ANSWERS)
def test_answers_about_the_table(question: str, answers: RunAnswers) -> None:
    text = answers.answer(question).text
    said = ANSWERS[question]
    if said is None:
        assert text
    else:
        assert text.startswith(said)


def test_why_goes_with_the_answer_about_things_before(answers: RunAnswers) -> None:
    answers.answer("how many cubes are on the cylinder?")
    assert GREEN in answers.answer("why?").text
    answers.answer("what is your goal?")
    with pytest.raises(QuestionError):
        answers.answer("why?")


@pytest.mark.parametrize(
    "question",
    [
        "did the red cube fall?",
        "why did the red cube fall?",
        "what will be on the red cube?",
        "where was the red cube?",
        "how many cubes were on the cylinder?",
    ],
)
def test_the_scene_as_it_is_now_tells_nothing_of_another_time(
    answers: RunAnswers, question: str
) -> None:
    with pytest.raises(QuestionError):
        answers.answer(question)


def test_it_is_asked_which_of_several(answers: RunAnswers) -> None:
    with pytest.raises(QuestionError) as problem:
        answers.answer("why did you put the cube on the table?")
    assert str(problem.value) == (
        "Which cube? There are three: the small red metal cube, the small blue rubber cube and "
        f"{GREEN}."
    )


def test_what_is_planned_is_told_why(table: PlanningDomain) -> None:
    goal = goal_of("pick up the green cube", table)
    text = (
        RunAnswers(table, Run(goal, table.history)).answer("why will you move the small ball?").text
    )
    assert text == (
        f"I have not done anything yet. I would pick up {BALL} because I want to put {BALL} on the "
        f"table, in order to pick up {GREEN}. Otherwise I could not do that: "
        f'"only a thing that is held can be put on the table", and I do not hold {BALL}.'
    )


def test_a_run_of_no_things_tells_what_it_expected() -> None:
    office = load_planning_domain("robot_assistant")
    goal = goal_of("move to the kitchen", office)
    *_, run = execute(
        office, goal, sensed=[], act=lambda _: [literal_of("-loc(rob1,kitchen)")], most_steps=2
    )
    text = RunAnswers(office, run).answer("what did you expect?").text
    assert text.startswith(
        "I tried to move to the kitchen at step 0 and expected that I am in the kitchen. "
        "Instead I saw that I was not in the kitchen."
    )


def test_questions_on_the_command_line(run: RunCommand) -> None:
    asked = ("--ask", "is there a ball on the cylinder?", "--ask", "what is your plan?")
    done = run("plan", "tabletop", "--goal", "clear the green cube", *asked)
    assert done.code == 0
    assert f"No: there is no sphere on {CYLINDER}." in done.out
    assert f"My plan is to pick up {BALL}." in done.out


# What is seen of a thing, and changes


@pytest.mark.parametrize(
    ("believed", "open_", "colour", "heavy"),
    [
        ((), (), "red", "yes"),
        (("colour(thing1,blue)", "heavy(thing1)"), (), "blue", "yes"),
        (("-colour(thing1,red)", "-heavy(thing1)"), (), None, "no"),
        ((), ("colour(thing1,red)", "heavy(thing1)"), None, None),
    ],
)
def test_a_thing_is_now_as_it_is_believed_to_be(
    believed: tuple[str, ...],
    open_: tuple[str, ...],
    colour: str | None,
    heavy: str | None,
    tmp_path: Path,
) -> None:
    domain = load_domain(write_domain(tmp_path / "desk"))
    assert domain.things is not None
    scene = thing_scene(domain.things, [{"colour": "red", "heavy": "yes"}], relations={})
    state = State(
        frozenset(map(clingo.parse_term, believed)), frozenset(map(clingo.parse_term, open_))
    )
    values = believed_scene(SceneOfPlan(domain, scene), state).values
    assert (values["colour"][0], values["heavy"][0]) == (colour, heavy)
