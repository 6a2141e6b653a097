"""`seewhy chat`: questions about one picture, one after another."""

from __future__ import annotations

import sys

from seewhy.cli.options import Gate, ImageFile, Json, KnownShare, ModelFolder, Reading
from seewhy.cli.screen import complain, say

_LEAVE = {"quit", "exit", "bye", "q"}


def chat(
    model: ModelFolder,
    image: ImageFile,
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    json: Json = False,
) -> None:
    """Talk about a picture; an empty line or "quit" ends.

    With --json every answer is one line of JSON.
    """
    from json import dumps

    from seewhy.agent import Agent
    from seewhy.errors import QuestionError
    from seewhy.reply import Reply

    agent = Agent.load(model, reading=reading, gate=gate, known_share=known_share)
    scene = agent.classify(image)
    interactive = sys.stdin.isatty()
    if interactive and not json:
        say("Ask about the picture, for instance:")
        for question in agent.questions.one_of_each()[:4]:
            say(f"  {question.text}?")
        say('"please explain this answer" explains the last one; an empty line ends.')
    previous: Reply | None = None
    while True:
        if interactive and not json:
            sys.stdout.write("> ")
            sys.stdout.flush()
        line = sys.stdin.readline()
        text = line.strip()
        if not text or text.casefold() in _LEAVE:
            if line and not text and not interactive:
                continue
            return
        try:
            reply = agent.answer(scene, agent.questions.understand(text), previous=previous)
        except QuestionError as problem:
            if json:
                sys.stdout.write(
                    dumps(
                        {"error": str(problem), "nearest": list(problem.nearest)},
                        ensure_ascii=False,
                    )
                    + "\n"
                )
                sys.stdout.flush()
            else:
                complain(str(problem))
            continue
        if json:
            sys.stdout.write(dumps(reply.to_dict(), ensure_ascii=False) + "\n")
            sys.stdout.flush()
        else:
            say(reply.text)
        if reply.kind.form != "explain":
            previous = reply
