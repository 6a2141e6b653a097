"""Pascal VOC: an XML file a picture, and lists of pictures for the splits."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from xml.etree.ElementTree import Element

from seewhy.data.importers.annotation import AnnotatedPicture, Box
from seewhy.data.importers.picture_files import ENDINGS, PictureFinder, split_of
from seewhy.data.importers.source import UNREADABLE, Source, split_in_folders
from seewhy.data.importers.source_files import DamagedFileError, read_text_file
from seewhy.data.importers.tables import known
from seewhy.data.importers.xml_reading import number_of, read_document, root_tag, text_of

ROOT = "annotation"
_FLAGS = ("truncated", "difficult", "occluded")


def voc_files(source: Source) -> list[str]:
    """The XML files of a source that may be VOC: those in a folder Annotations, or all."""
    names = source.named(".xml")
    inside = [name for name in names if "annotations/" in f"{posixpath.dirname(name)}/".casefold()]
    return list(inside or names)


def is_voc(source: Source) -> bool:
    """Whether a source is VOC by the first of its XML files."""
    return any(root_tag(source.files, name) == ROOT for name in voc_files(source)[:5])


def read_voc(source: Source) -> Iterator[AnnotatedPicture]:
    """Yield the pictures that the XML files of a source describe.

    VOC counts pixels from 1 and means the last pixel inside; boxes are converted.

    Raises
    ------
    DatasetError
        If there is none, or most of them cannot be read.
    """
    names = voc_files(source)
    if not names:
        raise source.nothing(
            "no VOC annotation (XML files with <annotation>); name the folder that holds "
            "Annotations and JPEGImages"
        )
    splits = _splits(source)
    finder = source.finder()
    damaged = 0
    for name in names:
        try:
            root = read_document(source.files, name)
            if root.tag != ROOT:
                raise DamagedFileError(
                    f"{source.files.said(name)}: is no VOC annotation, it begins with <{root.tag}>"
                )
            picture = _picture(source, name, root, finder, splits)
        except DamagedFileError as problem:
            damaged += 1
            if 2 * damaged > len(names):
                raise
            source.notes.add(UNREADABLE, str(problem))
            continue
        if picture is not None:
            yield picture


def _picture(
    source: Source, name: str, root: Element, finder: PictureFinder, splits: dict[str, str]
) -> AnnotatedPicture | None:
    stem = posixpath.splitext(posixpath.basename(name))[0]
    written = text_of(root, "filename") or stem
    split = splits.get(stem, "") or split_in_folders(name)
    file = _find(written, stem, name, finder, split)
    if file is None:
        source.miss(written, name)
        return None
    width, height = number_of(root, "size/width"), number_of(root, "size/height")
    boxes = []
    for number, thing in enumerate(root.iterfind("object"), start=1):
        box = _box(thing)
        if box is None:
            source.notes.add(
                "things without a name or a box, left out",
                f"{source.files.said(name)}: object {number}",
            )
        else:
            boxes.append(box)
    return AnnotatedPicture(
        file=file,
        boxes=tuple(boxes),
        split=split or split_in_folders(file),
        measured_in=(width, height) if width and height else None,
    )


def _find(written: str, stem: str, name: str, finder: PictureFinder, split: str) -> str | None:
    """The picture of an XML file: the one that it names, or the one called as it is."""
    folder = posixpath.dirname(name)
    places = [
        posixpath.normpath(posixpath.join(folder, "..", "JPEGImages")),
        posixpath.normpath(posixpath.join(folder, "..", "images")),
        folder,
    ]
    called = [written, *(f"{stem}{ending}" for ending in ENDINGS)]
    for place in places:
        for candidate in called:
            path = posixpath.normpath(posixpath.join(place, candidate))
            if finder.has(path):
                return path
    return next(
        (found for candidate in called if (found := finder.find(candidate, split=split))), None
    )


def _box(thing: Element) -> Box | None:
    kind = text_of(thing, "name")
    left, top = number_of(thing, "bndbox/xmin"), number_of(thing, "bndbox/ymin")
    right, bottom = number_of(thing, "bndbox/xmax"), number_of(thing, "bndbox/ymax")
    if not kind or left is None or top is None or right is None or bottom is None:
        return None
    attributes: dict[str, str] = {}
    for flag in _FLAGS:
        said = text_of(thing, flag)
        if said:
            attributes[flag] = "yes" if said in ("1", "true", "True") else "no"
    pose = known(text_of(thing, "pose"))
    if pose and pose.casefold() not in ("unspecified", "unknown"):
        attributes["pose"] = pose
    for attribute in thing.iterfind("attributes/attribute"):
        key, value = text_of(attribute, "name"), known(text_of(attribute, "value"))
        if key and value:
            attributes[key] = value
    return Box(left - 1, top - 1, right, bottom, kind, attributes)


def _splits(source: Source) -> dict[str, str]:
    """Picture → its split, by the lists in ImageSets."""
    splits: dict[str, str] = {}
    if source.only is not None:
        return splits
    for name in source.files.names:
        parts = name.casefold().split("/")
        if "imagesets" not in parts or not name.casefold().endswith(".txt"):
            continue
        stem = posixpath.splitext(parts[-1])[0]
        split = split_of(stem)
        if not split:
            continue
        for line in read_text_file(source.files, name).splitlines():
            words = line.split()
            if words and (stem != "trainval" or words[0] not in splits):
                # "trainval" is both: where another list says which, that list is right.
                splits[words[0]] = split
    return splits
