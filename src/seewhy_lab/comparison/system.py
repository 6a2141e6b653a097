"""What a system to compare is given, and what comes of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from seewhy.data.dataset import Dataset
from seewhy.data.making import make_dataset
from seewhy.domain.domain import load_domain

__all__ = ["Drawings", "Fitted", "System"]


@dataclass(frozen=True)
class Drawings:
    """Pictures of a domain's source that every system is trained on before photographs.

    They are the same for all seeds, and a system is trained on them once a process.

    Attributes
    ----------
    domain : str
        A bundled domain's name or a domain folder.
    count : int
    folder : Path
        For the pictures, and for what an interrupted training on them leaves.
    """

    domain: str
    count: int
    folder: Path

    def scenes(self) -> Dataset:
        """The drawings, made where they are not there yet."""
        domain = load_domain(self.domain)
        folder = self.folder / "drawn"  # where seewhy.agent.pretraining has them, too
        make_dataset(
            domain,
            folder,
            count=self.count,
            seed=0,
            size=2 * domain.pictures.size,
            test_share=0.0,
            workers=1,
        )
        return Dataset.load(folder, domain)


@dataclass(frozen=True, eq=False)
class Fitted:
    """A trained system.

    Attributes
    ----------
    classify : callable
        The class of every picture of a dataset; None where the system says that it does not know.
    options : mapping
        How it was trained, for the trial's file: numbers, words and lists of these.
    """

    classify: Callable[[Dataset], Sequence[str | None]]
    options: Mapping[str, Any]


@dataclass(frozen=True)
class System:
    """One of the systems.

    Attributes
    ----------
    name : str
        On the command line and in the files of trials.
    letter, title : str
        On the page.
    fit : callable
        Trains it on the pictures of a dataset with a seed, and where there are drawings on these
        before.
    most : int or None
        Labels above which it is run on a graphics processor only; None: anywhere.
    """

    name: str
    letter: str
    title: str
    fit: Callable[[Dataset, int, Drawings | None], Fitted]
    most: int | None = None
