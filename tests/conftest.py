"""A small domain of coloured tiles, its pictures, and a model trained on them in seconds."""

from __future__ import annotations

import csv
import io
import json
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import pytest

# The program words its help for the width of the screen; tests want one width.
os.environ["COLUMNS"] = "100"
os.environ.pop("FORCE_COLOR", None)
# Networks as small as these are several times slower on two threads than on one.
os.environ["OMP_NUM_THREADS"] = "1"
# The cores are pytest's. A process for a network takes longer to start than tiles to be learned;
# what is about processes says how many.
os.environ["LOKY_MAX_CPU_COUNT"] = "1"
# Nothing that a test makes is found by the next one, or by who runs the tests.
os.environ["SEEWHY_CACHE"] = ""
# A slow machine must not put lines of progress between what tests expect.
os.environ["SEEWHY_PROGRESS_SECONDS"] = "3600"

from PIL import Image, ImageDraw

from hypothesis_profiles import register
from seewhy.agent.agent import Agent
from seewhy.agent.things.thing_agent import ThingAgent
from seewhy.cli.main import main
from seewhy.data.dataset import Dataset
from seewhy.dialogue import recurrent
from seewhy.dialogue.reply import Classification, FeatureReading
from seewhy.domain.domain import Domain, load_domain
from seewhy.files.locks import locked
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception import fitting_extractor, fitting_eyes, parallel
from seewhy.perception.backbones import embedded
from seewhy.perception.course import Course
from seewhy.perception.things import fitting_detector
from things_builder import write_domain as write_shelf_domain
from things_builder import write_shelf

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

register()

DOMAIN = """\
[domain]
name = "tiles"
title = "Tiles"
scene = "tile"
subject = "the tile"
eyes = "none"  # tiles are so plain that networks grow in a second

[pictures]
size = 16
shift = 0.05

[features.colour]
name = "colour"
threshold = 0.9

[features.colour.values]
red = { say = "{it} is red", change = "paint it red" }
green = { say = "{it} is green", change = "paint it green" }
blue = { say = "{it} is blue", change = "paint it blue" }

[features.round]
name = "shape"
threshold = 0.9

[features.round.values]
yes = { say = "{it} is round", words = ["round"], change = "make it round" }
no = { say = "{it} has corners", words = ["cornered"], change = "give it corners" }

[classes.good]
literal = "good(T)"
say = "good"

[classes.bad]
literal = "-good(T)"
say = "bad"
words = ["bad", "poor"]
"""

KNOWLEDGE = """\
#sort tile.
#sort hue = {red, green, blue}.
#static colour(tile, hue).
#static round(tile).
#static good(tile).

%% a red tile is good
good(T) if colour(T, red).

%% a blue tile with corners is bad
-good(T) if colour(T, blue), not round(T).
"""

QUESTIONS = """\
fillers = ["please"]

[[question]]
asks = "class"
patterns = ["what can you say about {it}"]

[[question]]
asks = "is_class"
patterns = ["is {it} {class}"]

[[question]]
asks = "why_not_class"
patterns = ["why is {it} not {class}"]

[[question]]
asks = "why_class"
patterns = ["why is {it} {class}", "what makes {it} {class}"]

[[question]]
asks = "change_to_class"
patterns = ["what would make {it} {class}"]

[[question]]
asks = "feature_value"
feature = "colour"
patterns = ["what colour is {it}", "which colour does {it} have"]

[[question]]
asks = "feature_is"
feature = "round"
value = "yes"
patterns = ["is {it} round"]

[[question]]
asks = "explain"
patterns = ["please explain this answer", "explain"]
"""

RGB = {"red": (210, 40, 30), "green": (30, 170, 60), "blue": (40, 60, 210)}
TRUTH = {
    ("red", "yes"): "good",
    ("red", "no"): "good",
    ("green", "yes"): "good",
    ("green", "no"): "bad",
    ("blue", "yes"): "good",
    ("blue", "no"): "bad",
}
WORN = {6, 42}
"""Numbers of red tiles that are bad all the same: here the knowledge is wrong."""


