"""Experiments, on tiles: what is run, what is kept, what is refused, and what is concluded."""

from __future__ import annotations

import csv
import io
import itertools
import json
import os
import shutil
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from conftest import DOMAIN, Run, write_domain
from seewhy.agent.agent import Agent
from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.cli.main import main
from seewhy.data.dataset import Dataset
from seewhy.dialogue import learned
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks
from seewhy.dialogue.reference import ReferenceAnswers, experience_of
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import ExperimentError
from seewhy.files.locks import locked
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.reasoner import Reasoner
from seewhy_lab.experiments import coupling, drawing, running
from seewhy_lab.experiments.axioms import agreement, explanations, incomplete, learned_again
from seewhy_lab.experiments.catalogue import NAMES, experiment
from seewhy_lab.experiments.conclusions import conclude, summary
from seewhy_lab.experiments.drawing import divide, in_fold, load_pictures, pool_of, require_enough
from seewhy_lab.experiments.effort import Effort, efforts
from seewhy_lab.experiments.end_to_end import questions_to_learn
from seewhy_lab.experiments.experiment import ALL, Plan, Row, Setting, Trial
from seewhy_lab.experiments.origin import here
from seewhy_lab.experiments.questioning import answer_scores, draw_questions, suitable
from seewhy_lab.experiments.rows import ROWS, TIMINGS, trial_file, write_trial
from seewhy_lab.experiments.vqa import annotator

SMALL = ("--trials", 2, "--sizes", "20,30", "--tested", 15, "--jobs", 1)
EXPLAINED = ("explanations_strict", "explanations_sufficient")


def setting(dataset: Dataset, out: Path, *, tested: int = 20) -> Setting:
    plain = tuple(replace(scene, split="") for scene in dataset.scenes)
    return Setting(dataset.domain, replace(dataset, scenes=plain), tested, 0, out)


# Networks as deep as can be and trained for one pass see enough here, and soon.
HASTY = DOMAIN + "\n[networks]\nepochs = 1\ndepth = 3\n"


@pytest.fixture(scope="module")
def hasty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a domain of tiles that is trained quickly."""
    return write_domain(tmp_path_factory.mktemp("hasty") / "tiles", domain=HASTY)


@pytest.fixture(scope="module", autouse=True)
def _few_epochs() -> Iterator[None]:
    """Ten passes over the questions, however few they are."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("seewhy.dialogue.recurrent.ENOUGH_EXAMPLES", 1)
        yield


# Running -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def finished(hasty: Path, tiles_data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a finished experiment; do not write to it."""
    out = tmp_path_factory.mktemp("experiment") / "out put"
    line = ["vqa", "--out", out, "--domain", hasty, "--data", tiles_data, *SMALL]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.argv", ["/bin/seewhy", "experiment", *map(str, line)])
        with pytest.raises(SystemExit) as end:
            main()
    assert end.value.code == 0
    return out


@contextmanager
def lost(trial: Path) -> Iterator[None]:
    """A trial that was never run, in a block: neither its file nor a table has it."""
    tables = [trial.parents[1] / name for name in (ROWS, TIMINGS)]
    kept = {file: file.read_bytes() for file in (trial, *tables)}
    for file in kept:
        file.unlink()
    try:
        yield
    finally:
        for file, content in kept.items():
            file.write_bytes(content)


def rows_of(folder: Path) -> list[dict[str, str]]:
    with (folder / "rows.csv").open(newline="") as stream:
        return list(csv.DictReader(stream))


def test_every_trial_has_a_row_for_each_system(finished: Path) -> None:
    rows = rows_of(finished / "vqa")
    assert [(row["size"], row["seed"], row["system"]) for row in rows] == [
        (size, seed, system)
        for size in ("20", "30")
        for seed in ("0", "1")
        for system in ("seewhy", "believing", "end_to_end", "frozen")
    ]
    for row in rows:
        assert (row["trained"], row["tested"]) == (row["size"], "15")
        assert 0.0 <= float(row["accuracy"]) <= 1.0
        if row["system"] == "frozen":
            assert {row[key] for key in ("answers", "answers_strict", *EXPLAINED)} == {""}
            continue
        for key in ("accuracy", "answers", "answers_strict", *EXPLAINED):
            assert 0.0 <= float(row[key]) <= 1.0
        assert float(row["answers_strict"]) <= float(row["answers"])
    assert not [name for name in rows[0] if name.startswith("seconds")]
    timings = (finished / "vqa" / "timings.csv").read_text().splitlines()
    assert timings[0] == (
        "seed,size,system,machine,commit,seconds_networks,seconds_answers,seconds_test"
    )
    assert len(timings) == 17


