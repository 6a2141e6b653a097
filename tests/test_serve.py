"""A model over HTTP: the same answers, and nobody else's."""

from __future__ import annotations

import io
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import httpx2
import pytest
from fastapi.testclient import TestClient

from conftest import Run, draw_tile
from seewhy.agent.agent import Agent
from seewhy.studio.access import AccessRules
from seewhy.studio.application import Limits, application

RULES = AccessRules(frozenset({"testserver"}), "", 200_000)


def tile(colour: str = "red", *, seed: int = 0, kind: str = "PNG") -> bytes:
    stream = io.BytesIO()
    draw_tile(colour, "yes", seed).save(stream, kind)
    return stream.getvalue()


@pytest.fixture(scope="module")
def served_agent(model_folder: Path) -> Agent:
    return Agent.load(model_folder)


@pytest.fixture
def client(served_agent: Agent) -> Iterator[TestClient]:
    with TestClient(application(served_agent, rules=RULES)) as client:
        yield client


def shown(content: bytes, name: str = "a.png") -> dict[str, tuple[str, bytes]]:
    return {"image": (name, content)}


# What is answered ------------------------------------------------------------------------------


def test_an_answer_is_that_of_the_command_line(
    client: TestClient, model_folder: Path, tmp_path: Path, run: Run
) -> None:
    picture = tmp_path / "a.png"
    picture.write_bytes(tile())
    asked = client.post("/ask", files=shown(tile()), data={"question": "why is it good?"})
    assert asked.status_code == 200
    printed = run("ask", model_folder, picture, "why is it good?", "--json")
    assert asked.json() == json.loads(printed.out)


def test_a_class_is_the_row_of_the_table(
    client: TestClient, model_folder: Path, tmp_path: Path, run: Run
) -> None:
    (tmp_path / "a.png").write_bytes(tile("blue"))
    table = tmp_path / "table.json"
    assert run("classify", model_folder, tmp_path / "a.png", "--out", table).code == 0
    (row,) = json.loads(table.read_text())
    found = client.post("/classify", files=shown(tile("blue"))).json()
    assert found.pop("image") == "a.png"
    assert row.pop("image").endswith("a.png")
    assert found == row


def test_what_if_and_why(client: TestClient, agent: Agent) -> None:
    explained = client.post("/explain", files=shown(tile())).json()
    assert explained["class"] == "good"
    assert explained["reasons"] == "The tile is red."
    assert explained["lines"][0].startswith("the tile is good")
    supposed = client.post(
        "/what-if", files=shown(tile()), data={"change": ["colour=blue", "round=no"]}
    ).json()
    then = agent.classify_values({"colour": "blue", "round": "no"})
    assert (supposed["class"], supposed["then"]) == ("good", then.label)
    assert supposed["changes"] == {"colour": "blue", "round": "no"}


def test_many_at_once_are_answered_as_one_by_one(client: TestClient) -> None:
    colours = ["red", "blue", "green"] * 12

    def classify(colour: str) -> object:
        return client.post("/classify", files=shown(tile(colour))).json()

    one_by_one = {colour: classify(colour) for colour in set(colours)}
    with ThreadPoolExecutor(12) as threads:
        found = list(threads.map(classify, colours))
    assert found == [one_by_one[colour] for colour in colours]


