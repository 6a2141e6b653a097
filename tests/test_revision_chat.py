"""Answers are doubted in a conversation; what mends them is asked before it is taken."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from apples import KNOWLEDGE, VECTORS, apple_agent, write_apple_pictures, write_apples
from conftest import Run
from seewhy.agent.agent import Agent
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError, RevisionError
from seewhy.revision.conversation import Conversation
from seewhy.revision.remarks import Says, remark_of
from seewhy.revision.revisions import Revisions
from seewhy.revision.said import Said

Talk = Callable[..., Conversation]


@pytest.fixture
def talk(tmp_path: Path) -> Talk:
    """Begin a conversation about an apple; with ``annotated``, among annotated pictures."""

    def begin(*vector: str, annotated: bool = True) -> Conversation:
        folder = write_apples(tmp_path / "apples")
        data = write_apple_pictures(tmp_path / "data") if annotated else None
        agent = apple_agent(load_domain(folder))
        seen = dict(zip(agent.domain.features, vector, strict=True))
        picture = None if data is None else data / f"{VECTORS.index(vector):02d}.png"
        return Conversation(
            agent,
            Revisions(folder, agent=agent, dataset=data),
            look=lambda: agent.classify_values(seen),
            picture=picture,
        )

    return begin


def transcript(talk: Conversation, root: Path, said: list[str]) -> str:
    lines = []
    for text in said:
        answer = talk.say(text).text.replace(f"{root}/", "")
        lines += [f"> {text}", answer]
    return "\n".join(lines)


RULE = """\
> why is it spoilt?
The apple is brown.
> No, that's wrong!
1. I misread the brown: the apple is not brown. Then the apple is fresh. The apple is not brown \
and firm. In data/scenes.csv, its brown would be 'no' instead of 'yes'.
2. An exception; the rule would read: "a brown apple is spoilt, unless it is a russet". No rule \
would say of which class the apple is. Of 24 annotated pictures, 2 that are right now would be \
left open (08.png, 20.png); 2 that are wrong now would be left open (09.png, 21.png); all others \
stay.
3. One more condition; the rule would read: "a brown apple is spoilt, provided that it is soft". \
No rule would say of which class the apple is. Of 24 annotated pictures, 4 that are right now \
would be left open (01.png, 05.png, 13.png, …); 2 that are wrong now would be left open (09.png, \
21.png); all others stay.
Which one shall I take? Say 1 to 3, or no.
> yes
Which one? Say 1 to 3, or no.
> the second
Taken as revision 1; "undo that" takes it back.
The apple is fresh: no rule says so, the decision tree says it.
> it is fresh because it is a russet and it is firm
A new rule: "if the apple is a russet and it is firm, then it is fresh". By the rules, the apple \
would be fresh. Of 24 annotated pictures, 2 that are left open now would be right (09.png, \
21.png); all others stay.
Shall I take it? Say yes or no.
> yes
Taken as revision 2; "undo that" takes it back.
The apple is fresh. The apple is a russet and firm.
> no, it is spoilt
1. I misread the kind: the apple is green. Then the apple is spoilt. The apple is green and \
brown. In data/scenes.csv, its kind would be 'green' instead of 'russet' and its class would be \
'spoilt' instead of 'fresh'.
2. I misread the kind: the apple is red. Then the apple is spoilt. The apple is red and brown. In \
data/scenes.csv, its kind would be 'red' instead of 'russet' and its class would be 'spoilt' \
instead of 'fresh'.
3. An exception; the rule would read: "if the apple is a russet and it is firm, then it is fresh, \
unless it is brown". No rule would say of which class the apple is. Of 24 annotated pictures, 2 \
that are right now would be left open (09.png, 21.png); all others stay.
Which one shall I take? Say 1 to 3, or no.
> undo revision 1
Taken back: revision 1, "a brown apple is spoilt, unless it is a russet".
The apple is fresh: the rules contradict each other, the decision tree says it.
> undo that
Taken back: revision 2, "if the apple is a russet and it is firm, then it is fresh".
The apple is spoilt. The apple is brown."""


def test_a_rule_is_revised_and_taken_back(talk: Talk, tmp_path: Path) -> None:
    said = [line[2:] for line in RULE.splitlines() if line.startswith("> ")]
    found = transcript(talk("russet", "yes", "no"), tmp_path, said)
    assert found == RULE
    assert (tmp_path / "apples" / "knowledge.al").read_text() == KNOWLEDGE


def test_without_a_dataset_a_correction_holds_for_the_conversation(talk: Talk) -> None:
    apple = talk("russet", "yes", "no", annotated=False)
    proposed = apple.say("no, it is not brown")
    assert "with --data DATASET it would be one more label" in proposed.text
    assert apple.say("yes").text == (
        'For this conversation, I take it so; "undo that" takes it back.\n'
        "The apple is fresh. The apple is not brown and firm."
    )
    assert apple.say("is it brown?").text == "No, the apple is not brown."
    assert apple.say("undo that").text == "Taken back.\nThe apple is spoilt. The apple is brown."
    assert apple.say("undo that").text == "There is nothing to take back."


def test_a_label_is_kept_and_taken_back(talk: Talk, tmp_path: Path) -> None:
    apple = talk("green", "yes", "no")
    table = tmp_path / "data" / "scenes.csv"
    before = table.read_bytes()
    apple.say("no, it is fresh")
    said = apple.say("1").text
    assert "The networks learn it when they are trained again" in said
    assert b"01.png,fresh,green,no,no" in table.read_bytes()
    apple.say("undo that")
    assert table.read_bytes() == before
    assert apple.scene.label == "spoilt"


def test_what_is_agreed_with_changes_nothing(talk: Talk) -> None:
    apple = talk("green", "yes", "no")
    assert apple.say("no, it is spoilt").text == "I take the apple to be spoilt, too."
    assert apple.say("no, it is brown").text == "I see that, too: the apple is brown."
    known = apple.say("it is spoilt because it is brown").text
    assert known == 'The rule is known already: "a brown apple is spoilt". Nothing is changed.'
    assert apple.revisions.all == ()


def test_a_reason_that_is_not_seen_is_said_to_be_not_seen(talk: Talk) -> None:
    said = talk("green", "no", "no").say("it is spoilt because it is soft")
    assert said.text.startswith('I see that the apple is firm.\nSo "if the apple is soft, then')
    assert isinstance(said, Said)
    assert [proposal.reading for proposal in said.proposals] == [None, ("soft", "yes")]


def test_where_no_rule_decides_no_rule_is_wrong(talk: Talk) -> None:
    said = talk("red", "no", "yes").say("the rule is wrong").text
    assert said.startswith("No rule says of which class the apple is: the decision tree does. Say")


@pytest.mark.parametrize("text", ["9", "0", "take number 4"])
def test_a_number_of_no_proposal_is_said(talk: Talk, text: str) -> None:
    apple = talk("russet", "yes", "no")
    apple.say("that is wrong")
    with pytest.raises(QuestionError, match=r"there is no proposal \d; say a number from 1 to 3"):
        apple.say(text)
    assert len(apple.proposals) == 3


def test_a_rule_against_what_is_known_is_refused(talk: Talk) -> None:
    with pytest.raises(RevisionError, match="say first which rule is wrong"):
        talk("green", "yes", "no").say("it is fresh because it is brown")


REMARKS = {
    "no": Says.WRONG, "that's not right": Says.WRONG, "you are wrong": Says.WRONG,
    "I disagree.": Says.WRONG, "this rule is wrong": Says.RULE_WRONG,
    "the rule does not apply here": Says.RULE_WRONG, "something is missing": Says.MISSING,
    "no, it isn't brown": Says.OTHERWISE, "no it is fresh": Says.OTHERWISE,
    "wrong, the apple is soft": Says.OTHERWISE, "take it back": Says.TAKE_BACK,
    "undo revision 3": Says.TAKE_BACK, "no, it is fresh because it is firm": Says.BECAUSE,
    "these are spoilt because they are soft": Says.BECAUSE,
}  # fmt: skip
QUESTIONS = [
    "is it fresh", "no, is it fresh", "it is brown", "no, it is fresh?", "why is it fresh",
    "no why",
    "is it spoilt because it is brown", "and the kind?", "yes", "2",
]  # fmt: skip


@pytest.mark.parametrize("text", REMARKS)
def test_remarks_are_told_from_questions(tmp_path: Path, text: str) -> None:
    questions = Questions(load_domain(write_apples(tmp_path / "apples")))
    found = remark_of(questions, text)
    assert found is not None
    assert found.says is REMARKS[text]


@pytest.mark.parametrize("text", QUESTIONS)
def test_questions_are_no_remarks(tmp_path: Path, text: str) -> None:
    questions = Questions(load_domain(write_apples(tmp_path / "apples")))
    assert remark_of(questions, text) is None


# The command line -----------------------------------------------------------------------------

WORN = "it is bad because it is red and it has corners"


@pytest.fixture
def model(model_folder: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(model_folder, tmp_path / "model"))


def test_chat_revises_the_model_and_takes_it_back(run: Run, model: Path, tiles_data: Path) -> None:
    image = tiles_data / "images" / "006.png"
    files = ("domain/knowledge.al", "experience.json", "induction/tree.json")
    before = [(model / name).read_bytes() for name in files]
    chat = run("chat", model, image, "--data", tiles_data, stdin=f"{WORN}\nyes\nis it bad?\n")
    assert (chat.code, chat.err) == (0, "")
    assert 'a rule would read: "a red tile is good, unless it has corners"' in chat.out
    assert "2 that are wrong now would be right (images/006.png, images/042.png)" in chat.out
    assert chat.out.endswith("Yes, the tile is bad.\n")
    assert Agent.load(model).decide({"colour": "red", "round": "no"}) == "bad"
    listed = json.loads(run("revisions", model, "--json").out)
    assert [(one["number"], one["cause"], one["taken_back"]) for one in listed] == [
        (1, "a rule is missing", None)
    ]
    undone = run("revisions", model, "--undo", "1")
    assert undone.out == (
        'taken back: revision 1, "if the tile is red and it has corners, then it is bad"\n'
    )
    assert [(model / name).read_bytes() for name in files] == before
    assert "if the tile is red" in run("revisions", model).out.replace("\n", " ")


def test_chat_in_json_has_the_proposals(run: Run, model: Path, tiles_data: Path) -> None:
    image = tiles_data / "images" / "006.png"
    result = run("chat", model, image, "--json", stdin=f"no, it is bad\n99\n{WORN}\nno\n")
    first, error, rule, refused = map(json.loads, result.out.splitlines())
    assert [one["cause"] for one in first["proposals"]] == [
        "a feature was misread",
        "the rule has an exception",
    ]
    assert error["error"].startswith("there is no proposal 99;")
    assert rule["proposals"][0]["consequences"]["scenes"] == 40  # those that the model remembers
    assert refused == {"text": "Nothing is changed.", "proposals": [], "revision": None}


def test_revisions_of_a_domain_and_of_nothing(run: Run, tmp_path: Path) -> None:
    folder = write_apples(tmp_path / "apples")
    assert run("revisions", folder).out == "nothing was revised\n"
    result = run("revisions", folder, "--undo", "1")
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith(f"seewhy: {folder}: nothing was revised, so nothing is taken back")
    result = run("revisions", tmp_path)
    assert result.code == 2
    assert "is neither a model nor a domain folder" in result.err
