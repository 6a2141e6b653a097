"""`seewhy classify`: many pictures become a table."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.cores import share_cores
from seewhy.cli.options import Device, Gate, Json, KnownShare, ModelFolder, Outside, Reading
from seewhy.cli.screen import print_json, progress, remark, say
from seewhy.cli.things_in_pictures import classify_things, refuse

if TYPE_CHECKING:
    from seewhy.classification.running import Classified


def classify(
    model: ModelFolder,
    pictures: Annotated[
        list[Path],
        typer.Argument(
            metavar="PICTURES…",
            help="Folders, patterns such as 'photos/*.jpg', files, or tables with a column image.",
            show_default=False,
        ),
    ],
    out: Annotated[
        Path,
        typer.Option("--out", metavar="TABLE", help="The table: .csv, .json or .parquet."),
    ],
    all_: Annotated[
        bool,
        typer.Option("--all", help="Of tables, classify rows that have a class, too."),
    ] = False,
    outside: Outside = False,
    device: Device = "auto",
    reading: Reading = None,
    gate: Gate = None,
    known_share: KnownShare = None,
    json: Json = False,
) -> None:
    """Classify many pictures: a table with classes, probabilities, features and reasons.

    Where pictures show several things, a table of the things, with the columns of things.csv.

    An interrupted run goes on where it was when the same command is given again.
    """
    from seewhy.classification.table_files import check_table

    check_table(out)
    share_cores()
    from seewhy.agent.agent import Agent
    from seewhy.agent.manifest_file import MANIFEST, is_of_things
    from seewhy.classification.running import classify_to_table
    from seewhy.data.digest import digest_of
    from seewhy.data.importers.annotation import Note
    from seewhy.data.importers.folder_files import LINKS_OUT
    from seewhy.data.picture_listing import list_pictures
    from seewhy.errors import DatasetError

    if is_of_things(model):
        options = {"--reading": reading, "--gate": gate, "--known-share": known_share}
        refuse(options, why="leave it out")
        classify_things(model, pictures, out, outside=outside, device=device, json=json)
        return
    agent = Agent.load(model, device=device, reading=reading, gate=gate, known_share=known_share)
    listing = list_pictures(pictures, agent.domain, with_class=all_, outside=outside)
    if any(out.exists() and out.samefile(table) for table in listing.tables):
        raise DatasetError(f"{out}: is the table that names the pictures; name another for --out")
    if listing.with_class:
        remark(
            f"rows that have a class are left out ({listing.with_class:,}); --all classifies them, "
            "too"
        )
    if listing.links_out:
        remark(Note(LINKS_OUT, listing.links_out).say())
    with progress() as bars:
        task = bars.add_task("classifying", total=len(listing.pictures))
        found = classify_to_table(
            agent,
            listing.pictures,
            out,
            model=digest_of(model / MANIFEST),
            on_notice=remark,
            on_progress=lambda done: bars.update(task, completed=done),
        )
    _say_problems(found)
    if json:
        print_json(_as_json(found))
    else:
        _say_classes(found)


def _say_problems(found: Classified) -> None:
    if found.problems:
        remark(
            f"{found.problems:,} of {found.pictures:,} pictures could not be read; the column "
            "'problem' says why:"
        )
    for problem in found.first_problems:
        remark(f"  {problem}")
    if found.problems > len(found.first_problems):
        remark(f"  and {found.problems - len(found.first_problems):,} more")


def _say_classes(found: Classified) -> None:
    counts = [f"{label} {count:,}" for label, count in found.classes.items()]
    if found.undecided:
        counts.append(f"no class {found.undecided:,}")
    if found.problems:
        counts.append(f"not read {found.problems:,}")
    say(f"{found.pictures:,} pictures: {', '.join(counts)}")
    say(f"table: {found.table}")


def _as_json(found: Classified) -> dict[str, object]:
    return {
        "table": str(found.table),
        "pictures": found.pictures,
        "classes": found.classes,
        "no_class": found.undecided,
        "problems": found.problems,
    }