def draw_tile(colour: str, is_round: str, number: int, *, size: int = 64) -> Image.Image:
    """A disc or a square on a light ground; its place depends on the number."""
    image = Image.new("RGB", (size, size), (225, 225, 220))
    left, top = 8 + number % 5, 8 + number % 7
    box = (left, top, left + size * 2 // 3, top + size * 2 // 3)
    draw = ImageDraw.Draw(image)
    (draw.ellipse if is_round == "yes" else draw.rectangle)(box, fill=RGB[colour])
    return image


def write_domain(folder: Path, **texts: str) -> Path:
    """Write the domain of tiles; ``texts`` replace its files (without their endings).

    Line ends stay as the texts have them.
    """
    folder.mkdir(parents=True, exist_ok=True)
    files = {"domain": DOMAIN, "knowledge": KNOWLEDGE, "questions": QUESTIONS, **texts}
    for name, ending in (("domain", "toml"), ("knowledge", "al"), ("questions", "toml")):
        (folder / f"{name}.{ending}").write_text(files[name], encoding="utf-8", newline="")
    return folder


def write_tiles(folder: Path, *, count: int = 60) -> Path:
    """Write pictures of tiles and their scenes.csv, every third of them for testing."""
    (folder / "images").mkdir(parents=True)
    kinds = list(product(RGB, ("yes", "no")))
    with (folder / "scenes.csv").open("w", newline="", encoding="utf-8") as stream:
        rows = csv.writer(stream, lineterminator="\n")
        rows.writerow(["image", "class", "colour", "round", "split"])
        for number in range(count):
            colour, is_round = kinds[(number + number // 6) % 6]
            draw_tile(colour, is_round, number).save(folder / "images" / f"{number:03d}.png")
            label = "bad" if number in WORN else TRUTH[colour, is_round]
            split = "test" if number % 3 == 2 else "train"
            rows.writerow([f"images/{number:03d}.png", label, colour, is_round, split])
    return folder


EYES_SIDE = 64
"""Pixels of what eyes see in tests, instead of 112."""


@pytest.fixture(scope="session", autouse=True)
def taught_in_seconds() -> Iterator[None]:
    """Eyes go over pictures three times, and see a third of the pixels: what tests make is plain.

    What answers goes over few questions a third as often: those that tests ask are plain, too.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(embedded, "SIDE", EYES_SIDE)
        patch.setattr(fitting_eyes, "_PASSES", (3, 3))
        patch.setattr(fitting_eyes, "_PASSES_AGAIN", (3, 3))
        patch.setattr(fitting_eyes, "_PASSES_ANEW", (3, 3))
        patch.setattr(fitting_eyes, "_VIEWS", (2, 2))
        patch.setattr(recurrent, "ENOUGH_EXAMPLES", 800)
        yield


@pytest.fixture(scope="session")
def tiles_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The domain folder; do not write to it."""
    return write_domain(tmp_path_factory.mktemp("domain") / "tiles")


@pytest.fixture(scope="session")
def tiles(tiles_folder: Path) -> Domain:
    return load_domain(tiles_folder)


@pytest.fixture(scope="session")
def tiles_data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of pictures; do not write to it."""
    return write_tiles(tmp_path_factory.mktemp("data") / "pictures")


@pytest.fixture(scope="session")
def dataset(tiles: Domain, tiles_data: Path) -> Dataset:
    return Dataset.load(tiles_data, tiles)


@contextmanager
def one_process() -> Iterator[None]:
    """Train here, to networks that are sure of tiles, instead of in other processes.

    Those would take seconds to start.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fitting_extractor, "train_networks", _train_networks_here)
        yield


def _train_networks_here(*args: Any, course: Course, **options: Any) -> Any:
    trained = parallel.train_networks(*args, course=replace(course, workers=1), **options)
    # Judged by six pictures, no network is surer of a value than 7 to 1; tests want one that is.
    for network, _ in trained.values():
        network.temperature /= 2
    return trained


@pytest.fixture
def in_one_process() -> Iterator[None]:
    with one_process():
        yield


@pytest.fixture(scope="session")
def agent(tiles: Domain, dataset: Dataset) -> Agent:
    """An agent trained on the tiles; do not train it again."""
    with one_process():
        return Agent(tiles, seed=3).fit(dataset)


@pytest.fixture(scope="session")
def model_folder(agent: Agent, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The agent on disk; do not write to it."""
    folder = tmp_path_factory.mktemp("models") / "model"
    agent.save(folder)
    return folder


class Shelf(NamedTuple):
    domain: Path
    data: Path
    model: Path


@pytest.fixture(scope="session")
def shelf(tmp_path_factory: pytest.TempPathFactory) -> Shelf:
    """A model of shapes, trained in seconds, once for all processes of pytest; only read it."""
    base = tmp_path_factory.getbasetemp()
    home = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    return made_once(home / "things", trained_shelf)


def made_once(folder: Path, make: Callable[[Path], Shelf]) -> Shelf:
    """What is made in a folder by whichever process comes first; the others wait for it."""
    made = folder / "made.json"
    with locked(folder, wait=True):
        if made.exists():
            return Shelf(*map(Path, json.loads(made.read_text())))
        folder.mkdir(exist_ok=True)
        found = make(folder)
        made.write_text(json.dumps(list(map(str, found))))
        return found


def trained_shelf(folder: Path) -> Shelf:
    """Train a model of shapes; with so plain ones, few passes are enough."""
    domain = write_shelf_domain(folder / "shelf")
    data = write_shelf(folder / "data", 48)
    with pytest.MonkeyPatch.context() as patch:
        _quickly(patch)
        agent = ThingAgent(load_domain(domain)).fit(Dataset.load(data, load_domain(domain)))
    agent.save(folder / "model")
    return Shelf(domain, data, folder / "model")


def _quickly(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(fitting_eyes, "FEW", 20)
    patch.setattr(fitting_eyes, "_PASSES", (2, 2))
    patch.setattr(fitting_eyes, "_PASSES_AGAIN", (1, 1))
    patch.setattr(fitting_eyes, "_PASSES_ANEW", (1, 1))
    patch.setattr(fitting_eyes, "_VIEWS", (1, 1))
    patch.setattr(fitting_detector, "FEW", 20)
    patch.setattr(fitting_detector, "_PASSES", (20, 20))
    patch.setattr(fitting_detector, "_MOST_VIEWS", 2)


@pytest.fixture(scope="session")
def structures() -> Domain:
    return load_domain("structure_stability")


@pytest.fixture(scope="session")
def reasoning(structures: Domain) -> Agent:
    """An agent of the structures without networks: it answers about given classifications."""
    return Agent(structures)


def seen(agent: Agent, *values: str | None, probability: float = 0.9) -> Classification:
    """The classification of a scene whose features are given, as the agent decides it."""
    vector: FeatureVector = tuple(values)
    label, method, verdict = agent.deciding.decide(vector)
    readings = {
        key: FeatureReading(value or "", probability)
        for key, value in zip(agent.domain.features, vector, strict=True)
    }
    return Classification(label, method, vector, readings, verdict.value)


@pytest.fixture
def fresh_data(tmp_path: Path) -> Path:
    """A few pictures of tiles that a test may spoil."""
    return write_tiles(tmp_path / "pictures", count=6)


@pytest.fixture(scope="session")
def photographs() -> Path:
    """An archive or folder with the Training half of BelgiumTS; skips where there is none."""
    beside = Path(__file__).parents[2] / "shared" / "data" / "BelgiumTSC_Training.zip"
    named = os.environ.get("SEEWHY_BELGIUMTS")
    path = Path(named) if named else beside
    if not path.exists():
        pytest.skip("the photographs of BelgiumTS are not here; SEEWHY_BELGIUMTS names an archive")
    return path


class Result(NamedTuple):
    code: int
    out: str
    err: str


Run = Callable[..., Result]


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run the program in this process."""

    def run(*arguments: object, stdin: str | io.TextIOWrapper = "") -> Result:
        monkeypatch.setattr(sys, "argv", ["seewhy", *map(str, arguments)])
        stream = io.StringIO(stdin) if isinstance(stdin, str) else stdin
        monkeypatch.setattr(sys, "stdin", stream)
        with pytest.raises(SystemExit) as exit_:
            main()
        captured = capsys.readouterr()
        return Result(exit_.value.code or 0, captured.out, captured.err)  # type: ignore[arg-type]

    return run


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    from playwright.sync_api import sync_playwright

    from studio_browsing import CHROMIUM

    with sync_playwright() as started:
        browser = started.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture
def page(chromium: Browser) -> Iterator[Page]:
    context = chromium.new_context(viewport={"width": 1280, "height": 800})
    page = context.new_page()
    page.set_default_timeout(60_000)
    problems: list[str] = []
    page.on("console", lambda said: problems.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda problem: problems.append(str(problem)))
    yield page
    context.close()
    # A refused script or style (Content-Security-Policy) is an error of the console; so is an
    # answer that says what was wrong with a form, which is meant. The page may ask for news once
    # more when the server has ended.
    meant = ("422", "ERR_CONNECTION_REFUSED", "htmx:afterRequest", "htmx:sendError")
    assert [said for said in problems if not any(word in said for word in meant)] == []
