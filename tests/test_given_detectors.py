"""Detectors of the user's own: what they give is checked, and how long they take is bounded."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from seewhy.domain.domain import load_domain
from seewhy.errors import DomainError, ModelError
from seewhy.perception.things.given_detector import FunctionDetector, OnnxDetector, as_detector
from things_builder import write_domain

PICTURE = Image.new("RGB", (80, 40))


def test_boxes_of_a_function_are_taken_and_cut_to_the_picture() -> None:
    found = as_detector(lambda _: ([[0, 0, 10, 10], [60, 20, 200, 90]], [0.3, 0.8])).find(PICTURE)
    assert found.boxes.tolist() == [[60, 20, 80, 40], [0, 0, 10, 10]]
    assert found.scores.tolist() == [0.8, 0.3]


def test_a_picture_comes_as_rows_columns_and_colours() -> None:
    seen: list[tuple[int, ...]] = []

    def find(picture: Any) -> tuple[list[Any], list[Any]]:
        seen.append(picture.shape)
        picture[:] = 0  # the picture that is looked at stays as it is
        return [], []

    white = Image.new("RGB", (80, 40), "white")
    assert not len(FunctionDetector(find).find(white).boxes)
    assert seen == [(40, 80, 3)]
    assert white.getpixel((0, 0)) == (255, 255, 255)


@pytest.mark.parametrize(
    ("find", "said"),
    [
        (lambda _: None, "must return boxes of shape"),
        (lambda _: ([[0, 0, 1]], [0.5]), r"got shapes \(1, 3\) and \(1,\)"),
        (lambda _: ([[0, 0, 9, 9]], [0.5, 0.5]), r"got shapes \(1, 4\) and \(2,\)"),
        (lambda _: ([[0, 0, 9, float("nan")]], [0.5]), "got what is no number"),
        (lambda _: ([[0, 0, 9, 9]], [7]), "got scores from 7 to 7"),
        (lambda _: ([[9, 0, 0, 9]], [0.5]), "right is not more than its left"),
        (lambda _: (np.ones((20_000, 4)) * [0, 0, 9, 9], np.ones(20_000)), "more than 10,000"),
        (lambda _: ("many", "things"), "must return boxes of shape"),
        (lambda _: 1 / 0, "fails .ZeroDivisionError: division by zero.: mend it, or give boxes"),
    ],
)
def test_what_is_no_answer_is_said(find: Callable[[Any], Any], said: str) -> None:
    with pytest.raises(ModelError, match=said):
        FunctionDetector(find).find(PICTURE)


def test_a_detector_that_hangs_is_given_up() -> None:
    start = time.monotonic()
    with pytest.raises(ModelError, match=r"gave no answer within 0\.1 seconds: use a faster one"):
        FunctionDetector(lambda _: time.sleep(20), seconds=0.1).find(PICTURE)
    assert time.monotonic() - start < 10


# In an ONNX file: a stand-in for onnxruntime, which is not needed to build and test SeeWhy -------


class _Session:
    """Gives what a test says."""

    shape: tuple[Any, ...] = (1, 3, 64, 64)
    answer: Callable[[Any, Any], list[Any]]

    def __init__(self, content: bytes, *_: Any, **__: Any) -> None:
        if content == b"damaged":
            raise ValueError("protobuf parsing failed")

    def get_inputs(self) -> list[Any]:
        return [SimpleNamespace(name="picture", shape=list(self.shape))]

    def get_outputs(self) -> list[Any]:
        return [SimpleNamespace(), SimpleNamespace()]

    def run(self, _: Any, inputs: dict[str, Any], options: Any) -> list[Any]:
        return type(self).answer(inputs["picture"], options)


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch) -> type[_Session]:
    stand_in = type("Session", (_Session,), {})
    module = SimpleNamespace(
        InferenceSession=stand_in,
        SessionOptions=SimpleNamespace,
        RunOptions=lambda: SimpleNamespace(terminate=False),
    )
    monkeypatch.setitem(sys.modules, "onnxruntime", module)
    return stand_in


def _file(folder: Path, content: bytes = b"network") -> Path:
    (folder / "boxes.onnx").write_bytes(content)
    return folder / "boxes.onnx"


def test_boxes_of_a_network_are_in_pixels_of_the_picture(
    session: type[_Session], tmp_path: Path
) -> None:
    def answer(shown: Any, _: Any) -> list[Any]:
        assert shown.shape == (1, 3, 64, 64)
        return [np.array([[[8.0, 4, 16, 20]]]), np.array([[0.7]])]

    session.answer = staticmethod(answer)
    found = OnnxDetector(_file(tmp_path)).find(PICTURE)
    assert found.boxes.round(3).tolist() == [[10, 5, 20, 25]]
    assert found.scores.tolist() == [0.7]


def test_a_network_that_fails_hangs_or_returns_nonsense_is_said(
    session: type[_Session], tmp_path: Path
) -> None:
    detector = OnnxDetector(_file(tmp_path), seconds=0.05)

    def fails(_: Any, __: Any) -> list[Any]:
        raise RuntimeError("a kernel is missing")

    def hangs(_: Any, options: Any) -> list[Any]:
        while not options.terminate:
            time.sleep(0.01)
        raise RuntimeError("exiting due to terminate flag")

    session.answer = staticmethod(fails)
    with pytest.raises(ModelError, match=r"boxes\.onnx fails: a kernel is missing"):
        detector.find(PICTURE)
    session.answer = staticmethod(hangs)
    with pytest.raises(ModelError, match=r"gave no answer within 0\.05 seconds"):
        detector.find(PICTURE)
    session.answer = staticmethod(lambda _, __: [np.zeros((1, 7)), np.zeros(1)])
    with pytest.raises(ModelError, match=r"boxes\.onnx' must return boxes of shape"):
        detector.find(PICTURE)


def test_a_file_that_is_no_such_network_is_refused(session: type[_Session], tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="is no network that finds boxes: protobuf"):
        OnnxDetector(_file(tmp_path, b"damaged"))
    session.shape = (1, 7)
    with pytest.raises(ModelError, match="its input is of shape"):
        OnnxDetector(_file(tmp_path))
    with pytest.raises(DomainError, match="there is no such file"):
        OnnxDetector(tmp_path / "none.onnx")


def test_without_onnxruntime_it_is_said_how_to_get_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    with pytest.raises(DomainError, match="pip install onnxruntime"):
        OnnxDetector(_file(tmp_path))


@pytest.mark.parametrize("name", ["../boxes.onnx", "/etc/boxes.onnx", "finder:find", "boxes.py"])
def test_a_folder_names_no_file_elsewhere_and_no_code(tmp_path: Path, name: str) -> None:
    folder = write_domain(tmp_path / "shelf")
    file = folder / "domain.toml"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("most = 5", f'most = 5\ndetector = "{name}"'), encoding="utf-8")
    with pytest.raises(DomainError, match=r"domain\.toml:.*must be the name of an ONNX file"):
        load_domain(folder)
