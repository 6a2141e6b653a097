"""`seewhy new NAME --from SOURCE`: a domain with the classes and features of labelled pictures."""

from __future__ import annotations

import json
from itertools import product
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from conftest import Run, seen, write_tiles
from exports_builder import coco, draw, draw_all, pack, rows_of, write, write_json
from seewhy.agent.agent import Agent
from seewhy.check.domain import check_domain
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain
from seewhy.errors import DomainError
from seewhy.knowledge.reasoner import Reasoner
from seewhy.new_domain.from_names import NamedDomain, domain_from_names
from seewhy.new_domain.from_pictures import write_domain_of
from seewhy.new_domain.proposals import proposals
from seewhy.new_domain.sketch import Sketch, SketchFeature

FINGERS = """\
class,thumb,index,middle
0,no,no,no
1,no,yes,no
2,no,yes,yes
3,yes,yes,yes
"""


@pytest.fixture
def hands(tmp_path: Path) -> Path:
    """Class folders in an archive, as they are shared."""
    names = [f"hands/{digit}/{person}_{digit}.png" for digit in range(4) for person in "abc"]
    source = draw_all(tmp_path / "source", names)
    return pack(source, tmp_path / "hands.zip")


def test_from_class_folders_and_a_table(hands: Path, tmp_path: Path, run: Run) -> None:
    features = write(tmp_path / "fingers.csv", FINGERS)
    folder = tmp_path / "digits"
    result = run(
        "new", folder, "--from", hands, "--features", features, "--subject", "the hand",
        "--group", "^(.)_",
    )  # fmt: skip
    assert (result.code, result.err) == (0, "")
    assert result.out == (
        f"{folder} holds a domain of 4 classes and 3 features, 4 axioms that follow from them; "
        "its README.md says how to go on.\n"
        f"  seewhy check {folder}\n"
        f"  seewhy data import folder {hands} --features {folder}/classes.csv --group '^(.)_' "
        f"--out {folder}_data\n"
        f"  seewhy data show {folder}_data --domain {folder}\n"
        f"  seewhy train {folder} --data {folder}_data --out {folder}_model\n"
        f"  seewhy evaluate {folder}_model --data {folder}_data\n"
    )
    assert (folder / "knowledge.al").read_text() == (
        """\
% The signature: sorts, and statics over them. 'hand' is the picture at hand.
#sort hand.
#sort kind = {0, 1, 2, 3}.
#static thumb(hand).
#static index(hand).
#static middle(hand).
#static of_kind(hand, kind).

% Proposals, which follow from classes.csv: each class by the fewest values that tell
% it from all others there. The line above each (%%) is its sentence and appears in
% answers. Change them, and add what you know.

%% if the hand shows no index, then it is 0
of_kind(S, 0) if -index(S).

%% if the hand shows index and it shows no middle, then it is 1
of_kind(S, 1) if index(S), -middle(S).

%% if the hand shows no thumb and it shows middle, then it is 2
of_kind(S, 2) if -thumb(S), middle(S).

%% if the hand shows thumb, then it is 3
of_kind(S, 3) if thumb(S).
"""
    )
    assert "[networks]" not in (folder / "domain.toml").read_text()
    checked = run("check", folder)
    assert (checked.code, checked.err) == (0, "")
    assert checked.out.endswith("nothing is wrong\n")
    # the command that it says makes the dataset that fits
    run(*result.out.splitlines()[2].replace("'", "").split()[1:])
    dataset = Dataset.load(tmp_path / "digits_data", load_domain(folder))
    assert len(dataset) == 12
    assert {scene.group for scene in dataset.scenes} == {"a", "b", "c"}
    assert dataset.vectors[0] == ("no", "no", "no")


def test_the_dataset_in_the_same_go(hands: Path, tmp_path: Path, run: Run) -> None:
    features = write(tmp_path / "fingers.csv", FINGERS)
    folder, data = tmp_path / "digits", tmp_path / "pictures"
    result = run(
        "new", folder, "--from", hands, "--features", features, "--data", data,
        "--test-share", "0.34",
    )  # fmt: skip
    assert result.code == 0
    assert result.out.splitlines()[:2] == [
        f"dataset: {data} (12 pictures of 4 classes)",
        "  classes: 0 3, 1 3, 2 3, 3 3",
    ]
    assert f"  seewhy train {folder} --data {data} --out {folder}_model\n" in result.out
    assert "data import" not in result.out
    domain = load_domain(folder)
    report = check_domain(domain, Dataset.load(data, domain))
    assert (report.decided, report.decided_rightly) == (1.0, 1.0)
    again = run("new", tmp_path / "other", "--from", hands, "--data", data)
    assert again.code == 2
    assert "holds a dataset already" in again.err
    assert not (tmp_path / "other").exists()


