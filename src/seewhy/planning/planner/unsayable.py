"""What an axiom says that no problem without variables can say."""

from __future__ import annotations

from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Axiom


def unsayable(axiom: Axiom, why: str) -> PlanningError:
    """Return the error that refuses an axiom, with its place; ``why`` begins with a verb."""
    return PlanningError(f"{axiom.location}: the axiom '{axiom}' {why}; PDDL cannot say that")