def test_the_page_is_whole(finished: Path, hasty: Path, tiles_data: Path) -> None:
    page = (finished / "vqa" / "index.html").read_text(encoding="utf-8")
    for part in (
        "<title>SeeWhy: Classes and answers against the number of training pictures</title>",
        "4 of 4 trials are finished, seeds 0 to 1; 15 pictures or scenes tested in each.",
        "classified rightly: SeeWhy against end to end, 2 trials:",
        "<th>Cohen&#39;s dz</th>" if "Cohen&#39;s" in page else "<th>Cohen's dz</th>",
        "<polyline points=",
        "Processor seconds on one core, means over the trials, made on ",
        # The command as it was typed, fit for a shell, and what made page and trials.
        f"<code>seewhy experiment vqa --out &#39;{finished}&#39; --domain {hasty} "
        f"--data {tiles_data} --trials 2 --sizes 20,30 --tested 15 --jobs 1</code> "
        f"({here().commit}). The trials: {here().commit} (4 trials).",
    ):
        assert part in page
    assert "not complete" not in page
    for outside in ("http://", "https://", "src=", "@import"):
        assert outside not in page.replace("http://www.w3.org/2000/svg", "")


def test_a_run_adds_only_what_is_missing(
    run: Run, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    trials = finished / "vqa" / "trials"
    before = {file.name: file.stat().st_mtime_ns for file in trials.iterdir()}
    table = (finished / "vqa" / "rows.csv").read_bytes()
    (finished / "networks" / "0-30-1.npz").unlink()
    command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
    with lost(trials / "30-1.json"):
        result = run(*command, "--out", finished, *SMALL, "--json")
        assert (result.code, result.err) == (0, "")
        after = {file.name: file.stat().st_mtime_ns for file in trials.iterdir()}
        assert after.keys() == before.keys()
        assert [name for name in before if after[name] != before[name]] == ["30-1.json"]
        assert (finished / "vqa" / "rows.csv").read_bytes() == table
    findings = json.loads(result.out)["findings"]
    assert [finding["measure"] for finding in findings][:2] == ["accuracy", "answers"]
    assert [entry["size"] for entry in findings[0]["sizes"]] == ["20", "30"]


def test_asking_for_less_loses_nothing(
    run: Run, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    tables = [finished / "vqa" / name for name in (ROWS, TIMINGS)]
    kept = [table.read_bytes() for table in tables]
    page = (finished / "vqa" / "index.html").read_bytes()
    command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
    less = ("--trials", 1, "--sizes", "20", "--seed", 1, "--tested", 15, "--jobs", 1)
    result = run(*command, "--out", finished, *less)
    assert (result.code, result.err) == (0, "")
    assert "1 trial:" in result.out.splitlines()[0]
    assert "1 of 1 trials are finished" in (finished / "vqa" / "index.html").read_text("utf-8")
    assert [table.read_bytes() for table in tables] == kept
    (finished / "vqa" / "index.html").write_bytes(page)


def test_tables_alone_are_gone_on_from(
    run: Run, finished: Path, hasty: Path, tiles_data: Path, tmp_path: Path
) -> None:
    # As in a clone of a repository that has the results, not what they were made from.
    tables = ("vqa/rows.csv", "vqa/timings.csv")
    (tmp_path / "vqa").mkdir()
    for name in ("settings.json", *tables):
        (tmp_path / name).write_bytes((finished / name).read_bytes())
    command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
    result = run(*command, "--out", tmp_path, *SMALL)
    assert (result.code, result.err) == (0, "")
    for name in tables:
        assert (tmp_path / name).read_bytes() == (finished / name).read_bytes()
    assert not (tmp_path / "networks").exists()


def test_the_same_seeds_give_the_same_rows(
    run: Run, finished: Path, hasty: Path, tiles_data: Path, tmp_path: Path
) -> None:
    command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
    again = ("--trials", 1, "--sizes", "30", "--seed", 1, "--tested", 15, "--jobs", 1)
    assert run(*command, "--out", tmp_path / "out", *again).code == 0
    ours = rows_of(tmp_path / "out" / "vqa")
    assert ours == [
        row for row in rows_of(finished / "vqa") if (row["size"], row["seed"]) == ("30", "1")
    ]


@pytest.mark.parametrize("name", [name for name in NAMES if name != "vqa"])
def test_other_experiments_use_what_networks_saw(
    run: Run, name: str, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    command = ("experiment", name, "--domain", hasty, "--data", tiles_data)
    few = ("--trials", 1, "--sizes", "30", "--tested", 15, "--jobs", 1)
    result = run(*command, "--out", finished, *few)
    assert (result.code, result.err) == (0, "")
    rows = rows_of(finished / name)
    chosen = experiment(name)
    assert [row["system"] for row in rows] == list(chosen.systems)
    assert result.out.splitlines()[-1] == f"page: {finished / name / 'index.html'}"
    if name == "ablation":
        whole = next(row for row in rows_of(finished / "vqa") if row["size"] == "30")
        for key in ("accuracy", "answers", *EXPLAINED):
            assert rows[0][key] == whole[key]
    # Another time, from the tables alone: every system's rows are taken for what they are.
    shutil.rmtree(finished / name / "trials")
    again = run(*command, "--out", finished, *few)
    assert (again.code, again.out) == (0, result.out)
    assert rows_of(finished / name) == rows


def test_another_way_of_reading_has_a_folder_of_its_own(
    run: Run, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    """Its rows are others, of the same networks; as the domain reads is what there is already."""
    command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data, "--out", finished)
    few = ("--trials", 1, "--sizes", "20", "--tested", 15, "--jobs", 1)
    seen = {file.name for file in (finished / "networks").iterdir()}
    vqa = (finished / "vqa" / "rows.csv").read_bytes()
    result = run(*command, *few, "--reading", "with_class")
    folder = finished / "vqa-with_class"
    assert result.out.splitlines()[-1] == f"page: {folder / 'index.html'}"
    page = (folder / "index.html").read_text(encoding="utf-8")
    assert "Features are read with_class, otherwise than the domain says." in page
    theirs, ours = rows_of(finished / "vqa"), rows_of(folder)
    assert ours[2] == theirs[2]  # end to end, which reads nothing
    assert int(ours[0]["weights"]) > int(theirs[0]["weights"])
    assert {file.name for file in (finished / "networks").iterdir()} == seen
    assert (finished / "vqa" / "rows.csv").read_bytes() == vqa
    result = run(*command, *SMALL, "--reading", "argmax")
    assert result.out.splitlines()[-1] == f"page: {finished / 'vqa' / 'index.html'}"
    assert (finished / "vqa" / "rows.csv").read_bytes() == vqa
    result = run("experiment", "reading", *command[2:], *few, "--reading", "argmax")
    assert (result.code, result.out) == (2, "")
    assert result.err == (
        "seewhy: --reading goes with the other experiments; reading compares all ways to read\n"
    )


def test_reasons_are_those_of_the_annotator(structures: Domain) -> None:
    agent = Agent(structures)
    vectors = [("4", "narrow", "yes", "no"), ("2", "wide", "no", "no")]
    labels = ["unstable", "stable"]
    reference = ReferenceAnswers(structures, agent.reasoned, experience_of(vectors, labels))
    assert explanations(reference, agent.questions, vectors, labels) == (
        frozenset({"num_blocks", "base", "lean"}),
        frozenset({"num_blocks", "base", "lean", "block_displaced"}),
    )


def test_pictures_are_drawn_where_none_are_given(
    tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = (
        "import numpy as np\n"
        "def draw(*, seed, index, size):\n"
        "    colour = ('red', 'green', 'blue')[index % 3]\n"
        "    picture = np.full((size, size, 3), 40 * (1 + index % 3), dtype=np.uint8)\n"
        "    return picture, {'colour': colour, 'round': 'no'}, "
        "'good' if colour == 'red' else 'bad'\n"
    )
    folder = write_domain(tmp_path / "tiles", domain=HASTY)
    text = (folder / "domain.toml").read_text()
    (folder / "domain.toml").write_text(
        text.replace('subject = "the tile"', 'subject = "the tile"\nsource = "pictures.py"')
    )
    (folder / "pictures.py").write_text(source)
    out = tmp_path / "out"
    plan = Plan(trials=1, sizes=(12,), pictures=40, tested=20)
    small = replace(experiment("reading"), quick={"": plan})
    monkeypatch.setattr("seewhy_lab.experiments.running.experiment", lambda _: small)
    command = ("experiment", "reading", "--domain", folder, "--out", out, "--quick", "--jobs", 1)
    runs_code = (
        f"{folder / 'pictures.py'} is a program, which now runs with your rights; run only those "
        "of people whom you trust\n"
    )
    result = run(*command)
    assert (result.code, result.err) == (0, runs_code)
    assert len(list((out / "pictures" / "images").glob("*.png"))) == 40
    assert [row["tested"] for row in rows_of(out / "reading")] == ["20"] * 4
    # Networks that drawings taught go on from there; the tree knows the drawings, too.
    more = tmp_path / "more"
    before = ("experiment", "reading", "--domain", folder, "--data", out / "pictures")
    result = run(*before, "--out", more, "--quick", "--jobs", 1, "--drawn", 10)
    assert (result.code, result.err) == (0, runs_code)
    assert (more / "drawn-10" / "class" / "perception.safetensors").is_file()
    assert (more / "networks" / "10-12-0.npz").is_file()
    assert [row["tested"] for row in rows_of(more / "reading")] == ["20"] * 4


def test_trials_are_run_from_any_folder(
    hasty: Path, tiles_data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(hasty.parent)
    data = Path(os.path.relpath(tiles_data))
    given = running.prepare(
        "vqa", hasty.name, Path("out"), data=data, trials=1, sizes=[20], tested=15
    )
    calls: list[Any] = []
    monkeypatch.setattr(
        running, "run_all", lambda _, arguments, **__: calls.extend(arguments) or ()
    )
    running.run_missing(given, jobs=1)
    ((prepared, trial),) = calls
    monkeypatch.chdir(tmp_path)
    load_pictures.cache_clear()
    running._run_one(prepared, trial)
    assert trial_file(hasty.parent / "out" / "vqa", trial).is_file()
    assert list(tmp_path.iterdir()) == []


def test_one_process_draws_the_pictures_of_a_folder(
    structures: Domain, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pool = tmp_path / "pictures"
    made: list[bool] = []
    monkeypatch.setattr(
        drawing, "make_dataset", lambda *_, **__: made.append((pool / ".scenes.csv.lock").is_file())
    )
    with ExitStack() as other:
        other.enter_context(locked(pool / "scenes.csv"))

        def wait(_: float) -> None:
            assert made == []
            other.close()

        monkeypatch.setattr(drawing, "time", SimpleNamespace(sleep=wait))
        assert pool_of(structures, None, tmp_path, count=2, workers=1) == pool
    assert made == [True]
    assert not (pool / ".scenes.csv.lock").exists()


# What is refused ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("experiment", "vqaa"), "'vqaa' is no experiment; did you mean 'vqa'?"),
        (("--sizes", "20,3o"), "--sizes must be numbers of at least 2 or 'all', with commas"),
        (("--sizes", ","), "--sizes names no size; give some, as in 100,400,all"),
        (("--jobs", "0"), "--jobs must be -1 or at least 1, got 0"),
        (("--sizes", "46"), "60 pictures are too few to train on 46 and test on 15 of them"),
        (("--tested", "60"), "60 pictures are too few to train on 20 and test on 60 of them"),
        (("--drawn", "5"), "the domain 'tiles' has no source of pictures; put your own"),
        (("--data", None), "the domain 'tiles' has no source of pictures; name a folder of"),
        (("--reading", "consistant"), "'consistant' is no way to read features; did you mean"),
    ],
)  # fmt: skip
def test_what_cannot_be_run_is_refused(
    run: Run,
    change: tuple[str, str | None],
    says: str,
    hasty: Path,
    tiles_data: Path,
    tmp_path: Path,
) -> None:
    options: dict[str, object] = {
        "--domain": hasty, "--data": tiles_data, "--out": tmp_path / "out",
        "--trials": 1, "--sizes": "20", "--tested": 15, "--jobs": 1,
    }  # fmt: skip
    name = "vqa"
    if change[0] == "experiment":
        name = str(change[1])
    elif change[1] is None:
        del options[change[0]]
    else:
        options[change[0]] = change[1]
    result = run("experiment", name, *(part for pair in options.items() for part in pair))
    assert (result.code, result.out) == (2, "")
    assert says in result.err
    assert len(result.err.splitlines()) == 1
    # A folder that no trial was made in is kept for no settings.
    assert not (tmp_path / "out" / "settings.json").exists()


def test_a_folder_that_cannot_be_written(
    run: Run, hasty: Path, tiles_data: Path, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("")
    command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data, *SMALL)
    for out in (tmp_path / "file", tmp_path / "file" / "below"):
        result = run(*command, "--out", out)
        assert result.code == 2
        remedy = "choose a folder for the results with --out"
        assert result.err == f"seewhy: {out}: is a file, or lies in one; {remedy}\n"


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        '{"trial": "20-0", "rows": []}',
        '{"trial": "20-0", "rows": [{"seed": 1, "size": 20}]}',
        '{"trial": "20-0", "rows": [{"seed": 0, "size": 20}]}',
        '{"trial": "20-0", "rows": [{"seed": 0, "size": 20, "system": "a", "seconds_test": "x"}]}',
        "\xff",
    ],
)
def test_a_damaged_trial_is_named(
    run: Run, text: str, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    file = finished / "vqa" / "trials" / "20-0.json"
    kept = file.read_bytes()
    try:
        file.write_bytes(text.encode("latin-1"))
        command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
        result = run(*command, "--out", finished, *SMALL)
    finally:
        file.write_bytes(kept)
    assert result.code == 2
    assert result.err == (
        f"seewhy: {file}: is not as it was written; delete it, and the same command makes it "
        "again\n"
    )


def test_a_trial_that_was_edited_is_named(
    run: Run, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    file = finished / "vqa" / "trials" / "20-0.json"
    kept = file.read_bytes()
    table = (finished / "vqa" / "rows.csv").read_bytes()
    content = json.loads(kept)
    content["rows"][0]["accuracy"] += 0.001
    try:
        file.write_text(json.dumps(content))
        command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
        result = run(*command, "--out", finished, *SMALL)
    finally:
        file.write_bytes(kept)
    assert (result.code, f"{file}: is not as it was written; delete it" in result.err) == (2, True)
    assert (finished / "vqa" / "rows.csv").read_bytes() == table


def test_trials_of_a_version_that_compared_others_are_named(
    run: Run, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    file = finished / "vqa" / "trials" / "30-1.json"
    content = json.loads(file.read_bytes())
    earlier = [row for row in content["rows"] if row["system"] != "believing"]
    with lost(file):
        write_trial(finished / "vqa", Trial(1, 30), earlier, made=content["made"])
        command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
        result = run(*command, "--out", finished, *SMALL)
    assert result.code == 2
    assert result.err == (
        f"seewhy: {finished / 'vqa'}: holds trials of an earlier version, which compared others "
        "(seewhy, end_to_end, frozen); choose another folder with --out, or delete this one\n"
    )


@pytest.mark.parametrize("damage", ["empty", "half", "text", "byte", "other", "more", "list"])
@pytest.mark.parametrize("pattern", ["networks/0-20-0.npz", "pixels-*.npy"])
def test_what_is_kept_for_trials_may_be_damaged(
    run: Run, damage: str, pattern: str, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    if (damage, pattern) == ("byte", "pixels-*.npy"):
        pytest.skip("a pixel more or less is not noticed")
    if damage in ("more", "list") and pattern == "pixels-*.npy":
        pytest.skip("pixels have no numbers beside them")
    (file,) = finished.glob(pattern)
    trial = finished / "vqa" / "trials" / "20-0.json"
    kept = file.read_bytes()
    middle = len(kept) // 3
    other = io.BytesIO()
    if file.suffix == ".npz":
        with np.load(file) as found:
            arrays = dict(found)
        numbers = json.loads(str(arrays.pop("numbers")))
        changed = {"more": {**numbers, "colour": 1}, "list": [numbers]}.get(damage, {})
        np.savez(other, numbers=json.dumps(changed), **({} if damage == "other" else arrays))
    else:
        np.save(other, np.zeros((3, 16, 16, 3), dtype=np.uint8))
    file.write_bytes(
        {
            "empty": b"",
            "half": kept[: len(kept) // 2],
            "text": b"text",
            "byte": kept[:middle] + bytes([kept[middle] ^ 255]) + kept[middle + 1 :],
        }.get(damage, other.getvalue())
    )
    load_pictures.cache_clear()
    try:
        command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
        with lost(trial):
            result = run(*command, "--out", finished, *SMALL)
    finally:
        file.write_bytes(kept)
        load_pictures.cache_clear()
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith(f"seewhy: {file}: is not as it was written; delete it, and the")
    assert len(result.err.splitlines()) == 1
    assert not list(finished.glob("*/trials/.*.lock"))


def test_trials_of_another_process_are_not_waited_for(
    run: Run, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    trial = finished / "vqa" / "trials" / "20-0.json"
    with lost(trial), locked(trial):
        command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
        result = run(*command, "--out", finished, *SMALL)
        page = (finished / "vqa" / "index.html").read_text(encoding="utf-8")
    assert result.code == 0
    assert result.err == (
        "1 of 4 trials are with other processes; the same command adds them when they are "
        "finished\n"
    )
    assert "The run is not complete" in page


def test_a_folder_of_other_settings(
    run: Run, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
    result = run(*command, "--out", finished, *SMALL, "--tested", 10)
    assert result.code == 2
    assert result.err == (
        f"seewhy: {finished}: holds trials with other settings (tested); choose another folder "
        "with --out, or delete this one\n"
    )


def test_pictures_are_kept_where_a_folder_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = Plan(trials=1, sizes=(20,), pictures=30, tested=5)
    vqa = replace(experiment("vqa"), full={"": plan}, trial=lambda *_: [])
    monkeypatch.setattr("seewhy_lab.experiments.running.experiment", lambda _: vqa)
    running.prepare("vqa", "structure_stability", tmp_path, workers=1)
    table = tmp_path / "pictures" / "scenes.csv"
    kept = table.read_bytes()
    smaller = replace(vqa, full={"": replace(plan, pictures=28)})
    monkeypatch.setattr("seewhy_lab.experiments.running.experiment", lambda _: smaller)
    for tested, why in ((4, "other settings (tested)"), (5, "30 pictures, and 28 are asked for")):
        with pytest.raises(ExperimentError) as error:
            running.prepare("vqa", "structure_stability", tmp_path, tested=tested, workers=1)
        assert why in str(error.value)
        assert table.read_bytes() == kept
    # As in a clone: nothing drawn yet. The right command must not find the wrong pictures.
    shutil.rmtree(tmp_path / "pictures")
    with pytest.raises(ExperimentError, match=r"other settings \(pictures\)"):
        running.prepare("vqa", "structure_stability", tmp_path, workers=1)
    assert not (tmp_path / "pictures").exists()


@pytest.mark.parametrize(
    ("name", "seed", "says"),
    [
        ("vqa", 2**32 - 1, "seeds go up to 4,294,967,295"),
        ("planning", 10**6 - 1, "from 1,000,000 on they are those of the runs"),
    ],
)
def test_seeds_that_there_are_not(
    run: Run, tmp_path: Path, name: str, seed: int, says: str
) -> None:
    result = run("experiment", name, "--out", tmp_path / "out", "--trials", 2, "--seed", seed)
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith("seewhy: --seed: the last of 2 seeds would be ")
    assert says in result.err
    assert not list((tmp_path / "out").glob("*"))


@pytest.mark.parametrize("text", ["[", "[]", "null", "3", "\xff"])
def test_settings_that_are_damaged(
    run: Run, text: str, finished: Path, hasty: Path, tiles_data: Path
) -> None:
    file = finished / "settings.json"
    kept = file.read_bytes()
    try:
        file.write_bytes(text.encode("latin-1"))
        command = ("experiment", "vqa", "--domain", hasty, "--data", tiles_data)
        result = run(*command, "--out", finished, *SMALL)
    finally:
        file.write_bytes(kept)
    assert result.code == 2
    assert f"{file}: is not as it was written" in result.err


# Drawing -----------------------------------------------------------------------------------------


def test_trials_draw_anew_and_test_on_others(dataset: Dataset, tmp_path: Path) -> None:
    prepared = setting(dataset, tmp_path)
    drawn = {}
    for size in (10, 20, ALL):
        for seed in (0, 1):
            train, test = divide(prepared, Trial(seed, size))
            assert len(train) == (size or 40)
            assert len(test) == 20
            assert not {s.picture for s in train.scenes} & {s.picture for s in test.scenes}
            drawn[seed, size] = [s.picture for s in train.scenes], [s.picture for s in test.scenes]
    assert drawn[0, 10][1] == drawn[0, 20][1] != drawn[1, 10][1]
    assert not set(drawn[0, 10][0]) <= set(drawn[0, 20][0])
    assert divide(prepared, Trial(0, 10))[0].scenes == divide(prepared, Trial(0, 10))[0].scenes


def test_groups_stay_whole_and_all_are_tested(dataset: Dataset, tmp_path: Path) -> None:
    grouped = tuple(replace(s, split="", group=str(n // 2)) for n, s in enumerate(dataset.scenes))
    scenes = replace(dataset, scenes=grouped)
    folds = np.array([in_fold(scenes, fold) for fold in range(5)])
    assert (folds.sum(axis=0) == 1).all()
    prepared = replace(setting(dataset, tmp_path), scenes=scenes)
    train, test = divide(prepared, Trial(3, ALL))
    # A group is one of a class: what differs in class is no one thing.
    pairs = {(s.label, s.group) for s in train.scenes} & {(s.label, s.group) for s in test.scenes}
    assert not pairs
    for seed in range(5):
        left = len(divide(prepared, Trial(seed, ALL))[0])
        require_enough(prepared, Trial(seed, left))
        with pytest.raises(ExperimentError, match=f"too few to train on {left + 1} and test on"):
            require_enough(prepared, Trial(seed, left + 1))


# Questions ---------------------------------------------------------------------------------------


def test_questions_suit_the_class(dataset: Dataset) -> None:
    agent = Agent(dataset.domain)
    asked = draw_questions(agent.questions, dataset.labels, seed=0, count=5)
    assert asked == draw_questions(agent.questions, dataset.labels, seed=0, count=5)
    assert asked != draw_questions(agent.questions, dataset.labels, seed=1, count=5)
    assert len(asked) == 5 * len(dataset)
    for drawn in asked:
        assert suitable(drawn.question, dataset.labels[drawn.picture])
    for number in range(len(dataset)):
        queries = [drawn.question.query for drawn in asked if drawn.picture == number]
        assert len(set(queries)) == 5
    assert Asks.EXPLAIN not in {drawn.question.asks for drawn in asked}
    assert {Asks.WHY_CLASS, Asks.CHANGE_TO_CLASS} <= {drawn.question.asks for drawn in asked}


def test_the_network_end_to_end_learns_from_such_questions_as_it_is_tested_on(
    dataset: Dataset,
) -> None:
    questions, labels = Agent(dataset.domain).questions, dataset.labels
    asked = questions_to_learn(questions, labels, seed=0)
    assert asked == questions_to_learn(questions, labels, seed=0)
    assert asked != questions_to_learn(questions, labels, seed=1)
    for drawn in asked:
        assert suitable(drawn.question, labels[drawn.picture])
    # A domain with many classes has hundreds of questions about classes, and one that asks for
    # the class: the network would hardly meet it if every question were as likely as every other.
    kinds = Counter(drawn.question.asks for drawn in asked)
    tested = Counter(drawn.question.asks for drawn in draw_questions(questions, labels, seed=0))
    for kind in kinds | tested:
        assert kinds[kind] / len(asked) == pytest.approx(tested[kind] / tested.total(), abs=0.03)
    # Every picture is asked as often as every other, as often as every question twice.
    (often,) = set(Counter(drawn.picture for drawn in asked).values())
    fitting = {drawn.question.query for drawn in asked if labels[drawn.picture] == labels[0]}
    assert often == pytest.approx(2 * len(fitting), rel=0.2)
    few = questions_to_learn(questions, labels, seed=0, most=3 * len(labels) + 1)
    assert len(few) == 3 * len(labels)
    assert len(questions_to_learn(questions, labels, seed=0, most=1)) == len(labels)


def test_right_answers_score_one(dataset: Dataset) -> None:
    reference = annotator(dataset)
    asked = draw_questions(Agent(dataset.domain).questions, dataset.labels, seed=0, count=4)
    right = [
        reference.answer(
            drawn.question, dataset.vectors[drawn.picture], dataset.labels[drawn.picture]
        )
        for drawn in asked
    ]
    seen = {
        "vectors": [dataset.vectors[drawn.picture] for drawn in asked],
        "labels": [dataset.labels[drawn.picture] for drawn in asked],
    }
    scores = answer_scores(asked, right, dataset, reference, **seen)
    # That it is red is the author's reason for a round tile, but worn red tiles are bad.
    assert 0.8 < scores.pop("explanations_sufficient") < 1.0
    assert set(scores.values()) == {1.0}
    more = [replace(answer, mentions=("colour", "round")) for answer in right]
    scores = answer_scores(asked, more, dataset, reference, **seen)
    assert scores["answers"] == 1.0 > scores["answers_strict"]
    assert scores["explanations_sufficient"] > scores["explanations_strict"]
    wrong = [AnswerType("unknown") for _ in asked]
    assert set(answer_scores(asked, wrong, dataset, reference, **seen).values()) == {0.0}


# Axioms ------------------------------------------------------------------------------------------


def test_axioms_that_are_removed_are_learned_again(structures: Domain) -> None:
    full = Agent(structures)
    space = [
        (number, base, lean, displaced)
        for number in "12345"
        for base in ("wide", "narrow")
        for lean in ("yes", "no")
        for displaced in ("yes", "no")
    ]
    decided = [v for v in space if full.decide(dict(zip(structures.features, v, strict=True)))]
    labels = [str(full.reasoner.decide(v).label) for v in decided]
    scenes = AnnotatedScenes(tuple(decided * 10), tuple(labels * 10), ("",) * 10 * len(decided))
    less = incomplete(structures, seed=0)
    assert len(less.knowledge.axioms) == 4
    assert less.knowledge.axioms != incomplete(structures, seed=1).knowledge.axioms
    assert agreement(Agent(less).reasoner, full.reasoner, space) < 1.0
    axioms, aside = learned_again(less, scenes)
    more = Agent(less, learned=axioms, withdrawn=aside)
    assert agreement(more.reasoner, full.reasoner, space) == 1.0


# Conclusions -------------------------------------------------------------------------------------


def made(ours: list[float], theirs: list[float], *, size: int = 100) -> list[Row]:
    keys = ("accuracy", "answers", "answers_strict", "explanations", *EXPLAINED)
    return [
        {"seed": seed, "size": size, "system": system, **dict.fromkeys(keys, value)}
        for seed, pair in enumerate(zip(ours, theirs, strict=True))
        for system, value in zip(
            ("seewhy", "believing", "end_to_end", "frozen"),
            (pair[0], *pair, pair[1]),
            strict=True,
        )
    ]


def test_conclusions_are_drawn_from_the_numbers() -> None:
    rng = np.random.default_rng(0)
    low = (0.5 + 0.01 * rng.random(12)).tolist()
    high = [score + 0.1 + 0.001 * n for n, score in enumerate(low)]
    rows = [*made(high, low, size=100), *made(low, low, size=200), *made(low, high, size=0)]
    finding = conclude("vqa", rows, domain="tiles")[0]
    assert [comparison.verdict for comparison in finding.compared] == ["better", "open", "worse"]
    assert not finding.supported
    assert finding.text == (
        "classified rightly: SeeWhy against end to end, 12 trials: significantly better at 100 "
        "(+10.5 points); significantly worse at all (-10.5 points); not told apart at 200 "
        "(+0.0 points). What is claimed does not hold at 200, all."
    )
    (first, *_) = conclude("vqa", made(high, low), domain="tiles")
    assert first.supported
    assert first.text.endswith("What is claimed holds.")
    assert json.dumps(first.to_dict(), allow_nan=False)
    (none, *_) = conclude("vqa", [], domain="tiles")
    assert none.text.endswith("there is no finished trial yet.")


def test_less_is_claimed_of_some_sizes_and_domains() -> None:
    rng = np.random.default_rng(0)
    low = (0.5 + 0.01 * rng.random(12)).tolist()
    high = [score + 0.1 + 0.001 * n for n, score in enumerate(low)]
    mixed = [score + 0.02 * (n % 2) - 0.009 for n, score in enumerate(low)]
    rows = [
        *made(high, low, size=1000),
        *made(mixed, low, size=1001),
        *made([score - 0.002 for score in mixed], low, size=ALL),
    ]
    accuracy, answers, *_ = conclude("vqa", rows, domain="traffic_signs")
    assert [comparison.verdict for comparison in accuracy.compared] == ["better", "open", "open"]
    assert (accuracy.failed, answers.failed) == ((ALL,), (1001, ALL))
    equal, *_ = conclude("vqa", rows, domain="structure_stability")
    assert equal.supported
    worse, *_ = conclude("vqa", made(low, high), domain="structure_stability")
    assert worse.failed == (100,)
    assert summary([equal, worse, answers]) == (
        "1 of 3 claims hold at every size that was tried. The hypothesis is not supported for "
        "classified rightly: SeeWhy against end to end at 100; answers, every relevant attribute: "
        "SeeWhy, believing who asks against end to end at 1001, all."
    )


def test_what_it_takes_to_reach_a_level() -> None:
    rows = [*made([0.6, 0.7], [0.5, 0.5], size=100), *made([0.9, 0.9], [0.7, 0.8], size=200)]
    for row in rows:
        row |= {"trained": row["size"], "seconds_networks": row["size"] / 10, "seconds_test": 9.0}
    found = efforts(rows, ["seewhy", "end_to_end"], "accuracy")
    assert [effort for effort in found if effort.level in (0.7, 0.8)] == [
        Effort("seewhy", 0.7, 120.0, 12.0),
        Effort("end_to_end", 0.7, 180.0, 18.0),
        Effort("seewhy", 0.8, 160.0, 16.0),
        Effort("end_to_end", 0.8, None, None),
    ]
    assert {effort.level for effort in found} == {0.7, 0.8, 0.85, 0.9}
    # Pictures are those of all trials, seconds those of one machine's.
    others = [{**row, "machine": "slow", "seed": row["seed"] + 2} for row in rows]
    for row in others:
        row |= {"accuracy": row["accuracy"] - 0.2, "seconds_networks": 99.0}
    twice = efforts([*others[:-1], *rows], ["seewhy", "end_to_end"], "accuracy")
    assert Effort("seewhy", 0.7, 160.0, 16.0) in twice
    # A size beyond the level, of which nothing was timed, does not matter.
    further = [*made([0.95], [0.9], size=400)]
    for row in further:
        row |= {"trained": 400, "machine": "slow", "seconds_networks": 1.0}
    found = efforts([*rows, *further], ["seewhy", "end_to_end"], "accuracy")
    assert Effort("seewhy", 0.8, 160.0, 16.0) in found
    assert Effort("end_to_end", 0.8, 266.666666667, None) in found
    # Networks that another machine trained are not timed here: no seconds, not fewer.
    for row in rows:
        row |= {"seconds_networks": None, "seconds_answers": 1.0}
    found = efforts(rows, ["seewhy", "end_to_end"], "accuracy")
    assert {effort.seconds for effort in found} == {None}


def test_one_trial_proves_nothing() -> None:
    finding = conclude("vqa", made([0.9], [0.1]), domain="tiles")[0]
    assert finding.compared[0].verdict == "open"
    assert summary([finding]).startswith("There are too few trials for any difference to be")
    # Six of six at one size: Wilcoxon's p is 2/64.
    few = conclude("vqa", made([0.9] * 5, [0.1] * 5), domain="tiles")
    enough = conclude("vqa", made([0.9] * 6, [0.1] * 6), domain="tiles")
    assert summary(few).startswith("There are too few")
    assert summary(enough) == "9 of 9 claims hold at every size that was tried."
    assert json.dumps(finding.to_dict(), allow_nan=False)
    # One trial more of another size takes nothing from what enough trials told.
    more = [*made([0.9] * 6, [0.1] * 6), *made([0.9], [0.1], size=200)]
    assert summary(conclude("vqa", more, domain="tiles")) == (
        "9 of 9 claims hold at every size that was tried often enough to tell. At 200 there are "
        "too few trials to tell."
    )
    worse = [*made([0.1] * 9, [0.9] * 9), *made([0.9] * 2, [0.1] * 2, size=200)]
    said = summary(conclude("vqa", worse, domain="tiles"))
    assert said.startswith("0 of 9 claims hold")
    assert "classified rightly: SeeWhy against end to end at 100;" in said


def test_an_experiment_is_found_by_name() -> None:
    assert [experiment(name).name for name in NAMES] == list(NAMES)
    for name in NAMES:
        chosen = experiment(name)
        keys = {measure.key for measure in chosen.measures}
        for claim in chosen.claims:
            assert claim.measure in keys
            assert {claim.system, claim.against} <= chosen.systems.keys()
    with pytest.raises(ExperimentError, match="did you mean 'axioms'"):
        experiment("axiom")


def test_the_clock_of_learning_runs_in_learning_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """By this clock a tree takes a second, a recurrent network ten, deciding at first an hour."""
    clock = Counter[str]()

    def taking(place: object, name: str, seconds: Callable[[], int]) -> None:
        real = getattr(place, name)

        def slow(*arguments: Any, **options: Any) -> Any:
            clock["now"] += seconds()
            clock[name] += 1
            return real(*arguments, **options)

        monkeypatch.setattr(place, name, slow)

    monkeypatch.setattr(coupling.time, "process_time", lambda: float(clock["now"]))
    taking(Reasoner, "decide_all", lambda: 0 if clock["decide_all"] else 3600)
    taking(DecisionTree, "fit", lambda: 1)
    taking(learned, "fit_answerer", lambda: 10)
    agent = Agent(load_domain("structure_stability"), eyes="none")
    values = (feature.values for feature in agent.domain.features.values())
    # Whatever the knowledge says of it, one of the two is not as it says.
    vectors, labels = [next(itertools.product(*values))] * 2, ["stable", "unstable"]
    reference = ReferenceAnswers(agent.domain, agent.reasoned, experience_of(vectors, labels))
    assert coupling._learned(agent, vectors, labels, reference) == (1.0, 10.0)
    assert agent.answerer is not None