def test_from_a_dataset_that_was_imported(hands: Path, tmp_path: Path, run: Run) -> None:
    """Its classes.csv and its words are used, and it is trained on as it is."""
    features = write(tmp_path / "t.csv", FINGERS.replace("thumb", "Is Stretched"))
    data = tmp_path / "data"
    run("data", "import", "folder", hands, "--features", features, "--out", data)
    result = run("new", tmp_path / "digits", "--from", data)
    assert (result.code, result.err) == (0, "")
    assert f"--data {data} --out" in result.out
    assert "data import" not in result.out
    domain = load_domain(tmp_path / "digits")
    assert list(domain.features) == ["is_stretched", "index", "middle"]
    assert domain.features["is_stretched"].say["no"] == "{it} is not stretched"
    assert len(domain.knowledge.axioms) == 4
    assert check_domain(domain, Dataset.load(data, domain)).decided_rightly == 1.0


def test_from_a_dataset_without_a_table_of_classes(tmp_path: Path, run: Run) -> None:
    """There are features, and nobody says what follows: the tree will learn it."""
    data = write_tiles(tmp_path / "tiles_data", count=12)
    result = run("new", tmp_path / "tiles", "--from", data)
    assert (result.code, result.err) == (0, "")
    folder = tmp_path / "tiles"
    assert (folder / "knowledge.al").read_text() == (
        """\
% The signature: sorts, and statics over them. 'picture' is the picture at hand.
#sort picture.
#sort kind = {bad, good}.
#sort colour_value = {blue, green, red}.
#static colour(picture, colour_value).
#static round(picture).
#static of_kind(picture, kind).

% Here belong axioms: what everybody knows who knows such pictures. They need not
% cover everything: what they leave open is learned from your pictures. For example,
% without the first % of each line:
%
% %% if the colour of the picture is blue, then it is bad
% of_kind(S, bad) if colour(S, blue).
"""
    )
    assert not (folder / "classes.csv").exists()
    checked = run("check", folder, "--data", data)
    assert "of 6 feature vectors: silent 100.0 %" in checked.out
    # the example can be taken as it stands
    text = (folder / "knowledge.al").read_text()
    taken = text.replace("% %% if", "%% if").replace("% of_kind", "of_kind")
    (folder / "knowledge.al").write_text(taken)
    assert run("check", folder).code == 0
    assert len(load_domain(folder).knowledge.axioms) == 1


def _see_little(folder: Path) -> None:
    """Let networks look at small pictures, which is faster."""
    text = (folder / "domain.toml").read_text()
    small = text.replace("# [pictures]\n", "[pictures]\nsize = 16\n")
    assert small != text
    (folder / "domain.toml").write_text(small)


@pytest.mark.usefixtures("in_one_process")
def test_where_no_axiom_is_known_the_tree_decides(tmp_path: Path, run: Run) -> None:
    data = write_tiles(tmp_path / "tiles_data", count=30)
    run("new", tmp_path / "tiles", "--from", data)
    _see_little(tmp_path / "tiles")
    domain = load_domain(tmp_path / "tiles")
    dataset = Dataset.load(data, domain)
    # The recurrent network learns to word answers; what decides here is the tree.
    agent = Agent(domain, seed=3).fit(dataset, answers=False)
    found = [agent.classify(scene.picture) for scene in dataset.of_split("train").scenes[:6]]
    assert {classification.method for classification in found} == {"tree"}
    assert {classification.label for classification in found} == {"good", "bad"}


@pytest.mark.usefixtures("in_one_process")
def test_without_any_feature_the_look_as_a_whole_is_one(tmp_path: Path, run: Run) -> None:
    for kind, colour in (("Red Thing", "red"), ("blue", "blue"), ("2 Green Ovals!", "green")):
        for number in range(10):
            draw(tmp_path / "s" / kind / f"{number}.png", size=(20, 20 + number), colour=colour)
    folder, data = tmp_path / "shown", tmp_path / "data"
    result = run("new", folder, "--from", tmp_path / "s", "--data", data, "--test-share", "0.3")
    assert result.code == 0
    assert "no feature is said, so the domain has one, what a picture looks like" in result.err
    assert rows_of(data / "scenes.csv")[0] == {
        "image": "images/2 Green Ovals!/0.png",
        "class": "n2_green_ovals",
        "look": "n2_green_ovals",
        "split": rows_of(data / "scenes.csv")[0]["split"],
    }
    assert run("check", folder, "--data", data).code == 0
    _see_little(folder)
    assert run("train", folder, "--data", data, "--out", tmp_path / "model").code == 0
    evaluated = json.loads(run("evaluate", tmp_path / "model", "--data", data, "--json").out)
    assert evaluated["classification_accuracy"] == 1.0
    asked = run("ask", tmp_path / "model", data / "images/blue/1.png", "why is it blue?")
    assert asked.out.startswith("The picture looks blue.")


