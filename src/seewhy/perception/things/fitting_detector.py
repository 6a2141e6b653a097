"""Teach a detector where things are, by the boxes that somebody drew around them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import torch

from seewhy.perception.backbones import EMBEDDED, load_backbone
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.events import EyesEvent
from seewhy.perception.optimisation import descend, one_cycle, slow_down
from seewhy.perception.randomness import seed_of, seeded
from seewhy.perception.side_by_side import side_by_side
from seewhy.perception.things.box_views import View, view_of
from seewhy.perception.things.boxes import Boxes, matched
from seewhy.perception.things.centre_map import STRIDE, CentreMap, Maps, box_loss, centre_loss
from seewhy.perception.things.centre_targets import targets_of
from seewhy.perception.things.detector import (
    SIDES,
    CentreDetector,
    Detected,
    Detector,
    Trust,
    evidence,
    looked_at,
    untrained,
)
from seewhy.perception.validation import folds

__all__ = ["BoxedPictures", "FittedDetector", "fit_detector", "fit_trust", "side_for"]

Told = Callable[[EyesEvent], None]
Rows = npt.NDArray[np.int64]

FEW = 60
"""With fewer pictures than this, each is held out once; with more, a fifth of them once."""

_FOLDS, _HELD_OUT = 3, 5
_GONE_OVER, _PASSES = 8000, (6.0, 60.0)
_AGAIN = 0.4  # of the passes, over all pictures, in the end
_VIEWS, _MOST_VIEWS = 1800, 8
_BATCH = 16
_RATE = 3e-3
_CELLS = 4.0  # sides of the smallest things, in cells: fewer, and what is half hidden is missed
_FARTHEST = 0.3  # in lengths of a box: edges further off are no spread but mistakes


@dataclass(frozen=True, eq=False)
class BoxedPictures:
    """Pictures with the boxes that are annotated in them.

    Attributes
    ----------
    pixels : sequence of ndarray of uint8, each of shape (rows, columns, 3)
        With a longer side of ``side``.
    boxes : sequence of ndarray of float, each of shape (things, 4)
        In their pixels.
    groups : sequence
        Pictures of one group are never divided.
    side : int
    """

    pixels: Sequence[npt.NDArray[np.uint8]]
    boxes: Sequence[Boxes]
    groups: Sequence[object]
    side: int

    def __len__(self) -> int:
        return len(self.pixels)


@dataclass(frozen=True, eq=False)
class FittedDetector:
    """A detector, how its scores are to be trusted, and what it found where it was not taught.

    Attributes
    ----------
    detector : CentreDetector
    trust : Trust
    held_out : Rows
        The places of pictures that were kept out.
    found : list of Detected
        What was found in each of them.
    """

    detector: CentreDetector
    trust: Trust
    held_out: Rows
    found: list[Detected]


def side_for(boxes: Sequence[Boxes], sizes: Sequence[tuple[int, int]]) -> int:
    """The side of pictures at which even small things cover a few cells.

    Examples
    --------
    >>> side_for([np.array([[0.0, 0, 40, 40]])], [(400, 300)])
    320
    """
    shares = [
        float(np.sqrt((box[2] - box[0]) * (box[3] - box[1]))) / max(size)
        for of_picture, size in zip(boxes, sizes, strict=True)
        for box in of_picture
    ]
    if not shares:
        return SIDES[0]
    small = float(np.quantile(shares, 0.1))
    return next((side for side in SIDES if side * small >= _CELLS * STRIDE), SIDES[-1])


def fit_detector(
    pictures: BoxedPictures, *, seed: int = 0, on_progress: Told | None = None
) -> FittedDetector:
    """Teach a detector by pictures in all of which all things have boxes.

    Parameters
    ----------
    pictures : BoxedPictures
    seed : int, default 0
        Two runs with the same seed and data agree on processors with the same instruction set.
    on_progress : callable, optional
        Called with every step.
    """
    told = on_progress or (lambda _: None)
    backbone = load_backbone(EMBEDDED, device="cpu")
    course = _Course(
        backbone, pictures, _views(backbone, pictures, seed=seed, told=told), seed, told
    )
    few = len(pictures) <= FEW
    counts = [min(len(boxes), 3) for boxes in pictures.boxes]
    parts = folds(
        counts,
        count=_FOLDS if few else _HELD_OUT,
        seed=seed_of(seed, "detector"),
        groups=pictures.groups,
    )
    parts = [] if len(parts) < 2 else parts if few else parts[:1]
    everything = np.arange(len(pictures))
    found: list[Detected] = []
    network: CentreMap | None = None
    for number, part in enumerate(parts):
        network = course.taught(None, np.setdiff1d(everything, part), 1.0, ("part", number))
        detector = CentreDetector(network, side=pictures.side, backbone=backbone)
        found += _found_in(detector, pictures, part)
    # What one fifth was kept from knows most already.
    further = len(parts) == 1
    network = course.taught(
        network if further else None, everything, _AGAIN if further else 1.0, ("all",)
    )
    held = np.concatenate(parts) if parts else everything[:0]
    trust = fit_trust(found, [pictures.boxes[n] for n in held])
    detector = CentreDetector(network, side=pictures.side, backbone=backbone)
    return FittedDetector(detector, trust, held, found)


def fit_trust(found: Sequence[Detected], true: Sequence[Boxes]) -> Trust:
    """How a detector's scores become probabilities, by pictures that taught it nothing.

    Parameters
    ----------
    found : sequence of Detected, length n
    true : sequence of ndarray of float, shape (things, 4), length n

    Examples
    --------
    >>> fit_trust([], []).slope
    1.0
    """
    from sklearn.linear_model import LogisticRegression

    columns: list[npt.NDArray[np.float64]] = []
    right: list[npt.NDArray[np.bool_]] = []
    residuals: list[npt.NDArray[np.float64]] = []
    for detected, boxes in zip(found, true, strict=True):
        if not len(detected.boxes):
            continue
        numbers = matched(detected.boxes, boxes)
        columns.append(np.stack(evidence(detected), axis=1))
        right.append(numbers >= 0)
        of_things = boxes[numbers[numbers >= 0]]
        lengths = np.tile(of_things[:, 2:] - of_things[:, :2], 2)
        residuals.append((detected.boxes[numbers >= 0] - of_things) / lengths)
    shown = np.concatenate(right) if right else np.zeros(0, dtype=bool)
    spread = (0.0, 0.0, 0.0, 0.0)
    if residuals and len(off := np.concatenate(residuals)):
        square = np.clip(off, -_FARTHEST, _FARTHEST) ** 2
        spread = tuple(float(edge) for edge in np.sqrt(square.mean(axis=0)))  # type: ignore[assignment]
    if shown.all() or not shown.any():
        return Trust(spread=spread, pictures=len(found))
    model = LogisticRegression(C=10.0, max_iter=300).fit(np.concatenate(columns), shown)
    slope, crowding = model.coef_[0]
    return Trust(
        slope=round(float(np.clip(slope, 0.05, 100.0)), 4),
        intercept=round(float(model.intercept_[0]), 4),
        crowding=round(float(np.clip(crowding, -100.0, 0.0)), 4),
        spread=spread,
        pictures=len(found),
    )


def _found_in(detector: Detector, pictures: BoxedPictures, rows: Rows) -> list[Detected]:
    from PIL import Image

    shown = [Image.fromarray(pictures.pixels[n]) for n in rows]
    return side_by_side(detector.find, shown)


@dataclass(frozen=True, eq=False)
class _Views:
    """Maps of all pictures in some views, in half precision, and the boxes in each view."""

    fine: npt.NDArray[np.float16]
    coarse: npt.NDArray[np.float16]
    boxes: list[list[Boxes]]

    def some(self, rows: Rows, views: Rows) -> Maps:
        return Maps(
            torch.from_numpy(self.fine[rows, views]).float(),
            torch.from_numpy(self.coarse[rows, views]).float(),
        )


def _views(backbone: Backbone, pictures: BoxedPictures, *, seed: int, told: Told) -> _Views:
    count = len(pictures)
    views = int(np.clip(_VIEWS // count, 2, _MOST_VIEWS))
    boxes: list[list[Boxes]] = []
    fine: npt.NDArray[np.float16] | None = None
    coarse: npt.NDArray[np.float16] | None = None
    for number in range(count):
        generator = np.random.default_rng(seed_of(seed, "view", number))
        shown = [
            view_of(
                pictures.pixels[number],
                pictures.boxes[number],
                side=pictures.side,
                generator=generator if view else None,
            )
            for view in range(views)
        ]

        def look(view: View) -> Maps:
            return looked_at(backbone, view.pixels[None])

        maps = side_by_side(look, shown)
        if fine is None or coarse is None:
            fine, coarse = (
                np.empty((count, views, *one.shape[1:]), dtype=np.float16) for one in maps[0]
            )
        for view, found in enumerate(maps):
            fine[number, view] = found.fine[0].half().numpy()
            coarse[number, view] = found.coarse[0].half().numpy()
        boxes.append([view.boxes for view in shown])
        told(EyesEvent("looking for things", number + 1, count))
    assert fine is not None, "there is no picture"
    assert coarse is not None
    return _Views(fine, coarse, boxes)


@dataclass(frozen=True, eq=False)
class _Course:
    """What a centre map is trained by."""

    backbone: Backbone
    pictures: BoxedPictures
    views: _Views
    seed: int
    told: Told

    def taught(
        self, start: CentreMap | None, rows: Rows, share: float, place: tuple[object, ...]
    ) -> CentreMap:
        """A network that the pictures at ``rows`` taught, from the start or further."""
        passes = share * float(np.clip(_GONE_OVER / len(rows), *_PASSES))
        total = max(1, round(len(rows) * passes / _BATCH))
        generator = np.random.default_rng(seed_of(self.seed, "centres", *place))
        with seeded(torch.device("cpu"), self.seed, "centres", *place):
            network = self._new(start, rows)
            optimizer = torch.optim.AdamW(
                [
                    {
                        "params": list(network.parameters()),
                        "largest": _RATE if start is None else _RATE / 3,
                    }
                ],
                weight_decay=0.02,
            )
            order: list[int] = []
            network.train()
            for step in range(total):
                if len(order) < _BATCH:
                    order += generator.permutation(rows).tolist()
                batch = np.array(order[:_BATCH])
                del order[:_BATCH]
                slow_down(optimizer, to=one_cycle((step + 0.5) / total, least=0.0))
                descend(self._loss(network, batch, generator), optimizer)
                self.told(EyesEvent(f"learning where things are{_say(place)}", step + 1, total))
        return network.eval()

    def _new(self, start: CentreMap | None, rows: Rows) -> CentreMap:
        network = untrained(self.backbone)
        if start is not None:
            network.load_state_dict(start.state_dict())
            return network
        some = rows[: 64 * max(1, len(rows) // 64) : max(1, len(rows) // 64)]
        network.standardise_by(self.views.some(some, np.zeros_like(some)))
        return network

    def _loss(
        self, network: CentreMap, batch: Rows, generator: np.random.Generator
    ) -> torch.Tensor:
        views = generator.integers(0, self.views.fine.shape[1], len(batch))
        predicted = network(self.views.some(batch, views))
        boxes = [self.views.boxes[n][view] / STRIDE for n, view in zip(batch, views, strict=True)]
        targets = targets_of(boxes, predicted.centres.shape[-2:])
        return centre_loss(predicted.centres, targets.centres) + box_loss(
            predicted.boxes, targets.boxes, targets.weights
        )


def _say(place: tuple[object, ...]) -> str:
    return "" if place == ("all",) else ", judged by others"
