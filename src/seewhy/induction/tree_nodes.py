"""The nodes of a decision tree as plain tables: walked, written and read without scikit-learn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from seewhy.files.json_file import Strict

if TYPE_CHECKING:
    from sklearn.tree import DecisionTreeClassifier

__all__ = ["TreeNodes", "TreeTable"]

LEAF = -1
DEEPEST = 600
"""Questions on the way to a leaf; of a few hundred columns none is asked so often."""

Place = Annotated[int, Field(ge=LEAF, lt=10**7)]


class TreeTable(Strict):
    """The fields of :class:`TreeNodes` as they stand in a file."""

    classes: tuple[str, ...]
    left: tuple[Place, ...]
    right: tuple[Place, ...]
    column: tuple[Place, ...]
    threshold: tuple[float, ...]
    support: tuple[Annotated[int, Field(ge=0, lt=10**12)], ...]
    shares: tuple[tuple[Annotated[float, Field(ge=0.0)], ...], ...]


@dataclass(frozen=True)
class TreeNodes:
    """A fitted tree, a row a node; the first is the root, children come after their parents.

    Attributes
    ----------
    classes : tuple of str
    left, right : tuple of int
        The children of each node; -1 at a leaf. What is at most the threshold goes left.
    column : tuple of int
        The column that each node asks about; -1 at a leaf.
    threshold : tuple of float
    support : tuple of int
        The training scenes that come to each node.
    shares : tuple of tuple of float, (nodes, classes)
        The share of each class among them.

    Examples
    --------
    >>> nodes = TreeNodes(
    ...     classes=("down", "up"), left=(1, -1, -1), right=(2, -1, -1), column=(0, -1, -1),
    ...     threshold=(0.5, 0.0, 0.0), support=(4, 3, 1),
    ...     shares=((0.25, 0.75), (0.0, 1.0), (1.0, 0.0)),
    ... )
    >>> nodes.leaves_of(np.array([[0.0], [1.0]])).tolist()
    [1, 2]
    """

    classes: tuple[str, ...]
    left: tuple[int, ...]
    right: tuple[int, ...]
    column: tuple[int, ...]
    threshold: tuple[float, ...]
    support: tuple[int, ...]
    shares: tuple[tuple[float, ...], ...]

    @staticmethod
    def of(fitted: DecisionTreeClassifier) -> TreeNodes:
        """The nodes of a tree that scikit-learn has grown."""
        table = fitted.tree_
        counts = table.value[:, 0, :]
        shares = counts / counts.sum(axis=1, keepdims=True)
        inner = table.children_left != LEAF
        return TreeNodes(
            classes=tuple(map(str, fitted.classes_)),
            left=tuple(table.children_left.tolist()),
            right=tuple(table.children_right.tolist()),
            column=tuple(np.where(inner, table.feature, LEAF).tolist()),
            threshold=tuple(np.where(inner, table.threshold, 0.0).tolist()),
            support=tuple(table.n_node_samples.tolist()),
            shares=tuple(tuple(row) for row in shares.tolist()),
        )

    @staticmethod
    def read(described: TreeTable, *, columns: int) -> TreeNodes:
        """The nodes that :meth:`to_dict` described, if they form a tree over so many columns.

        Raises
        ------
        ValueError
            They do not.
        """
        nodes = TreeNodes(
            **{name: getattr(described, name) for name in type(described).model_fields}
        )
        if not nodes._form_a_tree(columns):
            raise ValueError("its nodes do not form a tree")
        return nodes

    def to_dict(self) -> dict[str, Any]:
        """The nodes as values that JSON can hold."""
        return {
            "classes": list(self.classes),
            "left": list(self.left),
            "right": list(self.right),
            "column": list(self.column),
            "threshold": list(self.threshold),
            "support": list(self.support),
            "shares": [list(row) for row in self.shares],
        }

    def is_leaf(self, node: int) -> bool:
        """Whether a node asks nothing."""
        return self.left[node] == LEAF

    def leaves_of(self, table: NDArray[np.float64]) -> NDArray[np.intp]:
        """The leaf that each row of a table, shape (rows, columns), comes to."""
        left, right, column, threshold = self._arrays
        nodes = np.zeros(len(table), dtype=np.intp)
        while True:
            rows = np.flatnonzero(left[nodes] != LEAF)
            if not len(rows):
                return nodes
            here = nodes[rows]
            goes_left = table[rows, column[here]] <= threshold[here]
            nodes[rows] = np.where(goes_left, left[here], right[here])

    def steps_to(self, row: NDArray[np.float64]) -> Iterator[tuple[int, bool]]:
        """Yield the inner nodes that a row passes, and whether it goes left there."""
        node = 0
        while not self.is_leaf(node):
            left = bool(row[self.column[node]] <= self.threshold[node])
            yield node, left
            node = self.left[node] if left else self.right[node]

    @cached_property
    def _arrays(
        self,
    ) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
        left, right, column = (
            np.array(numbers, dtype=np.intp) for numbers in (self.left, self.right, self.column)
        )
        return left, right, column, np.array(self.threshold)

    def _form_a_tree(self, columns: int) -> bool:
        count = len(self.left)
        lengths = {len(self.right), len(self.column), len(self.threshold), len(self.support)}
        if not count or lengths != {count} or len(self.shares) != count or not self.classes:
            return False
        inner = [node for node in range(count) if self.left[node] != LEAF]
        children = [child for node in inner for child in (self.left[node], self.right[node])]
        return (
            all(self.right[node] == LEAF for node in range(count) if self.left[node] == LEAF)
            # Every node but the root has one parent, which stands before it: no circle.
            and sorted(children) == list(range(1, count))
            and all(min(self.left[node], self.right[node]) > node for node in inner)
            and all(0 <= self.column[node] < columns for node in inner)
            and all(len(row) == len(self.classes) for row in self.shares)
            and all(abs(sum(row) - 1.0) < 1e-6 for row in self.shares)
            and self._depth() <= DEEPEST
        )

    def _depth(self) -> int:
        depths = [0] * len(self.left)
        for node in range(len(self.left)):
            for child in () if self.is_leaf(node) else (self.left[node], self.right[node]):
                depths[child] = depths[node] + 1
        return max(depths)
