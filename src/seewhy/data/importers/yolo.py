"""YOLO: a text file of boxes beside each picture, and data.yaml with names and splits."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, field_validator

from seewhy.data.importers.annotation import AnnotatedPicture, Box
from seewhy.data.importers.class_folders import read_class_folders
from seewhy.data.importers.json_reading import checked
from seewhy.data.importers.picture_files import SPLITS, is_picture_name
from seewhy.data.importers.source import Source, split_in_folders
from seewhy.data.importers.source_files import DamagedFileError, read_text_file
from seewhy.data.importers.xml_reading import as_number
from seewhy.errors import DatasetError

_YAML = (".yaml", ".yml")
_NAMES = ("classes.txt", "obj.names", "_darknet.labels", "class_names.txt", "labels.txt")
_SPLIT_KEYS = ("train", "val", "valid", "validation", "test")
_MOST_CLASSES = 100_000


class _Names(BaseModel):
    model_config = ConfigDict(extra="ignore")

    names: dict[int, str] = Field(max_length=_MOST_CLASSES)

    @field_validator("names", mode="before")
    @classmethod
    def _numbered(cls, value: object) -> object:
        if not value:
            raise ValueError("must name at least one class")
        if isinstance(value, list):
            return {number: str(name) for number, name in enumerate(value)}
        if isinstance(value, dict):
            return {number: str(name) for number, name in value.items()}
        return value


@dataclass(frozen=True)
class _Layout:
    """What data.yaml or its older kin say."""

    names: Mapping[int, str]
    splits: Mapping[str, Sequence[str]]
    said: str


def yolo_files(source: Source) -> list[str]:
    """The files of a source by which it is YOLO: a YAML file with names, or a list of names."""
    tables = [name for name in source.named(*_YAML) if _has_names(source, name)]
    if tables or source.only is not None:
        return tables
    lists = [name for name in source.files.names if posixpath.basename(name).casefold() in _NAMES]
    return lists if lists and _labelled(source) else []


def read_yolo(source: Source) -> Iterator[AnnotatedPicture]:
    """Yield the pictures of a YOLO dataset: of detection, segmentation (boxes) or classes.

    Raises
    ------
    DatasetError
        If there is no list of names, or a label file is none.
    """
    found = yolo_files(source)
    labelled = _labelled(source)
    broken = [name for name in source.named(*_YAML) if name not in found]
    if not found and broken and (source.only is not None or labelled):
        checked(_Names, _read_yaml(source, broken[0]), f"{source.files.said(broken[0])}: ")
    if not labelled:
        yield from read_class_folders(source)
        return
    if not found:
        raise source.nothing(
            "no data.yaml and no classes.txt beside the labels; one of them says which class each "
            "number stands for"
        )
    layout = _layout(source, found)
    labels = _texts(source)
    for picture in _pictures(source):
        label = labelled.get(picture)
        yield AnnotatedPicture(
            file=picture,
            boxes=tuple(_boxes(source, label, layout)) if label else (),
            split=_split(picture, layout),
            measured_in=(1, 1),
        )
    for label in sorted(labels - set(labelled.values())):
        if "labels" in posixpath.dirname(label).split("/"):
            source.miss(label, "a label file without its picture")


def _pictures(source: Source) -> list[str]:
    return [name for name in source.pictures.names if is_picture_name(name)]


def _texts(source: Source) -> set[str]:
    return {name for name in source.files.names if name.casefold().endswith(".txt")}


def _labelled(source: Source) -> dict[str, str]:
    """Picture → its label file, for those that have one."""
    texts = _texts(source)
    return {
        picture: label
        for picture in _pictures(source)
        if (label := _label_file(picture, texts)) is not None
    }


def _has_names(source: Source, name: str) -> bool:
    try:
        return "names" in _read_yaml(source, name)
    except DatasetError:
        return False


def _read_yaml(source: Source, name: str) -> dict[str, Any]:
    import yaml

    said = source.files.said(name)
    text = read_text_file(source.files, name)
    try:
        # Anchors that name each other can blow up a short text; a list of names needs none.
        has_aliases = any(isinstance(token, yaml.AliasToken) for token in yaml.scan(text))
        content = None if has_aliases else yaml.safe_load(text)
    except yaml.MarkedYAMLError as problem:
        mark = problem.problem_mark
        where = f":{mark.line + 1}:{mark.column + 1}" if mark is not None else ""
        raise DamagedFileError(
            f"{said}{where}: is no valid YAML ({problem.problem}); correct the line"
        ) from None
    except (yaml.YAMLError, ValueError, RecursionError) as problem:
        what = " ".join(str(problem).split())
        raise DamagedFileError(f"{said}: is no valid YAML ({what}); correct it") from None
    if has_aliases:
        raise DamagedFileError(
            f"{said}: has references (*name), which are not read; write what they stand for"
        )
    if not isinstance(content, dict):
        raise DamagedFileError(
            f"{said}: must name the classes (names: [cat, dog]), got {type(content).__name__}"
        )
    return content


def _layout(source: Source, found: Sequence[str]) -> _Layout:
    name = found[0]
    if len(found) > 1:
        source.notes.add(f"lists of names beside {name}, not read", ", ".join(found[1:]))
    if not name.casefold().endswith(_YAML):
        lines = read_text_file(source.files, name).splitlines()
        names = {number: line.strip() for number, line in enumerate(lines) if line.strip()}
        return _Layout(names, {}, source.files.said(name))
    content = _read_yaml(source, name)
    names = checked(_Names, content, f"{source.files.said(name)}: ").names
    home = posixpath.dirname(name)
    splits: dict[str, list[str]] = {}
    for key in _SPLIT_KEYS:
        value = content.get(key)
        for path in value if isinstance(value, list) else [value]:
            if isinstance(path, str) and path.strip():
                splits.setdefault(SPLITS[key], []).extend(
                    _listed(source, path.strip(), home, str(content.get("path") or ""))
                )
    return _Layout(names, splits, source.files.said(name))


def _listed(source: Source, path: str, home: str, root: str) -> list[str]:
    """What an entry of data.yaml names: a folder, or the pictures in a list of them."""
    plain = path.replace("\\", "/")
    while plain.startswith(("./", "../", "/")):
        plain = plain.partition("/")[2]
    folders = [posixpath.normpath(posixpath.join(home, plain))]
    folders.append(posixpath.normpath(posixpath.join(home, root.strip("/"), plain)))
    folders.append(plain.rstrip("/"))
    if plain.casefold().endswith(".txt"):
        listed = next((name for name in folders if source.files.has(name)), None)
        if listed is None:
            return []
        finder = source.finder(beside=(home, posixpath.dirname(listed)))
        lines = read_text_file(source.files, listed).splitlines()
        return [file for line in lines if line.strip() and (file := finder.find(line.strip()))]
    return [f"{folder}/" for folder in dict.fromkeys(folders)]


def _split(picture: str, layout: _Layout) -> str:
    for split, places in layout.splits.items():
        for place in places:
            if picture == place or (place.endswith("/") and picture.startswith(place)):
                return split
    return split_in_folders(picture)


def _label_file(picture: str, labels: set[str]) -> str | None:
    """The label file of a picture: in labels where it is in images, or beside it."""
    stem = posixpath.splitext(picture)[0]
    parts = stem.split("/")
    for position in reversed(range(len(parts) - 1)):
        if parts[position] == "images":
            swapped = "/".join([*parts[:position], "labels", *parts[position + 1 :]]) + ".txt"
            if swapped in labels:
                return swapped
    beside = f"{stem}.txt"
    return beside if beside in labels else None


def _boxes(source: Source, name: str, layout: _Layout) -> Iterator[Box]:
    said = source.files.said(name)
    for number, line in enumerate(read_text_file(source.files, name).splitlines(), start=1):
        words = line.split()
        if not words:
            continue
        numbers = [as_number(word) for word in words]
        kind = numbers[0]
        if kind is None or None in numbers or len(words) < 5 or kind != int(kind):
            raise DamagedFileError(
                f"{said}:{number}: must be a class number and a box (number, x, y, width, height, "
                f"each from 0 to 1), got '{line.strip()[:60]}'; export it again"
            )
        if int(kind) not in layout.names:
            raise DatasetError(
                f"{said}:{number}: class {int(kind)} has no name in {layout.said}, which names "
                f"{len(layout.names)} (from 0); add the name"
            )
        shares = [share for share in numbers[1:] if share is not None]
        left, top, right, bottom = _corners(shares)
        if max(map(abs, (left, top, right, bottom))) > 10:
            raise DamagedFileError(
                f"{said}:{number}: a box of YOLO is measured in shares from 0 to 1, got "
                f"'{line.strip()[:60]}'; export it again"
            )
        yield Box(left, top, right, bottom, layout.names[int(kind)])


def _corners(shares: Sequence[float]) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of a box (with a confidence or without), or of a polygon."""
    if len(shares) in (4, 5):
        across, down, width, height = shares[:4]
        return (across - width / 2, down - height / 2, across + width / 2, down + height / 2)
    across_all, down_all = shares[::2], shares[1::2]
    return (min(across_all), min(down_all), max(across_all), max(down_all))
