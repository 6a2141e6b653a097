"""A contact sheet: many pictures of a dataset with their annotation."""

from __future__ import annotations

from collections.abc import Callable

from PIL import Image, ImageDraw, ImageFont

from seewhy.data.dataset import Dataset
from seewhy.perception.picture import read_picture

_LINE = 13


def draw_contact_sheet(
    dataset: Dataset, *, columns: int = 8, rows: int = 5, size: int = 128
) -> Image.Image:
    """Draw scenes spread evenly over the dataset, class and feature values below each.

    Raises
    ------
    PictureError
        If a file is not a picture.
    """
    features = list(dataset.domain.features)
    number = min(columns * rows, len(dataset))
    chosen = [dataset.scenes[i * len(dataset) // number] for i in range(number)]
    columns = min(columns, number)
    below = _LINE * (1 + len(features)) + 8
    width, height = columns * (size + 8) + 8, -(-number // columns) * (size + below) + 8
    sheet = Image.new("RGB", (width, height), "white")
    draw = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(size=11)
    for position, scene in enumerate(chosen):
        x = 8 + position % columns * (size + 8)
        y = 8 + position // columns * (size + below)
        sheet.paste(Image.fromarray(read_picture(scene.picture, size=size)), (x, y))
        values = [
            f"{key.replace('_', ' ')}: {value or '?'}"
            for key, value in zip(features, scene.vector, strict=True)
        ]
        lines = [scene.label or "no class", *values]
        for number_of_line, line in enumerate(lines):
            fill = "#111111" if number_of_line == 0 else "#555555"
            text = _fitted(line, lambda shortened: draw.textlength(shortened, font=font) <= size)
            draw.text((x, y + size + 2 + number_of_line * _LINE), text, fill=fill, font=font)
    return sheet


def _fitted(line: str, fits: Callable[[str], bool]) -> str:
    """The line; else its value alone; else as much of that as fits.

    Examples
    --------
    >>> _fitted("second symbol: fence", lambda text: len(text) <= 9)
    'fence'
    >>> _fitted("second symbol: sixteen_and_thirtyone", lambda text: len(text) <= 9)
    'sixtee...'
    """
    if fits(line):
        return line
    value = line.rpartition(": ")[2]
    if fits(value):
        return value
    most = next((n for n in range(len(value), 0, -1) if fits(f"{value[:n]}...")), 0)
    return f"{value[:most]}..."
