"""COCO: JSON with images, annotations and categories."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from seewhy.data.importers.annotation import AnnotatedPicture, Box
from seewhy.data.importers.json_reading import checked, json_items, json_outline
from seewhy.data.importers.source import Source, split_in_folders, split_in_name
from seewhy.data.importers.source_files import SourceFiles
from seewhy.data.importers.tables import known
from seewhy.errors import DatasetError

Identifier = int | Annotated[str, Field(max_length=200)]
Pixels = Annotated[float, Field(ge=-1e7, le=1e7, allow_inf_nan=False)]
Side = Annotated[float, Field(gt=0, le=1e6, allow_inf_nan=False)]

_CROWD = "crowd"


class _Image(BaseModel):
    model_config = ConfigDict(extra="ignore")

    id: Identifier
    file_name: str = Field(min_length=1, max_length=4096)
    width: Side | None = None
    height: Side | None = None


class _Category(BaseModel):
    model_config = ConfigDict(extra="ignore")

    id: Identifier
    name: str = Field(min_length=1, max_length=500)


class _Annotation(BaseModel):
    model_config = ConfigDict(extra="ignore")

    image_id: Identifier
    category_id: Identifier
    bbox: list[Pixels] | None = Field(default=None, max_length=4)
    segmentation: Any = None
    iscrowd: int = Field(default=0, ge=0, le=1)
    attributes: dict[str, Any] = Field(default_factory=dict, max_length=200)


@dataclass
class _File:
    """What one JSON file says."""

    images: dict[Identifier, _Image] = field(default_factory=dict)
    categories: dict[Identifier, str] = field(default_factory=dict)
    boxes: dict[Identifier, list[tuple[Identifier, Box]]] = field(default_factory=dict)
    labels: dict[Identifier, set[Identifier]] = field(default_factory=dict)


def is_coco(files: SourceFiles, name: str) -> bool:
    """Whether a JSON file is COCO by its first items."""
    outline = json_outline(files, name)
    image, annotation = outline.get("images"), outline.get("annotations")
    return (isinstance(image, dict) and "file_name" in image) or (
        isinstance(annotation, dict) and "image_id" in annotation
    )


def coco_files(source: Source) -> list[str]:
    """The COCO files of a source; of those that COCO itself publishes, the instances."""
    found = [name for name in source.named(".json") if is_coco(source.files, name)]
    instances = [name for name in found if posixpath.basename(name).startswith("instances_")]
    return instances or found


def read_coco(source: Source) -> Iterator[AnnotatedPicture]:
    """Yield the pictures of all COCO files of a source.

    Masks and polygons are kept as the box around them. Annotations that have no place in the
    picture say its class.

    Raises
    ------
    DatasetError
        If there is none, or what stands in one is not COCO.
    """
    names = coco_files(source)
    if source.only is not None and not names:
        _read_file(source, source.only)  # says where it is no JSON
    if not names:
        raise source.nothing(
            "no COCO file (JSON with 'images', 'annotations' and 'categories'); name the file "
            "that the tool exported"
        )
    for name in names:
        yield from _pictures(source, name)


def _pictures(source: Source, name: str) -> Iterator[AnnotatedPicture]:
    content = _read_file(source, name)
    split = split_in_name(name)
    finder = source.finder(beside=(posixpath.dirname(name),))
    kinds = content.categories
    for identifier, image in content.images.items():
        file = finder.find(image.file_name, split=split)
        if file is None:
            source.miss(image.file_name, posixpath.basename(name))
            continue
        boxes = []
        for category, box in content.boxes.get(identifier, ()):
            if category in kinds:
                boxes.append(
                    Box(box.left, box.top, box.right, box.bottom, kinds[category], box.attributes)
                )
            else:
                source.notes.add(
                    "annotations of a category that the file does not list, left out",
                    f"{source.files.said(name)}: category_id {category}",
                )
        labels = {kinds[key] for key in content.labels.get(identifier, ()) if key in kinds}
        if len(labels) > 1:
            source.notes.add("pictures that are labelled as several classes, left without", file)
        yield AnnotatedPicture(
            file=file,
            class_name=labels.pop() if len(labels) == 1 else "",
            boxes=tuple(boxes),
            split=split or split_in_folders(file),
            measured_in=(image.width, image.height) if image.width and image.height else None,
        )


def _read_file(source: Source, name: str) -> _File:
    content = _File()
    said = source.files.said(name)
    unlisted = 0
    for key, position, item in json_items(source.files, name):
        place = f"{said}: {key}[{position}]"
        if key == "images":
            image = checked(_Image, item, place)
            if image.id in content.images:
                source.notes.add("images with the id of another, left out", place)
                continue
            content.images[image.id] = image
        elif key == "categories":
            category = checked(_Category, item, place)
            content.categories[category.id] = category.name
        elif key == "annotations":
            if isinstance(item, dict) and "caption" in item:
                source.notes.add("captions, left out", None)
                continue
            _add(content, checked(_Annotation, item, place), source, place)
    if not content.images:
        raise DatasetError(
            f"{said}: is no COCO file, it lists no images; name the file that the tool exported"
        )
    for identifier in content.boxes.keys() - content.images.keys():
        unlisted += len(content.boxes[identifier])
    if unlisted:
        source.notes.add(
            "annotations of images that their file does not list, left out",
            f"{said}: {unlisted} of them",
        )
    return content


def _add(content: _File, found: _Annotation, source: Source, place: str) -> None:
    """Keep an annotation as a box, or as the label of its picture."""
    corners = _corners(found)
    if corners is None and (found.segmentation or found.bbox):
        source.notes.add("annotations whose box cannot be read, left out", place)
        return
    if corners is None:
        content.labels.setdefault(found.image_id, set()).add(found.category_id)
        return
    attributes = {
        key: known(value)
        for key, value in found.attributes.items()
        if isinstance(value, str | int | float | bool)
    }
    if found.iscrowd:
        attributes[_CROWD] = "yes"
    box = Box(*corners, kind="", attributes=attributes)
    content.boxes.setdefault(found.image_id, []).append((found.category_id, box))


def _corners(found: _Annotation) -> tuple[float, float, float, float] | None:
    """Left, top, right and bottom of an annotation: of its box, or of its polygons."""
    if found.bbox is not None and len(found.bbox) == 4:
        left, top, width, height = found.bbox
        if width or height or not found.segmentation:
            return None if not (width or height or left or top) else (
                left, top, left + width, top + height
            )  # fmt: skip
    polygons = found.segmentation
    if not isinstance(polygons, list) or not polygons:
        return None
    numbers = [
        number
        for polygon in polygons
        if isinstance(polygon, list)
        for number in polygon
        if isinstance(number, int | float)
    ]
    across, down = numbers[::2], numbers[1::2]
    if len(across) < 2 or len(across) != len(down):
        return None
    return (min(across), min(down), max(across), max(down))
