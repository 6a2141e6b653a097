"""`seewhy check`: read a domain folder as a whole and say what is wrong with it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from seewhy.cli.options import DomainName, Json, Outside
from seewhy.cli.screen import add_row, output, print_json, say, share_of_cases, table
from seewhy.text.percentage import percent


def check(
    domain: DomainName,
    data: Annotated[
        Path | None,
        typer.Option("--data", help="Also say how often each axiom is right on this dataset."),
    ] = None,
    outside: Outside = False,
    json: Json = False,
) -> None:
    """Check a domain folder: its files, words, axioms and questions."""
    from seewhy.check.domain import check_domain
    from seewhy.cli.read_data import read_data
    from seewhy.domain.domain import load_domain
    from seewhy.planning.domain import plans, plans_only

    planning = _checked_planning(domain) if plans(domain) else None
    if planning is not None and plans_only(domain):
        if json:
            print_json(planning)
            return
        _print_planning(planning)
        say("nothing is wrong")
        return
    loaded = load_domain(domain)
    dataset = None if data is None else read_data(data, loaded, outside=outside)
    report = check_domain(loaded, dataset)
    if json:
        print_json({**report.to_dict(), **({"planning": planning} if planning else {})})
        return
    say(f"{loaded.title} ({loaded.name}) in {loaded.folder}")
    counts = (f"{key} ({len(feature.values)})" for key, feature in loaded.features.items())
    if loaded.features:
        say(f"  features: {', '.join(counts)}")
        say(f"  classes: {', '.join(loaded.classes)}")
    if loaded.things is not None:
        say(f"  features of things: {', '.join(loaded.things.features)}")
        say(f"  relations: {', '.join(loaded.things.relations) or 'none'}")
    say(f"  axioms: {len(loaded.knowledge.axioms)}")
    say(f"  questions: {report.questions} in {report.wordings} wordings")
    verdicts = ", ".join(f"{name} {percent(share)}" for name, share in report.verdicts.items())
    say(f"  of {report.vectors} feature vectors: {verdicts}")
    for warning in report.warnings:
        say(f"  note: {warning}")
    if report.axioms:
        rows = table("axiom", ">decides", ">right")
        for record in report.axioms:
            add_row(rows, record.statement, str(record.decided), share_of_cases(record.accuracy))
        output().print(rows)
        say(
            f"decided: {percent(report.decided or 0.0)} of the scenes, "
            f"{percent(report.decided_rightly or 0.0)} of those rightly"
        )
    if planning is not None:
        _print_planning(planning)
    for doubt in report.doubtful:
        say(f"doubtful: {doubt}")
    say(f"nothing is wrong{' but what is doubtful' if report.doubtful else ''}")


def _checked_planning(domain: str) -> dict[str, Any]:
    from seewhy.check.change import check_change
    from seewhy.planning.domain import load_planning_domain

    loaded = load_planning_domain(domain)
    notes = check_change(loaded)
    kinds = [predicate.kind for predicate in loaded.knowledge.signature.predicates.values()]
    return {
        "name": loaded.name,
        "title": loaded.title,
        "folder": str(loaded.folder),
        "fluents": sum(kind.is_fluent for kind in kinds),
        "actions": sum(kind.is_action for kind in kinds),
        "axioms": len(loaded.knowledge.axioms),
        "notes": list(notes),
    }


def _print_planning(found: dict[str, Any]) -> None:
    say(f"{found['title']} ({found['name']}) in {found['folder']}")
    for name in ("fluents", "actions", "axioms"):
        say(f"  {name}: {found[name]}")
    for note in found["notes"]:
        say(f"  note: {note}")
