"""Backbones by the name that timm or torchvision has for them, with the weights that it fetches."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import Any

import torch
from torch import nn

from seewhy.errors import DomainError, ModelError
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.backbones.frozen import IMAGENET_MEAN, IMAGENET_SCALE, FrozenBackbone

__all__ = ["observed", "timm_backbone", "torchvision_backbone"]

SIDE = 160
"""The side of pictures shown to a network that takes any; others have one of their own."""

_LOOKED_AT = 3  # layers, each the last of its resolution


def timm_backbone(name: str) -> Backbone:
    """The network that timm calls so; ``eyes = "timm:resnet18"``.

    Raises
    ------
    DomainError
        timm is not installed, or has no such network.
    ModelError
        The weights cannot be fetched.
    """
    try:
        import timm
    except ImportError:
        raise _not_installed("timm") from None
    except Exception as problem:
        raise _does_not_fit("timm", problem) from None
    if not timm.is_model(name):
        raise DomainError(f"eyes 'timm:{name}': timm has no network of this name")
    try:
        model = timm.create_model(name, pretrained=True)
    except Exception as problem:
        raise _not_fetched(f"timm:{name}", problem) from None
    settings: dict[str, Any] = model.pretrained_cfg
    fixed = settings.get("fixed_input_size", False)
    side = int(settings["input_size"][-1]) if fixed else SIDE
    mean = [255.0 * level for level in settings["mean"]]
    scale = [255.0 * level for level in settings["std"]]
    return _frozen(f"timm:{name}", model, side=side, mean=mean, scale=scale)


def torchvision_backbone(name: str) -> Backbone:
    """The network that torchvision calls so; ``eyes = "torchvision:resnet18"``.

    Raises
    ------
    DomainError
        torchvision is not installed, or has no such network.
    ModelError
        The weights cannot be fetched.
    """
    try:
        from torchvision import models
    except ImportError:
        raise _not_installed("torchvision") from None
    except Exception as problem:
        raise _does_not_fit("torchvision", problem) from None
    if name not in models.list_models(models):
        raise DomainError(f"eyes 'torchvision:{name}': torchvision has no network of this name")
    try:
        model = models.get_model(name, weights="DEFAULT")
    except Exception as problem:
        raise _not_fetched(f"torchvision:{name}", problem) from None
    # Transformers take pictures of the side that they were trained on, and no other.
    side = int(getattr(model, "image_size", SIDE))
    return _frozen(
        f"torchvision:{name}", model, side=side, mean=IMAGENET_MEAN, scale=IMAGENET_SCALE
    )


def _frozen(
    name: str, model: nn.Module, *, side: int, mean: Sequence[float], scale: Sequence[float]
) -> Backbone:
    model.eval().requires_grad_(False)
    digest = hashlib.sha256(f"{name} {side} {_LOOKED_AT}".encode())
    for key, weight in sorted(model.state_dict().items()):
        digest.update(key.encode() + weight.cpu().contiguous().numpy().tobytes())
    names = observed(model, side=side)
    modules = dict(model.named_modules())

    def look(pictures: torch.Tensor) -> list[torch.Tensor]:
        return [
            found[key] for found in [_outputs(model, modules, names, pictures)] for key in names
        ]

    return FrozenBackbone(
        name=name,
        digest=digest.hexdigest(),
        side=side,
        look=look,
        mean=mean,
        scale=scale,
        module=model,
    )


def observed(model: nn.Module, *, side: int) -> list[str]:
    """The modules to look at: of each of the last resolutions, the last one that has it.

    Of a transformer, which has one resolution, the last that gives tokens.
    """
    modules = {name: module for name, module in model.named_modules() if name}
    blank = torch.zeros((1, 3, side, side))
    with torch.inference_mode():
        outputs = _outputs(model, modules, list(modules), blank)
    last: dict[object, str] = {}
    for name, values in outputs.items():
        wide = values.ndim == 4 and 1 < values.shape[-1] == values.shape[-2] <= side // 4
        if wide or values.ndim == 3:
            shape = values.shape[-1] if wide else "tokens"
            last.pop(shape, None)
            last[shape] = name
    return list(last.values())[-_LOOKED_AT:]


def _outputs(
    model: nn.Module, modules: dict[str, nn.Module], names: list[str], pictures: torch.Tensor
) -> dict[str, torch.Tensor]:
    """What modules give for pictures, in the order in which they finish."""
    found: dict[str, torch.Tensor] = {}

    def keep(name: str) -> Any:
        def hook(_module: nn.Module, _inputs: Any, output: Any) -> None:
            if isinstance(output, torch.Tensor):
                found.pop(name, None)
                found[name] = output

        return hook

    hooks = [modules[name].register_forward_hook(keep(name)) for name in names]
    try:
        model(pictures)
    finally:
        for hook in hooks:
            hook.remove()
    return found


def _not_installed(library: str) -> DomainError:
    return DomainError(
        f"eyes '{library}:…' need {library}, which is not installed: pip install {library}"
    )


def _does_not_fit(library: str, problem: Exception) -> DomainError:
    # Compiled for another PyTorch, they fail in whatever way that leads to.
    return DomainError(
        f"eyes '{library}:…' need {library}, which does not work with this PyTorch ({problem}): "
        "install the release that belongs to it"
    )


def _not_fetched(name: str, problem: Exception) -> ModelError:
    said = str(problem).splitlines()[0] if str(problem) else type(problem).__name__
    return ModelError(
        f"the weights of {name} cannot be fetched ({said}): try again with a network, or take "
        "other eyes"
    )
