"""`seewhy data import`: pictures that are labelled already become a dataset."""

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
from seewhy.cli.screen import print_json, progress, remark, say
from seewhy.data.annotation_formats import FORMATS, format_called
from seewhy.errors import SeeWhyError
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from collections.abc import Sequence

    from seewhy.data.importers import ImportedDataset, ImportRequest, Note

CLEVR = "clevr"
IMPORTED = (*FORMATS, CLEVR)
_MOST_NAMED = 5
_MOST_CLASSES = 12

Out = Annotated[Path, typer.Option("--out", metavar="DIR", help="The folder to write.")]


def import_(
    format: Annotated[
        str,
        typer.Argument(metavar="FORMAT", help=f"{', '.join(IMPORTED[:-1])} or {IMPORTED[-1]}."),
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
        typer.Option("--from", metavar="SOURCE", help="The same as SOURCE."),
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
    scenes: Annotated[
        Path | None,
        typer.Option("--scenes", metavar="FILE", help="With clevr: the file of scenes."),
    ] = None,
    questions: Annotated[
        Path | None,
        typer.Option("--questions", metavar="FILE", help="With clevr: questions about them."),
    ] = None,
    domain: Annotated[
        str, typer.Option("--domain", help="With clevr: the domain whose things they are.")
    ] = "tabletop",
    json: Json = False,
) -> None:
    """Make a dataset of pictures that are labelled already: class folders, exports, tables.

    Boxes are kept in things.csv. An interrupted import goes on where it was.
    """
    if format == CLEVR:
        named = [*(source or ()), *(more or ()), *([scenes] if scenes else ())]
        import_clevr(
            _one_source(named), out, questions, pictures, domain=domain, copy=copy, json=json
        )
        return
    if scenes is not None or questions is not None:
        raise SeeWhyError("--scenes and --questions go with 'seewhy data import clevr'")
    _check_format(format)
    chosen = _one_source([*(source or ()), *(more or ())])
    request = request_of(
        chosen,
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


def import_clevr(
    scenes: Path,
    out: Path,
    questions: Path | None,
    pictures: Path | None,
    *,
    domain: str,
    copy: bool,
    json: bool,
) -> None:
    """Make a dataset of scenes of things, with the questions about them and their pictures."""
    from seewhy.data.importers.clevr_dataset import import_scenes
    from seewhy.domain.domain import load_domain

    loaded = load_domain(domain)
    if loaded.things is None:
        raise SeeWhyError(f"{loaded.folder}: the domain has no [things] that scenes could show")
    with progress() as bars:
        task = bars.add_task("importing scenes", total=None)
        imported = import_scenes(
            scenes,
            out,
            loaded.things,
            questions=questions,
            pictures=pictures,
            copy=copy,
            on_progress=lambda done, total: bars.update(task, completed=done, total=total),
        )
    if json:
        print_json(imported.as_json())
        return
    say(
        f"dataset: {imported.folder} ({imported.scenes:,} scenes of {imported.things:,} things, "
        f"{imported.relations:,} relations, {imported.questions:,} questions, "
        f"{imported.pictures:,} pictures)"
    )


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


def _check_format(name: str) -> None:
    if name not in IMPORTED and Path(name).exists():
        raise SeeWhyError(f"'{name}' is a source; say its format before it: {', '.join(IMPORTED)}")
    format_called(name, beside=(CLEVR,))


def _one_source(sources: Sequence[Path]) -> Path:
    if not sources:
        raise SeeWhyError("there is no SOURCE; name a folder, a zip archive or an exported file")
    if len(sources) > 1:
        raise SeeWhyError(
            f"there are {len(sources)} sources ({', '.join(map(str, sources[:5]))}); give one: a "
            "folder may hold several exports"
        )
    return sources[0]
