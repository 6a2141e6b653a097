"""Plans, actions and time before and after the robot has learned where people usually are.

The robot first makes runs without knowing it, learns from their record, and then pursues the same
random goals in the same random worlds, once without and once with what it learned. Finished runs
and trials are kept in OUT; the same command goes on from there.

    python experiments/planning_with_learned_axioms.py --out runs/planning --trials 100 --jobs 2
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from joblib import Parallel, delayed

from seewhy.experiments.planning import (
    RECORDED,
    Ratio,
    learned_from,
    recipients_elsewhere,
    recorded_run,
    robot_before,
    summary,
    trial,
)
from seewhy.experiments.statistics import Interval
from seewhy.files import write_whole
from seewhy.knowledge.history import history_text, read_history_file
from seewhy.knowledge.learned_file import learned_text, read_learned

NAMES = {
    "plans": "plans in a trial",
    "actions": "actions",
    "execution": "execution time",
    "seconds_planning": "planning time of a trial",
    "seconds_per_plan": "planning time of a plan",
}


def make_run(out: Path, number: int, before: int | None) -> None:
    """Record an earlier run, unless it is there."""
    file = out / "runs" / f"{number:04}.al"
    if not file.is_file():
        write_whole(file, history_text(recorded_run(number, before=before), title=f"run {number}"))


def make_trial(out: Path, seed: int, before: int | None, answer_sets: bool) -> None:
    """Write the rows of a trial, unless they are there."""
    file = trial_file(out, seed)
    if not file.is_file():
        axioms, _ = read_learned(out / "learned.al", robot_before().knowledge.signature)
        rows = trial(seed=seed, learned=axioms, before=before, answer_sets=answer_sets)
        write_whole(file, json.dumps({"trial": seed, "rows": rows}, indent=1))


def trial_file(out: Path, seed: int) -> Path:
    """Where a trial's rows lie."""
    return out / "trials" / f"{seed:04}.json"


def learn(out: Path, runs: int) -> None:
    """Learn from the record, unless it is done."""
    file = out / "learned.al"
    if file.is_file():
        return
    signature = robot_before().knowledge.signature
    record = [
        read_history_file(out / "runs" / f"{number:04}.al", signature) for number in range(runs)
    ]
    found = learned_from(record)
    write_whole(file, learned_text(found.axioms, source=f"the record of {runs} runs"))


def shown(own: Interval) -> str:
    """A figure with its interval."""
    return f"{own.mean:.2f} ({own.low:.2f} to {own.high:.2f})"


def line(own: Ratio) -> str:
    """A row of the table."""
    return (
        f"| {NAMES[own.measure]} | {own.before:.2f} | {own.after:.2f} "
        f"| {shown(own.mean_of_ratios)} | {shown(own.ratio_of_means)} "
        f"| {own.paper} | {own.trials} |"
    )


def main() -> None:
    """Run what is missing and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--trials", type=int, default=100)
    parser.add_argument("--runs", type=int, default=RECORDED, help="runs that are learned from")
    parser.add_argument(
        "--before",
        type=int,
        help="steps that people may walk about before the robot begins (else as planning.toml)",
    )
    parser.add_argument(
        "--answer-sets", action="store_true", help="plan by answer sets alone, as in the paper"
    )
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    work = Parallel(n_jobs=options.jobs)
    work(delayed(make_run)(options.out, number, options.before) for number in range(options.runs))
    learn(options.out, options.runs)
    print((options.out / "learned.al").read_text(encoding="utf-8"))
    work(
        delayed(make_trial)(options.out, seed, options.before, options.answer_sets)
        for seed in range(options.trials)
    )
    rows = [
        row
        for seed in range(options.trials)
        for row in json.loads(trial_file(options.out, seed).read_text(encoding="utf-8"))["rows"]
    ]
    print("| | before | after | mean of the ratios | ratio of the means | paper | pairs |")
    print("|---|---|---|---|---|---|---|")
    for own in summary(rows):
        print(line(own))
    for arm in ("before", "after"):
        ended = [row["outcome"] for row in rows if row["system"] == arm]
        reached = sum(row["achieved"] for row in rows if row["system"] == arm)
        counts = ", ".join(f"{own} {ended.count(own)}" for own in sorted(set(ended)))
        print(f"\n{arm}: {counts}; goal truly reached in {reached} of {len(ended)}", end="")
    elsewhere = recipients_elsewhere(range(options.trials), before=options.before)
    for text, seeds in (
        ("the recipients are at first where they work", [s for s, n in elsewhere.items() if not n]),
        ("a recipient is at first elsewhere", [s for s, n in elsewhere.items() if n]),
    ):
        print(f"\n\nOf the {len(seeds)} trials in which {text}:\n")
        for own in summary(row for row in rows if row["seed"] in seeds):
            print(line(own))


if __name__ == "__main__":
    main()