def test_a_damaged_picture_among_others_is_its_senders_alone(
    served_agent: Agent, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("seewhy.studio.batches.torch.get_num_threads", lambda: 2)
    sent = [b"no picture" if number % 3 == 0 else tile("blue") for number in range(36)]
    with (
        TestClient(application(served_agent, rules=RULES)) as client,
        ThreadPoolExecutor(12) as threads,
    ):
        found = list(
            threads.map(lambda content: client.post("/classify", files=shown(content)), sent)
        )
        alone = client.post("/classify", files=shown(tile("blue")))
    assert alone.status_code == 200
    for content, response in zip(sent, found, strict=True):
        if content == b"no picture":
            assert response.status_code == 422
            assert response.json()["error"].startswith("a.png is not a picture of a known type")
        else:
            assert response.json() == alone.json()


def test_health_metrics_and_the_description(client: TestClient) -> None:
    assert client.get("/health").json() == {
        "status": "ok",
        "domain": "tiles",
        "version": client.app.version,  # type: ignore[attr-defined]
    }
    client.post("/classify", files=shown(tile()))
    client.get("/nowhere")
    metrics = client.get("/metrics").text
    assert 'seewhy_requests_total{path="/classify",status="200"} 1.0' in metrics
    assert 'seewhy_requests_total{path="other",status="404"} 1.0' in metrics
    paths = client.get("/openapi.json").json()["paths"]
    assert {"/ask", "/classify", "/explain", "/what-if", "/health", "/metrics"} == set(paths)
    assert client.get("/docs").status_code == 404  # its page fetches scripts from elsewhere


# What is refused -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("content", "question", "problem"),
    [
        (b"", "why is it good?", "a.png is empty (0 bytes): send the picture itself"),
        (b"no picture", "why is it good?", "a.png is not a picture of a known type: save it as "
         "PNG or JPEG"),
        (b"%!PS-Adobe-3.0 EPSF-3.0", "why is it good?", "a.png is PostScript (EPS), a program and "
         "no picture: save it as PNG or JPEG"),
    ],
)  # fmt: skip
def test_what_is_no_picture(
    client: TestClient, content: bytes, question: str, problem: str
) -> None:
    found = client.post("/ask", files=shown(content), data={"question": question})
    assert (found.status_code, found.json()) == (422, {"error": problem})


def test_a_question_that_is_not_understood(client: TestClient) -> None:
    found = client.post("/ask", files=shown(tile()), data={"question": "who sells it?"})
    assert found.status_code == 422
    assert "who sells it" in found.json()["error"]


def test_a_change_of_no_feature(client: TestClient) -> None:
    found = client.post("/what-if", files=shown(tile()), data={"change": "color=red"})
    assert found.status_code == 422
    assert found.json() == {"error": "'color' is no feature of tiles; did you mean 'colour'?"}


def test_a_name_with_folders_is_only_a_name(client: TestClient) -> None:
    found = client.post("/classify", files=shown(tile(), "../../etc/passwd")).json()
    assert found["image"] == "passwd"


def test_parts_that_are_missing(client: TestClient) -> None:
    no_question = client.post("/ask", files=shown(tile()))
    assert (no_question.status_code, no_question.json()) == (
        422,
        {"error": "question: field required"},
    )
    assert client.post("/ask", data={"question": "why?"}).json() == {
        "error": "image: field required"
    }
    wrong = client.get("/ask")
    assert (wrong.status_code, wrong.json()) == (405, {"error": "Method Not Allowed"})
    assert client.get("/nowhere").json() == {"error": "Not Found"}


def test_more_than_a_request_may_hold(client: TestClient) -> None:
    large = client.post("/classify", files=shown(bytes(300_000)))
    assert (large.status_code, large.json()) == (
        413,
        {"error": "more than 200,000 bytes; send a smaller picture"},
    )

    def streamed() -> Iterator[bytes]:
        yield b'--x\r\nContent-Disposition: form-data; name="image"; filename="a"\r\n\r\n'
        for _ in range(40):
            yield bytes(10_000)

    kind = {"content-type": "multipart/form-data; boundary=x"}
    unannounced = client.post("/classify", content=streamed(), headers=kind)
    assert unannounced.status_code == 413


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({"host": "evil.example"}, 403),
        ({"host": "evil.example:8000"}, 403),
        ({"origin": "http://evil.example"}, 403),
        ({"origin": "null"}, 403),
        ({"origin": "http://testserver"}, 200),
    ],
)
def test_hosts_and_origins(client: TestClient, headers: dict[str, str], status: int) -> None:
    found = client.post("/classify", files=shown(tile()), headers=headers)
    assert found.status_code == status


