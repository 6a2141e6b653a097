"""What the robot of a planning domain knows: options of the commands that plan and simulate."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from seewhy.knowledge.axiom import Axiom
    from seewhy.knowledge.learned_file import Withdrawn
    from seewhy.planning.domain import PlanningDomain

Learned = Annotated[
    Path | None,
    typer.Option("--learned", help="Axioms that 'seewhy learn --runs' has written: known, too."),
]
Without = Annotated[
    list[str] | None,
    typer.Option(
        "--without",
        metavar="AXIOM",
        help="An axiom of knowledge.al that the robot does not know; may be given several times.",
    ),
]


def with_knowledge_of_robot(
    domain: PlanningDomain, *, learned: Path | None, without: list[str] | None
) -> PlanningDomain:
    """Return the domain with what the robot knows: less than it says, and what was learned."""
    for statement in without or ():
        domain = domain.without(statement)
    return domain if learned is None else domain.knowing(learned_before(domain, learned)[0])


def learned_before(
    domain: PlanningDomain, learned: Path
) -> tuple[tuple[Axiom, ...], tuple[Withdrawn, ...]]:
    """Return the axioms of a file that 'seewhy learn --runs' has written, and those withdrawn."""
    from seewhy.errors import KnowledgeError
    from seewhy.knowledge.learned_file import read_learned

    if not learned.is_file():
        raise KnowledgeError(
            f"{learned}: there is no such file; 'seewhy learn DOMAIN --runs FOLDER --out FILE' "
            "writes one"
        )
    return read_learned(learned, domain.knowledge.signature)


def robot_options(*, learned: Path | None, without: list[str] | None) -> str:
    """Return the options as they were given, to be shown in a command."""
    said = [f' --without "{statement}"' for statement in without or ()]
    return "".join([*said, f" --learned {learned}" if learned else ""])
