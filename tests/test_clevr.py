"""Scenes and questions in CLEVR's formats: read, refused with place, answered, imported."""

from __future__ import annotations

import json
import os
import zipfile
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from conftest import Run
from seewhy.data.importers.clevr import read_questions, read_scenes
from seewhy.domain.domain import load_domain
from seewhy.domain.things import Things

SCENES: dict[str, Any] = {
    "info": {"split": "test"},
    "scenes": [
        {
            "image_index": 3,
            "image_filename": "CLEVR_test_000003.png",
            "objects": [
                {
                    "size": "small",
                    "color": "red",
                    "material": "metal",
                    "shape": "cube",
                    "3d_coords": [-1.0, 0.5, 0.35],
                    "pixel_coords": [10, 20, 8.5],
                    "rotation": 12.5,
                },
                {
                    "size": "large",
                    "color": "blue",
                    "material": "rubber",
                    "shape": "sphere",
                    "3d_coords": [1.0, -0.5, 0.7],
                },
            ],
            "relationships": {
                "left": [[], [0]],
                "right": [[1], []],
                "front": [[1], []],
                "behind": [[], [0]],
            },
        }
    ],
}
QUESTIONS: dict[str, Any] = {
    "questions": [
        {
            "image_index": 3,
            "question": "How many big balls are right of the shiny block?",
            "answer": 1,
            "template_filename": "one_hop.json",
            "question_family_index": 0,
        },
        {"image_index": 3, "question": "Is there a cyan thing?", "answer": "no"},
        {"image_index": 3, "question": "What color is the ball?", "answer": "blue"},
        {"image_index": 3, "question": "What shape is the red thing?", "answer": "cube"},
        {"image_index": 3, "question": "How many cubes are there?", "answer": "1"},
    ]
}


@pytest.fixture(scope="module")
def things() -> Things:
    found = load_domain("tabletop").things
    assert found is not None
    return found


def written(folder: Path, name: str, content: object) -> Path:
    path = folder / name
    path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
    return path


def test_a_scene_in_the_domains_terms(things: Things, tmp_path: Path) -> None:
    scenes = read_scenes(written(tmp_path, "s.json", SCENES), things)
    scene = scenes[3]
    assert scene.values["colour"] == ("red", "blue")
    assert scene.related["left"] == (0, 0b01)
    assert scene.related["in_front"] == (0b10, 0)
    assert scene.positions[1] == (1.0, -0.5, 0.7)
    asked = read_questions(written(tmp_path, "q.json", QUESTIONS), scenes)
    assert [question.answer for question in asked] == [1, False, "blue", "cube", 1]
    assert asked[0].family == "one_hop 0"


def test_the_command_says_how_many_are_right(run: Run, tmp_path: Path) -> None:
    scenes, questions = (
        written(tmp_path, "s.json", SCENES),
        written(tmp_path, "q.json", QUESTIONS),
    )
    found = run("evaluate", "clevr", "--scenes", scenes, "--questions", questions, "--json")
    told = json.loads(found.out)
    assert found.code == 0
    assert (told["questions"], told["understood"], told["right"]) == (5, 5, 5)
    assert told["families"]["one_hop 0"] == {"questions": 1, "right": 1}
    assert told["steps_of_reasons"] > 20
    assert told["wrong"] == []


def test_wrong_answers_are_written_with_what_was_understood(run: Run, tmp_path: Path) -> None:
    wrong = deepcopy(QUESTIONS)
    wrong["questions"][2]["answer"] = "red"
    wrong["questions"][3]["question"] = "What zorb is the red thing?"
    scenes, questions = written(tmp_path, "s.json", SCENES), written(tmp_path, "q.json", wrong)
    out = tmp_path / "wrong.txt"
    found = run("evaluate", "clevr", "--scenes", scenes, "--questions", questions, "--wrong", out)
    assert found.code == 0
    assert "5 questions about 1 scenes: 4 understood, 3 right (60.0 %" in found.out
    text = out.read_text(encoding="utf-8")
    assert "questions[2]\n  asked:      What color is the ball?\n  annotated:  red" in text
    assert "understood: ValueOf(feature='colour'" in text
    assert "'zorb' is no word of the domain" in text
    assert "understood: not at all" in text


