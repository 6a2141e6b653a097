"""A domain of things on a desk, and scenes of it, for tests: drawn by lot."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

DOMAIN = """
[domain]
name = "desk"
title = "Things on a desk"
scene = "picture"
subject = "the picture"

[features.light]
name = "light"

[features.light.values]
bright = { say = "the light is bright" }
dim = { say = "the light is dim" }
dark = { say = "the light is off" }

[classes.good]
literal = "good(picture)"
say = "good"

[classes.bad]
literal = "-good(picture)"
say = "bad"

[things]
most = 5
one = "thing"

[things.features.colour]
[things.features.size]
ordered = true
[things.features.form.values]
box = { nouns = ["box"] }
ball = { nouns = ["ball"] }
[things.features.heavy.values]
yes = { say = "{it} is heavy", words = ["heavy"] }
no = { say = "{it} is light", words = ["light"] }

[things.relations.on]
measure = "seen"
say = "{0} is on {1}"
words = ["on"]
converse = "under"

[things.relations.under]
measure = "seen"
say = "{0} is under {1}"
words = ["under"]
converse = "on"

[things.relations.touches]
measure = "seen"
say = "{0} touches {1}"

[things.relations.above]
measure = "axioms"
say = "{0} is above {1}"
words = ["above"]

[things.conclusions.free]
say = "{it} is free"
deny = "{it} is not free"

[things.groups.row]
"""

KNOWLEDGE = """\
#sort picture.
#sort thing = things.
#sort hue = {red, blue, green}.
#sort extent = {small, large}.
#sort outline = {box, ball}.
#sort lit = {bright, dim, dark}.
#static light(picture, lit).
#static colour(thing, hue).
#static size(thing, extent).
#static form(thing, outline).
#static heavy(thing).
#static on(thing, thing).
#static under(thing, thing).
#static touches(thing, thing).
#static above(thing, thing).
#static free(thing).
#static row(thing, thing, thing).
#static good(picture).

above(X, Y) if on(X, Y).
above(X, Z) if on(X, Y), above(Y, Z).
free(X) if thing(X), #count { Y : on(Y, X) } = 0.
row(X, Y, Z) if touches(X, Y), touches(Y, Z), X != Z.
row(X, Y, Z) if row(Y, X, Z).
row(X, Y, Z) if row(X, Z, Y).
"""

VALUES = {
    "colour": ("red", "blue", "green"),
    "size": ("small", "large"),
    "form": ("box", "ball"),
    "heavy": ("yes", "no"),
}


@dataclass(frozen=True)
class Desk:
    """Things with their values, and the pairs of which the first is on, or touches, the second."""

    things: tuple[dict[str, str], ...]
    on: tuple[tuple[int, int], ...]
    touches: tuple[tuple[int, int], ...]


def write_domain(folder: Path) -> Path:
    """Write the domain's folder."""
    folder.mkdir(parents=True)
    (folder / "domain.toml").write_text(DOMAIN, encoding="utf-8")
    (folder / "knowledge.al").write_text(KNOWLEDGE, encoding="utf-8")
    (folder / "questions.toml").write_text("", encoding="utf-8")
    return folder


def random_desk(generator: np.random.Generator) -> Desk:
    """Draw lots for two to five things."""
    count = int(generator.integers(2, 6))
    things = tuple(
        {key: values[generator.integers(len(values))] for key, values in VALUES.items()}
        for _ in range(count)
    )
    on = tuple((n, int(generator.integers(n))) for n in range(1, count) if generator.random() < 0.5)
    pairs = [(a, b) for a in range(count) for b in range(count) if a != b]
    touches = tuple(pair for pair in pairs if generator.random() < 0.2)
    return Desk(things, on, touches)


def write_desks(
    folder: Path, good: Callable[[Desk], bool] | None, count: int, *, seed: int = 0
) -> Path:
    """Write a dataset of desks, each good or bad; of no class, where ``good`` is None."""
    generator = np.random.default_rng(seed)
    (folder / "images").mkdir(parents=True)
    scenes: list[Sequence[object]] = []
    things: list[Sequence[object]] = []
    relations: list[Sequence[object]] = []
    for number in range(count):
        name = f"images/{number:03}.png"
        pixels = generator.integers(0, 256, (8, 8, 3), dtype=np.uint8)
        Image.fromarray(pixels).save(folder / name)
        desk = random_desk(generator)
        scenes.append([name, "" if good is None else "good" if good(desk) else "bad"])
        things += [[name, n, *values.values()] for n, values in enumerate(desk.things, start=1)]
        for relation in ("on", "touches"):
            relations += [[name, relation, a + 1, b + 1] for a, b in getattr(desk, relation)]
    _write(folder / "scenes.csv", ["image", "class"], scenes)
    _write(folder / "things.csv", ["image", "thing", *VALUES], things)
    _write(folder / "relations.csv", ["image", "relation", "thing", "other"], relations)
    return folder


def _write(file: Path, header: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(header)
        writer.writerows(rows)
