"""The command line, from the outside: exit codes, standard output, standard error, files."""

from __future__ import annotations

import io
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from conftest import DOMAIN, Result, Run, draw_tile, write_domain, write_tiles
from seewhy.agent.agent import Agent
from seewhy.agent.model import replaced_notice
from seewhy.domain.domain import Domain, load_domain
from seewhy.knowledge.learned_file import LEARNED

COMMANDS = [
    "",
    "train",
    "evaluate",
    "learn",
    "axioms",
    "ask",
    "chat",
    "trace",
    "new",
    "check",
    "reference",
    "demo",
    "data",
]


@pytest.fixture
def image(tmp_path: Path) -> Path:
    path = tmp_path / "blue square.png"
    draw_tile("blue", "no", 1).save(path)
    return path


# Help -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "says"),
    [
        ("", "Answers questions about pictures and says why."),
        ("train", "Train on a dataset"),
        ("evaluate", "Evaluate a model on a dataset"),
        ("ask", "Answer a question about a picture, with the reasons."),
        ("chat", "Talk about a picture"),
        ("trace", "Show what each component did"),
        ("new", "Write a working domain folder"),
        ("check", "Check a domain folder"),
        ("reference", "Say what may stand in a domain's files"),
        ("demo", "Make pictures, train, evaluate, ask"),
        ("experiment", "Run an experiment, or what is missing of it"),
        ("data", "Make datasets and look at them."),
        ("data make", "Make pictures with the domain's own source"),
        ("data show", "Write a contact sheet"),
    ],
)
def test_help(run: Run, command: str, says: str) -> None:
    for option in ("--help", "-h"):
        result = run(*command.split(), option)
        assert (result.code, result.err) == (0, "")
        assert says in result.out
        assert f"Usage: seewhy {command}".strip() in result.out


def test_without_a_command_there_is_help(run: Run) -> None:
    result = run()
    assert result.code == 2
    assert "Commands" in result.out
    assert result.err == ""


HEAVY = ("torch", "clingo", "mujoco", "sklearn", "pandas", "matplotlib", "scipy")


@pytest.mark.parametrize(
    "code",
    [
        "import seewhy",
        "import sys; sys.argv = ['seewhy', '--help']\n"
        "from seewhy.cli.main import main\n"
        "try: main()\nexcept SystemExit: pass",
        "import sys; sys.argv = ['seewhy', 'ask', '--help']\n"
        "from seewhy.cli.main import main\n"
        "try: main()\nexcept SystemExit: pass",
    ],
)
def test_what_is_not_needed_is_not_imported(code: str) -> None:
    show = f"\nimport sys; print('heavy:', [m for m in {HEAVY} if m in sys.modules])"
    found = subprocess.run(
        [sys.executable, "-c", code + show], capture_output=True, text=True, check=True
    )
    assert found.stdout.splitlines()[-1] == "heavy: []"


NOT_FOR_ANSWERS = (
    *("scipy", "sklearn", "skops", "joblib", "loky", "pandas", "pyarrow", "openpyxl"),
    *("torch._dynamo", "sympy"),
    *("mujoco", "gymnasium", "jinja2", "matplotlib", "torchvision", "yaml", "defusedxml"),
)


