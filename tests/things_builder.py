"""Pictures of coloured shapes on a plain table, with boxes, for tests: drawn, not photographed."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

DOMAIN = """
[domain]
name = "shelf"
title = "Shapes on a shelf"
scene = "picture"
subject = "the picture"

[features.light]
name = "light"

[features.light.values]
bright = { say = "the light is on" }
dark = { say = "the light is off" }

[classes.tidy]
literal = "tidy(P)"
say = "tidy"

[classes.untidy]
literal = "untidy(P)"
say = "untidy"

[things]
most = 5
one = "shape"

[things.features.colour.values]
red = {}
blue = {}

[things.features.form.values]
box = { nouns = ["box"] }
ball = { nouns = ["ball"] }

[things.features.size]
ordered = true

[things.relations.left]
measure = "left"
say = "{0} is left of {1}"
words = ["left of"]
most = ["leftmost"]
converse = "right"

[things.relations.right]
measure = "right"
say = "{0} is right of {1}"
words = ["right of"]
most = ["rightmost"]
converse = "left"

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
"""

KNOWLEDGE = """
#sort picture.
#sort thing = things.
#sort lit = {bright, dark}.
#sort hue = {red, blue}.
#sort outline = {box, ball}.
#sort extent = {small, large}.
#static light(picture, lit).
#static colour(thing, hue).
#static form(thing, outline).
#static size(thing, extent).
#static left(thing, thing).
#static right(thing, thing).
#static on(thing, thing).
#static under(thing, thing).
#static tidy(picture).
#static untidy(picture).

%% nothing lies on a ball
-on(X, Y) if thing(X), form(Y, ball).
%% the picture is untidy where a ball lies on something
untidy(P) if picture(P), form(X, ball), on(X, Y).
-tidy(P) if untidy(P).
"""

COLOURS = {"red": (200, 40, 40), "blue": (40, 60, 200)}
SIDES = {"small": 14, "large": 26}

Row = tuple[str, str, str, tuple[float, float, float, float]]


def write_domain(folder: Path) -> Path:
    """Write the domain's folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "domain.toml").write_text(DOMAIN, encoding="utf-8")
    (folder / "knowledge.al").write_text(KNOWLEDGE, encoding="utf-8")
    (folder / "questions.toml").write_text("", encoding="utf-8")
    return folder


def draw_shapes(things: Sequence[Row], *, seed: int = 0, dark: bool = False) -> Image.Image:
    """Draw shapes where their boxes are."""
    generator = np.random.default_rng(seed)
    level = 90 if dark else 200
    noise = generator.normal(level, 5, (120, 160, 3)).clip(0, 255).astype(np.uint8)
    image = Image.fromarray(noise)
    pen = ImageDraw.Draw(image)
    for colour, form, _, box in things:
        draw = pen.rectangle if form == "box" else pen.ellipse
        draw(box, fill=COLOURS[colour])
    return image


def random_things(
    generator: np.random.Generator, most: int = 4
) -> tuple[list[Row], list[tuple[int, int]]]:
    """Draw lots for things side by side, of which some carry another."""
    things: list[Row] = []
    on: list[tuple[int, int]] = []
    across = 4.0
    while len(things) < most and across < 130:
        colour, form, size = _lots(generator)
        side = SIDES[size]
        across += float(generator.uniform(2, 24))
        if across + side > 158:
            break
        down = float(generator.uniform(78, 112 - side * 0.2))
        things.append((colour, form, size, (across, down - side, across + side, down)))
        if form == "box" and generator.random() < 0.4 and len(things) < most:
            other, shape, extent = _lots(generator)
            wide = SIDES[extent]
            middle, top = across + side / 2, down - side
            on.append((len(things), len(things) - 1))
            things.append(
                (other, shape, extent, (middle - wide / 2, top - wide, middle + wide / 2, top))
            )
            across = max(across, middle + wide / 2 - side)
        across += side
    return things, on


def _lots(generator: np.random.Generator) -> tuple[str, str, str]:
    return (
        ("red", "blue")[generator.integers(2)],
        ("box", "ball")[generator.integers(2)],
        ("small", "large")[generator.integers(2)],
    )


def write_shelf(folder: Path, count: int, *, seed: int = 0) -> Path:
    """Write a dataset: scenes.csv, things.csv, relations.csv, images."""
    generator = np.random.default_rng(seed)
    (folder / "images").mkdir(parents=True, exist_ok=True)
    scenes, rows, relations = [], [], []
    for number in range(count):
        name = f"images/{number:03}.png"
        things, on = random_things(generator)
        dark = bool(generator.integers(2))
        draw_shapes(things, seed=number, dark=dark).save(folder / name)
        untidy = any(things[one][1] == "ball" for one, _ in on)
        split = "test" if number % 4 == 3 else "train"
        scenes.append([name, "untidy" if untidy else "tidy", "dark" if dark else "bright", split])
        for at, (colour, form, size, box) in enumerate(things, start=1):
            rows.append([name, at, *(round(corner, 1) for corner in box), colour, form, size])
        relations += [[name, "on", one + 1, other + 1] for one, other in on]
    _write(folder / "scenes.csv", ["image", "class", "light", "split"], scenes)
    header = ["image", "thing", "left", "top", "right", "bottom", "colour", "form", "size"]
    _write(folder / "things.csv", header, rows)
    _write(folder / "relations.csv", ["image", "relation", "thing", "other"], relations)
    return folder


def _write(file: Path, header: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(header)
        writer.writerows(rows)
