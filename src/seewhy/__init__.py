"""SeeWhy answers questions about pictures and says why.

>>> import seewhy
>>> domain = seewhy.load_domain("structure_stability")
>>> agent = seewhy.Agent(domain)
"""

from __future__ import annotations

import logging
from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

logging.getLogger(__name__).addHandler(logging.NullHandler())  # who uses SeeWhy says what is shown

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.classification import classify_pictures
    from seewhy.data.dataset import Dataset
    from seewhy.data.thing_scene import ThingScene, thing_scene
    from seewhy.dialogue.reply import Reply
    from seewhy.dialogue.things.answering import ThingAnswerer, ThingReply
    from seewhy.domain.domain import Domain, load_domain
    from seewhy.errors import SeeWhyError
    from seewhy.evaluation import Evaluation, evaluate
    from seewhy.evaluation.things_learned import LearnedAboutThings, learn_about_things
    from seewhy.knowledge.justification import Node

__all__ = [
    "Agent",
    "Dataset",
    "Domain",
    "Evaluation",
    "LearnedAboutThings",
    "Node",
    "Reply",
    "SeeWhyError",
    "ThingAgent",
    "ThingAnswerer",
    "ThingReply",
    "ThingScene",
    "__version__",
    "classify_pictures",
    "evaluate",
    "learn_about_things",
    "load_domain",
    "thing_scene",
]

_HOMES = {
    "Agent": "seewhy.agent.agent",
    "Dataset": "seewhy.data.dataset",
    "Domain": "seewhy.domain.domain",
    "Evaluation": "seewhy.evaluation",
    "LearnedAboutThings": "seewhy.evaluation.things_learned",
    "Node": "seewhy.knowledge.justification",
    "Reply": "seewhy.dialogue.reply",
    "SeeWhyError": "seewhy.errors",
    "ThingAgent": "seewhy.agent.things.thing_agent",
    "ThingAnswerer": "seewhy.dialogue.things.answering",
    "ThingReply": "seewhy.dialogue.things.answering",
    "ThingScene": "seewhy.data.thing_scene",
    "classify_pictures": "seewhy.classification",
    "evaluate": "seewhy.evaluation",
    "learn_about_things": "seewhy.evaluation.things_learned",
    "load_domain": "seewhy.domain.domain",
    "thing_scene": "seewhy.data.thing_scene",
}


def __getattr__(name: str) -> Any:
    # Names are looked up when they are first used, so that `import seewhy` costs nothing.
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'seewhy' has no attribute '{name}'")
