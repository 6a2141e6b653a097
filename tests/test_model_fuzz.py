"""Models that a stranger made: whatever stands in them, with digests that fit, one sentence."""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Callable, Iterator
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
import torch
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from safetensors.torch import load, save

from conftest import draw_tile
from seewhy.agent.agent import Agent
from seewhy.agent.manifest_file import _digest, _digest_of
from seewhy.errors import ModelError, SeeWhyError

JSON = (
    "model.json",
    "experience.json",
    "induction/tree.json",
    "dialogue/answers.json",
    "perception/perception.json",
)
WEIGHTS = {
    "dialogue/answers.safetensors": "dialogue/answers.json",
    "perception/perception.safetensors": "perception/perception.json",
}
Place = tuple[str | int, ...]


def signed(folder: Path) -> None:
    """Write all digests anew, as who wants a model to be read would."""
    for weights, described in WEIGHTS.items():
        file = folder / described
        try:
            found = json.loads(file.read_text())
            found["digest"] = _digest(folder / weights)
            file.write_text(json.dumps(found))
        except (ValueError, TypeError, RecursionError):
            continue
    file = folder / "model.json"
    try:
        manifest = json.loads(file.read_text())
        manifest.pop("digest", None)
        if isinstance(manifest["files"], dict):
            manifest["files"] |= {
                name: _digest(folder / name)
                for name in manifest["files"]
                if (folder / name).is_file()
            }
        file.write_text(json.dumps({**manifest, "digest": _digest_of(manifest)}))
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return


def places(value: Any, here: Place = ()) -> Iterator[Place]:
    """Every place in a JSON value; of a long list only the first few."""
    yield here
    inside = value.items() if isinstance(value, dict) else ()
    inside = enumerate(value[:3]) if isinstance(value, list) else inside
    for key, part in inside:
        yield from places(part, (*here, key))


def put(value: Any, place: Place, new: Any) -> Any:
    """The value with another one at a place; without the place where that is ``...``."""
    if not place:
        return None if new is ... else new
    part = value[place[0]]
    if len(place) == 1 and new is ...:
        del value[place[0]]
    else:
        value[place[0]] = put(part, place[1:], new)
    return value


DEEP = "a value in thousands of lists"
OTHER = st.one_of(
    st.none(),
    st.just(...),
    st.booleans(),
    st.sampled_from([0, -1, 1, 2, 7, 10**6, 2**31, 2**63, -(2**70), 10**400]),
    st.sampled_from([0.0, 0.5, -0.5, 1e308, float("nan"), float("inf")]),
    st.sampled_from(["", "a", "red", "good", "yes", "1", "../../x", "{it}", "\x1b[2J", "x" * 5000]),
    st.sampled_from([[], {}, [[]], [None], {"a": 1}, [1, "a"], ["red", "red"]]),
    st.just(DEEP),
)


def works_or_is_refused(folder: Path) -> None:
    """A model either answers or is refused in one sentence that names its folder."""
    said = ""
    try:
        agent = Agent.load(folder)
        reply = agent.ask(draw_tile("red", "yes", 0), "why is it good?")
        agent.ask(draw_tile("blue", "no", 1), "what would make it good?")
        json.dumps(reply.to_dict(), allow_nan=False)
        agent.tree.root()
    except SeeWhyError as problem:
        said = str(problem)
    assert len(said.splitlines()) <= 1
    assert len(said) < 1200


@pytest.fixture
def spoiling(model_folder: Path, tmp_path: Path) -> Callable[[], Path]:
    """Copies of the model, each in place of the last."""

    def copy() -> Path:
        shutil.rmtree(tmp_path / "model", ignore_errors=True)
        return Path(shutil.copytree(model_folder, tmp_path / "model"))

    return copy


