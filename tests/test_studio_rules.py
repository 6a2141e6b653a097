"""Rules: written, checked, made by example, accepted as learned; each can be taken back."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from conftest import KNOWLEDGE
from seewhy.studio.writing import digest_of_text
from studio_tiles import HTMX, csrf_of, keys_of, studio_of, text_of, tiles_project


@pytest.fixture
def folder(tmp_path: Path, tiles_data: Path, tiles_folder: Path) -> Path:
    """Without a model: rules need none."""
    return tiles_project(tmp_path / "project", data=tiles_data, domain=tiles_folder, model=None)


@pytest.fixture
def client(folder: Path) -> Iterator[TestClient]:
    with studio_of(folder) as client:
        yield client


def knowledge_of(folder: Path) -> str:
    return (folder / "tiles" / "knowledge.al").read_text()


def post(client: TestClient, address: str, said: dict[str, object], status: int = 200) -> str:
    answered = client.post(address, data={**said, "csrf": csrf_of(client)}, headers=HTMX)
    assert answered.status_code == status, answered.text
    return answered.text


# As written ------------------------------------------------------------------------------------


def test_each_rule_has_its_support_and_its_exceptions(client: TestClient) -> None:
    said = text_of(client.get("/rules").text)
    assert "28 of 60 labelled pictures are decided rightly by the rules." in said
    assert "2 decided wrongly" in said
    assert "30 that no rule decides" in said
    assert "a red tile is good line 8 good(T) if colour(T, red)." in said
    assert "18 pictures speak for it 2 exceptions" in said
    assert "10 pictures speak for it" in said
    assert 'href="/label?picture=images/006.png"' in client.get("/rules").text


def test_what_is_typed_is_checked_and_nothing_is_kept(client: TestClient, folder: Path) -> None:
    shown = post(client, "/rules/check", {"text": KNOWLEDGE.replace("colour(T, red)", "hue(T)")})
    assert "knowledge.al:8:16" in shown
    assert 'data-line="8" data-column="16"' in shown
    misspelt = KNOWLEDGE.replace("colour(T, red)", "colur(T, red)")
    shown = post(client, "/rules/check", {"text": misspelt})
    assert "did you mean &#39;colour&#39;" in shown
    both = KNOWLEDGE + "-good(T) if round(T).\n"
    shown = text_of(post(client, "/rules/check", {"text": both}))
    assert "10 on which rules contradict each other" in shown
    assert knowledge_of(folder) == KNOWLEDGE


def test_rules_are_kept_and_each_edit_is_taken_back_by_itself(
    client: TestClient, folder: Path
) -> None:
    one = KNOWLEDGE.replace("a red tile is good", "red is good")
    post(client, "/rules/save", {"text": one, "base": digest_of_text(KNOWLEDGE)})
    assert knowledge_of(folder) == one
    two = one + "\n%% green with corners is bad\n-good(T) if colour(T, green), not round(T).\n"
    post(client, "/rules/save", {"text": two.replace("\n", "\r\n"), "base": digest_of_text(one)})
    assert knowledge_of(folder) == two
    first, second = (
        number
        for number, said in re.findall(
            r'<span class="soft small">(\d+)</span> ([^<]*)', client.get("/label/history").text
        )[::-1]
        if "knowledge.al: edited" in said
    )
    client.post("/label/take-back", data={"number": first, "csrf": csrf_of(client)})
    assert knowledge_of(folder) == two.replace("red is good", "a red tile is good")
    client.post("/label/take-back", data={"number": second, "csrf": csrf_of(client)})
    assert knowledge_of(folder) == KNOWLEDGE


def test_what_later_rules_build_on_is_not_taken_back(client: TestClient, folder: Path) -> None:
    one = KNOWLEDGE + "\n#static old(tile).\n"
    post(client, "/rules/save", {"text": one, "base": digest_of_text(KNOWLEDGE)})
    two = one + "\nold(T) if colour(T, red).\n"
    post(client, "/rules/save", {"text": two, "base": digest_of_text(one)})
    number = re.findall(r'name="number" value="(\d+)"', client.get("/label/history").text)[1]
    refused = client.post("/label/take-back", data={"number": number, "csrf": csrf_of(client)})
    assert refused.status_code == 422
    assert f"entry {number} cannot be taken back" in refused.text
    assert knowledge_of(folder) == two


def test_wrong_or_outdated_rules_are_not_kept(client: TestClient, folder: Path) -> None:
    wrong = KNOWLEDGE.replace("colour(T, red)", "colour(T, pink)")
    shown = post(client, "/rules/save", {"text": wrong, "base": digest_of_text(KNOWLEDGE)}, 422)
    assert "knowledge.al:8" in shown
    assert "colour(T, pink)" in shown  # what was typed is not lost
    shown = post(client, "/rules/save", {"text": KNOWLEDGE + "\n", "base": "0"}, 422)
    assert "changed since this page was loaded" in shown
    assert knowledge_of(folder) == KNOWLEDGE


def test_without_a_domain(tmp_path: Path) -> None:
    with studio_of(tmp_path / "new") as client:
        assert "There is no domain yet" in client.get("/rules").text
        assert "there is no domain yet" in post(client, "/rules/check", {"text": ""}, 422)


# By example ------------------------------------------------------------------------------------


def test_a_rule_by_example(client: TestClient, folder: Path) -> None:
    assert 'value="images/002.png"' in client.get("/rules/example?of=good").text
    green_and_round = ["images/002.png", "images/009.png"]
    shown = post(client, "/rules/example", {"picture": green_and_round, "label": "good"})
    said = text_of(shown)
    assert "if the tile is round, then it is good" in said
    assert "good(S) if round(S)." in said
    assert "Pictures that it rests on: 2" in said
    assert "that are left open now would be right" in said
    taken = post(client, "/rules/take", {"key": keys_of(shown)[0]})
    assert "kept as entry" in taken
    assert "good(S) if round(S)." in knowledge_of(folder)


def test_a_rule_by_conditions(client: TestClient) -> None:
    chosen = {"shows": ["colour=green", "round=no"], "label": "bad"}
    said = text_of(post(client, "/rules/example", chosen))
    assert "-good(S) if colour(S, green), -round(S)." in said
    assert "that are left open now would be right" in said


@pytest.mark.parametrize(
    ("address", "chosen", "said"),
    [
        ("/rules/example", {"label": "fine"}, "'fine' is no class"),
        ("/rules/example", {"label": "good"}, "nothing is chosen"),
        ("/rules/example", {"label": "good", "picture": "a.png"}, "a.png has no class yet"),
        ("/rules/example", {"label": "good", "shows": "colour=pink"}, "is no value of a feature"),
        ("/rules/example", {"label": "good", "shows": "colour"}, "gives no value"),
        ("/rules/example", {"label": "good", "shows": "colour=red"}, "known already"),
        ("/rules/example", {"label": "bad", "picture": "images/000.png"}, "have in common"),
        ("/rules/take", {"key": "f" * 20}, "look at it again"),
    ],
)
def test_bad_input(client: TestClient, address: str, chosen: dict[str, str], said: str) -> None:
    assert client.post(address, data=chosen).status_code == 403
    refused = client.post(address, data={**chosen, "csrf": csrf_of(client)}, headers=HTMX)
    assert refused.status_code == 422
    assert said in html.unescape(refused.text)


# Learned ---------------------------------------------------------------------------------------


def test_learned_rules_are_accepted_with_what_they_rest_on(
    client: TestClient, folder: Path
) -> None:
    shown = client.get("/rules/learned", headers=HTMX).text
    said = text_of(shown)
    assert "Pictures that it rests on:" in said
    assert "Of 60 annotated pictures," in said
    before = knowledge_of(folder)
    post(client, "/rules/take", {"key": keys_of(shown)[0]})
    assert knowledge_of(folder).startswith(before)
    assert len(knowledge_of(folder)) > len(before)


def test_more_than_knowledge_may_hold(client: TestClient) -> None:
    shown = post(client, "/rules/check", {"text": "x" * 200_001}, 422)
    assert "at most 200000" in shown
