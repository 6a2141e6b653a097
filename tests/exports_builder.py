"""Small pictures, and exports as labelling tools write them."""

from __future__ import annotations

import csv
import json
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from PIL import Image

from seewhy.data.importers import ImportedDataset, ImportRequest, import_pictures

COLOURS = {"red": (200, 30, 30), "green": (30, 160, 60), "blue": (40, 60, 200)}


def draw(
    path: Path, *, size: tuple[int, int] = (40, 20), colour: str = "red", orientation: int = 1
) -> Path:
    """Write a picture of one colour; its number of pixels tells it from others."""
    path.parent.mkdir(parents=True, exist_ok=True)
    exif = Image.Exif()
    exif[0x0112] = orientation
    options = {"exif": exif} if orientation != 1 else {}
    Image.new("RGB", size, COLOURS.get(colour, colour)).save(path, **options)
    return path


def draw_all(folder: Path, names: Iterable[str]) -> Path:
    for name in names:
        draw(folder / name)
    return folder


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def write_json(path: Path, value: object) -> Path:
    return write(path, json.dumps(value))


def pack(folder: Path, archive: Path) -> Path:
    """Zip the content of a folder."""
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as target:
        for path in sorted(folder.rglob("*")):
            if path.is_file():
                target.write(path, path.relative_to(folder).as_posix())
    return archive


def imported(
    source: Path, format: str, folder: Path, **options: Any
) -> tuple[ImportedDataset, list[dict[str, str]]]:
    """Import, and return the rows of scenes.csv."""
    dataset = import_pictures(ImportRequest(source, format, **options), folder)
    return dataset, rows_of(folder / "scenes.csv")


def rows_of(table: Path) -> list[dict[str, str]]:
    with table.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def notes_of(dataset: ImportedDataset) -> dict[str, tuple[str, ...]]:
    return {note.text: note.places for note in dataset.notes}


def coco(
    images: Sequence[Mapping[str, Any]],
    annotations: Sequence[Mapping[str, Any]],
    categories: Sequence[str] = ("cat", "dog"),
) -> dict[str, Any]:
    """A COCO file; what is left out of images and annotations is filled in."""
    return {
        "info": {"description": "made for tests", "year": 2026},
        "licenses": [{"id": 1, "name": "none"}],
        "images": [{"width": 40, "height": 20, "license": 1, **image} for image in images],
        "annotations": [
            {"id": number, "iscrowd": 0, "area": 1.0, **annotation}
            for number, annotation in enumerate(annotations, start=1)
        ],
        "categories": [
            {"id": number, "name": name, "supercategory": "animal"}
            for number, name in enumerate(categories, start=1)
        ],
    }


def voc(
    filename: str, objects: str = "", *, size: tuple[int, int] = (40, 20), folder: str = "VOC2012"
) -> str:
    return (
        f"<annotation>\n<folder>{folder}</folder>\n<filename>{filename}</filename>\n"
        f"<size><width>{size[0]}</width><height>{size[1]}</height><depth>3</depth></size>\n"
        f"<segmented>0</segmented>\n{objects}</annotation>\n"
    )


def voc_object(kind: str, box: tuple[int, int, int, int], more: str = "") -> str:
    left, top, right, bottom = box
    return (
        f"<object><name>{kind}</name><pose>Unspecified</pose><truncated>0</truncated>"
        f"<difficult>1</difficult><bndbox><xmin>{left}</xmin><ymin>{top}</ymin>"
        f"<xmax>{right}</xmax><ymax>{bottom}</ymax></bndbox>{more}</object>\n"
    )


def task(
    number: int, image: str, results: Sequence[Mapping[str, Any]] | None, **annotation: Any
) -> dict[str, Any]:
    """A task of Label Studio as its export as JSON has it."""
    annotations = (
        []
        if results is None
        else [
            {
                "id": 100 + number,
                "completed_by": 1,
                "result": list(results),
                "was_cancelled": False,
                "ground_truth": False,
                "created_at": "2026-03-01T10:00:00.000000Z",
                "updated_at": "2026-03-01T10:00:05.000000Z",
                "lead_time": 4.2,
                "prediction": {},
                "result_count": len(results),
                "task": number,
                **annotation,
            }
        ]
    )
    return {
        "id": number,
        "annotations": annotations,
        "file_upload": image.rpartition("/")[2],
        "drafts": [],
        "predictions": [],
        "data": {"image": image},
        "meta": {},
        "created_at": "2026-03-01T09:00:00.000000Z",
        "updated_at": "2026-03-01T10:00:05.000000Z",
        "inner_id": number,
        "total_annotations": len(annotations),
        "project": 7,
    }


def choice(control: str, *choices: str, region: str = "") -> dict[str, Any]:
    return {
        "value": {"choices": list(choices)},
        "id": region or f"c_{control}",
        "from_name": control,
        "to_name": "image",
        "type": "choices",
        "origin": "manual",
    }


def rectangle(
    kind: str, box: tuple[float, float, float, float], *, region: str, rotation: float = 0
) -> dict[str, Any]:
    x, y, width, height = box
    return {
        "original_width": 40,
        "original_height": 20,
        "image_rotation": 0,
        "value": {
            "x": x,
            "y": y,
            "width": width,
            "height": height,
            "rotation": rotation,
            "rectanglelabels": [kind],
        },
        "id": region,
        "from_name": "box",
        "to_name": "image",
        "type": "rectanglelabels",
        "origin": "manual",
    }


def cvat(images: str) -> str:
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n<annotations>\n  <version>1.1</version>\n'
        "  <meta><task><id>5</id><name>made for tests</name><mode>annotation</mode>"
        "<labels><label><name>cat</name><type>any</type><attributes/></label></labels></task>"
        f"</meta>\n{images}</annotations>\n"
    )
