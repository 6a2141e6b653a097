"""Say a path of the decision tree as a sentence with its support."""

from __future__ import annotations

from collections.abc import Sequence

from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_clauses, join_words, say_values
from seewhy.induction.tree import PathCondition, TreePath


def say_path(domain: Domain, path: TreePath) -> str:
    """Return a path as "of the scenes that no rule decides, if … then … (94 % of 212 scenes)".

    Of other scenes it says nothing: the tree is grown from those that the knowledge leaves open or
    gets wrong.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> path = TreePath((PathCondition("num_blocks", ("4", "5")), PathCondition("lean", ("yes",))),
    ...                 label="unstable", support=212, precision=0.94)
    >>> say_path(load_domain("structure_stability"), path)  # doctest: +NORMALIZE_WHITESPACE
    'of the structures that no rule decides, if the structure has four or five blocks and it leans
     to one side, then it is unstable (2 of 4 features tested, 94 % of 212 structures)'
    """
    tested = f"{len(path.conditions)} of {len(domain.features)} features tested"
    support = f"({tested}, {path.precision:.0%} of {path.support} {things(domain)})"
    if not path.conditions:
        label = domain.classes[path.label].say
        said = f"each is taken to be {label}"
    else:
        said = say_rule(domain, path.conditions, path.label)
    as_often = join_words([domain.classes[label].say for label in path.equals])
    tied = f", and as often {as_often}" if as_often else ""
    scope = f"of the {things(domain)} that no rule decides"
    return f"{scope}, {said}{tied} {support.replace('%', ' %')}"


def say_rule(domain: Domain, conditions: Sequence[PathCondition], label: str) -> str:
    """Return conditions and the class that they make as "if … then it is …".

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> leans = PathCondition("lean", ("yes",))
    >>> say_rule(load_domain("structure_stability"), [leans], "unstable")
    'if the structure leans to one side, then it is unstable'
    """
    clauses = [
        say_values(domain, condition.feature, condition.values)
        if condition.values
        else f"the {domain.features[condition.feature].name} is not known"
        for condition in conditions
    ]
    if not clauses:
        return f"{domain.subject} is {domain.classes[label].say}"
    joined = join_clauses(clauses, subject=domain.subject)
    if len(clauses) == 2:
        joined = joined.replace(", and ", " and ")
    return f"if {joined}, then it is {domain.classes[label].say}"


def things(domain: Domain) -> str:
    """Return what several scenes of a domain are called.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> things(load_domain("structure_stability"))
    'structures'
    """
    return domain.scene.replace("_", " ") + "s"
