"""What the knowledge says of a scene of things, without a picture or a model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from seewhy.cli.decide_things import answers_about, print_reply
from seewhy.cli.screen import print_json, say

if TYPE_CHECKING:
    from seewhy.dialogue.scene_beliefs import SceneBeliefs
    from seewhy.domain.domain import Domain
    from seewhy.knowledge.axiom import Literal

__all__ = ["Wanted", "decide_named_things"]


@dataclass(frozen=True)
class Wanted:
    """What is asked of a scene: literals, and what is supposed instead of what is seen."""

    why: Sequence[str] = ()
    change: Sequence[str] = ()
    supposing: Sequence[str] = ()
    ask: Sequence[str] = ()


def decide_named_things(
    domain: Domain,
    assignments: Sequence[str],
    *,
    file: Path | None,
    image: str | None,
    wanted: Wanted,
    json: bool,
) -> None:
    """Print what is believed of a scene of things, and what is asked of it."""
    from seewhy.data.named_things import named_scene, supposed
    from seewhy.data.scene_vector import vector_with_things
    from seewhy.data.thing_tables import things_of_file
    from seewhy.dialogue.scene_beliefs import SceneBeliefs
    from seewhy.domain.assignments import named_values
    from seewhy.errors import DomainError

    assert domain.things is not None, "the domain has no things"
    if file is None and image is not None:
        raise DomainError("--image goes with --things or --scene")
    if file is None and not assignments:
        raise DomainError(
            f"{domain.name} has things: name some, as in cup.{next(iter(domain.things.features))}="
            "…, or give a table with --things FILE or an annotated scene with --scene FILE"
        )
    if file is None:
        vector, things = named_scene(domain, assignments)
    else:
        things, related = things_of_file(file, domain, image=image)
        whole = tuple(map(named_values(domain, assignments).get, domain.features))
        vector = vector_with_things(domain, whole, things, related)
    names = [thing.name for thing in things]
    beliefs = SceneBeliefs(domain, vector, names)
    found = _found(beliefs)
    found |= {
        "why": [_why(beliefs, beliefs.read(text)) for text in wanted.why],
        "change": [_change(beliefs, beliefs.read(text)) for text in wanted.change],
    }
    if wanted.supposing:
        other = supposed(domain, vector, names, wanted.supposing)
        found["supposing"] = _found(SceneBeliefs(domain, other, names, reasoner=beliefs.reasoner))
    replies, failed = answers_about(domain.things, beliefs.scene, wanted.ask)
    if json:
        answers = [reply.to_dict() for reply in replies]
        print_json({"domain": domain.name, "things": names, **found, "answers": answers})
    else:
        _print(found, supposing=", ".join(wanted.supposing))
        for reply in replies:
            say()
            print_reply(reply)
    if failed:
        raise typer.Exit(2)


def _found(beliefs: SceneBeliefs) -> dict[str, Any]:
    """The class with its reason, and what else follows."""
    domain, label = beliefs.domain, beliefs.decision.label
    found: dict[str, Any] = {"class": None, "verdict": None, "justification": None}
    if domain.classes:
        found |= {
            "class": label,
            "say": "not decided" if label is None else domain.classes[label].say,
            "verdict": beliefs.decision.verdict.value,
        }
    if label is not None:
        node = beliefs.why(domain.schema.classes[label])
        found |= {"justification": node.to_dict(), "because": node.to_text()}
    found["concluded"] = [
        {"literal": beliefs.named(literal), "text": beliefs.say(literal)}
        for literal in beliefs.concluded
    ]
    return found


def _why(beliefs: SceneBeliefs, literal: Literal) -> dict[str, Any]:
    node = beliefs.why(literal)
    return {
        "literal": beliefs.named(literal),
        "believed": beliefs.is_believed(literal),
        "text": node.to_text(),
        "justification": node.to_dict(),
    }


def _change(beliefs: SceneBeliefs, literal: Literal) -> dict[str, Any]:
    return {
        "literal": beliefs.named(literal),
        "text": beliefs.say(literal),
        "believed": beliefs.is_believed(literal),
        "changes": [
            {"text": beliefs.say_change(change), "cost": change.cost}
            for change in beliefs.changes(literal)
            if change.changes
        ],
    }


def _print(found: dict[str, Any], *, supposing: str) -> None:
    _print_found(found)
    for asked in found["why"]:
        say()
        say(f"{asked['literal']}: {'believed' if asked['believed'] else 'not believed'}")
        for line in asked["text"].splitlines():
            say(f"  {line}")
    for asked in found["change"]:
        say()
        if asked["believed"]:
            say(f"{asked['text']} already")
        elif not asked["changes"]:
            say(f"nothing would make it so that {asked['text']}")
        for change in asked["changes"]:
            say(f"{asked['text']} if {change['text']}")
    if "supposing" in found:
        say()
        say(f"supposing {supposing}:")
        _print_found(found["supposing"])


def _print_found(found: dict[str, Any]) -> None:
    if found["verdict"] is not None:
        say(f"class: {found['say']}")
    if found["justification"] is not None:
        say("because:")
        for line in found["because"].splitlines():
            say(f"  {line}")
    if found["concluded"]:
        say("it follows that:")
        from seewhy.dialogue.things.said_once import said_once

        texts = {literal["literal"]: literal["text"] for literal in found["concluded"]}
        for name in said_once(texts):
            say(f"  {texts[name]}")
    elif found["verdict"] is None:
        say("nothing follows")