def damaged(path: tuple[str | int, ...], value: object) -> dict[str, Any]:
    content = deepcopy(SCENES)
    at: Any = content
    for key in path[:-1]:
        at = at[key]
    if value is ...:
        del at[path[-1]]
    else:
        at[path[-1]] = value
    return content


FIRST = ("scenes", 0)
DAMAGED_SCENES: dict[str, tuple[object, str]] = {
    "not JSON": (
        '{"scenes": [',
        "s.json:1:13: is no valid JSON (expecting value); export it again",
    ),
    "something else": (
        "[1, 2]",
        "s.json: has no scenes; it must be an object with a list 'scenes'",
    ),
    "no list": (
        {"scenes": {"a": 1}},
        "s.json: 'scenes' must be a list; correct it or export it again",
    ),
    "no scenes": (
        {"scenes": []},
        "s.json: has no scenes; it must be an object with a list 'scenes'",
    ),
    "nested without end": (
        '{"scenes": [' + "[" * 100_000 + "]" * 100_000 + "]}",
        "s.json:1:13: is no valid JSON (it is nested too deeply); export it again",
    ),
    "no things": (
        damaged((*FIRST, "objects"), ...),
        "s.json: scenes[0].objects is missing; correct it or export it again",
    ),
    "no number": (
        damaged((*FIRST, "image_index"), ...),
        "s.json: scenes[0].image_index is missing; correct it or export it again",
    ),
    "a number that is none": (
        damaged((*FIRST, "image_index"), True),
        "s.json: scenes[0].image_index: input should be a valid integer, got True; correct it or "
        "export it again",
    ),
    "no relations": (
        damaged((*FIRST, "relationships"), ...),
        "s.json: scenes[0].relationships is missing; correct it or export it again",
    ),
    "a thing that is none": (
        damaged((*FIRST, "objects", 0), "cube"),
        "s.json: scenes[0].objects[0]: input should be a valid dictionary, got 'cube'; correct it "
        "or export it again",
    ),
    "a relation to a thing that is not there": (
        damaged((*FIRST, "relationships", "left", 1), [2]),
        "s.json: scenes[0].relationships.left[1]: thing 2 is not there; things count from 0 to 1",
    ),
    "a relation to a thing before the first": (
        damaged((*FIRST, "relationships", "left", 1), [-1]),
        "s.json: scenes[0].relationships.left[1]: thing -1 is not there; things count from 0 to 1",
    ),
    "a relation with too few lists": (
        damaged((*FIRST, "relationships", "left"), [[]]),
        "s.json: scenes[0].relationships.left: must have a list for each of the 2 things, got 1; "
        "correct it or export it again",
    ),
    "a relation that is none": (
        damaged((*FIRST, "relationships", "lefft"), [[], []]),
        "s.json: scenes[0].relationships: 'lefft' is no relation of the domain; did you mean "
        "'left'?",
    ),
    "a feature that is none": (
        damaged((*FIRST, "objects", 0, "colr"), "red"),
        "s.json: scenes[0].objects[0]: 'colr' is no feature of things in the domain; did you mean "
        "'colour'?",
    ),
    "a value that is none": (
        damaged((*FIRST, "objects", 0, "color"), "rad"),
        "s.json: scenes[0].objects[0].color: 'rad' is no colour of the domain; did you mean 'red'?",
    ),
    "a value of another type": (
        damaged((*FIRST, "objects", 0, "color"), 3),
        "s.json: scenes[0].objects[0].color: must be a text, got 3; correct it or export it again",
    ),
    "no number as a place": (
        json.dumps(damaged((*FIRST, "objects", 0, "3d_coords"), [1, 2, float("nan")])),
        "s.json: scenes[0].objects[0].3d_coords: must be three finite numbers, got [1, 2, nan]; "
        "correct it or export it again",
    ),
    "a place of two numbers": (
        damaged((*FIRST, "objects", 0, "3d_coords"), [1, 2]),
        "s.json: scenes[0].objects[0].3d_coords: must be three finite numbers, got [1, 2]; correct "
        "it or export it again",
    ),
    "twice the same number": (
        {"scenes": SCENES["scenes"] * 2},
        "s.json: scenes[1]: image_index 3 is that of an earlier scene, too; give each scene its "
        "own",
    ),
    "too many things": (
        damaged((*FIRST, "objects"), [{}] * 11) | {},
        "s.json: scenes[0].relationships.left: must have a list for each of the 11 things, got 2; "
        "correct it or export it again",
    ),
}


