"""Walk through the studio with a browser: from a folder of pictures to an answer that is doubted.

    python -m seewhy_lab studio_walk --pictures hands/pool --features fingers.csv --test hands/test
        --stops 100 150 200 --out runs/walk

Pictures lie in a folder a class, with a table class → features; or they are a dataset. The studio sees
them as one flat folder that says nothing of them. A browser begins, labels by keyboard in the order
in which the studio shows them, trains at every stop, evaluates, asks and doubts. Clicks and keys are
counted. A person's time is an estimate: 2 seconds a picture of which all that is proposed is right,
4 one that is changed, 3 a click, 0.3 a character that is typed.
"""

from __future__ import annotations

import argparse
import shutil
from collections.abc import Sequence
from pathlib import Path

from seewhy.agent.agent import Agent
from seewhy.domain.tables import CLASS
from seewhy_lab.walk.person import Person, Step
from seewhy_lab.walk.serving import running_studio
from seewhy_lab.walk.truth import Truth, flat_folder, read_truth
from seewhy_lab.walk.walking import Asked, Walk

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


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
    parser.add_argument("--pace", type=float, default=2.0, help="seconds a picture at least")
    parser.add_argument("--group", default="", help="which part of a name says what belongs together")
    parser.add_argument("--out", type=Path, required=True, help="a new folder")
    parser.add_argument("--screenshots", type=Path, help="where pictures of the pages are put")
    return parser.parse_args(arguments)


def accuracy(model: Path, test: Truth) -> tuple[int, int]:
    """How many pictures a model gives their class, and how many there are."""
    agent = Agent.load(model)
    names = sorted(test.files)
    said = agent.classify_all([test.files[name] for name in names])
    right = sum(
        one.label == test.values[name][CLASS] for one, name in zip(said, names, strict=True)
    )
    return right, len(names)


def told(steps: Sequence[Step]) -> list[str]:
    """The table of the walk."""
    lines = ["| step | clicks | keys | characters | person, min | the machine's, min |"]
    lines.append("|---|---|---|---|---|---|")
    for step in steps:
        did = step.effort
        labels = f", {did.confirmed} confirmed, {did.changed} changed" if did.confirmed else ""
        lines.append(
            f"| {step.what}{labels} | {did.clicks} | {did.keys} | {did.characters} "
            f"| {did.seconds / 60:.1f} | {step.machine / 60:.1f} |"
        )
    return lines


def main() -> None:
    """Walk, and print what it took."""
    from playwright.sync_api import sync_playwright

    options = options_of()
    truth = read_truth(options.pictures, table=options.features)
    test = read_truth(options.test, table=options.features) if options.test else None
    project = flat_folder(truth, options.out / "photos")
    models: list[tuple[int, Path]] = []
    asked: Asked | None = None
    with running_studio(project, options.out / "studio.log") as address, sync_playwright() as used:
        browser = used.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.set_default_timeout(120_000)
        problems: list[str] = []
        page.on("console", lambda m: problems.append(m.text) if m.type == "error" else None)
        walk = Walk(Person(page), address, project, truth)
        walk.begin(options.subject)
        for stop in options.stops:
            walk.label(stop, pace=options.pace)
            models.append((stop, walk.train(keep=stop == options.stops[0])))
            print(f"labels {stop}: trained", flush=True)
        evaluated = walk.evaluate()
        print(f"the page Evaluate: {evaluated}")
        others = test or truth
        label = truth.classes[len(truth.classes) // 2]
        picture = next(f for n, f in sorted(others.files.items()) if others.values[n][CLASS] == label)
        asked = walk.ask(picture, label)
        browser.close()
    print(*told(walk.person.steps), sep="\n")
    print(asked)
    print("errors of the browser:", problems)
    if test is not None:
        for stop, model in models:
            right, count = accuracy(model, test)
            print(f"{stop} labels: {right} of {count} right, {100 * right / count:.1f} %")


if __name__ == "__main__":
    main()
