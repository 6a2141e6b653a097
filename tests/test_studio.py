"""The studio: what its pages let in, and that every page stands."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from fastapi.testclient import TestClient
from PIL import Image

from conftest import Run
from seewhy.domain.domain import Domain
from seewhy.new_domain.from_names import NamedDomain, domain_from_names
from seewhy.perception.picture import read_picture
from seewhy.studio.access import AccessRules
from seewhy.studio.pages import PAGES
from seewhy.studio.project import Project
from seewhy.studio.site import site

RULES = AccessRules(frozenset({"testserver"}), "", 200_000)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "fruit"
    folder.mkdir()
    for name, colour in (("a.png", "red"), ("b.png", "green"), ("c.png", "red")):
        Image.new("RGB", (40, 30), colour).save(folder / name)
    return folder


def embed(files: Sequence[Path], _: Domain) -> npt.NDArray[np.floating]:
    """The mean colour of a picture, instead of what a backbone sees."""
    return np.stack([read_picture(file, size=8).mean(axis=(0, 1)) for file in files])


@pytest.fixture
def client(folder: Path) -> Iterator[TestClient]:
    domain_from_names(
        NamedDomain(("good", "spoilt"), {"colour": ("red", "green"), "round": ("yes", "no")}),
        folder / "fruit",
        data=str(folder),
    )
    with TestClient(site(Project(folder), rules=RULES, embed=embed)) as client:
        yield client


@pytest.fixture
def new_client(folder: Path) -> Iterator[TestClient]:
    """Of a project without a domain."""
    with TestClient(site(Project(folder), rules=RULES, embed=embed)) as client:
        yield client


def csrf_of(client: TestClient) -> str:
    found = re.search(r'name="csrf" value="([0-9a-f]+)"', client.get("/begin").text)
    assert found
    return found[1]


# What is let in --------------------------------------------------------------------------------


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.title)
def test_every_page_stands(client: TestClient, page: object) -> None:
    shown = client.get(page.path)  # type: ignore[attr-defined]
    assert shown.status_code == 200
    assert f'<a href="{page.path}" aria-current="page">' in shown.text  # type: ignore[attr-defined]
    assert "<h1" in shown.text


def test_nothing_inline_and_nothing_from_elsewhere(client: TestClient) -> None:
    for page in PAGES:
        shown = client.get(page.path)
        policy = shown.headers["Content-Security-Policy"]
        assert "script-src 'self';" in policy
        assert "unsafe" not in policy
        assert not re.search(r"<script(?![^>]*\bsrc=\"/static/)", shown.text)
        assert not re.search(r"\s(style|on[a-z]+)=\"", shown.text)
        assert not re.search(r"(src|href)=\"(https?:)?//", shown.text)


def test_a_form_of_another_page_is_refused(client: TestClient) -> None:
    asked = {"theme": "dark", "back": "/begin"}
    assert client.post("/settings", data=asked).status_code == 403
    assert client.post("/settings", data={**asked, "csrf": "0" * 64}).status_code == 403
    kept = client.post("/settings", data={**asked, "csrf": csrf_of(client)}, follow_redirects=False)
    assert kept.status_code == 303
    assert 'data-theme="dark"' in client.get("/begin").text


def test_a_form_of_another_session_is_refused(folder: Path) -> None:
    app = site(Project(folder), rules=RULES)
    one, other = TestClient(app), TestClient(app)
    asked = {"theme": "dark", "csrf": csrf_of(one)}
    assert csrf_of(other) != csrf_of(one)
    assert other.post("/settings", data=asked).status_code == 403


def test_after_settings_no_other_site_is_shown(client: TestClient) -> None:
    asked = {"theme": "dark", "csrf": csrf_of(client), "back": "https://example.org/"}
    kept = client.post("/settings", data=asked, follow_redirects=False)
    assert kept.headers["location"] == "/"


def test_hosts_and_origins(client: TestClient) -> None:
    assert client.get("/begin", headers={"host": "evil.example"}).status_code == 403
    refused = client.get("/begin", headers={"origin": "https://evil.example"})
    assert refused.status_code == 403
    assert client.get("/begin", headers={"origin": "http://testserver"}).status_code == 200


def test_the_token(folder: Path) -> None:
    rules = AccessRules(frozenset({"testserver"}), "secret", 200_000)
    client = TestClient(site(Project(folder), rules=rules))
    assert client.get("/begin").status_code == 401
    assert client.get("/begin?token=wrong").status_code == 401
    shown = client.get("/begin?token=secret")
    assert shown.status_code == 200
    assert "token" not in str(shown.url)
    assert client.get("/label").status_code == 200


def test_more_than_a_request_may_hold(client: TestClient) -> None:
    sent = client.post("/settings", data={"who": "x" * 300_000})
    assert sent.status_code == 413


@pytest.mark.parametrize(
    "name", ["../secret.png", "%2e%2e/secret.png", "/etc/passwd", "link.png", "studio.sqlite"]
)
def test_no_picture_but_the_project_s(client: TestClient, folder: Path, name: str) -> None:
    outside = folder.parent / "secret.png"
    Image.new("RGB", (20, 20), "blue").save(outside)
    (folder / "link.png").symlink_to(outside)
    assert client.get(f"/picture/{name}").status_code in (403, 404)


def test_a_picture_is_drawn_anew(client: TestClient, folder: Path) -> None:
    shown = client.get("/picture/a.png?side=160")
    assert shown.status_code == 200
    assert shown.headers["content-type"] == "image/jpeg"
    (folder / "a.png").write_bytes(b"<html><script>alert(1)</script>")
    refused = client.get("/picture/a.png?side=160")
    assert refused.status_code == 422
    assert "alert(1)" not in refused.text


def test_a_model_is_no_project(run: Run, tmp_path: Path) -> None:
    (tmp_path / "model.json").write_text("{}")
    refused = run("studio", tmp_path, "--no-browser", "--port", "0")
    assert refused.code == 2
    assert "seewhy studio NAME" in refused.err
