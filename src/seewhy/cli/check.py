"""`seewhy check`: read a domain folder as a whole and say what is wrong with it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from seewhy.cli.options import DomainName, Json
from seewhy.cli.screen import add_row, output, percent, print_json, say, table


def check(
    domain: DomainName,
    data: Annotated[
        Path | None,
        typer.Option("--data", help="Also say how often each axiom is right on this dataset."),
    ] = None,
    json: Json = False,
) -> None:
    """Check a domain folder: its files, words, axioms and questions."""
    from seewhy.domain import load_domain
    from seewhy.domain_check import check_domain
    from seewhy.planning.domain import plans_only

    if plans_only(domain):
        _check_planning(domain, json=json)
        return
    own = load_domain(domain)
    report = check_domain(own, data)
    if json:
        print_json(report.to_dict())
        return
    say(f"{own.title} ({own.name}) in {own.folder}")
    say(f"  features: {', '.join(f'{k} ({len(f.values)})' for k, f in own.features.items())}")
    say(f"  classes: {', '.join(own.classes)}")
    say(f"  axioms: {len(own.knowledge.axioms)}")
    say(f"  questions: {report.questions} in {report.wordings} wordings")
    verdicts = ", ".join(f"{name} {percent(share)}" for name, share in report.verdicts.items())
    say(f"  of {report.vectors} feature vectors: {verdicts}")
    for warning in report.warnings:
        say(f"  note: {warning}")
    if report.axioms:
        rows = table("axiom", ">decides", ">right")
        for record in report.axioms:
            add_row(rows, record.statement, str(record.decided), percent(record.accuracy))
        output().print(rows)
        say(
            f"decided: {percent(report.decided or 0.0)} of the scenes, "
            f"{percent(report.decided_rightly or 0.0)} of those rightly"
        )
    say("nothing is wrong")


def _check_planning(domain: str, *, json: bool) -> None:
    from seewhy.planning.check import check_change
    from seewhy.planning.domain import load_planning_domain

    own = load_planning_domain(domain)
    notes = check_change(own)
    kinds = [predicate.kind for predicate in own.knowledge.signature.predicates.values()]
    counts = {
        "fluents": sum(kind.is_fluent for kind in kinds),
        "actions": sum(kind.is_action for kind in kinds),
        "axioms": len(own.knowledge.axioms),
    }
    if json:
        print_json({"name": own.name, **counts, "notes": list(notes)})
        return
    say(f"{own.title} ({own.name}) in {own.folder}")
    for name, count in counts.items():
        say(f"  {name}: {count}")
    for note in notes:
        say(f"  note: {note}")
    say("nothing is wrong")
