"""Tasks side by side: in processes, or handed to Ray where a cluster is named."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import joblib.parallel
import pytest
from joblib import register_parallel_backend
from joblib.parallel import SequentialBackend

from seewhy.errors import ExperimentError
from seewhy_lab.experiments.jobs import RAY, run_all


def write(folder: Path, number: int) -> None:
    (folder / str(number)).write_text(str(number))


def test_all_calls_are_made_and_counted(tmp_path: Path) -> None:
    assert list(run_all(write, [(tmp_path, n) for n in range(5)], jobs=2)) == [1, 2, 3, 4, 5]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["0", "1", "2", "3", "4"]
    assert list(run_all(write, [], jobs=2)) == []


class Cluster(SequentialBackend):
    """What joblib sees of Ray: it returns nothing before all is done."""

    supports_return_generator = False
    asked: tuple[int, ...] = ()

    def configure(self, n_jobs: int = 1, *_: object, **__: object) -> int:
        type(self).asked += (n_jobs,)
        return 1


@pytest.fixture
def ray(monkeypatch: pytest.MonkeyPatch) -> Any:
    """What SeeWhy needs of Ray."""
    ray: Any = ModuleType("ray")
    ray.is_initialized = lambda: False
    ray.init = lambda: None
    of_joblib: Any = ModuleType("ray.util.joblib")
    of_joblib.register_ray = lambda: register_parallel_backend("ray", Cluster)
    monkeypatch.setitem(sys.modules, "ray", ray)
    monkeypatch.setitem(sys.modules, "ray.util", ModuleType("ray.util"))
    monkeypatch.setitem(sys.modules, "ray.util.joblib", of_joblib)
    monkeypatch.setitem(joblib.parallel.BACKENDS, "ray", Cluster)
    monkeypatch.setattr(Cluster, "asked", ())
    return ray


@pytest.mark.usefixtures("ray")
def test_a_cluster_that_is_named_is_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert list(run_all(write, [(tmp_path, 1)], jobs=3)) == [1]
    assert Cluster.asked == ()
    monkeypatch.setenv(RAY, "auto")
    assert list(run_all(write, [(tmp_path, n) for n in range(2, 4)], jobs=3)) == [1, 2]
    assert Cluster.asked == (3,)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["1", "2", "3"]


def test_a_cluster_that_is_not_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ray: Any
) -> None:
    def refuse() -> None:
        raise ConnectionError("Failed to connect to Ray cluster")

    ray.init = refuse
    monkeypatch.setenv(RAY, "somewhere:6379")
    says = "RAY_ADDRESS: the Ray cluster 'somewhere:6379' does not answer or does not let this"
    with pytest.raises(ExperimentError, match=says):
        list(run_all(write, [(tmp_path, 1)], jobs=1))
    # Who is connected already stays so.
    ray.is_initialized = lambda: True
    assert list(run_all(write, [(tmp_path, 1)], jobs=1)) == [1]


def test_without_ray_a_named_cluster_changes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    monkeypatch.setenv(RAY, "auto")
    assert list(run_all(write, [(tmp_path, 1)], jobs=1)) == [1]
