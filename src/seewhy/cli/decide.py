"""`seewhy decide`: what the knowledge says of named values, without a picture or a model."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.decide_named_things import Wanted, decide_named_things
from seewhy.cli.decide_things import decide_things
from seewhy.cli.options import DomainName, Json
from seewhy.cli.screen import complain, print_json, say

if TYPE_CHECKING:
    from seewhy.dialogue.reply import Classification, Reply
    from seewhy.domain.domain import Domain


def decide(
    domain: DomainName,
    values: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[FEATURE=VALUE]...",
            help="What a picture would show, as in colour=brown; what is left out is not known. Of "
            "things: cup.colour=brown, and on=cup,book for what holds between two.",
        ),
    ] = None,
    ask: Annotated[
        list[str] | None,
        typer.Option("--ask", help="Also answer this question; may be given several times."),
    ] = None,
    scene: Annotated[
        Path | None,
        typer.Option(
            "--scene",
            metavar="FILE",
            help="Ask about the things of an annotated scene instead (docs/things.md).",
        ),
    ] = None,
    things: Annotated[
        Path | None,
        typer.Option("--things", help="A table of things (things.csv) in place of named ones."),
    ] = None,
    image: Annotated[
        str | None,
        typer.Option(
            "--image",
            help="Which picture of the table of things, or which scene of the file, by its "
            "image_index.",
        ),
    ] = None,
    why: Annotated[
        list[str] | None,
        typer.Option("--why", help="Of things: why this is believed, or not, as in 'falls(cup)'."),
    ] = None,
    change: Annotated[
        list[str] | None,
        typer.Option("--change", help="Of things: the smallest change that makes this so."),
    ] = None,
    suppose: Annotated[
        list[str] | None,
        typer.Option("--if", help="Of things: what follows if this were so, as in cup.colour=red."),
    ] = None,
    json: Json = False,
) -> None:
    """Reason about named values, so that rules can be tried before anything is trained."""
    if scene is not None:
        decide_things(domain, scene, image=image, questions=ask or (), json=json)
        return
    from seewhy.agent.agent import Agent
    from seewhy.dialogue.question import Asks, Question
    from seewhy.domain.assignments import named_values
    from seewhy.domain.domain import load_domain
    from seewhy.errors import DomainError, QuestionError

    loaded = load_domain(domain)
    if loaded.things is not None:
        wanted = Wanted(why or (), change or (), suppose or (), ask or ())
        decide_named_things(
            loaded, values or (), file=things, image=image, wanted=wanted, json=json
        )
        return
    if things or image or why or change or suppose:
        raise DomainError(
            f"the domain '{loaded.name}' has no things, of which --things, --image, --why, "
            "--change and --if speak; ask with --ask"
        )
    agent = Agent(loaded)
    classified = agent.classify_values(named_values(loaded, values or ()))
    reply = agent.answer(classified, Question(Asks.CLASS, "what is it", ()))
    replies: dict[str, Reply] = {}
    before: Reply | None = None
    for question in ask or ():
        try:
            asked = agent.questions.understand(
                question, previous=before.question if before else None
            )
        except QuestionError as problem:
            complain(str(problem))  # the others are answered all the same
            continue
        before = replies[question] = agent.answer(classified, asked, previous=before)
    _print(loaded, classified, reply, replies, json=json)
    if len(replies) < len(set(ask or ())):
        raise typer.Exit(2)


def _print(
    loaded: Domain,
    scene: Classification,
    reply: Reply,
    replies: Mapping[str, Reply],
    *,
    json: bool,
) -> None:
    """Print what is decided and why, and the answers to questions."""
    if json:
        told = {"features": loaded.named(scene.vector), "class": scene.label}
        print_json(
            {
                "domain": loaded.name,
                **told,
                "verdict": scene.verdict,
                "justification": reply.justification.to_dict(),
                "answers": [
                    {
                        "question": f"{answered.question.text}?",
                        "text": answered.text,
                        "justification": answered.justification.to_dict(),
                    }
                    for answered in replies.values()
                ],
            }
        )
        return
    label = "not decided" if scene.label is None else loaded.classes[scene.label].say
    say(f"class: {label}")
    say("because:")
    for line in reply.justification.to_text().splitlines():
        say(f"  {line}")
    for question, answered in replies.items():
        say()
        say(question)
        say(answered.text)
