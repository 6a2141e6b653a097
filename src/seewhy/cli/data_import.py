"""`seewhy data import` and `seewhy data fetch`: what others photographed and labelled."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

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
    request_of,
)
from seewhy.cli.options import Json
from seewhy.cli.screen import add_row, output, percent, print_json, progress, remark, say, table

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from seewhy.belgiumts.conversion import ImportedDataset as ImportedPhotographs
    from seewhy.belgiumts.conversion import ImportedHalf
    from seewhy.data.importers import ImportedDataset, ImportRequest, Note

PHOTOGRAPHS = ("belgiumts",)
FORMATS = ("folder", "coco", "voc", "yolo", "labelstudio", "cvat", "table")
_MOST_NAMED = 5
_MOST_CLASSES = 12
_SAID = {"train": "training", "test": "testing"}

Name = Annotated[
    str, typer.Argument(metavar="NAME", help=f"The photographs: {', '.join(PHOTOGRAPHS)}.")
]
Out = Annotated[Path, typer.Option("--out", metavar="DIR", help="The folder to write.")]
SignDomain = Annotated[
    str | None,
    typer.Option(
        "--domain",
        help="belgiumts: the domain whose classes.csv says what each class shows (traffic_signs).",
    ),
]
_SIGNS = "traffic_signs"


def import_(
    format: Annotated[
        str,
        typer.Argument(metavar="FORMAT", help=f"{', '.join(FORMATS)}, or {PHOTOGRAPHS[0]}."),
    ],
    out: Out,
    source: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="SOURCE",
            help="A folder, a zip archive, or the file that a tool exported.",
            show_default=False,
        ),
    ] = None,
    more: Annotated[
        list[Path] | None,
        typer.Option(
            "--from",
            metavar="SOURCE",
            help="The same as SOURCE; belgiumts has several, one for each archive.",
        ),
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
    domain: SignDomain = None,
    json: Json = False,
) -> None:
    """Make a dataset of pictures that are labelled already: class folders, exports, tables.

    Boxes are kept in things.csv. An interrupted import goes on where it was.
    """
    _check_format(format)
    sources = [*(source or ()), *(more or ())]
    if format in PHOTOGRAPHS:
        _check_sources(sources, most=None)
        given = {
            "--pictures": pictures, "--features": features, "--class-parts": class_parts,
            "--group": group, "--image-column": image_column, "--class-column": class_column,
            "--inside": inside, "--test-share": test_share or None, "--copy": copy or None,
            "--outside": outside or None,
        }  # fmt: skip
        _refuse({option: value for option, value in given.items() if value is not None}, format)
        _report_photographs(_import_photographs(sources, out, domain or _SIGNS), json=json)
        return
    _refuse({"--domain": domain} if domain is not None else {}, format)
    _check_sources(sources, most=1)
    request = request_of(
        sources[0],
        format,
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
    dataset = run_import(request, out)
    say_notes(dataset.notes)
    if json:
        print_json(dataset.as_json())
    else:
        say_dataset(dataset)
        say(f"  seewhy new NAME --from {shlex.quote(str(out))} writes a domain to go with it")


def run_import(request: ImportRequest, out: Path) -> ImportedDataset:
    """Import with a bar that shows how far it is."""
    from seewhy.data.importers import import_pictures

    with progress() as bars:
        task = bars.add_task("importing pictures", total=None)
        return import_pictures(
            request,
            out,
            on_progress=lambda done, total: bars.update(task, completed=done, total=total),
        )


def say_notes(notes: Sequence[Note]) -> None:
    """Say on standard error what was not as it should be, and what was guessed."""
    for note in notes:
        remark(note.say(most=_MOST_NAMED))


def say_dataset(dataset: ImportedDataset) -> None:
    """Say what is in an imported dataset."""
    how = ", linked with their source" if dataset.linked else ""
    labelled = {name: count for name, count in dataset.classes.items() if name}
    say(
        f"dataset: {dataset.folder} ({dataset.pictures:,} pictures of {len(labelled)} "
        f"class{'es' * (len(labelled) != 1)}{how})"
    )
    say(f"  classes: {_counted(dataset.classes, dataset.pictures)}")
    for name, counts in dataset.features.items():
        say(f"  {name}: {_counted(counts, dataset.pictures)}")
    if dataset.splits:
        say("  splits: " + ", ".join(f"{key} {n:,}" for key, n in dataset.splits.items()))
    else:
        say("  splits: none; --test-share 0.25 would keep a quarter for evaluation")
    if dataset.groups:
        say(f"  groups: {dataset.groups:,}")
    if dataset.things:
        say(f"  things: {dataset.things:,} boxes ({_counted(dataset.kinds, dataset.things)})")


def _counted(counts: dict[str, int], total: int) -> str:
    """Names with their counts; of many, their number and the range of the counts."""
    named = {name: count for name, count in counts.items() if name}
    if len(named) > _MOST_CLASSES:
        low, high = min(named.values()), max(named.values())
        each = f"{low:,}" if low == high else f"{low:,} to {high:,}"
        said = f"{len(named)}, of each {each}"
    else:
        said = ", ".join(f"{name} {count:,}" for name, count in named.items())
    missing = total - sum(named.values())
    unknown = f"; not known {missing:,} ({percent(missing / total)})" if missing else ""
    return f"{said or 'none'}{unknown}"


def fetch(
    name: Name,
    out: Out,
    domain: SignDomain = None,
    address: Annotated[str | None, typer.Option("--address", hidden=True)] = None,
    json: Json = False,
) -> None:
    """Download photographs from their authors' server and make a dataset of them.

    The archives are kept in DIR/archives. An interrupted download goes on where it was.
    """
    _check_photographs(name)
    from seewhy.belgiumts.classes import read_classes
    from seewhy.belgiumts.download import ADDRESS, check_counts, fetch_archives
    from seewhy.domain import load_domain

    classes = read_classes(load_domain(domain or _SIGNS))
    with progress() as bars:
        tasks = {}

        def show(archive: str, here: int, total: int | None) -> None:
            if archive not in tasks:
                tasks[archive] = bars.add_task(f"{archive} (MB)", total=None)
            whole = None if total is None else total // 10**6
            bars.update(tasks[archive], completed=here // 10**6, total=whole)

        archives = fetch_archives(out / "archives", address=address or ADDRESS, on_progress=show)
    check_counts(archives, class_ids=set(classes))
    _report_photographs(_import_photographs(archives, out, domain or _SIGNS), json=json)


def _check_format(name: str) -> None:
    from seewhy.errors import SeeWhyError
    from seewhy.nearest import did_you_mean

    known = (*FORMATS, *PHOTOGRAPHS)
    if name not in known:
        path = Path(name)
        if path.exists():
            raise SeeWhyError(f"'{name}' is a source; say its format before it: {', '.join(known)}")
        raise SeeWhyError(f"'{name}' is no format that is imported; {did_you_mean(name, known)}")


def _refuse(given: Mapping[str, object], format: str) -> None:
    """Refuse options that go with other formats."""
    from seewhy.errors import SeeWhyError

    for option, value in given.items():
        shown = option if value is True else f"{option} {value}"
        raise SeeWhyError(f"{shown}: does not go with {format}; leave it out")


def _check_sources(sources: Sequence[Path], *, most: int | None) -> None:
    from seewhy.errors import SeeWhyError

    if not sources:
        raise SeeWhyError("there is no SOURCE; name a folder, a zip archive or an exported file")
    if most is not None and len(sources) > most:
        raise SeeWhyError(
            f"there are {len(sources)} sources ({', '.join(map(str, sources[:5]))}); give one: a "
            "folder may hold several exports"
        )


def _check_photographs(name: str) -> None:
    from seewhy.errors import SeeWhyError
    from seewhy.nearest import did_you_mean

    if name not in PHOTOGRAPHS:
        raise SeeWhyError(
            f"'{name}': there are no such photographs; {did_you_mean(name, PHOTOGRAPHS)}"
        )


def _import_photographs(sources: list[Path], out: Path, domain: str) -> ImportedPhotographs:
    from seewhy.belgiumts.conversion import import_photographs
    from seewhy.domain import load_domain

    signs = load_domain(domain)
    with progress() as bars:
        task = bars.add_task("importing photographs", total=None)
        return import_photographs(
            sources,
            out,
            domain=signs,
            on_progress=lambda done, total: bars.update(task, completed=done, total=total),
        )


def _report_photographs(dataset: ImportedPhotographs, *, json: bool) -> None:
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
