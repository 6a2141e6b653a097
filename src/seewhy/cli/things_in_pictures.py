"""Commands on models of several things in a picture: train, ask, chat, classify, evaluate."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.cli.conversation import converse
from seewhy.cli.screen import (
    add_row,
    output,
    print_json,
    progress,
    remark,
    say,
    table,
    warn,
)
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.agent.things.thing_reply import PictureReply, ReadScene
    from seewhy.data.thing import BoundingBox
    from seewhy.domain.domain import Domain
    from seewhy.evaluation.things_seen import SeenFeature, ThingsSeen

__all__ = [
    "ask_things",
    "chat_about_things",
    "classify_things",
    "evaluate_things_seen",
    "refuse",
    "train_things",
]


def refuse(given: Mapping[str, object], *, why: str) -> None:
    """Raise a SeeWhyError for the first option that was given and is not for things."""
    from seewhy.errors import SeeWhyError

    for option, value in given.items():
        if value:
            raise SeeWhyError(f"{option} is not for pictures of several things: {why}")


def train_things(
    domain: Domain,
    data: Path,
    out: Path,
    *,
    eyes: str | None,
    device: str,
    outside: bool,
    seed: int,
    json: bool,
) -> None:
    """Train on a dataset with things.csv, and write the model."""
    from seewhy.agent.model import check_target, replaced_notice
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.agent.things.thing_fitting import scenes_with_things
    from seewhy.cli.read_data import read_data
    from seewhy.cli.training import eyes_progress
    from seewhy.files.locks import sole_writer

    check_target(out)
    agent = ThingAgent(domain, seed=seed, eyes=eyes, device=device)
    dataset = read_data(data, domain, outside=outside)
    scenes_with_things(dataset, domain)  # what is missing is said before anything long begins
    if (replaced := replaced_notice(out)) is not None:
        remark(replaced)
    checkpoints = out.with_name(f"{out.name}.training")
    with sole_writer(checkpoints), progress() as bars:
        agent.fit(dataset, checkpoints=checkpoints, on_progress=eyes_progress(bars))
        agent.save(out)
        shutil.rmtree(checkpoints, ignore_errors=True)
    _print_training(agent, out, json=json)


def _print_training(agent: ThingAgent, out: Path, *, json: bool) -> None:
    seeing = agent.trained
    if json:
        print_json(
            {
                "model": str(out),
                "domain": agent.domain.name,
                "features": {
                    key: {
                        "validation_accuracy": stack.accuracy,
                        "things": stack.pictures,
                        "weights": stack.weights,
                    }
                    for key, stack in seeing.eyes.stacks.items()
                },
                "relations": seeing.eyes.accuracies,
                "detector": seeing.trust.model_dump(mode="json"),
                "whole": {} if seeing.whole is None else seeing.whole.summary(),
            }
        )
        return
    rows = table("feature of things", "seen by", ">validation", ">things")
    for key, stack in seeing.eyes.stacks.items():
        accuracy = "–" if stack.accuracy is None else percent(stack.accuracy)
        add_row(rows, key, " and ".join(stack.asked), accuracy, str(stack.pictures))
    output().print(rows)
    for key, right in seeing.eyes.accuracies.items():
        say(f"{key}: {percent(right)} of pairs that had no part in teaching it are right")
    for key in _never_said(agent):
        remark(
            f"nothing was learned of '{key}': relations.csv says of no two things that it holds, "
            "or never that it does not"
        )
    say(f"model: {out}")


def _never_said(agent: ThingAgent) -> list[str]:
    from seewhy.agent.things.thing_lessons import seen_once

    return [key for key in seen_once(agent.things) if key not in agent.trained.eyes.related]


def ask_things(
    model: Path,
    image: Path,
    question: str,
    *,
    things: Path | None,
    picture: Path | None,
    device: str,
    voices: Sequence[Any],
    json: bool,
) -> None:
    """Answer a question about the things in a picture, with the reasons."""
    agent = _loaded(model, device)
    scene = agent.scene_of(agent.read(image, boxes=_boxes(agent, things, image)))
    reply = agent.answer(question, scene)
    if picture is not None:
        from seewhy.report.thing_card import draw_thing_card

        draw_thing_card(reply, image).save(picture)
        remark(f"picture: {picture}")
    if json:
        print_json(reply.to_dict())
    else:
        _print_reply(reply)
    for voice in voices:
        voice(reply.text)


def _loaded(model: Path, device: str) -> ThingAgent:
    from seewhy.agent.things.thing_agent import ThingAgent

    return ThingAgent.load(model, device=device)


def _boxes(agent: ThingAgent, file: Path | None, image: Path) -> list[BoundingBox] | None:
    """The boxes of a table of things, of the picture that is asked about."""
    if file is None:
        return None
    from seewhy.data.thing_tables import things_of_picture
    from seewhy.errors import DatasetError

    found = things_of_picture(file, agent.domain, image)
    for thing in found:
        if thing.box is None:
            raise DatasetError(
                f"{file}:{thing.line}: '{thing.name}' has no box; fill left, top, right and bottom"
            )
    return [thing.box for thing in found if thing.box is not None]


def _print_reply(reply: PictureReply) -> None:
    say(reply.text)
    say()
    _print_scene(reply.read)
    if (least := reply.say_least_sure()) is not None:
        say(f"not sure: {least}")
    say("because:")
    for line in reply.justification.to_text().splitlines():
        say(f"  {line}")


def _print_scene(read: ReadScene) -> None:
    reading, domain = read.reading, read.domain
    for number, thing in enumerate(reading.things):
        values = ", ".join(
            f"{key} {seen.value} ({seen.probability:.2f})" for key, seen in thing.values.items()
        )
        say(f"seen: {read.names[number]} ({thing.probability:.2f}): {values}")
    if not reading.things:
        say(f"seen: no {read.things.one} was found")
    for thing in reading.doubtful:
        box = thing.box
        say(
            f"perhaps a {read.things.one}, too ({thing.probability:.2f}), around "
            f"({box.middle[0]:.0f}, {box.middle[1]:.0f})"
        )
    for said in read.notices():
        say(said)
    for key, seen in reading.whole.items():
        say(f"seen: {domain.features[key].name} {seen.value} ({seen.probability:.2f})")
    if reading.label is not None:
        sure = "" if reading.class_probability is None else f" ({reading.class_probability:.2f})"
        by = "concluded" if reading.method == "knowledge" else "seen"
        say(f"class: {domain.classes[reading.label].say}, {by}{sure if by == 'seen' else ''}")


def chat_about_things(
    model: Path, image: Path, *, data: Path | None, device: str, json: bool, voice: Any
) -> None:
    """Talk about the things in a picture, and revise the rules about them."""
    from seewhy.data.dataset import Dataset
    from seewhy.revision.revisions import Revisions
    from seewhy.revision.things.conversation import ThingConversation

    agent = _loaded(model, device)
    if data is not None:
        Dataset.load(data, agent.domain)
    sighting = agent.read(image).sighting
    talk = ThingConversation(
        agent,
        Revisions(model, dataset=data),
        look=lambda knowing: knowing.scene_of(knowing.reader.read(sighting)),
    )
    converse(
        talk.say,
        greeting=(
            "Ask about the things in the picture, for instance:",
            f"  how many {agent.things.many} are there?",
            "  what is there?",
            'then "why?"; "the rule is wrong" revises the rules; an empty line ends.',
        ),
        json=json,
        voice=voice,
    )


def classify_things(
    model: Path, pictures: Sequence[Path], out: Path, *, outside: bool, device: str, json: bool
) -> None:
    """Write the things that pictures show to a table with the columns of things.csv."""
    from seewhy.classification.things import things_to_table
    from seewhy.data.picture_listing import list_pictures

    agent = _loaded(model, device)
    listing = list_pictures(pictures, agent.domain, with_class=True, outside=outside)
    with progress() as bars:
        task = bars.add_task("looking for things", total=len(listing.pictures))
        found = things_to_table(
            agent,
            listing.pictures,
            out,
            on_progress=lambda done: bars.update(task, completed=done),
        )
    for problem in found.problems:
        remark(problem)
    if json:
        print_json(
            {
                "table": str(out),
                "pictures": found.pictures,
                "things": found.things,
                "problems": len(found.problems),
            }
        )
        return
    say(f"{found.pictures:,} pictures: {found.things:,} {agent.things.many}")
    say(f"table: {out}")


def evaluate_things_seen(
    model: Path,
    data: Path,
    *,
    page: Path | None,
    most: int | None,
    outside: bool,
    device: str,
    json: bool,
) -> None:
    """Print how well the things in annotated pictures are seen, and write it as a page."""
    from seewhy.cli.read_data import read_data
    from seewhy.evaluation.things_seen import evaluate_things

    agent = _loaded(model, device)
    dataset = read_data(data, agent.domain, outside=outside, evaluated=True)
    with progress() as bars:
        task = bars.add_task("looking at pictures", total=len(dataset.of_split("test")))
        result = evaluate_things(
            agent, dataset, on_progress=lambda done: bars.update(task, completed=done)
        )
    if result.known:
        warn(
            f"{result.known:,} of the pictures taught the model: of those it knows too much for "
            "the figures to hold for others"
        )
    if page is not None:
        _write_page(page, agent.domain, result, most=most)
    if json:
        print_json(result.to_dict())
        return
    _print_figures(result, agent)
    if page is not None:
        say(f"page: {page}")


def _write_page(page: Path, domain: Domain, result: ThingsSeen, *, most: int | None) -> None:
    from seewhy.cli.command_line import as_typed
    from seewhy.files.whole_files import write_whole
    from seewhy.report.evaluation_page import MOST_PICTURES
    from seewhy.report.things_evaluation_page import things_evaluation_page

    shown = MOST_PICTURES if most is None else most
    write_whole(page, things_evaluation_page(domain, result, command=as_typed(), most=shown))


def _print_figures(result: ThingsSeen, agent: ThingAgent) -> None:
    many = agent.things.many
    total = result.found + result.missed
    say(
        f"{result.pictures:,} pictures with {total:,} {many}: {result.found:,} found, "
        f"{result.missed:,} missed, {result.imagined:,} imagined"
    )
    rows = table("what is read", ">right", ">of", ">majority")
    named: list[tuple[str, SeenFeature]] = [*result.features.items(), *result.relations.items()]
    if result.classes is not None:
        named.append(("class", result.classes))
    for key, seen in named:
        add_row(rows, key, percent(seen.right.value), f"{seen.right.of:,}", percent(seen.majority))
    output().print(rows)
    say(
        f"scenes wholly right: {percent(result.scenes.value)} ({result.scenes.right:,} of "
        f"{result.scenes.of:,}); with relations, too: "
        f"{percent(result.scenes_with_relations.value)}"
    )
    if result.inconsistent:
        say(f"{result.inconsistent:,} pictures could not be read as the knowledge allows")
    say(f"{result.pictures_per_second:.1f} pictures a second")
    for picture in result.wrong[:5]:
        say(f"  {picture.image}: {'; '.join(picture.wrong[:4])}")
    if len(result.wrong) > 5:
        say(f"  … and {len(result.wrong) - 5:,} more that are not wholly right; --json lists all")
