"""Where in a picture each feature is seen: what is hidden there changes what is read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import numpy.typing as npt

from seewhy.errors import DatasetError
from seewhy.text.nearest import did_you_mean

if TYPE_CHECKING:
    from PIL import Image

    from seewhy.perception.extractor import Seen
    from seewhy.perception.picture import Fit

__all__ = ["ACROSS", "MATTERS", "Seeing", "Where", "filled_in", "find_where"]

ACROSS = 7
"""So many windows lie side by side, each half over the next: 49 hidden copies in all."""

MATTERS = 0.01
"""Where no window that is hidden takes so much from the probability, no place is marked."""

_FAR = 1e-4  # what is far away counts this little, but not nothing
_CELLS = 32  # squares each way in which a map is told
_LINE = 0.5  # an overlay has a line around all that counts half as much as the best place
_PLACES = (
    ("in the upper left", "at the top", "in the upper right"),
    ("on the left", "in the middle", "on the right"),
    ("in the lower left", "at the bottom", "in the lower right"),
)
_RED = (214.0, 39.0, 40.0)

Picture = npt.NDArray[np.uint8]
Map = npt.NDArray[np.float32]
Masks = npt.NDArray[np.float32]


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

    @property
    def place(self) -> str:
        """The place that counts most, in words.

        The middle of the map's mass tells it, in thirds of the picture; a map of which more than
        half counts at least half as much as its best place has no place.

        Examples
        --------
        >>> corner = np.zeros((9, 9), dtype=np.float32)
        >>> corner[:3, 6:] = 1
        >>> Where("lean", "yes", 0.98, 0.61, corner).place
        'in the upper right'
        >>> Where("lean", "yes", 0.98, 0.61, np.ones((9, 9), dtype=np.float32)).place
        'all over the picture'
        """
        if (self.map >= _LINE).mean() > _LINE:
            return "all over the picture"
        mass = np.where(self.map >= _LINE, self.map, 0.0).astype(np.float64)
        if not mass.any():
            return "all over the picture"
        side = len(self.map)
        middles = (np.arange(side) + 0.5) / side
        down = float((mass.sum(axis=1) * middles).sum() / mass.sum())
        across = float((mass.sum(axis=0) * middles).sum() / mass.sum())
        return _PLACES[min(int(3 * down), 2)][min(int(3 * across), 2)]

    def to_text(self) -> str:
        """Return in words how much the marked place matters.

        Examples
        --------
        >>> Where("lean", "yes", 0.98, 0.61, np.ones((8, 8), dtype=np.float32)).to_text()
        'hiding the marked place takes 0.61 of p = 0.98'
        >>> Where("lean", "yes", 0.98, 0.002, np.zeros((8, 8), dtype=np.float32)).to_text()
        'no single place matters: hiding one takes at most 0.00 of p = 0.98'
        """
        whole = f"p = {self.probability:.2f}"
        if self.matters:
            return f"hiding the marked place takes {self.lost:.2f} of {whole}"
        return f"no single place matters: hiding one takes at most {self.lost:.2f} of {whole}"

    def picture(
        self,
        image: Path | str | Image.Image | npt.NDArray[np.generic],
        *,
        side: int = 224,
        fit: Fit = "pad",
    ) -> Image.Image:
        """Return the picture with a line around what matters most; the rest is pale.

        Parameters
        ----------
        image : path, Pillow image or array
            The picture that the map is of.
        side : int, default 224
            Of the result, in pixels.
        fit : {"pad", "stretch"}, default "pad"
            How a picture that is not square became one when it was seen.

        Raises
        ------
        PictureError
            If the image is no picture.
        """
        from PIL import Image as Images

        from seewhy.perception.picture import as_picture

        pixels = as_picture(image, size=side, fit=fit).astype(np.float32)
        shares = np.asarray(
            Images.fromarray(self.map).resize((side, side), Images.Resampling.BICUBIC)
        ).clip(0, 1)
        pale = 0.35 * pixels.mean(axis=2, keepdims=True) + 0.65 * 255.0
        clear = (shares / _LINE).clip(0, 1)[:, :, None]
        shown = pale + clear * (pixels - pale)
        shown[_rim(shares >= _LINE)] = _RED
        return Images.fromarray(shown.round().astype(np.uint8))

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


def find_where(seeing: Seeing, picture: Picture, values: Mapping[str, str]) -> dict[str, Where]:
    """Return where in a picture values of features are seen.

    Windows that cover the picture are hidden one after the other, each behind what surrounds it
    (:func:`filled_in`); what a value's probability loses is laid on the window, the more the
    nearer to its middle. All features share the hidden copies, which are seen in one batch.

    Parameters
    ----------
    seeing : Seeing
        Eyes or networks.
    picture : ndarray of uint8, shape (size, size, 3)
        As :func:`seewhy.perception.picture.as_picture` makes it, of the side that is seen.
    values : mapping of str to str
        Feature, or "class" → the value that is asked for.

    Returns
    -------
    dict of str to Where
        By feature, in the order of ``values``.

    Raises
    ------
    DatasetError
        The picture has another shape or type, or nothing sees a feature or a value.

    Notes
    -----
    Sources: Zeiler and Fergus (2014), "Visualizing and understanding convolutional networks",
    section 4.2, and Petsiuk, Das and Saenko (2018), "RISE". Departures: windows overlap by half
    and stand in rows, instead of a grey square that slides by pixels (thousands of passes) or of
    masks drawn at random (noise with so few). A place is filled with what surrounds it instead
    of grey or black, which was more faithful, as is counting what the probability loses and not
    its log-odds (docs/where.md). A map says nothing where nothing matters. What is seen by two
    places far from each other is found by neither source nor here: hiding one changes nothing.

    Examples
    --------
    What sees whether the left half is bright, marks the left half:

    >>> from seewhy.perception.extractor import Seen
    >>> class LeftHalf:
    ...     size, values = 32, {"light": ("off", "on")}
    ...     def see(self, pictures):
    ...         on = pictures[:, :, :16].mean(axis=(1, 2, 3)) / 255
    ...         return Seen({"light": np.stack([1 - on, on], axis=1)}, {})
    >>> picture = np.zeros((32, 32, 3), dtype=np.uint8)
    >>> picture[10:20, 4:12] = 255
    >>> found = find_where(LeftHalf(), picture, {"light": "on"})["light"]
    >>> found.matters, [int(n) for n in np.unravel_index(found.map.argmax(), found.map.shape)]
    (True, [15, 8])
    """
    _check(seeing, picture, values)
    windows, weights = _windows(seeing.size)
    copies = np.concatenate([picture[None], filled_in(picture, windows)])
    seen = seeing.see(copies).probabilities
    found = {}
    for feature, value in values.items():
        column = seen[feature][:, list(seeing.values[feature]).index(value)]
        losses = column[0] - column[1:]
        lost = max(0.0, float(losses.max()))
        marked = np.zeros((seeing.size, seeing.size), dtype=np.float32)
        if lost >= MATTERS:
            marked += np.tensordot(losses, weights, axes=1).clip(min=0)
            marked /= max(float(marked.max()), _FAR)
        found[feature] = Where(feature, value, float(column[0]), lost, marked)
    return found


def filled_in(picture: Picture, masks: Masks) -> Picture:
    """Return copies of a picture, in each of which a place is hidden behind what surrounds it.

    Every hidden pixel becomes the mean of the others, those nearby counting more (as a Gaussian
    with a twelfth of the side has it).

    Parameters
    ----------
    picture : ndarray of uint8, shape (size, size, 3)
    masks : ndarray of float32, shape (n, size, size)
        1 where a copy is hidden, 0 where it is not.

    Returns
    -------
    ndarray of uint8, shape (n, size, size, 3)

    Examples
    --------
    >>> picture = np.full((16, 16, 3), 80, dtype=np.uint8)
    >>> picture[4:8, 4:8] = 250
    >>> mask = np.zeros((1, 16, 16), dtype=np.float32)
    >>> mask[0, 4:8, 4:8] = 1
    >>> np.unique(filled_in(picture, mask)).tolist()
    [80]
    """
    at = np.arange(len(picture), dtype=np.float32)
    far = (at[:, None] - at[None, :]) / (len(picture) / 12)
    spread = np.exp(-0.5 * far**2) + _FAR
    kept = 1.0 - masks
    around = np.maximum(spread @ kept @ spread, _FAR**2)
    filled = np.empty((*masks.shape, 3), dtype=np.uint8)
    for channel in range(3):
        pixels = picture[:, :, channel].astype(np.float32)
        mean = (spread @ (kept * pixels) @ spread) / around
        filled[..., channel] = (kept * pixels + masks * mean).round()
    return filled


def _windows(size: int) -> tuple[Masks, Masks]:
    """The windows as masks, and how much what each loses counts at every place.

    Both of shape (windows, size, size); at every place the latter add up to 1.
    """
    step = size / (ACROSS + 1)
    places = np.arange(size) + 0.5
    middles = step * np.arange(1, ACROSS + 1)
    far = np.abs(places[None, :] - middles[:, None]) / step
    hidden = (far <= 1.0).astype(np.float32)
    # The margins are near to the middle of no window: there its outer parts count, too.
    near = (0.5 + 0.5 * np.cos(np.pi * far.clip(max=1.0)) + _FAR).astype(np.float32)
    near /= near.sum(axis=0)
    masks, weights = (
        np.einsum("iy,jx->ijyx", rows, rows).reshape(-1, size, size) for rows in (hidden, near)
    )
    return masks, weights


def _rim(inside: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """The outermost pixels, two deep, of a region."""
    core = np.pad(inside, 2, mode="edge")
    for axis in (0, 1):
        core = core & np.roll(core, 1, axis) & np.roll(core, -1, axis)
        core = core & np.roll(core, 1, axis) & np.roll(core, -1, axis)
    return inside & ~core[2:-2, 2:-2]


def _check(seeing: Seeing, picture: Picture, values: Mapping[str, str]) -> None:
    side = seeing.size
    if picture.dtype != np.uint8 or picture.shape != (side, side, 3):
        raise DatasetError(
            f"the picture must be uint8 of shape ({side}, {side}, 3), got {picture.dtype} of "
            f"shape {picture.shape}: make it with as_picture"
        )
    for feature, value in values.items():
        if feature not in seeing.values:
            raise DatasetError(
                f"nothing sees '{feature}'; {did_you_mean(feature, list(seeing.values))}"
            )
        if value not in seeing.values[feature]:
            raise DatasetError(
                f"'{value}' is no value of '{feature}'; "
                f"{did_you_mean(value, list(seeing.values[feature]))}"
            )
