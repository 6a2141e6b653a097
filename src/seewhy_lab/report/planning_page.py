"""The page of the planning experiment: ratios before to after learning beside the paper's."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from html import escape

from seewhy.knowledge.learned_file import LEARNED
from seewhy.report.figure import Figure
from seewhy.report.html import rendered
from seewhy_lab.experiments.experiment import Row
from seewhy_lab.experiments.origin import here, installed, one_machine, say_machine, say_origins
from seewhy_lab.experiments.planning import NAMES, SYSTEMS, Ratio, recipients_elsewhere, summary
from seewhy_lab.experiments.planning_run import PlanningRun
from seewhy_lab.experiments.statistics import Interval, can_tell
from seewhy_lab.report.experiment_page import LIBRARIES, comparison_cells

__all__ = ["conclusions", "draw_ratios", "planning_page"]

_VERDICTS = {
    "better": "significantly less after learning",
    "worse": "significantly more after learning",
    "open": "not told apart",
}

_WIDTH, _LEFT, _ROW, _TOP = 640, 190, 34, 10


def planning_page(run: PlanningRun, rows: Sequence[Row], *, command: str) -> str:
    """Return the page as the text of an HTML file that opens with no network."""
    elsewhere = recipients_elsewhere(run.seeds, before=run.before)
    at_work = [row for row in rows if not elsewhere[row["seed"]]]
    away = [row for row in rows if elsewhere[row["seed"]]]
    parts = [
        ("All trials", rows),
        ("The recipients are at first where they work", at_work),
        ("A recipient is at first elsewhere", away),
    ]
    timed, machine = one_machine(rows)
    found = summary(rows, machine=machine)
    return rendered(
        "planning.html",
        package="seewhy_lab",
        figure=draw_ratios(found).svg,
        sentences=conclusions(found),
        learned=(run.folder / LEARNED).read_text(encoding="utf-8"),
        tables=[
            {"name": name, "trials": len(part_rows) // 2, "lines": _lines(part_rows, machine)}
            for name, part_rows in parts
            if part_rows
        ],
        tests=[
            [NAMES[ratio.measure], *comparison_cells(ratio.compared)]
            for ratio in found
            if ratio.compared
        ],
        ended=[_ended(system, rows) for system in SYSTEMS],
        finished=len(rows) // 2,
        planned=run.trials,
        records=run.records,
        answer_sets=run.answer_sets,
        timed=say_machine(rows, timed, machine),
        maker=here().commit,
        origins=say_origins(rows),
        seeds=f"{run.seeds[0]} to {run.seeds[-1]}",
        libraries=[(name, installed(name)) for name in LIBRARIES],
        python=platform.python_version(),
        command=command,
    )


def conclusions(found: Sequence[Ratio]) -> list[str]:
    """Return a sentence for every measure, and one for the hypothesis, whatever the numbers say.

    Examples
    --------
    >>> from seewhy_lab.experiments.planning import MEASURES
    >>> rows = [{"seed": seed, "system": arm, **dict.fromkeys(MEASURES, number)}
    ...         for seed in range(9) for arm, number in (("before", 8.0 + seed), ("after", 4.0))]
    >>> conclusions(summary(rows))[0]
    'plans in a trial: 12.00 before, 4.00 after, significantly less after learning; the mean of \
the ratios 3.00 (2.56 to 3.42), less than in the paper (4.0).'
    >>> conclusions(summary(rows[:10]))[-1]
    'There are too few pairs for any difference to be significant after correction.'
    """
    said = []
    for ratio in found:
        interval = ratio.mean_of_ratios
        if not ratio.trials:
            said.append(f"{NAMES[ratio.measure]}: there is no finished pair yet.")
            continue
        verdict = ratio.compared.verdict if ratio.compared else "open"
        if interval.mean >= ratio.paper:
            beside = f"at least as in the paper ({ratio.paper})"
        elif interval.high >= ratio.paper:
            beside = f"the paper's figure ({ratio.paper}) lies within the interval"
        else:
            beside = f"less than in the paper ({ratio.paper})"
        means = f"{ratio.before:.2f} before, {ratio.after:.2f} after, {_VERDICTS[verdict]}"
        times = f"{interval.mean:.2f} ({interval.low:.2f} to {interval.high:.2f})"
        said.append(f"{NAMES[ratio.measure]}: {means}; the mean of the ratios {times}, {beside}.")
    return [*said, _hypothesis(found)]


def _hypothesis(found: Sequence[Ratio]) -> str:
    """Say of which measures the trials bear out that learning saves some of it."""
    told = [(ratio.measure, ratio.compared) for ratio in found if ratio.compared]
    if not any(can_tell([compared.paired.trials for _, compared in told])):
        return "There are too few pairs for any difference to be significant after correction."
    saved = [NAMES[measure] for measure, compared in told if compared.verdict == "better"]
    other = [
        f"{NAMES[measure]} ({_VERDICTS[compared.verdict]})"
        for measure, compared in told
        if compared.verdict != "better"
    ]
    if not saved:
        return "The hypothesis is not supported by any measure."
    said = f"The hypothesis is supported for {_listed(saved)}"
    return f"{said}; it is not supported for {_listed(other)}." if other else f"{said}."


def _listed(parts: Sequence[str]) -> str:
    return " and ".join(filter(None, [", ".join(parts[:-1]), parts[-1]]))


def draw_ratios(found: Sequence[Ratio]) -> Figure:
    """Draw every ratio with its interval, and the paper's as a hollow diamond.

    Examples
    --------
    >>> ratio = Ratio("plans", 9, 4.0, 2.0, Interval(2.0, 1.5, 3.0), Interval(2.0, 1.6, 2.5), 4.0)
    >>> draw_ratios([ratio]).width
    640
    """
    shown = [ratio for ratio in found if ratio.trials]
    most = max([2.0, *(max(ratio.mean_of_ratios.high, ratio.paper) for ratio in shown)])
    unit = (_WIDTH - _LEFT - 30) / most
    bottom = _TOP + _ROW * len(shown)
    parts = []
    for mark in range(int(most) + 1):
        x = _LEFT + unit * mark
        colour = "#888" if mark == 1 else "#e4e4e4"
        parts.append(
            f"<line x1='{x:.1f}' x2='{x:.1f}' y1='{_TOP}' y2='{bottom}' stroke='{colour}'/>"
            f"<text x='{x:.1f}' y='{bottom + 16}' text-anchor='middle' fill='#666'>{mark}</text>"
        )
    for number, ratio in enumerate(shown):
        y = _TOP + _ROW * (number + 0.5)
        low, middle, high, paper = (
            _LEFT + unit * value
            for value in (
                ratio.mean_of_ratios.low,
                ratio.mean_of_ratios.mean,
                ratio.mean_of_ratios.high,
                ratio.paper,
            )
        )
        parts.append(
            f"<text x='{_LEFT - 10}' y='{y + 4:.1f}' text-anchor='end'>"
            f"{escape(NAMES[ratio.measure])}</text>"
            f"<line x1='{low:.1f}' x2='{high:.1f}' y1='{y:.1f}' y2='{y:.1f}' stroke='#2f6fb3' "
            "stroke-width='3' stroke-linecap='round'/>"
            f"<circle cx='{middle:.1f}' cy='{y:.1f}' r='5.5' fill='#2f6fb3'/>"
            f"<path d='M{paper:.1f} {y - 7:.1f} l7 7 -7 7 -7 -7 z' fill='none' stroke='#c8651b' "
            "stroke-width='2'/>"
        )
    return Figure(width=_WIDTH, height=int(bottom) + 26, content="".join(parts))


def _lines(rows: Sequence[Row], machine: str) -> list[list[str]]:
    return [_line(ratio) for ratio in summary(rows, machine=machine)]


def _line(ratio: Ratio) -> list[str]:
    return [
        NAMES[ratio.measure],
        f"{ratio.before:.2f}",
        f"{ratio.after:.2f}",
        _said(ratio.mean_of_ratios),
        _said(ratio.ratio_of_means),
        str(ratio.paper),
        str(ratio.trials),
    ]


def _said(interval: Interval) -> str:
    return f"{interval.mean:.2f} ({interval.low:.2f} to {interval.high:.2f})"


def _ended(system: str, rows: Sequence[Row]) -> str:
    of_system = [row for row in rows if row["system"] == system]
    ends = [row["outcome"] for row in of_system]
    counts = ", ".join(f"{end} {ends.count(end)}" for end in sorted(set(ends)))
    reached = sum(row["achieved"] for row in of_system)
    return (
        f"{system} learning: {counts}; the goal was truly reached in {reached} of {len(of_system)}."
    )
