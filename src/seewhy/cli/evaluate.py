"""`seewhy evaluate`: accuracies of a model on annotated pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.options import (
    DataFolder,
    Gate,
    Json,
    KnownShare,
    ModelFolder,
    Outside,
    Reading,
    Seed,
)
from seewhy.cli.screen import add_row, output, percent, print_json, progress, remark, table

if TYPE_CHECKING:
    from seewhy.evaluation import Evaluation


def evaluate(
    model: ModelFolder,
    data: DataFolder,
    questions: Annotated[
        int, typer.Option("--questions", min=1, help="Questions drawn for each picture.")
    ] = 8,
    seed: Seed = 0,
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    outside: Outside = False,
    json: Json = False,
) -> None:
    """Evaluate a model on a dataset (on the rows with split = test, where there are splits)."""
    from seewhy.agent import Agent
    from seewhy.cli.read_data import read_data
    from seewhy.evaluation import evaluate as evaluate_agent

    agent = Agent.load(model, reading=reading, gate=gate, known_share=known_share)
    dataset = read_data(data, agent.domain, outside=outside, evaluated=True)
    with progress() as bars:
        task = bars.add_task("looking at pictures", total=len(dataset.of_split("test")))
        result = evaluate_agent(
            agent,
            dataset,
            questions_per_scene=questions,
            seed=seed,
            on_progress=lambda done: bars.update(task, completed=done),
        )
    if result.without_class:
        remark(
            f"{result.without_class} more pictures have no class: they count for the features "
            "that they are annotated with, for nothing else"
        )
    if result.seen_in_training:
        remark(
            f"{result.seen_in_training} of {result.scenes} pictures were trained on; "
            "results on them prove nothing"
        )
    if json:
        print_json(result.to_dict())
    else:
        print_evaluation(result)


def print_evaluation(result: Evaluation) -> None:
    """Print an evaluation as tables."""
    rows = table("measured on", ">share")
    add_row(rows, "classification", percent(result.classification_accuracy))
    add_row(rows, "  the best over the annotated features", percent(result.determined))
    for method, share in result.accuracy_by_method.items():
        add_row(rows, f"  decided by {method}", percent(share))
    add_row(rows, "decided by knowledge", percent(result.decided_by_knowledge))
    if result.unknown:
        add_row(rows, "said not to be known", percent(result.unknown))
    add_row(rows, "answers (every relevant attribute)", percent(result.answer_accuracy))
    add_row(rows, "answers, strict (and no other)", percent(result.answer_accuracy_strict))
    add_row(rows, "explanatory answers", percent(result.explanation_accuracy))
    add_row(rows, "explanatory answers, strict", percent(result.explanation_accuracy_strict))
    for name, share in result.feature_accuracy.items():
        add_row(rows, f"feature {name}", percent(share))
    output().print(f"{result.scenes} scenes", markup=False)
    output().print(rows)
    print_classes(result)
    print_axioms(result)


def print_classes(result: Evaluation, *, most: int = 12) -> None:
    """Print the classes that no picture was shown of, and the least well recognised of the rest."""
    shares = result.class_accuracy
    worst = sorted(shares, key=lambda label: (label not in result.without, shares[label]))
    rows = table("class", ">classified rightly")
    for label in worst[: max(most, len(result.without))]:
        note = " (left out of training)" if label in result.without else ""
        add_row(rows, f"{label}{note}", percent(shares[label]))
    more = len(worst) - most
    if more > 0:
        add_row(rows, f"{more} more, each at least", percent(shares[worst[-more]]))
    output().print(rows)


def print_axioms(result: Evaluation) -> None:
    """Print how often each axiom applied and was right, on the annotated features."""
    rows = table("axiom", ">decides", ">right")
    for own in result.axioms:
        add_row(rows, own.statement, str(own.decided), percent(own.accuracy))
    output().print(rows)
