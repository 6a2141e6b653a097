"""Randomness that depends on a place in training, not on what ran before."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager

import torch

__all__ = ["seed_of", "seeded"]


def seed_of(*parts: object) -> int:
    """A seed made of ``parts``.

    Examples
    --------
    >>> seed_of(0, "lean", "split") == seed_of(0, "lean", "split")
    True
    """
    digest = hashlib.sha256(repr(parts).encode()).digest()
    return int.from_bytes(digest[:7], "big")


@contextmanager
def seeded(device: torch.device, *parts: object) -> Iterator[None]:
    """Run a block with PyTorch's generators seeded by ``parts``; the caller's are untouched."""
    devices = [torch.cuda.current_device()] if device.type == "cuda" else []
    with (
        torch.random.fork_rng(devices=devices),
        torch.backends.cudnn.flags(deterministic=True, benchmark=False),
    ):
        torch.manual_seed(seed_of(*parts))
        yield
