"""Say a path of the decision tree as a sentence with its support."""

from __future__ import annotations

from seewhy.domain import Domain
from seewhy.induction.tree import TreePath
from seewhy.wording import join_clauses, say_values


def say_path(domain: Domain, path: TreePath) -> str:
    """Return a path as "if … then … (94 % of 212 scenes)".

    Examples
    --------
    >>> from seewhy.domain import load_domain
    >>> from seewhy.induction.tree import PathCondition
    >>> path = TreePath((PathCondition("num_blocks", ("4", "5")), PathCondition("lean", ("yes",))),
    ...                 label="unstable", support=212, precision=0.94)
    >>> say_path(load_domain("structure_stability"), path)  # doctest: +NORMALIZE_WHITESPACE
    'if the structure has four or five blocks and it leans to one side, then it is unstable
     (2 of 4 features tested, 94 % of 212 structures)'
    """
    clauses = [
        say_values(domain, c.feature, c.values)
        if c.values
        else f"the {domain.features[c.feature].name} is not known"
        for c in path.conditions
    ]
    tested = f"{len(path.conditions)} of {len(domain.features)} features tested"
    things = domain.scene.replace("_", " ") + "s"
    support = f"({tested}, {path.precision:.0%} of {path.support} {things})".replace("%", " %")
    label = domain.classes[path.label].say
    if not clauses:
        return f"{domain.subject} is {label} unless something says otherwise {support}"
    joined = join_clauses(clauses, subject=domain.subject)
    if len(clauses) == 2:
        joined = joined.replace(", and ", " and ")
    return f"if {joined}, then it is {label} {support}"
