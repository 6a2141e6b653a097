"""SeeWhy answers questions about pictures and says why.

>>> import seewhy
>>> domain = seewhy.load_domain("structure_stability")
>>> agent = seewhy.Agent(domain)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from seewhy.agent import Agent
    from seewhy.classifying import classify_pictures
    from seewhy.data.dataset import Dataset
    from seewhy.domain import Domain, load_domain
    from seewhy.errors import SeeWhyError
    from seewhy.evaluation import Evaluation, evaluate
    from seewhy.knowledge.justification import Node
    from seewhy.reply import Reply

__all__ = [
    "Agent",
    "Dataset",
    "Domain",
    "Evaluation",
    "Node",
    "Reply",
    "SeeWhyError",
    "classify_pictures",
    "evaluate",
    "load_domain",
]

_HOMES = {
    "Agent": "seewhy.agent",
    "Dataset": "seewhy.data.dataset",
    "Domain": "seewhy.domain",
    "Evaluation": "seewhy.evaluation",
    "Node": "seewhy.knowledge.justification",
    "Reply": "seewhy.reply",
    "SeeWhyError": "seewhy.errors",
    "classify_pictures": "seewhy.classifying",
    "evaluate": "seewhy.evaluation",
    "load_domain": "seewhy.domain",
}


def __getattr__(name: str) -> Any:
    # Names are looked up when they are first used, so that `import seewhy` costs nothing.
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'seewhy' has no attribute '{name}'")
