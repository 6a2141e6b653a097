"""Datasets that a domain's own source makes: in parallel, resumably, the same every time."""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

import pytest
from joblib.externals.loky import get_reusable_executor

from conftest import DOMAIN, Run, write_domain
from seewhy.data import picture_source
from seewhy.data.dataset import Dataset
from seewhy.data.making import determined_share, make_dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DatasetError, DomainError

SOURCE = """\
import os
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent


def draw(*, seed, index, size):
    if (HERE / f"stop_{index}").exists():
        raise KeyboardInterrupt
    with (HERE / "drawn.txt").open("a") as log:
        log.write(f"{index}\\n")
    rng = np.random.default_rng([seed, index])
    hue = ["red", "green", "blue"][index % 3]
    pixels = rng.integers(0, 60, (size, size, 3), dtype=np.uint8)
    pixels[..., index % 3] += 150
    features = {"colour": hue, "round": ["yes", "no"][index % 2]}
    return pixels, features, "bad" if hue == "blue" and index % 2 else "good"
"""


@pytest.fixture
def domain(tmp_path: Path) -> Domain:
    named = DOMAIN.replace("subject =", 'source = "pictures.py"\nsubject =')
    folder = write_domain(tmp_path / "domain" / "tiles", domain=named)
    (folder / "pictures.py").write_text(SOURCE)
    return load_domain(folder)


@pytest.fixture
def source(domain: Domain) -> Path:
    """The file that makes the pictures of the domain."""
    return domain.folder / "pictures.py"


def drawn(source: Path) -> list[int]:
    return [int(line) for line in (source.parent / "drawn.txt").read_text().split()]


def contents(folder: Path) -> dict[str, bytes]:
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def test_what_is_made(domain: Domain, tmp_path: Path) -> None:
    done: list[int] = []
    made = make_dataset(
        domain, tmp_path / "out", count=6, size=16, workers=1, on_progress=done.append
    )
    assert done == [1, 2, 3, 4, 5, 6]
    assert (made.count, made.classes, made.determined) == (6, {"good": 5 / 6, "bad": 1 / 6}, 1.0)
    assert (tmp_path / "out" / "scenes.csv").read_text() == (
        "image,class,colour,round,split\n"
        "images/000000.png,good,red,yes,train\n"
        "images/000001.png,good,green,no,train\n"
        "images/000002.png,good,blue,yes,test\n"
        "images/000003.png,good,red,no,train\n"
        "images/000004.png,good,green,yes,train\n"
        "images/000005.png,bad,blue,no,test\n"
    )
    assert len(Dataset.load(tmp_path / "out", domain)) == 6
    assert sorted(contents(tmp_path / "out")) == [
        *(f"images/{n:06d}.png" for n in range(6)),
        "made.json",
        "scenes.csv",
    ]


def test_the_same_bytes_for_any_number_of_workers(domain: Domain, tmp_path: Path) -> None:
    make_dataset(domain, tmp_path / "one", count=12, size=16, seed=5, workers=1)
    # Processes that other tests have left would not find the module of this test.
    get_reusable_executor().shutdown()
    make_dataset(domain, tmp_path / "two", count=12, size=16, seed=5, workers=2)
    assert contents(tmp_path / "one") == contents(tmp_path / "two")
    make_dataset(domain, tmp_path / "other", count=12, size=16, seed=6, workers=1)
    assert contents(tmp_path / "one") != contents(tmp_path / "other")


def test_an_interrupted_call_goes_on_where_it_was(
    domain: Domain, source: Path, tmp_path: Path
) -> None:
    make_dataset(domain, tmp_path / "whole", count=8, size=16, workers=1)
    (source.parent / "drawn.txt").unlink()
    stop = source.parent / "stop_5"
    stop.touch()
    with pytest.raises(KeyboardInterrupt):
        make_dataset(domain, tmp_path / "out", count=8, size=16, workers=1)
    assert drawn(source) == [0, 1, 2, 3, 4]
    stop.unlink()
    make_dataset(domain, tmp_path / "out", count=8, size=16, workers=1)
    assert drawn(source) == [0, 1, 2, 3, 4, 5, 6, 7]
    assert contents(tmp_path / "out") == contents(tmp_path / "whole")


def test_a_dataset_grows(domain: Domain, source: Path, tmp_path: Path) -> None:
    make_dataset(domain, tmp_path / "out", count=4, size=16, workers=1)
    before = contents(tmp_path / "out")
    made = make_dataset(domain, tmp_path / "out", count=7, size=16, workers=1)
    assert made.count == 7
    assert drawn(source) == [0, 1, 2, 3, 4, 5, 6]
    after = contents(tmp_path / "out")
    pictures = [name for name in before if name.startswith("images/")]
    assert all(after[name] == before[name] for name in pictures)


def test_a_lost_picture_is_drawn_again(domain: Domain, source: Path, tmp_path: Path) -> None:
    make_dataset(domain, tmp_path / "out", count=4, size=16, workers=1)
    before = contents(tmp_path / "out")
    (tmp_path / "out" / "images" / "000002.png").unlink()
    make_dataset(domain, tmp_path / "out", count=4, size=16, workers=1)
    assert drawn(source) == [0, 1, 2, 3, 2]
    assert contents(tmp_path / "out") == before