@pytest.mark.parametrize("name", DAMAGED_SCENES)
@pytest.mark.parametrize("command", ["evaluate", "import"])
def test_scenes_that_are_damaged(name: str, command: str, run: Run, tmp_path: Path) -> None:
    content, said = DAMAGED_SCENES[name]
    scenes = written(tmp_path, "s.json", content)
    questions = written(tmp_path, "q.json", QUESTIONS)
    if command == "evaluate":
        found = run("evaluate", "clevr", "--scenes", scenes, "--questions", questions)
    else:
        found = run("data", "import", "clevr", "--scenes", scenes, "--out", tmp_path / "out")
        assert not (tmp_path / "out").exists()
    assert found.code == 2
    assert found.err.replace("\n", " ").replace(f"{tmp_path}/", "").strip() == f"seewhy: {said}"


DAMAGED_QUESTIONS: dict[str, tuple[object, str]] = {
    "not JSON": ("nothing", "q.json:1:1: is no valid JSON (expecting '{' or '['); export it again"),
    "none": (
        {"questions": []},
        "q.json: has no questions; it must be an object with a list 'questions'",
    ),
    "no question": (
        {"questions": [{"image_index": 3}]},
        "q.json: questions[0].question is missing; correct it or export it again",
    ),
    "of an image that is not there": (
        {"questions": [{"image_index": 4, "question": "Is there a cube?"}]},
        "q.json: questions[0]: asks about image 4, of which there is no scene; give the scenes "
        "that the questions were made for",
    ),
    "an answer that is none": (
        {"questions": [{"image_index": 3, "question": "Is there a cube?", "answer": [1]}]},
        "q.json: questions[0].answer.bool: input should be a valid boolean, got list; correct it "
        "or export it again",
    ),
}


@pytest.mark.parametrize("name", DAMAGED_QUESTIONS)
def test_questions_that_are_damaged(name: str, run: Run, tmp_path: Path) -> None:
    content, said = DAMAGED_QUESTIONS[name]
    scenes, questions = written(tmp_path, "s.json", SCENES), written(tmp_path, "q.json", content)
    found = run("evaluate", "clevr", "--scenes", scenes, "--questions", questions)
    assert found.code == 2
    assert found.err.replace("\n", " ").replace(f"{tmp_path}/", "").strip() == f"seewhy: {said}"


