"""The systems that are compared, by name."""

from __future__ import annotations

from seewhy_lab.comparison.fine_tuned import MOST, fit_fine_tuned
from seewhy_lab.comparison.frozen_features import fit_frozen_features
from seewhy_lab.comparison.seewhy_agents import fit_before, fit_default
from seewhy_lab.comparison.small_network import fit_small_network
from seewhy_lab.comparison.system import System

__all__ = ["SYSTEMS"]

SYSTEMS = {
    system.name: system
    for system in (
        System("seewhy", "a", "SeeWhy by default", fit_default),
        System("small_network", "b", "small network", fit_small_network),
        System("frozen_features", "c", "frozen features", fit_frozen_features),
        System("fine_tuned", "d", "fine-tuned backbone", fit_fine_tuned, most=MOST),
        System("before", "e", "SeeWhy before", fit_before),
    )
}
"""In the order of the page; the first is the one that the others are compared with."""
