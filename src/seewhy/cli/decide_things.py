"""`seewhy decide --scene`: questions about the things of an annotated scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from seewhy.cli.screen import complain, print_json, say

if TYPE_CHECKING:
    from seewhy.data.thing_scene import ThingScene
    from seewhy.dialogue.scene_conclusions import SceneConclusions
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
    conclusions = SceneConclusions(loaded)
    scene_there = conclusions.conclude(by_name[str(number)])
    replies, failed = answers_about(loaded.things, scene_there, questions or ("what is there?",))
    decided = _class(conclusions, scene_there) if loaded.classes else {}
    if json:
        answers = [reply.to_dict() for reply in replies]
        print_json({"domain": loaded.name, **decided, "answers": answers})
    else:
        _print_class(decided)
        for reply in replies:
            print_reply(reply)
    if failed:
        raise typer.Exit(2)


def _class(conclusions: SceneConclusions, scene: ThingScene) -> dict[str, Any]:
    """The class of a scene and why it is of it, the things called by what they look like."""
    from seewhy.dialogue.scene_beliefs import SceneBeliefs
    from seewhy.dialogue.things.evaluating import Evaluation
    from seewhy.dialogue.things.wording import ThingWords

    words = ThingWords(Evaluation(scene, conclusions.things))
    names = [words.name(number) for number in range(scene.count)]
    beliefs = SceneBeliefs(
        conclusions.domain.with_most_things(max(1, scene.count)),
        conclusions.shortest_vector(scene),
        names,
        reasoner=conclusions.reasoner_for(scene.count),
    )
    label = beliefs.decision.label
    known = beliefs.domain.classes
    reason = None if label is None else beliefs.why(known[label].literal)
    return {
        "class": label,
        "say": "not decided" if label is None else known[label].say,
        "verdict": beliefs.decision.verdict.value,
        "justification": None if reason is None else reason.to_dict(),
        "because": None if reason is None else reason.to_text(),
    }


def _print_class(decided: Mapping[str, Any]) -> None:
    if not decided:
        return
    say(f"class: {decided['say']}")
    if decided["because"] is not None:
        say("because:")
        for line in decided["because"].splitlines():
            say(f"  {line}")
    say()


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