def test_the_look_for_a_dataset_that_lacks_it(tmp_path: Path, run: Run) -> None:
    """The dataset is not changed; the command that is said makes one that fits."""
    source = draw_all(tmp_path / "s", ["cats/1.png", "dogs/1.png"])
    run("data", "import", "folder", source, "--out", tmp_path / "d")
    before = (tmp_path / "d/scenes.csv").read_text()
    result = run("new", tmp_path / "pets", "--from", tmp_path / "d")
    command = result.out.splitlines()[2].strip()
    assert command == (
        f"seewhy data import table {tmp_path}/d --features {tmp_path}/pets/classes.csv "
        f"--out {tmp_path}/pets_data"
    )
    assert run(*command.split()[1:]).code == 0
    assert (tmp_path / "d/scenes.csv").read_text() == before
    dataset = Dataset.load(tmp_path / "pets_data", load_domain(tmp_path / "pets"))
    assert dataset.vectors == [("cats",), ("dogs",)]


def test_from_an_export_the_format_is_found(tmp_path: Path, run: Run) -> None:
    draw_all(tmp_path / "s", ["1.jpg", "2.jpg", "3.jpg"])
    write_json(
        tmp_path / "s/instances.json",
        coco(
            [{"id": n, "file_name": f"{n}.jpg"} for n in (1, 2, 3)],
            [{"image_id": n, "category_id": n % 2 + 1, "bbox": [0, 0, 9, 9]} for n in (1, 2, 3)],
        ),
    )
    result = run("new", tmp_path / "pets", "--from", tmp_path / "s", "--json")
    assert result.code == 0
    made = json.loads(result.out)
    assert (made["classes"], made["features"], made["axioms"], made["has_look"]) == (2, 1, 0, True)
    assert made["files"] == [
        "README.md", "classes.csv", "domain.toml", "knowledge.al", "questions.toml"
    ]  # fmt: skip
    assert made["commands"][1].startswith("seewhy data import coco ")
    assert list(load_domain(tmp_path / "pets").classes) == ["cat", "dog"]


def test_a_table_beside_class_folders_that_lists_no_pictures(tmp_path: Path, run: Run) -> None:
    source = draw_all(tmp_path / "s", ["cats/1.png", "dogs/1.png"])
    write(source / "people.csv", "name,age\nAnn,3\n")
    made = json.loads(run("new", tmp_path / "a", "--from", source, "--json").out)
    assert made["commands"][1].startswith("seewhy data import folder ")
    write(source / "labels.csv", "name,kind\n1,cats\n")
    draw(source / "1.png")
    asked = run("new", tmp_path / "b", "--from", source, "--json")
    assert asked.code == 2
    assert "one class only ('cats')" in asked.err


def test_classes_that_the_table_does_not_tell_apart(tmp_path: Path, run: Run) -> None:
    source = draw_all(tmp_path / "s", ["cat/1.png", "lynx/1.png", "dog/1.png"])
    features = write(tmp_path / "t.csv", "class,purrs\ncat,yes\nlynx,yes\ndog,no\n")
    result = run("new", tmp_path / "pets", "--from", source, "--features", features)
    assert result.code == 0
    assert "classes that have the same features: cat, lynx" in result.err
    knowledge = (tmp_path / "pets/knowledge.al").read_text()
    assert "% Nothing in classes.csv tells cat from lynx: the pictures have to." in knowledge
    assert "of_kind(S, dog) if -purrs(S)." in knowledge
    assert run("check", tmp_path / "pets").code == 0


# What is wrong ---------------------------------------------------------------------------------


