"""The studio: what its pages let in, that every page stands, and how a project begins."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient
from PIL import Image

from conftest import Run
from seewhy.check.domain import check_domain
from seewhy.data.dataset import Dataset
from seewhy.data.thing_scene import thing_scene
from seewhy.dialogue.things.answering import ThingAnswerer
from seewhy.domain.domain import load_domain
from seewhy.studio import incoming
from seewhy.studio.access import AccessRules
from seewhy.studio.pages import PAGES
from seewhy.studio.project import Project
from seewhy.studio.site import site
from studio_builder import FRUIT, RULES, csrf_of, embed, pictures, with_domain


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return pictures(tmp_path / "fruit")


@pytest.fixture
def client(folder: Path) -> Iterator[TestClient]:
    with TestClient(site(Project(with_domain(folder)), rules=RULES, embed=embed)) as client:
        yield client


@pytest.fixture
def new_client(folder: Path) -> Iterator[TestClient]:
    """Of a project without a domain."""
    with TestClient(site(Project(folder), rules=RULES, embed=embed)) as client:
        yield client


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
    sent = client.post("/settings", data={"who": "x" * 500_000})
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


def test_without_the_extra_the_remedy_is_said(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "fastapi", None)
    for name in [name for name in __import__("sys").modules if name.startswith("seewhy.studio")]:
        monkeypatch.delitem(__import__("sys").modules, name)
    refused = run("studio", "anywhere", "--no-browser")
    assert refused.code == 2
    assert "pip install 'seewhy[studio]'" in refused.err


def test_no_route_is_made_ready_by_a_request(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """FastAPI silences warnings while it does, and one thread ends what another begins so."""

    def late(**_: object) -> None:
        pytest.fail("a request makes a route ready")

    monkeypatch.setattr("fastapi.routing.get_dependant", late)
    for path in ("/begin", "/label", "/nowhere"):
        client.get(path)


def test_a_machine_wide_address_needs_a_name(run: Run, tmp_path: Path) -> None:
    refused = run("studio", tmp_path / "new", "--host", "0.0.0.0", "--no-browser")
    assert refused.code == 2
    assert "--allow-host" in refused.err


# Begin -----------------------------------------------------------------------------------------


def png(colour: str = "red") -> bytes:
    stream = io.BytesIO()
    Image.new("RGB", (20, 20), colour).save(stream, "PNG")
    return stream.getvalue()


def send(client: TestClient, *files: tuple[str, bytes]) -> str:
    answered = client.post(
        "/begin/pictures",
        data={"csrf": csrf_of(client)},
        files=[("files", (name, content)) for name, content in files],
    )
    assert answered.status_code == 200
    return answered.text


def test_pictures_are_sent(new_client: TestClient, folder: Path) -> None:
    text = send(new_client, ("photos/a.png", png("red")), ("b.png", png("blue")))
    assert "2 pictures came" in text
    assert (folder / "images/photos/a.png").read_bytes() == png("red")
    assert "8</strong> pictures" in text


def test_the_same_picture_twice_is_one_and_another_of_its_name_is_kept(
    new_client: TestClient, folder: Path
) -> None:
    send(new_client, ("a.png", png("red")))
    send(new_client, ("a.png", png("red")), ("a.png", png("blue")))
    assert (folder / "images/a.png").read_bytes() == png("red")
    assert (folder / "images/a-2.png").read_bytes() == png("blue")
    assert len(list((folder / "images").iterdir())) == 2


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("page.html", b"<script>alert(1)</script>", "no picture by its name"),
        ("a.png", b"<script>alert(1)</script>", "not a picture of a known type"),
        ("a.jpg", b"%!PS-Adobe-3.0 EPSF-3.0", "is PostScript"),
        ("a.png", b"", "is empty"),
        (".htaccess", b"deny", "no picture by its name"),
    ],
)
def test_what_is_no_picture_is_refused_and_kept_nowhere(
    new_client: TestClient, folder: Path, name: str, content: bytes, said: str
) -> None:
    before = sorted(folder.rglob("*"))
    assert said in send(new_client, (name, content))
    assert [p for p in sorted(folder.rglob("*")) if p not in before and p.is_file()] == []


@pytest.mark.parametrize("name", ["../../a.png", "/etc/a.png", "..\\..\\a.png", "C:\\a.png"])
def test_no_name_leads_out_of_the_project(new_client: TestClient, folder: Path, name: str) -> None:
    above = set(folder.parent.rglob("*"))
    send(new_client, (name, png()))
    new = {path for path in folder.parent.rglob("*") if path not in above and path.is_file()}
    assert new
    assert all(path.is_relative_to(folder / "images") for path in new)


def test_a_picture_that_is_too_large(
    new_client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(incoming, "LARGEST", 50)
    assert "more than 50 bytes" in send(new_client, ("a.png", png()))


def test_names_become_a_domain(new_client: TestClient, folder: Path) -> None:
    asked = {
        "csrf": csrf_of(new_client),
        "classes": "good, spoilt",
        "features": "colour: red, green\nhas spots",
        "subject": "the apple",
    }
    answered = new_client.post("/begin/names", data=asked)
    assert answered.url.path == "/label"
    (file,) = folder.glob("*/domain.toml")
    domain = load_domain(file.parent)
    check_domain(domain)
    assert list(domain.classes) == ["good", "spoilt"]
    assert {name: one.values for name, one in domain.features.items()} == {
        "colour": ("red", "green"),  # as it was typed: the keys are in this order
        "has_spots": ("yes", "no"),
    }


def test_names_of_things_become_a_domain(new_client: TestClient, folder: Path) -> None:
    asked = {
        "csrf": csrf_of(new_client),
        "subject": "the table",
        "thing": "Playing card",
        "of_things": "number: one, two, three\nhas spots\nbent",
        "most": "4",
    }
    answered = new_client.post("/begin/names", data=asked)
    assert answered.url.path == "/label"
    (file,) = folder.glob("*/domain.toml")
    domain = load_domain(file.parent)
    check_domain(domain)
    assert (dict(domain.classes), dict(domain.features)) == ({}, {})
    things = domain.things
    assert things is not None
    assert (things.one, things.many, things.most) == ("playing card", "playing cards", 4)
    assert {name: one.values for name, one in things.features.items()} == {
        "number": ("one", "two", "three"),
        "has_spots": ("yes", "no"),
        "bent": ("yes", "no"),
    }
    assert list(things.relations) == ["left", "right", "above", "below"]
    replies = ThingAnswerer(things)
    card = {"number": "two", "has_spots": "yes", "bent": "no"}
    scene = thing_scene(things, [card], relations={})
    assert replies.answer("how many bent playing cards are there?", scene).value == 0
    assert replies.answer("is there a playing card with spots?", scene).value is True
    assert "number of a playing card" in new_client.get("/begin").text


def test_classes_and_features_beside_things(new_client: TestClient, folder: Path) -> None:
    asked = {
        "csrf": csrf_of(new_client),
        "subject": "the card",
        "classes": "sorted, mixed",
        "thing": "card",
        "of_things": "colour: red, green",
    }
    assert new_client.post("/begin/names", data=asked).url.path == "/label"
    (file,) = folder.glob("*/domain.toml")
    domain = load_domain(file.parent)
    check_domain(domain)
    assert list(domain.classes) == ["sorted", "mixed"]
    assert (
        "%% if there are at least two cards, then the card is sorted"
        in (file.parent / "knowledge.al").read_text()
    )


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"classes": "good"}, "at least two"),
        ({"classes": "good, bad", "features": "colour: red"}, "features, line 1"),
        ({"classes": "good, bad", "features": "\n: red, green"}, "features, line 2"),
        ({"classes": "good, bad", "features": "Has spots\nhas_spots"}, "named twice"),
        ({"classes": "good, bad", "table": "class,a\ngood,1\n"}, "the table of classes"),
        ({"classes": "good, bad", "features": "a: b, c", "subject": "?"}, "no word"),
        ({"of_things": "colour: red, green"}, "say what one of them is called"),
        ({"thing": "card"}, "say what there is to see of each card"),
        ({"thing": "card", "of_things": "colour: red"}, "features, line 1"),
        ({"thing": "card", "of_things": "above"}, "is what is measured between two things"),
        ({"thing": "card", "of_things": "a", "features": "A"}, "of the picture, too"),
        ({"thing": "card", "of_things": "a", "most": "99"}, "1 to 50 of them"),
        ({"thing": "card", "of_things": "a", "classes": "good"}, "at least two"),
    ],
)
def test_names_that_make_no_domain(
    new_client: TestClient, folder: Path, asked: dict[str, str], said: str
) -> None:
    answered = new_client.post("/begin/names", data={"csrf": csrf_of(new_client), **asked})
    assert answered.status_code == 422
    assert said in answered.text
    assert not list(folder.glob("*/domain.toml"))


def test_a_second_domain_is_refused(client: TestClient) -> None:
    asked = {"csrf": csrf_of(client), "classes": "a, b", "features": "c: d, e"}
    answered = client.post("/begin/names", data=asked)
    assert answered.status_code == 422
    assert "there is a domain already" in answered.text


def test_pictures_of_a_folder(new_client: TestClient, tmp_path: Path, folder: Path) -> None:
    others = tmp_path / "others"
    others.mkdir()
    (others / "x.png").write_bytes(png("blue"))
    (others / "broken.png").write_bytes(b"no picture")
    asked = {"csrf": csrf_of(new_client), "path": str(others)}
    text = new_client.post("/begin/folder", data=asked).text
    assert "1 picture came" in text
    assert "broken.png" in text
    assert (folder / "images/x.png").read_bytes() == png("blue")


def test_an_export_becomes_a_domain_and_a_dataset(tmp_path: Path) -> None:
    archive = tmp_path / "labelled.zip"
    with zipfile.ZipFile(archive, "w") as into:
        for label in ("red", "blue"):
            into.writestr(f"{label}/1.png", png(label))
    project = tmp_path / "fresh"
    with TestClient(site(Project(project), rules=RULES, embed=embed)) as client:
        asked = {"csrf": csrf_of(client), "path": str(archive)}
        assert client.post("/begin/export", data=asked).status_code == 200
    dataset = Dataset.load(project, load_domain(project / "fresh"))
    assert sorted(map(str, dataset.labels)) == ["blue", "red"]
    assert Project(project).labels().value("images/blue/1.png", "class") == "blue"


def test_an_export_joins_a_project_that_has_a_domain(client: TestClient, folder: Path) -> None:
    source = folder.parent / "more"
    for label in ("good", "spoilt"):
        (source / label).mkdir(parents=True)
        (source / label / "1.png").write_bytes(png("blue" if label == "good" else "red"))
    asked = {"csrf": csrf_of(client), "path": str(source)}
    assert client.post("/begin/export", data=asked).status_code == 200
    labels = Project(folder).labels()
    assert labels.value("images/good/1.png", "class") == "good"
    refused = client.post("/begin/export", data=asked)
    assert refused.status_code == 422
    assert "already" in refused.text


def test_a_model_is_opened_as_a_copy(model_folder: Path, tmp_path: Path) -> None:
    project = tmp_path / "fresh"
    with TestClient(site(Project(project), rules=RULES, embed=embed)) as client:
        asked = {"csrf": csrf_of(client), "path": str(model_folder)}
        assert client.post("/begin/open", data=asked).status_code == 200
    opened = Project(project)
    assert opened.has_model
    assert opened.domain().name == load_domain(model_folder / "domain").name


def test_paths_are_not_taken_from_others(folder: Path) -> None:
    rules = AccessRules(frozenset({"testserver"}), "secret", 200_000)
    with TestClient(site(Project(folder), rules=rules, embed=embed)) as client:
        client.get("/begin?token=secret")
        asked = {"csrf": csrf_of(client), "path": str(folder)}
        for path in ("/begin/folder", "/begin/export", "/begin/open"):
            refused = client.post(path, data=asked)
            assert refused.status_code == 422
            assert "not taken from others" in refused.text


def test_names_on_a_page_are_text(tmp_path: Path) -> None:
    folder = pictures(tmp_path / "fruit", 2)
    (folder / "a.png").rename(folder / "<img src=x onerror=alert(1)>.png")
    with TestClient(site(Project(with_domain(folder, FRUIT)), rules=RULES, embed=embed)) as client:
        for path in ("/begin", "/label", "/label/sheet"):
            assert "<img src=x" not in client.get(path).text
