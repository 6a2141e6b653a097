"""`seewhy decide --scene`: questions about the things of an annotated scene."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from seewhy.cli.screen import complain, print_json, say

if TYPE_CHECKING:
    from seewhy.dialogue.things.answering import ThingReply


def decide_things(
    domain: str, scene: Path, *, image: int | None, questions: Sequence[str], json: bool
) -> None:
    """Answer questions, each of which may go with the one before, and print the reasons."""
    from seewhy.data.importers.clevr import read_scenes
    from seewhy.dialogue.things.answering import ThingAnswerer
    from seewhy.domain.domain import load_domain
    from seewhy.errors import QuestionError, SeeWhyError

    loaded = load_domain(domain)
    if loaded.things is None:
        raise SeeWhyError(f"{loaded.folder}: the domain has no [things] that could be asked about")
    scenes = read_scenes(scene, loaded.things)
    if image is None and len(scenes) > 1:
        raise SeeWhyError(f"{scene}: has {len(scenes)} scenes; say which with --image")
    number = next(iter(scenes)) if image is None else image
    if number not in scenes:
        raise SeeWhyError(f"{scene}: has no scene with image_index {number}")
    answerer = ThingAnswerer(loaded.things)
    replies: list[ThingReply] = []
    failed = False
    for question in questions or ("what is there?",):
        try:
            previous = replies[-1] if replies else None
            replies.append(answerer.answer(question, scenes[number], previous=previous))
        except QuestionError as problem:
            complain(str(problem))  # the others are answered all the same
            failed = True
            continue
        if not json:
            _print(replies[-1])
    if json:
        print_json({"domain": loaded.name, "answers": [reply.to_dict() for reply in replies]})
    if failed:
        raise typer.Exit(2)


def _print(reply: ThingReply) -> None:
    say(reply.question)
    say(reply.text)
    for line in reply.justification.to_text().splitlines()[1:]:
        say(f"  {line}")
    say()
