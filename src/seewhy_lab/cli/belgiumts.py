"""`seewhy belgiumts`: the photographs of Belgian traffic signs become a dataset."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.options import Json
from seewhy.cli.screen import add_row, output, print_json, progress, remark, say, table

if TYPE_CHECKING:
    from seewhy_lab.belgiumts.conversion import ImportedDataset, ImportedHalf

_SIGNS = "traffic_signs"
_MOST_NAMED = 5
_SAID = {"train": "training", "test": "testing"}

app = typer.Typer(no_args_is_help=True)

Out = Annotated[Path, typer.Option("--out", metavar="DIR", help="The folder to write.")]
SignDomain = Annotated[
    str,
    typer.Option("--domain", help="The domain whose classes.csv says what each class shows."),
]


@app.command("import")
def import_(
    out: Out,
    archives: Annotated[
        list[Path] | None,
        typer.Argument(metavar="ARCHIVE...", help="Archives of BelgiumTS.", show_default=False),
    ] = None,
    domain: SignDomain = _SIGNS,
    json: Json = False,
) -> None:
    """Make a dataset of archives that were downloaded before.

    An interrupted import goes on where it was.
    """
    from seewhy.errors import SeeWhyError

    if not archives:
        raise SeeWhyError("there is no ARCHIVE; name BelgiumTSC_Training.zip, or several")
    _report(_imported(archives, out, domain), json=json)


@app.command()
def fetch(
    out: Out,
    domain: SignDomain = _SIGNS,
    address: Annotated[str | None, typer.Option("--address", hidden=True)] = None,
    json: Json = False,
) -> None:
    """Download photographs from their authors' server and make a dataset of them.

    The archives are kept in DIR/archives. An interrupted download goes on where it was.
    """
    from seewhy.domain.domain import load_domain
    from seewhy_lab.belgiumts.classes import read_classes
    from seewhy_lab.belgiumts.download import ADDRESS, check_counts, fetch_archives

    classes = read_classes(load_domain(domain))
    with progress() as bars:
        tasks = {}

        def show(archive: str, here: int, total: int | None) -> None:
            if archive not in tasks:
                tasks[archive] = bars.add_task(f"{archive} (MB)", total=None)
            whole = None if total is None else total // 10**6
            bars.update(tasks[archive], completed=here // 10**6, total=whole)

        archives = fetch_archives(out / "archives", address=address or ADDRESS, on_progress=show)
    check_counts(archives, class_ids=set(classes))
    _report(_imported(archives, out, domain), json=json)


def _imported(sources: Sequence[Path], out: Path, domain: str) -> ImportedDataset:
    from seewhy.domain.domain import load_domain
    from seewhy_lab.belgiumts.conversion import import_photographs

    signs = load_domain(domain)
    with progress() as bars:
        task = bars.add_task("importing photographs", total=None)
        return import_photographs(
            sources,
            out,
            domain=signs,
            on_progress=lambda done, total: bars.update(task, completed=done, total=total),
        )


def _report(dataset: ImportedDataset, *, json: bool) -> None:
    for half in dataset.halves.values():
        _warn(half)
    if json:
        print_json(dataset.as_json())
        return
    counts = table("class", *(f">{split}" for split in dataset.halves))
    for key in next(iter(dataset.halves.values())).classes:
        add_row(counts, key, *(str(half.classes[key]) for half in dataset.halves.values()))
    output().print(counts)
    say()
    for split, half in dataset.halves.items():
        official = (
            "as in the official archive"
            if half.photographs == half.official
            else f"the official archive has {half.official:,}"
        )
        say(
            f"{split}: {half.photographs:,} photographs ({official}) of {half.groups:,} signs in "
            f"{len(half.classes) - len(half.empty_classes)} classes, from {half.source}"
        )
        if half.repeated_rows:
            say(f"  {half.repeated_rows} rows of its tables name a picture again and add nothing")
        if half.empty_classes:
            say(
                f"  classes without a photograph ({len(half.empty_classes)}): "
                f"{', '.join(half.empty_classes)}"
            )
    for split in _SAID.keys() - dataset.halves.keys():
        say(f"the {_SAID[split]} half was not given: no row of scenes.csv has split = {split}")
    say(f"dataset: {dataset.folder} ({dataset.photographs:,} photographs)")


def _warn(half: ImportedHalf) -> None:
    """Say on standard error what was not as it should be."""
    left_out = [f"{picture.file} {picture.reason}" for picture in half.left_out]
    for found, text in (
        (left_out, "left out"),
        (half.rows_without_file, "rows without a picture"),
        (half.files_without_row, "pictures without a row, used all the same"),
        (half.without_pole, "pictures whose name says no pole, each taken for a sign of its own"),
    ):
        if found:
            more = f"; and {len(found) - _MOST_NAMED} more" * (len(found) > _MOST_NAMED)
            remark(f"{text} ({len(found)}): {'; '.join(found[:_MOST_NAMED])}{more}")
