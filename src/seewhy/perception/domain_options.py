"""How a domain wants its features trained."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception.options import TrainingOptions

__all__ = [
    "class_options",
    "given_variations",
    "seen_labels",
    "seen_values",
    "trained_together",
    "training_options",
]


def seen_values(domain: Domain, *, with_class: bool = False) -> dict[str, tuple[str, ...]]:
    """The values that each network tells apart: one network a feature, and one for the class.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> seen_values(load_domain("structure_stability"), with_class=True)["class"]
    ('stable', 'unstable')
    """
    found = {key: tuple(feature.values) for key, feature in domain.features.items()}
    return {**found, CLASS: tuple(domain.classes)} if with_class else found


def seen_labels(
    domain: Domain,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str | None],
    *,
    with_class: bool = False,
) -> dict[str, Sequence[str | None]]:
    """What each network is to see in annotated scenes; see :func:`seen_values`."""
    columns: dict[str, Sequence[str | None]] = dict(
        zip(domain.features, zip(*vectors, strict=True), strict=True)
    )
    return {**columns, CLASS: labels} if with_class else columns


def trained_together(domain: Domain) -> tuple[str, ...]:
    """The features whose networks are trained together; that of the class is never among them."""
    return tuple(domain.features) if domain.networks.together else ()


def training_options(
    domain: Domain, *, seed: int = 0, with_class: bool = False
) -> dict[str, TrainingOptions]:
    """The options of each feature's network, from ``[pictures]``, ``[networks]`` and the feature.

    ``with_class`` adds those of the network of the class; see :func:`class_options`.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> options = training_options(load_domain("structure_stability"), seed=3)
    >>> options["num_blocks"].threshold, options["lean"].flip, options["lean"].seed
    (0.98, True, 3)
    """
    variations = given_variations(domain)
    networks = domain.networks
    found = {
        key: TrainingOptions(
            threshold=feature.threshold,
            max_epochs=networks.epochs,
            patience=networks.patience,
            depth=networks.depth,
            batch_size=networks.batch,
            channels=feature.channels or networks.channels,
            dense=feature.dense or networks.dense,
            seed=seed,
            standard=domain.pictures.standard,
            **variations,
        )
        for key, feature in domain.features.items()
    }
    return {**found, CLASS: class_options(domain, seed=seed)} if with_class else found


def given_variations(domain: Domain) -> dict[str, Any]:
    """The variations of pictures that ``[pictures]`` settles; the others are left open.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> given_variations(load_domain("structure_stability"))
    {'flip': True, 'shift': 0.06}
    """
    stated = domain.pictures.model_dump(exclude={"size", "source_size", "fit", "standard", "drawn"})
    return {name: value for name, value in stated.items() if value is not None}


def class_options(domain: Domain, *, seed: int = 0) -> TrainingOptions:
    """How the network of the class is trained: as the network of the hardest feature is.

    It is as wide as the widest and must be as accurate as the most accurate; where all start as
    deep as can be and many features make up the class, its dense layer is wider, so that it has
    about as many weights as they have together.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> class_options(load_domain("structure_stability")).threshold
    0.98
    """
    options = training_options(domain, seed=seed).values()
    largest = max(
        options, key=lambda feature_options: (sum(feature_options.channels), feature_options.dense)
    )
    wider = 1 if len(domain.classes) == 2 else 2
    return replace(
        largest,
        threshold=max(feature_options.threshold for feature_options in options),
        dense=wider * largest.dense,
    )
