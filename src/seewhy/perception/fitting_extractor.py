"""Train the networks that see a domain's features: each by itself, or some together."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from copy import deepcopy
from dataclasses import replace

import torch

from seewhy.errors import DatasetError
from seewhy.perception.course import QUIETLY, Course
from seewhy.perception.extractor import FeatureExtractor, checked_pictures
from seewhy.perception.joint_training import train_jointly
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.labels import labelled
from seewhy.perception.network import GrowingNetwork, deepest
from seewhy.perception.new_network import new_network
from seewhy.perception.options import TrainingOptions
from seewhy.perception.parallel import train_networks
from seewhy.perception.randomness import seeded
from seewhy.perception.rehearsal import Rehearsal

__all__ = ["fit_extractor"]


def fit_extractor(
    shown: LabelledPictures,
    *,
    options: TrainingOptions | Mapping[str, TrainingOptions] | None = None,
    start_from: FeatureExtractor | None = None,
    rehearsal: Rehearsal | None = None,
    together: Collection[str] = (),
    course: Course = QUIETLY,
) -> FeatureExtractor:
    """Train one network for each feature.

    Parameters
    ----------
    shown : LabelledPictures
        The pictures, with what is to be seen in them.
    options : TrainingOptions or mapping of str to TrainingOptions, optional
        For all features, or for each (the defaults for those without).
    start_from : FeatureExtractor, optional
        Earlier networks to train on instead of growing new ones. Features that it lacks, or whose
        values are as many others there, grow.
    rehearsal : Rehearsal, optional
        Pictures that ``start_from`` was trained on, to go over again.
    together : collection of str
        The features whose networks are trained together, to tell annotated feature vectors apart;
        see :func:`seewhy.perception.joint_training.train_jointly`. Those that have to grow are
        trained by themselves before.
    course : Course
        How the training is run. ``on_progress`` is called with a
        :class:`seewhy.perception.events.TrainingEvent` after every epoch.

    Returns
    -------
    FeatureExtractor

    Raises
    ------
    DatasetError
        The pictures or labels do not fit together, or a feature has no label at all.

    Notes
    -----
    Source: Riley and Sridharan (2019), feature extraction; the departures are listed at
    :class:`~seewhy.perception.network.GrowingNetwork` and
    :func:`~seewhy.perception.training.train_network`.

    Examples
    --------
    >>> import numpy as np
    >>> pictures = np.zeros((40, 16, 16, 3), dtype=np.uint8)
    >>> pictures[::2] = 200
    >>> shown = LabelledPictures(
    ...     pictures, {"light": ["on", "off"] * 20}, {"light": ["on", "off"]}
    ... )
    >>> extractor = fit_extractor(shown)
    >>> bool(extractor.probabilities(pictures[:1])["light"][0, 0] > 0.8)
    True
    """
    shown = _learnable(shown)
    labels, values = shown.labels, shown.values
    chosen = {
        name: options
        if isinstance(options, TrainingOptions)
        else (options or {}).get(name, TrainingOptions())
        for name in labels
    }
    earlier = {} if start_from is None else _fitting(start_from, values)
    shared = shown.of_features(together)
    ready = _ready(shared, chosen, earlier)
    trained = train_networks(
        shown.of_features(labels.keys() - ready.keys()),
        options=chosen,
        start_from=earlier,
        rehearsal=rehearsal,
        course=course,
    )
    grown = {name: trained[name][0] for name in shared.labels if name in trained}
    joint = ready | {name: network for name, network in grown.items() if trained[name][1].epochs}
    if joint:
        trained |= train_jointly(
            {name: joint[name] for name in shared.labels if name in joint},
            shared,
            options=chosen,
            fine_tune=joint != ready or bool(earlier),
            rehearsal=rehearsal,
            course=course,
        )
    trained = {name: trained[name] for name in labels}
    return FeatureExtractor(
        {name: network for name, (network, _) in trained.items()},
        values=values,
        records={name: record for name, (_, record) in trained.items()},
    )


def _fitting(
    earlier: FeatureExtractor, values: Mapping[str, Sequence[str]]
) -> dict[str, GrowingNetwork]:
    """The earlier networks whose logits, if there are as many, stand for the same values."""
    return {
        name: network
        for name, network in earlier.networks.items()
        if name in values
        and (network.values != len(values[name]) or earlier.values[name] == tuple(values[name]))
    }


def _ready(
    shown: LabelledPictures,
    options: Mapping[str, TrainingOptions],
    earlier: Mapping[str, GrowingNetwork],
) -> dict[str, GrowingNetwork]:
    """Networks that need no training of their own before they are trained together.

    Those that are trained already; and new ones, where all features start as deep as can be. A
    feature that shows one value only has nothing to learn.
    """
    labels, values, size = shown.labels, shown.values, shown.pixels.shape[1]
    if earlier:
        return {
            name: deepcopy(network)
            for name, network in earlier.items()
            if name in labels and (network.size, network.values) == (size, len(values[name]))
        }
    if any(options[name].depth < deepest(size) for name in labels):
        return {}
    found = {}
    for name, column in labels.items():
        if len({value for value in column if value is not None}) > 1:
            with seeded(torch.device("cpu"), options[name].seed, name, "first"):
                found[name] = new_network(size, len(values[name]), options[name])
    return found


def _learnable(shown: LabelledPictures) -> LabelledPictures:
    """The pictures, if there is something to learn from them, and all fits together.

    It is checked before, or hours of training are lost.
    """
    pixels = checked_pictures(shown.pixels)
    if not len(pixels):
        raise DatasetError("there is no picture to learn from: add labelled pictures")
    if not shown.labels:
        raise DatasetError("there is no feature to learn: name at least one in the domain")
    for name, column in shown.labels.items():
        if name not in shown.values:
            raise DatasetError(f"the values of {name} are not given: list them in the domain")
        if len(column) != len(pixels):
            raise DatasetError(
                f"{name} must have one label a picture ({len(pixels)}), got {len(column)}"
            )
        labelled(column, feature=name, values=shown.values[name])
    if shown.groups is not None and len(shown.groups) != len(pixels):
        raise DatasetError(
            f"groups must have one entry a picture ({len(pixels)}), got {len(shown.groups)}"
        )
    return replace(shown, pixels=pixels)
