"""The page of an experiment: figures, tables, tests and conclusions in one HTML file."""

from __future__ import annotations

import math
import platform
from collections.abc import Sequence

from seewhy.report.html import rendered
from seewhy.report.line_chart import Line, Point, draw_lines
from seewhy_lab.experiments.catalogue import experiment
from seewhy_lab.experiments.conclusions import Compared, Finding, summary, values_of
from seewhy_lab.experiments.effort import efforts, training_parts
from seewhy_lab.experiments.experiment import Experiment, Measure, Row, say_size
from seewhy_lab.experiments.origin import here, installed, one_machine, say_machine, say_origins
from seewhy_lab.experiments.rows import is_timing
from seewhy_lab.experiments.running import Run
from seewhy_lab.experiments.statistics import interval

__all__ = ["LIBRARIES", "comparison_cells", "experiment_page"]

LIBRARIES = ("seewhy", "torch", "clingo", "scikit-learn", "scipy", "numpy", "mujoco-core")


def experiment_page(
    run: Run, rows: Sequence[Row], findings: Sequence[Finding], *, command: str
) -> str:
    """Return the page as the text of an HTML file that opens with no network.

    Parameters
    ----------
    run : Run
    rows : sequence of rows
        Of the trials that are finished.
    findings : sequence of Finding
        See :func:`seewhy_lab.experiments.conclusions.conclude`.
    command : str
        What makes the page, for its last lines.
    """
    design = experiment(run.experiment)
    sizes = list(dict.fromkeys(row["size"] for row in rows))
    finished = len({(row["seed"], row["size"]) for row in rows})
    timed, machine = one_machine(rows)
    return rendered(
        "experiment.html",
        package="seewhy_lab",
        experiment=design,
        domain=run.domain,
        reading=run.reading,
        finished=finished,
        planned=len(run.trials),
        measures=[_measure(design, measure, rows, sizes) for measure in design.measures],
        summary=summary(findings),
        findings=[_tested(design, finding) for finding in findings],
        efforts=_efforts(design, rows),
        parts=training_parts(timed),
        timings=_timings(design, timed, sizes),
        timed=say_machine(rows, timed, machine),
        maker=here().commit,
        origins=say_origins(rows),
        seeds=_span(sorted({int(row["seed"]) for row in rows})),
        tested=_span(sorted({int(row["tested"]) for row in rows if "tested" in row})),
        libraries=[(name, installed(name)) for name in LIBRARIES],
        python=platform.python_version(),
        command=command,
    )


def _measure(
    design: Experiment, measure: Measure, rows: Sequence[Row], sizes: Sequence[int]
) -> dict[str, object]:
    lines, table = [], []
    for system, name in design.systems.items():
        points, cells = [], []
        for size in sizes:
            values = list(values_of(rows, system, size, measure.key).values())
            if not values:
                cells.append("–")
                continue
            found = interval(values)
            points.append(Point(say_size(size), found.mean, found.low, found.high))
            cells.append(
                f"{100 * found.mean:.1f} ({100 * found.low:.1f} to {100 * found.high:.1f})"
            )
        if points:
            lines.append(Line(name, tuple(points)))
            table.append({"name": name, "cells": cells})
    labels = [say_size(size) for size in sizes]
    return {
        "name": measure.name,
        "sizes": labels,
        "systems": table,
        "figure": draw_lines(lines, labels, across=design.across, up=measure.name).svg,
    }


def _tested(design: Experiment, finding: Finding) -> dict[str, object]:
    claim = finding.claim
    return {
        "measure": design.measure(claim.measure).name,
        "system": design.systems[claim.system],
        "against": design.systems[claim.against],
        "text": finding.text,
        "supported": finding.supported,
        "sizes": [
            [say_size(comparison.size), *comparison_cells(comparison, times=100)]
            for comparison in finding.compared
        ],
    }


def comparison_cells(compared: Compared, *, times: float = 1) -> list[str]:
    """Return trials, difference, interval, effect, p-values and verdict, as a line of a table.

    Differences are given so many ``times``: 100 makes points of shares.
    """
    paired = compared.paired
    difference = paired.difference
    return [
        str(paired.trials),
        f"{times * difference.mean:+.2f}",
        f"{times * difference.low:+.2f} to {times * difference.high:+.2f}",
        "–" if not math.isfinite(paired.effect) else f"{paired.effect:+.2f}",
        _p(paired.p_t),
        _p(compared.corrected_t),
        _p(paired.p_wilcoxon),
        _p(compared.corrected_wilcoxon),
        compared.verdict,
    ]


def _p(value: float) -> str:
    if math.isnan(value):
        return "–"
    return f"{value:.3f}" if value >= 0.001 else f"{value:.0e}"


def _efforts(design: Experiment, rows: Sequence[Row]) -> list[dict[str, object]]:
    """For every level: what each system needs to classify so many pictures rightly."""
    found: dict[float, dict[str, object]] = {}
    for effort in efforts(rows, list(design.systems), design.measures[0].key):
        line = found.setdefault(effort.level, {"level": f"{100 * effort.level:.0f} %", "cells": []})
        cells = line["cells"]
        assert isinstance(cells, list)
        pictures = "not reached" if effort.pictures is None else f"{effort.pictures:,.0f}"
        cells.append(pictures + ("" if effort.seconds is None else f" ({effort.seconds:,.0f} s)"))
    return list(found.values())


def _timings(design: Experiment, rows: Sequence[Row], sizes: Sequence[int]) -> dict[str, object]:
    """Mean processor seconds of every part of a trial, by system and size."""
    columns = list(dict.fromkeys(name for row in rows for name in row if is_timing(name)))
    lines = []
    for system, name in design.systems.items():
        for size in sizes:
            cells = []
            for column in columns:
                spent = list(values_of(rows, system, size, column).values())
                cells.append(f"{sum(spent) / len(spent):.1f}" if spent else "–")
            lines.append([name, say_size(size), *cells])
    names = [name.removeprefix("seconds_").replace("_", " ") for name in columns]
    return {"columns": names, "lines": lines if columns else []}


def _span(numbers: Sequence[int]) -> str:
    if not numbers:
        return "none"
    return str(numbers[0]) if len(numbers) == 1 else f"{numbers[0]} to {numbers[-1]}"
