"""How like a picture is to pictures of training: what networks see for the first time is not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import numpy.typing as npt
from pydantic import Field, model_validator

from seewhy.errors import ModelError
from seewhy.files.json_file import Strict
from seewhy.perception.matrix_product import matrix_product
from seewhy.perception.weights import REMEDY, Described, check_tensors, read_weights, write_weights
from seewhy.text.visible import visible

__all__ = [
    "FAMILIARITY",
    "MOST",
    "Familiarity",
    "Known",
    "NearPicture",
    "TrainingPicture",
    "fit_familiarity",
]

FAMILIARITY = "familiarity.json"
WEIGHTS = "familiarity.safetensors"
FORMAT = 1

KEPT = 25  # pictures of each distinct feature vector
MOST = 4000  # of all together, so that a picture is compared in a fraction of a millisecond
_AT_ONCE = 256  # pictures compared in one matrix product

Embeddings = npt.NDArray[np.float32]


@dataclass(frozen=True)
class TrainingPicture:
    """A picture of training, to be named where another is like it.

    Attributes
    ----------
    name : str
        Its path from the dataset's folder.
    label : str or None
        The annotated class.
    features : dict of str to str
        Feature → annotated value, of the features that were annotated.
    """

    name: str
    label: str | None
    features: dict[str, str]


@dataclass(frozen=True)
class NearPicture:
    """A picture of training, and how like it another is.

    Attributes
    ----------
    picture : TrainingPicture
    likeness : float
        Cosine between what is made of the two, 0 (nothing in common) to 1.
    """

    picture: TrainingPicture
    likeness: float

    def to_text(self) -> str:
        """Return it as a line: the picture, its likeness, and what is annotated of it.

        Examples
        --------
        >>> tile = TrainingPicture("images/7.png", "bad", {"colour": "blue", "round": "no"})
        >>> NearPicture(tile, 0.925).to_text()
        'images/7.png (0.93): bad; colour blue, round no'
        """
        picture = self.picture
        told = ", ".join(f"{name} {value}" for name, value in picture.features.items())
        annotated = "; ".join(part for part in (picture.label, told) if part)
        annotated = annotated or "nothing annotated"
        return f"{picture.name} ({self.likeness:.2f}): {annotated}"

    def to_dict(self) -> dict[str, Any]:
        """Return it as values that JSON can hold."""
        return {
            "picture": self.picture.name,
            "likeness": round(self.likeness, 4),
            "class": self.picture.label,
            "features": dict(self.picture.features),
        }


@dataclass(frozen=True, eq=False)
class Known:
    """What one feature's network makes of training pictures.

    Attributes
    ----------
    directions : ndarray of float16, shape (n, width of the dense layer)
        The pictures' embeddings, each of length 1, those of one value beside each other.
    values : tuple of str
        The values that the pictures show, in the order of ``directions``.
    counts : tuple of int
        How many of the pictures show each.
    pictures : tuple of TrainingPicture
        Which pictures they are, in the order of ``directions``; none where that is not kept.
    """

    directions: npt.NDArray[np.float16]
    values: tuple[str, ...]
    counts: tuple[int, ...]
    pictures: tuple[TrainingPicture, ...] = ()

    @property
    def weight(self) -> int:
        """How much the feature counts: the number of its values, less one, but at least 1."""
        return max(1, len(self.values) - 1)

    @cached_property
    def _exact(self) -> Embeddings:
        """Of length 1 in spite of the rounding, and in the precision that is fast."""
        return _directions(self.directions)

    def likeness(self, embeddings: Embeddings, values: Sequence[str]) -> npt.NDArray[np.float64]:
        """Cosine between each picture and the nearest one of training with the same value.

        Parameters
        ----------
        embeddings : ndarray of float, shape (n, width of the dense layer)
        values : sequence of str, length n
            0 is returned for a value that no picture of training shows.

        Returns
        -------
        ndarray of float, shape (n,)
            0 (nothing in common) to 1.
        """
        place = {value: n for n, value in enumerate(self.values)}
        # A further column of zeros stands for the values that no picture shows.
        chosen = np.array([place.get(value, len(place)) for value in values], dtype=np.intp)
        nearest = np.zeros((len(values), len(place) + 1), dtype=np.float32)
        starts = np.cumsum((0, *self.counts[:-1]))
        for start in range(0, len(values), _AT_ONCE):
            part = slice(start, start + _AT_ONCE)
            cosines = matrix_product(_directions(embeddings[part]), self._exact.T)
            nearest[part, :-1] = np.maximum.reduceat(cosines, starts, axis=1).clip(max=1)
        return nearest[np.arange(len(values)), chosen].astype(np.float64)

    def nearest(self, embedding: Embeddings, *, count: int) -> tuple[NearPicture, ...]:
        """Return the pictures of training that are most like one, the most alike first.

        Parameters
        ----------
        embedding : ndarray of float, shape (width of the dense layer,)
        count : int
            At most so many; none where it is not kept which pictures they are.
        """
        if not self.pictures:
            return ()
        cosines = matrix_product(_directions(embedding[None]), self._exact.T)[0].clip(0, 1)
        order = np.argsort(-cosines, kind="stable")[:count]
        return tuple(NearPicture(self.pictures[n], float(cosines[n])) for n in order)


class Familiarity:
    """Compares pictures with those of training; made by :func:`fit_familiarity` or :meth:`load`.

    A network is sure of things it never saw; what it makes of them before it decides is far from
    what it made of the training pictures all the same. A picture's likeness is, for each feature,
    the cosine between the dense layer's outputs for it and for the nearest training picture that
    shows the value read. The features' mean is weighted by their numbers of values less one: a
    network that tells many values apart looks closer.

    Where eyes see, there is one embedding for the whole picture instead of one for each feature,
    and the cosine is nearly a distance: see :meth:`seewhy.perception.eyes.Eyes.familiar_by`.

    Departure from the paper, which answers every picture. After Sun, Ming, Zhu and Li (2022),
    "Out-of-distribution detection with deep nearest neighbors"; here for several networks, and
    among the pictures of the value that was read.

    Parameters
    ----------
    known : mapping of str to Known
        By feature; or, of the whole picture, under :data:`seewhy.perception.eyes.SCENE`.
    """

    def __init__(self, known: Mapping[str, Known]) -> None:
        self.known = dict(known)

    def likeness(
        self, embeddings: Mapping[str, Embeddings], values: Mapping[str, Sequence[str]]
    ) -> npt.NDArray[np.float64]:
        """Return how like pictures are to those of training, 0 to 1.

        Parameters
        ----------
        embeddings : mapping of str to ndarray of float, shape (n, width of the dense layer)
            See :meth:`seewhy.perception.extractor.FeatureExtractor.embeddings`.
        values : mapping of str to sequence of str, length n
            The value read of every feature.

        Returns
        -------
        ndarray of float, shape (n,)
        """
        likenesses = [
            known.likeness(embeddings[key], values[key]) for key, known in self.known.items()
        ]
        weights = [known.weight for known in self.known.values()]
        mean: npt.NDArray[np.float64] = np.average(likenesses, axis=0, weights=weights)
        return mean

    def save(self, folder: Path | str) -> None:
        """Write ``familiarity.safetensors`` and ``familiarity.json`` into ``folder``."""
        import torch

        description = _Description(
            format=FORMAT,
            digest="",
            features={
                name: _Feature(values=known.values, counts=known.counts, pictures=known.pictures)
                for name, known in self.known.items()
            },
        )
        tensors = {name: torch.from_numpy(known.directions) for name, known in self.known.items()}
        write_weights(
            tensors,
            description,
            weights=Path(folder) / WEIGHTS,
            described=Path(folder) / FAMILIARITY,
        )

    @classmethod
    def load(cls, folder: Path | str, *, widths: Mapping[str, int]) -> Familiarity:
        """Read what :meth:`save` wrote.

        Parameters
        ----------
        folder : Path or str
        widths : mapping of str to int
            How many numbers each of the embeddings has that what sees makes of a picture.

        Raises
        ------
        ModelError
            A file is missing, damaged, or does not belong to the other; the text names it.
        """
        weights, described = Path(folder) / WEIGHTS, Path(folder) / FAMILIARITY
        description, tensors = read_weights(
            _Description, number=FORMAT, weights=weights, described=described
        )
        import torch

        unseen = next((name for name in description.features if name not in widths), None)
        if unseen is not None:
            raise ModelError(
                f"{described} is damaged ({visible(unseen)}: nothing sees it): {REMEDY}"
            )
        expected = {
            name: torch.empty(sum(feature.counts), widths[name], dtype=torch.float16, device="meta")
            for name, feature in description.features.items()
        }
        check_tensors(tensors, expected, weights=weights, described=described)
        return cls(
            {
                name: Known(tensors[name].numpy(), feature.values, feature.counts, feature.pictures)
                for name, feature in description.features.items()
            }
        )


def fit_familiarity(
    embeddings: Mapping[str, Embeddings],
    labels: Mapping[str, Sequence[str | None]],
    *,
    seed: int = 0,
    kept: int = KEPT,
    most: int = MOST,
    pictures: Sequence[TrainingPicture] = (),
) -> Familiarity:
    """Keep what the networks make of training pictures.

    Parameters
    ----------
    embeddings : mapping of str to ndarray of float, shape (n, width of the dense layer)
        Of pictures that the networks were trained on.
    labels : mapping of str to sequence of str or None, length n
        Each feature's value in each picture; None where it is unknown.
    seed : int, default 0
        Draws the pictures that are kept.
    kept, most : int, default 25 and 4000
        At most so many pictures of each distinct combination of labels, and in all.
    pictures : sequence of TrainingPicture, length n, optional
        Which pictures they are, to be kept with them.

    Examples
    --------
    >>> trained = {"light": np.array([[2.0, 0.1], [0.0, 3.0]], dtype=np.float32)}
    >>> familiarity = fit_familiarity(trained, {"light": ["on", "off"]})
    >>> shown = {"light": np.array([[4.0, 0.1], [4.0, 0.1]], dtype=np.float32)}
    >>> familiarity.likeness(shown, {"light": ["on", "off"]}).round(2).tolist()
    [1.0, 0.02]
    """
    chosen = _drawn(list(zip(*labels.values(), strict=True)), seed=seed, kept=kept, most=most)
    known = {}
    for name, column in labels.items():
        by_value: dict[str, list[int]] = {}
        for n in chosen:
            value = column[n]
            if value is not None:
                by_value.setdefault(value, []).append(n)
        if not by_value:
            continue
        order = sorted(by_value)
        rows = [n for value in order for n in by_value[value]]
        known[name] = Known(
            _directions(embeddings[name][rows]).astype(np.float16),
            tuple(order),
            tuple(len(by_value[value]) for value in order),
            tuple(pictures[n] for n in rows) if pictures else (),
        )
    # A network with nothing to tell apart has learned to see nothing.
    told = {name: of_feature for name, of_feature in known.items() if len(of_feature.values) > 1}
    return Familiarity(told or known)


def _drawn(vectors: Sequence[object], *, seed: int, kept: int, most: int) -> list[int]:
    """Positions of at most ``most`` pictures: one of every vector, then a second of each, …"""
    turns: dict[object, int] = {}
    ranked = []
    for place, n in enumerate(np.random.default_rng(seed).permutation(len(vectors)).tolist()):
        turn = turns[vectors[n]] = turns.get(vectors[n], 0) + 1
        if turn <= kept:
            ranked.append((turn, place, n))
    return sorted(n for _, _, n in sorted(ranked)[:most])


def _directions(embeddings: npt.NDArray[np.floating]) -> Embeddings:
    """Embeddings of length 1; those of length 0 stay."""
    single = embeddings.astype(np.float32)
    lengths = np.linalg.norm(single, axis=1, keepdims=True)
    lengths[lengths == 0] = 1
    directions: Embeddings = single / lengths
    return directions


class _Feature(Strict):
    values: Annotated[tuple[str, ...], Field(min_length=1)]
    counts: tuple[Annotated[int, Field(ge=1, le=MOST)], ...]
    pictures: tuple[TrainingPicture, ...] = ()

    @model_validator(mode="after")
    def _as_many(self) -> _Feature:
        if len(self.counts) != len(self.values):
            raise ValueError("there must be as many counts as values")
        if len(self.pictures) not in (0, sum(self.counts)):
            raise ValueError("there must be as many pictures as are counted")
        return self


class _Description(Described):
    """The JSON beside the embeddings."""

    features: Annotated[dict[str, _Feature], Field(min_length=1)]
