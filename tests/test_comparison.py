"""The comparison with other systems: its command from outside, its trials, and its page."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
import zipfile
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image, ImageDraw

from conftest import Run
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain
from seewhy.files.locks import locked
from seewhy.perception import fitting_eyes, training
from seewhy_lab.commands import compare
from seewhy_lab.comparison import fine_tuned, small_network, trials
from seewhy_lab.comparison.catalogue import SYSTEMS
from seewhy_lab.comparison.page import page
from seewhy_lab.comparison.picture_sets import SETS, drawn_rows
from seewhy_lab.comparison.system import Drawings, Fitted, System
from seewhy_lab.comparison.trials import Result, Trial, planned

DOMAINS = Path(__file__).parents[1] / "src" / "seewhy_lab" / "comparison" / "domains"

PERSONS = (0, 1, 2, 3, 4, 6, 8)
TESTED = {"0", "6", "8"}  # as `is_tested` says
COUNT = 20


def hand(digit: str, person: int) -> bytes:
    """Five bars, one a finger, of which the stretched ones are long."""
    table = (DOMAINS / "hands" / "classes.csv").read_text().splitlines()
    fingers = next(line.split(",")[1:] for line in table if line.startswith(f"{digit},"))
    image = Image.new("RGB", (48, 48), (230, 225 - person, 220))
    draw = ImageDraw.Draw(image)
    for n, finger in enumerate(fingers):
        top = 4 + person if finger == "stretched" else 34
        draw.rectangle((3 + 9 * n, top, 8 + 9 * n, 44), fill=(180, 120 + 4 * person, 90))
    stream = io.BytesIO()
    image.save(stream, "JPEG")
    return stream.getvalue()


@pytest.fixture(scope="module")
def archives(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with an archive of 70 hands, laid out as the real one."""
    folder = tmp_path_factory.mktemp("archives")
    with zipfile.ZipFile(folder / "hands.zip", "w") as archive:
        archive.writestr("hands/LICENSE", "Apache-2.0")
        for digit in map(str, range(10)):
            for person in PERSONS:
                archive.writestr(f"hands/{digit}/{person}_{person}.jpg", hand(digit, person))
    return folder


def read(out: Path, name: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((out / "trials" / f"{name}.json").read_text())
    return found


def test_the_command_runs_goes_on_and_reports(archives: Path, tmp_path: Path) -> None:
    """The real program, twice: what was interrupted goes on, what is there is not run again."""
    common = [
        *(sys.executable, "-m", "seewhy_lab", "compare", "--out", tmp_path / "out"),
        *("--data", archives, "--sets", "hands", "--systems", "frozen_features"),
        *("--counts", COUNT),
    ]

    def call(*more: object) -> subprocess.CompletedProcess[str]:
        words = [str(word) for word in (*common, *more)]
        environment = {**os.environ, "SEEWHY_CACHE": str(tmp_path / "cache")}
        return subprocess.run(words, capture_output=True, text=True, env=environment, check=False)

    done = call("--seeds", 1)
    assert (done.returncode, done.stdout) == (0, f"page: {tmp_path / 'out' / 'report.md'}\n")
    assert done.stderr.startswith(f"hands/frozen_features-{COUNT}-0: ")
    first = tmp_path / "out" / "trials" / "hands" / f"frozen_features-{COUNT}-0.json"
    kept = json.loads(first.read_text())
    assert kept["accuracy"] > 0.5  # a tenth by chance
    assert (kept["trained_on"], kept["tested"]) == (COUNT, 30)
    assert set(kept["options"]) == {"backbone", "strength", "held_out_right"}
    first.write_text(json.dumps({**kept, "accuracy": 0.25}))
    first.with_name(".being-written.json").write_text("{")
    report = compare_here(
        *("--out", tmp_path / "out", "--sets", "hands", "--systems", "frozen_features"),
        *("--counts", COUNT, "--seeds", 2, "--report"),
    )
    assert "**Missing: 1 of 2 trials.**" in report
    assert f"| {COUNT} | **25.0 (1 seed)** |" in report
    report = compare_here(*common[4:], "--seeds", 2)
    second = read(tmp_path / "out", f"hands/frozen_features-{COUNT}-1")
    assert second["trial"]["seed"] == 1
    assert read(tmp_path / "out", f"hands/frozen_features-{COUNT}-0")["accuracy"] == 0.25
    assert f"**{50 * (0.25 + second['accuracy']):.1f} ± " in report
    assert "Missing" not in report


def compare_here(*arguments: object) -> str:
    """Run the command in this process; return its page."""
    words = [str(word) for word in arguments]
    compare.main(words)
    return (Path(words[words.index("--out") + 1]) / "report.md").read_text()


@pytest.fixture
def few_passes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fitting_eyes, "_PASSES", (1, 1))
    monkeypatch.setattr(fitting_eyes, "_VIEWS", (2, 2))
    monkeypatch.setattr(training, "planned_epochs", lambda *_, **__: 1)
    monkeypatch.setattr(small_network, "PASSES", 1)
    monkeypatch.setattr(fine_tuned, "PASSES", (1, 1))
    monkeypatch.setattr(fine_tuned, "DRAWN_GONE_OVER", 1)


