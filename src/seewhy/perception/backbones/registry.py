"""Which backbones there are: a name, or a family's name and what follows its colon."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from seewhy.domain.tables import EMBEDDED, NONE
from seewhy.errors import DomainError
from seewhy.text.nearest import did_you_mean

if TYPE_CHECKING:
    from seewhy.perception.backbones.backbone import Backbone

__all__ = ["EMBEDDED", "NONE", "load_backbone", "require_backbone", "sides_of"]


def _embedded(_: str) -> Backbone:
    from seewhy.perception.backbones.embedded import embedded_backbone

    return embedded_backbone()


def _timm(name: str) -> Backbone:
    from seewhy.perception.backbones.libraries import timm_backbone

    return timm_backbone(name)


def _torchvision(name: str) -> Backbone:
    from seewhy.perception.backbones.libraries import torchvision_backbone

    return torchvision_backbone(name)


def _onnx(path: str) -> Backbone:
    from seewhy.perception.backbones.onnx_file import onnx_backbone

    return onnx_backbone(path)


FAMILIES: dict[str, Callable[[str], Backbone]] = {
    EMBEDDED: _embedded,
    "timm": _timm,
    "torchvision": _torchvision,
    "onnx": _onnx,
}
"""Family → what makes a backbone of what follows the colon."""


def require_backbone(name: str) -> None:
    """Raise a DomainError where ``name`` is neither a backbone nor "none"; nothing is loaded.

    Examples
    --------
    >>> require_backbone("efficientnet-lite")
    Traceback (most recent call last):
    seewhy.errors.DomainError: eyes 'efficientnet-lite' are not known; did you mean ...
    """
    family, _, _ = name.partition(":")
    if family not in FAMILIES and name != NONE:
        raise DomainError(f"eyes '{name}' are not known; {did_you_mean(name, (*FAMILIES, NONE))}")


def sides_of(name: str) -> tuple[int, ...]:
    """The sides of pictures that a backbone may look at, its usual one first; none where one alone.

    Examples
    --------
    >>> sides_of("timm:resnet18")
    ()
    """
    from seewhy.perception.backbones.embedded import sides

    return sides() if name == EMBEDDED else ()


def load_backbone(name: str, *, device: str = "auto", side: int | None = None) -> Backbone:
    """Return the backbone of a name.

    Parameters
    ----------
    name : str
        ``efficientnet-lite0``, whose last layers are tuned; or, with heads alone, ``timm:NAME``,
        ``torchvision:NAME`` or ``onnx:FILE``.
    device : {"auto", "cpu", "cuda", "mps"}
    side : int, optional
        Of the pictures that it looks at, one of :func:`sides_of`; its usual one where left out.

    Raises
    ------
    DomainError
        There is no such backbone, or no such device.
    ModelError
        Its weights are missing, damaged or others.

    Examples
    --------
    >>> load_backbone("efficientnet-lite0").name
    'efficientnet-lite0'
    """
    from seewhy.perception.device import device_of

    require_backbone(name)
    family, _, rest = name.partition(":")
    if side in sides_of(name):
        from seewhy.perception.backbones.embedded import embedded_backbone

        return embedded_backbone(side).to(device_of(device))
    return FAMILIES[family](rest).to(device_of(device))
