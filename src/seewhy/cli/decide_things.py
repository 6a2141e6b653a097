"""`seewhy decide --scene`: questions about the things of an annotated scene."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from seewhy.cli.screen import complain, print_json, say

if TYPE_CHECKING:
    from seewhy.data.thing_scene import ThingScene
    from seewhy.dialogue.things.answering import ThingReply
    from seewhy.domain.things import Things


def decide_things(
    domain: str, scene: Path, *, image: str | None, questions: Sequence[str], json: bool
) -> None:
    """Answer questions, each of which may go with the one before, and print the reasons."""
    from seewhy.data.importers.clevr import read_scenes
    from seewhy.dialogue.scene_conclusions import SceneConclusions
    from seewhy.domain.domain import load_domain
    from seewhy.errors import SeeWhyError

    loaded = load_domain(domain)
    if loaded.things is None:
        raise SeeWhyError(f"{loaded.folder}: the domain has no [things] that could be asked about")
    scenes = read_scenes(scene, loaded.things)
    if image is None and len(scenes) > 1:
        raise SeeWhyError(f"{scene}: has {len(scenes)} scenes; say which with --image")
    number = next(iter(scenes)) if image is None else image
    by_name = {str(index): found for index, found in scenes.items()}
    if str(number) not in by_name:
        raise SeeWhyError(f"{scene}: has no scene with image_index {number}")
    scene_there = SceneConclusions(loaded).conclude(by_name[str(number)])
    replies, failed = answers_about(loaded.things, scene_there, questions or ("what is there?",))
    if json:
        print_json({"domain": loaded.name, "answers": [reply.to_dict() for reply in replies]})
    else:
        for reply in replies:
            print_reply(reply)
    if failed:
        raise typer.Exit(2)


def answers_about(
    things: Things, scene: ThingScene, questions: Sequence[str]
) -> tuple[list[ThingReply], bool]:
    """Return the answers to questions, and whether one was not understood, which is said."""
    from seewhy.dialogue.things.answering import ThingAnswerer
    from seewhy.errors import QuestionError

    answerer = ThingAnswerer(things)
    replies: list[ThingReply] = []
    failed = False
    for question in questions:
        try:
            previous = replies[-1] if replies else None
            replies.append(answerer.answer(question, scene, previous=previous))
        except QuestionError as problem:
            complain(str(problem))  # the others are answered all the same
            failed = True
    return replies, failed


def print_reply(reply: ThingReply) -> None:
    """Print an answer with its reasons."""
    say(reply.question)
    say(reply.text)
    for line in reply.justification.to_text().splitlines()[1:]:
        say(f"  {line}")
    say()
