"""What is published: the wheel holds all that users need and no laboratory, the sdist the rest."""

from __future__ import annotations

import re
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

import seewhy
from distribution_builder import ROOT, build

PACKAGES = ROOT / "src"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build(ROOT, "wheel", tmp_path_factory.mktemp("wheel"))


def files_of(package: str) -> set[str]:
    """The files of a package in the checkout, but for what Python leaves there."""
    return {
        str(path.relative_to(PACKAGES))
        for path in (PACKAGES / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def test_the_wheel_holds_the_package_and_no_laboratory(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
    assert names == files_of("seewhy")
    assert {
        "seewhy/py.typed",
        "seewhy/dialogue/answers.toml",
        "seewhy/dialogue/grammar.toml",
        "seewhy/new_domain/template/domain.toml",
        "seewhy/new_domain/words.toml",
        "seewhy/report/report.html",
        "seewhy/domains/traffic_signs/classes.csv",
    } <= names


def test_bundled_folders_are_text_only() -> None:
    endings = {Path(name).suffix for name in files_of("seewhy/domains")}
    assert endings == {".al", ".csv", ".json", ".toml"}


def test_the_wheel_needs_neither_simulator_nor_environment(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        (metadata,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
        text = archive.read(metadata).decode()
    assert f"\nVersion: {seewhy.__version__}\n" in text
    needed = set(re.findall(r"^Requires-Dist: ([\w-]+)[^;\n]*$", text, flags=re.MULTILINE))
    assert {"clingo", "torch", "typer"} <= needed
    assert needed.isdisjoint({"gymnasium", "mujoco-core", "pandas", "ray"})
    extras = set(re.findall(r"^Provides-Extra: (\S+)$", text, flags=re.MULTILINE))
    assert extras >= {"lab", "studio", "ray", "benchmarks", "docs", "dev", "tables", "backbones"}


def test_what_only_the_laboratory_imports_is_its_extra() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lab = {re.split("[><=]", line)[0] for line in project["optional-dependencies"]["lab"]}
    assert lab == {"gymnasium", "mujoco-core"}
    imported = re.compile(
        r"^\s*(?:from|import) (?:gymnasium|mujoco|ray|seewhy_lab)\b", re.MULTILINE
    )
    for file in (PACKAGES / "seewhy").rglob("*.py"):
        assert not imported.search(file.read_text(encoding="utf-8")), file


def test_the_laboratory_is_a_wheel_of_its_own(tmp_path: Path) -> None:
    with zipfile.ZipFile(build(ROOT / "lab", "wheel", tmp_path)) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
        (metadata,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
        text = archive.read(metadata).decode()
    assert names == files_of("seewhy_lab") | {"seewhy_lab/LICENSE"}
    assert "Requires-Dist: seewhy[lab]" in text
    assert f"\nVersion: {seewhy.__version__}\n" in text


def test_the_sdist_builds_the_same_wheel_and_holds_the_tests(wheel: Path, tmp_path: Path) -> None:
    with tarfile.open(build(ROOT, "sdist", tmp_path / "sdist")) as archive:
        archive.extractall(tmp_path / "unpacked", filter="data")
    (unpacked,) = (tmp_path / "unpacked").iterdir()
    for needed in (
        *("Makefile", "constraints.txt", "LICENSE", "SECURITY.md", ".ci/run", "lab/pyproject.toml"),
        *(
            "tests/conftest.py",
            "tests/test_distribution.py",
            "tests/questions",
            "tests/fuzz/run.py",
        ),
        *("src/seewhy_lab/__init__.py", "benchmarks/wide_knowledge.py", "docs/data.md", "results"),
    ):
        assert (unpacked / needed).exists(), needed
    again = build(unpacked, "wheel", tmp_path / "again")
    with zipfile.ZipFile(wheel) as one, zipfile.ZipFile(again) as other:
        assert sorted(one.namelist()) == sorted(other.namelist())
