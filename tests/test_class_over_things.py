"""Questions about the class of a picture that axioms conclude over its things."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from conftest import Run
from fruit_builder import write_fruits

STRUCTURES = {
    "scenes": [
        {
            "image_index": index,
            "objects": [
                {"colour": colour, "width": "narrow"} for colour in ("green", "red", "white")
            ],
            "relationships": {"on": [[1], [2], []], "beyond": [[], beyond, []]},
        }
        for index, beyond in ((1, [2]), (2, []))
    ]
}


@pytest.fixture(scope="module")
def structures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("structures") / "scenes.json"
    file.write_text(json.dumps(STRUCTURES), encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def fruits(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_fruits(tmp_path_factory.mktemp("fruits"))


def answers(run: Run, domain: str | Path, scenes: Path, image: int, *asked: str) -> list[str]:
    """The answers of one conversation."""
    questions = [part for question in asked for part in ("--ask", question)]
    found = run("decide", domain, "--scene", scenes, "--image", str(image), *questions, "--json")
    assert found.code == 0, found.err
    return [answer["text"] for answer in json.loads(found.out)["answers"]]


WHY = (
    "The structure is unstable: the white narrow block would fall, since the white narrow block is "
    "displaced."
)
OF_ONE_THAT_FALLS = {
    "is the structure stable?": "No, the structure is unstable.",
    "is the tower unstable?": "Yes, the structure is unstable.",
    "is it not stable?": "Yes, the structure is unstable.",
    "will it collapse?": "Yes, the structure is unstable.",
    "what is it?": "The structure is unstable.",
    "is it stable or unstable?": "The structure is unstable.",
    "which class is the picture?": "The structure is unstable.",
    "why is it unstable?": WHY,
    "why not stable?": WHY,
    "why is the structure not stable?": WHY,
    "what keeps it from being stable?": WHY,
    "why unstable and not stable?": WHY,
    "why is it stable?": f"But t{WHY[1:]}",
    "what would have to be otherwise for it to be stable?": (
        "If it were not so that the middle of the white narrow block lies beyond the edge of the "
        "red narrow block, the structure would be stable. One other change as small would do, too."
    ),
    "what would make the structure stable?": (
        "If it were not so that the middle of the white narrow block lies beyond the edge of the "
        "red narrow block, the structure would be stable. One other change as small would do, too."
    ),
    "how sure are you?": "I am as sure as of what I was told.",
    "would it be stable without the white block?": "Then: yes, the structure is stable.",
    "is the structure stable if the green block is taken away?": (
        "Then: no, the structure is unstable."
    ),
}


@pytest.mark.parametrize("question", OF_ONE_THAT_FALLS)
def test_the_class_is_asked_about_in_words(question: str, run: Run, structures: Path) -> None:
    told = answers(run, "structure_blocks", structures, 1, question)
    assert told == [OF_ONE_THAT_FALLS[question]]


OF_ONE_THAT_STAYS = {
    "what if the red block were displaced — is it stable then?": (
        "Then: no, the structure is unstable."
    ),
    "if the red block were displaced, would the white block fall?": (
        "Then: yes, the white narrow block would fall."
    ),
    "would the white block fall if the red block were displaced?": (
        "Then: yes, the white narrow block would fall."
    ),
    "what if the red block were displaced?": (
        "The red narrow block would have to be moved, the red narrow block and the white narrow "
        "block would fall and the structure would be unstable."
    ),
    "why is it stable?": (
        "The structure is stable: a structure in which every block stays is stable."
    ),
    "why is it unstable?": (
        "But the structure is stable: a structure in which every block stays is stable."
    ),
    "what would have to be otherwise for the white block to fall?": (
        "If the middle of the red narrow block lies beyond the edge of the green narrow block, the "
        "white narrow block would fall. Three other changes as small would do, too."
    ),
}


@pytest.mark.parametrize("question", OF_ONE_THAT_STAYS)
def test_what_is_supposed_is_concluded_to_the_class(
    question: str, run: Run, structures: Path
) -> None:
    told = answers(run, "structure_blocks", structures, 2, question)
    assert told == [OF_ONE_THAT_STAYS[question]]


def test_it_is_the_thing_that_was_spoken_of_and_else_the_picture(
    run: Run, structures: Path
) -> None:
    told = answers(
        run, "structure_blocks", structures, 1,
        "which block would fall?", "is it displaced?", "is the structure stable?", "what is it?",
        "what if the white block were removed?",
    )  # fmt: skip
    assert told[1:] == [
        "Yes, the white narrow block is displaced.",
        "No, the structure is unstable.",
        "The structure is unstable.",
        "Then: the structure is stable.",
    ]


def test_a_folder_of_somebody_is_asked_the_same(run: Run, fruits: Path) -> None:
    told = answers(
        run, fruits, fruits.parent / "scenes.json", 1,
        "is the bowl fresh?", "why not?", "what would make it fresh?", "how sure are you?",
        "would the bowl be good without the plum?",
    )  # fmt: skip
    assert told == [
        "No, the bowl is spoiled.",
        "The bowl is spoiled: the green unripe sound pear will spoil, since the green unripe sound "
        "pear touches the blue overripe rotten plum and the blue overripe rotten plum is rotten; "
        "the blue overripe rotten plum will spoil, since the blue overripe rotten plum is rotten.",
        "If the blue overripe rotten plum were sound, the bowl would be fresh. One other change as "
        "small would do, too.",
        "I am as sure as of what I was told.",
        "Then: yes, the bowl is fresh.",
    ]


def test_what_is_not_decided_is_not_said(run: Run, fruits: Path) -> None:
    """Without the axiom that concludes it, nothing says that a bowl is fresh."""
    knowledge = fruits / "knowledge.al"
    whole = knowledge.read_text(encoding="utf-8")
    scenes = fruits.parent / "scenes.json"
    knowledge.write_text(whole.replace("fresh(B) if bowl(B), not -fresh(B).", ""), encoding="utf-8")
    try:
        asked = ("if the plum were sound, is the bowl fresh?", "is the bowl fresh?")
        told = answers(run, fruits, scenes, 1, *asked)
    finally:
        knowledge.write_text(whole, encoding="utf-8")
    assert told == [
        "Then: I don't know: it is not decided of which class the bowl is.",
        "No, the bowl is spoiled.",
    ]


# What is taken away takes with it what stood on it


def test_no_smallest_change_takes_away_what_others_stand_on(run: Run, structures: Path) -> None:
    """That the white block falls does not become otherwise by taking away what is below it."""
    told = answers(
        run, "structure_blocks", structures, 1,
        "would the white block fall?",
        "what would have to be otherwise for the answer to be no?",
        "would the white block fall?", "what if the red block were removed?",
        "is the white block steady?", "what if the red block were removed?",
    )  # fmt: skip
    assert told[1] == (
        "If it were not so that the middle of the white narrow block lies beyond the edge of the "
        "red narrow block, the answer would be no."
    )
    assert told[3] == "Then: yes, the white narrow block would fall."
    assert told[5] == "Then: I don't know: not enough is seen of the white narrow block."


def test_what_contradicts_the_knowledge_is_no_change(run: Run, tmp_path: Path) -> None:
    """A thing lies on one thing: so it is not put on a second."""
    table = {
        "scenes": [
            {
                "image_index": 1,
                "objects": [
                    {"color": colour, "shape": "cube", "size": "small", "material": "rubber"}
                    for colour in ("red", "green", "blue")
                ],
                "relationships": {"on": [[], [0], []]},
            }
        ]
    }
    file = tmp_path / "table.json"
    file.write_text(json.dumps(table), encoding="utf-8")
    told = answers(
        run, "tabletop", file, 1,
        "is the red cube on the blue cube?",
        "what would have to be otherwise for the answer to be yes?",
        "what if the red cube were on the blue cube?",
        "how many things are on the green cube?",
        "what if the red cube were on the blue cube?",
    )  # fmt: skip
    assert told[1] == (
        "If it were not so that the small red rubber cube is on the small green rubber cube and "
        "the small red rubber cube were on the small blue rubber cube, the answer would be yes. "
        "One other change as small would do, too."
    )
    assert told[2] == "Then: yes, the small red rubber cube is on the small blue rubber cube."
    assert told[4] == "Then: there is no thing on the small green rubber cube."


def test_what_could_come_about_in_several_ways_is_asked_back(run: Run, fruits: Path) -> None:
    scenes = fruits.parent / "scenes.json"
    found = run(
        "decide", fruits, "--scene", scenes, "--image", "1", "--ask",
        "how many green fruits are there?", "--ask", "what if the pear were not green?",
    )  # fmt: skip
    assert found.code == 2
    assert (
        "that could come about in several ways: if the green unripe sound pear were red; if the "
        "green unripe sound pear were yellow; if the green unripe sound pear were blue; say which"
    ) in " ".join(found.err.split())


def test_the_page_says_what_is_answered_of_the_whole(run: Run, tmp_path: Path) -> None:
    page = Path(__file__).parents[1] / "docs" / "things.md"
    told = page.read_text("utf-8").split("## The picture as a whole")[1].split("\n## ")[0]
    rows = re.findall(r"^\| [^|]+ \| ([A-Z][^|]+\?) \| ([^|]+) \|$", told, re.M)
    assert len(rows) == 6
    blocks = [("green", "wide"), ("red", "narrow"), ("teal", "narrow")]
    objects = [{"colour": colour, "width": width} for colour, width in blocks]
    related = {"on": [[1], [2], []], "beyond": [[], [2], []]}
    scene = {"image_index": 1, "objects": objects, "relationships": related}
    file = tmp_path / "scenes.json"
    file.write_text(json.dumps({"scenes": [scene]}), encoding="utf-8")
    for question, answer in rows:
        assert answers(run, "structure_blocks", file, 1, question) == [answer]


def test_a_source_may_leave_the_class_to_axioms(run: Run, tmp_path: Path) -> None:
    """Pictures that are made without a class have none in their table, and go on being made."""
    for count in ("2", "3"):
        found = run(
            "data", "make", "structure_blocks", "--count", count, "--size", "64", "--out", tmp_path
        )
        assert found.code == 0, found.err
    rows = (tmp_path / "scenes.csv").read_text(encoding="utf-8").splitlines()
    assert rows[0] == "image,class,split"
    assert [row.split(",")[1] for row in rows[1:]] == ["", "", ""]


SYMMETRIC = {
    "two alike": (
        "species(X, S), species(Y, S), X != Y",
        ["the red ripe sound apple is an apple", "the green ripe sound apple is an apple"],
    ),
    "three that differ": (
        "colour(X, red), species(Y, pear), rotten(Z), X != Y, Y != Z, X != Z",
        [
            "the red ripe sound apple is red",
            "the green unripe sound pear is a pear",
            "the blue overripe rotten plum is rotten",
        ],
    ),
    "that touch each other": (
        "touches(X, Y), -rotten(X), -rotten(Y)",
        ["the red ripe sound apple touches the green unripe sound pear"],
    ),
    "one that is told apart": (
        "touches(X, Y), rotten(Y)",
        ["the green unripe sound pear touches the blue overripe rotten plum"],
    ),
}


@pytest.mark.parametrize("case", SYMMETRIC)
def test_a_reason_with_things_exchanged_is_told_once(case: str, run: Run, tmp_path: Path) -> None:
    """As of an axiom that was learned over things, which asks for two that are alike."""
    body, told = SYMMETRIC[case]
    mine = write_fruits(tmp_path)
    knowledge = mine / "knowledge.al"
    before = knowledge.read_text(encoding="utf-8").split("%% a bowl in which something spoils")[0]
    knowledge.write_text(f"{before}-fresh(B) if bowl(B), {body}.\n", encoding="utf-8")
    found = run("decide", mine, "--scene", tmp_path / "scenes.json", "--image", "1")
    assert found.code == 0, found.err
    lines = found.out.split("what is there?")[0].splitlines()
    assert sum("the bowl is spoiled" in line for line in lines) == 1
    for text in told:
        assert sum(line.endswith(text) for line in lines) == 1


def test_networks_that_grow_see_no_things(run: Run, tmp_path: Path) -> None:
    """A folder that asks for them is told so, by what trains and by what checks."""
    mine = write_fruits(tmp_path)
    table = mine / "domain.toml"
    text = table.read_text(encoding="utf-8").replace(
        'scene = "bowl"', 'scene = "bowl"\neyes = "none"'
    )
    table.write_text(text, encoding="utf-8")
    (tmp_path / "data").mkdir()
    trained = run("train", mine, "--data", tmp_path / "data", "--out", tmp_path / "model")
    assert trained.code == 2
    assert trained.err == (
        f"seewhy: {table}:6: eyes = 'none' sees no things: networks that grow see one thing in a "
        "picture, and things are seen by a backbone; leave the line out, or name one such as "
        "'efficientnet-lite0'\n"
    )
    assert not (tmp_path / "model").exists()
    checked = run("check", mine)
    assert f"{table}:6: eyes = 'none' sees no things" in checked.out + checked.err
