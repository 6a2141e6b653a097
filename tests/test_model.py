"""Models on disk: whole or not at all, and refused when anything in them has changed."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from conftest import draw_tile, write_domain
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError, ModelError, NotFittedError
from seewhy.evaluation import evaluate

FILES = [
    "dialogue/answers.json",
    "dialogue/answers.safetensors",
    "domain/domain.toml",
    "domain/knowledge.al",
    "domain/questions.toml",
    "experience.json",
    "induction/tree.json",
    "perception/perception.json",
    "perception/perception.safetensors",
]


@pytest.fixture
def copy(model_folder: Path, tmp_path: Path) -> Path:
    """A copy of the model that a test may spoil."""
    return Path(shutil.copytree(model_folder, tmp_path / "model"))


def test_the_files_of_a_model(model_folder: Path) -> None:
    files = {p.relative_to(model_folder).as_posix() for p in model_folder.rglob("*") if p.is_file()}
    manifest = json.loads((model_folder / "model.json").read_text())
    assert sorted(manifest["files"]) == sorted(files - {"model.json"}) == FILES
    assert not [name for name in files if name.endswith((".pkl", ".pickle", ".pt", ".joblib"))]


def test_a_loaded_model_replies_as_the_one_that_was_saved(
    agent: Agent, model_folder: Path, dataset: Dataset
) -> None:
    loaded = Agent.load(model_folder)
    assert (loaded.seed, loaded.minimality) == (agent.seed, agent.minimality)
    assert loaded.trained_on == agent.trained_on
    assert loaded.experience == agent.experience
    for scene in dataset.scenes[:6]:
        for question in agent.questions.one_of_each():
            mine, theirs = (
                agent.ask(scene.picture, question.text),
                loaded.ask(scene.picture, question.text),
            )
            expected = mine.to_dict()
            found = json.loads(
                json.dumps(theirs.to_dict()).replace(
                    str(model_folder / "domain"), str(agent.domain.folder)
                )
            )
            assert found == expected
    again = evaluate(loaded, dataset, questions_per_scene=3)
    assert again == evaluate(agent, dataset, questions_per_scene=3)


def test_a_loaded_model_needs_no_domain_folder(copy: Path) -> None:
    assert Agent.load(copy).domain.folder == copy / "domain"


@pytest.mark.parametrize("name", FILES)
def test_a_missing_file_is_named(copy: Path, name: str) -> None:
    (copy / name).unlink()
    with pytest.raises(ModelError) as problem:
        Agent.load(copy)
    assert str(problem.value) == (
        f"{copy}: the model is incomplete, {name} is missing; train it again"
    )


@pytest.mark.parametrize("name", FILES)
def test_an_edited_file_is_named(copy: Path, name: str) -> None:
    content = bytearray((copy / name).read_bytes())
    content[len(content) // 2] ^= 1
    (copy / name).write_bytes(content)
    with pytest.raises(ModelError) as problem:
        Agent.load(copy)
    assert str(problem.value) == (
        f"{copy}/{name}: has changed since the model was trained; undo the change or train the "
        "model again (knowledge is edited in the domain's own folder)"
    )


def test_an_edited_manifest_is_refused_whichever_byte(copy: Path) -> None:
    path = copy / "model.json"
    whole = path.read_bytes()
    for at in range(0, len(whole), max(1, len(whole) // 150)):
        content = bytearray(whole)
        content[at] = ord("7") if content[at] != ord("7") else ord("8")
        path.write_bytes(content)
        with pytest.raises(ModelError) as problem:
            Agent.load(copy)
        assert str(path) in str(problem.value), at


@pytest.mark.parametrize(
    ("content", "wrong"),
    [
        (b"", " is damaged (its text: EOF while parsing a value at line 1 column 0): "),
        (b"[]", " is damaged (its text: it must be an object): "),
        (b"null", " is damaged (its text: it must be an object): "),
        (b"{}", ": the model has format None, this version reads 5; "),
        (b'{"format": 5, "files": []}', None),
        (b"\xff\xfe", " is damaged (its text: expected value at line 1 column 1): "),
        (b"[" * 9999, " is damaged (its text: recursion limit exceeded at line 1 column 202): "),
        (b'{"format": NaN}', " is damaged (its text: expected value at line 1 column 12): "),
        (b'{"format": %s}' % (b"9" * 5000), None),
    ],
)
def test_a_damaged_manifest(copy: Path, content: bytes, wrong: str | None) -> None:
    (copy / "model.json").write_bytes(content)
    with pytest.raises(ModelError) as problem:
        Agent.load(copy)
    said = str(problem.value)
    assert said.startswith(f"{copy}/model.json")
    assert len(said) < len(str(copy)) + 250
    assert wrong is None or said == f"{copy}/model.json{wrong}train it again"


def test_a_model_of_another_format(copy: Path) -> None:
    manifest = json.loads((copy / "model.json").read_text())
    (copy / "model.json").write_text(json.dumps({**manifest, "format": 99}))
    with pytest.raises(ModelError) as problem:
        Agent.load(copy)
    assert str(problem.value) == (
        f"{copy}/model.json: the model has format 99, this version reads 5; train it again"
    )


def test_a_folder_that_is_no_model(tmp_path: Path, tiles_data: Path) -> None:
    with pytest.raises(ModelError) as problem:
        Agent.load(tmp_path / "nowhere")
    assert str(problem.value) == (
        f"{tmp_path}/nowhere: there is no such model; 'seewhy train' makes one"
    )
    with pytest.raises(ModelError) as problem:
        Agent.load(tiles_data)
    assert str(problem.value) == (
        f"{tiles_data}: is not a model, it has no model.json; give the folder that 'seewhy train "
        "--out' wrote"
    )


def test_a_model_and_data_of_different_domains(
    agent: Agent, tiles_data: Path, structures: Domain
) -> None:
    other = Dataset(scenes=(), domain=structures, folder=tiles_data)
    with pytest.raises(DatasetError) as problem:
        evaluate(agent, other)
    assert str(problem.value) == (
        f"{tiles_data}: the dataset is of the domain 'structure_stability', the model of 'tiles'"
    )
    with pytest.raises(DatasetError, match="'colour' is no feature of the domain"):
        Dataset.load(tiles_data, structures)


def test_an_agent_that_is_not_trained_is_not_saved(tiles: Domain, tmp_path: Path) -> None:
    with pytest.raises(NotFittedError, match="the agent is not trained yet; call fit before save"):
        Agent(tiles).save(tmp_path / "model")
    assert not list(tmp_path.iterdir())


def test_what_is_no_model_is_not_saved_over(agent: Agent, tmp_path: Path) -> None:
    folder = write_domain(tmp_path / "tiles")
    (tmp_path / "file").write_text("mine")
    for target in (folder, tmp_path / "file"):
        with pytest.raises(ModelError) as problem:
            agent.save(target)
        assert str(problem.value) == (
            f"{target}: exists and is not a model; choose another folder for the model"
        )
    assert sorted(p.name for p in tmp_path.iterdir()) == ["file", "tiles"]
    assert (tmp_path / "file").read_text() == "mine"


def test_a_model_replaces_a_model_and_fills_an_empty_folder(agent: Agent, tmp_path: Path) -> None:
    (tmp_path / "model").mkdir()
    for _ in range(2):
        agent.save(tmp_path / "model")
        assert [p.name for p in tmp_path.iterdir()] == ["model"]
    Agent.load(tmp_path / "model")


@pytest.mark.parametrize("failing", ["first", "second"])
def test_an_interrupted_save_leaves_the_old_model_whole(
    agent: Agent, copy: Path, monkeypatch: pytest.MonkeyPatch, failing: str
) -> None:
    before = {p: p.read_bytes() for p in copy.rglob("*") if p.is_file()}
    rename = Path.rename

    def interrupted(self: Path, target: Path) -> Path:
        if self == copy if failing == "first" else self.name == ".model-new":
            raise KeyboardInterrupt
        return rename(self, target)

    monkeypatch.setattr("seewhy.files.folders._exchanged", lambda *_: False)
    monkeypatch.setattr(Path, "rename", interrupted)
    with pytest.raises(KeyboardInterrupt):
        agent.save(copy)
    assert {p: p.read_bytes() for p in copy.rglob("*") if p.is_file()} == before
    assert [p.name for p in copy.parent.iterdir()] == ["model"]
    Agent.load(copy)


def test_a_save_that_fails_while_writing_leaves_nothing(
    agent: Agent, copy: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def fails(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("seewhy.agent.model._experience_text", fails)
    for folder in (copy, tmp_path / "new"):
        with pytest.raises(OSError, match="No space left"):
            agent.save(folder)
    assert [p.name for p in tmp_path.iterdir()] == ["model"]
    assert Agent.load(copy).ask(draw_tile("red", "yes", 0), "is it good?").label == "good"
