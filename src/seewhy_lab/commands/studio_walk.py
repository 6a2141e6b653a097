"""Walk through the studio with a browser: from a folder of pictures to an answer that is doubted.

    python -m seewhy_lab studio_walk --pictures hands/pool --features fingers.csv --test hands/test
        --stops 100 150 --out runs/walk

Pictures lie in a folder a class, with a table class → features; or they are a dataset. The studio
sees them as one flat folder that says nothing of them. A browser begins, labels by keyboard in the
order in which the studio shows them, trains at every stop, evaluates, asks and doubts. Clicks and
keys are counted. A person's time is an estimate: 2 seconds a picture of which all that is proposed
is right, 4 one that is changed, 3 a click, 0.3 a character that is typed. What was walked is kept:
the same command goes on where it was interrupted, and trains no number of labels twice.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from playwright.sync_api import sync_playwright

from seewhy.agent.agent import Agent
from seewhy.domain.tables import CLASS
from seewhy_lab.walk.camera import Camera
from seewhy_lab.walk.diary import read_steps, table, write_steps
from seewhy_lab.walk.person import Person
from seewhy_lab.walk.serving import chromium, running_studio
from seewhy_lab.walk.truth import Truth, flat_folder, read_truth
from seewhy_lab.walk.walking import Asked, Walk, picture_of_class


def options_of(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        "python -m seewhy_lab studio_walk",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--pictures", type=Path, required=True, help="class folders, or a dataset")
    parser.add_argument("--features", type=Path, help="a table class → features")
    parser.add_argument("--test", type=Path, help="pictures of others, looked at once at the end")
    parser.add_argument("--stops", type=int, nargs="+", default=[100], help="labels, then train")
    parser.add_argument("--subject", default="the picture", help="what a picture shows")
    parser.add_argument("--asked", help="the class that is asked for; the middle one")
    parser.add_argument("--pace", type=float, default=2.0, help="seconds a picture at least")
    parser.add_argument("--out", type=Path, required=True, help="the walk; new, or interrupted")
    parser.add_argument("--screenshots", type=Path, help="where small pictures of the pages go")
    return parser.parse_args(arguments)


def accuracy(model: Path, test: Truth) -> str:
    """How many pictures a model gives their class."""
    names = sorted(test.files)
    agent = Agent.load(model)
    right = sum(
        agent.classify(test.files[name]).label == test.values[name][CLASS] for name in names
    )
    return f"{right} of {len(names)} right, {100 * right / len(names):.1f} %"


def walked(walk: Walk, options: argparse.Namespace, others: Truth) -> tuple[str, Asked]:
    """Walk all the way; return what the pages Evaluate and Ask said."""
    diary = options.out / "steps.json"
    steps = walk.person.steps
    steps.extend(read_steps(diary))
    scenes = walk.project / "scenes.csv"
    if scenes.is_file():
        walk.labels = len(scenes.read_text(encoding="utf-8").splitlines()) - 1
        walk.person.page.goto(walk.address)
    else:
        walk.begin(options.subject)
    for stop in options.stops:
        if walk.model_of(stop).is_dir():
            continue
        if walk.labels < stop:
            walk.label(stop, pace=options.pace)
            write_steps(diary, steps)
        walk.train(keep=stop == options.stops[0])
        write_steps(diary, steps)
        print(f"trained on {stop} labels", flush=True)
    evaluated = walk.evaluate()
    classes = walk.truth.classes
    label = options.asked or classes[len(classes) // 2]
    asked = walk.ask(picture_of_class(others, label), label)
    write_steps(diary, steps)
    return evaluated, asked


def main() -> None:
    """Walk, and print what it took."""
    options = options_of()
    truth = read_truth(options.pictures, table=options.features)
    test = read_truth(options.test, table=options.features) if options.test else None
    project = options.out / "photos"
    if not project.is_dir():
        flat_folder(truth, project)
    problems: list[str] = []
    with running_studio(project, options.out / "studio.log") as address, sync_playwright() as used:
        browser = used.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.set_default_timeout(120_000)
        page.on(
            "console", lambda said: problems.append(said.text) if said.type == "error" else None
        )
        page.on("pageerror", lambda problem: problems.append(str(problem)))
        look = Camera(page, options.screenshots) if options.screenshots else str
        walk = Walk(Person(page), address, project, truth, look=look)
        evaluated, asked = walked(walk, options, test or truth)
        browser.close()
    print(*table(walk.person.steps), sep="\n")
    print(f"the page Evaluate says: {evaluated}")
    print(f"asked of {asked.picture}: {asked.question}", asked.answer, sep="\n")
    print(asked.flipped, asked.offered, asked.taken, sep="\n")
    print("errors of the browser:", *problems or ["none"])
    if test is not None:
        for stop in options.stops:
            print(f"{stop} labels: {accuracy(walk.model_of(stop), test)}")


if __name__ == "__main__":
    main()
