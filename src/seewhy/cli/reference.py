"""`seewhy reference`: every key of a domain's files."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from seewhy.cli.options import Json
from seewhy.cli.screen import print_json, say


def reference(
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FILE", help="Write it to this file instead."),
    ] = None,
    json: Json = False,
) -> None:
    """Say what may stand in a domain's files: each key, its range, its default, its meaning."""
    from seewhy.files.whole_files import write_whole
    from seewhy.report.key_reference import reference_dict, reference_page

    if out is not None:
        write_whole(out, reference_page())
        if not json:
            say(f"written: {out}")
            return
    if json:
        print_json(reference_dict())
        return
    # As it is: rich would break its lines to the width of the screen.
    sys.stdout.write(reference_page())
