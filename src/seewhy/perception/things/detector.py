"""A detector: finds the boxes of things in a picture, whatever they are, and how sure each is."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Protocol

import numpy as np
import numpy.typing as npt
import torch
from PIL import Image
from pydantic import Field

from seewhy.errors import ModelError
from seewhy.files.json_file import Strict
from seewhy.perception.backbones import EMBEDDED, load_backbone
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.things.boxes import Boxes, none_twice, overlaps
from seewhy.perception.things.centre_map import STRIDE, CentreMap, Maps, Predicted
from seewhy.perception.weights import Described, check_tensors, read_weights, write_weights

__all__ = ["SIDES", "CentreDetector", "Detected", "Detector", "Trust", "looked_at"]

SIDES = (192, 256, 320, 448)
"""Pixels of a picture's longer side when it is looked for things; small things need many."""

_FINE, _COARSE = 5, 11  # stages of the backbone
_MULTIPLE = 32  # sides of what the backbone looks at
_LEAST = 0.02  # scores below are not told
_TWICE = 0.6  # boxes that overlap by more are of one thing
_MOST = 200

DESCRIPTION, WEIGHTS, FORMAT = "detector.json", "detector.safetensors", 1


@dataclass(frozen=True, eq=False)
class Detected:
    """Boxes that may be of things.

    Attributes
    ----------
    boxes : ndarray of float, shape (n, 4)
        In pixels of the picture.
    scores : ndarray of float, shape (n,)
        As the detector gives them, 0 to 1.
    """

    boxes: Boxes
    scores: npt.NDArray[np.float64]


class Detector(Protocol):
    """Finds boxes in a picture."""

    def find(self, image: Image.Image) -> Detected:
        """Return what may be things in an upright picture in red, green and blue."""


Spread = Annotated[float, Field(ge=0.0, le=10.0)]


class Trust(Strict):
    """How a detector's scores become probabilities, and how far its boxes are off.

    Attributes
    ----------
    slope, intercept : float
        Of the logit of a score.
    crowding : float
        What counts against a box for the share that it has in common with a better one.
    spread : tuple of float
        The standard deviation of left, top, right and bottom, in lengths of the box.
    pictures : int
        By which all that was settled, that taught the detector nothing.
    """

    slope: Annotated[float, Field(ge=0.0, le=100.0)] = 1.0
    intercept: Annotated[float, Field(ge=-100.0, le=100.0)] = 0.0
    crowding: Annotated[float, Field(ge=-100.0, le=100.0)] = 0.0
    spread: tuple[Spread, Spread, Spread, Spread] = (0.0, 0.0, 0.0, 0.0)
    pictures: int = 0

    def probabilities(self, detected: Detected) -> npt.NDArray[np.float64]:
        """How probable it is that each box is of a thing of its own."""
        logits, crowded = evidence(detected)
        found: npt.NDArray[np.float64] = 1.0 / (
            1.0 + np.exp(-(self.slope * logits + self.crowding * crowded + self.intercept))
        )
        return found


