"""The shape of Python packages, side by side: how long modules and functions are, what is public.

    python benchmarks/code_shape.py sklearn imodels unified_planning seewhy

A package is looked up where it is installed; nothing of it is imported. Tests are left out.
"""

from __future__ import annotations

import ast
import sys
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path
from statistics import median

LONG_MODULE, LONG_FUNCTION = 400, 60
_COLUMNS = (
    "package", "modules", "median lines", f"over {LONG_MODULE}", "functions",
    f"over {LONG_FUNCTION}", "documented", "with an example", "with __all__", "py.typed",
)  # fmt: skip


def shape(package: str, folder: Path) -> tuple[str, ...]:
    """The row of a package."""
    texts = [
        path.read_text(encoding="utf-8", errors="replace")
        for path in sorted(folder.rglob("*.py"))
        if path.stat().st_size
        and not any("test" in part for part in path.relative_to(folder).parts)
    ]
    trees = [ast.parse(text) for text in texts]
    lines = [len(text.splitlines()) for text in texts]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    functions = [node for node in nodes if isinstance(node, ast.FunctionDef)]
    public = [
        node
        for node in nodes
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_")
    ]
    documented = [text for node in public if (text := ast.get_docstring(node))]
    listing = sum(any(map(_lists_names, tree.body)) for tree in trees)
    long = [node for node in functions if (node.end_lineno or 0) - node.lineno >= LONG_FUNCTION]
    return (
        f"`{package}`",
        f"{len(texts):,}",
        f"{median(lines):.0f}",
        f"{sum(count > LONG_MODULE for count in lines) / len(lines):.0%}",
        f"{len(functions):,}",
        f"{len(long) / len(functions):.1%}",
        f"{len(documented) / len(public):.0%}",
        f"{sum('>>>' in text for text in documented) / len(public):.0%}",
        f"{listing / len(texts):.0%}",
        "yes" if (folder / "py.typed").exists() else "no",
    )


def _lists_names(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Assign) and any(
        isinstance(target, ast.Name) and target.id == "__all__" for target in statement.targets
    )


def main() -> None:
    """Print a table of the packages that are named."""
    rows = [_COLUMNS, ("---",) * len(_COLUMNS)]
    for package in sys.argv[1:]:
        found = find_spec(package)
        if found is None or found.origin is None:
            sys.exit(f"'{package}' is not installed here")
        rows.append(shape(package, Path(found.origin).parent))
    assert all(len(one) == len(other) for one, other in pairwise(rows))
    for row in rows:
        print(f"| {' | '.join(row)} |")


if __name__ == "__main__":
    main()
