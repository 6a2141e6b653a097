"""Where networks compute."""

from __future__ import annotations

from typing import Literal, get_args

import torch

from seewhy.errors import DomainError
from seewhy.text.nearest import did_you_mean

__all__ = ["DEVICES", "Device", "device_of"]

Device = Literal["auto", "cpu", "cuda", "mps"]

DEVICES: tuple[Device, ...] = get_args(Device)


def device_of(name: str) -> torch.device:
    """The device of a name; ``auto`` is a graphics processor where there is one.

    Raises
    ------
    DomainError
        There is no such device, or this machine lacks it.

    Examples
    --------
    >>> device_of("cpu").type
    'cpu'
    """
    there = {
        "cuda": torch.cuda.is_available(),
        "mps": torch.backends.mps.is_available(),
        "cpu": True,
    }
    if name == "auto":
        return torch.device(next(kind for kind, present in there.items() if present))
    if name not in there:
        raise DomainError(f"'{name}' is no device; {did_you_mean(name, DEVICES)}")
    if not there[name]:
        raise DomainError(
            f"device {name}: PyTorch finds none on this machine; leave the option out, or use cpu"
        )
    return torch.device(name)
