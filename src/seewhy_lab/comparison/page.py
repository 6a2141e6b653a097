"""The page over all trials that there are: a table a set, and what is missing."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from seewhy_lab.comparison.picture_sets import PictureSet
from seewhy_lab.comparison.system import System
from seewhy_lab.comparison.trials import Result, Trial, is_too_many
from seewhy_lab.experiments.experiment import ALL, say_size

__all__ = ["page"]

NONE = "–"

Shares = Mapping[int, float]  # seed → accuracy


def page(
    results: Collection[Result],
    *,
    sets: Sequence[PictureSet],
    systems: Sequence[System],
    asked: Collection[Trial],
    seeds: int,
) -> str:
    """The page, in Markdown.

    Parameters
    ----------
    results : collection of Result
        Those that there are; of other sets and systems they are left out.
    sets : sequence of PictureSet
    systems : sequence of System
        In the order of the columns; the first is compared with the best of the others.
    asked : collection of Trial
        What would be there if everything were run.
    seeds : int
        How many seeds are asked for.
    """
    names = {chosen.name for chosen in sets}, {system.name for system in systems}
    shown = [
        result
        for result in results
        if result.trial.pictures in names[0] and result.trial.system in names[1]
    ]
    there = {result.trial for result in shown}
    missing = [trial for trial in asked if trial not in there]
    lines = [
        "# SeeWhy beside what else one would try",
        "",
        "Accuracy in per cent on the same held-out pictures, mean ± standard error over seeds; a "
        "seed settles which pictures are labelled. The best of a row is bold. A number of seeds "
        f"stands where it is not {seeds}; {NONE} is what was not run.",
        "",
    ]
    if missing:
        lines += [f"**Missing: {len(missing)} of {len(set(asked))} trials.**", ""]
    for chosen in sets:
        lines += [f"## {chosen.title}", ""]
        of_set = [result for result in shown if result.trial.pictures == chosen.name]
        trials = [trial for trial in asked if trial.pictures == chosen.name]
        trials += [result.trial for result in of_set]
        for drawn in sorted({trial.drawn for trial in trials}):
            counts = {trial.count for trial in trials if trial.drawn == drawn}
            some = [result for result in of_set if result.trial.drawn == drawn]
            if drawn:
                lines += [f"Every system was trained on {drawn:,} drawings before.", ""]
            if some:
                lines += [_say_tested(some), ""]
            lines += _table(some, sorted(counts, key=lambda n: (n == ALL, n)), systems, seeds)
            lines += _footnotes(some, counts, systems)
    lines += [_say_origins(shown)]
    return "\n".join(lines).rstrip() + "\n"


def _table(
    results: Sequence[Result], counts: Sequence[int], systems: Sequence[System], seeds: int
) -> list[str]:
    heads = [f"({system.letter}) {system.title}" for system in systems]
    if len(systems) > 1:
        heads.append(f"({systems[0].letter}) − best of the others")
    rows = [f"| labels | {' | '.join(heads)} |", "|---" * (len(heads) + 1) + "|"]
    for count in counts:
        by_system = [
            {
                result.trial.seed: result.accuracy
                for result in results
                if (result.trial.count, result.trial.system) == (count, system.name)
            }
            for system in systems
        ]
        means = [float(np.mean(list(shares.values()))) for shares in by_system if shares]
        cells = []
        for shares in by_system:
            text = _say_share(shares, seeds)
            # What is printed alike is as good.
            best = bool(shares) and _percent(np.mean(list(shares.values()))) == _percent(max(means))
            cells.append(f"**{text}**" if best else text)
        if len(systems) > 1:
            cells.append(_say_difference(by_system, systems, seeds))
        rows.append(f"| {say_size(count)} | {' | '.join(cells)} |")
    return [*rows, ""]


def _say_share(shares: Shares, seeds: int) -> str:
    if not shares:
        return NONE
    numbers = np.array(list(shares.values()))
    text = _percent(numbers.mean())
    if len(numbers) > 1:
        text += f" ± {_percent(_error(numbers))}"
    return text + _say_seeds(len(numbers), seeds)


def _say_difference(by_system: Sequence[Shares], systems: Sequence[System], seeds: int) -> str:
    """By how much the first is better than the one that it is least better than.

    Compared is over the seeds that both have, so that what is missing favours nobody.
    """
    ours = by_system[0]
    found = []
    for system, shares in zip(systems[1:], by_system[1:], strict=True):
        both = sorted(ours.keys() & shares.keys())
        if both:
            apart = np.array([ours[seed] - shares[seed] for seed in both])
            found.append((float(apart.mean()), system.letter, apart))
    if not found:
        return NONE
    mean, letter, apart = min(found, key=lambda row: row[0])
    text = f"{100 * mean:+.1f}".replace("-", "−")
    if len(apart) > 1:
        text += f" ± {_percent(_error(apart))}"
    return f"{text} over ({letter})" + _say_seeds(len(apart), seeds)


def _say_seeds(count: int, seeds: int) -> str:
    if count == seeds:
        return ""
    return f" ({count} seed{'s' * (count != 1)})"


def _error(numbers: np.ndarray[tuple[int], np.dtype[np.float64]]) -> float:
    return float(numbers.std(ddof=1)) / math.sqrt(len(numbers))


def _percent(share: float | np.floating) -> str:
    return f"{100 * float(share):.1f}"


def _say_tested(results: Sequence[Result]) -> str:
    tested = sorted({result.tested for result in results})
    alike = "Tested on " + " or ".join(f"{count:,}" for count in tested) + " pictures."
    return alike if len(tested) == 1 else f"{alike} **Trials were not tested on the same.**"


def _footnotes(
    results: Sequence[Result], counts: Collection[int], systems: Sequence[System]
) -> list[str]:
    found = []
    for system in systems:
        of_system = [result for result in results if result.trial.system == system.name]
        absent = {count for count in counts if is_too_many(system, count)}
        absent -= {result.trial.count for result in of_system}
        if absent:
            found.append(
                f"({system.letter}) is run with at most {system.most} labels without a graphics "
                "processor."
            )
        unknown = [result.unknown for result in of_system]
        if unknown and np.mean(unknown) >= 0.0005:
            found.append(
                f"Of {_percent(np.mean(unknown))} % of the pictures ({system.letter}) decides on "
                "no class; they count as wrong."
            )
    return [" ".join(found), ""] if found else []


def _say_origins(results: Sequence[Result]) -> str:
    """Which commits made how many trials, on which machines."""
    if not results:
        return "There is no trial yet."
    commits = Counter(result.commit for result in results)
    machines = Counter(result.machine for result in results)
    made = ", ".join(f"{name} ({n} trial{'s' * (n != 1)})" for name, n in sorted(commits.items()))
    return f"Made by {made}; on {', '.join(sorted(machines))}."
