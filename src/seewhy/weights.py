"""A network's weights on disk: tensors in one file, and beside it JSON that describes them."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from seewhy.errors import ModelError
from seewhy.files import write_whole

REMEDY = "train the model again, or copy its folder again from where it is whole"


class Described(BaseModel):
    """What every description says: its format, and the digest of the weights that it describes."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    format: int
    digest: str


Description = TypeVar("Description", bound=Described)


def write_weights(
    tensors: Mapping[str, Any], description: Described, *, weights: Path, described: Path
) -> None:
    """Write tensors (safetensors) and their description, with the digest filled in."""
    from safetensors.torch import save

    content = save({name: tensor.contiguous().clone() for name, tensor in tensors.items()})
    digest = hashlib.sha256(content).hexdigest()
    text = description.model_copy(update={"digest": digest}).model_dump_json(indent=2)
    write_whole(weights, content)
    write_whole(described, text + "\n")


def read_weights(
    schema: type[Description], *, number: int, weights: Path, described: Path
) -> tuple[Description, dict[str, Any]]:
    """Return what :func:`write_weights` wrote; ``number`` is the format that is read.

    Raises
    ------
    ModelError
        A file is missing, damaged, or does not belong to the other; the text names it.
    """
    from safetensors import SafetensorError
    from safetensors.torch import load

    try:
        description = schema.model_validate_json(described.read_bytes())
        content = weights.read_bytes()
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(part) for part in first["loc"]) or "its text"
        raise ModelError(f"{described} is damaged ({where}: {first['msg']}): {REMEDY}") from None
    except OSError as error:
        missing = error.filename or weights.parent
        raise ModelError(f"{missing} cannot be read ({error.strerror}): {REMEDY}") from None
    if description.format != number:
        raise ModelError(
            f"{described} has format {description.format}, this version of SeeWhy reads {number}: "
            "train the model again"
        )
    if hashlib.sha256(content).hexdigest() != description.digest:
        raise ModelError(f"{weights} is damaged or belongs to another {described.name}: {REMEDY}")
    try:
        return description, load(content)
    except (SafetensorError, ValueError):
        raise ModelError(f"{weights} does not hold what {described} describes: {REMEDY}") from None
