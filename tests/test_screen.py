"""What a stranger's names say to a terminal is shown, and not obeyed."""

from __future__ import annotations

import ast
import io
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conftest import Run, draw_tile, write_domain, write_tiles
from seewhy.cli import screen

OBEYED = re.compile(
    "[\\x00-\\x08\\x0b-\\x1f\\x7f-\\x9f\\u2028\\u2029\\u202a-\\u202e\\u2066-\\u2069]"
)
STYLES = re.compile(r"\x1b\[[0-9;]*m")
"""What the program itself says to a terminal: colours."""

WORDS = st.text(
    st.one_of(
        st.sampled_from("\x1b\x07\x9b\x08\r\u202e\u2067[]0;ab"),
        st.characters(codec="utf-8"),
    ),
    max_size=20,
)


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("kind", [io.StringIO, Terminal])
@given(text=WORDS)
def test_nothing_is_passed_on(kind: type[io.StringIO], text: str) -> None:
    with pytest.MonkeyPatch.context() as patch:
        streams = kind(), kind()
        patch.setattr(sys, "stdout", streams[0])
        patch.setattr(sys, "stderr", streams[1])
        patch.setenv("TERM", "xterm-256color")
        screen.say(text)
        rows = screen.table("name", text, title=text)
        screen.add_row(rows, text, text)
        screen.output().print(rows)
        for speak in (screen.remark, screen.warn, screen.complain):
            speak(text)
    written = "".join(stream.getvalue() for stream in streams)
    assert OBEYED.findall(STYLES.sub("", written)) == []
    assert streams[1].getvalue().count("\n") == 3 or kind is Terminal  # a terminal's lines end


@given(value=st.recursive(WORDS, lambda inner: st.lists(inner) | st.dictionaries(WORDS, inner)))
def test_json_is_exact(value: object) -> None:
    with pytest.MonkeyPatch.context() as patch:
        stream = io.StringIO()
        patch.setattr(sys, "stdout", stream)
        screen.print_json(value)
    assert json.loads(stream.getvalue()) == value
    assert OBEYED.findall(stream.getvalue()) == []


EVIL = "\x1b]0;mine\x07\x1b[2J\u202egnp"
SHOWN = r"\x1b]0;mine\x07\x1b[2J\u202egnp"


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    write_domain(tmp_path / "tiles")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_names_of_a_stranger(run: Run, place: Path) -> None:
    """In titles, files, values and line ends, on both streams."""
    domain = place / "tiles" / "domain.toml"
    escaped = json.dumps(f"{EVIL}\x9b")
    domain.write_text(domain.read_text().replace('"Tiles"', escaped, 1))
    result = run("check", "tiles")
    assert result.code == 0
    assert result.out.startswith(f"{SHOWN}\\x9b (tiles) in tiles\n")
    result = run("check", "tiles", "--json")
    assert json.loads(result.out)["vectors"] == 6
    assert OBEYED.findall(result.out) == []
    data = write_tiles(place / "data", count=3)
    with (data / "scenes.csv").open("a") as table:
        table.write(f"{EVIL}.png,good,red,yes\n")
    result = run("check", "tiles", "--data", "data")
    assert result.code == 2
    assert OBEYED.findall(result.err) == []
    assert result.err.count("\n") == 1
    draw_tile("red", "yes", 1).save(place / "a.png")
    (place / "a.png").rename(place / f"{EVIL}\nseewhy: all is well")
    result = run("ask", "nowhere", f"{EVIL}\nseewhy: all is well", "is it good?")
    assert (result.code, result.err.count("\n")) == (2, 1)


def test_names_of_an_archive(run: Run, place: Path) -> None:
    for name in ("cats/1", "dogs/2", f"dogs/{EVIL}\nseewhy: all is well"):
        (place / "s" / name).parent.mkdir(parents=True, exist_ok=True)
        draw_tile("red", "yes", 1).save(place / "s" / f"{name}.png", format="PNG")
    (place / "s" / f"dogs/{EVIL}\nseewhy: all is well.png").write_text("none")
    result = run("data", "import", "folder", "s", "--out", "data")
    assert result.code == 0
    assert OBEYED.findall(result.out + result.err) == []
    assert not re.search("^seewhy:", result.err, re.MULTILINE)
    assert SHOWN in result.err


# Streams that are closed -----------------------------------------------------------------------


def shell(command: str) -> subprocess.CompletedProcess[str]:
    program = f"{sys.executable} -m seewhy.cli.main"
    return subprocess.run(
        ["bash", "-c", command.replace("seewhy", program, 1)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ},
    )


@pytest.mark.usefixtures("place")
def test_standard_output_is_closed() -> None:
    found = shell("seewhy check tiles >&-")
    assert (found.returncode, found.stdout) == (2, "")
    assert found.stderr == (
        "seewhy: standard output is closed; send it to a file, or to /dev/null\n"
    )


@pytest.mark.usefixtures("place")
@pytest.mark.parametrize(
    ("command", "code"),
    [
        ("seewhy check tiles 2>&- <&-", 0),
        ("seewhy check tiles >&- 2>&-", 2),
        ("seewhy check nowhere 2>&-", 2),
    ],
)
def test_other_streams_are_closed(command: str, code: int) -> None:
    found = shell(command)
    assert (found.returncode, found.stderr) == (code, "")


@pytest.mark.usefixtures("place")
@pytest.mark.parametrize("command", ["reference", "check tiles", "check nowhere 2>&1", "--help"])
def test_nobody_reads(command: str) -> None:
    found = shell(f"seewhy {command} | true")
    assert found.stderr == ""


def test_only_commands_print() -> None:
    package = Path(screen.__file__).parents[1]
    for file in package.rglob("*.py"):
        if file.is_relative_to(package / "cli"):
            continue
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                into = {keyword.arg for keyword in node.keywords}
                assert node.func.id != "print" or "file" in into, f"{file}:{node.lineno}"
