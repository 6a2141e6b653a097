"""`seewhy experiment`: run an experiment of the paper and write its page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.command_line import as_typed
from seewhy.cli.options import Json, Reading
from seewhy.cli.screen import print_json, progress, remark, say

if TYPE_CHECKING:
    from seewhy_lab.experiments.experiment import Row
    from seewhy_lab.experiments.running import Run

ExperimentName = Annotated[
    str,
    typer.Argument(
        metavar="NAME",
        help="The experiment: vqa, axioms, planning, confidence, reading or ablation.",
    ),
]


def experiment(
    name: ExperimentName,
    out: Annotated[Path, typer.Option("--out", help="The folder for rows, tables and the page.")],
    domain: Annotated[
        str | None,
        typer.Option(
            "--domain",
            help="A bundled domain's name or a domain folder (structure_stability; planning is of "
            "robot_assistant).",
        ),
    ] = None,
    data: Annotated[
        Path | None,
        typer.Option(
            "--data", help="Annotated pictures to draw from; drawn by the domain's source without."
        ),
    ] = None,
    trials: Annotated[
        int | None, typer.Option("--trials", min=1, help="How many seeds (the paper's number).")
    ] = None,
    sizes: Annotated[
        str | None,
        typer.Option(
            "--sizes", help="Training pictures, as in 100,400,all (what the experiment says)."
        ),
    ] = None,
    seed: Annotated[int, typer.Option("--seed", min=0, help="The seed of the first trial.")] = 0,
    quick: Annotated[
        bool, typer.Option("--quick", help="A smaller version of at most ten minutes.")
    ] = False,
    jobs: Annotated[
        int, typer.Option("--jobs", min=-1, help="Trials at the same time; -1: one a core.")
    ] = -1,
    tested: Annotated[
        int | None,
        typer.Option("--tested", min=1, help="Pictures that a trial tests on, without groups."),
    ] = None,
    drawn: Annotated[
        int,
        typer.Option(
            "--drawn", min=0, help="Pictures of the domain's source that networks see before."
        ),
    ] = 0,
    reading: Reading = None,
    before: Annotated[
        int | None,
        typer.Option(
            "--before",
            min=0,
            help="With planning: steps that people may walk about before the robot begins.",
        ),
    ] = None,
    answer_sets: Annotated[
        bool,
        typer.Option("--answer-sets", help="With planning: plan by answer sets alone."),
    ] = False,
    json: Json = False,
) -> None:
    """Run an experiment, or what is missing of it, and write its tables and its page.

    Every finished trial is a file: a run that is stopped goes on where it was, and several
    processes or machines that see the same folder share the work.
    """
    from seewhy.cli.code_notice import remark_code
    from seewhy.domain.domain import load_domain
    from seewhy.errors import ExperimentError
    from seewhy_lab.experiments.catalogue import PLANNING
    from seewhy_lab.experiments.rows import write_tables
    from seewhy_lab.experiments.running import finished_rows, prepare, run_missing

    if jobs == 0:
        raise ExperimentError("--jobs must be -1 or at least 1, got 0")
    pictures = {
        "--domain": domain,
        "--data": data,
        "--sizes": sizes,
        "--tested": tested,
        "--reading": reading,
    }
    of_robot = {"--before": before is not None, "--answer-sets": answer_sets}
    _refuse_misplaced(name, {**pictures, "--drawn": drawn or None}, of_robot)
    if name == PLANNING:
        _planning(
            out, trials=trials, seed=seed, quick=quick, jobs=jobs, before=before,
            answer_sets=answer_sets, json=json,
        )  # fmt: skip
        return
    domain = domain or "structure_stability"
    if data is None or drawn:
        remark_code(load_domain(domain))
    with progress() as bars:
        drawing = bars.add_task("drawing pictures", total=None, visible=False)
        run = prepare(
            name,
            domain,
            out,
            data=data,
            trials=trials,
            sizes=None if sizes is None else read_sizes(sizes),
            first_seed=seed,
            quick=quick,
            tested=tested,
            drawn=drawn,
            reading=reading,
            workers=jobs,
            on_picture=lambda done: bars.update(drawing, completed=done, visible=True),
        )
        bars.update(drawing, visible=False)
        task = bars.add_task("trials", total=len(run.trials))
        try:
            run_missing(run, jobs=jobs, on_trial=lambda done: bars.update(task, completed=done))
        finally:
            write_tables(run.folder)
    _say_findings(run, finished_rows(run), domain=load_domain(domain).name, json=json)


def _refuse_misplaced(
    name: str, pictures: Mapping[str, object], of_robot: Mapping[str, bool]
) -> None:
    """Refuse options of pictures for the experiment with a robot, and the other way round."""
    from seewhy.errors import ExperimentError
    from seewhy_lab.experiments.catalogue import PLANNING

    if name == PLANNING:
        for option, given in pictures.items():
            if given is not None and (option, given) != ("--domain", "robot_assistant"):
                raise ExperimentError(
                    f"{option} goes with the other experiments; planning is of robot_assistant, "
                    "which needs no pictures for it"
                )
        return
    for option, asked in of_robot.items():
        if asked:
            raise ExperimentError(f"{option} goes with the experiment planning only")


def _say_findings(run: Run, rows: Sequence[Row], *, domain: str, json: bool) -> None:
    """Write the page of an experiment, and say what its rows show."""
    from seewhy.files.whole_files import write_whole
    from seewhy_lab.experiments.conclusions import conclude, summary
    from seewhy_lab.report.experiment_page import experiment_page

    findings = conclude(run.experiment, rows, domain=domain)
    page = run.folder / "index.html"
    write_whole(page, experiment_page(run, rows, findings, command=as_typed()))
    _remark_unfinished(rows, len(run.trials))
    if json:
        print_json(
            {
                "page": str(page),
                "summary": summary(findings),
                "findings": [finding.to_dict() for finding in findings],
            }
        )
        return
    for finding in findings:
        say(finding.text)
    say(summary(findings))
    say(f"page: {page}")


def _remark_unfinished(rows: Sequence[Row], planned: int) -> None:
    unfinished = planned - len({(row["seed"], row["size"]) for row in rows})
    if unfinished:
        remark(
            f"{unfinished} of {planned} trials are with other processes; the same command adds "
            "them when they are finished"
        )


def _planning(
    out: Path,
    *,
    trials: int | None,
    seed: int,
    quick: bool,
    jobs: int,
    before: int | None,
    answer_sets: bool,
    json: bool,
) -> None:
    """Run the experiment that needs no pictures."""
    from seewhy.files.whole_files import write_whole
    from seewhy_lab.experiments.planning import summary
    from seewhy_lab.experiments.planning_run import FULL, QUICK, PlanningRun, run_planning
    from seewhy_lab.report.planning_page import conclusions, planning_page

    count, records = QUICK if quick else FULL
    run = PlanningRun(
        out,
        trials=count if trials is None else trials,
        first_seed=seed,
        records=records,
        before=before,
        answer_sets=answer_sets,
    )
    with progress() as bars:
        task = bars.add_task("trials", total=run.trials)
        rows = run_planning(run, jobs=jobs, on_trial=lambda done: bars.update(task, completed=done))
    page = run.folder / "index.html"
    write_whole(page, planning_page(run, rows, command=as_typed()))
    _remark_unfinished(rows, run.trials)
    found = summary(rows)
    if json:
        print_json({"page": str(page), "ratios": [ratio.to_dict() for ratio in found]})
        return
    for sentence in conclusions(found):
        say(sentence)
    say(f"page: {page}")


def read_sizes(text: str) -> list[int]:
    """Return the sizes in a text such as "100,400,all"; 0 stands for all.

    Examples
    --------
    >>> read_sizes("100,400,all")
    [100, 400, 0]
    """
    from seewhy.errors import ExperimentError
    from seewhy_lab.experiments.experiment import ALL

    found = []
    for part in text.replace(",", " ").split():
        if part != "all" and not (part.isascii() and part.isdigit() and int(part) > 1):
            raise ExperimentError(
                f"--sizes must be numbers of at least 2 or 'all', with commas between, got '{part}'"
            )
        found.append(ALL if part == "all" else int(part))
    if not found:
        raise ExperimentError("--sizes names no size; give some, as in 100,400,all")
    return found
