"""`seewhy axioms`: what a model knows, given and learned."""

from __future__ import annotations

from typing import Annotated

import typer

from seewhy.cli.axiom_lines import axiom_dict, withdrawn_dict, withdrawn_line
from seewhy.cli.options import Json, ModelFolder
from seewhy.cli.screen import add_row, output, print_json, say, table


def axioms(
    model: ModelFolder,
    remove: Annotated[
        str | None,
        typer.Option("--remove", metavar="ID", help="Withdraw a learned axiom."),
    ] = None,
    restore: Annotated[
        str | None,
        typer.Option("--restore", metavar="ID", help="Know a given axiom again, set aside before."),
    ] = None,
    json: Json = False,
) -> None:
    """List the axioms of a model as sentences, given and learned, and those known no more."""
    from seewhy.agent.agent import Agent

    agent = Agent.load(model)
    if remove is not None:
        gone = agent.withdraw(remove)
        agent.save(model)
        if not json:
            say(f"withdrawn: {gone.statement}")
            return
    if restore is not None:
        restored = agent.restore(restore)
        agent.save(model)
        if not json:
            say(f"known again: {restored}")
            return
    known = agent.domain.knowledge.axioms
    if json:
        print_json(
            {
                "axioms": [axiom_dict(axiom) for axiom in known],
                "withdrawn": [withdrawn_dict(agent, withdrawn) for withdrawn in agent.withdrawn],
            }
        )
        return
    rows = table("id", "axiom", "origin")
    for axiom in known:
        origin = axiom.origin
        place = f"learned from {origin.support} {origin.things}" if origin.learned else "given"
        add_row(rows, axiom.identifier, axiom.text, place)
    output().print(rows)
    for gone in agent.withdrawn:
        say(f"{withdrawn_line(agent, gone)}")
