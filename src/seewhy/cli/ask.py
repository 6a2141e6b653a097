"""`seewhy ask`: one question about one picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

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
    SpeechFile,
)
from seewhy.cli.screen import print_json, remark, say
from seewhy.cli.things_in_pictures import ask_things, refuse

if TYPE_CHECKING:
    from seewhy.dialogue.reply import Classification, Reply


def ask(
    model: ModelFolder,
    image: ImageFile,
    question: Annotated[str, typer.Argument(metavar="QUESTION", help="In plain words.")],
    picture: Annotated[
        Path | None,
        typer.Option("--picture", help="Also draw the answer with its reasons to this .svg file."),
    ] = None,
    nearest: Annotated[
        bool,
        typer.Option("--nearest", help="Also name the pictures of training that are most like it."),
    ] = False,
    things: Annotated[
        Path | None,
        typer.Option(
            "--things",
            metavar="FILE",
            help="Of several things: a table of their boxes (things.csv), instead of looking for "
            "them.",
        ),
    ] = None,
    speak: Speak = False,
    speech: SpeechFile = None,
    device: Device = "auto",
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    json: Json = False,
) -> None:
    """Answer a question about a picture, with the reasons."""
    share_cores()
    from seewhy.agent.agent import Agent
    from seewhy.agent.manifest_file import is_of_things
    from seewhy.dialogue.text_to_speech import find_voice
    from seewhy.errors import SeeWhyError

    # Where nothing speaks, that is said before the answer is worked out.
    voices = [find_voice()] if speak else []
    voices += [find_voice(speech)] if speech is not None else []
    if is_of_things(model):
        options = {"--nearest": nearest, "--reading": reading, "--gate": gate}
        refuse({**options, "--known-share": known_share}, why="leave it out")
        ask_things(
            model,
            image,
            question,
            things=things,
            picture=picture,
            device=device,
            voices=voices,
            json=json,
        )
        return
    if things is not None:
        raise SeeWhyError(f"--things goes with a model of several things, which {model} is not")
    agent = Agent.load(model, device=device, reading=reading, gate=gate, known_share=known_share)
    reply = agent.ask(image, question)
    if picture is not None:
        from seewhy.report.card import draw_card

        where = agent.where(image, scene=reply.scene)
        draw_card(reply, image, where=where, fit=agent.domain.pictures.fit).save(picture)
        remark(f"picture: {picture}")
    near = agent.nearest(image) if nearest or json else ()
    if json:
        print_json({**reply.to_dict(), "nearest": [nearby.to_dict() for nearby in near]})
    else:
        print_reply(reply)
    if nearest and not json:
        say("most like it in training:" if near else "most like it in training: not kept")
        for nearby in near:
            say(f"  {nearby.to_text()}")
    for voice in voices:
        voice(reply.text)


def print_reply(reply: Reply) -> None:
    """Print an answer, what was seen, and the justification."""
    from seewhy.dialogue.certainty import Certainty

    say(reply.text)
    say()
    seen = [
        f"{name} {reading.value} ({reading.probability:.2f})"
        for name, reading in reply.features.items()
    ]
    witness = reply.classification.class_seen
    if witness is not None:
        seen.append(f"class {witness[0]} ({witness[1]:.2f})")
    judge = "the knowledge" if witness is None else "the knowledge and the class seen"
    if reply.supposed is not None:
        judge = "what is supposed"
    say(f"asked: {reply.question.text}?")
    say(f"seen: {', '.join(seen)}")
    for name, reading in reply.features.items():
        if reading.overruled is not None:
            value, probability = reading.overruled
            say(
                f"{judge} overruled: {name} read as {value} (p = {probability:.2f}), "
                f"{reading.value} ({reading.probability:.2f}) is what fits"
            )
    if reply.supposed is not None:
        say(
            f"supposed: {_class(reply.supposed)}, as asked, instead of "
            f"{_class(reply.classification)}"
        )
    if reply.certainty not in (None, Certainty.SURE) and reply.least_sure is not None:
        least = reply.least_sure
        say(f"not sure: {least.feature} {least.value} ({least.probability:.2f})")
    say(f"by: {reply.method}")
    say("because:")
    for line in reply.justification.to_text().splitlines():
        say(f"  {line}")


def _class(scene: Classification) -> str:
    sure = "" if scene.probability is None else f" ({scene.probability:.2f})"
    return f"{scene.label}{sure}"
