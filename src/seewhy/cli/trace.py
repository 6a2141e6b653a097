"""`seewhy trace`: what each component did with a picture and a question about it."""

from __future__ import annotations

from typing import Annotated

import typer

from seewhy.cli.cores import share_cores
from seewhy.cli.options import Device, Gate, ImageFile, Json, KnownShare, ModelFolder, Reading
from seewhy.cli.screen import print_json, say


def trace(
    model: ModelFolder,
    image: ImageFile,
    question: Annotated[
        str | None,
        typer.Option("--question", "-q", help="In plain words; without it, only the class."),
    ] = None,
    device: Device = "auto",
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    json: Json = False,
) -> None:
    """Show what each component did: networks, knowledge, tree, question, answer."""
    share_cores()
    from seewhy.agent.agent import Agent
    from seewhy.agent.trace import trace as traced

    agent = Agent.load(model, device=device, reading=reading, gate=gate, known_share=known_share)
    found = traced(agent, image, question)
    if json:
        print_json({"image": str(image), **found.to_dict()})
    else:
        say(found.to_text())
