"""The experiments that there are, by name."""

from __future__ import annotations

from importlib import import_module

from seewhy.errors import ExperimentError
from seewhy.text.nearest import did_you_mean
from seewhy_lab.experiments.experiment import Experiment

__all__ = ["COMPARES_READINGS", "NAMES", "PLANNING", "experiment"]

_HOMES = {
    "vqa": ("seewhy_lab.experiments.vqa", "VQA"),
    "axioms": ("seewhy_lab.experiments.axioms", "AXIOMS"),
    "confidence": ("seewhy_lab.experiments.coupling", "CONFIDENCE"),
    "reading": ("seewhy_lab.experiments.coupling", "READING"),
    "ablation": ("seewhy_lab.experiments.coupling", "ABLATION"),
}

NAMES = tuple(_HOMES)
COMPARES_READINGS = "reading"
"""The experiment that has every way of reading features for a system."""
PLANNING = "planning"
"""The experiment that needs no pictures; see :mod:`seewhy_lab.experiments.planning_run`."""


def experiment(name: str) -> Experiment:
    """Return the experiment with a name; :data:`PLANNING` is of another kind.

    Raises
    ------
    ExperimentError
        If there is none.

    Examples
    --------
    >>> list(experiment("vqa").systems.values())  # doctest: +ELLIPSIS
    ['SeeWhy', 'SeeWhy, believing who asks', 'end to end', ...]
    """
    if name not in _HOMES:
        raise ExperimentError(
            f"'{name}' is no experiment; {did_you_mean(name, (*NAMES, PLANNING))}"
        )
    module, attribute = _HOMES[name]
    found: Experiment = getattr(import_module(module), attribute)
    return found
