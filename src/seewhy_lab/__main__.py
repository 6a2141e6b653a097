"""Run a measurement of the laboratory: ``python -m seewhy_lab NAME …``."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

COMMANDS = tuple(
    sorted(
        path.stem
        for path in (Path(__file__).parent / "commands").glob("*.py")
        if path.stem != "__init__"
    )
)


def main() -> None:
    """Run the command that is named first, with the arguments behind it."""
    name = sys.argv[1] if len(sys.argv) > 1 else "--help"
    if name in ("-h", "--help"):
        print("python -m seewhy_lab NAME …, and NAME --help for each:", *COMMANDS, sep="\n  ")
        return
    if name not in COMMANDS:
        sys.exit(f"'{name}' is no command of the laboratory; there are {', '.join(COMMANDS)}")
    sys.argv = [f"python -m seewhy_lab {name}", *sys.argv[2:]]
    runpy.run_module(f"seewhy_lab.commands.{name}", run_name="__main__")


if __name__ == "__main__":
    main()
