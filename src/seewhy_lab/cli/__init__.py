"""Commands of the laboratory, which `seewhy` has where the laboratory is there."""

from __future__ import annotations

import typer

from seewhy_lab.cli import belgiumts
from seewhy_lab.cli.experiment import experiment

__all__ = ["add_commands"]


def add_commands(app: typer.Typer) -> None:
    """Add the commands to those of ``seewhy``."""
    app.command("experiment")(experiment)
    app.add_typer(belgiumts.app, name="belgiumts", help="Photographs of Belgian traffic signs.")
