"""Networks that have seen a domain's own drawings before they see photographs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.data.dataset import Dataset
from seewhy.data.making import MADE, make_dataset
from seewhy.domain.domain import Domain
from seewhy.files.folders import scratch_folder
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception.backbones import NONE

if TYPE_CHECKING:
    from seewhy.perception.extractor import FeatureExtractor
    from seewhy.perception.eyes import Eyes
    from seewhy.perception.rehearsal import Rehearsal

__all__ = ["Pretrained", "is_drawn", "pretrained"]


@dataclass(frozen=True)
class Pretrained:
    """Networks that know a domain's drawings, and the drawings with their annotation."""

    extractor: FeatureExtractor | Eyes
    rehearsal: Rehearsal | None
    vectors: tuple[FeatureVector, ...]
    labels: tuple[str, ...]

    @property
    def networks(self) -> FeatureExtractor:
        """The extractor, where networks were grown."""
        from seewhy.perception.extractor import FeatureExtractor

        assert isinstance(self.extractor, FeatureExtractor)
        return self.extractor


def is_drawn(dataset: Dataset) -> bool:
    """Whether a dataset was made by its domain's own source."""
    return (dataset.folder / MADE).is_file()


def pretrained(
    domain: Domain,
    *,
    eyes: str = NONE,
    device: str = "auto",
    count: int,
    seed: int = 0,
    without: Sequence[str] = (),
    with_class: bool = False,
    workers: int = -1,
    checkpoints: Path | None = None,
    on_picture: Callable[[int], None] | None = None,
    on_progress: Callable[[Any], None] | None = None,
) -> Pretrained:
    """Draw pictures with the domain's source and train a network for each feature on them.

    Use it where drawings are free and photographs are few: networks that know the drawings need
    fewer photographs. Source: none; the paper trains on the pictures of the domain alone.

    Parameters
    ----------
    domain : Domain
        With a source of pictures.
    eyes : str, default "none"
        A backbone to teach instead of growing networks; see :mod:`seewhy.perception.backbones`.
    device : str, default "auto"
        Where it computes.
    count : int
        How many pictures to draw.
    seed : int, default 0
    without : sequence of str
        Classes of which no drawing is used.
    with_class : bool, default False
        Whether a network of the class is trained as well.
    workers : int, default -1
        Processes that draw and train; -1: one a core.
    checkpoints : Path, optional
        A folder in which an interrupted call finds the pictures and where training was.
    on_picture : callable, optional
        Called with the number of pictures drawn so far.
    on_progress : callable, optional
        See :func:`seewhy.perception.extractor.fit_extractor`.

    Raises
    ------
    DomainError
        If the domain has no source of pictures.
    """
    from seewhy.perception.domain_options import (
        seen_labels,
        seen_values,
        trained_together,
        training_options,
    )
    from seewhy.perception.extractor import fit_extractor
    from seewhy.perception.rehearsal import Rehearsal

    with scratch_folder() as temporary:
        folder = checkpoints if checkpoints is not None else temporary
        make_dataset(
            domain,
            folder / "drawn",
            count=count,
            seed=seed,
            # Twice as large as the networks see them, as photographs are: stretching blurs less.
            size=2 * domain.pictures.size,
            test_share=0.0,
            workers=workers,
            on_progress=on_picture,
        )
        scenes = Dataset.load(folder / "drawn", domain).without_classes(without)
        shown = (tuple(scenes.vectors), tuple(scenes.classes))
        if eyes != NONE:
            from seewhy.agent.teaching import teach_eyes

            taught = teach_eyes(
                scenes,
                backbone=eyes,
                device=device,
                seed=seed,
                checkpoints=folder / "drawn.training",
                on_progress=on_progress,
            )
            return Pretrained(taught.eyes, None, *shown)
        columns = seen_labels(domain, scenes.vectors, scenes.labels, with_class=with_class)
        labels = {key: [str(value) for value in column] for key, column in columns.items()}
        pixels = scenes.pictures(domain.pictures.size)
        extractor = fit_extractor(
            pixels,
            labels,
            values=seen_values(domain, with_class=with_class),
            options=training_options(domain, seed=seed, with_class=with_class),
            together=trained_together(domain),
            workers=workers,
            checkpoints=folder / "drawn.training",
            on_progress=on_progress,
        )
        drawn = Rehearsal(pixels, labels)
        return Pretrained(extractor, drawn, *shown)
