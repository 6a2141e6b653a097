"""Draw the decision tree: questions at the branches, classes with their support at the leaves."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from seewhy.domain.domain import Domain
from seewhy.domain.wording import say_values
from seewhy.induction.tree import DecisionTree, TreeNode
from seewhy.report.figure import CHARACTER, Figure, text_lines

_WIDTH = 150
_BOX = 52
_LEVEL = 96


@dataclass
class _Placed:
    node: TreeNode
    x: float
    depth: int
    below: tuple[_Placed, ...] = ()
    marked: bool = False


def draw_tree(domain: Domain, tree: DecisionTree, *, accepted: Collection[int] = ()) -> Figure:
    """Return the tree as a figure; an unfitted tree as a figure that says so.

    ``accepted`` are the places, among the tree's paths, of those that became axioms: they are
    drawn strong.
    """
    root = tree.root()
    if root is None:
        text, _ = text_lines(
            "No training scene is left for it: there is no tree.",
            10, 24, width=80, fill="#222222",
        )  # fmt: skip
        return Figure(width=480, height=40, content=text)
    leaves: list[_Placed] = []
    placed = _place(root, 0, leaves, accepted)
    deepest = max(leaf.depth for leaf in leaves)
    parts: list[str] = []
    _draw(domain, placed, parts)
    return Figure(
        width=int(len(leaves) * (_WIDTH + 16) + 16),
        height=deepest * _LEVEL + _BOX + 30,
        content="".join(parts),
    )


def _place(node: TreeNode, depth: int, leaves: list[_Placed], accepted: Collection[int]) -> _Placed:
    if not node.branches:
        x = 16 + _WIDTH / 2 + len(leaves) * (_WIDTH + 16)
        leaf = _Placed(node, x, depth, marked=len(leaves) in accepted)
        leaves.append(leaf)
        return leaf
    below = tuple(_place(branch, depth + 1, leaves, accepted) for branch in node.branches)
    x = sum(branch.x for branch in below) / len(below)
    return _Placed(node, x, depth, below, marked=any(branch.marked for branch in below))


def _draw(domain: Domain, placed: _Placed, parts: list[str]) -> None:
    node, x, y = placed.node, placed.x, 10 + placed.depth * _LEVEL
    for below in placed.below:
        top = 10 + below.depth * _LEVEL
        parts.append(
            f"<path d='M{x:g},{y + _BOX} L{below.x:g},{top}' "
            f"{_line(below, '#999999')} fill='none'/>"
        )
        feature = domain.features[node.feature or ""]
        allowed = below.node.allowed
        said = say_values(domain, feature.key, allowed) if allowed else "not known"
        said = (
            said.replace(f"the {feature.name} of {{it}} is ", "")
            .replace("{it} is ", "")
            .replace("{it} has ", "")
            .replace("{it} ", "")
        )
        text, _ = text_lines(
            said, (x + below.x) / 2, (y + _BOX + top) / 2 - 2, width=24,
            text_anchor="middle", fill="#555555", font_size="11",
            stroke="#ffffff", stroke_width="4", paint_order="stroke",
        )  # fmt: skip
        parts.append(text)
    if node.branches:
        fill, label = "#f3ecfa", f"{domain.features[node.feature or ''].name}?"
    else:
        fill, label = "#e9f6ec", f"{domain.classes[node.label].say}"
    support = f"{node.precision:.0%} of {node.support}".replace("%", " %")
    parts.append(
        f"<rect x='{x - _WIDTH / 2:g}' y='{y}' width='{_WIDTH}' height='{_BOX}' rx='6' "
        f"fill='{fill}' {_line(placed, '#888888')}/>"
    )
    lines = int(_WIDTH / CHARACTER)
    for text, dy, weight in ((label, 22, "bold"), (f"{node.label}: {support}", 40, "normal")):
        drawn, _ = text_lines(
            text, x, y + dy, width=lines, text_anchor="middle", fill="#222222", font_weight=weight
        )
        parts.append(drawn)
    for below in placed.below:
        _draw(domain, below, parts)


def _line(placed: _Placed, plain: str) -> str:
    """The stroke of a box, or of the line that leads to it."""
    return "stroke='#1c7a3d' stroke-width='3'" if placed.marked else f"stroke='{plain}'"