@pytest.mark.usefixtures("few_passes")
def test_every_other_system_is_trained_and_kept(archives: Path, tmp_path: Path) -> None:
    names = [name for name in SYSTEMS if name != "frozen_features"]
    report = compare_here(
        *("--data", archives, "--out", tmp_path, "--sets", "hands", "--counts", COUNT),
        *("--systems", ",".join(names), "--seeds", 1),
    )
    assert "Missing" not in report
    found = {name: read(tmp_path, f"hands/{name}-{COUNT}-0") for name in names}
    for kept in found.values():
        assert (kept["trained_on"], kept["tested"]) == (COUNT, 30)
        assert kept["seconds"] > 0
        assert {"version", "commit", "machine", "balanced_accuracy"} <= set(kept)
    options = {name: kept["options"] for name, kept in found.items()}
    assert options["seewhy"] == {
        "eyes": "efficientnet-lite0",
        "reading": "with_class",
        "known_share": 0.995,
    }
    assert options["before"] == {
        "eyes": "none",
        "reading": "argmax",
        "known_share": 1.0,
        "depth": 1,
        "epochs": 18,
    }
    assert options["small_network"]["depth"] == 4
    # Both were shown the pictures in the ways that SeeWhy chose.
    for name in ("flip", "rotate", "scale", "shift", "brightness"):
        assert options["small_network"][name] == options["fine_tuned"][name]


@pytest.mark.usefixtures("few_passes")
@pytest.mark.parametrize("name", list(SYSTEMS))
def test_drawings_come_before(name: str, tmp_path: Path, made: Dataset) -> None:
    drawings = Drawings("structure_stability", 8, tmp_path)
    fitted = SYSTEMS[name].fit(made.take(range(12)), 0, drawings)
    assert len(Dataset.load(tmp_path / "drawn", made.domain)) == 8
    assert len(fitted.classify(made.take(range(12, 15)))) == 3


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Dataset:
    """Fifteen structures, each of which the other seed draws otherwise."""
    drawings = Drawings("structure_stability", 15, tmp_path_factory.mktemp("made"))
    return drawings.scenes()


