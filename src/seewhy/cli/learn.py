"""`seewhy learn`: find axioms in annotated pictures, or in the record of a robot's runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from seewhy.cli.axiom_lines import rests
from seewhy.cli.learn_things import domain_of_things, learn_from_things
from seewhy.cli.learned_lines import judgement_lines, learning_dict, print_learning
from seewhy.cli.options import Json, Outside, Seed
from seewhy.cli.robot import Learned, Without, with_knowledge_of_robot
from seewhy.cli.screen import harmless, print_json, remark, say
from seewhy.errors import DatasetError, SeeWhyError

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset
    from seewhy.domain.domain import Domain
    from seewhy.evaluation.held_back import JudgedLearning, Proposal
    from seewhy.induction.axiom_learning import LearningOptions
    from seewhy.knowledge.axiom import Axiom


_MODEL_STAYS = "the model stays as it was"


def learn(
    model: Annotated[
        Path,
        typer.Argument(
            metavar="MODEL",
            help="A model folder, made by 'seewhy train'; a domain whose pictures show several "
            "things; with --runs, a domain that plans.",
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
        typer.Option(
            "--out",
            help="With --runs: the file for what is learned (.al). Of things: a new folder for a "
            "copy of the domain that knows it.",
        ),
    ] = None,
    without: Without = None,
    learned: Learned = None,
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
            help="The share of the annotation taken to be wrong (0; of things, as the pictures "
            "suggest); with --runs, how often what is usual may be otherwise (as the record "
            "suggests).",
        ),
    ] = None,
    yes: Annotated[
        bool,
        typer.Option(
            "--yes",
            help="Do not ask: add all axioms found, but for those with which accuracy on the "
            "pictures held back would fall.",
        ),
    ] = False,
    even_if_worse: Annotated[
        bool,
        typer.Option("--even-if-worse", help="With --yes: add those, too."),
    ] = False,
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

    A fifth of the pictures is held back, by group, to judge what the others propose. What is
    proposed is shown with what it does to accuracy on those, asked about, and added to the model's
    knowledge. With --json nothing is asked: it is added with --yes; without, it is only shown and
    the model stays as it was.

    Of a domain with several things in a picture, axioms about them are learned without a model:
    which things there are, how many, which not. They are added to the domain's knowledge.al.

    With --runs, learn what is usually so, and what does not work, from the record of a robot's
    earlier runs, and write it to --out, for 'seewhy plan --learned' and 'seewhy simulate
    --learned'. With --learned, these runs judge what was learned from others, and go on from there.
    """
    if runs is not None:
        _from_runs(
            str(model), runs, out, data=data, picture=picture, without=without, learned=learned,
            support=support, tolerance=tolerance, seed=seed, yes=yes, json=json,
        )  # fmt: skip
        return
    if data is None:
        raise SeeWhyError(
            "nothing is said to learn from; give --data FOLDER with annotated pictures, or --runs "
            "FOLDER with the record of a robot's runs"
        )
    if even_if_worse and not yes:
        raise SeeWhyError("--even-if-worse goes with --yes; without it you are asked")
    with_things = domain_of_things(model)
    if (out is not None and with_things is None) or without or learned:
        given = "--without" if without else "--learned" if learned else "--out"
        kept = "model" if with_things is None else "domain"
        raise SeeWhyError(f"{given} goes with --runs; what pictures teach is kept in the {kept}")
    from seewhy.evaluation.held_back import not_worse
    from seewhy.induction.axiom_learning import DEFAULTS, LearningOptions

    options = LearningOptions(
        support=DEFAULTS.support if support is None else support,
        tolerance=DEFAULTS.tolerance if tolerance is None else tolerance,
        seed=seed,
    )
    asked = not json and not yes
    accept = _ask_judged if asked else _anything if even_if_worse else not_worse
    only_shown = json and not yes
    if with_things is not None:
        _from_things(
            with_things, data, out, outside=outside, support=options.support, tolerance=tolerance,
            seed=seed, accept=accept, keep=not only_shown, picture=picture, json=json,
        )  # fmt: skip
        return
    found = _from_pictures(
        model, data, outside=outside, options=options, accept=accept, keep=not only_shown
    )
    if picture is not None:
        _draw_tree(found, picture)
    if json:
        print_json(learning_dict(found, only_shown=only_shown))
        return
    print_learning(found)


