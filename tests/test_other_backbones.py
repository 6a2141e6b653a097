"""Backbones of other libraries and of files; each test is skipped where its library is not."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest
import torch
from torch import nn

from seewhy.errors import DomainError, ModelError
from seewhy.perception.backbones import load_backbone, require_backbone
from seewhy.perception.backbones.frozen import FrozenBackbone
from seewhy.perception.backbones.libraries import Observed, observed
from seewhy.perception.fitting_eyes import fit_eyes
from seewhy.perception.lesson import Lesson

PICTURES = np.random.default_rng(0).integers(0, 256, (3, 160, 160, 3), dtype=np.uint8)


def test_of_each_of_the_last_resolutions_the_last_map_is_looked_at() -> None:
    model = nn.Sequential(
        nn.Conv2d(3, 2, 3, stride=2, padding=1),  # 16
        nn.Conv2d(2, 4, 3, stride=2, padding=1),  # 8
        nn.ReLU(),
        nn.Conv2d(4, 4, 3, stride=2, padding=1),  # 4
        nn.Conv2d(4, 5, 3, stride=2, padding=1),  # 2
        nn.BatchNorm2d(5),
        nn.AdaptiveAvgPool2d(1),
        nn.Flatten(),
    ).eval()
    assert observed(model, side=32) == ["2", "3", "5"]


def test_threads_that_look_at_once_see_their_own_pictures() -> None:
    torch.manual_seed(0)
    model = nn.Sequential(
        nn.Conv2d(3, 6, 3, stride=4, padding=1), nn.Conv2d(6, 8, 3, stride=2, padding=1)
    ).eval()
    backbone = FrozenBackbone(
        name="two layers", digest="", side=64, look=Observed(model, observed(model, side=64))
    )
    pictures = np.random.default_rng(0).integers(0, 256, (200, 64, 64, 3), dtype=np.uint8)
    alone = np.concatenate([backbone.embed(pictures[n : n + 8]).pooled for n in range(0, 200, 8)])
    before = torch.get_num_threads()
    torch.set_num_threads(4)
    try:
        for _ in range(3):
            np.testing.assert_array_equal(backbone.embed(pictures).pooled, alone)
    finally:
        torch.set_num_threads(before)


def test_timm_names_a_backbone(monkeypatch: pytest.MonkeyPatch) -> None:
    timm = pytest.importorskip("timm", reason="timm is not installed")
    made = timm.create_model
    torch.manual_seed(0)
    # Untrained: what it was trained to see is not to be fetched in a test.
    monkeypatch.setattr(timm, "create_model", lambda name, **_: made(name))
    backbone = load_backbone("timm:resnet18", device="cpu")
    assert not backbone.tunable
    embedded = backbone.embed(PICTURES)
    assert embedded.pooled.shape == (3, 128 * 25 + 256 * 9 + 512)
    assert embedded.middle.shape == (3, 0, 0, 0)
    np.testing.assert_allclose(backbone.embed(PICTURES[:1]).pooled, embedded.pooled[:1], atol=0.02)
    lesson = Lesson(
        batches=lambda: iter([PICTURES]),
        labels={"colour": ["red", "blue", "red"]},
        values={"colour": ("red", "blue")},
        strata=["a", "b", "a"],
        groups=["1", "2", "3"],
    )
    assert fit_eyes(backbone, lesson).eyes.tail is None
    with pytest.raises(DomainError, match="timm has no network of this name"):
        load_backbone("timm:resnet1800")


def test_weights_that_cannot_be_fetched(monkeypatch: pytest.MonkeyPatch) -> None:
    models = pytest.importorskip("torchvision.models", reason="torchvision is not installed")

    def offline(*_: object, **__: object) -> None:
        raise OSError("no network")

    monkeypatch.setattr(models, "get_model", offline)
    with pytest.raises(ModelError) as problem:
        load_backbone("torchvision:resnet18")
    assert str(problem.value) == (
        "the weights of torchvision:resnet18 cannot be fetched (no network): try again with a "
        "network, or take other eyes"
    )
    with pytest.raises(DomainError, match="torchvision has no network of this name"):
        load_backbone("torchvision:resnet")


def test_an_onnx_file_is_a_backbone(tmp_path: Path) -> None:
    onnx = pytest.importorskip("onnx", reason="onnx is not installed")
    pytest.importorskip("onnxruntime", reason="onnxruntime is not installed")
    helper, float_ = onnx.helper, onnx.TensorProto.FLOAT
    graph = helper.make_graph(
        [helper.make_node("AveragePool", ["x"], ["y"], kernel_shape=[8, 8], strides=[8, 8])],
        "means",
        [helper.make_tensor_value_info("x", float_, ["n", 3, 32, 32])],
        [helper.make_tensor_value_info("y", float_, ["n", 3, 4, 4])],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8)
    file = tmp_path / "means.onnx"
    file.write_bytes(model.SerializeToString())
    backbone = load_backbone(f"onnx:{file}")
    assert backbone.side == 32
    white = np.full((2, 32, 32, 3), 255, dtype=np.uint8)
    found = backbone.embed(white).pooled
    np.testing.assert_allclose(found[0], [2.249, 2.429, 2.64], atol=0.002)
    file.write_bytes(b"no network")
    with pytest.raises(ModelError, match="is no network of pictures"):
        load_backbone(f"onnx:{file}")
    with pytest.raises(DomainError, match="there is no such file"):
        load_backbone(f"onnx:{tmp_path / 'none.onnx'}")


@pytest.mark.parametrize("library", ["timm", "torchvision", "onnxruntime"])
def test_a_library_that_is_not_installed(library: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    family = "onnx" if library == "onnxruntime" else library
    with pytest.raises(DomainError, match=f"which is not installed: pip install {library}"):
        load_backbone(f"{family}:resnet18")


def test_naming_a_backbone_loads_nothing() -> None:
    before = set(sys.modules)
    importlib.reload(sys.modules["seewhy.perception.backbones.registry"])
    require_backbone("timm:resnet18")
    assert not {"timm", "torchvision", "onnxruntime"} & (set(sys.modules) - before)
