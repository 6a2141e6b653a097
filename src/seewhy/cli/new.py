"""`seewhy new`: write a working domain folder to start from."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.data_import import say_dataset, say_notes
from seewhy.cli.import_options import (
    ClassColumn,
    ClassOfBoxes,
    ClassParts,
    Copy,
    Features,
    Group,
    ImageColumn,
    Inside,
    LinksOutside,
    Pictures,
    TestShare,
    command_of,
    request_of,
)
from seewhy.cli.options import Json
from seewhy.cli.screen import print_json, progress, remark, say

if TYPE_CHECKING:
    from seewhy.data.importers import ImportRequest


def new(
    name: Annotated[
        str,
        typer.Argument(metavar="NAME", help="The folder to write; its last part names the domain."),
    ],
    source: Annotated[
        Path | None,
        typer.Option(
            "--from",
            metavar="SOURCE",
            help="Labelled pictures: a dataset folder, class folders, an export, a table; zipped "
            "or not.",
        ),
    ] = None,
    data: Annotated[
        Path | None,
        typer.Option(
            "--data", metavar="DIR", help="Import SOURCE into this dataset folder as well."
        ),
    ] = None,
    subject: Annotated[
        str | None,
        typer.Option(
            "--subject", metavar="TEXT", help="How answers name the picture, such as 'the hand'."
        ),
    ] = None,
    format: Annotated[
        str | None,
        typer.Option("--format", metavar="FORMAT", help="Of SOURCE; found where left out."),
    ] = None,
    pictures: Pictures = None,
    features: Features = None,
    class_parts: ClassParts = None,
    group: Group = None,
    class_rule: ClassOfBoxes = "only",
    image_column: ImageColumn = None,
    class_column: ClassColumn = None,
    inside: Inside = None,
    test_share: TestShare = 0.0,
    copy: Copy = False,
    outside: LinksOutside = False,
    json: Json = False,
) -> None:
    """Write a working domain folder: features, axioms, questions, and a README.

    With --from, it has the classes and features of pictures that are labelled already.
    """
    if source is None:
        given = {
            "--data": data, "--subject": subject, "--format": format, "--pictures": pictures,
            "--features": features, "--class-parts": class_parts, "--group": group,
            "--class-column": class_column, "--image-column": image_column, "--inside": inside,
        }  # fmt: skip
        _refuse_without_source([option for option, value in given.items() if value is not None])
        _write_template(Path(name), json=json)
        return
    request = request_of(
        source,
        format or "",
        pictures=pictures,
        features=features,
        class_parts=class_parts,
        group=group,
        class_rule=class_rule,
        image_column=image_column,
        class_column=class_column,
        inside=inside,
        test_share=test_share,
        copy=copy,
        outside=outside,
    )
    _write_from(Path(name), request, data=data, subject=subject or "the picture", json=json)


def _refuse_without_source(given: list[str]) -> None:
    from seewhy.errors import SeeWhyError

    if given:
        raise SeeWhyError(
            f"{given[0]} goes with --from SOURCE, which names the labelled pictures; add it"
        )


def _write_template(folder: Path, *, json: bool) -> None:
    from seewhy.new_domain.template import write_new_domain

    write_new_domain(folder)
    if json:
        print_json({"folder": str(folder), "files": sorted(path.name for path in folder.iterdir())})
        return
    say(f"{folder} holds a working domain; its README.md says how to make it yours.")
    say(f"  seewhy check {folder}")


def _write_from(
    folder: Path, request: ImportRequest, *, data: Path | None, subject: str, json: bool
) -> None:
    from seewhy.new_domain.from_source import new_domain_from

    with progress() as bars:
        task = bars.add_task("importing pictures", total=None, visible=data is not None)
        made = new_domain_from(
            request,
            folder,
            command_of=lambda request, features, out: command_of(
                request, features=features, out=out
            ),
            data=data,
            subject=subject,
            on_progress=lambda done, total: bars.update(task, completed=done, total=total),
        )
    say_notes(made.notes)
    if made.has_look:
        remark(
            "no feature is said, so the domain has one, what a picture looks like as a whole; "
            "features of your own make reasons: --features TABLE has a row a class and a column a "
            "feature, --class-parts says what names such as 2-red-oval are made of; or add columns "
            "to scenes.csv"
        )
    if made.written.alike:
        remark(f"classes that have the same features: {', '.join(made.written.alike)}")
    if json:
        print_json(made.as_json())
        return
    written = made.written
    if made.dataset is not None:
        say_dataset(made.dataset)
    axioms = f", {written.axioms} axioms that follow from them" if written.axioms else ""
    say(
        f"{written.folder} holds a domain of {written.classes} classes and {written.features} "
        f"feature{'s' * (written.features != 1)}{axioms}; its README.md says how to go on."
    )
    for command in made.commands:
        say(f"  {command}")