def _from_pictures(
    model: Path,
    data: Path,
    *,
    outside: bool,
    options: LearningOptions,
    accept: Callable[[Proposal], bool],
    keep: bool,
) -> JudgedLearning:
    """Learn from annotated pictures; with ``keep``, the model knows it from now on."""
    from seewhy.agent.agent import Agent
    from seewhy.cli.read_data import read_data
    from seewhy.evaluation.held_back import learn_judged

    agent = Agent.load(model)
    found = learn_judged(
        agent,
        _with_class(read_data(data, agent.given, outside=outside)),
        options=options,
        accept=accept,
        seed=options.seed,
        answers=agent.answerer is not None,
        on_held_back=_remark_held_back,
    )
    if keep:
        found.agent.save(model)
    return found


def _from_things(
    domain: Domain,
    data: Path,
    out: Path | None,
    *,
    outside: bool,
    support: float,
    tolerance: float | None,
    seed: int,
    accept: Callable[[Proposal], bool],
    keep: bool,
    picture: Path | None,
    json: bool,
) -> None:
    from seewhy.induction.things.rule_learning import ThingLearningOptions

    learn_from_things(
        domain,
        data,
        out,
        outside=outside,
        options=ThingLearningOptions(support=support, tolerance=tolerance, seed=seed),
        accept=accept,
        keep=keep,
        refused={"--picture": picture},
        json=json,
    )


def _draw_tree(found: JudgedLearning, picture: Path) -> None:
    from seewhy.files.whole_files import write_whole
    from seewhy.report.tree import draw_tree

    learning = found.learning
    tree = draw_tree(found.agent.domain, learning.tree, accepted=learning.accepted_leaves)
    write_whole(picture, tree.svg)


def _from_runs(
    domain: str,
    runs: Path,
    out: Path | None,
    *,
    data: Path | None,
    picture: Path | None,
    without: list[str] | None,
    learned: Path | None,
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
        learned=learned,
        support=support,
        tolerance=tolerance,
        seed=seed,
        accept=None if yes else _none if json else partial(_ask, else_="nothing is written"),
        keep=yes or not json,
        json=json,
    )


def _ask(axioms: Sequence[Axiom], *, else_: str) -> list[Axiom]:
    chosen = []
    for axiom in axioms:
        say(f"{axiom.text}")
        say(f"  {axiom}  learned from {rests(axiom)}")
        if _confirmed("add this axiom?", else_=else_):
            chosen.append(axiom)
    return chosen


def _ask_judged(proposal: Proposal) -> bool:
    from seewhy.knowledge.learned_file import Withdrawn

    proposed = proposal.proposed
    if isinstance(proposed, Withdrawn):
        say(f"given: {proposed.statement}")
        say(f"  {proposed.reason}")
    else:
        say(f"{proposed.text}")
        say(f"  {proposed}  learned from {rests(proposed)}")
    for line in judgement_lines(proposal):
        say(f"  {line}")
    question = "set this axiom aside?" if isinstance(proposed, Withdrawn) else "add this axiom?"
    return _confirmed(question, default=not proposal.falls)


def _anything(_: Proposal) -> bool:
    return True


def _remark_held_back(held_back: int, pictures: int) -> None:
    many = f"{pictures} pictures are" if pictures > 1 else "1 picture is"
    remark(
        f"{held_back} of {many} held back: nothing is learned from them, they judge what is "
        "proposed"
        if held_back
        else f"{many} too few to hold some back: nothing judges what is proposed"
    )


def _confirmed(question: str, *, default: bool = True, else_: str = _MODEL_STAYS) -> bool:
    try:
        return typer.confirm(harmless(f"  {question}"), default=default)
    except typer.Abort:
        raise SeeWhyError(
            f"no answer to '{question}', {else_}; answer y or n, or give --yes to agree without "
            "being asked"
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
