"""`seewhy evaluate clevr`: questions about annotated scenes, in the formats of CLEVR."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from seewhy.cli.screen import add_row, output, print_json, progress, say, table
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.evaluation.thing_questions import ThingEvaluation

NAME = "clevr"


def evaluate_clevr(
    scenes: Path | None, questions: str | None, *, domain: str, wrong: Path | None, json: bool
) -> None:
    """Answer the questions of a file about the scenes of another, and print how many are right."""
    from seewhy.data.importers.clevr import read_questions, read_scenes
    from seewhy.domain.domain import load_domain
    from seewhy.errors import SeeWhyError
    from seewhy.evaluation.thing_questions import evaluate_thing_questions
    from seewhy.files.whole_files import write_whole

    if scenes is None or questions is None:
        raise SeeWhyError(
            "'evaluate clevr' needs the scenes and the questions: --scenes FILE --questions FILE"
        )
    loaded = load_domain(domain)
    if loaded.things is None:
        raise SeeWhyError(f"{loaded.folder}: the domain has no [things] that could be asked about")
    described = read_scenes(scenes, loaded.things)
    asked = read_questions(Path(questions), described)
    with progress() as bars:
        task = bars.add_task("answering questions", total=len(asked))
        result = evaluate_thing_questions(
            loaded.things,
            described,
            asked,
            on_progress=lambda done: bars.update(task, completed=done),
        )
    if wrong is not None:
        lines = [_wrong_text(result)]
        write_whole(wrong, "\n".join(lines))
    if json:
        print_json({"scenes": len(described), **result.to_dict()})
        return
    _print(result, scenes=len(described), wrong=wrong)


def _wrong_text(result: ThingEvaluation) -> str:
    if not result.wrong:
        return "no answer is wrong\n"
    return "\n".join(
        f"{wrong.place}\n  asked:      {wrong.question}\n  annotated:  {wrong.answer}\n"
        f"  answered:   {wrong.text}\n  understood: {wrong.understood or 'not at all'}\n"
        for wrong in result.wrong
    )


def _print(result: ThingEvaluation, *, scenes: int, wrong: Path | None) -> None:
    from seewhy.evaluation.share import Share

    right = Share(result.right, result.questions)
    low, high = right.interval
    say(
        f"{result.questions:,} questions about {scenes:,} scenes: {result.understood:,} "
        f"understood, {result.right:,} right ({percent(right.value)}, 95 % interval "
        f"{percent(low)} to {percent(high)}; the most frequent answer alone: "
        f"{percent(result.majority.value)})"
    )
    say(
        f"{result.seconds:.1f} s; {result.questions_per_second:,.0f} questions in a second of one "
        f"core's time, with the reasons of every answer ({result.steps:,} steps)"
    )
    rows = table("questions like", ">questions", ">right")
    for name, share in result.families.items():
        add_row(rows, name, str(share.of), percent(share.value))
    output().print(rows)
    if result.wrong and wrong is None:
        say("--wrong FILE writes those that are wrong, with what was understood")
    elif wrong is not None:
        say(f"wrong: {wrong}")
