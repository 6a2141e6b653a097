"""What an experiment is, as data: its hypothesis, its sizes, and how one trial is run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain

__all__ = ["ALL", "Claim", "Experiment", "Measure", "Plan", "Setting", "Trial", "say_size"]

ALL = 0
"""The size that stands for all pictures that there are."""

Row = dict[str, Any]
"""One line of the table of results; names that begin with "seconds" are timings."""


@dataclass(frozen=True)
class Trial:
    """One drawing of pictures to train on and to test on; ``size`` of them train."""

    seed: int
    size: int

    @property
    def name(self) -> str:
        """The name of the trial's file.

        Examples
        --------
        >>> Trial(seed=3, size=100).name, Trial(seed=3, size=ALL).name
        ('100-3', 'all-3')
        """
        return f"{say_size(self.size)}-{self.seed}"


@dataclass(frozen=True)
class Setting:
    """What all trials of an experiment share.

    Attributes
    ----------
    domain : Domain
    scenes : Dataset
        The pictures that trials draw from.
    tested : int
        Pictures that a trial tests on, where the pictures have no groups.
    drawn : int
        Pictures of the domain's own source that networks are trained on before.
    out : Path
        The folder for what the experiments of a domain share: pictures, and what networks saw.
    """

    domain: Domain
    scenes: Dataset
    tested: int
    drawn: int
    out: Path


@dataclass(frozen=True)
class Plan:
    """How large an experiment is.

    Attributes
    ----------
    trials : int
        Seeds, each with every size.
    sizes : tuple of int
        Pictures (or scenes) to train on; 0 for all.
    pictures : int
        How many are drawn to choose from where the user gives no pictures.
    tested : int
        Pictures that a trial tests on.
    """

    trials: int
    sizes: tuple[int, ...]
    pictures: int = 6000
    tested: int = 1000


@dataclass(frozen=True)
class Measure:
    """A column of the rows that is a share, 0 to 1, and what it is called on the page."""

    key: str
    name: str


@dataclass(frozen=True)
class Claim:
    """One system is significantly better than another by a measure, at every size.

    Attributes
    ----------
    measure, system, against : str
    equal_in : tuple of str
        Domains in which less is claimed: that it is nowhere significantly worse; "" for all.
    significant_to : int
        The largest size at which the difference has to be significant; above, the mean has to be
        better. 0: at all sizes.
    """

    measure: str
    system: str
    against: str
    equal_in: tuple[str, ...] = ()
    significant_to: int = ALL

    def at_least_equal(self, domain: str) -> bool:
        """Whether it suffices in a domain that the system is nowhere significantly worse."""
        return domain in self.equal_in or "" in self.equal_in


@dataclass(frozen=True)
class Experiment:
    """An experiment of the paper.

    Attributes
    ----------
    name, title, hypothesis : str
        What it is called on the command line and on its page, and what it is to show.
    systems : mapping of str to str
        The ``system`` of a row → what it is called on the page, in the order of the page.
    measures : tuple of Measure
    claims : tuple of Claim
        What is tested.
    trial : callable
        Runs one trial in a setting and returns its rows.
    full, quick : mapping of str to Plan
        Domain → how large it is; the domain "" stands for all others.
    across : str
        What the sizes are, for the axis of the figures.
    """

    name: str
    title: str
    hypothesis: str
    systems: Mapping[str, str]
    measures: tuple[Measure, ...]
    claims: tuple[Claim, ...]
    trial: Callable[[Setting, Trial], list[Row]]
    full: Mapping[str, Plan] = field(default_factory=dict)
    quick: Mapping[str, Plan] = field(default_factory=dict)
    across: str = "training pictures"

    def plan(self, domain: str, *, quick: bool) -> Plan:
        """The plan for a domain."""
        plans = self.quick if quick else self.full
        return plans.get(domain, plans[""])

    def measure(self, key: str) -> Measure:
        """The measure with a key."""
        return next(measure for measure in self.measures if measure.key == key)


def say_size(size: int) -> str:
    """Return a size as it is written.

    Examples
    --------
    >>> say_size(100), say_size(ALL)
    ('100', 'all')
    """
    return str(size) if size != ALL else "all"
