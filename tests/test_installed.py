"""SeeWhy as users have it: the wheel alone, without laboratory, simulator or checkout."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path
from typing import NamedTuple

import pytest

from conftest import RGB, draw_tile
from distribution_builder import ROOT, build

# What only the laboratory needs cannot be imported, whether or not it is installed here.
_LIBRARIES = """\
{libraries}
import sys; sys.modules.update(dict.fromkeys(["gymnasium", "mujoco", "ray"]))
"""


class Done(NamedTuple):
    code: int
    out: str
    err: str


class Installed(NamedTuple):
    """An environment into which only the wheel was installed; libraries are those of the tests."""

    home: Path

    def run(self, program: str, *arguments: str, within: Path) -> Done:
        environment = {
            **{key: text for key, text in os.environ.items() if not key.startswith("PYTHON")},
            "SEEWHY_CACHE": "",
            "COLUMNS": "100",
        }
        done = subprocess.run(
            [str(self.home / "bin" / program), *arguments],
            cwd=within,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        return Done(done.returncode, done.stdout, done.stderr)


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Installed:
    wheel = build(ROOT, "wheel", tmp_path_factory.mktemp("wheel"))
    home = tmp_path_factory.mktemp("installed") / "venv"
    venv.create(home)
    subprocess.run(
        [
            *(sys.executable, "-m", "pip", "--quiet", "--python", str(home), "install"),
            *("--no-deps", "--no-index", "--no-compile", str(wheel)),
        ],
        check=True,
    )
    (packages,) = home.glob("lib/python*/site-packages")
    # A path file is not searched for path files in turn: the tests' own checkout stays out.
    libraries = sysconfig.get_paths()["purelib"]
    (packages / "libraries.pth").write_text(_LIBRARIES.format(libraries=libraries))
    return Installed(home)


def test_only_the_wheel_is_there(installed: Installed, tmp_path: Path) -> None:
    code = """
from importlib.util import find_spec
from pathlib import Path
import seewhy, sys
missing = [find_spec(name) for name in ("seewhy_lab", "mujoco", "gymnasium")]
print(Path(seewhy.__file__).is_relative_to(sys.prefix), missing)
"""
    assert installed.run("python", "-c", code, within=tmp_path).out == "True [None, None, None]\n"


def test_the_version_is_that_of_the_package(installed: Installed, tmp_path: Path) -> None:
    code = "import importlib.metadata as m, seewhy; print(seewhy.__version__, m.version('seewhy'))"
    one, other = installed.run("python", "-c", code, within=tmp_path).out.split()
    assert one == other
    assert installed.run("seewhy", "--version", within=tmp_path).out == f"seewhy {one}\n"


def test_a_domain_by_hand_and_a_plan(installed: Installed, tmp_path: Path) -> None:
    made = installed.run("seewhy", "new", "apples", within=tmp_path)
    assert made.code == 0, made.err
    checked = installed.run("seewhy", "check", "apples", within=tmp_path)
    assert (checked.code, checked.out.splitlines()[-1]) == (0, "nothing is wrong")
    question = ("--ask", "why is it spoilt?")
    decided = installed.run(
        "seewhy", "decide", "apples", "colour=brown", *question, within=tmp_path
    )
    assert decided.code == 0, decided.err
    assert "a brown apple is spoilt" in decided.out
    goal = ("--goal", "make a tower of three with the red block on top")
    planned = installed.run("seewhy", "plan", "tabletop", *goal, within=tmp_path)
    assert planned.code == 0, planned.err
    assert "4 actions" in planned.out


def test_ones_own_pictures(installed: Installed, tmp_path: Path) -> None:
    for colour in RGB:
        for shape in ("disc", "square"):
            of_class = tmp_path / "pictures" / f"{colour}-{shape}"
            of_class.mkdir(parents=True)
            for maker in range(8):
                picture = draw_tile(colour, "yes" if shape == "disc" else "no", maker)
                picture.save(of_class / f"{maker}.png")
    source = ("--from", "pictures", "--class-parts", "colour-shape")
    made = installed.run("seewhy", "new", "tiles", *source, "--data", "data", within=tmp_path)
    assert made.code == 0, made.err
    # Small networks that grow learn tiles in seconds; tuning a backbone takes minutes.
    described = tmp_path / "tiles" / "domain.toml"
    with described.open("a", encoding="utf-8") as stream:
        stream.write("\n[pictures]\nsize = 16\n")
    for command in (
        ("train", "tiles", "--data", "data", "--out", "model", "--eyes", "none"),
        ("ask", "model", "pictures/red-disc/1.png", "why is it red-disc?"),
    ):
        done = installed.run("seewhy", *command, within=tmp_path)
        assert done.code == 0, (command, done.err)
    assert "\nbecause:\n" in done.out


@pytest.mark.parametrize(
    "command",
    [
        ("data", "make", "structure_stability", "--out", "out", "--count", "2"),
        ("demo", "--out", "out"),
    ],
)
def test_pictures_of_a_bundled_domain_are_the_laboratorys(
    installed: Installed, tmp_path: Path, command: tuple[str, ...]
) -> None:
    done = installed.run("seewhy", *command, within=tmp_path)
    assert done.code == 2
    (said,) = done.err.splitlines()
    assert said.startswith("seewhy: ")
    assert said.endswith(
        "structure_stability/domain.toml: the pictures of this domain are made by the laboratory "
        "(seewhy_lab), which is not installed; it comes with the source code of SeeWhy: 'pip "
        "install . ./lab' in a checkout"
    )
    assert not (tmp_path / "out").exists()


def test_the_knowledge_of_a_bundled_domain_is_checked_all_the_same(
    installed: Installed, tmp_path: Path
) -> None:
    done = installed.run("seewhy", "check", "structure_stability", within=tmp_path)
    assert done.code == 0, done.err
    assert "note: the pictures of this domain are made by the laboratory" in done.out


@pytest.mark.parametrize("command", ["experiment", "belgiumts"])
def test_a_command_of_the_laboratory_says_where_that_is(
    installed: Installed, tmp_path: Path, command: str
) -> None:
    done = installed.run("seewhy", command, "vqa", "--out", "results", within=tmp_path)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(f"seewhy: 'seewhy {command}' is a command of the laboratory")
    assert command not in installed.run("seewhy", "--help", within=tmp_path).out
