"""The backbone that comes with SeeWhy: EfficientNet-Lite0, looked at where it pays."""

from __future__ import annotations

import hashlib

from seewhy.perception.backbones.backbone import Backbone, Tap, Trunk
from seewhy.perception.backbones.efficientnet_lite import DIGEST, efficientnet_lite0
from seewhy.perception.backbones.registry import EMBEDDED

__all__ = ["embedded_backbone", "sides"]

SIDE = 112
"""Half of what it was trained on: a quarter of the time, and as good on things cut out close."""

_LARGER = 10 / 7
"""Of that side is the larger one, of 160 pixels: for what has finer details, at twice the time."""

# Early stages tell lines and colours, late ones things; the last alone is much worse than all.
_TAPS = (Tap(5, 5), Tap(8, 3), Tap(11, 3), Tap(16, 1))
_TUNED_FROM = 9
_TUNED_TAPS = (Tap(11, 2), Tap(16, 1))


def sides() -> tuple[int, int]:
    """The sides of pictures that it may look at: its own, and a larger one."""
    return SIDE, round(SIDE * _LARGER)


def embedded_backbone(side: int | None = None) -> Backbone:
    """EfficientNet-Lite0 with its weights checked.

    Parameters
    ----------
    side : int, optional
        Of the pictures, in pixels; :data:`SIDE` where left out.

    Raises
    ------
    ModelError
        The weights are missing, damaged or others.
    """
    looked_at = SIDE if side is None else side
    described = repr((DIGEST, looked_at, _TAPS, _TUNED_FROM))
    return Backbone(
        name=EMBEDDED,
        digest=hashlib.sha256(described.encode()).hexdigest(),
        side=looked_at,
        mean=(127.0,) * 3,
        scale=(128.0,) * 3,
        trunk=Trunk(efficientnet_lite0(), _TUNED_FROM, _TUNED_TAPS),
        taps=_TAPS,
    )
