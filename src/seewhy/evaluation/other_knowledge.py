"""The same agent with other axioms, to try what they would do."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from typing import TYPE_CHECKING

from seewhy.induction.tree import DecisionTree

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.knowledge.axiom import Axiom
    from seewhy.knowledge.learned_file import Withdrawn

__all__ = ["with_axioms"]


def with_axioms(agent: Agent, learned: Sequence[Axiom], withdrawn: Sequence[Withdrawn]) -> Agent:
    """Return a copy that sees with the same networks and knows these axioms beside the given ones.

    Its tree is not trained yet; the agent itself stays as it is.

    Examples
    --------
    >>> import seewhy
    >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
    >>> with_axioms(agent, (), ()).domain == agent.domain
    True
    """
    from seewhy.agent.agent import Agent

    known = Agent(agent.given, minimality=agent.minimality, learned=learned, withdrawn=withdrawn)
    # A copy has all options of the agent, whatever they are, and of these only the knowledge.
    other = copy(agent)
    vars(other).update(
        {name: dict(value) for name, value in vars(agent).items() if isinstance(value, dict)}
    )
    other.learned, other.withdrawn = known.learned, known.withdrawn
    other.domain, other.reasoner = known.domain, known.reasoner
    other.tree = DecisionTree({key: one.values for key, one in agent.domain.features.items()})
    other.experience = agent.experience
    return other
