"""The command line: `seewhy …`; every command is a module of its own."""

from __future__ import annotations

import atexit
import gc
import io
import os
import sys
from importlib import import_module
from importlib.util import find_spec
from typing import Annotated, Any

import typer

from seewhy import __version__
from seewhy.cli import (
    ask,
    axioms,
    chat,
    check,
    classify,
    data,
    decide,
    demo,
    evaluate,
    learn,
    new,
    plan,
    reference,
    revisions,
    serve,
    simulate,
    studio,
    trace,
    train,
)
from seewhy.cli.screen import complain, say
from seewhy.data.laboratory import LABORATORY

_INTERRUPTED = 130
# Most of what a command makes is modules, which last: with Python's own thresholds an answer
# spends a fifth of its time on looking for garbage among them.
_COLLECTED_AFTER = (50_000, 20, 20)
# Typer names only some of the errors of a command line; this is what they have in common.
_UsageError: Any = typer.BadParameter.__base__

app = typer.Typer(
    name="seewhy",
    help="Answers questions about pictures and says why.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _show_version(asked: bool) -> None:
    if asked:
        say(f"seewhy {__version__}")
        raise typer.Exit


@app.callback()
def options(
    _version: Annotated[
        bool,
        typer.Option("--version", help="Print the version.", is_eager=True, callback=_show_version),
    ] = False,
) -> None:
    """Answers questions about pictures and says why."""


def laboratory_lacks(context: typer.Context) -> None:
    """Say that a command is the laboratory's, where that is not installed."""
    from seewhy.errors import SeeWhyError

    raise SeeWhyError(
        f"'{context.command_path}' is a command of the laboratory ({LABORATORY}), which is not "
        "installed; it comes with the source code of SeeWhy: 'pip install . ./lab' in a checkout"
    )


app.add_typer(data.app, name="data", help="Make datasets and look at them.")
app.command("train")(train.train)
app.command("evaluate")(evaluate.evaluate)
app.command("learn")(learn.learn)
app.command("axioms")(axioms.axioms)
app.command("ask")(ask.ask)
app.command("chat")(chat.chat)
app.command("revisions")(revisions.revisions)
app.command("decide")(decide.decide)
app.command("classify")(classify.classify)
app.command("serve")(serve.serve)
app.command("studio")(studio.studio)
app.command("trace")(trace.trace)
app.command("new")(new.new)
app.command("check")(check.check)
app.command("reference")(reference.reference)
app.command("plan")(plan.plan)
app.command("simulate")(simulate.simulate)
app.command("demo")(demo.demo)
if find_spec(LABORATORY) is not None:
    import_module(f"{LABORATORY}.cli").add_commands(app)
else:
    _anything = {"allow_extra_args": True, "ignore_unknown_options": True}
    for _name in ("experiment", "belgiumts"):
        app.command(_name, hidden=True, context_settings=_anything)(laboratory_lacks)


def main() -> None:
    """Run a command; errors that are the user's to mend end with one sentence and code 2."""
    from seewhy.errors import SeeWhyError
    from seewhy.knowledge.abandoned import still_working

    # PyTorch's modules last until the end. Looking for garbage among them then takes ten times
    # as long as an answer.
    atexit.register(gc.freeze)
    gc.set_threshold(*_COLLECTED_AFTER)
    _require_output()
    for stream in (sys.stdin, sys.stdout, sys.stderr):
        # Names and questions may hold what the terminal's encoding does not.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        code = app(standalone_mode=False, prog_name="seewhy")
        sys.stdout.flush()
    except SeeWhyError as problem:
        complain(str(problem))
        code = 2
    except _UsageError as problem:
        _complain_of_usage(problem)
        code = 2
    except KeyboardInterrupt:
        code = _INTERRUPTED
    except BrokenPipeError:
        # The reader of our output has gone (`seewhy … | head`); there is nobody to tell.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
    except OSError as problem:
        where = f"{problem.filename}: " if problem.filename else ""
        complain(f"{where}{problem.strerror or problem}; check the path, its rights and the disk")
        code = 2
    if code == _INTERRUPTED:
        complain("interrupted; what is finished is kept, the same command goes on from there")
    status = code if isinstance(code, int) else 0
    if still_working():
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
    sys.exit(status)


def _require_output() -> None:
    """End where there is no standard output; what else is closed reads nothing and says nothing.

    The numbers of closed streams must not go to files that are opened later: libraries write there.
    """
    closed = sys.stdout is None
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode))  # noqa: PTH123, SIM115
    if closed:
        complain("standard output is closed; send it to a file, or to /dev/null")
        sys.exit(2)


def _complain_of_usage(problem: Any) -> None:
    """Say in one sentence what is wrong with a command line, and which help to read."""
    text = " ".join(problem.format_message().split()).rstrip(".")
    context = problem.ctx
    if type(problem).__name__ == "NoArgsIsHelpError":
        return  # the help is on the screen
    command = context.command_path if context is not None else "seewhy"
    text = f"{text[:1].lower()}{text[1:]}".replace(". Did you mean", "; did you mean")
    where = f"'{command} --help' says what there is"
    complain(f"{text} ({where})" if text.endswith("?") else f"{text}; {where}")


if __name__ == "__main__":
    main()
