"""`seewhy learn --runs`: what is usually so, from the record of a robot's earlier runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.cli.axiom_lines import axiom_dict
from seewhy.cli.screen import print_json, remark, say
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.knowledge.axiom import Axiom
    from seewhy.planning.domain import PlanningDomain
    from seewhy.planning.learning.learning_defaults import LearnedFromRuns

Accept = Callable[[Sequence["Axiom"]], Sequence["Axiom"]]
"""Which of the axioms found are taken over."""


def learn_from_record(
    domain: PlanningDomain,
    runs: Path,
    out: Path,
    *,
    support: float | None,
    tolerance: float | None,
    seed: int,
    accept: Accept | None,
    json: bool,
) -> None:
    """Learn from all records in a folder, and write what was accepted."""
    from seewhy.files.whole_files import write_whole
    from seewhy.knowledge.history import read_history_file
    from seewhy.knowledge.learned_file import learned_text
    from seewhy.planning.learning.learning_defaults import SUPPORT, learn_from_runs

    files = _records(runs)
    found = learn_from_runs(
        domain,
        [read_history_file(file, domain.knowledge.signature) for file in files],
        names=list(map(str, files)),
        support=SUPPORT if support is None else support,
        tolerance=tolerance,
        seed=seed,
    )
    added = list(found.axioms if accept is None else accept(found.axioms))
    if added or not found.axioms:
        write_whole(out, learned_text(added, source=f"the record of {len(files)} runs"))
    if json:
        print_json(_to_dict(found, added))
        return
    _print(found, added)
    if added:
        remark(f"what was learned is in {out}; give it to plan or simulate with --learned")


def _records(folder: Path) -> list[Path]:
    from seewhy.errors import PlanningError

    remedy = "'seewhy simulate DOMAIN --goal GOAL --record FOLDER/NAME.al' records a run"
    if not folder.is_dir():
        raise PlanningError(f"{folder}: there is no such folder; {remedy}")
    files = sorted(file for file in folder.glob("*.al") if file.is_file())
    if not files:
        raise PlanningError(f"{folder}: there is no record (*.al) in this folder; {remedy}")
    return files


def _print(found: LearnedFromRuns, added: Sequence[Axiom]) -> None:
    if not found.axioms:
        say(f"no axiom is to be learned from these {found.runs} runs")
    for axiom in added:
        origin = axiom.origin
        said = f"{origin.support} {origin.things}, {percent(origin.precision)} of them rightly"
        say(f"added: {axiom.text}")
        say(f"  {axiom}  ({said})")
    for rejection in found.rejected:
        say(f"not added: {rejection.axiom} {rejection.reason}")


def _to_dict(found: LearnedFromRuns, added: Sequence[Axiom]) -> dict[str, Any]:
    return {
        "runs": found.runs,
        "observations": found.observations,
        "tolerances": dict(found.tolerances),
        "found": [str(axiom) for axiom in found.axioms],
        "added": [axiom_dict(axiom) for axiom in added],
        "rejected": [
            {"statement": str(rejection.axiom), "reason": rejection.reason}
            for rejection in found.rejected
        ],
    }
