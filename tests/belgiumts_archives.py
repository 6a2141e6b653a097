"""Archives of photographs in the official layout of BelgiumTS, made here."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from PIL import Image

HEADER = "Filename;Width;Height;Roi.X1;Roi.Y1;Roi.X2;Roi.Y2;ClassId\n"
Files = dict[str, bytes]


def picture(number: int, *, size: tuple[int, int] = (12, 10), kind: str = "PPM") -> bytes:
    """A picture of noise; width comes first in ``size``."""
    pixels = np.random.default_rng(number).integers(0, 256, (size[1], size[0], 3), dtype=np.uint8)
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, kind)
    return stream.getvalue()


def row(name: str, class_id: int, *, size: tuple[int, int] = (12, 10)) -> str:
    """A row as the official tables have it: rows where they say Width, columns for Height."""
    width, height = size
    return f"{name};{height};{width};2;1;{height - 2};{width - 1};{class_id}\n"


def half(folder: str, classes: Mapping[int, list[str]]) -> Files:
    """The files of a half: class → names of its pictures."""
    files: Files = {f"{folder}/Readme.txt": b"about the photographs"}
    number = 0
    for class_id, names in classes.items():
        home = f"{folder}/{class_id:05d}"
        files[f"{home}/GT-{class_id:05d}.csv"] = (
            HEADER + "".join(row(name, class_id) for name in names)
        ).encode()
        for name in names:
            files[f"{home}/{name}"] = picture(number)
            number += 1
    return files


def training() -> Files:
    """Two signs of class 0, one of class 1."""
    names = ["00010_00000.ppm", "00010_00001.ppm", "00020_00000.ppm"]
    return half("Training", {0: names, 1: ["00010_00000.ppm"]})


def other_half() -> Files:
    """One sign of class 0; class 1 has a table without rows."""
    return half("Testing", {0: ["00030_00000.ppm"], 1: []})


def pack(path: Path, files: Mapping[str, bytes]) -> Path:
    """Write files as a zip archive."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


def unpack(folder: Path, files: Mapping[str, bytes]) -> Path:
    """Write files to a folder."""
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    return folder