def test_all_systems_get_the_same_pictures(
    archives: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those of tested people are never trained on; seed and count settle the others."""
    shown: dict[str, list[tuple[frozenset[str], frozenset[str]]]] = {"seewhy": [], "before": []}

    def spy(name: str) -> Callable[[Dataset, int, Drawings | None], Fitted]:
        def fit(train: Dataset, _seed: int, _drawings: Drawings | None) -> Fitted:
            def classify(test: Dataset) -> Sequence[str | None]:
                parts = [
                    frozenset(part.name_of(scene) for scene in part.scenes)
                    for part in (train, test)
                ]
                shown[name].append((parts[0], parts[1]))
                assert {scene.group for scene in test.scenes} == TESTED
                assert not TESTED & {scene.group for scene in train.scenes}
                return [None if name == "before" else "7"] * len(test)

            return Fitted(classify, {})

        return fit

    for name in shown:
        monkeypatch.setitem(SYSTEMS, name, replace(SYSTEMS[name], fit=spy(name)))
    report = compare_here(
        *("--data", archives, "--out", tmp_path, "--sets", "hands", "--counts", "10,20,all"),
        *("--systems", "seewhy,before", "--seeds", 2),
    )
    assert shown["seewhy"] == shown["before"]
    assert len({test for _, test in shown["seewhy"]}) == 1
    sizes = Counter(len(train) for train, _ in shown["seewhy"])
    assert sizes == {10: 2, 20: 2, 40: 2}
    assert len({train for train, _ in shown["seewhy"] if len(train) == 10}) == 2
    assert "| all | **10.0 ± 0.0** | 0.0 ± 0.0 | +10.0 ± 0.0 over (e) |" in report
    assert "Of 100.0 % of the pictures (e) decides on no class; they count as wrong." in report


@settings(max_examples=60)
@given(
    st.lists(st.sampled_from("aabc"), min_size=1, max_size=40),
    st.integers(0, 5),
    st.data(),
)
def test_labels_are_drawn_in_the_shares_of_the_classes(
    classes: list[str], seed: int, data: st.DataObject
) -> None:
    count = data.draw(st.integers(1, len(classes)))
    rows = drawn_rows(classes, count, seed=seed)
    assert rows == sorted(set(rows))
    assert len(rows) == count
    drawn = Counter(classes[row] for row in rows)
    for label, there in Counter(classes).items():
        # Rounded up or down; each other class may take one more or fewer.
        assert abs(drawn[label] - count * there / len(classes)) <= 2
    assert drawn_rows(classes, 0, seed=seed) == list(range(len(classes)))
    assert set(rows) <= set(drawn_rows(classes, min(count + 1, len(classes)), seed=seed))


def result(system: str, count: int, seed: int, accuracy: float, **more: Any) -> Result:
    """What a trial on hands may have found."""
    return Result(
        **{
            "trial": Trial("hands", system, count, seed, more.pop("drawn", 0)),
            "accuracy": accuracy,
            "balanced_accuracy": accuracy,
            "unknown": 0.0,
            "trained_on": count,
            "tested": 459,
            "seconds": 1.0,
            "processor_seconds": 1.0,
            "options": {},
            "version": "0.1.0",
            "commit": "commit 123456789",
            "machine": "a machine, 2 cores, Linux",
            **more,
        }
    )


PAGE = """\
# SeeWhy beside what else one would try

Accuracy in per cent on the same held-out pictures, mean ± standard error over seeds; a seed \
settles which pictures are labelled. The best of a row is bold. A number of seeds stands where it \
is not 3; – is what was not run.

**Missing: 12 of 24 trials.**

## Hands showing digits, tested on other people

Tested on 459 pictures.

| labels | (a) SeeWhy by default | (b) small network | (d) fine-tuned backbone | \
(a) − best of the others |
|---|---|---|---|---|
| 100 | **92.0 ± 1.2** | 90.0 ± 0.6 | – | +2.0 ± 0.6 over (b) |
| 300 | 95.0 ± 1.0 (2 seeds) | **96.0 (1 seed)** | 93.0 (1 seed) | −2.0 over (b) (1 seed) |
| 1000 | **99.0 (1 seed)** | **99.0 (1 seed)** | – | – |

Of 0.1 % of the pictures (a) decides on no class; they count as wrong. (d) is run with at most 500 \
labels without a graphics processor.

Every system was trained on 500 drawings before.

Tested on 459 or 460 pictures. **Trials were not tested on the same.**

| labels | (a) SeeWhy by default | (b) small network | (d) fine-tuned backbone | \
(a) − best of the others |
|---|---|---|---|---|
| 100 | 90.0 (1 seed) | **91.0 (1 seed)** | – | −1.0 over (b) (1 seed) |

Made by commit 123456789 (13 trials), commit 987654321 (1 trial); on a machine, 2 cores, Linux.
"""


def test_the_page_says_what_there_is_and_what_is_missing() -> None:
    results = [
        *(result("seewhy", 100, n, share) for n, share in enumerate((0.90, 0.92, 0.94))),
        *(result("small_network", 100, n, share) for n, share in enumerate((0.89, 0.90, 0.91))),
        result("seewhy", 300, 0, 0.94),
        result("seewhy", 300, 1, 0.96, unknown=0.006),
        result("small_network", 300, 0, 0.96),
        result("fine_tuned", 300, 0, 0.93),
        # Of other seeds, so that no difference is told.
        result("seewhy", 1000, 0, 0.99),
        result("small_network", 1000, 2, 0.99),
        result("seewhy", 100, 0, 0.90, drawn=500),
        result("small_network", 100, 0, 0.91, drawn=500, tested=460, commit="commit 987654321"),
        result("before", 100, 0, 0.5),
    ]
    systems = [SYSTEMS[name] for name in ("seewhy", "small_network", "fine_tuned")]
    asked = planned(["hands"], systems, counts=None, seeds=3, drawn=0, on_processor=True)
    text = page(results, sets=[SETS["hands"]], systems=systems, asked=asked, seeds=3)
    assert text == PAGE


def test_what_nobody_has_the_patience_for_is_not_planned() -> None:
    def asked(*, on_processor: bool) -> set[int]:
        found = planned(
            ["signs"],
            [SYSTEMS["fine_tuned"]],
            counts=None,
            seeds=1,
            drawn=9,
            on_processor=on_processor,
        )
        return {trial.count for trial in found}

    assert asked(on_processor=True) == {100, 200, 500}
    assert asked(on_processor=False) == set(SETS["signs"].counts)


@pytest.mark.parametrize("name", ["hands", "set_cards"])
def test_the_domains_are_sound(name: str, run: Run) -> None:
    folder = DOMAINS / name
    checked = run("check", folder)
    assert (checked.code, checked.out.splitlines()[-1]) == (0, "nothing is wrong")
    domain = load_domain(folder)
    assert set(domain.classes) == {
        line.split(",")[0] for line in (folder / "classes.csv").read_text().splitlines()[1:]
    }


HANDS = ("--sets", "hands", "--systems", "seewhy", "--seeds", "1")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--sets", "hand"), "--sets: 'hand' is none; did you mean 'hands'?"),
        (("--systems", "before,after"), "--systems: 'after' is none; it must be one of: seewhy, "),
        (("--sets", ""), "--sets names nothing; there are structures, signs, hands, set_cards, "),
        (("--counts", "100,x"), "--counts must be numbers of at least 2 or 'all', with commas "),
        (("--counts", ","), "--counts names no count; give some, as in 100,300,all"),
        (("--seeds", "0"), "--seeds must be at least 1, got 0"),
        (("--drawn", "-1"), "--drawn must be 0 or more, got -1"),
        (("--drawn", "9", *HANDS), "--drawn: hands is no set of photographs whose domain can draw"),
        (("--report",), "OUT: holds no trial; leave --report out to run some"),
        (HANDS, "the set hands is made of hands.zip; name the folder that holds it with --data"),
        ((*HANDS, "--data", "OUT"), "OUT/hands.zip: there is no such file, of which the set hands"),
        (
            (*HANDS, "--data", "ARCHIVES", "--counts", "41"),
            "41 labels are asked for and 40 pictures are there to train on; choose fewer with "
            "--counts",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(
    arguments: tuple[str, ...],
    said: str,
    archives: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    places = {"OUT": str(tmp_path), "ARCHIVES": str(archives)}
    words = [places.get(word, word) for word in arguments]
    with pytest.raises(SystemExit) as stopped:
        compare.main(["--out", str(tmp_path), *words])
    error = capsys.readouterr().err
    assert stopped.value.code == 2
    assert error.startswith(f"seewhy: {said.replace('OUT', str(tmp_path))}")
    assert error.count("\n") == 1


@pytest.mark.parametrize(
    "spoil",
    [
        lambda _: "{",
        lambda found: json.dumps({**found, "accuracy": 1.5}),
        lambda found: json.dumps({**found, "trial": {**found["trial"], "seed": 3}}),
        lambda found: json.dumps({key: found[key] for key in found if key != "tested"}),
    ],
    ids=["half", "share", "other", "column"],
)
def test_a_damaged_trial_is_named(
    spoil: Callable[[dict[str, Any]], str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sound = result("seewhy", 100, 0, 0.5)
    file = trials.trial_file(tmp_path, sound.trial)
    file.parent.mkdir(parents=True)
    file.write_text(json.dumps(asdict(sound)))
    assert trials.read_result(file) == sound
    file.write_text(spoil(asdict(sound)))
    with pytest.raises(SystemExit):
        compare.main(["--out", str(tmp_path), "--report"])
    assert capsys.readouterr().err == (
        f"seewhy: {file}: is not as it was written; delete it, and the same command makes it "
        "again\n"
    )


def test_a_trial_that_somebody_else_runs_is_left_to_them(tmp_path: Path) -> None:
    def never(*_: object) -> Any:
        raise AssertionError("it was run")

    trial = Trial("hands", "x", 10, 0)
    with locked(trials.trial_file(tmp_path, trial)):
        assert trials.run_trial(tmp_path, trial, System("x", "x", "x", never), never) is None
