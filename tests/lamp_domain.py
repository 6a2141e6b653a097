"""A planning domain of two lamps."""

from __future__ import annotations

from pathlib import Path

__all__ = ["write_lamps"]

LAMPS = """\
#sort lamp = {desk, door}.
#fluent basic lit(lamp).
#fluent basic broken(lamp).
#action press(lamp).
press(L) causes lit(L).
impossible press(L) if broken(L).
"""
PLANNING = """\
[planning]
name = "lamps"
title = "Lamps"

[things]
desk = "the desk lamp"
door = "the door lamp"

[fluents.lit]
say = "{0} is lit"
deny = "{0} is dark"

[fluents.broken]
say = "{0} is broken"
deny = "{0} is whole"

[actions.press]
do = "press {0}"
did = "pressed {0}"

[[sensing]]
literal = "lit(L)"
where = "lamp(L)"

[[sensing]]
literal = "broken(L)"
where = "lamp(L)"
"""


def write_lamps(folder: Path) -> Path:
    """Write the domain's folder."""
    folder.mkdir()
    (folder / "knowledge.al").write_text(LAMPS)
    (folder / "planning.toml").write_text(PLANNING)
    return folder
