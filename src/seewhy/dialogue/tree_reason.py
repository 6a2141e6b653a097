"""What the decision tree says of a class that no rule of the knowledge concludes."""

from __future__ import annotations

from seewhy.domain.domain import Domain
from seewhy.induction.sentence import say_path
from seewhy.induction.tree import DecisionTree, TreePath
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.scene import FeatureVector

__all__ = ["tree_says"]


def tree_says(domain: Domain, tree: DecisionTree, vector: FeatureVector, label: str) -> Node | None:
    """Return the path to a class that is nearest to a scene, or None where none leads there.

    Nearest is the path of whose conditions the fewest fail; of several, the one with most support.
    """
    paths = [path for path in tree.paths() if label in (path.label, *path.equals)]
    if not paths:
        return None
    values = domain.named(vector)

    def distance(path: TreePath) -> tuple[int, int]:
        failed = sum(
            values[condition.feature] not in condition.values for condition in path.conditions
        )
        return failed, -path.support

    path = min(paths, key=distance)
    said = f"the decision tree says: {say_path(domain, path)}"
    return Node(str(domain.classes[label].literal), said, Basis.PATH)