@pytest.mark.parametrize(
    ("colour", "command", "said"),
    [
        ("blue", ["ask", "{model}", "{image}", "why is it bad?"], "by: knowledge"),
        ("green", ["ask", "{model}", "{image}", "why is it bad?", "--json"], '"method": "tree"'),
        ("blue", ["classify", "{model}", "{image}", "--out", "{out}"], "1 pictures: bad 1"),
    ],
)
def test_an_answer_imports_what_it_needs(
    model_folder: Path, tmp_path: Path, colour: str, command: list[str], said: str
) -> None:
    """Every answer pays for what the program imports, often more than for the answer."""
    image = tmp_path / "tile.png"
    draw_tile(colour, "no", 1).save(image)
    places = {"model": model_folder, "image": image, "out": tmp_path / "table.csv"}
    typed = ["seewhy", *(word.format(**places) for word in command)]
    code = (
        f"import os, sys; sys.argv = {typed!r}\n"
        "from seewhy.cli.main import main\n"
        "try: main()\nexcept SystemExit: pass\n"
        f"print('needless:', [m for m in {NOT_FOR_ANSWERS} if m in sys.modules])\n"
        "print('waiting threads:', os.environ.get('OMP_WAIT_POLICY'))"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said in found.stdout
    assert found.stdout.splitlines()[-2:] == ["needless: []", "waiting threads: PASSIVE"]


def test_no_garbage_is_looked_for_at_exit() -> None:
    """With PyTorch loaded, that takes a fifth of the whole time of an answer."""
    code = (
        "import atexit, gc, sys; sys.argv = ['seewhy', '--help']\n"
        "atexit.register(lambda: print('frozen:', gc.get_freeze_count() > 0))\n"
        "from seewhy.cli.main import main\n"
        "main()"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.splitlines()[-1] == "frozen: True"


PROGRAM = [str(Path(sys.executable).with_name("seewhy"))]
MODULE = [sys.executable, "-m", "seewhy.cli.main"]


def test_the_program_itself(model_folder: Path, image: Path) -> None:
    """What others start: an answer is all that there is on standard output."""
    program = PROGRAM if Path(PROGRAM[0]).exists() else MODULE
    ask = [*program, "ask", str(model_folder), str(image), "is it good?", "--json"]
    found = subprocess.run(ask, capture_output=True, check=False)
    assert (found.returncode, found.stderr) == (0, b"")
    assert json.loads(found.stdout)["text"] == "No, the tile is bad."


@pytest.mark.parametrize("program", [PROGRAM, MODULE])
def test_the_program_itself_fails_in_one_sentence(program: list[str]) -> None:
    if not Path(program[0]).exists():
        pytest.skip("the program is not installed beside this Python")
    found = subprocess.run([*program, "check", "nowhere"], capture_output=True, check=False)
    assert (found.returncode, found.stdout) == (2, b"")
    assert re.fullmatch(
        "seewhy: 'nowhere' is neither a folder nor a bundled domain; .*\n", found.stderr.decode()
    )


# Ask and chat ---------------------------------------------------------------------------------


def test_ask(run: Run, model_folder: Path, image: Path) -> None:
    result = run("ask", model_folder, image, "why is it bad?")
    assert (result.code, result.err) == (0, "")
    assert re.sub(r"\d\.\d\d", "#", result.out) == (
        "The tile is blue, and it has corners.\n\n"
        "asked: why is the tile bad?\n"
        "seen: colour blue (#), round no (#)\n"
        "by: knowledge\n"
        "because:\n"
        '  the tile is bad: "a blue tile with corners is bad" (knowledge.al:11)\n'
        "  ├─ the tile is blue (p = #)\n"
        "  └─ the tile has corners (p = #)\n"
    )


def test_ask_for_json(run: Run, model_folder: Path, image: Path) -> None:
    result = run("ask", model_folder, image, "WHY is this tile bad??", "--json")
    assert (result.code, result.err) == (0, "")
    reply = json.loads(result.out)
    assert reply["question"] == "why is the tile bad?"
    assert reply["text"] == "The tile is blue, and it has corners."
    assert (reply["class"], reply["method"]) == ("bad", "knowledge")
    assert {name: feature["value"] for name, feature in reply["features"].items()} == {
        "colour": "blue",
        "round": "no",
    }
    for feature in reply["features"].values():
        assert 0.0 <= feature["probability"] <= 1.0
    node = reply["justification"]
    assert node["literal"] == "-good(tile)"
    assert node["axiom"]["text"] == "a blue tile with corners is bad"
    assert Path(node["axiom"]["file"]).read_text().splitlines()[node["axiom"]["line"] - 1] == (
        "-good(T) if colour(T, blue), not round(T)."
    )
    assert [child["literal"] for child in node["children"]] == [
        "colour(tile, blue)",
        "not round(tile)",
    ]


def test_ask_with_a_picture_of_the_reasons(
    run: Run, model_folder: Path, image: Path, tmp_path: Path
) -> None:
    svg = tmp_path / "why.svg"
    result = run("ask", model_folder, image, "is it bad?", "--picture", svg, "--json")
    assert json.loads(result.out)["text"] == "Yes, the tile is bad."
    assert result.err == f"picture: {svg}\n"
    assert svg.read_text().startswith("<svg xmlns=")


CHAT = """\
is it bad?

please explain this answer
what is the meaning of life?
what would make it good?
explain
quit
is it good?
"""


def test_chat(run: Run, model_folder: Path, image: Path) -> None:
    result = run("chat", model_folder, image, stdin=CHAT)
    assert result.code == 0
    said = re.sub(r"\d\.\d\d", "#", result.out).splitlines()
    assert said == [
        "Yes, the tile is bad.",
        "You asked: is the tile bad? I see that the tile is blue, and it has corners (each with a "
        'probability of at least #). The tile is bad, because "a blue tile with corners is bad".',
        "To make the tile good, paint it red.",
        "You asked: what would make the tile good? I see that the tile is blue (with a "
        'probability of #). With this change, the tile is good, because "a red tile is good". '
        'The axiom "a red tile is good" does not apply, since the tile is blue.',
    ]
    assert result.err.startswith("seewhy: 'what is the meaning of life?' is not understood; ask")
    assert result.err.count("\n") == 1


def test_chat_in_json_is_one_line_an_answer(run: Run, model_folder: Path, image: Path) -> None:
    result = run("chat", model_folder, image, "--json", stdin=CHAT)
    lines = [json.loads(line) for line in result.out.splitlines()]
    assert [line.get("text", "")[:22] for line in lines] == [
        "Yes, the tile is bad.",
        "You asked: is the tile",
        "",
        "To make the tile good,",
        "You asked: what would ",
    ]
    assert "is not understood" in lines[2]["error"]
    assert len(lines[2]["nearest"]) == 3
    assert (result.code, result.err) == (0, "")


def test_chat_ends_with_its_input(run: Run, model_folder: Path, image: Path) -> None:
    assert run("chat", model_folder, image, stdin="") == Result(0, "", "")
    assert run("chat", model_folder, image, stdin="explain").out.startswith("I see that the tile")


def test_chat_reads_any_bytes(run: Run, model_folder: Path, image: Path) -> None:
    typed = io.TextIOWrapper(io.BytesIO(b"caf\xe9 \xff\nis it bad?\n"), encoding="utf-8")
    result = run("chat", model_folder, image, stdin=typed)
    assert (result.code, result.out) == (0, "Yes, the tile is bad.\n")
    assert result.err.startswith("seewhy: 'caf\\xe9 \\xff' is not understood; ")
    assert result.err.count("\n") == 1


# New and check --------------------------------------------------------------------------------


def test_new_writes_a_domain_that_check_accepts(run: Run, tmp_path: Path) -> None:
    folder = tmp_path / "deep" / "pears"
    result = run("new", folder)
    assert result == Result(
        0,
        f"{folder} holds a working domain; its README.md says how to make it yours.\n"
        f"  seewhy check {folder}\n",
        "",
    )
    assert load_domain(folder).name == "pears"
    assert "my_domain" not in "".join(p.read_text() for p in folder.iterdir())
    result = run("check", folder)
    assert result == Result(
        0,
        f"Apples for sale (pears) in {folder}\n"
        "  features: colour (3), spotted (2)\n"
        "  classes: good, spoilt\n"
        "  axioms: 2\n"
        f"  questions: {_number(result.out, 'questions')} in {_wordings(result.out)} wordings\n"
        "  of 6 feature vectors: silent 50.0 %, believed 50.0 %\n"
        "nothing is wrong\n",
        "",
    )
    assert [p.name for p in tmp_path.joinpath("deep").iterdir()] == ["pears"]


def _number(text: str, name: str) -> int:
    found = re.search(rf"{name}: (\d+)", text)
    assert found is not None
    return int(found[1])


def _wordings(text: str) -> int:
    found = re.search(r"in (\d+) wordings", text)
    assert found is not None
    assert int(found[1]) > _number(text, "questions")
    return int(found[1])


def test_new_and_check_for_json(run: Run, tmp_path: Path) -> None:
    folder = tmp_path / "pears"
    assert json.loads(run("new", folder, "--json").out) == {
        "folder": str(folder),
        "files": ["README.md", "domain.toml", "knowledge.al", "questions.toml"],
    }
    report = json.loads(run("check", folder, "--json").out)
    assert report["verdicts"] == {"believed": 0.5, "silent": 0.5}
    assert report["warnings"] == []
    assert report["decided"] is None


def test_the_template_can_be_asked_everything(tmp_path: Path, run: Run) -> None:
    """What 'seewhy new' writes answers all of its own questions."""
    run("new", tmp_path / "pears")
    agent = Agent(load_domain(tmp_path / "pears"))
    from conftest import seen

    for values in (("brown", "no"), ("red", "no"), ("green", "yes")):
        for question in agent.questions.one_of_each():
            assert agent.answer(seen(agent, *values), question).text.endswith(".")


def test_check_with_data(run: Run, tiles_folder: Path, tiles_data: Path) -> None:
    result = run("check", tiles_folder, "--data", tiles_data)
    assert result.code == 0
    lines = result.out.splitlines()
    assert lines[5] == "  of 6 feature vectors: believed 50.0 %, silent 50.0 %"
    table = [re.split(r"\s{2,}", line.strip()) for line in lines[6:9]]
    assert table == [
        ["axiom", "decides", "right"],
        ["good(T) if colour(T, red).", "20", "90.0 %"],
        ["-good(T) if colour(T, blue), not round(T).", "10", "100.0 %"],
    ]
    assert lines[9:] == [
        "decided: 50.0 % of the scenes, 93.3 % of those rightly",
        "nothing is wrong",
    ]
    report = json.loads(run("check", tiles_folder, "--data", tiles_data, "--json").out)
    assert report["decided"] == 0.5
    assert report["decided_rightly"] == pytest.approx(28 / 30)


def test_check_says_which_rules_are_doubtful(run: Run, tiles_data: Path, tmp_path: Path) -> None:
    folder = write_domain(tmp_path / "tiles")
    knowledge = folder / "knowledge.al"
    rule = "%% a green tile is good\ngood(T) if colour(T, green).\n"
    knowledge.write_text(knowledge.read_text() + rule)
    result = run("check", folder, "--data", tiles_data)
    assert result.err == ""
    doubt, last = result.out.splitlines()[-2:]
    assert doubt.startswith('doubtful: the rule "a green tile is good" is right about ')
    assert doubt.endswith(" scenes that it decides (good(T) if colour(T, green).)")
    assert last == "nothing is wrong but what is doubtful"
    report = json.loads(run("check", folder, "--data", tiles_data, "--json").out)
    assert report["doubtful"] == [doubt.removeprefix("doubtful: ")]


def test_check_notes_what_the_author_may_have_missed(run: Run, tmp_path: Path) -> None:
    folder = write_domain(tmp_path / "tiles")
    questions = (folder / "questions.toml").read_text()
    (folder / "questions.toml").write_text(
        questions.split('[[question]]\nasks = "feature_value"')[0]
    )
    result = run("check", folder)
    assert result.code == 0
    assert "  note: no question asks about the feature 'colour'\n" in result.out
    assert "  note: no question asks about the feature 'round'\n" in result.out


def test_bundled_domains_are_checked_by_name(run: Run) -> None:
    result = run("check", "structure_stability")
    assert (result.code, result.err) == (0, "")
    assert result.out.startswith("Structures of blocks (structure_stability) in ")


# Train and evaluate ---------------------------------------------------------------------------


@pytest.mark.usefixtures("in_one_process")
def test_train_then_evaluate(
    run: Run, tiles_folder: Path, tiles_data: Path, model_folder: Path, tmp_path: Path
) -> None:
    out = tmp_path / "model"
    result = run("train", tiles_folder, "--data", tiles_data, "--out", out, "--seed", 3)
    assert result.code == 0
    assert "holds a model" not in result.err
    assert result.out.splitlines()[3:] == [
        "the knowledge leaves 22 of 40 training scenes open or gets them wrong; from these the "
        "tree has learned:",
        "  - of the tiles that no rule decides, "
        "if the tile has corners, then it is bad (1 of 2 features tested, 100 % of 9 tiles)",
        "  - of the tiles that no rule decides, "
        "if the tile is round, then it is good (1 of 2 features tested, 100 % of 13 tiles)",
        "answers: 1 recurrent layer(s), 100.0 % right on held-out questions",
        f"model: {out}",
    ]
    weights = "perception/perception.safetensors"
    assert (out / weights).read_bytes() == (model_folder / weights).read_bytes()
    assert [p.name for p in tmp_path.iterdir()] == ["model"]

    result = run("evaluate", out, "--data", tiles_data, "--questions", 3, "--json")
    assert (result.code, result.err) == (0, "")
    record = json.loads(result.out)
    assert record["scenes"] == 20
    assert record["classification_accuracy"] == 1.0
    assert record["feature_accuracy"] == {"colour": 1.0, "round": 1.0}
    result = run("evaluate", out, "--data", tiles_data, "--questions", 3)
    assert re.search(r"classification\s+100\.0 %", result.out)
    assert re.search(r"decided by knowledge\s+50\.0 %", result.out)


@pytest.mark.usefixtures("in_one_process")
def test_training_over_a_model_says_what_is_replaced(
    run: Run, tiles_folder: Path, tiles_data: Path, model_folder: Path, tmp_path: Path
) -> None:
    out = tmp_path / "model"
    shutil.copytree(model_folder, out)
    command = ("train", tiles_folder, "--data", tiles_data, "--out", out)
    replaced = f"{out} holds a model, which is replaced when this training ends"
    result = run(*command)
    assert result.code == 0
    assert f"{replaced}; to keep it, name another folder\n" in result.err
    (out / LEARNED).write_text("bad(T) if -round(T).\n", encoding="utf-8")
    assert replaced_notice(out) == (
        f"{replaced}, with the axioms that it has learned; to keep it, name another folder"
    )


@pytest.mark.usefixtures("in_one_process")
def test_fine_tuning(
    run: Run, tiles_folder: Path, tiles_data: Path, model_folder: Path, tmp_path: Path
) -> None:
    result = run(
        *("train", tiles_folder, "--data", tiles_data, "--out", tmp_path / "tuned"),
        *("--from", model_folder, "--json"),
    )
    assert result.code == 0
    record = json.loads(result.out)
    assert (record["domain"], record["tree_scenes"]) == ("tiles", 22)
    assert set(record["networks"]) == {"colour", "round"}
    first = Agent.load(model_folder).extractor
    assert first is not None
    for key, network in record["networks"].items():
        assert network["epochs"] < first.records[key].epochs


def test_evaluating_on_training_pictures_is_remarked(
    run: Run, model_folder: Path, tiles_data: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "data"
    folder.mkdir()
    rows = (tiles_data / "scenes.csv").read_text().splitlines()
    rows = [rows[0], *(f"{tiles_data}/{row}".replace(",train", ",") for row in rows[1:3])]
    (folder / "scenes.csv").write_text("\n".join(rows))
    result = run("evaluate", model_folder, "--data", folder, "--outside", "--json")
    assert result.code == 0
    assert json.loads(result.out)["seen_in_training"] == 2
    assert result.err == (
        "2 of 2 pictures were trained on; results on them prove nothing: the table keeps none for "
        "evaluation; add a column split, with test in a quarter of the rows, and train again\n"
    )
    result = run("evaluate", model_folder, "--data", folder, "--outside")
    assert result.out.splitlines()[0] == (
        "2 scenes, 2 of them trained on: results on them prove nothing"
    )


class _Bars:
    """Stands for the progress display; interrupts after some steps."""

    def __init__(self, interrupt_after: int) -> None:
        self.steps = 0
        self.interrupt_after = interrupt_after

    def add_task(self, *_: object, **__: object) -> int:
        return 0

    def update(self, *_: object, **__: object) -> None:
        self.steps += 1
        if self.steps == self.interrupt_after:
            raise KeyboardInterrupt


@pytest.mark.usefixtures("in_one_process")
def test_an_interrupted_training_goes_on(
    run: Run,
    monkeypatch: pytest.MonkeyPatch,
    tiles_folder: Path,
    tiles_data: Path,
    model_folder: Path,
    agent: Agent,
    tmp_path: Path,
) -> None:
    out = tmp_path / "model"
    command = ("train", tiles_folder, "--data", tiles_data, "--out", out, "--seed", 3)
    bars = _Bars(interrupt_after=100)

    @contextmanager
    def progress() -> Iterator[_Bars]:
        yield bars

    monkeypatch.setattr("seewhy.cli.training.progress", progress)
    result = run(*command)
    assert result.code == 130
    assert result.out == ""
    assert result.err.splitlines()[-1] == (
        "seewhy: interrupted; what is finished is kept, the same command goes on from there"
    )
    assert [p.name for p in tmp_path.iterdir()] == ["model.training"]

    bars = _Bars(interrupt_after=10_000)
    assert run(*command).code == 0
    assert agent.extractor is not None
    epochs = sum(record.epochs for record in agent.extractor.records.values())
    assert 0 < bars.steps < epochs - 80
    weights = "perception/perception.safetensors"
    assert (out / weights).read_bytes() == (model_folder / weights).read_bytes()
    assert [p.name for p in tmp_path.iterdir()] == ["model"]


# Data -----------------------------------------------------------------------------------------

SOURCE = """\
from pathlib import Path

import numpy as np
from conftest import TRUTH, draw_tile

KINDS = list(TRUTH)


def draw(*, seed, index, size):
    if (Path(__file__).parent / f"stop_{index}").exists():
        raise KeyboardInterrupt
    colour, is_round = KINDS[(index + index // 6) % 6]
    picture = np.asarray(draw_tile(colour, is_round, index, size=size))
    return picture, {"colour": colour, "round": is_round}, TRUTH[colour, is_round]
"""


@pytest.fixture
def made(tmp_path: Path) -> Domain:
    """A domain of tiles with a source of pictures."""
    text = DOMAIN.replace("subject =", 'source = "pictures.py"\nsubject =')
    folder = write_domain(tmp_path / "tiles", domain=text)
    (folder / "pictures.py").write_text(SOURCE)
    return load_domain(folder)


def test_making_data_is_interrupted_and_goes_on(run: Run, made: Domain, tmp_path: Path) -> None:
    out = tmp_path / "pictures"
    command = ("data", "make", made.folder, "--out", out, "--count", 6, "--size", 16)
    told = (
        f"{made.folder}/pictures.py is a program, which now runs with your rights; run only those "
        "of people whom you trust\n"
    )
    (made.folder / "stop_4").touch()
    result = run(*command, "--workers", 1)
    assert result == Result(
        130,
        "",
        f"{told}seewhy: interrupted; what is finished is kept, the same command goes on from "
        "there\n",
    )
    finished = {p.name: p.stat().st_mtime_ns for p in (out / "images").glob("*.png")}
    assert sorted(finished) == [f"00000{n}.png" for n in range(4)]
    (made.folder / "stop_4").unlink()
    result = run(*command, "--workers", 1)
    assert result == Result(
        0,
        f"6 pictures in {out}\n"
        "  good: 66.7 %\n"
        "  bad: 33.3 %\n"
        "  100.0 % of them have an outcome that their features determine (the best that any "
        "classifier over the features can do)\n",
        told,
    )
    for name, time in finished.items():
        assert (out / "images" / name).stat().st_mtime_ns == time
    record = json.loads(run(*command, "--workers", 1, "--json").out)
    assert record == {
        "folder": str(out),
        "scenes": 6,
        "classes": {"good": 4 / 6, "bad": 2 / 6},
        "determined": 1.0,
    }


def test_a_contact_sheet(run: Run, tiles_folder: Path, fresh_data: Path) -> None:
    result = run("data", "show", fresh_data, "--domain", tiles_folder)
    assert result == Result(
        0,
        "6 pictures (good 66.7 %, bad 33.3 %); 100.0 % determined by their features\n"
        f"contact sheet: {fresh_data}/contact_sheet.png\n",
        "domain: tiles\n",
    )
    assert (fresh_data / "contact_sheet.png").read_bytes().startswith(b"\x89PNG")
    target = fresh_data / "sheets" / "sheet.png"
    result = run(
        *("data", "show", fresh_data, "--domain", tiles_folder, "--out", target, "--json"),
        *("--rows", 1, "--columns", 2),
    )
    assert json.loads(result.out)["contact_sheet"] == str(target)
    assert target.is_file()


def test_the_demo_is_of_pictures_with_a_class(run: Run, tmp_path: Path) -> None:
    result = run("demo", "--domain", "tabletop", "--out", tmp_path / "demo")
    assert result.code == 2
    assert "'tabletop' has several things in a picture" in result.err.replace("\n", " ")
    assert not (tmp_path / "demo").exists()


@pytest.mark.usefixtures("in_one_process")
def test_the_demonstration_of_a_domain(
    run: Run, made: Domain, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from seewhy.data import making

    make_dataset = making.make_dataset

    def here(*args: Any, **options: Any) -> Any:
        return make_dataset(*args, **{**options, "workers": 1})

    monkeypatch.setattr(making, "make_dataset", here)
    out = tmp_path / "demo"
    result = run("demo", "--domain", made.folder, "--out", out, "--count", 60)
    assert result.code == 0
    page = (out / "report.html").read_text(encoding="utf-8")
    assert page.count('class="scene"') == 6
    said = result.out.splitlines()[-1]
    ask = re.fullmatch(r"ask on: seewhy ask (\S+) (\S+) \"(.+)\"", said)
    assert ask is not None
    assert run("ask", *ask.groups()).code == 0


def test_a_folder_of_ones_own_goes_the_whole_way(
    agent: Agent, model_folder: Path, run: Run, tmp_path: Path
) -> None:
    """Pictures that nobody annotated are asked about by path."""
    write_tiles(tmp_path / "new", count=3)
    for path in sorted((tmp_path / "new" / "images").iterdir()):
        result = run("ask", model_folder, path, "what can you say about the tile?")
        assert result.out.splitlines()[0] in ("The tile is good.", "The tile is bad.")
    assert agent.domain.name == "tiles"
