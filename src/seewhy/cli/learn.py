"""`seewhy learn`: find axioms in annotated pictures, or in the record of a robot's runs."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from seewhy.cli.axiom_lines import axiom_dict, rests, withdrawn_dict, withdrawn_line
from seewhy.cli.options import Json, Outside, Seed
from seewhy.cli.robot import Without, with_knowledge_of_robot
from seewhy.cli.screen import percent, print_json, remark, say
from seewhy.errors import DatasetError, SeeWhyError

if TYPE_CHECKING:
    from seewhy.agent import Agent
    from seewhy.data.dataset import Dataset
    from seewhy.knowledge.axiom import Axiom
    from seewhy.knowledge.learned_file import Withdrawn
    from seewhy.learning import Learning


_MODEL_STAYS = "the model stays as it was"


def learn(
    model: Annotated[
        Path,
        typer.Argument(
            metavar="MODEL",
            help="A model folder, made by 'seewhy train'; with --runs, a domain that plans.",
        ),
    ],
    data: Annotated[
        Path | None,
        typer.Option("--data", help="A dataset folder: pictures and scenes.csv."),
    ] = None,
    runs: Annotated[
        Path | None,
        typer.Option(
            "--runs",
            help="Instead of pictures, a folder of runs that 'seewhy simulate --record' wrote.",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="With --runs: the file for what is learned (.al)."),
    ] = None,
    without: Without = None,
    support: Annotated[
        float | None,
        typer.Option(
            "--support",
            min=0.0,
            max=1.0,
            help="The share of the scenes left open that an axiom must speak about (0.1); with "
            "--runs, of the observations (0.02).",
        ),
    ] = None,
    tolerance: Annotated[
        float | None,
        typer.Option(
            "--tolerance",
            min=0.0,
            max=0.5,
            help="The share of the annotation taken to be wrong (0); with --runs, how often what "
            "is usual may be otherwise (as the record suggests).",
        ),
    ] = None,
    yes: Annotated[bool, typer.Option("--yes", help="Add all axioms found, do not ask.")] = False,
    picture: Annotated[
        Path | None,
        typer.Option(
            "--picture",
            help="Draw the tree, with the paths that became axioms marked (SVG).",
        ),
    ] = None,
    outside: Outside = False,
    seed: Seed = 0,
    json: Json = False,
) -> None:
    """Learn axioms from annotated pictures (those with split = train, where there are splits).

    What the pictures let pass is shown and asked about, then added to the model's knowledge. With
    --json nothing is asked: it is added with --yes, and only shown without.

    With --runs, learn what is usually so from the record of a robot's earlier runs, and write it
    to --out, for 'seewhy plan --learned' and 'seewhy simulate --learned'.
    """
    if runs is not None:
        _from_runs(
            str(model), runs, out, data=data, picture=picture, without=without, support=support,
            tolerance=tolerance, seed=seed, yes=yes, json=json,
        )  # fmt: skip
        return
    if data is None:
        raise SeeWhyError(
            "nothing is said to learn from; give --data FOLDER with annotated pictures, or --runs "
            "FOLDER with the record of a robot's runs"
        )
    if out is not None or without:
        given = "--out" if out is not None else "--without"
        raise SeeWhyError(f"{given} goes with --runs; what pictures teach is kept in the model")
    from seewhy.agent import Agent
    from seewhy.cli.read_data import read_data
    from seewhy.induction.learning import DEFAULTS, LearningOptions

    agent = Agent.load(model)
    dataset = _with_class(read_data(data, agent.given, outside=outside, evaluated=True))
    before = _accuracy(agent, dataset)
    learning = agent.learn(
        dataset,
        options=LearningOptions(
            support=DEFAULTS.support if support is None else support,
            tolerance=DEFAULTS.tolerance if tolerance is None else tolerance,
            seed=seed,
        ),
        accept=None if yes else _none if json else _ask,
        set_aside=None if yes else _none if json else _ask_aside,
        answers=agent.answerer is not None,
    )
    after = _accuracy(agent, dataset)
    agent.save(model)
    if picture is not None:
        from seewhy.files import write_whole
        from seewhy.report.tree import draw_tree

        tree = draw_tree(agent.domain, learning.tree, accepted=learning.accepted_leaves)
        write_whole(picture, tree.svg)
    if json:
        print_json({**learning_dict(agent, learning), "before": before, "after": after})
        return
    print_learning(agent, learning)
    for name, share in before.items():
        say(f"{name}: {percent(share)} before, {percent(after[name])} now")


def _from_runs(
    domain: str,
    runs: Path,
    out: Path | None,
    *,
    data: Path | None,
    picture: Path | None,
    without: list[str] | None,
    support: float | None,
    tolerance: float | None,
    seed: int,
    yes: bool,
    json: bool,
) -> None:
    from seewhy.cli.learn_runs import learn_from_record
    from seewhy.planning.domain import load_planning_domain

    if data is not None or picture is not None:
        given = "--data" if data is not None else "--picture"
        raise SeeWhyError(f"{given} goes with pictures, and --runs with a robot; leave one out")
    if out is None or out.suffix != ".al":
        raise SeeWhyError(
            f"{out or '--out'}: what is learned from runs is written as .al; give --out learned.al"
        )
    learn_from_record(
        with_knowledge_of_robot(load_planning_domain(domain), learned=None, without=without),
        runs,
        out,
        support=support,
        tolerance=tolerance,
        seed=seed,
        accept=None if yes else _none if json else partial(_ask, else_="nothing is written"),
        json=json,
    )


def _ask(axioms: Sequence[Axiom], *, else_: str = _MODEL_STAYS) -> list[Axiom]:
    chosen = []
    for axiom in axioms:
        say(f"{axiom.text}")
        say(f"  {axiom}  learned from {rests(axiom)}")
        if _confirmed("add this axiom?", else_=else_):
            chosen.append(axiom)
    return chosen


def _ask_aside(refuted: Sequence[Withdrawn]) -> list[Withdrawn]:
    chosen = []
    for own in refuted:
        say(f"given: {own.statement}")
        say(f"  {own.reason}")
        if _confirmed("set this axiom aside?"):
            chosen.append(own)
    return chosen


def _confirmed(question: str, *, else_: str = _MODEL_STAYS) -> bool:
    try:
        return typer.confirm(f"  {question}", default=True)
    except typer.Abort:
        raise SeeWhyError(
            f"no answer to '{question}', {else_}; answer y or n, or give --yes to agree to "
            "everything"
        ) from None


def _none(_: Sequence[object]) -> list[Any]:
    return []


def _with_class(dataset: Dataset) -> Dataset:
    found = dataset.with_class()
    if not len(found):
        raise DatasetError(
            f"{dataset.table.name}: no row has a class, of which axioms are learned; fill the "
            "column 'class'"
        )
    if len(found) < len(dataset):
        remark(
            f"{len(dataset) - len(found):,} of {len(dataset):,} pictures have no class: nothing is "
            "learned from them"
        )
    return found


def _accuracy(agent: Agent, dataset: Dataset) -> dict[str, float]:
    """How much of the annotated features is classified, and how much of the pictures to test on."""
    scenes = dataset.of_split("test")
    decisions = agent.reasoner.decide_all(scenes.vectors)
    labels = [agent.decide(agent.domain.named(vector)) for vector in scenes.vectors]
    by_knowledge = [
        own.label == label for own, label in zip(decisions, scenes.classes, strict=True)
    ]
    found = agent.classify_all(scenes.pictures(agent.picture_size))
    pairs = zip(found, scenes.classes, strict=True)
    right = [own == label for own, label in zip(labels, scenes.classes, strict=True)]
    count = max(1, len(scenes))
    return {
        "annotated features that the knowledge decides rightly": sum(by_knowledge) / count,
        "annotated features classified rightly": sum(right) / count,
        "pictures classified rightly": sum(own.label == label for own, label in pairs) / count,
    }


def learning_dict(agent: Agent, learning: Learning) -> dict[str, Any]:
    """What was learned, as values that JSON can hold."""
    from seewhy.induction.sentence import say_rule

    return {
        "found": [str(own) for own in learning.found],
        "added": [axiom_dict(own) for own in learning.added],
        "withdrawn": [withdrawn_dict(agent, own) for own in learning.withdrawn],
        "candidates": [
            {
                "text": say_rule(agent.domain, own.candidate.conditions, own.candidate.label),
                "fate": own.fate.value,
                "reason": own.reason,
                "right": own.tally.right,
                "wrong": own.tally.wrong,
                "left_open": own.tally.left,
            }
            for own in learning.judgements
        ],
    }


def print_learning(agent: Agent, learning: Learning) -> None:
    """Print every candidate with its verdict, and what was added and withdrawn."""
    from seewhy.induction.sentence import say_rule, things

    for own in learning.judgements:
        text = say_rule(agent.domain, own.candidate.conditions, own.candidate.label)
        why = f": {own.reason}" if own.reason else ""
        say(f"{own.fate.value}: {text} ({own.tally.right} {things(agent.domain)} for it{why})")
    for gone in learning.withdrawn:
        say(withdrawn_line(agent, gone))
    if not learning.found:
        say("no axiom is to be learned from these pictures")
    for axiom in learning.added:
        say(f"added {axiom.identifier}: {axiom}  ({rests(axiom)})")
