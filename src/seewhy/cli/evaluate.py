"""`seewhy evaluate`: how good a model is on annotated pictures, and how it could become better."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from seewhy.cli.evaluate_clevr import NAME as CLEVR
from seewhy.cli.evaluate_clevr import evaluate_clevr
from seewhy.cli.options import (
    Device,
    Gate,
    Json,
    KnownShare,
    Outside,
    Reading,
    Seed,
)
from seewhy.cli.screen import print_json, progress, remark, say, warn
from seewhy.cli.things_in_pictures import evaluate_things_seen, refuse
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.data.dataset import Dataset
    from seewhy.evaluation import Evaluation
    from seewhy.evaluation.curve import LearningCurve

_QUESTIONS = 8
"""Drawn for each picture, where nothing else is said."""


def evaluate(
    model: Annotated[
        Path,
        typer.Argument(
            metavar="MODEL",
            help="A model folder, made by 'seewhy train'; or clevr: questions about annotated "
            "scenes of things.",
        ),
    ],
    data: Annotated[
        Path | None, typer.Option("--data", help="A dataset folder: pictures and scenes.csv.")
    ] = None,
    questions: Annotated[
        str | None,
        typer.Option(
            "--questions",
            metavar="N|FILE",
            help="Questions drawn for each picture (8); with clevr, the file of questions.",
        ),
    ] = None,
    scenes: Annotated[
        Path | None,
        typer.Option("--scenes", metavar="FILE", help="With clevr: the file of scenes."),
    ] = None,
    domain: Annotated[
        str, typer.Option("--domain", help="With clevr: the domain whose words are understood.")
    ] = "tabletop",
    wrong: Annotated[
        Path | None,
        typer.Option("--wrong", metavar="FILE", help="With clevr: write the wrong answers here."),
    ] = None,
    page: Annotated[
        Path | None,
        typer.Option(
            "--page",
            help="Write a page (HTML, a single file) with all figures and the wrong pictures.",
        ),
    ] = None,
    most: Annotated[
        int | None,
        typer.Option(
            "--most", min=0, help="How many wrong pictures the page shows (100); --json lists all."
        ),
    ] = None,
    curve: Annotated[
        bool,
        typer.Option(
            "--curve",
            help="Also train on an eighth, a quarter, a half and all of the pictures to train on, "
            "and say whether more labels would help. What was trained is kept in MODEL.curve.",
        ),
    ] = False,
    seed: Seed = 0,
    device: Device = "auto",
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    outside: Outside = False,
    json: Json = False,
) -> None:
    """Evaluate a model on a dataset (on the rows with split = test, where there are splits).

    `seewhy evaluate clevr --scenes FILE --questions FILE` answers questions about annotated scenes.
    """
    if str(model) == CLEVR:
        evaluate_clevr(scenes, questions, domain=domain, wrong=wrong, json=json)
        return
    from dataclasses import replace

    from seewhy.agent.agent import Agent
    from seewhy.agent.manifest_file import is_of_things
    from seewhy.cli.evaluation_tables import print_curve, print_evaluation
    from seewhy.cli.read_data import read_data
    from seewhy.errors import SeeWhyError

    if scenes is not None or wrong is not None:
        raise SeeWhyError("--scenes and --wrong go with 'seewhy evaluate clevr'")
    if data is None:
        raise SeeWhyError("there is no dataset; name its folder with --data")
    drawn = _questions_drawn(questions)
    if most is not None and page is None:
        raise SeeWhyError("--most goes with --page; --json lists all wrong pictures")
    if is_of_things(model):
        options = {"--questions": questions, "--curve": curve, "--reading": reading}
        refuse({**options, "--gate": gate, "--known-share": known_share}, why="leave it out")
        evaluate_things_seen(
            model, data, page=page, most=most, outside=outside, device=device, json=json
        )
        return
    agent = Agent.load(model, device=device, reading=reading, gate=gate, known_share=known_share)
    dataset = read_data(
        data,
        agent.domain,
        outside=outside,
        evaluated=True,
        before_notices=lambda read: _warn_of_training(agent, read),
    )
    if curve:
        from seewhy.evaluation.curve import require_splits

        require_splits(dataset)
    result = _evaluated(agent, dataset, questions=drawn, seed=seed)
    if result.without_class:
        remark(
            f"{result.without_class} more pictures have no class: they count for the features "
            "that they are annotated with, for nothing else"
        )
    if curve:
        result = replace(result, curve=_curve(agent, dataset, model))
    if page is not None:
        _write_page(page, agent, result, most=most)
    if json:
        print_json(result.to_dict())
        return
    print_evaluation(result)
    if result.curve is not None:
        print_curve(result.curve)
    if page is not None:
        say(f"page: {page}")


def _questions_drawn(said: str | None) -> int:
    from seewhy.errors import SeeWhyError

    if said is None:
        return _QUESTIONS
    if not said.isdecimal() or len(said) > 6 or int(said) < 1:
        raise SeeWhyError(
            f"--questions must be a whole number of at least 1, got '{said}'; a file of questions "
            "goes with 'seewhy evaluate clevr'"
        )
    return int(said)


def _warn_of_training(agent: Agent, dataset: Dataset) -> None:
    from seewhy.evaluation.advice import training_notice
    from seewhy.evaluation.judging import seen_in_training

    scenes = dataset.of_split("test").with_class()
    notice = training_notice(
        seen=seen_in_training(agent, scenes),
        scenes=len(scenes),
        has_splits=any(scene.split for scene in dataset.scenes),
    )
    if notice is not None:
        warn(notice)


def _evaluated(agent: Agent, dataset: Dataset, *, questions: int, seed: int) -> Evaluation:
    from seewhy.evaluation import evaluate as evaluate_agent

    with progress() as bars:
        task = bars.add_task("looking at pictures", total=len(dataset.of_split("test")))
        return evaluate_agent(
            agent,
            dataset,
            questions_per_scene=questions,
            seed=seed,
            on_progress=lambda done: bars.update(task, completed=done),
        )


def _curve(agent: Agent, dataset: Dataset, model: Path) -> LearningCurve:
    from seewhy.evaluation.curve import CurvePoint, learning_curve

    folder = model.resolve()
    with progress() as bars:
        task = bars.add_task("training", total=None)

        def on_part(pictures: int) -> None:
            bars.reset(task, description=f"training on {pictures:,} pictures", total=None)

        def on_progress(event: Any) -> None:
            # Networks that grow tell of passes, eyes of pictures gone over.
            passes = not hasattr(event, "done")
            done, total = (event.epoch, event.epochs) if passes else (event.done, event.total)
            bars.update(task, completed=done, total=total)

        def on_point(point: CurvePoint) -> None:
            share = point.class_recognition.confusion.share
            remark(f"trained on {point.pictures:,} pictures: {percent(share.value)} right")

        return learning_curve(
            agent,
            dataset,
            folder.with_name(f"{folder.name}.curve"),
            on_part=on_part,
            on_progress=on_progress,
            on_point=on_point,
        )


def _write_page(page: Path, agent: Agent, result: Evaluation, *, most: int | None) -> None:
    from seewhy.cli.command_line import as_typed
    from seewhy.files.whole_files import write_whole
    from seewhy.report.evaluation_page import MOST_PICTURES, evaluation_page

    shown = MOST_PICTURES if most is None else most
    write_whole(page, evaluation_page(agent.domain, result, command=as_typed(), most=shown))
