"""`seewhy demo`: the whole way once, from a domain's own pictures to answers with reasons."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.options import Json, Seed
from seewhy.cli.screen import output, print_json, progress, say

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.data.dataset import Dataset, Scene
    from seewhy.dialogue.reply import Classification, Reply


MOST_SCENES = 6
"""Of so many test pictures at the most is shown what is answered."""
FEW_CLASSES = 4
"""Of more classes, a picture is asked about its own and the nearest other one only."""


def demo(
    domain: Annotated[
        str, typer.Option("--domain", help="A bundled domain's name or a domain folder.")
    ] = "structure_stability",
    out: Annotated[Path, typer.Option("--out", help="The folder to write.")] = Path("demo"),
    count: Annotated[int, typer.Option("--count", min=60, help="How many pictures.")] = 1500,
    seed: Seed = 0,
    json: Json = False,
) -> None:
    """Make pictures, train, evaluate, ask, and write OUT/report.html."""
    from seewhy.cli.evaluation_tables import print_evaluation
    from seewhy.cli.train import print_learned
    from seewhy.cli.training import train_model, trained_already
    from seewhy.data.dataset import Dataset
    from seewhy.data.making import make_dataset
    from seewhy.domain.domain import load_domain
    from seewhy.errors import SeeWhyError
    from seewhy.evaluation import evaluate
    from seewhy.files.whole_files import write_whole
    from seewhy.report.page import report_page

    start = perf_counter()
    loaded = load_domain(domain)
    if loaded.things is not None or not loaded.classes:
        raise SeeWhyError(
            f"the demo is of pictures with a class, and the domain '{loaded.name}' has several "
            "things in a picture; make some with 'seewhy data make', then 'seewhy train' and 'ask'"
        )
    quiet = json

    def heading(text: str) -> None:
        if not quiet:
            output().print()
            output().print(f"{text}  ({perf_counter() - start:.0f} s)", markup=False, style="bold")

    heading(f"{loaded.title}: {count} pictures")
    with progress() as bars:
        task = bars.add_task("making pictures", total=count)
        made = make_dataset(
            loaded,
            out / "pictures",
            count=count,
            seed=seed,
            on_progress=lambda done: bars.update(task, completed=done),
        )
    if not quiet:
        shares = ", ".join(f"{n} {100 * share:.0f} %" for n, share in made.classes.items())
        said = shares if len(made.classes) <= FEW_CLASSES else f"{len(made.classes)} classes"
        assert made.determined is not None, "the domain has classes"
        say(f"{said}; the features determine {100 * made.determined:.1f} % of the outcomes")
    heading("Training what sees, the tree and the answers")
    dataset = Dataset.load(out / "pictures", loaded)
    agent = trained_already(out / "model", dataset, seed=seed)
    if agent is None:
        agent = train_model(loaded, out / "pictures", out / "model", seed=seed)
    elif not quiet:
        say(f"{out / 'model'} is trained on these pictures already")
    if not quiet:
        print_learned(agent)
    heading("Evaluating on pictures that were never trained on")
    evaluation = evaluate(agent, dataset, seed=seed)
    if not quiet:
        print_evaluation(evaluation)
    heading("Questions about test pictures")
    answered = [(scene, _ask_everything(agent, scene)) for scene in choose_scenes(agent, dataset)]
    if not quiet:
        _print_answers(answered[:2])
    command = f"seewhy demo --domain {domain} --count {count} --seed {seed} --out {out}"
    report = out / "report.html"
    write_whole(report, report_page(agent, evaluation, answered, command=command))
    if json:
        print_json(
            {
                "report": str(report),
                "model": str(out / "model"),
                "seconds": round(perf_counter() - start, 1),
                "evaluation": evaluation.to_dict(),
            }
        )
        return
    heading(f"The whole story, with pictures and justifications: {report}")
    scene, replies = answered[0]
    say(f'ask on: seewhy ask {out / "model"} {scene.picture} "{replies[-1].question.text}?"')


def choose_scenes(agent: Agent, dataset: Dataset) -> list[Scene]:
    """Choose test scenes that differ: every way of deciding and every class, knowledge first."""
    scenes = dataset.of_split("test")
    pictures = scenes.pictures(agent.picture_size)
    kinds: dict[tuple[str, str | None, str], list[Scene]] = {}
    for scene, classification in zip(scenes.scenes, agent.classify_all(pictures), strict=True):
        kinds.setdefault(
            (classification.method, classification.label, classification.verdict), []
        ).append(scene)
    chosen: list[Scene] = []
    rank = 0
    ordered = [kinds[key] for key in sorted(kinds, key=str)]
    while len(chosen) < MOST_SCENES and any(len(alike) > rank for alike in ordered):
        chosen += [alike[rank] for alike in ordered if len(alike) > rank]
        rank += 1
    return chosen[:MOST_SCENES]


def _ask_everything(agent: Agent, scene: Scene) -> list[Reply]:
    """Every question of the domain about one picture, and the explanation of one answer."""
    from seewhy.dialogue.question import Asks

    classification = agent.classify(scene.picture)
    labels = _asked_about(agent, classification)
    replies: list[Reply] = []
    explain = None
    for question in agent.questions.one_of_each():
        if question.asks is Asks.EXPLAIN:
            explain = question
            continue
        if question.label is not None and question.label not in labels:
            continue
        if (
            question.value is not None
            and question.value != agent.domain.named(classification.vector)[question.feature or ""]
            and len(agent.domain.features[question.feature or ""].values) > 2
        ):
            continue
        replies.append(agent.answer(classification, question))
    if explain is not None:
        about = next(
            (
                reply
                for reply in replies
                if reply.question.asks is Asks.WHY_CLASS
                and reply.question.label == classification.label
            ),
            replies[0],
        )
        replies.append(agent.answer(classification, explain, previous=about))
    return replies


def _asked_about(agent: Agent, classification: Classification) -> set[str]:
    """The classes to ask about: all of a few, or the picture's own and the nearest other one."""
    classes = tuple(agent.domain.classes)
    if len(classes) <= FEW_CLASSES:
        return set(classes)
    nearest = agent.reasoned.nearest_classes(classification.vector, most=2)
    other = next((label for label in nearest if label != classification.label), classes[0])
    return {other, *([classification.label] if classification.label is not None else [])}


def _print_answers(answered: list[tuple[Scene, list[Reply]]]) -> None:
    for scene, replies in answered:
        say(f"\n{scene.picture}")
        for reply in replies:
            say(f"  {reply.question.text}?")
            say(f"    {reply.text}")
