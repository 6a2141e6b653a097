"""The same agent with other axioms, to try what they would do."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from typing import TYPE_CHECKING

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
    # Parts are values: a copy has the same ones until another takes the place of one.
    other = copy(agent)
    other.known = agent.known.knowing(learned, withdrawn)
    other.tree = other.known.untrained_tree()
    return other
