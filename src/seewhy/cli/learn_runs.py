"""`seewhy learn --runs`: what is usually so, and what does not work, from earlier runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.cli.axiom_lines import axiom_dict, rests
from seewhy.cli.robot import learned_before
from seewhy.cli.screen import print_json, remark, say

if TYPE_CHECKING:
    from seewhy.knowledge.axiom import Axiom
    from seewhy.planning.domain import PlanningDomain
    from seewhy.planning.learning.learning_from_runs import LearnedFromRuns

Accept = Callable[[Sequence["Axiom"]], Sequence["Axiom"]]
"""Which of the axioms found are taken over."""


def learn_from_record(
    domain: PlanningDomain,
    runs: Path,
    out: Path,
    *,
    learned: Path | None,
    support: float | None,
    tolerance: float | None,
    seed: int,
    accept: Accept | None,
    keep: bool,
    json: bool,
) -> None:
    """Learn from all records in a folder, and write what was accepted.

    ``learned`` has what was learned before. ``keep`` False only shows what is found.
    """
    from seewhy.files.whole_files import write_whole
    from seewhy.knowledge.learned_file import learned_text
    from seewhy.planning.learning.learning_from_runs import SUPPORT, learn_from_runs
    from seewhy.planning.things.recorded_scene import read_record

    known, gone = ((), ()) if learned is None else learned_before(domain, learned)
    files = _records(runs)
    found = learn_from_runs(
        domain,
        [read_record(domain, file) for file in files],
        names=list(map(str, files)),
        support=SUPPORT if support is None else support,
        tolerance=tolerance,
        seed=seed,
        learned=known,
    )
    if found.held_back and found.attempts:
        remark(
            f"{found.held_back} of {found.runs} runs are held back: nothing is learned from what "
            "was tried in them, they judge what is proposed"
        )
    added = list(found.axioms if accept is None else accept(found.axioms))
    if keep and (added or found.kept or found.withdrawn or not found.axioms):
        text = learned_text(
            [*found.kept, *added],
            [*gone, *found.withdrawn],
            source=f"the record of {len(files)} runs",
        )
        write_whole(out, text)
    if json:
        print_json(_to_dict(found, added))
        return
    _print(found, added)
    if keep and (added or found.kept or found.withdrawn):
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
    for gone in found.withdrawn:
        say(f"withdrawn: {gone.statement} {gone.reason}")
    for axiom in found.kept:
        say(f"kept: {axiom}  ({rests(axiom)})")
    if not found.axioms:
        say(f"no axiom is to be learned from these {found.runs} runs")
    for axiom in added:
        say(f"added: {axiom.text}")
        say(f"  {axiom}  ({rests(axiom)}{_held_back(found, axiom)})")
    for rejection in found.rejected:
        say(f"not added: {rejection.axiom} {rejection.reason}")


def _held_back(found: LearnedFromRuns, axiom: Axiom) -> str:
    """How the runs held back bear an axiom out; nothing where they do not judge it."""
    judged = found.judged.get(str(axiom))
    if judged is None or not found.held_back:
        return ""
    spoken = judged.right + judged.wrong
    return f"; in the runs held back {judged.right} of {spoken}"


def _to_dict(found: LearnedFromRuns, added: Sequence[Axiom]) -> dict[str, Any]:
    return {
        "runs": found.runs,
        "held_back": found.held_back,
        "observations": found.observations,
        "attempts": found.attempts,
        "tolerances": dict(found.tolerances),
        "found": [str(axiom) for axiom in found.axioms],
        "added": [axiom_dict(axiom) for axiom in added],
        "kept": [axiom_dict(axiom) for axiom in found.kept],
        "withdrawn": [
            {"statement": gone.statement, "reason": gone.reason} for gone in found.withdrawn
        ],
        "rejected": [
            {"statement": str(rejection.axiom), "reason": rejection.reason}
            for rejection in found.rejected
        ],
    }
