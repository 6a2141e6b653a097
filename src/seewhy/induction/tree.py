"""A decision tree over feature vectors, whose paths read as sentences."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median_low
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from seewhy.errors import ModelError
from seewhy.files.json_file import Strict, read_json
from seewhy.files.whole_files import write_whole
from seewhy.induction.tree_nodes import TreeNodes, TreeTable
from seewhy.knowledge.scene import FeatureVector

if TYPE_CHECKING:
    import pandas as pd
    from sklearn.model_selection import GridSearchCV
    from sklearn.tree import DecisionTreeClassifier

    from seewhy.domain.domain import Domain


TREE = "tree.json"
_MOST_ALPHAS = 25
"""So many pruning strengths are tried at the most."""
_REMEDY = "train the model again"


@dataclass(frozen=True)
class PathCondition:
    """What a path asks of one feature: that its value is among ``values``."""

    feature: str
    values: tuple[str, ...]


@dataclass(frozen=True)
class TreePath:
    """A path from the root to a leaf.

    Attributes
    ----------
    conditions : tuple of PathCondition
        One per feature that the path tests, in the order of the first test. Without values:
        only a feature that is not known gets here.
    label : str
        The class of the leaf.
    support : int
        The training scenes that end in the leaf.
    precision : float
        The share of them that are of the class.
    equals : tuple of str
        The other classes of which as many of them are; the path says the first of these classes.
    """

    conditions: tuple[PathCondition, ...]
    label: str
    support: int
    precision: float
    equals: tuple[str, ...] = ()


@dataclass(frozen=True)
class TreeNode:
    """A node of the tree, for drawing.

    ``feature`` is what the node asks about (None at a leaf); ``allowed`` are the values of the
    parent's feature that lead here.
    """

    feature: str | None
    allowed: tuple[str, ...]
    label: str
    support: int
    precision: float
    branches: tuple[TreeNode, ...] = ()


class DecisionTree:
    """Induces classes from feature vectors with scikit-learn's tree (Gini, pruned).

    Numbers are compared, all other values are columns of their own, so that no path ever orders
    categories. Pruning (cost-complexity) is chosen by cross-validation where there are enough
    scenes. Paper: section 3.3.

    Parameters
    ----------
    features : mapping of str to sequence of str
        Feature name → its values.

    Examples
    --------
    >>> tree = DecisionTree({"size": ["1", "2", "3"], "lean": ["yes", "no"]})
    >>> scenes = [("1", "no"), ("2", "no"), ("3", "no"), ("3", "yes")] * 10
    >>> tree = tree.fit(scenes, ["up", "up", "up", "down"] * 10)
    >>> tree.classify(("3", "yes"))
    'down'
    >>> tree.path(("3", "yes")).conditions
    (PathCondition(feature='lean', values=('yes',)),)
    """

    def __init__(self, features: Mapping[str, Sequence[str]]) -> None:
        self.features = {name: tuple(values) for name, values in features.items()}
        self.columns = tuple(_columns(self.features))
        self._nodes: TreeNodes | None = None

    @property
    def fitted(self) -> bool:
        """False where there were no scenes to learn from."""
        return self._nodes is not None

    @property
    def classes(self) -> tuple[str, ...]:
        """The classes that the tree knows."""
        return () if self._nodes is None else self._nodes.classes

    def fit(
        self,
        vectors: Sequence[FeatureVector],
        labels: Sequence[str],
        *,
        seed: int = 0,
        smallest_leaf: int | None = None,
    ) -> DecisionTree:
        """Grow the tree and prune it; with no scenes it stays unfitted.

        With ``smallest_leaf`` it is not pruned: it grows until every leaf is of one class or
        cannot be divided into leaves of so many scenes.
        """
        if not vectors:
            self._nodes = None
            return self
        from sklearn.tree import DecisionTreeClassifier  # slow to import; asking needs none of it

        table = self._encode(vectors)
        classes = np.asarray(labels)
        # The features are few and discrete: leaves need support, or they are noise.
        pruned = smallest_leaf is None
        smallest = smallest_leaf or max(1, min(5, len(vectors) // 50))
        tree = DecisionTreeClassifier(
            criterion="gini", min_samples_leaf=smallest, random_state=seed
        )
        with warnings.catch_warnings():
            # Of a few scenes of many classes scikit-learn suspects that they are no classes.
            warnings.filterwarnings("ignore", message="The number of unique classes is greater")
            if pruned:
                tree = _pruned(tree, table, classes, seed=seed)
            tree.fit(table, classes)
        self._nodes = TreeNodes.of(tree)
        return self

    def classify(self, vector: FeatureVector) -> str:
        """Return the class of a scene.

        Raises
        ------
        ValueError
            If the tree is not fitted.
        """
        return self.classify_all([vector])[0]

    def classify_all(self, vectors: Sequence[FeatureVector]) -> list[str]:
        """Return the class of every scene."""
        nodes = self._fitted()
        best = np.argmax(nodes.shares, axis=1)
        return [nodes.classes[best[leaf]] for leaf in nodes.leaves_of(self._encode(vectors))]

    def probability(self, vector: FeatureVector) -> dict[str, float]:
        """Return the share of each class among the training scenes in the scene's leaf."""
        nodes = self._fitted()
        leaf = int(nodes.leaves_of(self._encode([vector]))[0])
        return dict(zip(nodes.classes, nodes.shares[leaf], strict=True))

    def path(self, vector: FeatureVector) -> TreePath:
        """Return the path that a scene takes."""
        nodes = self._fitted()
        table = self._encode([vector])
        return self._path([*nodes.steps_to(table[0])], int(nodes.leaves_of(table)[0]))

    def paths(self) -> tuple[TreePath, ...]:
        """Return all paths, from the leftmost leaf to the rightmost."""
        if self._nodes is None:
            return ()
        nodes = self._nodes
        found: list[TreePath] = []

        def descend(node: int, steps: list[tuple[int, bool]]) -> None:
            if nodes.is_leaf(node):
                found.append(self._path(steps, node))
                return
            descend(nodes.left[node], [*steps, (node, True)])
            descend(nodes.right[node], [*steps, (node, False)])

        descend(0, [])
        return tuple(found)

    def root(self) -> TreeNode | None:
        """Return the tree as nested nodes, or None where it is unfitted."""
        if self._nodes is None:
            return None
        nodes = self._nodes

        def node_at(node: int, steps: list[tuple[int, bool]]) -> TreeNode:
            path = self._path(steps, node)
            branches: tuple[TreeNode, ...] = ()
            feature = None
            if not nodes.is_leaf(node):
                feature = self.columns[nodes.column[node]][0]
                branches = (
                    node_at(nodes.left[node], [*steps, (node, True)]),
                    node_at(nodes.right[node], [*steps, (node, False)]),
                )
            asked = self.columns[nodes.column[steps[-1][0]]][0] if steps else None
            allowed = next(
                (condition.values for condition in path.conditions if condition.feature == asked),
                (),
            )
            return TreeNode(feature, allowed, path.label, path.support, path.precision, branches)

        return node_at(0, [])

    def get_rules(self, domain: Domain | None = None) -> pd.DataFrame:
        """Return the paths as a data frame; see :func:`seewhy.induction.rule_table.rules_of_tree`.

        Raises
        ------
        SeeWhyError
            If pandas is not installed.
        """
        from seewhy.induction.rule_table import rules_of_tree

        return rules_of_tree(self, domain)

    def _path(self, steps: Sequence[tuple[int, bool]], leaf: int) -> TreePath:
        nodes = self._fitted()
        allowed: dict[str, tuple[str, ...]] = {}
        for node, left in steps:
            feature, value = self.columns[nodes.column[node]]
            values = allowed.get(feature, self.features[feature])
            if value is None:
                limit = nodes.threshold[node]
                kept = tuple(known for known in values if (int(known) <= limit) == left)
            else:
                kept = tuple(known for known in values if (known != value) == left)
            allowed[feature] = kept
        shares = nodes.shares[leaf]
        label, *equals = (
            name for name, share in zip(nodes.classes, shares, strict=True) if share == max(shares)
        )
        return TreePath(
            conditions=tuple(PathCondition(feature, values) for feature, values in allowed.items()),
            label=label,
            equals=tuple(equals),
            support=nodes.support[leaf],
            precision=max(shares) / sum(shares),
        )

    def _encode(self, vectors: Sequence[FeatureVector]) -> NDArray[np.float64]:
        """One row per scene; a number that is not known is the middle one of its values."""
        names = list(self.features)
        table = np.zeros((len(vectors), len(self.columns)))
        for column, (feature, value) in enumerate(self.columns):
            position = names.index(feature)
            if value is None:
                middle = float(median_low([int(number) for number in self.features[feature]]))
                table[:, column] = [
                    middle if vector[position] is None else float(vector[position] or 0)
                    for vector in vectors
                ]
            else:
                table[:, column] = [vector[position] == value for vector in vectors]
        return table

    def _fitted(self) -> TreeNodes:
        if self._nodes is None:
            raise ValueError("the tree is not fitted; call fit with at least one scene")
        return self._nodes

    def save(self, folder: Path) -> None:
        """Write the tree to ``folder`` as tree.json."""
        described = {
            "features": self.features,
            "nodes": None if self._nodes is None else self._nodes.to_dict(),
        }
        write_whole(folder / TREE, json.dumps(described, indent=1), durable=False)

    @staticmethod
    def load(folder: Path) -> DecisionTree:
        """Read a tree that :meth:`save` wrote.

        Raises
        ------
        ModelError
            If the file is missing or is no tree.
        """
        file = folder / TREE
        described = read_json(file, _TreeFile, remedy=_REMEDY)
        tree = DecisionTree(described.features)
        if described.nodes is not None:
            try:
                tree._nodes = TreeNodes.read(described.nodes, columns=len(tree.columns))
            except ValueError as problem:
                raise ModelError(f"{file} is damaged ({problem}): {_REMEDY}") from None
        return tree


