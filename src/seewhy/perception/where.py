"""Where in a picture each feature is seen: what is hidden there changes what is read."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import numpy.typing as npt

from seewhy.errors import DatasetError

if TYPE_CHECKING:
    from PIL import Image

    from seewhy.perception.extractor import Seen

__all__ = ["ACROSS", "MATTERS", "Seeing", "Where", "find_where", "filled_in"]

ACROSS = 7
"""So many windows lie side by side, each half over the next: 49 hidden copies in all."""

MATTERS = 0.05
"""Where no window that is hidden takes so much from the probability, no place is marked."""

_SURE = 1e-6  # nobody is surer than that, and logarithms stay finite
_CELLS = 32  # an overlay is told in so many squares each way by to_dict
_RED = np.array([214.0, 39.0, 40.0], dtype=np.float32)

Picture = npt.NDArray[np.uint8]
Map = npt.NDArray[np.float32]
Masks = npt.NDArray[np.float32]
Hide = Callable[[Picture, Masks], Picture]


class Seeing(Protocol):
    """What sees features: :class:`~seewhy.perception.eyes.Eyes` or the paper's networks."""

    @property
    def size(self) -> int:
        """Side of the pictures, in pixels."""

    @property
    def values(self) -> Mapping[str, Sequence[str]]:
        """The values of each feature, in the order of the probabilities."""

    def see(self, pictures: Picture) -> Seen:
        """Probabilities of each feature's values."""


@dataclass(frozen=True, eq=False)
class Where:
    """Where in a picture a value of a feature is seen.

    Attributes
    ----------
    feature : str
        A feature of the domain, or "class".
    value : str
        The value whose probability is looked at.
    probability : float
        Of that value in the whole picture, 0 to 1.
    lost : float
        The largest part of it that hiding one window took away, 0 to 1.
    map : ndarray of float32, shape (size, size)
        How much each place counts, 0 (nothing) to 1 (most of all); all 0 where no place does.
    """

    feature: str
    value: str
    probability: float
    lost: float
    map: Map

    @property
    def matters(self) -> bool:
        """Whether some place matters, so that the map marks it."""
        return self.lost >= MATTERS

    def to_text(self) -> str:
        """Return in words how much the marked place matters.

        Examples
        --------
        >>> Where("lean", "yes", 0.98, 0.61, np.ones((8, 8), dtype=np.float32)).to_text()
        'hiding the marked place takes 0.61 of p = 0.98'
        >>> Where("lean", "yes", 0.98, 0.01, np.zeros((8, 8), dtype=np.float32)).to_text()
        'no single place matters: hiding one takes at most 0.01 of p = 0.98'
        """
        whole = f"p = {self.probability:.2f}"
        if self.matters:
            return f"hiding the marked place takes {self.lost:.2f} of {whole}"
        return f"no single place matters: hiding one takes at most {self.lost:.2f} of {whole}"

    def picture(self, image: Picture) -> Image.Image:
        """Return the picture, pale, with what matters in colour and ringed with red.

        Parameters
        ----------
        image : ndarray of uint8, shape (size, size, 3)
            The picture that the map is of.

        Raises
        ------
        DatasetError
            If it is of another shape than the map.
        """
        from PIL import Image as Images

        if image.shape != (*self.map.shape, 3):
            raise DatasetError(
                f"the picture must be of shape {(*self.map.shape, 3)} as the map is, got "
                f"{image.shape}: make it with as_picture"
            )
        pixels = image.astype(np.float32)
        grey = pixels.mean(axis=2, keepdims=True)
        pale = 0.45 * grey + 0.55 * 255.0
        share = self.map[:, :, None]
        shown = pale + np.sqrt(share) * (pixels - pale)
        shown += 0.35 * share * (_RED - shown)
        return Images.fromarray(shown.clip(0, 255).round().astype(np.uint8))

    def to_dict(self) -> dict[str, Any]:
        """Return it as values that JSON can hold, the map as rows of at most 32 by 32 squares.

        Examples
        --------
        >>> half = np.zeros((8, 8), dtype=np.float32)
        >>> half[:4] = 1
        >>> told = Where("lean", "yes", 0.98, 0.61, half).to_dict()
        >>> told["lost"], told["matters"], len(told["map"]), told["map"][3][:2]
        (0.61, True, 8, [1.0, 1.0])
        """
        side = len(self.map)
        edges = np.linspace(0, side, min(side, _CELLS) + 1).astype(int)
        counts = np.diff(edges)
        rows = np.add.reduceat(self.map.astype(np.float64), edges[:-1], axis=0)
        cells = np.add.reduceat(rows, edges[:-1], axis=1) / np.outer(counts, counts)
        return {
            "feature": self.feature,
            "value": self.value,
            "probability": round(self.probability, 4),
            "lost": round(self.lost, 4),
            "matters": self.matters,
            "map": [[round(float(cell), 3) for cell in row] for row in cells],
        }


def find_where(
    seeing: Seeing,
    picture: Picture,
    values: Mapping[str, str],
    *,
    hide: Hide | None = None,
    across: int = ACROSS,
) -> dict[str, Where]:
    hide = hide or filled_in
    windows, weights = _windows(seeing.size, across)
    copies = hide(picture, windows)
    seen = seeing.see(np.concatenate([picture[None], copies])).probabilities
    found = {}
    for feature, value in values.items():
        column = seen[feature][:, list(seeing.values[feature]).index(value)]
        odds = np.log(np.clip(column, _SURE, 1)) - np.log(np.clip(1 - column, _SURE, 1))
        lost = float(column[0] - column[1:].min())
        blurred = np.tensordot((odds[0] - odds[1:]).astype(np.float32), weights, axes=1)
        marked = blurred.clip(min=0)
        top = marked.max()
        found[feature] = Where(
            feature, value, float(column[0]), max(0.0, lost), marked / top if top > 0 else marked
        )
    return found


def _windows(size: int, across: int) -> tuple[Masks, Masks]:
    """The windows as masks, and how much each counts at every place (adding up to 1)."""
    step = size / (across + 1)
    at = np.arange(size) + 0.5
    # side 2 steps, starts k*step
    hard, soft = [], []
    for k in range(across):
        centre = (k + 1) * step
        far = np.abs(at - centre) / step
        hard.append((far <= 1.0).astype(np.float32))
        soft.append(np.where(far < 1, 0.5 + 0.5 * np.cos(np.pi * far.clip(max=1)), 0) + 1e-4)
    hard_ = np.array(hard)
    soft_ = np.array(soft)
    soft_ /= soft_.sum(axis=0)
    masks = np.einsum("iy,jx->ijyx", hard_, hard_).reshape(-1, size, size)
    weights = np.einsum("iy,jx->ijyx", soft_, soft_).reshape(-1, size, size)
    return masks.astype(np.float32), weights.astype(np.float32)


def filled_in(picture: Picture, masks: Masks) -> Picture:
    """Copies of a picture, each with a place hidden behind what surrounds it."""
    size = len(picture)
    at = np.arange(size, dtype=np.float32)

    def gauss(sigma: float) -> Masks:
        return np.exp(-0.5 * ((at[:, None] - at[None]) / sigma) ** 2) + 1e-9

    spread = gauss(size / 12)
    kept = 1.0 - masks
    pixels = picture.astype(np.float32)
    weight = spread @ kept @ spread
    out = np.empty((len(masks), size, size, 3), dtype=np.uint8)
    for channel in range(3):
        mean = (spread @ (kept * pixels[:, :, channel]) @ spread) / weight
        out[..., channel] = (kept * pixels[:, :, channel] + masks * mean).round().clip(0, 255)
    return out
