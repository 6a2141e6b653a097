"""`seewhy experiment`: run an experiment of the paper and write its page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from seewhy.cli.options import Json
from seewhy.cli.screen import print_json, progress, say

ExperimentName = Annotated[
    str,
    typer.Argument(
        metavar="NAME", help="The experiment: vqa, axioms, confidence, reading or ablation."
    ),
]


def experiment(
    name: ExperimentName,
    out: Annotated[Path, typer.Option("--out", help="The folder for rows, tables and the page.")],
    domain: Annotated[
        str, typer.Option("--domain", help="A bundled domain's name or a domain folder.")
    ] = "structure_stability",
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
    json: Json = False,
) -> None:
    """Run an experiment, or what is missing of it, and write its tables and its page.

    Every finished trial is a file: a run that is stopped goes on where it was, and several
    processes or machines that see the same folder share the work.
    """
    from seewhy.domain import load_domain
    from seewhy.errors import ExperimentError
    from seewhy.experiments.conclusions import conclude, summary
    from seewhy.experiments.running import prepare, run_missing, write_tables
    from seewhy.files import write_whole
    from seewhy.report.experiment_page import experiment_page

    if jobs == 0:
        raise ExperimentError("--jobs must be -1 or at least 1, got 0")
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
            workers=jobs,
            on_picture=lambda done: bars.update(drawing, completed=done, visible=True),
        )
        bars.update(drawing, visible=False)
        task = bars.add_task("trials", total=len(run.trials))
        try:
            run_missing(run, jobs=jobs, on_trial=lambda done: bars.update(task, completed=done))
        finally:
            rows = write_tables(run)
    command = f"seewhy experiment {name} --domain {domain}"
    command += f" --data {data}" if data else ""
    command += f" --trials {trials}" if trials is not None else ""
    command += f" --sizes {sizes}" if sizes is not None else ""
    command += f" --seed {seed}" if seed else ""
    command += " --quick" if quick else ""
    command += f" --tested {tested}" if tested is not None else ""
    command += f" --drawn {drawn}" if drawn else ""
    command += f" --out {out}"
    findings = conclude(run.experiment, rows, domain=load_domain(domain).name)
    page = run.folder / "index.html"
    write_whole(page, experiment_page(run, rows, findings, command=command))
    if json:
        print_json(
            {
                "page": str(page),
                "summary": summary(findings),
                "findings": [own.to_dict() for own in findings],
            }
        )
        return
    for own in findings:
        say(own.text)
    say(summary(findings))
    say(f"page: {page}")


def read_sizes(text: str) -> list[int]:
    """Return the sizes in a text such as "100,400,all"; 0 stands for all.

    Examples
    --------
    >>> read_sizes("100,400,all")
    [100, 400, 0]
    """
    from seewhy.errors import ExperimentError
    from seewhy.experiments.experiment import ALL

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
