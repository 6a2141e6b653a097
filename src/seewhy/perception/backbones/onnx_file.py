"""A backbone in an ONNX file: what its outputs say of a picture."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import numpy as np
import torch

from seewhy.errors import DomainError, ModelError
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.backbones.frozen import FrozenBackbone

__all__ = ["onnx_backbone"]

SIDE = 224
"""The side of pictures shown to a network whose file names none."""


def onnx_backbone(path: str) -> Backbone:
    """The network in a file; ``eyes = "onnx:/home/me/backbone.onnx"``.

    It takes pictures of shape (n, 3, side, side), standardised as for ImageNet; all its outputs are
    looked at. It is never tuned.

    Raises
    ------
    DomainError
        onnxruntime is not installed, or there is no such file.
    ModelError
        The file is no such network.
    """
    try:
        import onnxruntime
    except ImportError:
        raise DomainError(
            "eyes 'onnx:…' need onnxruntime, which is not installed: pip install onnxruntime"
        ) from None
    file = Path(path).expanduser()
    if not file.is_file():
        raise DomainError(f"eyes 'onnx:{path}': there is no such file; give its whole path")
    content = file.read_bytes()
    options = onnxruntime.SessionOptions()
    options.log_severity_level = 4
    try:
        session: Any = onnxruntime.InferenceSession(
            content, options, providers=["CPUExecutionProvider"]
        )
        (taken,) = session.get_inputs()
        shape = list(taken.shape)
        side = shape[-1] if isinstance(shape[-1], int) else SIDE
        if len(shape) != 4 or shape[1] != 3 or taken.type != "tensor(float)":
            raise ValueError(f"its input is {taken.type} of shape {shape}")
    except Exception as problem:
        said = str(problem).splitlines()[0]
        raise ModelError(
            f"{file}: is no network of pictures of shape (n, 3, side, side): {said}; export one "
            "with a single input"
        ) from None
    one_at_a_time = shape[0] == 1

    def look(pictures: torch.Tensor) -> list[torch.Tensor]:
        rows = pictures.contiguous().numpy()
        parts = [rows[n : n + 1] for n in range(len(rows))] if one_at_a_time else [rows]
        outputs = [session.run(None, {taken.name: part}) for part in parts]
        return [torch.from_numpy(np.concatenate(column)) for column in zip(*outputs, strict=True)]

    return FrozenBackbone(
        name=f"onnx:{path}",
        digest=hashlib.sha256(content).hexdigest(),
        side=int(side),
        look=look,
    )
