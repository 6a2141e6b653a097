"""`seewhy chat`: questions about one picture, one after another."""

from __future__ import annotations

from typing import TYPE_CHECKING

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

if TYPE_CHECKING:
    from seewhy.dialogue.reply import Reply


def chat(
    model: ModelFolder,
    image: ImageFile,
    speak: Speak = False,
    device: Device = "auto",
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    json: Json = False,
) -> None:
    """Talk about a picture; an empty line or "quit" ends.

    With --json every answer is one line of JSON.
    """
    share_cores()
    from seewhy.agent.agent import Agent
    from seewhy.dialogue.text_to_speech import find_voice

    voice = find_voice() if speak else None
    agent = Agent.load(model, device=device, reading=reading, gate=gate, known_share=known_share)
    scene = agent.classify(image)
    previous: Reply | None = None

    def answer(question: str) -> Reply:
        nonlocal previous
        asked = previous.question if previous is not None else None
        understood = agent.questions.understand(question, previous=asked)
        reply = agent.answer(scene, understood, previous=previous, image=image)
        if reply.kind.form != "explain":
            previous = reply
        return reply

    converse(
        answer,
        greeting=(
            "Ask about the picture, for instance:",
            *(f"  {question.text}?" for question in agent.questions.one_of_each()[:4]),
            '"please explain this answer" explains the last one; an empty line ends.',
        ),
        json=json,
        voice=voice,
    )