COMMANDS = {
    "evaluate clevr": "'evaluate clevr' needs the scenes and the questions: --scenes FILE "
    "--questions FILE",
    "evaluate clevr --scenes nowhere.json --questions q.json": "nowhere.json: there is no such "
    "file; name one with a list 'scenes'",
    "evaluate clevr --scenes s.json --questions q.json --domain structure_stability": "the domain "
    "has no [things] that could be asked about",
    "evaluate model --scenes s.json": "--scenes and --wrong go with 'seewhy evaluate clevr'",
    "evaluate model": "there is no dataset; name its folder with --data",
    "evaluate model --data d --questions q.json": "--questions must be a whole number of at least "
    "1, got 'q.json'; a file of questions goes with 'seewhy evaluate clevr'",
    "data import clevr --out out": "there is no SOURCE; name a folder, a zip archive or an "
    "exported file",
    "data import coco x --scenes s.json --out out": "--scenes and --questions go with 'seewhy data "
    "import clevr'",
    "decide tabletop": "tabletop has things: name some, as in cup.size=…, or give a table with "
    "--things FILE or an annotated scene with --scene FILE",
    "decide tabletop --scene s.json --image 4": "has no scene with image_index 4",
    "decide tabletop --image 4": "--image goes with --things or --scene",
    "decide tabletop --scene s.json --ask zorb": "I do not understand the question; 'zorb' is no "
    "word of the domain",
}


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_that_cannot_be_meant(
    command: str, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    written(tmp_path, "s.json", SCENES)
    written(tmp_path, "q.json", QUESTIONS)
    found = run(*command.split())
    assert found.code == 2
    assert COMMANDS[command] in found.err.replace("\n", " ")


def test_a_dataset_of_scenes(run: Run, tmp_path: Path) -> None:
    scenes, questions = (
        written(tmp_path, "s.json", SCENES),
        written(tmp_path, "q.json", QUESTIONS),
    )
    pictures = tmp_path / "pictures"
    pictures.mkdir()
    Image.new("RGB", (32, 24)).save(pictures / "CLEVR_test_000003.png")
    out = tmp_path / "out"
    found = run(
        "data", "import", "clevr", "--scenes", scenes, "--questions", questions,
        "--pictures", pictures, "--out", out,
    )  # fmt: skip
    assert found.code == 0, found.err
    assert "1 scenes of 2 things, 2 relations, 5 questions, 1 pictures" in found.out.replace(
        "\n", " "
    )
    image = "images/CLEVR_test_000003.png"
    assert (out / image).is_file()
    assert (out / "things.csv").read_text(encoding="utf-8").splitlines() == [
        "image,thing,x,y,z,size,colour,material,shape",
        f"{image},1,-1,0.5,0.35,small,red,metal,cube",
        f"{image},2,1,-0.5,0.7,large,blue,rubber,sphere",
    ]
    assert (out / "relations.csv").read_text(encoding="utf-8").splitlines() == [
        "image,relation,thing,other",
        f"{image},left,1,2",
        f"{image},in_front,2,1",
    ]
    assert (out / "questions.csv").read_text(encoding="utf-8").splitlines()[2] == (
        f"{image},Is there a cyan thing?,no,question"
    )
    again = run("data", "import", "clevr", "--scenes", scenes, "--out", out)
    assert again.code == 2
    assert "is there already; name a new folder with --out" in again.err.replace("\n", " ")


def test_a_picture_that_is_missing(run: Run, tmp_path: Path) -> None:
    scenes = written(tmp_path, "s.json", SCENES)
    (tmp_path / "pictures").mkdir()
    found = run(
        "data", "import", "clevr", "--scenes", scenes, "--pictures", tmp_path / "pictures",
        "--out", tmp_path / "out",
    )  # fmt: skip
    assert found.code == 2
    assert "has no picture 'CLEVR_test_000003.png', which a scene is of" in found.err.replace(
        "\n", " "
    )


def test_a_scene_is_asked_about(run: Run, tmp_path: Path) -> None:
    scenes = written(tmp_path, "s.json", SCENES)
    found = run(
        "decide", "tabletop", "--scene", scenes, "--ask", "is there a ball", "--ask", "what is it"
    )
    assert found.code == 0
    assert "Yes: there is one sphere: the large blue rubber sphere." in found.out
    assert "It is the large blue rubber sphere: it is large, it is blue" in found.out
    told = json.loads(run("decide", "tabletop", "--scene", scenes, "--ask", "why", "--json").out)
    assert told["answers"] == []


def _archive() -> Path:
    """The archive with scenes, and questions that the public generator's templates made."""
    beside = Path(__file__).parents[2] / "shared" / "data" / "clevr.zip"
    path = Path(os.environ.get("SEEWHY_CLEVR", beside))
    if not path.exists():
        pytest.skip("no scenes of CLEVR are here; SEEWHY_CLEVR names an archive with them")
    return path


def test_the_questions_of_all_families(run: Run, tmp_path: Path) -> None:
    with zipfile.ZipFile(_archive()) as archive:
        for name in archive.namelist():
            if name.endswith(("scenes.json", "questions.json")):
                (tmp_path / Path(name).name).write_bytes(archive.read(name))
    found = run(
        "evaluate", "clevr", "--scenes", tmp_path / "scenes.json", "--questions",
        tmp_path / "questions.json", "--json",
    )  # fmt: skip
    told = json.loads(found.out)
    assert len(told["families"]) == 90
    assert told["understood"] == told["questions"] == told["right"]
