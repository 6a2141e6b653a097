"""CVAT for images 1.1: one XML file with tags, boxes and their attributes."""

from __future__ import annotations

import posixpath
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from xml.etree.ElementTree import Element

from seewhy.data.importers.annotation import AnnotatedPicture, Box
from seewhy.data.importers.boxes import TURNED, around_turned
from seewhy.data.importers.picture_files import split_of
from seewhy.data.importers.source import Source, split_in_folders
from seewhy.data.importers.source_files import DamagedFileError
from seewhy.data.importers.tables import known
from seewhy.data.importers.xml_reading import as_number, elements, root_tag
from seewhy.errors import DatasetError

ROOT = "annotations"
_MANY = 1_000
_OUTLINES = ("polygon", "polyline", "points", "cuboid")


def cvat_files(source: Source) -> list[str]:
    """The XML files of a source that are CVAT's."""
    names = source.named(".xml")
    if len(names) > _MANY:  # a file a picture, as VOC has; CVAT has one
        names = [name for name in names if posixpath.basename(name).startswith(ROOT)]
    return [name for name in names if root_tag(source.files, name) == ROOT]


def read_cvat(source: Source) -> Iterator[AnnotatedPicture]:
    """Yield the pictures that CVAT's XML files describe.

    A tag is the picture's class where no picture has more than one; else each tag is a feature
    (yes or no). Attributes of tags are features, those of boxes stay with their box.

    Raises
    ------
    DatasetError
        If there is none, it is of a video, or it is no XML.
    """
    names = cvat_files(source)
    if not names and source.only is not None:
        next(elements(source.files, source.only), None)  # says where it is no XML
    if not names:
        raise source.nothing(
            "no CVAT annotation (annotations.xml); export the task as 'CVAT for images 1.1'"
        )
    tagged: list[tuple[AnnotatedPicture, tuple[str, ...]]] = []
    for name in names:
        finder = source.finder(
            beside=(posixpath.dirname(name), posixpath.join(posixpath.dirname(name), "images"))
        )
        for element in elements(source.files, name):
            if element.tag == "track":
                raise DatasetError(
                    f"{source.files.said(name)}: is of the format 'CVAT for video'; export the "
                    "task as 'CVAT for images 1.1'"
                )
            if element.tag != "image":
                continue
            subset = element.get("subset", "")
            written = element.get("name", "")
            if not written:
                raise DamagedFileError(
                    f"{source.files.said(name)}: image {element.get('id', '?')} has no name; "
                    "export the task again"
                )
            split = split_of(subset)
            file = (finder.find(f"{subset}/{written}", split=split) if subset else None) or (
                finder.find(written, split=split)
            )
            if file is None:
                source.miss(written, posixpath.basename(name))
                continue
            tagged.append(_picture(source, element, file, split or split_in_folders(file)))
    yield from _with_tags(tagged)


def _with_tags(
    tagged: list[tuple[AnnotatedPicture, tuple[str, ...]]],
) -> Iterator[AnnotatedPicture]:
    """Tags as the class, or as features where a picture may have several."""
    if all(len(tags) < 2 for _, tags in tagged):
        for picture, tags in tagged:
            yield replace(picture, class_name=tags[0] if tags else "")
        return
    every = list(dict.fromkeys(tag for _, tags in tagged for tag in tags))
    for picture, tags in tagged:
        said = {tag: "yes" if tag in tags else "no" for tag in every} if tags else {}
        yield replace(picture, features={**said, **picture.features})


def _picture(
    source: Source, image: Element, file: str, split: str
) -> tuple[AnnotatedPicture, tuple[str, ...]]:
    tags: list[str] = []
    features: dict[str, str] = {}
    boxes: list[Box] = []
    left_out: Counter[str] = Counter()
    for shape in image:
        label = (shape.get("label") or "").strip()
        attributes = _attributes(shape)
        if shape.tag == "tag":
            tags.append(label)
            features.update(attributes)
            continue
        corners = _corners(shape)
        if corners is None or not label:
            left_out[str(shape.tag)] += 1
            continue
        if as_number(shape.get("rotation", "0")):
            source.notes.add(TURNED, file)
        if shape.get("occluded") == "1":
            attributes.setdefault("occluded", "yes")
        boxes.append(Box(*corners, label, attributes))
    for tag, count in left_out.items():
        source.notes.add(
            f"shapes without a box that can be read ({tag}), left out", f"{count} in {file}"
        )
    width, height = as_number(image.get("width", "")), as_number(image.get("height", ""))
    picture = AnnotatedPicture(
        file=file,
        features=features,
        boxes=tuple(boxes),
        split=split,
        measured_in=(width, height) if width and height else None,
    )
    return picture, tuple(tags)


def _attributes(shape: Element) -> dict[str, str]:
    said: dict[str, str] = {}
    for attribute in shape.iterfind("attribute"):
        name, value = (attribute.get("name") or "").strip(), known(attribute.text or "")
        if name and value:
            said[name] = {"true": "yes", "false": "no"}.get(value.casefold(), value)
    return said


def _corners(shape: Element) -> tuple[float, float, float, float] | None:
    """Left, top, right and bottom around a shape."""
    if shape.tag in ("box", "mask", "ellipse"):
        names = {
            "box": ("xtl", "ytl", "xbr", "ybr"),
            "mask": ("left", "top", "width", "height"),
            "ellipse": ("cx", "cy", "rx", "ry"),
        }[str(shape.tag)]
        numbers = [as_number(shape.get(name, "")) for name in names]
        if None in numbers:
            return None
        first, second, third, fourth = (number or 0.0 for number in numbers)
        if shape.tag == "mask":
            return (first, second, first + third, second + fourth)
        corners = (first, second, third, fourth)
        if shape.tag == "ellipse":  # its centre and its radii
            corners = (first - third, second - fourth, first + third, second + fourth)
        return around_turned(corners, as_number(shape.get("rotation", "0")) or 0.0)
    if shape.tag in _OUTLINES:
        points = [point.split(",") for point in shape.get("points", "").split(";") if point]
        pairs = [(as_number(point[0]), as_number(point[1])) for point in points if len(point) == 2]
        across = [first for first, _ in pairs if first is not None]
        down = [second for _, second in pairs if second is not None]
        if len(across) > 1 and len(across) == len(down):
            return (min(across), min(down), max(across), max(down))
    return None