def test_other_settings_need_another_folder(domain: Domain, tmp_path: Path) -> None:
    out = tmp_path / "out"
    make_dataset(domain, out, count=2, size=16, workers=1)
    before = contents(out)
    for change in ({"seed": 1}, {"size": 17}):
        with pytest.raises(DatasetError) as problem:
            make_dataset(domain, out, count=2, workers=1, **{"size": 16, **change})
        assert str(problem.value) == (
            f'{out}: holds pictures made with other settings ({{"domain": "tiles", "seed": 0, '
            '"size": 16}); choose another folder or delete this one'
        )
    assert contents(out) == before


def test_a_damaged_note_of_the_settings(domain: Domain, tmp_path: Path) -> None:
    out = tmp_path / "out"
    make_dataset(domain, out, count=2, size=16, workers=1)
    (out / "made.json").write_bytes(b'{"domain": \xff')
    with pytest.raises(DatasetError, match="holds pictures made with other settings"):
        make_dataset(domain, out, count=2, size=16, workers=1)


@pytest.mark.parametrize("table", ["image,class\nfirst.png,good\n", "number\n3\n"])
def test_a_table_that_was_edited(domain: Domain, tmp_path: Path, table: str) -> None:
    out = tmp_path / "out"
    make_dataset(domain, out, count=2, size=16, workers=1)
    (out / "scenes.csv").write_text(table)
    with pytest.raises(DatasetError) as problem:
        make_dataset(domain, out, count=2, size=16, workers=1)
    assert str(problem.value) == (
        f"{out}/scenes.csv: is not as it was made; delete it and the pictures are annotated "
        "again, or choose another folder"
    )


def test_a_dataset_that_was_not_made_here_is_left_alone(
    domain: Domain, fresh_data: Path, source: Path
) -> None:
    before = contents(fresh_data)
    with pytest.raises(DatasetError) as problem:
        make_dataset(domain, fresh_data, count=2, size=16, workers=1)
    assert str(problem.value) == (
        f"{fresh_data}: holds a dataset that was not made here; choose another folder"
    )
    assert contents(fresh_data) == before
    assert not (source.parent / "drawn.txt").exists()


def test_a_domain_without_a_source(tiles: Domain, tmp_path: Path) -> None:
    with pytest.raises(DomainError) as problem:
        make_dataset(tiles, tmp_path / "out", count=2)
    assert str(problem.value) == (
        "the domain 'tiles' has no source of pictures; put your own pictures beside a "
        "scenes.csv, or name a file with a function draw as 'source' in "
        f"{tiles.folder}/domain.toml"
    )
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("source", "text", "why"),
    [
        ("seewhy.domains.no_such_module", None, "there is no such module"),
        ("seewhy.domain.tables.deeper", None, "there is no such module"),
        ("seewhy.files.whole_files", None, "it has no function draw"),
        ("pictures.py", None, "No such file or directory"),
        ("pictures.py", "def paint(): pass\n", "it has no function draw"),
        ("pictures.py", "def draw(:\n", "line 1: invalid syntax"),
        ("pictures.py", "def draw(*, seed, index, size): ...\n", None),
        ("pictures.py", "from paint import tile as draw\n", None),
        ("pictures.py", "try:\n    from paint import *\nexcept ImportError:\n    pass\n", None),
        ("pictures.py", "paint = draw = print\n", None),
        ("seewhy_lab.simulators.structure_stability.source", None, None),
    ],
)
def test_check_reads_a_source_and_runs_nothing_of_it(
    run: Run, tmp_path: Path, source: str, text: str | None, why: str | None
) -> None:
    named = DOMAIN.replace("subject =", f'source = "{source}"\nsubject =')
    folder = write_domain(tmp_path / "tiles", domain=named)
    if text is not None:
        (folder / "pictures.py").write_text(f"{text}\nopen('{tmp_path}/was_run', 'w')\n")
    result = run("check", folder)
    said = (
        f"seewhy: {folder}/domain.toml: source = '{source}' must be a file of this folder that has "
        f"a function draw(seed=, index=, size=) ({why})\n"
    )
    assert (result.code, result.err) == ((0, "") if why is None else (2, said))
    assert not (tmp_path / "was_run").exists()


@pytest.mark.parametrize(
    "source",
    ["../pictures.py", "/pictures.py", "link.py", "json", "pictures", "pictures.pyc", "seewhy", ""],
)
@pytest.mark.parametrize("command", ["check", "data make"])
def test_a_source_outside_of_its_folder_is_refused(
    run: Run, tmp_path: Path, source: str, command: str
) -> None:
    named = DOMAIN.replace("subject =", f'source = "{source}"\nsubject =')
    folder = write_domain(tmp_path / "tiles", domain=named)
    (tmp_path / "pictures.py").write_text(f"open('{tmp_path}/was_run', 'w')\n")
    (folder / "link.py").symlink_to(tmp_path / "pictures.py")
    options = ("--out", tmp_path / "out") if command == "data make" else ()
    result = run(*command.split(), folder, *options)
    assert (result.code, result.err) == (
        2,
        f"seewhy: {folder}/domain.toml:5: source = '{source}' must be a file of this folder, such "
        'as "pictures.py": what lies elsewhere is not run\n',
    )
    assert not (tmp_path / "was_run").exists()
    assert not (tmp_path / "out").exists()


