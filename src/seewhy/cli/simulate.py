"""`seewhy simulate`: a robot pursues a goal in a simulated world, as it happens."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from seewhy.cli.options import DomainName, Json, Seed
from seewhy.cli.plan import GoalText
from seewhy.cli.robot import Learned, Without, robot_options, with_knowledge_of_robot
from seewhy.cli.run_questions import (
    Ask,
    Chat,
    ask_all,
    exit_if_not_understood,
    show_answers,
    talk,
)
from seewhy.cli.scene_of_plan import BeginningScene, SceneFile, SceneNumber
from seewhy.cli.screen import print_json, remark, say

if TYPE_CHECKING:
    from seewhy.planning.domain import PlanningDomain
    from seewhy.planning.execution.sight import Sight
    from seewhy.planning.execution.simulation import Simulation


def simulate(
    domain: DomainName,
    goal: GoalText,
    seed: Seed = 0,
    model: Annotated[
        Path | None,
        typer.Option(
            "--model",
            help="Let the networks of this model see: the robot takes pictures, which are drawn.",
        ),
    ] = None,
    steps: Annotated[int, typer.Option("--steps", min=1, help="The most actions to do.")] = 60,
    out: Annotated[
        Path | None, typer.Option("--out", help="Also write the run to this .html file.")
    ] = None,
    ask: Ask = None,
    chat: Chat = False,
    record: Annotated[
        Path | None,
        typer.Option("--record", help="Also write what was seen and done to this .al file."),
    ] = None,
    learned: Learned = None,
    without: Without = None,
    at_first: Annotated[
        list[str] | None,
        typer.Option(
            "--at-first",
            metavar="LITERAL",
            help="What is so in the world at first, whatever else is random, such as "
            '"closed(library)"; may be given several times.',
        ),
    ] = None,
    scene: SceneFile = None,
    image: SceneNumber = None,
    json: Json = False,
) -> None:
    """Simulate a robot that plans, acts, is surprised, and plans anew.

    With --chat and --json the run is one line of JSON, and so is every answer. The world follows
    knowledge.al, whatever the robot knows of it.
    """
    from seewhy.planning.dialogue.run_answers import RunAnswers
    from seewhy.planning.execution.execution import Outcome
    from seewhy.planning.execution.run_narration import narrate_end, narrate_step
    from seewhy.planning.execution.simulation import ground_fluents
    from seewhy.planning.execution.simulation import simulate as run_simulation
    from seewhy.planning.spoken_goals import goal_of
    from seewhy.planning.unreachable import why_unreachable

    _check_endings(out, record)
    world = BeginningScene(scene, image).planning_domain(domain)
    robot_domain = with_knowledge_of_robot(world, learned=learned, without=without)
    aim = goal_of(goal, robot_domain)
    sight = None if model is None else _sight(robot_domain, model)
    start = ground_fluents(at_first or (), world.knowledge)
    last: Simulation | None = None
    interrupted = False
    try:
        for last in run_simulation(
            robot_domain,
            aim,
            seed=seed,
            most_steps=steps,
            world=world,
            sight=sight,
            at_first=start,
        ):
            step = last.run.steps[-1]
            if not json:
                for number, sentence in enumerate(narrate_step(robot_domain.words, step)):
                    say(f"{step.number:3}  {sentence}" if number == 0 else f"     {sentence}")
    except KeyboardInterrupt:
        interrupted = True
    if last is None:
        raise KeyboardInterrupt
    run = last.run
    answers = RunAnswers(robot_domain, run)
    asked = ask_all(answers, ask)
    if json:
        told = {**_to_dict(last, seed), "replies": [reply.to_dict() for reply in asked]}
        print_json(told, lines=not chat)
    else:
        say(narrate_end(run))
        if run.outcome is Outcome.IMPOSSIBLE:
            why = why_unreachable(robot_domain, aim, run.steps[-1].believed)
            if why is not None:
                say(f"The goal cannot be reached: {why}.")
        say(f"In truth it {'is' if last.achieved else 'is not'} reached.")
        show_answers(asked)
    command = f'seewhy simulate {domain} --goal "{goal}" --seed {seed}'
    command += "" if model is None else f" --model {model}"
    command += "" if scene is None else f" --scene {scene}"
    command += "" if image is None else f" --image {image}"
    command += "".join(f' --at-first "{literal}"' for literal in at_first or ())
    command += robot_options(learned=learned, without=without)
    _write(robot_domain, last, out=out, record=record, command=command)
    if chat:
        talk(answers, json=json)
    if interrupted:
        raise KeyboardInterrupt
    exit_if_not_understood(asked)
    if not last.achieved:
        raise typer.Exit(1)


def _check_endings(out: Path | None, record: Path | None) -> None:
    from seewhy.errors import PlanningError

    if out is not None and out.suffix.lower() != ".html":
        raise PlanningError(f"{out}: the run is written as .html; choose a name that ends so")
    if record is not None and record.suffix != ".al":
        raise PlanningError(f"{record}: a record is written as .al; choose a name that ends so")


def _write(
    domain: PlanningDomain,
    simulation: Simulation,
    *,
    out: Path | None,
    record: Path | None,
    command: str,
) -> None:
    """Write the files that are asked for: the record of the run, and its page."""
    from seewhy.files.whole_files import write_whole
    from seewhy.knowledge.history import history_text
    from seewhy.planning.execution.recording import record_of
    from seewhy.report.run_page import run_page

    if record is not None:
        write_whole(record, history_text(record_of(domain, simulation.run), title=command))
        remark(f"what was seen and done is in {record}")
    if out is not None:
        write_whole(out, run_page(domain, simulation, command=command))
        remark(f"the run with its map is in {out}")


def _sight(domain: PlanningDomain, model: Path) -> Sight:
    from seewhy.agent.agent import Agent
    from seewhy.cli.code_notice import remark_code
    from seewhy.domain.domain import load_domain
    from seewhy.planning.execution.sight import Sight

    remark_code(load_domain(domain.folder))
    return Sight(domain, Agent.load(model))


def _to_dict(simulation: Simulation, seed: int) -> dict[str, Any]:
    run, looks = simulation.run, simulation.looks
    return {
        "goal": run.goal.text,
        "seed": seed,
        "outcome": run.outcome.value if run.outcome else "interrupted",
        "achieved": simulation.achieved,
        "steps": [
            {
                "step": step.number,
                "decision": step.decision.value,
                "plan": list(map(str, step.plan)),
                "action": None if step.action is None else str(step.action),
                "surprises": [
                    {"kind": surprise.kind.value, "what": str(surprise.what), "step": surprise.step}
                    for surprise in step.surprises
                ],
                "because": list(map(str, step.because)),
                "believed": list(map(str, step.believed.positive())),
                "true": sorted(str(literal) for literal in world if literal.positive),
                "planning_seconds": round(step.planning_seconds, 4),
                **({"misread": list(map(str, looks[number].misread))} if looks else {}),
            }
            for number, (step, world) in enumerate(zip(run.steps, simulation.worlds, strict=True))
        ],
    }
