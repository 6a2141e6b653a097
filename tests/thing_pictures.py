"""A small project with things for the studio: a domain, and pictures that are drawn."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

__all__ = ["DOMAIN", "KNOWLEDGE", "piles"]

DOMAIN = """\
[domain]
name = "piles"
title = "Blocks on blocks"
scene = "picture"
subject = "the pile"

[features.light]
name = "light"

[features.light.values]
yes = { say = "{it} is well lit" }
no = { say = "{it} is dark" }

[things]
sort = "block"
most = 4
one = "block"

[things.features.colour]
[things.features.round]

[things.relations.left]
measure = "left"
say = "{0} is left of {1}"

[things.relations.on]
measure = "seen"
say = "{0} is on {1}"
converse = "under"

[things.relations.under]
measure = "seen"
say = "{0} is under {1}"
converse = "on"

[things.relations.above]
measure = "axioms"
say = "{0} is above {1}"

[classes.stable]
literal = "stable(picture)"
say = "stable"

[classes.unstable]
literal = "-stable(picture)"
say = "unstable"
"""

KNOWLEDGE = """\
#sort picture.
#sort block = things.
#sort hue = {red, green}.
#static light(picture).
#static colour(block, hue).
#static round(block).
#static left(block, block).
#static on(block, block).
#static under(block, block).
#static above(block, block).
#static falls(block).
#static stable(picture).
above(X, Y) if on(X, Y).
falls(X) if on(X, Y), round(Y).
-stable(P) if picture(P), falls(X).
stable(P) if picture(P), not -stable(P), block(X).
"""


def piles(folder: Path, count: int = 3) -> Path:
    """Write a project's folder: a domain, and pictures a.png, b.png, … of 200 × 100 pixels."""
    domain = folder / "piles"
    domain.mkdir(parents=True)
    (domain / "domain.toml").write_text(DOMAIN)
    (domain / "knowledge.al").write_text(KNOWLEDGE)
    (domain / "questions.toml").write_text("")
    for number in range(count):
        picture = Image.new("RGB", (200, 100), (230, 230, 230))
        picture.paste((200, 30, 30), (20, 50 - 10 * number, 60, 90))
        picture.paste((30, 160, 60), (100, 40, 150, 90))
        picture.save(folder / f"{chr(97 + number)}.png")
    return folder
