"""`seewhy chat`: questions about one picture, one after another, and corrections of answers."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from seewhy.cli.conversation import converse
from seewhy.cli.cores import share_cores
from seewhy.cli.options import (
    Device,
    Gate,
    ImageFile,
    Json,
    KnownShare,
    ModelFolder,
    Reading,
    Speak,
)
from seewhy.cli.things_in_pictures import chat_about_things, refuse


def chat(
    model: ModelFolder,
    image: ImageFile,
    data: Annotated[
        Path | None,
        typer.Option(
            "--data",
            help="A dataset folder: says which of its pictures a revision would change, and keeps "
            "labels.",
        ),
    ] = None,
    speak: Speak = False,
    device: Device = "auto",
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    json: Json = False,
) -> None:
    """Talk about a picture; an empty line or "quit" ends.

    "No, that is wrong", "no, it is CLASS" or "it is CLASS because …" proposes what mends it, with
    what else that would change. What is taken is kept in the model; "undo that" takes it back.
    With --json every answer is one line of JSON.
    """
    share_cores()
    from seewhy.agent.agent import Agent
    from seewhy.agent.manifest_file import is_of_things
    from seewhy.data.dataset import Dataset
    from seewhy.dialogue.text_to_speech import find_voice
    from seewhy.revision.conversation import Conversation
    from seewhy.revision.revisions import Revisions

    voice = find_voice() if speak else None
    if is_of_things(model):
        options = {"--reading": reading, "--gate": gate}
        refuse({**options, "--known-share": known_share}, why="leave it out")
        chat_about_things(model, image, data=data, device=device, json=json, voice=voice)
        return
    agent = Agent.load(model, device=device, reading=reading, gate=gate, known_share=known_share)
    if data is not None:
        Dataset.load(data, agent.domain)
    talk = Conversation(
        agent,
        Revisions(model, agent=agent, dataset=data),
        look=lambda: agent.classify(image),
        picture=image,
    )
    converse(
        talk.say,
        greeting=(
            "Ask about the picture, for instance:",
            *(f"  {question.text}?" for question in agent.questions.one_of_each()[:4]),
            '"please explain this answer" explains the last one, "no, that is wrong" corrects it; '
            "an empty line ends.",
        ),
        json=json,
        voice=voice,
    )
