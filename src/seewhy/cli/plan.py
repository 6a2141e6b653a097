"""`seewhy plan`: a shortest plan to a goal, from what is known."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from seewhy.cli.options import DomainName, Json
from seewhy.cli.robot import Learned, Without, with_knowledge_of_robot
from seewhy.cli.run_questions import (
    Ask,
    Chat,
    ask_all,
    exit_if_not_understood,
    show_answers,
    talk,
)
from seewhy.cli.scene_of_plan import (
    BeginningScene,
    PictureFile,
    SceneFile,
    SceneNumber,
    ThingModelFolder,
)
from seewhy.cli.screen import print_json, remark, say

if TYPE_CHECKING:
    from clingo import Symbol

    from seewhy.planning.goal import Goal
    from seewhy.planning.planner.pddl import PddlProblem
    from seewhy.planning.planner.planner import Plan
    from seewhy.planning.words import PlanningWords

GoalText = Annotated[
    str,
    typer.Option(
        "--goal",
        help='What shall hold, such as "loc(rob1, kitchen), not closed(library)", or in words, '
        'such as "move to the kitchen".',
    ),
]
Observed = Annotated[
    list[str] | None,
    typer.Option("--observed", help="What is seen at first, besides; may be given several times."),
]


def plan(
    domain: DomainName,
    goal: GoalText,
    observed: Observed = None,
    history: Annotated[
        Path | None,
        typer.Option("--history", help="What was seen and done so far, instead of history.al."),
    ] = None,
    horizon: Annotated[
        int | None, typer.Option("--horizon", min=0, help="The most actions to try.")
    ] = None,
    pddl: Annotated[
        Path | None,
        typer.Option("--pddl", help="Also write domain.pddl and problem.pddl to this folder."),
    ] = None,
    ask: Ask = None,
    chat: Chat = False,
    learned: Learned = None,
    without: Without = None,
    scene: SceneFile = None,
    image: SceneNumber = None,
    picture: PictureFile = None,
    model: ThingModelFolder = None,
    json: Json = False,
) -> None:
    """Find a shortest plan to a goal, and answer questions about it.

    Plans about the things of a picture begin with those of an annotated scene (--scene), or with
    those that a model sees (--picture and --model). With --history, what was done so far can be
    asked about like a run: --history takes what 'seewhy simulate --record' writes.
    """
    from seewhy.knowledge.ground_literal import read_ground_literal
    from seewhy.planning.diagnosis.diagnosis import diagnose
    from seewhy.planning.dialogue.run_answers import RunAnswers
    from seewhy.planning.execution.execution import Run
    from seewhy.planning.execution.plan_monitoring import suppositions
    from seewhy.planning.planner.pddl import to_pddl
    from seewhy.planning.planner.planner import PlanStatus
    from seewhy.planning.planner.planner import plan as find_plan
    from seewhy.planning.spoken_goals import goal_of
    from seewhy.planning.unreachable import why_unreachable

    begin = BeginningScene(scene, image, picture, model)
    robot_domain = with_knowledge_of_robot(
        begin.planning_domain(domain), learned=learned, without=without
    )
    knowledge = robot_domain.knowledge
    aim = goal_of(goal, robot_domain)
    past = robot_domain.history_of(history) if history else robot_domain.history
    seen = [read_ground_literal(text, knowledge.signature, of="fluent") for text in observed or ()]
    past = past.with_observations(seen, step=past.last_step)
    known = diagnose(knowledge, past, sensors_err=robot_domain.sensors_err)
    if pddl is not None:
        _write_pddl(to_pddl(knowledge, aim, start=known.now), pddl)
    most = robot_domain.horizon if horizon is None else horizon
    found = find_plan(
        knowledge, aim, start=known.now, horizon=most, answer_sets=robot_domain.answer_sets
    )
    why = None
    if found.status in (PlanStatus.UNREACHABLE, PlanStatus.NOT_WITHIN_HORIZON):
        why = why_unreachable(robot_domain, aim, known.now)
    if why is not None:  # no horizon would do
        found = replace(found, status=PlanStatus.UNREACHABLE)
    supposed: tuple[Symbol, ...] = ()
    if found.settles(known.now):
        supposed = suppositions(knowledge, aim, found.actions, start=known.now)
    answers = (
        RunAnswers(replace(robot_domain, horizon=most), Run(aim, past)) if ask or chat else None
    )
    asked = [] if answers is None else ask_all(answers, ask)
    if json:
        replies = {"replies": [reply.to_dict() for reply in asked]} if ask else {}
        print_json({**_to_dict(found, aim, supposed, why), **replies}, lines=not chat)
    else:
        for surprise in known.surprises:
            say(f"It must be that {robot_domain.words.surprise(surprise)}.")
        _show(found, robot_domain.words, supposed, why)
        show_answers(asked)
    if chat and answers is not None:
        talk(answers, json=json)
    exit_if_not_understood(asked)
    if not found.found:
        raise typer.Exit(1)


def _write_pddl(problem: PddlProblem, folder: Path) -> None:
    from seewhy.files.whole_files import write_whole

    folder.mkdir(parents=True, exist_ok=True)
    write_whole(folder / "domain.pddl", problem.domain)
    write_whole(folder / "problem.pddl", problem.problem)
    remark(f"the problem for other planners is in {folder}")


def _show(found: Plan, words: PlanningWords, supposed: tuple[Symbol, ...], why: str | None) -> None:
    from seewhy.planning.planner.planner import PlanStatus

    if found.status is PlanStatus.ALREADY_TRUE:
        holds = "may hold" if supposed else "holds"
        say(f"The goal {holds} already; nothing is to be done.")
    elif found.status is PlanStatus.FOUND:
        for number, action in enumerate(found.actions, start=1):
            say(f"{number:3}. {words.do(action)}")
        count = f"{len(found.actions)} action{'s' * (len(found.actions) != 1)}"
        say(f"{count}, found in {1000 * found.seconds:.0f} ms; no plan is shorter.")
    elif found.status is PlanStatus.UNREACHABLE:
        say(f"The goal cannot be reached: {why or 'no sequence of actions leads to it'}.")
    elif found.status is PlanStatus.NOT_WITHIN_HORIZON:
        say(
            f"No plan of at most {found.horizon} actions reaches the goal; try a greater --horizon."
        )
    for supposition in supposed if found.found else ():
        say(f"This supposes that {words.say(supposition)}, which is not known.")


def _to_dict(
    found: Plan, goal: Goal, supposed: tuple[Symbol, ...], why: str | None
) -> dict[str, Any]:
    return {
        "goal": goal.text,
        "status": found.status.value,
        "why_not": why,
        "actions": [str(action) for action in found.actions],
        "supposed": [str(supposition) for supposition in supposed],
        "states": [[str(literal) for literal in state.positive()] for state in found.states],
        "horizon": found.horizon,
        "seconds": round(found.seconds, 4),
    }