def evidence(detected: Detected) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Of each box the logit of its score, and the share it has in common with a better one."""
    scores = np.clip(detected.scores, 1e-4, 1.0 - 1e-4)
    shares = overlaps(detected.boxes, detected.boxes)
    better = detected.scores[None, :] > detected.scores[:, None]
    crowded = np.where(better, shares, 0.0).max(axis=1, initial=0.0)
    return np.log(scores / (1.0 - scores)), crowded


class CentreDetector:
    """A centre map on the maps of the backbone that comes with SeeWhy.

    Parameters
    ----------
    network : CentreMap
    side : int
        Of :data:`SIDES`.
    backbone : Backbone, optional
        The embedded one where left out.
    """

    def __init__(self, network: CentreMap, *, side: int, backbone: Backbone | None = None) -> None:
        self.network = network.eval()
        self.side = side
        self.backbone = backbone or load_backbone(EMBEDDED, device="cpu")

    def find(self, image: Image.Image) -> Detected:
        """Return what may be things; at most 200, the surest first."""
        shown, scale = _shown(image, self.side)
        with torch.inference_mode():
            return _peaks(self.network(looked_at(self.backbone, shown[None])), scale, image.size)

    def save(self, folder: Path | str) -> None:
        """Write ``detector.safetensors`` and ``detector.json`` into ``folder``."""
        write_weights(
            dict(self.network.state_dict()),
            _Description(
                format=FORMAT, digest="", side=self.side, backbone_digest=self.backbone.digest
            ),
            weights=Path(folder) / WEIGHTS,
            described=Path(folder) / DESCRIPTION,
        )

    @classmethod
    def load(cls, folder: Path | str) -> CentreDetector:
        """Read what :meth:`save` wrote.

        Raises
        ------
        ModelError
            A file is missing, damaged, or does not belong to the other; the text names it.
        """
        weights, described = Path(folder) / WEIGHTS, Path(folder) / DESCRIPTION
        description, tensors = read_weights(
            _Description, number=FORMAT, weights=weights, described=described
        )
        backbone = load_backbone(EMBEDDED, device="cpu")
        if description.backbone_digest != backbone.digest:
            raise ModelError(
                f"{described}: the detector was trained on another {backbone.name} than the one "
                "installed: train the model again, or install the one of then"
            )
        network = untrained(backbone)
        check_tensors(tensors, network.state_dict(), weights=weights, described=described)
        network.load_state_dict(tensors)
        return cls(network, side=description.side, backbone=backbone)


class _Description(Described):
    side: Annotated[int, Field(ge=64, le=1024, multiple_of=_MULTIPLE)]
    backbone_digest: str


def untrained(backbone: Backbone) -> CentreMap:
    """A centre map for a backbone's maps that has learned nothing."""
    maps = looked_at(backbone, np.zeros((1, _MULTIPLE, _MULTIPLE, 3), dtype=np.uint8))
    return CentreMap(maps.fine.shape[1], maps.coarse.shape[1])


def looked_at(backbone: Backbone, pictures: npt.NDArray[np.uint8]) -> Maps:
    """What the backbone makes of pictures of any shape whose sides are multiples of 32."""
    found = backbone.stage_maps(pictures, (_FINE, _COARSE))
    return Maps(found[_FINE], found[_COARSE])


def scaled(image: Image.Image, side: int) -> tuple[npt.NDArray[np.uint8], float]:
    """The picture with a longer side of ``side``, and by what its pixels are multiplied."""
    scale = side / max(image.size)
    size = (max(1, round(image.width * scale)), max(1, round(image.height * scale)))
    return np.asarray(image.resize(size, Image.Resampling.BILINEAR)), scale


def padded(pixels: npt.NDArray[np.uint8], rows: int, columns: int) -> npt.NDArray[np.uint8]:
    """A picture with its mean colour below it and right of it."""
    canvas = np.empty((rows, columns, 3), dtype=np.uint8)
    canvas[:] = np.rint(pixels.mean(axis=(0, 1))).astype(np.uint8)
    canvas[: pixels.shape[0], : pixels.shape[1]] = pixels
    return canvas


def _shown(image: Image.Image, side: int) -> tuple[npt.NDArray[np.uint8], float]:
    pixels, scale = scaled(image, side)
    rows, columns = (-(-length // _MULTIPLE) * _MULTIPLE for length in pixels.shape[:2])
    return padded(pixels, rows, columns), scale


def _peaks(predicted: Predicted, scale: float, size: tuple[int, int]) -> Detected:
    """The cells that are likelier to be a middle than those around them, with their boxes."""
    scores = torch.sigmoid(predicted.centres[0])
    around = torch.nn.functional.max_pool2d(scores[None, None], 3, stride=1, padding=1)[0, 0]
    rows, columns = torch.nonzero((scores >= around) & (scores >= _LEAST), as_tuple=True)
    found = scores[rows, columns].double().numpy()
    boxes = predicted.boxes[0][:, rows, columns].T.double().numpy() * STRIDE / scale
    boxes[:, [0, 2]] = boxes[:, [0, 2]].clip(0.0, float(size[0]))
    boxes[:, [1, 3]] = boxes[:, [1, 3]].clip(0.0, float(size[1]))
    real = (boxes[:, 2] - boxes[:, 0] > 0.5) & (boxes[:, 3] - boxes[:, 1] > 0.5)
    boxes, found = boxes[real], found[real]
    best = np.argsort(-found, kind="stable")[:_MOST]
    kept = best[none_twice(boxes[best], found[best], above=_TWICE)] if len(best) else best
    return Detected(boxes[kept], found[kept])
