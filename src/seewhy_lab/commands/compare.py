"""Compare SeeWhy with what else one would try, on the same held-out pictures.

    python -m seewhy_lab compare --data ARCHIVES --out runs/comparison
    python -m seewhy_lab compare --sets structures,rooms --seeds 1 --out runs/comparison
    python -m seewhy_lab compare --report --out runs/comparison

(a) SeeWhy by default; (b) a small network end to end for the class; (c) frozen features of the
backbone and logistic regression; (d) the backbone fine-tuned end to end; (e) SeeWhy with networks
that grow, as it was before it had a backbone. Sets: structures and rooms, which are drawn here;
signs, hands and set_cards, whose archives (BelgiumTSC_Training.zip, hands.zip, set_cards.zip) lie
in the folder that --data names.

Every trial is a file in OUT/trials. A run that is stopped goes on where it was, several processes
may share a folder, and more sets, counts or seeds are added at any time. OUT/report.md is the page
over all that there is; --report writes it and runs nothing.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from functools import cache, partial
from pathlib import Path

from seewhy.cli.screen import complain, remark, say
from seewhy.domain.domain import load_domain
from seewhy.errors import ExperimentError, SeeWhyError
from seewhy.files.whole_files import write_whole
from seewhy.perception.device import device_of
from seewhy.text.nearest import did_you_mean
from seewhy_lab.comparison.catalogue import SYSTEMS
from seewhy_lab.comparison.page import page
from seewhy_lab.comparison.picture_sets import SETS, Pictures, load_set, require_source
from seewhy_lab.comparison.trials import kept_results, planned, run_trial
from seewhy_lab.experiments.experiment import ALL

REPORT, PICTURES = "report.md", "pictures"
SEEDS = 5


def main(arguments: Sequence[str] | None = None) -> None:
    """Run what is missing and write the page."""
    options = _parser().parse_args(arguments)
    try:
        compare(options)
    except SeeWhyError as problem:
        complain(str(problem))
        sys.exit(2)
    except KeyboardInterrupt:
        complain("interrupted; what is finished is kept, the same command goes on from there")
        sys.exit(130)


def compare(options: argparse.Namespace) -> None:
    """Do what the command line asks for."""
    out: Path = options.out
    sets = _chosen(options.sets, SETS, "--sets")
    systems = [SYSTEMS[name] for name in _chosen(options.systems, SYSTEMS, "--systems")]
    counts = None if options.counts is None else _counts(options.counts)
    if options.seeds < 1:
        raise ExperimentError(f"--seeds must be at least 1, got {options.seeds}")
    if options.drawn < 0:
        raise ExperimentError(f"--drawn must be 0 or more, got {options.drawn}")
    if options.drawn:
        sets = _drawable(sets, named=options.sets is not None)
    trials = planned(
        sets,
        systems,
        counts=counts,
        seeds=options.seeds,
        drawn=options.drawn,
        on_processor=device_of("auto").type == "cpu",
    )

    @cache
    def pictures(name: str) -> Pictures:
        return load_set(SETS[name], archives=options.data, folder=out / PICTURES / name)

    if options.report:
        if not any(kept_results(out)):
            raise ExperimentError(f"{out}: holds no trial; leave --report out to run some")
    else:
        for name in sets:
            require_source(SETS[name], archives=options.data, folder=out / PICTURES / name)
        for trial in trials:
            found = run_trial(out, trial, SYSTEMS[trial.system], partial(pictures, trial.pictures))
            if found is not None:
                remark(f"{trial.name}: {100 * found.accuracy:.1f} % in {found.seconds:.0f} s")
    text = page(
        list(kept_results(out)),
        sets=[SETS[name] for name in sets],
        systems=systems,
        asked=trials,
        seeds=options.seeds,
    )
    write_whole(out / REPORT, text)
    say(f"page: {out / REPORT}")


def _drawable(sets: Sequence[str], *, named: bool) -> list[str]:
    """The sets of photographs whose domain draws pictures; others must not be named."""
    found = [name for name in sets if SETS[name].archive and load_domain(SETS[name].domain).source]
    others = [name for name in sets if name not in found]
    if others and named:
        raise ExperimentError(
            f"--drawn: {others[0]} is no set of photographs whose domain can draw; leave it out of "
            "--sets, or --drawn"
        )
    return found


def _chosen(text: str | None, known: Mapping[str, object], option: str) -> list[str]:
    """The names that an option lists, in the order of those that there are; all without it."""
    if text is None:
        return list(known)
    names = text.replace(",", " ").split()
    for name in names:
        if name not in known:
            raise ExperimentError(f"{option}: '{name}' is none; {did_you_mean(name, known)}")
    if not names:
        raise ExperimentError(f"{option} names nothing; there are {', '.join(known)}")
    return [name for name in known if name in names]


def _counts(text: str) -> list[int]:
    """The counts in a text such as "100,300,all"; 0 stands for all."""
    parts = text.replace(",", " ").split()
    for part in parts:
        if part != "all" and not (part.isascii() and part.isdigit() and int(part) > 1):
            raise ExperimentError(
                "--counts must be numbers of at least 2 or 'all', with commas between, got "
                f"'{part}'"
            )
    if not parts:
        raise ExperimentError("--counts names no count; give some, as in 100,300,all")
    return [ALL if part == "all" else int(part) for part in dict.fromkeys(parts)]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--out", type=Path, required=True, help="the folder of all results")
    parser.add_argument("--data", type=Path, help="the folder of the archives")
    parser.add_argument("--sets", help=f"some of {','.join(SETS)} (all)")
    parser.add_argument("--systems", help=f"some of {','.join(SYSTEMS)} (all)")
    parser.add_argument("--counts", help="labels, as in 100,300,all (those of each set)")
    parser.add_argument("--seeds", type=int, default=SEEDS, help=f"how many ({SEEDS})")
    parser.add_argument(
        "--drawn",
        type=int,
        default=0,
        help="drawings that every system is trained on before, where a domain has a source (0)",
    )
    parser.add_argument("--report", action="store_true", help="write the page, run nothing")
    return parser


if __name__ == "__main__":
    main()
