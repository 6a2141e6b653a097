"""The list of a model's files with their digests: what was changed or left out is refused."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, TypeVar

from seewhy.errors import ModelError
from seewhy.files.json_file import Strict, read_json, read_object
from seewhy.perception.weights import LARGEST as LARGEST_WEIGHTS
from seewhy.text.visible import visible

__all__ = [
    "MANIFEST",
    "REMEDY",
    "THINGS_FORMAT",
    "check_files",
    "is_of_things",
    "read_manifest",
    "write_manifest",
]

MANIFEST = "model.json"
REMEDY = "train it again"

THINGS_FORMAT = "things 1"
"""The format of a model of things, whose files are others."""

Schema = TypeVar("Schema", bound=Strict)


def write_manifest(folder: Path, fields: Mapping[str, Any]) -> None:
    """Write model.json, with the digest of each file that is in the folder."""
    manifest = {
        **fields,
        "files": {
            path.relative_to(folder).as_posix(): _digest(path)
            for path in sorted(folder.rglob("*"))
            if path.is_file()
        },
    }
    text = json.dumps({**manifest, "digest": _digest_of(manifest)}, indent=1)
    (folder / MANIFEST).write_text(text, encoding="utf-8")


def read_manifest(folder: Path, schema: type[Schema], *, number: int | str) -> Schema:
    """Read model.json; ``number`` is the format that is read.

    Raises
    ------
    ModelError
        If the folder is no model, or one of another format, or model.json was edited.
    """
    path, found = _read(folder)
    written = found.get("format")
    if written != number:
        if THINGS_FORMAT in (written, number):
            several = written == THINGS_FORMAT
            raise ModelError(
                f"{path}: is a model of {'several things' if several else 'one thing'} in each "
                f"picture, which this is not for; {_USE[several]}"
            )
        raise ModelError(
            f"{path}: the model has format {visible(written, most=20)}, this version "
            f"reads {number}; {REMEDY}"
        )
    if found.pop("digest", None) != _digest_of(found):
        raise changed(path)
    return read_json(path, schema, remedy=REMEDY)


_USE = {
    True: "'seewhy ask', 'chat', 'classify' and 'evaluate' take it, and seewhy.ThingAgent",
    False: "load it with seewhy.Agent",
}


def is_of_things(folder: Path) -> bool:
    """Whether a folder holds a model of several things in each picture.

    Raises
    ------
    ModelError
        If it is no model.
    """
    _, found = _read(folder)
    return found.get("format") == THINGS_FORMAT


def _read(folder: Path) -> tuple[Path, dict[str, Any]]:
    if not folder.is_dir():
        raise ModelError(f"{folder}: there is no such model; 'seewhy train' makes one")
    path = folder / MANIFEST
    if not path.is_file():
        raise ModelError(
            f"{folder}: is not a model, it has no {MANIFEST}; give the folder that 'seewhy "
            "train --out' wrote"
        )
    return path, read_object(path, remedy=REMEDY)


def check_files(
    folder: Path, files: Mapping[str, str], *, must: Collection[str], may: Collection[str]
) -> None:
    """Check that the files of a model are there, as they were written, and no others.

    Raises
    ------
    ModelError
        If one is not; the text names it.
    """
    for name in files.keys() - {*may}:
        raise ModelError(
            f"{folder / MANIFEST} is damaged (files: '{visible(name)}' is no file of a model): "
            f"{REMEDY}"
        )
    for name in (*must, *files):
        path = folder / name
        if name not in files or not path.is_file():
            raise ModelError(f"{folder}: the model is incomplete, {name} is missing; {REMEDY}")
        if path.stat().st_size > LARGEST_WEIGHTS:
            raise ModelError(f"{path} is larger than any file of a model: {REMEDY}")
        if _digest(path) != files[name]:
            raise changed(path)


def changed(path: Path) -> ModelError:
    """The error that a file is not as it was written."""
    return ModelError(
        f"{path}: has changed since the model was trained; undo the change or train the model "
        "again (knowledge is edited in the domain's own folder)"
    )


def _digest(path: Path) -> str:
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _digest_of(manifest: Mapping[str, Any]) -> str:
    return hashlib.sha256(json.dumps(manifest, sort_keys=True).encode()).hexdigest()
