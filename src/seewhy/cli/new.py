"""`seewhy new`: write a working domain folder to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from seewhy.cli.options import Json
from seewhy.cli.screen import print_json, say


def new(
    name: Annotated[
        str,
        typer.Argument(metavar="NAME", help="The folder to write; its last part names the domain."),
    ],
    json: Json = False,
) -> None:
    """Write a working domain folder: features, axioms, questions, and a README."""
    from seewhy.new_domain import write_new_domain

    folder = write_new_domain(Path(name))
    if json:
        print_json({"folder": str(folder), "files": sorted(p.name for p in folder.iterdir())})
        return
    say(f"{folder} holds a working domain; its README.md says how to make it yours.")
    say(f"  seewhy check {folder}")
