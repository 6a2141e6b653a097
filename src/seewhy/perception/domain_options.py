"""How a domain wants its features trained."""

from __future__ import annotations

from seewhy.domain import Domain
from seewhy.perception.options import TrainingOptions

__all__ = ["training_options"]


def training_options(domain: Domain, *, seed: int = 0) -> dict[str, TrainingOptions]:
    """The options of each feature's network, from ``[pictures]``, ``[networks]`` and the feature.

    Examples
    --------
    >>> from seewhy.domain import load_domain
    >>> options = training_options(load_domain("structure_stability"), seed=3)
    >>> options["num_blocks"].threshold, options["lean"].flip, options["lean"].seed
    (0.98, True, 3)
    """
    variations = domain.pictures.model_dump(exclude={"size", "fit", "drawn"})
    networks = domain.networks
    return {
        key: TrainingOptions(
            threshold=feature.threshold,
            max_epochs=networks.epochs,
            patience=networks.patience,
            depth=networks.depth,
            batch_size=networks.batch,
            channels=feature.channels or networks.channels,
            dense=feature.dense or networks.dense,
            seed=seed,
            **variations,
        )
        for key, feature in domain.features.items()
    }
