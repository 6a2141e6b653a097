"""Which pictures are nearly the same: copies that were compressed again or scaled.

Every picture is described twice. Coarsely by its brightness in 16 × 16 and its colours in 4 × 4
cells, without their mean: two pictures are candidates where that differs by at most 10 % of what
it varies itself, and the means by at most 6 of 256 levels. What is plain (varies by less than one
level) is never a candidate. Then finely: the brightness in 64 × 64 cells may nowhere differ by
more than 8 levels (averaged over 3 × 3 cells), so that the same part in the same place with and
without a scratch are two pictures.

Thresholds were chosen on four sets (pairs called alike, of all pairs)::

    set                               pictures   alike   of these with different labels
    hands showing digits                 1,562       0                                0
    cards of SET, 81 classes             1,944      18                                0
    traffic signs of BelgiumTS           4,575       3                                0
    simulated structures                   300       0                                0

The three pairs of signs have the same pixels under two names each. The eighteen of cards (of 1.9
million pairs) are photographs of one card on one table, taken by a fixed camera a few seconds
apart; no two of a burst of signs are alike. Of copies compressed again (JPEG, quality 75 and
above) or scaled to half to one and a half of their size, at least 99 % are found in each of the
sets; of quality 50, 92 to 100 %; of those scaled by 0.75 and of quality 75, 80 to 100 %, and 53 %
of the signs, which are 30 to 96 pixels wide.

Hashes of 64 bits (difference hash, and the hash of cosines of the library ImageHash) were tried
on the same sets: with a threshold of 4 bits, which such copies need, they call 11,396 and 939
pairs of cards alike, of different colours among them, and 403 and 15 pairs of hands that show
different digits or other people's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from seewhy.data.reading_ahead import read_ahead

if TYPE_CHECKING:
    from PIL import Image

__all__ = ["Likeness", "alike_pairs", "described", "same_pixels"]

SIDE = 64
BRIGHTNESS = 16
COLOUR = 4

MOST_COARSE = 0.10
"""Of what a picture varies by; the largest coarse difference of two that are alike."""

MOST_MEAN = 6.0
MOST_FINE = 8.0
PLAIN = 1.0
"""Levels of 256."""

NEIGHBOURS = 8
"""A picture is compared with so many others at most, those that are coarsely most like it."""

DIRECTIONS = 12
"""Of the coarse description, what is searched by; the search misses nothing, it only narrows."""

SAMPLE = 5000
"""Pictures that settle the directions."""

REMEMBERED = 4096
"""Fine descriptions that are kept: 16 KiB each."""

Array = npt.NDArray[np.float32]

_OF_RGB = np.array(
    [[0.299, -0.1687, 0.5], [0.587, -0.3313, -0.4187], [0.114, 0.5, -0.0813]], dtype=np.float32
)
"""Red, green and blue to brightness and two colours, as JPEG has it."""


@dataclass(frozen=True)
class Likeness:
    """What is kept of every picture, in their order.

    Attributes
    ----------
    shape : ndarray of float16, shape (pictures, 288)
        Brightness and colours without their means, scaled so that the square of the length is
        the variance of both.
    means : ndarray of float32, shape (pictures, 3)
    """

    shape: npt.NDArray[np.float16]
    means: Array


def described(
    pictures: Sequence[Path], *, on_progress: Callable[[int], None] | None = None
) -> Likeness:
    """Read pictures, each once, and return what tells them apart.

    Parameters
    ----------
    pictures : sequence of Path
    on_progress : callable, optional
        Called with the number of pictures read so far.

    Raises
    ------
    PictureError
        If a file is not a picture.
    """
    shape = np.zeros((len(pictures), BRIGHTNESS**2 + 2 * COLOUR**2), dtype=np.float16)
    means = np.zeros((len(pictures), 3), dtype=np.float32)
    for number, (cells, mean) in enumerate(read_ahead(_coarse, pictures)):
        shape[number], means[number] = cells, mean
        if on_progress is not None:
            on_progress(number + 1)
    return Likeness(shape, means)


def _coarse(picture: Path) -> tuple[Array, Array]:
    channels = _channels(picture)
    means = channels.mean(axis=(0, 1))
    parts = []
    for channel, side in enumerate((BRIGHTNESS, COLOUR, COLOUR)):
        cells = channels[..., channel].reshape(side, SIDE // side, side, SIDE // side)
        parts.append((cells.mean(axis=(1, 3)) - means[channel]).ravel() / side)
    return np.concatenate(parts), means


def _channels(picture: Path) -> Array:
    """Brightness and the two colours, shape (64, 64, 3), in levels of 256."""
    from seewhy.perception.picture import read_picture

    pixels = read_picture(picture, size=SIDE, fit="stretch").astype(np.float32)
    return np.asarray(pixels @ _OF_RGB, dtype=np.float32)


@lru_cache(maxsize=REMEMBERED)
def _fine(picture: Path) -> tuple[Image.Image, int]:
    """The brightness of a picture, and its shorter side as it is in the file."""
    from PIL import Image

    from seewhy.perception.picture_file import open_picture

    brightness = Image.fromarray(_channels(picture)[..., 0])
    with open_picture(picture) as image:
        return brightness, min(image.size)


def alike_pairs(pictures: Sequence[Path], likeness: Likeness) -> list[tuple[int, int]]:
    """Return the pairs of positions of pictures that are nearly the same, the smaller first.

    Parameters
    ----------
    pictures : sequence of Path
        Those that ``likeness`` describes.
    likeness : Likeness
    """
    try:
        return sorted(
            pair
            for pair in _candidates(likeness)
            if _largest_difference(*(pictures[position] for position in pair)) <= MOST_FINE
        )
    finally:
        _fine.cache_clear()


def _candidates(likeness: Likeness) -> list[tuple[int, int]]:
    """Pairs that are coarsely alike."""
    from scipy.spatial import cKDTree

    shape = likeness.shape
    variation = np.concatenate([np.linalg.norm(part, axis=1) for part in _parts(shape)])
    varied = np.flatnonzero(variation >= PLAIN)
    if len(varied) < 2:
        return []
    # Two vectors are at least as far from each other, by the shorter, as their directions are.
    some = varied[:: max(1, len(varied) // SAMPLE)]
    sample = shape[some].astype(np.float32) / variation[some, None]
    axes = np.linalg.eigh(sample.T @ sample)[1][:, -DIRECTIONS:]
    along = np.concatenate([part @ axes for part in _parts(shape)])
    projected = along[varied] / variation[varied, None]
    many = min(NEIGHBOURS + 1, len(varied))
    found = cKDTree(projected).query(projected, k=many, distance_upper_bound=MOST_COARSE)
    near = np.asarray(found[1])
    rows, columns = np.nonzero(near < len(varied))
    first, second = varied[rows], varied[near[rows, columns]]
    apart = np.linalg.norm(shape[first].astype(np.float32) - shape[second], axis=1)
    close = (
        (first != second)
        & (apart <= MOST_COARSE * np.minimum(variation[first], variation[second]))
        & (np.abs(likeness.means[first] - likeness.means[second]).max(axis=1) <= MOST_MEAN)
    )
    pairs = zip(first[close].tolist(), second[close].tolist(), strict=True)
    return sorted({(min(pair), max(pair)) for pair in pairs})


def _parts(shape: npt.NDArray[np.float16]) -> Iterator[Array]:
    """Some thousand rows at a time: all of them in single precision would fill the memory."""
    for start in range(0, len(shape), SAMPLE):
        yield shape[start : start + SAMPLE].astype(np.float32)


def _largest_difference(first: Path, second: Path) -> float:
    """The largest difference in brightness, averaged over 3 × 3 cells.

    The smaller of the two settles how many cells there are: it holds no more than it has pixels.
    """
    from PIL import Image
    from scipy.ndimage import uniform_filter

    (one, one_side), (other, other_side) = _fine(first), _fine(second)
    side = min(SIDE, one_side, other_side)
    ours, theirs = (
        np.asarray(picture.resize((side, side), Image.Resampling.BICUBIC))
        for picture in (one, other)
    )
    apart = (ours - ours.mean()) - (theirs - theirs.mean())
    return float(np.abs(uniform_filter(apart, size=3, mode="nearest")).max())


def same_pixels(first: Path, second: Path) -> bool:
    """Whether two files that are pictures show the same in every pixel.

    Examples
    --------
    >>> import tempfile
    >>> from PIL import Image
    >>> folder = Path(tempfile.mkdtemp())
    >>> Image.new("RGB", (9, 9), "red").save(folder / "a.png")
    >>> Image.new("RGB", (9, 9), "red").save(folder / "a.bmp")
    >>> same_pixels(folder / "a.png", folder / "a.bmp")
    True
    """
    from seewhy.perception.pixels_digest import pixels_digest

    return pixels_digest(first) == pixels_digest(second)
