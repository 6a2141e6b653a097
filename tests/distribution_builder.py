"""Builds distributions of the checkout; tests that ask for one are skipped without hatchling."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("hatchling", reason="builds wheels; pip install '.[dev]' brings it")

ROOT = Path(__file__).parents[1]


def build(project: Path, target: str, out: Path) -> Path:
    """Build a distribution of a project as pip and build do, without fetching anything."""
    done = subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "--target", target, "--directory", str(out)],
        cwd=project,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    (built,) = out.iterdir()
    return built
