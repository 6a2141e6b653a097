"""Options of the commands that import pictures: `seewhy data import` and `seewhy new --from`."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, cast

import typer

if TYPE_CHECKING:
    from seewhy.data.importers import ImportRequest
    from seewhy.data.importers.boxes import ClassRule

Pictures = Annotated[
    Path | None,
    typer.Option(
        "--pictures", metavar="DIR", help="Where the pictures lie, if not beside the export."
    ),
]
Features = Annotated[
    Path | None,
    typer.Option(
        "--features",
        metavar="TABLE",
        help="A table with a row a class: the features that follow from it.",
    ),
]
ClassParts = Annotated[
    str | None,
    typer.Option(
        "--class-parts",
        metavar="PATTERN",
        help="What the classes' names are made of, such as number-colour-shape: features.",
    ),
]
Group = Annotated[
    str | None,
    typer.Option(
        "--group",
        metavar="REGEX",
        help="What it finds in a file name says which pictures belong together: '^(.+)_'.",
    ),
]
ClassOfBoxes = Annotated[
    str,
    typer.Option(
        "--class",
        metavar="RULE",
        help="The class of a picture with boxes: the kind of all of them (only), of the largest "
        "(largest), or none.",
    ),
]
ImageColumn = Annotated[
    str | None, typer.Option("--image-column", metavar="NAME", help="The column of the pictures.")
]
ClassColumn = Annotated[
    str | None,
    typer.Option("--class-column", metavar="NAME", help="The column, or control, of the class."),
]
Inside = Annotated[
    str | None,
    typer.Option(
        "--inside", metavar="FOLDER", help="The folder of SOURCE whose folders are the classes."
    ),
]
TestShare = Annotated[
    float,
    typer.Option(
        "--test-share",
        metavar="SHARE",
        help="The share of pictures to keep for evaluation, where the source has no splits.",
    ),
]
Copy = Annotated[
    bool,
    typer.Option("--copy", help="Copy pictures even where they could be linked."),
]
LinksOutside = Annotated[
    bool,
    typer.Option("--outside", help="Also follow links that lead out of SOURCE."),
]


def request_of(
    source: Path,
    format: str,
    *,
    pictures: Path | None,
    features: Path | None,
    class_parts: str | None,
    group: str | None,
    class_rule: str,
    image_column: str | None,
    class_column: str | None,
    inside: str | None,
    test_share: float,
    copy: bool,
    outside: bool,
) -> ImportRequest:
    """The request that the options of a command line make."""
    from seewhy.data.importers import ImportRequest

    return ImportRequest(
        source=source,
        format=format,
        pictures=pictures,
        features=features,
        class_parts=class_parts,
        group=group,
        class_rule=cast("ClassRule", class_rule),
        image_column=image_column,
        class_column=class_column,
        inside=inside,
        test_share=test_share,
        copy=copy,
        outside=outside,
    )


def command_of(request: ImportRequest, *, features: Path | None, out: Path) -> str:
    """The command that imports a request with a table of features into a folder.

    Examples
    --------
    >>> from seewhy.data.importers import ImportRequest
    >>> request = ImportRequest(Path("my hands.zip"), "folder", group="^[0-9]+")
    >>> command_of(request, features=Path("hands/classes.csv"), out=Path("hands_data"))
    "seewhy data import folder 'my hands.zip' --features hands/classes.csv --group '^[0-9]+' \
--out hands_data"
    """
    words = ["seewhy", "data", "import", request.format, str(request.source)]
    for option, value in (
        ("--pictures", request.pictures),
        ("--features", features),
        ("--group", request.group),
        ("--class", None if request.class_rule == "only" else request.class_rule),
        ("--image-column", request.image_column),
        ("--class-column", request.class_column),
        ("--inside", request.inside),
        ("--test-share", request.test_share or None),
    ):
        if value is not None:
            words += [option, str(value)]
    words += [option for option, given in _flags(request) if given]
    return shlex.join([*words, "--out", str(out)])


def _flags(request: ImportRequest) -> tuple[tuple[str, bool], ...]:
    return (("--copy", request.copy), ("--outside", request.outside))
