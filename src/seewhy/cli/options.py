"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

DomainName = Annotated[
    str, typer.Argument(metavar="DOMAIN", help="A bundled domain's name or a domain folder.")
]
ModelFolder = Annotated[
    Path, typer.Argument(metavar="MODEL", help="A model folder, made by 'seewhy train'.")
]
ImageFile = Annotated[Path, typer.Argument(metavar="IMAGE", help="A picture file.")]
DataFolder = Annotated[
    Path, typer.Option("--data", help="A dataset folder: pictures and scenes.csv.")
]
Json = Annotated[bool, typer.Option("--json", help="Print the result as JSON.")]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Settles every random choice.")]
