"""`seewhy train`: train a domain's networks, tree and answers on annotated pictures."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.options import DataFolder, DomainName, Json, Seed
from seewhy.cli.screen import add_row, output, percent, print_json, table
from seewhy.cli.training import train_model

if TYPE_CHECKING:
    from seewhy.agent import Agent


def train(
    domain: DomainName,
    data: DataFolder,
    out: Annotated[Path, typer.Option("--out", help="The model folder to write.")],
    start_from: Annotated[
        Path | None,
        typer.Option("--from", help="Fine-tune the networks of this model instead of growing new."),
    ] = None,
    seed: Seed = 0,
    json: Json = False,
) -> None:
    """Train on a dataset (on the rows with split = train, where there are splits).

    Training that is killed goes on where it was when the same command is given again.
    """
    from seewhy.domain import load_domain

    own = load_domain(domain)
    agent = train_model(own, data, out, start_from=start_from, seed=seed)
    summary = agent.extractor.summary() if agent.extractor else {}
    if json:
        print_json(
            {
                "model": str(out),
                "domain": own.name,
                "networks": summary,
                "tree_scenes": tree_scenes(agent),
            }
        )
        return
    rows = table("feature", "layers", ">validation", ">epochs")
    for name, record in summary.items():
        add_row(
            rows,
            name,
            str(record["layers"]),
            percent(float(str(record["validation_accuracy"]))),
            str(record["epochs"]),
        )
    output().print(rows)
    print_learned(agent)
    output().print(f"model: {out}", markup=False)


def tree_scenes(agent: Agent) -> int:
    """The number of training scenes that the knowledge left open or got wrong."""
    return sum(path.support for path in agent.tree.paths())


def print_learned(agent: Agent) -> None:
    """Print what was learned from the scenes that the knowledge does not decide."""
    from seewhy.induction.sentence import say_path

    scenes = tree_scenes(agent)
    total = sum(sum(counts.values()) for counts in agent.experience.values())
    output().print(
        f"the knowledge leaves {scenes} of {total} training scenes open or gets them wrong; "
        "from these the tree has learned:"
        if scenes
        else f"the knowledge decides all {total} training scenes rightly",
        markup=False,
    )
    for path in agent.tree.paths():
        output().print(f"  - {say_path(agent.domain, path)}", markup=False)
    if agent.answerer is not None:
        output().print(
            f"answers: {agent.answerer.layers} recurrent layer(s), "
            f"{percent(agent.answerer.held_out_accuracy)} right on held-out questions",
            markup=False,
        )
