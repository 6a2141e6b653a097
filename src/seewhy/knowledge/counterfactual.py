"""What would be believed if a default were not given up, told apart from what is so anyway."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace

from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.foundation import opposite
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.possible import Belief

_DENIES = "not "
_NO_BELIEF = (Basis.ABSENCE, Basis.ASSUMED, Basis.UNFOUNDED, Basis.COMPARISON, Basis.JOINTLY)


@dataclass(frozen=True)
class Counterfactual:
    """Tells what holds in an answer set that gives up a default from what holds only without.

    Attributes
    ----------
    default : Axiom
        The default that is given up.
    holds : collection of str
        The keys of what is believed though it is given up.
    otherwise : collection of str
        The keys of what would be believed if it were not.
    """

    default: Axiom
    holds: Collection[str]
    otherwise: Collection[str]

    def uses_default(self, node: Node) -> bool:
        """Whether a justification rests on the default."""
        return any(below.axiom is self.default and not below.is_refuted for below in node.walk())

    def marked(self, node: Node) -> Node:
        """Return a justification that says of each step whether it would only be so otherwise.

        The default itself is left out. Of several reasons those are told that are so anyway.
        """
        children = [self.marked(child) for child in node.children]
        so_anyway = [child for child in children if child.basis is not Basis.OTHERWISE]
        if self._is_so(node):
            if len(so_anyway) == len(children):
                return replace(node, children=tuple(children))
            if so_anyway and node.is_refuted:
                return replace(node, children=tuple(so_anyway))
            if so_anyway and node.basis is Basis.REASONS and node.holds:
                several = replace(node, children=tuple(so_anyway))
                return several if len(so_anyway) > 1 else so_anyway[0]
        return replace(
            node,
            text=f"otherwise {node.text}",
            basis=Basis.OTHERWISE,
            holds=False,
            children=tuple(child for child in children if child.axiom is not self.default),
        )

    def beliefs(self, node: Node) -> Iterator[Belief]:
        """Yield what is believed anyway and stands in a justification that is marked."""
        for below in node.walk():
            if below.basis in _NO_BELIEF or below.basis is Basis.OTHERWISE or below.is_refuted:
                continue
            if below.basis is Basis.REASONS and not below.holds:
                continue
            key = _key(below)
            yield from (Belief(side) for side in (key, opposite(key)) if side in self.holds)

    def _is_so(self, node: Node) -> bool:
        """Whether what a node says by itself is so though the default is given up."""
        if node.is_refuted:
            return True
        key = _key(node)
        denied = node.literal.count(_DENIES) % 2 == 1
        if node.holds is not denied:
            return key in self.holds or key not in self.otherwise
        return key not in self.holds


def _key(node: Node) -> str:
    """The key of the literal that a node affirms or denies."""
    return node.literal.replace(_DENIES, "").replace(" ", "")
