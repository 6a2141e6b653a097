"""`seewhy train`: train a domain's networks, tree and answers on annotated pictures."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.options import (
    DataFolder,
    Device,
    DomainName,
    Eyes,
    Gate,
    Json,
    KnownShare,
    Outside,
    Reading,
    Seed,
)
from seewhy.cli.screen import add_row, output, print_json, table
from seewhy.cli.things_in_pictures import refuse, train_things
from seewhy.cli.training import train_model
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent


def train(
    domain: DomainName,
    data: DataFolder,
    out: Annotated[Path, typer.Option("--out", help="The model folder to write.")],
    start_from: Annotated[
        Path | None,
        typer.Option("--from", help="Train further what this model sees by, instead of anew."),
    ] = None,
    drawn: Annotated[
        int | None,
        typer.Option(
            "--drawn",
            min=0,
            help="Train on so many pictures of the domain's own source before, 0: on none "
            "(what the domain says).",
        ),
    ] = None,
    without: Annotated[
        list[str] | None,
        typer.Option(
            "--without-class",
            metavar="CLASS",
            help="Leave out the pictures of a class, to see whether the knowledge of it is enough; "
            "more than once for several.",
        ),
    ] = None,
    eyes: Eyes = None,
    device: Device = "auto",
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    outside: Outside = False,
    seed: Seed = 0,
    json: Json = False,
) -> None:
    """Train on a dataset (on the rows with split = train, where there are splits).

    Training that is killed goes on where it was when the same command is given again.
    """
    from seewhy.domain.domain import load_domain

    loaded = load_domain(domain)
    if loaded.things is not None:
        refuse(
            {
                "--from": start_from,
                "--drawn": drawn,
                "--without-class": without,
                "--reading": reading,
                "--gate": gate,
                "--known-share": known_share,
            },
            why="they are found and read together, each picture is answered; leave it out",
        )
        train_things(
            loaded, data, out, eyes=eyes, device=device, outside=outside, seed=seed, json=json
        )
        return
    agent = train_model(
        loaded,
        data,
        out,
        without=without or (),
        start_from=start_from,
        drawn=drawn,
        outside=outside,
        seed=seed,
        eyes=eyes,
        device=device,
        reading=reading,
        gate=gate,
        known_share=known_share,
    )
    summary = agent.extractor.summary() if agent.extractor else {}
    if json:
        print_json(
            {
                "model": str(out),
                "domain": loaded.name,
                "eyes": agent.eyes,
                "networks": summary,
                "tree_scenes": tree_scenes(agent),
                "without": list(agent.without),
                "without_class": len(agent.without_class),
                "unknown_below": agent.unknown_below,
            }
        )
        return
    rows = table("feature", "seen by", ">validation", ">pictures", ">epochs")
    for name, record in summary.items():
        add_row(
            rows,
            name,
            str(record["layers"]),
            percent(float(str(record["validation_accuracy"]))),
            str(record["validation_pictures"] or f"{record['training_pictures']} (trained on)"),
            str(record["epochs"]),
        )
    output().print(rows)
    print_learned(agent)
    print_refusal(agent)
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


def print_refusal(agent: Agent) -> None:
    """Print of which pictures the agent will say that it does not know them, if of any."""
    if agent.known_share == 1.0:
        return
    number = len(agent.validation_scores.get(agent.reading, []))
    output().print(
        f"every picture is answered: {number} pictures are too few to know which are strange and "
        f"refuse at most {percent(1.0 - agent.known_share)} of the others"
        if agent.unknown_below is None
        else 'a picture that shows something else is answered with "I don\'t know", as are '
        f"{percent(1.0 - agent.known_share)} of pictures like the {number} that were compared",
        markup=False,
    )