def test_who_runs_the_code_of_a_folder_is_told(run: Run, domain: Domain, tmp_path: Path) -> None:
    two = ("--count", 2, "--workers", 1)
    made = run("data", "make", domain.folder, "--out", tmp_path / "out", *two)
    assert made.err.splitlines()[0] == (
        f"{domain.folder}/pictures.py is a program, which now runs with your rights; run only "
        "those of people whom you trust"
    )
    bundled = run("data", "make", "structure_stability", "--out", tmp_path / "own", *two)
    assert "is a program" not in bundled.err


def test_a_source_in_the_domains_own_folder(tmp_path: Path) -> None:
    text = DOMAIN.replace("subject =", 'source = "drawing.py"\nsubject =')
    domain = load_domain(write_domain(tmp_path / "tiles", domain=text))
    (domain.folder / "drawing.py").write_text(
        "import numpy as np\n"
        "def draw(*, seed, index, size):\n"
        "    if index == 2:\n"
        "        raise ValueError('out of paint')\n"
        "    picture = np.full((size, size, 3), index, dtype=np.uint8)\n"
        "    return picture, {'colour': 'red', 'round': 'yes'}, 'good'\n"
    )
    assert make_dataset(domain, tmp_path / "out", count=2, workers=1).count == 2
    with pytest.raises(DomainError) as problem:
        make_dataset(domain, tmp_path / "out", count=3, workers=1)
    assert str(problem.value) == (
        f"{tmp_path}/tiles/domain.toml: the source 'drawing.py' fails at draw(seed=0, index=2, "
        "size=112): ValueError: out of paint"
    )


@pytest.mark.parametrize(
    ("old", "new", "got"),
    [
        ('"round": [', '"shape": [', "class good, features colour, shape"),
        ('"red", "green"', '"crimson", "green"', "colour = crimson"),
        ('else "good"', 'else "fine"', "class fine, features colour, round"),
    ],
)
def test_a_source_that_annotates_in_other_words(
    domain: Domain, source: Path, tmp_path: Path, old: str, new: str, got: str
) -> None:
    assert old in SOURCE
    source.write_text(SOURCE.replace(old, new))
    with pytest.raises(DomainError) as problem:
        make_dataset(domain, tmp_path / "out", count=2, size=16, workers=1)
    assert str(problem.value) == (
        f"{domain.folder}/domain.toml: the source '{source.name}' must give values of colour, "
        f"round and a class among good, bad, got {got}"
    )


def test_the_share_that_the_features_determine() -> None:
    vectors = [("a",), ("a",), ("a",), ("b",), ("b",), ("c",)]
    labels = ["x", "x", "y", "y", "x", "y"]
    assert determined_share(vectors, labels) == pytest.approx((2 + 1 + 1) / 6)
    assert determined_share(vectors[3:4], ["y"]) == 1.0


def test_structures_are_made_by_their_own_source(structures: Domain, tmp_path: Path) -> None:
    made = make_dataset(structures, tmp_path, count=6, seed=1, size=32, workers=1)
    dataset = Dataset.load(tmp_path, structures)
    assert made.count == len(dataset) == 6
    assert dataset.pictures(16).std() > 0
    assert sum(made.classes.values()) == pytest.approx(1.0)
    assert json.loads((tmp_path / "made.json").read_text()) == {
        "domain": "structure_stability",
        "seed": 1,
        "size": 32,
    }
    with (tmp_path / "scenes.csv").open() as stream:
        assert [row["split"] for row in csv.DictReader(stream)] == (["train", "train", "test"] * 2)


def test_a_laboratory_without_its_libraries_says_which(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [name for name in sys.modules if name.startswith("seewhy_lab.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "mujoco", None)
    picture_source._load.cache_clear()
    result = run("data", "make", "structure_stability", "--out", tmp_path / "out", "--count", 2)
    said = (
        "the pictures of this domain are made by the laboratory, which needs the module 'mujoco', "
        "and that is not installed; install it with pip install 'seewhy[lab]'\n"
    )
    assert result.code == 2
    assert result.err.startswith("seewhy: ")
    assert result.err.endswith(f"structure_stability/domain.toml: {said}")
    assert not (tmp_path / "out").exists()


def test_things_from_the_source_of_a_domain_that_has_none(
    domain: Domain, source: Path, tmp_path: Path
) -> None:
    old = source.read_text()
    assert "\n    return " in old
    source.write_text(old.rstrip() + ", [{'thing': 'a'}], []\n")
    with pytest.raises(DomainError) as problem:
        make_dataset(domain, tmp_path / "out", count=1, size=16, workers=1)
    assert str(problem.value) == (
        f"{domain.folder}/domain.toml: the source '{source.name}' must give no things: "
        "domain.toml has no [things], got 1 things"
    )