class _TreeFile(Strict):
    """tree.json."""

    features: dict[str, Annotated[tuple[str, ...], Field(min_length=1)]]
    nodes: TreeTable | None


def _columns(features: Mapping[str, Sequence[str]]) -> list[tuple[str, str | None]]:
    """(feature, None) for a number, (feature, value) for one value of a category."""
    columns: list[tuple[str, str | None]] = []
    for name, values in features.items():
        if all(value.lstrip("-").isdecimal() for value in values):
            columns.append((name, None))
        elif len(values) == 2:
            columns.append((name, values[0]))
        else:
            columns += [(name, value) for value in values]
    return columns


def _thin(alphas: NDArray[np.float64]) -> list[float]:
    """Evenly chosen pruning strengths, where there are too many to try all."""
    if len(alphas) <= _MOST_ALPHAS:
        return [float(alpha) for alpha in alphas]
    return [float(alphas[i]) for i in np.linspace(0, len(alphas) - 1, _MOST_ALPHAS).astype(int)]


def _pruned(
    tree: DecisionTreeClassifier, table: NDArray[np.float64], classes: NDArray[Any], *, seed: int
) -> DecisionTreeClassifier:
    """The tree, not yet grown, with the pruning that does best in cross-validation."""
    from sklearn.model_selection import GridSearchCV, StratifiedKFold

    counts = np.unique(classes, return_counts=True)[1]
    rarest = int(counts.min())
    if rarest < 2 or len(counts) < 2 or len(classes) < 20:
        return tree
    path = tree.cost_complexity_pruning_path(table, classes)
    alphas = np.unique(np.clip(path.ccp_alphas, 0.0, None))
    # Between two prunings: at one itself, the trees of cross-validation may keep a branch that the
    # tree of all scenes loses.
    alphas = np.sqrt(alphas[:-1] * alphas[1:]) if len(alphas) > 1 else alphas
    search = GridSearchCV(
        tree,
        {"ccp_alpha": sorted(_thin(alphas))},
        cv=StratifiedKFold(min(5, rarest), shuffle=True, random_state=seed),
    )
    search.fit(table, classes)
    return _largest_alpha(search, tree)


def _largest_alpha(search: GridSearchCV, tree: DecisionTreeClassifier) -> DecisionTreeClassifier:
    """The strongest pruning within one standard error of the best accuracy."""
    results = search.cv_results_
    best = int(results["rank_test_score"].argmin())
    folds = search.n_splits_
    least = results["mean_test_score"][best] - results["std_test_score"][best] / np.sqrt(folds)
    alphas = np.asarray([parameters["ccp_alpha"] for parameters in results["params"]])
    enough = results["mean_test_score"] >= least
    return tree.set_params(ccp_alpha=float(alphas[enough].max()))
