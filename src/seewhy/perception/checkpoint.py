"""Where training stands, on disk after every epoch.

One safetensors file a feature; its header carries the position as JSON, so that tensors and
position are replaced in one step.
"""

from __future__ import annotations

import hashlib
import json
import logging
import math
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal, TypeVar

import numpy as np
import torch
from pydantic import TypeAdapter
from safetensors import SafetensorError, safe_open
from safetensors.torch import save_file

from seewhy.files.whole_files import whole_file
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.network import GrowingNetwork
from seewhy.perception.options import TrainingOptions
from seewhy.perception.rehearsal import Rehearsal

_logger = logging.getLogger(__name__)

__all__ = ["Checkpoint", "Position", "Weights", "checkpoint_file", "fingerprint"]

FORMAT = 2

Weights = dict[str, torch.Tensor]


@dataclass
class Position:
    """Where training stands between two epochs: all but the tensors."""

    stage: Literal["growing", "settling", "finished"] = "growing"
    depth: int = 1
    epoch: int = 0  # finished in this stage, at this depth
    epochs_run: int = 0
    since_best: int = 0
    best: list[float] = field(default_factory=lambda: [-1.0, math.inf])  # accuracy, loss
    chosen_depth: int = 0
    chosen: list[float] = field(default_factory=lambda: [-1.0, math.inf])
    flat_growths: int = 0


def checkpoint_file(folder: Path | str, feature: str) -> Path:
    """The file of a feature, always in the folder itself.

    Examples
    --------
    >>> checkpoint_file("training", "lean").name
    'lean.checkpoint.safetensors'
    """
    # A name that is no plain file name keeps apart from its neighbours by its digest.
    plain = re.fullmatch(r"[A-Za-z0-9_]+", feature)
    name = feature if plain else f"feature-{hashlib.sha256(feature.encode()).hexdigest()[:12]}"
    return Path(folder) / f"{name}.checkpoint.safetensors"


def fingerprint(
    shown: LabelledPictures,
    feature: str,
    *,
    options: TrainingOptions,
    start_from: GrowingNetwork | None,
    rehearsal: Rehearsal | None,
) -> str:
    """What must agree for a checkpoint of a feature to be gone on with."""
    digest = hashlib.sha256(np.ascontiguousarray(shown.pixels).data)
    described = [
        FORMAT,
        shown.pixels.shape,
        list(shown.labels[feature]),
        feature,
        list(shown.values[feature]),
        asdict(options),
        None if shown.groups is None else [repr(group) for group in shown.groups],
        None if shown.validation is None else [int(index) for index in shown.validation],
    ]
    digest.update(json.dumps(described, sort_keys=True).encode())
    if start_from is not None:
        digest.update(_digest(start_from.state_dict()).encode())
    if rehearsal is not None:
        digest.update(np.ascontiguousarray(rehearsal.pictures).data)
        digest.update(json.dumps(list(rehearsal.labels[feature])).encode())
    return digest.hexdigest()


Where = TypeVar("Where")  # a dataclass of what JSON can hold


@dataclass(frozen=True)
class Checkpoint:
    """Where an interrupted training finds where it was, and by what it knows that it is its own.

    Examples
    --------
    >>> Checkpoint(Path("nowhere"), "of these pictures").read(Position) is None
    True
    """

    file: Path
    fingerprint: str

    def write(self, position: Any, tensors: Mapping[str, Weights]) -> None:
        """Write a position (a dataclass) and its tensors, each under the part it belongs to."""
        flat = {
            f"{part}.{name}": tensor.detach().cpu().contiguous().clone()
            for part, of in tensors.items()
            for name, tensor in of.items()
        }
        header = {
            "fingerprint": self.fingerprint,
            "position": json.dumps(asdict(position), sort_keys=True),
            "digest": _digest(flat),
        }
        with whole_file(self.file, durable=False) as temporary:
            save_file(flat, temporary, metadata=header)

    def read(self, kind: type[Where]) -> tuple[Where, dict[str, Weights]] | None:
        """What :meth:`write` wrote, or None where there is nothing that could be gone on with."""
        if not self.file.is_file():
            return None
        try:
            with safe_open(self.file, framework="pt") as opened:
                header = opened.metadata() or {}
                if header.get("fingerprint") != self.fingerprint:
                    _logger.info("%s: is of another training, which begins anew", self.file)
                    return None
                position = TypeAdapter(kind).validate_json(header["position"], strict=True)
                flat = {name: opened.get_tensor(name) for name in opened.keys()}  # noqa: SIM118
            if _digest(flat) != header["digest"]:
                raise ValueError("its numbers are not those that were written")
        except (
            SafetensorError, OSError, ValueError, KeyError, TypeError, RecursionError,
        ) as problem:  # fmt: skip
            _logger.warning("%s: is damaged; the training begins anew (%s)", self.file, problem)
            return None
        parts: dict[str, Weights] = {}
        for key, tensor in flat.items():
            part, name = key.split(".", maxsplit=1)
            parts.setdefault(part, {})[name] = tensor
        return position, parts


def _digest(tensors: Weights) -> str:
    """Of names and numbers; safetensors itself does not notice a changed number."""
    digest = hashlib.sha256()
    for name in sorted(tensors):
        digest.update(name.encode() + tensors[name].cpu().contiguous().numpy().tobytes())
    return digest.hexdigest()