def test_it_complains(tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    draw_all(tmp_path / "one", ["cats/1.png"])
    draw_all(tmp_path / "none", ["1.png"])
    draw_all(tmp_path / "two", ["cats/1.png", "dogs/1.png"])
    (tmp_path / "empty").mkdir()
    cases = {
        ("new", "x", "--features", "t.csv"): "--features goes with --from SOURCE, which names the "
        "labelled pictures; add it",
        ("new", "X", "--from", "two"): "'X' cannot name a domain; use small letters, digits and "
        "underscores, beginning with a letter",
        ("new", "two", "--from", "two"): "two: exists already; choose another name",
        ("new", "x", "--from", "one"): "one: says one class only ('cats'); a domain tells at least "
        "two classes apart: add pictures of another, or name what says the class (--class-column, "
        "--class, --inside)",
        ("new", "x", "--from", "none"): "none: says no class; a domain tells at least two classes "
        "apart: add pictures of another, or name what says the class (--class-column, --class, "
        "--inside)",
        ("new", "x", "--from", "empty"): "empty: holds no pictures and no export that is read "
        "(class folders, COCO, Pascal VOC, YOLO, Label Studio, CVAT for images, a table with a row "
        "a picture); name the folder, archive or file that does",
        ("new", "x", "--from", "nowhere"): "nowhere: there is no such file or folder; check the "
        "path",
        ("new", "x", "--from", "two", "--format", "fold"): "'fold' is no format that is imported; "
        "did you mean 'folder'?",
        (
            "new",
            "x",
            "--from",
            "two",
            "--subject",
            "!",
        ): "--subject '!' has no word; write one such as 'the apple'",
        ("new", "x", "--from", "two", "--subject", "the"): "--subject 'the' has no word; write "
        "one such as 'the apple'",
    }
    before = sorted(tmp_path.iterdir())
    for arguments, expected in cases.items():
        result = run(*arguments)
        assert (result.code, result.out) == (2, "")
        assert result.err.splitlines()[-1] == f"seewhy: {expected}"
        assert sorted(tmp_path.iterdir()) == before


# Any words -------------------------------------------------------------------------------------

WORDS = st.text(min_size=1, max_size=12)


@settings(max_examples=25)
@given(
    classes=st.lists(WORDS, min_size=2, max_size=4, unique=True),
    features=st.lists(WORDS, min_size=1, max_size=3, unique=True),
    values=st.lists(WORDS, min_size=1, max_size=3, unique=True),
    subject=st.sampled_from(["the picture", "the kind", "it", "the big look", "the thing"]),
)
@example(classes=["0", "00"], features=["A"], values=["0"], subject="the picture")
@example(classes=["the", "a"], features=["★", "the"], values=["an", "!"], subject="it")
def test_whatever_the_words_the_domain_works(
    tmp_path_factory: pytest.TempPathFactory,
    classes: list[str],
    features: list[str],
    values: list[str],
    subject: str,
) -> None:
    """It passes the check, and every question that it has can be answered."""
    from seewhy.data.annotation_formats import format_called
    from seewhy.data.importers.annotation import AnnotatedPicture, Notes
    from seewhy.data.importers.folder_files import FolderFiles
    from seewhy.data.importers.reading import ReadSource
    from seewhy.data.importers.request import ImportRequest
    from seewhy.data.importers.vocabulary import vocabulary_of
    from seewhy.new_domain.sketch import sketch_of

    home = tmp_path_factory.mktemp("words")
    pictures = [
        AnnotatedPicture(
            f"{number}.jpg", label, dict.fromkeys(features, values[number % len(values)])
        )
        for number, label in enumerate(classes)
    ]
    vocabulary = vocabulary_of(pictures, None, Notes())
    if len(vocabulary.class_words) < 2:
        return
    read = ReadSource(
        ImportRequest(home, "folder"), format_called("folder"), tuple(pictures), vocabulary, None,
        FolderFiles(home),
    )  # fmt: skip
    sketch = sketch_of(read, name="words", subject=subject)
    write_domain_of(sketch, home / "words", classes_table="", commands=[], data="data")
    agent = Agent(load_domain(home / "words"))
    values_of = [feature.values[0] for feature in agent.domain.features.values()]
    for question in agent.questions.one_of_each()[:12]:
        assert agent.answer(seen(agent, *values_of), question).text


def test_a_class_and_a_value_may_be_called_like_what_is_shown(tmp_path: Path) -> None:
    table = "class,shape\napple,apple\npear,long\n"
    named = NamedDomain(("apple", "pear"), {}, table, subject="the apple")
    domain_from_names(named, tmp_path / "fruit", data="photos")
    domain = load_domain(tmp_path / "fruit")
    assert list(map(str, domain.knowledge.axioms)) == [
        "of_kind(S, apple) if shape(S, apple).",
        "of_kind(S, pear) if shape(S, long).",
    ]
    agent = Agent(domain)
    why = agent.answer(seen(agent, "apple"), agent.questions.understand("why is it an apple?"))
    assert why.text == "The shape of the apple is apple."


def test_long_names_are_written_as_they_are_read(tmp_path: Path) -> None:
    """The line of a sort is broken behind a value, however long its name is."""
    question = (
        "is there any damage that somebody can see on the left side of the car below the door"
    )
    named = NamedDomain(("good", "bad"), {question: ("none at all", "a little", question)})
    domain_from_names(named, tmp_path / "cars", data="photos")
    (feature,) = load_domain(tmp_path / "cars").features.values()
    assert len(feature.values) == 3


@pytest.mark.parametrize(
    ("subject", "scene"),
    [("the car a", "car"), ("the apple, please", "apple"), ("the ★ hat", "hat")],
)
def test_the_scene_is_the_last_word_that_says_something(
    tmp_path: Path, subject: str, scene: str
) -> None:
    named = NamedDomain(("good", "bad"), {"colour": ("red", "green")}, subject=subject)
    domain_from_names(named, tmp_path / "things", data="photos")
    assert load_domain(tmp_path / "things").scene == scene


@pytest.mark.parametrize("subject", ["the", "★", "er", "honestly, the", "_"])
def test_a_subject_that_says_nothing_is_refused(tmp_path: Path, subject: str) -> None:
    named = NamedDomain(("good", "bad"), {"colour": ("red", "green")}, subject=subject)
    with pytest.raises(DomainError) as problem:
        domain_from_names(named, tmp_path / "things", data="photos")
    assert str(problem.value) == f"'{subject}' has no word; write one such as 'the apple'"


# Proposals -------------------------------------------------------------------------------------

TABLES = st.integers(1, 4).flatmap(
    lambda width: st.lists(
        st.tuples(*[st.sampled_from(["a", "b", "no", ""])] * width), min_size=2, max_size=8
    )
)


@given(TABLES)
def test_proposals_tell_each_class_from_all_others(rows: list[tuple[str, ...]]) -> None:
    classes = {
        f"c{number}": {f"f{n}": value for n, value in enumerate(row) if value}
        for number, row in enumerate(rows)
    }
    found = proposals(classes)
    assert found.told_by.keys() | found.alike.keys() == classes.keys()
    for name, values in found.told_by.items():
        assert values.items() <= classes[name].items()
        for other, its in classes.items():
            differs = any(its.get(feature, value) != value for feature, value in values.items())
            assert differs or other == name
        # none of them can be done without
        for left_out in values:
            fewer = {k: v for k, v in values.items() if k != left_out}
            assert any(
                all(its.get(feature, value) == value for feature, value in fewer.items())
                for other, its in classes.items()
                if other != name
            )
    for name, other in found.alike.items():
        assert all(classes[other].get(k, v) == v for k, v in classes[name].items())


def test_many_features_are_told_apart_in_no_time() -> None:
    """Forty features of two hundred classes: all choices are too many to try."""
    classes = {
        f"c{number}": {f"f{bit}": "yes" if number * 7919 >> bit & 1 else "no" for bit in range(40)}
        for number in range(200)
    }
    found = proposals(classes)
    assert found.told_by.keys() == classes.keys()


def test_the_axioms_decide_every_class_of_their_table(tmp_path: Path) -> None:
    shapes, hues = ("round", "square", "flat"), ("red", "green", "blue")
    names = {f"{shape}_{hue}": (shape, hue) for shape, hue in product(shapes, hues)}
    sketch = Sketch(
        name="things",
        classes={name: name for name in names},
        features={
            "shape": SketchFeature("shape", {shape: shape for shape in shapes}),
            "hue": SketchFeature("hue", {hue: hue for hue in hues}),
        },
        class_values={name: {"shape": s, "hue": h} for name, (s, h) in names.items()},
    )
    write_domain_of(sketch, tmp_path / "things", classes_table="", commands=[], data="data")
    domain = load_domain(tmp_path / "things")
    reasoner = Reasoner(domain.knowledge, domain.schema)
    for name, (shape, hue) in names.items():
        decision = reasoner.decide(domain.vector({"shape": shape, "hue": hue}))
        assert decision.label == name


def test_set_cards_where_they_are(tmp_path: Path, run: Run) -> None:
    archive = Path(__file__).parents[2] / "shared/data/set_cards.zip"
    if not archive.exists():
        pytest.skip("the photographs of cards are not here")
    result = run(
        "new", tmp_path / "cards", "--from", archive, "--class-parts",
        "number-colour-shading-shape", "--subject", "the card",
    )  # fmt: skip
    assert result.code == 0
    domain = load_domain(tmp_path / "cards")
    assert {key: feature.values for key, feature in domain.features.items()} == {
        "number": ("1", "2", "3"),
        "colour": ("green", "purple", "red"),
        "shading": ("empty", "solid", "striped"),
        "shape": ("diamond", "oval", "squiggle"),
    }
    assert check_domain(domain).verdicts == {"believed": 1.0}
