"""`seewhy revisions`: how the knowledge of a model or a domain was revised in dialogue."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from seewhy.cli.options import Json
from seewhy.cli.screen import add_row, output, print_json, say, table

if TYPE_CHECKING:
    from seewhy.revision.record import Revision


def revisions(
    folder: Annotated[
        Path, typer.Argument(metavar="MODEL_OR_DOMAIN", help="A model folder, or a domain folder.")
    ],
    undo: Annotated[
        int | None,
        typer.Option("--undo", metavar="N", min=1, help="Take the revision of this number back."),
    ] = None,
    data: Annotated[
        Path | None,
        typer.Option("--data", help="To take a label back: the dataset folder that it stands in."),
    ] = None,
    json: Json = False,
) -> None:
    """List the revisions of a model or a domain, oldest first, or take one back.

    Revisions are made in 'seewhy chat'. The record is the file revisions.jsonl beside
    knowledge.al.
    """
    from seewhy.revision.model_folder import folder_of_domain
    from seewhy.revision.record import RecordFile, revisions_of
    from seewhy.revision.revisions import Revisions

    if undo is not None:
        revision = Revisions(folder, dataset=data).take_back(undo)
        if json:
            print_json(revision_dict(revision))
        else:
            say(f'taken back: revision {undo}, "{revision.taken.sentence}"')
        return
    found = revisions_of(RecordFile.beside(folder_of_domain(folder)).lines())
    if json:
        print_json([revision_dict(revision) for revision in found])
        return
    if not found:
        say("nothing was revised")
        return
    rows = table(">no", "when", "what was wrong", "revision", "taken back")
    for revision in found:
        taken = revision.taken
        add_row(
            rows,
            str(taken.number),
            taken.at[:16].replace("T", " "),
            taken.cause.value,
            f"{taken.picture}: {taken.sentence}" if taken.picture else taken.sentence,
            (revision.taken_back or "")[:16].replace("T", " "),
        )
    output().print(rows)


def revision_dict(revision: Revision) -> dict[str, Any]:
    """A revision as values that JSON can hold."""
    taken = revision.taken
    return {
        "number": taken.number,
        "taken": taken.at,
        "taken_back": revision.taken_back,
        "cause": taken.cause.value,
        "sentence": taken.sentence,
        "statement": taken.statement or None,
        "about": taken.about or None,
        "picture": taken.picture or None,
        "edits": [
            {"file": edit.file, "before": edit.before, "after": edit.after}
            for edit in taken.changes
        ],
    }
