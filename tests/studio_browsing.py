"""The studio in a real browser: served from a thread, and judged by axe-core."""

from __future__ import annotations

import importlib.util
import json
import shutil
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
import uvicorn

from seewhy.studio.access import AccessRules
from seewhy.studio.project import Project
from seewhy.studio.serving import bound_socket
from seewhy.studio.site import site
from studio_builder import embed

if TYPE_CHECKING:
    from playwright.sync_api import Page

__all__ = ["CHROMIUM", "NEEDS_CHROMIUM", "hindrances", "served"]

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
AXE = Path(__file__).parent / "axe" / "axe.min.js"

NEEDS_CHROMIUM = [
    pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium (apt install chromium)"),
    pytest.mark.skipif(
        importlib.util.find_spec("playwright") is None,
        reason="playwright is not installed (pip install 'seewhy[dev]')",
    ),
]


def served(project: Project) -> Iterator[str]:
    """Show a project from a thread; yield its address."""
    listening = bound_socket("127.0.0.1", 0)
    rules = AccessRules(frozenset({"127.0.0.1"}), "", 10_000_000)
    config = uvicorn.Config(site(project, rules=rules, embed=embed), log_level="error")
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{listening.getsockname()[1]}"
    server.should_exit = True
    thread.join(timeout=20)


def hindrances(shown: Page, width: int) -> list[str]:
    """What keeps somebody from using a page: by axe-core, and that it is too wide."""
    shown.add_script_tag(path=str(AXE))
    judged: dict[str, Any] = shown.evaluate("axe.run()")
    problems = [
        f"{problem['id']}: {json.dumps(problem['nodes'][0]['html'])}"
        for problem in judged["violations"]
    ]
    if shown.evaluate("document.documentElement.scrollWidth") > width:
        problems.append(f"wider than {width} pixels")
    return problems