def test_the_token(agent: Agent) -> None:
    rules = AccessRules(RULES.hosts, "secret", 200_000)
    with TestClient(application(agent, rules=rules)) as client:
        assert client.get("/health").status_code == 200
        refused = client.post("/classify", files=shown(tile()))
        assert (refused.status_code, refused.json()) == (
            401,
            {"error": "the token is missing or wrong; send 'Authorization: Bearer TOKEN'"},
        )
        for given, status in (("Bearer secre", 401), ("Bearer secret", 200), ("Bearer ü", 401)):
            headers = {"authorization": given.encode()}
            found = client.post("/classify", files=shown(tile()), headers=headers)
            assert found.status_code == status


class Slow:
    """An agent whose networks never come to an end in time."""

    def __init__(self, agent: Agent) -> None:
        self._agent = agent

    def __getattr__(self, name: str) -> object:
        return getattr(self._agent, name)

    def see(self, pictures: object) -> object:
        import time

        time.sleep(0.6)
        return self._agent.see(pictures)  # type: ignore[arg-type]


def test_time_is_bounded_and_so_is_who_waits(agent: Agent) -> None:
    slow: Agent = Slow(agent)  # type: ignore[assignment]
    with TestClient(application(slow, rules=RULES, limits=Limits(seconds=0.2))) as client:
        late = client.post("/classify", files=shown(tile()))
        assert (late.status_code, late.json()) == (
            503,
            {"error": "no answer within 0.2 seconds; try again, or raise --seconds"},
        )
        counted = 'seewhy_requests_total{path="/classify",status="503"} 1.0'
        assert counted in client.get("/metrics").text
    limits = Limits(seconds=10, waiting=1)
    with (
        TestClient(application(slow, rules=RULES, limits=limits)) as client,
        ThreadPoolExecutor(6) as threads,
    ):
        found = list(threads.map(lambda _: client.post("/classify", files=shown(tile())), range(6)))
    assert {response.status_code for response in found} == {200, 503}
    busy = next(response for response in found if response.status_code == 503)
    assert busy.json() == {"error": "1 pictures wait already; try again in some seconds"}


# The program -----------------------------------------------------------------------------------


@contextmanager
def served(model: Path, *options: str) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    command = [sys.executable, "-m", "seewhy.cli.main", "serve", str(model), "--port", "0"]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    process = subprocess.Popen(
        [*command, *options], stderr=subprocess.PIPE, text=True, env=environment
    )
    try:
        assert process.stderr is not None
        address = ""
        for line in process.stderr:
            found = re.search(r"at (http://\S+)", line)
            if found:
                address = found[1]
                break
        assert address
        yield address, process
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(30)


@pytest.mark.parametrize("workers", ["1", "2"])
def test_the_program_serves(model_folder: Path, workers: str) -> None:
    with served(model_folder, "--workers", workers) as (address, process):
        transport = httpx2.HTTPTransport(retries=40)
        with httpx2.Client(base_url=address, timeout=120, transport=transport) as client:
            found = client.post("/classify", files=shown(tile())).json()
        assert found["class"] == "good"
    assert process.returncode in (0, 130)


def test_the_program_complains(model_folder: Path, tmp_path: Path, run: Run) -> None:
    result = run("serve", tmp_path / "nowhere")
    assert (result.code, result.out) == (2, "")
    result = run("serve", model_folder, "--host", "0.0.0.0")
    assert result.code == 2
    assert "say by which name others call this machine, with --allow-host NAME" in result.err
    with served(model_folder) as (address, _):
        port = address.rpartition(":")[2]
        result = run("serve", model_folder, "--port", port)
        assert result.code == 2
        assert f"127.0.0.1:{port} cannot be served (Address already in use)" in result.err
