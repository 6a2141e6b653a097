"""A network's weights on disk: tensors in one file, and beside it JSON that describes them."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from seewhy.errors import ModelError
from seewhy.files.json_file import Strict, read_bytes, read_json, read_object
from seewhy.files.whole_files import write_whole
from seewhy.text.visible import visible

REMEDY = "train the model again, or copy its folder again from where it is whole"


LARGEST = 1 << 30
"""Bytes that a file of weights may have; those of the largest backbones' tails have a fifth."""


class Described(Strict):
    """What every description says: its format, and the digest of the weights that it describes."""

    format: int
    digest: str


Description = TypeVar("Description", bound=Described)


def write_weights(
    tensors: Mapping[str, Any], description: Described, *, weights: Path, described: Path
) -> None:
    """Write tensors (safetensors) and their description, with the digest filled in.

    They are on the disk when the folder is that they belong to; see
    :func:`seewhy.files.folders.whole_folder`.
    """
    from safetensors.torch import save

    content = save({name: tensor.contiguous().clone() for name, tensor in tensors.items()})
    digest = hashlib.sha256(content).hexdigest()
    text = description.model_copy(update={"digest": digest}).model_dump_json(indent=2)
    write_whole(weights, content, durable=False)
    write_whole(described, text + "\n", durable=False)


def read_weights(
    schema: type[Description], *, number: int, weights: Path, described: Path
) -> tuple[Description, dict[str, Any]]:
    """Return what :func:`write_weights` wrote; ``number`` is the format that is read.

    Raises
    ------
    ModelError
        A file is missing, damaged, too large, or does not belong to the other; the text names it.
    """
    from safetensors import SafetensorError
    from safetensors.torch import load

    found = read_object(described, remedy=REMEDY).get("format")
    if found != number:
        raise ModelError(
            f"{described} has format {visible(found, most=20)}, this version of SeeWhy reads "
            f"{number}: train the model again"
        )
    description = read_json(described, schema, remedy=REMEDY)
    content = read_bytes(weights, largest=LARGEST, remedy=REMEDY)
    if hashlib.sha256(content).hexdigest() != description.digest:
        raise ModelError(f"{weights} is damaged or belongs to another {described.name}: {REMEDY}")
    try:
        return description, load(content)
    except (SafetensorError, ValueError, KeyError, TypeError, RuntimeError):
        raise ModelError(f"{weights} does not hold what {described} describes: {REMEDY}") from None


def check_tensors(
    tensors: Mapping[str, Any], expected: Mapping[str, Any], *, weights: Path, described: Path
) -> None:
    """Check that tensors are just those that are expected, in shape and type, and numbers all.

    What is expected may stand on PyTorch's device "meta", which takes no memory: so nothing is
    made as large as a description says before the weights are known to be.

    Raises
    ------
    ModelError
        They are not; the text names the first.
    """
    import torch

    for name in sorted({*tensors, *expected}):
        if name not in expected:
            wrong = "is none of them"
        elif name not in tensors:
            wrong = "is missing"
        elif tensors[name].shape != expected[name].shape:
            shape = tuple(expected[name].shape)
            wrong = f"must be of shape {shape}, got {tuple(tensors[name].shape)}"
        elif tensors[name].dtype != expected[name].dtype:
            wrong = f"must be of {expected[name].dtype}, got {tensors[name].dtype}"
        elif not torch.isfinite(tensors[name]).all():
            wrong = "holds what is no number"
        else:
            continue
        raise ModelError(
            f"{weights} does not hold the weights that {described} describes "
            f"({visible(name)} {wrong}): {REMEDY}"
        )
