"""Tasks run side by side: in processes of this machine, or on the machines of a Ray cluster."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from joblib import Parallel, delayed, parallel_config
from joblib.parallel import get_active_backend

from seewhy.errors import ExperimentError

__all__ = ["RAY", "run_all"]

RAY = "RAY_ADDRESS"
"""The environment variable that names the Ray cluster to use, where Ray is installed."""


def run_all(
    function: Callable[..., None], calls: Iterable[tuple[Any, ...]], *, jobs: int
) -> Iterator[int]:
    """Call a function with many arguments; yield how many calls are done, as they are.

    Parameters
    ----------
    function : callable
        What can be pickled; its result counts for nothing.
    calls : iterable of tuple
        The arguments of every call.
    jobs : int
        Calls at the same time; -1: one a core. Where ``RAY_ADDRESS`` is set and Ray is installed,
        joblib hands the calls to the cluster's machines; how many are done is then known only when
        all are.

    Examples
    --------
    >>> list(run_all(print, [("once",)], jobs=1))
    once
    [1]
    """
    with _backend(jobs):
        backend, _ = get_active_backend()
        parallel = Parallel(
            return_as="generator_unordered" if backend.supports_return_generator else "list"
        )
        tasks = (delayed(function)(*arguments) for arguments in calls)
        yield from (done for done, _ in enumerate(parallel(tasks), start=1))


@contextmanager
def _backend(jobs: int) -> Iterator[None]:
    """Choose joblib's backend: Ray's where a cluster is named and Ray is there."""
    if os.environ.get(RAY):
        try:
            import ray  # type: ignore[import-not-found,unused-ignore]
            from ray.util.joblib import register_ray  # type: ignore[import-not-found,unused-ignore]
        except ImportError:
            pass
        else:
            try:
                if not ray.is_initialized():
                    ray.init()
            except ConnectionError:
                raise ExperimentError(
                    f"{RAY}: the Ray cluster '{os.environ[RAY]}' does not answer or does not let "
                    "this process in; start it, give its token, or unset the variable"
                ) from None
            register_ray()
            with parallel_config(backend="ray", n_jobs=jobs):
                yield
            return
    with parallel_config(n_jobs=jobs):
        yield
