"""`seewhy data`: make datasets and look at them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli import data_import
from seewhy.cli.options import DomainName, Json, Outside, Seed
from seewhy.cli.screen import print_json, progress, remark, say
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.domain.domain import Domain

MANY_CLASSES = 8
"""Of more, the share of each would say less than their range."""

app = typer.Typer(no_args_is_help=True)


@app.command()
def make(
    domain: DomainName,
    out: Annotated[Path, typer.Option("--out", help="The folder to write.")],
    count: Annotated[int, typer.Option("--count", min=1, help="How many pictures.")] = 2500,
    seed: Seed = 0,
    size: Annotated[
        int | None,
        typer.Option(
            "--size",
            min=16,
            max=1024,
            help="Longer side of a picture in pixels; source_size of domain.toml where left out.",
        ),
    ] = None,
    workers: Annotated[
        int, typer.Option("--workers", min=-1, help="Processes to use; -1: one per core.")
    ] = -1,
    json: Json = False,
) -> None:
    """Make pictures with the domain's own source; the same seed makes the same files.

    One picture in three is marked split = test in scenes.csv. An interrupted call goes on
    where it was.
    """
    from seewhy.cli.code_notice import remark_code
    from seewhy.data.making import make_dataset
    from seewhy.domain.domain import load_domain
    from seewhy.errors import SeeWhyError

    if workers == 0:
        raise SeeWhyError("--workers must be -1 or at least 1, got 0")
    loaded = load_domain(domain)
    remark_code(loaded)
    with progress() as bars:
        task = bars.add_task("making pictures", total=count)
        made = make_dataset(
            loaded,
            out,
            count=count,
            seed=seed,
            size=size,
            workers=workers,
            on_progress=lambda done: bars.update(task, completed=done),
        )
    if json:
        print_json(
            {
                "folder": str(made.folder),
                "scenes": made.count,
                "classes": made.classes,
                "determined": made.determined,
            }
        )
        return
    say(f"{made.count} pictures in {made.folder}")
    for part in say_shares(loaded, made.classes):
        say(f"  {part}")
    if made.determined is None:
        return
    say(
        f"  {percent(made.determined)} of them have an outcome that their features determine "
        "(the best that any classifier over the features can do)"
    )


def say_shares(domain: Domain, shares: Mapping[str, float], *, between: str = ": ") -> list[str]:
    """Say the share of every class, or of many their number and the smallest and largest share."""
    if len(shares) > MANY_CLASSES:
        low, high = percent(min(shares.values())), percent(max(shares.values()))
        return [f"{len(shares)} classes, each {low} to {high}"]
    return [
        f"{domain.classes[name].say}{between}{percent(share)}" for name, share in shares.items()
    ]


@app.command()
def show(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="A dataset folder.")],
    domain: Annotated[
        str | None,
        typer.Option("--domain", help="Its domain; found from the columns where left out."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="The picture to write (DIR/contact_sheet.png).")
    ] = None,
    rows: Annotated[int, typer.Option("--rows", min=1, max=50)] = 5,
    columns: Annotated[int, typer.Option("--columns", min=1, max=20)] = 8,
    outside: Outside = False,
    json: Json = False,
) -> None:
    """Write a contact sheet: pictures with their labels."""
    from seewhy.data.dataset import Dataset
    from seewhy.data.dataset_domain import domain_of
    from seewhy.data.making import determined_share
    from seewhy.domain.domain import load_domain
    from seewhy.files.whole_files import whole_file
    from seewhy.report.contact_sheet import draw_contact_sheet

    loaded = load_domain(domain) if domain else domain_of(folder)
    dataset = Dataset.load(folder, loaded, outside=outside)
    sheet = draw_contact_sheet(dataset, rows=rows, columns=columns)
    target = out or folder / "contact_sheet.png"
    with whole_file(target) as temporary:
        sheet.save(temporary, format="PNG")
    classed = dataset.with_class()
    classes = Counter(classed.classes)
    shares = {name: classes[name] / max(1, len(classed)) for name in loaded.classes}
    determined = determined_share(classed.vectors, classed.classes) if len(classed) else None
    if json:
        print_json(
            {
                "contact_sheet": str(target),
                "domain": loaded.name,
                "scenes": len(dataset),
                "without_class": len(dataset) - len(classed),
                "classes": shares,
                "determined": determined,
            }
        )
        return
    remark(f"domain: {loaded.name}")
    if determined is None:
        say(f"{len(dataset)} pictures, none of them with a class")
    else:
        said = ", ".join(say_shares(loaded, shares, between=" "))
        without = len(dataset) - len(classed)
        more = f", and {without} without a class" if without else ""
        say(
            f"{len(classed)} pictures ({said}); {percent(determined)} determined by their "
            f"features{more}"
        )
    say(f"contact sheet: {target}")


app.command("import")(data_import.import_)
