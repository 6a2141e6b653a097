"""A detector of the user's own: a Python function, or a network in an ONNX file.

What it gives is checked, and how long it takes is bounded: a detector that fails, hangs or returns
what are no boxes is said to do so in one sentence.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from seewhy.errors import DomainError, ModelError
from seewhy.perception.backbones.frozen import IMAGENET_MEAN, IMAGENET_SCALE
from seewhy.perception.things.boxes import none_twice
from seewhy.perception.things.detector import Detected, Detector, padded, scaled

__all__ = ["Find", "FunctionDetector", "NoDetector", "OnnxDetector", "as_detector"]

Find = Callable[[npt.NDArray[np.uint8]], tuple[Any, Any]]
"""A picture of shape (rows, columns, 3) → boxes of shape (n, 4), in its pixels, and n scores."""

SECONDS = 60.0
"""How long a detector may look at one picture."""

_MOST = 10_000
_MEAN, _SCALE = np.array(IMAGENET_MEAN), np.array(IMAGENET_SCALE)
_KEPT = 200
_SIDE = 640  # of pictures shown to a network whose file names none
_TWICE = 0.9  # a detector of one's own has done away with what it found twice; but for the same box


class FunctionDetector:
    """Boxes that a function finds.

    Parameters
    ----------
    find : callable
        Takes a picture as an array of uint8, shape (rows, columns, 3); returns boxes (left, top,
        right and bottom in its pixels), shape (n, 4), and as many scores between 0 and 1.
    name : str, optional
        What errors call it.
    seconds : float
        How long it may take for a picture.

    Examples
    --------
    >>> whole = FunctionDetector(lambda picture: ([[0, 0, *picture.shape[1::-1]]], [0.9]))
    >>> whole.find(Image.new("RGB", (40, 20))).boxes.tolist()
    [[0.0, 0.0, 40.0, 20.0]]
    """

    def __init__(self, find: Find, *, name: str | None = None, seconds: float = SECONDS) -> None:
        self.name = name or str(getattr(find, "__qualname__", "the detector"))
        self.seconds = seconds
        self._find = find

    def find(self, image: Image.Image) -> Detected:
        """Return what may be things.

        Raises
        ------
        ModelError
            If it fails, takes too long, or returns what are no boxes with scores.
        """
        return checked(self._in_time(np.array(image)), image.size, name=self.name)

    def _in_time(self, picture: npt.NDArray[np.uint8]) -> Any:
        found: list[Any] = []
        failed: list[Exception] = []

        def look() -> None:
            try:
                found.append(self._find(picture))
            except Exception as problem:
                failed.append(problem)

        thread = threading.Thread(target=look, daemon=True)
        thread.start()
        thread.join(self.seconds)
        if failed:
            said = str(failed[0]).splitlines()[0] if str(failed[0]) else ""
            raise ModelError(
                f"the detector '{self.name}' fails ({type(failed[0]).__name__}: {said}): mend it, "
                "or give boxes"
            )
        if not found:
            raise ModelError(
                f"the detector '{self.name}' gave no answer within {self.seconds:g} seconds: use a "
                "faster one, or give boxes"
            )
        return found[0]


class OnnxDetector:
    """Boxes that a network in an ONNX file finds.

    It takes one picture of shape (1, 3, rows, columns), standardised as for ImageNet, with its
    longer side as long as the input's, at the top left of it. Its first output are boxes, of shape
    (n, 4) or (1, n, 4): left, top, right and bottom in pixels of the input; the second are their
    scores, of shape (n,) or (1, n).

    Parameters
    ----------
    file : Path
    seconds : float
        How long it may take for a picture.

    Raises
    ------
    DomainError
        onnxruntime is not installed, or there is no such file.
    ModelError
        The file is no such network.
    """

    def __init__(self, file: Path, *, seconds: float = SECONDS) -> None:
        try:
            import onnxruntime
        except ImportError:
            raise DomainError(
                f"detector '{file.name}' needs onnxruntime, which is not installed: pip install "
                "onnxruntime"
            ) from None
        if not file.is_file():
            raise DomainError(
                f"{file}: there is no such file, which is to find things; put it there"
            )
        self.file = file
        self.seconds = seconds
        self._onnxruntime: Any = onnxruntime
        options = onnxruntime.SessionOptions()
        options.log_severity_level = 4
        try:
            # From bytes, so that the file cannot name others to be read.
            self._session: Any = onnxruntime.InferenceSession(
                file.read_bytes(), options, providers=["CPUExecutionProvider"]
            )
            (taken,) = self._session.get_inputs()
            shape = list(taken.shape)
            if len(shape) != 4 or shape[1] != 3 or len(self._session.get_outputs()) < 2:
                raise ValueError(f"its input is of shape {shape}")
        except Exception as problem:
            said = str(problem).splitlines()[0] if str(problem) else type(problem).__name__
            raise ModelError(
                f"{file}: is no network that finds boxes: {said}; it must take pictures of shape "
                "(1, 3, rows, columns) and give boxes and scores"
            ) from None
        self._input = str(taken.name)
        self._rows, self._columns = (
            side if isinstance(side, int) and side > 0 else _SIDE for side in shape[2:]
        )

    def find(self, image: Image.Image) -> Detected:
        """Return what may be things.

        Raises
        ------
        ModelError
            If it fails, takes too long, or returns what are no boxes with scores.
        """
        fits = min(self._rows / image.height, self._columns / image.width)
        pixels, scale = scaled(image, max(1, round(max(image.size) * fits)))
        pixels = pixels[: self._rows, : self._columns]
        shown = padded(pixels, self._rows, self._columns).astype(np.float32)
        levels = ((shown - _MEAN) / _SCALE).astype(np.float32)
        options = self._onnxruntime.RunOptions()
        bell = threading.Timer(self.seconds, lambda: setattr(options, "terminate", True))
        bell.daemon = True
        bell.start()
        try:
            found = self._session.run(None, {self._input: levels.transpose(2, 0, 1)[None]}, options)
        except Exception as problem:
            said = str(problem).splitlines()[0] if str(problem) else type(problem).__name__
            late = f"gave no answer within {self.seconds:g} seconds"
            raise ModelError(
                f"the detector {self.file} {late if options.terminate else f'fails: {said}'}; mend "
                "it, or give boxes"
            ) from None
        finally:
            bell.cancel()
        boxes, scores = (np.asarray(output) for output in found[:2])
        boxes = boxes[0] if boxes.ndim == 3 and len(boxes) == 1 else boxes
        scores = scores[0] if scores.ndim == 2 and len(scores) == 1 else scores
        kept = checked((boxes, scores), pixels.shape[1::-1], name=str(self.file))
        return Detected(kept.boxes / scale, kept.scores)


class NoDetector:
    """Stands for a detector that somebody has to give again, because no file holds it."""

    def find(self, image: Image.Image) -> Detected:  # noqa: ARG002
        """Raise a ModelError."""
        raise ModelError(
            "the model was trained with a detector of its own; give it as detector=… in Python, or "
            "boxes with --things"
        )


def as_detector(detector: Detector | Find) -> Detector:
    """A detector as it is, or one of a function.

    Examples
    --------
    >>> as_detector(lambda picture: ([], [])).find(Image.new("RGB", (9, 9))).scores.shape
    (0,)
    """
    return detector if hasattr(detector, "find") else FunctionDetector(detector)


def checked(found: Any, size: tuple[int, ...], *, name: str) -> Detected:
    """What a detector returned, if it is boxes with scores; those that lie outside are cut.

    Raises
    ------
    ModelError
        If it is not; the text says what it is.
    """
    try:
        boxes, scores = (np.asarray(part, dtype=np.float64) for part in found)
    except (TypeError, ValueError):
        raise _nonsense(name, f"got {type(found).__name__}") from None
    boxes = boxes.reshape(0, 4) if not boxes.size else boxes
    scores = scores.reshape(-1) if not scores.size else scores
    if boxes.ndim != 2 or boxes.shape[1] != 4 or scores.shape != (len(boxes),):
        raise _nonsense(name, f"got shapes {boxes.shape} and {scores.shape}")
    if len(boxes) > _MOST:
        raise _nonsense(name, f"got {len(boxes):,} boxes, more than {_MOST:,}")
    if not (np.isfinite(boxes).all() and np.isfinite(scores).all()):
        raise _nonsense(name, "got what is no number")
    if len(scores) and not 0.0 <= scores.min() <= scores.max() <= 1.0:
        raise _nonsense(name, f"got scores from {scores.min():g} to {scores.max():g}")
    if (boxes[:, 2:] <= boxes[:, :2]).any():
        raise _nonsense(name, "got a box whose right is not more than its left, or bottom than top")
    boxes = np.stack([boxes[:, n].clip(0.0, float(size[n % 2])) for n in range(4)], axis=1).reshape(
        -1, 4
    )
    inside = ((boxes[:, 2:] - boxes[:, :2]) > 0.5).all(axis=1)
    boxes, scores = boxes[inside], scores[inside]
    best = np.argsort(-scores, kind="stable")[:_KEPT]
    kept = best[none_twice(boxes[best], scores[best], above=_TWICE)] if len(best) else best
    return Detected(boxes[kept], scores[kept])


def _nonsense(name: str, got: str) -> ModelError:
    return ModelError(
        f"the detector '{name}' must return boxes of shape (n, 4), left, top, right and bottom, "
        f"and n scores between 0 and 1; {got}"
    )
