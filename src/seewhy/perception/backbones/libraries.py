"""Backbones by the name that timm or torchvision has for them, with the weights that it fetches."""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

import torch
from torch import nn

from seewhy.errors import DomainError, ModelError
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.backbones.frozen import IMAGENET_MEAN, IMAGENET_SCALE, FrozenBackbone

__all__ = ["Observed", "observed", "timm_backbone", "torchvision_backbone"]

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
    timm = _imported("timm")
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
    models = _imported("torchvision").models
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
    return FrozenBackbone(
        name=name,
        digest=digest.hexdigest(),
        side=side,
        look=Observed(model, observed(model, side=side)),
        mean=mean,
        scale=scale,
        module=model,
    )


class Observed:
    """A network that tells what some of its modules give; several threads may look at once.

    Parameters
    ----------
    model : nn.Module
    names : sequence of str
        Of the modules, as :meth:`nn.Module.named_modules` has them.
    """

    def __init__(self, model: nn.Module, names: Sequence[str]) -> None:
        self.model = model
        self.names = list(names)
        self._thread = threading.local()
        modules = dict(model.named_modules())
        self._hooks = [modules[name].register_forward_hook(self._keeper(name)) for name in names]

    def __call__(self, pictures: torch.Tensor) -> list[torch.Tensor]:
        """What the modules give, in the order in which they were named."""
        outputs = self.outputs(pictures)
        return [outputs[name] for name in self.names]

    def outputs(self, pictures: torch.Tensor) -> dict[str, torch.Tensor]:
        """Name → tensor, in the order in which modules finish; who gives no tensor is left out."""
        self._thread.outputs = {}
        self.model(pictures)
        found: dict[str, torch.Tensor] = self._thread.outputs
        return found

    def forget(self) -> None:
        """Observe no more."""
        for hook in self._hooks:
            hook.remove()

    def _keeper(self, name: str) -> Callable[[nn.Module, Any, Any], None]:
        def keep(_module: nn.Module, _inputs: Any, output: Any) -> None:
            if isinstance(output, torch.Tensor):
                self._thread.outputs.pop(name, None)
                self._thread.outputs[name] = output

        return keep


def observed(model: nn.Module, *, side: int) -> list[str]:
    """The modules to look at: of each of the last resolutions, the last one that has it.

    Of a transformer, which has one resolution, the last that gives tokens.
    """
    everything = Observed(model, [name for name, _ in model.named_modules() if name])
    with torch.inference_mode():
        outputs = everything.outputs(torch.zeros((1, 3, side, side)))
    everything.forget()
    last: dict[object, str] = {}
    for name, values in outputs.items():
        wide = values.ndim == 4 and 1 < values.shape[-1] == values.shape[-2] <= side // 4
        if wide or values.ndim == 3:
            shape = values.shape[-1] if wide else "tokens"
            last.pop(shape, None)
            last[shape] = name
    return list(last.values())[-_LOOKED_AT:]


def _imported(library: str) -> Any:
    try:
        return import_module(library)
    except ImportError:
        raise DomainError(
            f"eyes '{library}:…' need {library}, which is not installed: pip install {library}"
        ) from None
    except Exception as problem:
        # Compiled for another PyTorch, it fails in whatever way that leads to.
        raise DomainError(
            f"eyes '{library}:…' need {library}, which does not work with this PyTorch "
            f"({problem}): install the release that belongs to it"
        ) from None


def _not_fetched(name: str, problem: Exception) -> ModelError:
    said = str(problem).splitlines()[0] if str(problem) else type(problem).__name__
    return ModelError(
        f"the weights of {name} cannot be fetched ({said}): try again with a network, or take "
        "other eyes"
    )
