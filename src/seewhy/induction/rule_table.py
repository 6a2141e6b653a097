"""Rules as a data frame, whatever they come from: a decision tree, or axioms given and learned."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from seewhy.files.data_frame import data_frame
from seewhy.induction.sentence import say_path
from seewhy.induction.tree import DecisionTree, PathCondition, TreePath
from seewhy.knowledge.axiom import Axiom

if TYPE_CHECKING:
    import pandas as pd

    from seewhy.domain.domain import Domain
    from seewhy.induction.axiom_learning import Judgement

__all__ = ["COLUMNS", "rules_of_axioms", "rules_of_judgements", "rules_of_tree"]

COLUMNS = ("rule", "sentence", "kind", "concludes", "origin", "support", "precision")
"""The columns of every such table.

``rule`` is the statement, ``sentence`` the same in words, ``kind`` what sort of rule it is,
``concludes`` the class or literal, ``origin`` "given", "learned" or "tree"; ``support`` counts the
scenes that it speaks about and ``precision`` is the share of them on which it is right (none of
what was given).
"""

_TREE = "path of a tree"
_AXIOM = "axiom over features"


def rules_of_tree(tree: DecisionTree, domain: Domain | None = None) -> pd.DataFrame:
    """Return the paths of a tree, one a row, from the leftmost leaf to the rightmost.

    Parameters
    ----------
    tree : DecisionTree
        One that is not fitted has no rows.
    domain : Domain, optional
        Whose words sentences are in; without it they name features and values as they are.

    Raises
    ------
    SeeWhyError
        If pandas is not installed.

    Examples
    --------
    >>> tree = DecisionTree({"size": ["1", "2", "3"], "lean": ["yes", "no"]})
    >>> scenes = [("1", "no"), ("2", "no"), ("3", "no"), ("3", "yes")] * 10
    >>> table = rules_of_tree(tree.fit(scenes, ["up", "up", "up", "down"] * 10))
    >>> table[["rule", "support"]].values.tolist()
    [['up if lean = no.', 30], ['down if lean = yes.', 10]]
    """
    paths = tree.paths()
    return _table(
        _row(path, kind=_TREE, origin="tree", said=say_path(domain, path) if domain else None)
        for path in paths
    )


def rules_of_axioms(axioms: Iterable[Axiom]) -> pd.DataFrame:
    """Return axioms, one a row, in their order.

    Raises
    ------
    SeeWhyError
        If pandas is not installed.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> table = rules_of_axioms(load_domain("structure_stability").knowledge.axioms)
    >>> table.loc[0, ["rule", "origin"]].tolist()
    ['-stable(S) if block_displaced(S).', 'given']
    """
    return _table(
        {
            "rule": str(axiom),
            "sentence": axiom.text,
            "kind": axiom.kind.value,
            "concludes": str(axiom.head),
            "origin": "learned" if axiom.origin.learned else "given",
            "support": axiom.origin.support if axiom.origin.learned else None,
            "precision": axiom.origin.precision if axiom.origin.learned else None,
        }
        for axiom in axioms
    )


def rules_of_judgements(judgements: Iterable[Judgement]) -> pd.DataFrame:
    """Return what induction judged, one a row, in its order, where no domain has words for it.

    Raises
    ------
    SeeWhyError
        If pandas is not installed.
    """
    paths = [
        TreePath(
            judgement.candidate.conditions,
            label=judgement.candidate.label,
            support=judgement.tally.right + judgement.tally.wrong,
            precision=judgement.tally.precision,
        )
        for judgement in judgements
    ]
    return _table(_row(path, kind=_AXIOM, origin="learned") for path in paths)


def _row(path: TreePath, *, kind: str, origin: str, said: str | None = None) -> dict[str, object]:
    return {
        "rule": _rule(path),
        "sentence": _plain(path) if said is None else said,
        "kind": kind,
        "concludes": path.label,
        "origin": origin,
        "support": path.support,
        "precision": path.precision,
    }


def _table(rows: Iterable[dict[str, object]]) -> pd.DataFrame:
    known = list(rows)
    return data_frame({column: [row[column] for row in known] for column in COLUMNS})


def _rule(path: TreePath) -> str:
    conditions = ", ".join(map(_condition, path.conditions))
    return f"{path.label}{' if ' if conditions else ''}{conditions}."


def _condition(condition: PathCondition) -> str:
    values = condition.values
    if len(values) == 1:
        return f"{condition.feature} = {values[0]}"
    return f"{condition.feature} in {{{', '.join(values)}}}"


def _plain(path: TreePath) -> str:
    conditions = " and ".join(
        f"{condition.feature} is {' or '.join(condition.values) or 'not known'}"
        for condition in path.conditions
    )
    return f"if {conditions}, then {path.label}" if conditions else f"always {path.label}"
