"""`seewhy learn`: find axioms in annotated pictures, or in the record of a robot's runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from seewhy.cli.axiom_lines import axiom_dict, rests, withdrawn_dict, withdrawn_line
from seewhy.cli.options import Json, Outside, Seed
from seewhy.cli.robot import Without, with_knowledge_of_robot
from seewhy.cli.screen import harmless, print_json, remark, say
from seewhy.errors import DatasetError, SeeWhyError
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset
    from seewhy.evaluation.held_back import Judged, JudgedLearning, Proposal
    from seewhy.induction.axiom_learning import LearningOptions
    from seewhy.knowledge.axiom import Axiom


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
    if even_if_worse and not yes:
        raise SeeWhyError("--even-if-worse goes with --yes; without it you are asked")
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
    for line in _judgement(proposal):
        say(f"  {line}")
    question = "set this axiom aside?" if isinstance(proposed, Withdrawn) else "add this axiom?"
    return _confirmed(question, default=not proposal.falls)


def _judgement(proposal: Proposal) -> list[str]:
    """Say what a proposal does to the accuracy on the pictures held back."""
    before, after = proposal.before, proposal.after
    if before is None or after is None:
        return []
    shares = f"{percent(before.right.value)} before, {percent(after.right.value)} with this"
    said = f"of {before.right.of} pictures held back, classified rightly: {shares}"
    if not proposal.falls:
        return [said]
    points = 100 * (before.right.value - after.right.value)
    pictures = "1 picture" if proposal.lost == 1 else f"{proposal.lost} pictures"
    return [said, f"ACCURACY WOULD FALL by {points:.1f} points ({pictures})"]


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


def learning_dict(found: JudgedLearning, *, only_shown: bool) -> dict[str, Any]:
    """What was learned, as values that JSON can hold.

    What is only shown is judged as if all were accepted that lowers no accuracy; nothing is.
    """
    from seewhy.induction.sentence import say_rule
    from seewhy.knowledge.learned_file import Withdrawn

    agent, learning = found.agent, found.learning
    return {
        "found": [str(axiom) for axiom in learning.found],
        "added": [axiom_dict(axiom) for axiom in learning.added if not only_shown],
        "withdrawn": [withdrawn_dict(agent, gone) for gone in learning.withdrawn if not only_shown],
        "candidates": [
            {
                "text": say_rule(agent.domain, one.candidate.conditions, one.candidate.label),
                "fate": one.fate.value,
                "reason": one.reason,
                "right": one.tally.right,
                "wrong": one.tally.wrong,
                "left_open": one.tally.left,
            }
            for one in learning.judgements
        ],
        "held_back": found.held_back,
        "learned_from": found.learned_from,
        "judged": [
            {
                "statement": proposal.statement,
                "set_aside": isinstance(proposal.proposed, Withdrawn),
                "falls": proposal.falls,
                "accepted": accepted and not only_shown,
                "before": _shares(proposal.before),
                "after": _shares(proposal.after),
            }
            for proposal, accepted in found.judged
        ],
        "before": _shares(found.before),
        "after": _shares(found.after),
    }


_RIGHT = "annotated features classified rightly"
_BY_KNOWLEDGE = "annotated features that the knowledge decides rightly"


def _shares(judged: Judged | None) -> dict[str, float] | None:
    if judged is None:
        return None
    return {_BY_KNOWLEDGE: judged.by_knowledge.value, _RIGHT: judged.right.value}


def print_learning(found: JudgedLearning) -> None:
    """Print every candidate with its verdict, what was added and withdrawn, and what it did."""
    from seewhy.induction.axiom_learning import Fate
    from seewhy.induction.sentence import say_rule, things

    agent, learning = found.agent, found.learning
    for one in learning.judgements:
        text = say_rule(agent.domain, one.candidate.conditions, one.candidate.label)
        why = f": {one.reason}" if one.reason else ""
        fate = "proposed" if one.fate is Fate.ACCEPTED else one.fate.value
        say(f"{fate}: {text} ({one.tally.right} {things(agent.domain)} for it{why})")
    for gone in learning.withdrawn:
        say(withdrawn_line(agent, gone))
    if not learning.found:
        say("no axiom is to be learned from these pictures")
    for axiom in learning.added:
        say(f"added {axiom.identifier}: {axiom}  ({rests(axiom)})")
    for proposal, accepted in found.judged:
        if proposal.falls:
            say(f"{'agreed to all the same' if accepted else 'left out'}: {proposal.statement}")
            for line in _judgement(proposal):
                say(f"  {line}")
    before, after = _shares(found.before), _shares(found.after)
    for name in before or {}:
        if before is not None and after is not None:
            say(
                f"{name}, of {found.held_back} held back: {percent(before[name])} before, "
                f"{percent(after[name])} now"
            )