FUZZ = settings(
    max_examples=60,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@FUZZ
@given(data=st.data())
def test_whatever_stands_in_its_json(data: st.DataObject, spoiling: Callable[[], Path]) -> None:
    folder = spoiling()
    name = data.draw(st.sampled_from(JSON))
    content = json.loads((folder / name).read_text())
    for _ in range(data.draw(st.integers(1, 2))):
        place = data.draw(st.sampled_from(list(places(content))))
        content = put(content, place, deepcopy(data.draw(OTHER)))
    text = json.dumps(content).replace(f'"{DEEP}"', "[" * 5000 + "]" * 5000)
    (folder / name).write_text(text)
    signed(folder)
    works_or_is_refused(folder)


@settings(FUZZ, max_examples=25)
@given(data=st.data())
def test_whatever_weights_it_has(data: st.DataObject, spoiling: Callable[[], Path]) -> None:
    folder = spoiling()
    file = folder / data.draw(st.sampled_from(sorted(WEIGHTS)))
    tensors = load(file.read_bytes())
    name = data.draw(st.sampled_from(sorted(tensors)))
    kinds: dict[str, Callable[[torch.Tensor], torch.Tensor]] = {
        "nan": lambda tensor: torch.full_like(tensor.float(), float("nan")).to(tensor.dtype),
        "infinite": lambda tensor: torch.full_like(tensor.float(), float("inf")).to(tensor.dtype),
        "large": lambda tensor: torch.full_like(tensor.float(), 3e38).to(tensor.dtype),
        "nothing": torch.zeros_like,
        "double": lambda tensor: tensor.double(),
        "whole": lambda tensor: tensor.to(torch.int8),
        "longer": lambda tensor: torch.cat([tensor.flatten(), tensor.flatten()]),
        "flat": lambda tensor: tensor.flatten(),
        "empty": lambda tensor: tensor.flatten()[:0],
    }
    kind = data.draw(st.sampled_from([*kinds, "missing", "renamed"]))
    if kind in kinds:
        tensors[name] = kinds[kind](tensors[name]).contiguous()
    else:
        tensor = tensors.pop(name)
        if kind == "renamed":
            tensors["other/weight"] = tensor
    file.write_bytes(save(tensors))
    signed(folder)
    works_or_is_refused(folder)


@settings(FUZZ, max_examples=25)
@given(data=st.data())
def test_whatever_bytes_its_files_have(data: st.DataObject, spoiling: Callable[[], Path]) -> None:
    folder = spoiling()
    names = sorted(p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file())
    file = folder / data.draw(st.sampled_from(names))
    content = bytearray(file.read_bytes())
    at = data.draw(st.integers(0, len(content) - 1))
    match data.draw(st.sampled_from(["cut", "byte", "twice"])):
        case "cut":
            del content[at:]
        case "byte":
            content[at] = data.draw(st.integers(0, 255))
        case "twice":
            content += content[at:]
    file.write_bytes(content)
    signed(folder)
    works_or_is_refused(folder)


def test_weights_that_are_no_numbers_are_named(spoiling: Callable[[], Path]) -> None:
    folder = spoiling()
    file = folder / "perception" / "perception.safetensors"
    tensors = load(file.read_bytes())
    tensors["colour/head.1.bias"][0] = float("nan")
    file.write_bytes(save(tensors))
    signed(folder)
    with pytest.raises(ModelError) as problem:
        Agent.load(folder)
    assert str(problem.value) == (
        f"{file} does not hold the weights that {folder}/perception/perception.json describes "
        "(colour/head.1.bias holds what is no number): train the model again, or copy its folder "
        "again from where it is whole"
    )


def test_what_is_described_larger_than_it_is_takes_no_memory(spoiling: Callable[[], Path]) -> None:
    folder = spoiling()
    file = folder / "dialogue" / "answers.json"
    described = json.loads(file.read_text())
    file.write_text(json.dumps({**described, "layers": 8, "width": 4096, "embedding": 4096}))
    signed(folder)
    with pytest.raises(
        ModelError, match=r"\(dense\.bias must be of shape \(4096,\), got \(48,\)\)"
    ):
        Agent.load(folder)


def test_no_file_outside_of_the_model_is_read(spoiling: Callable[[], Path]) -> None:
    folder = spoiling()
    secret = folder.parent / "secret"
    secret.write_text("secret")
    manifest = json.loads((folder / "model.json").read_text())
    manifest["files"]["../secret"] = hashlib.sha256(b"secret").hexdigest()
    (folder / "model.json").write_text(json.dumps(manifest))
    signed(folder)
    with pytest.raises(ModelError) as problem:
        Agent.load(folder)
    assert str(problem.value) == (
        f"{folder}/model.json is damaged (files: '../secret' is no file of a model): train it again"
    )


@pytest.mark.parametrize(
    ("name", "size", "wrong"),
    [
        ("perception/perception.safetensors", 2 << 30, "is larger than any file of a model"),
        ("experience.json", 65 << 20, "has more than 64 MiB, which no model has"),
    ],
)
def test_a_huge_file_is_refused(
    spoiling: Callable[[], Path], name: str, size: int, wrong: str
) -> None:
    folder = spoiling()
    with (folder / name).open("r+b") as stream:
        stream.truncate(size)  # of nothing: it takes no room on the disk
    if size < 1 << 30:
        signed(folder)
    with pytest.raises(ModelError) as problem:
        Agent.load(folder)
    assert str(problem.value) == f"{folder}/{name} {wrong}: train it again"
