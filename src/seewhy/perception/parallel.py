"""Train the networks of several features at the same time, each in a process of its own."""

from __future__ import annotations

import json
import os
import threading
import time
from collections.abc import Mapping
from concurrent.futures import Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import asdict
from pathlib import Path
from typing import Any

import torch

from seewhy.errors import SeeWhyError
from seewhy.files.folders import scratch_folder
from seewhy.perception.course import QUIETLY, Course
from seewhy.perception.events import FeatureRecord, Progress, TrainingEvent
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.network import GrowingNetwork
from seewhy.perception.one_thread import one_thread
from seewhy.perception.options import TrainingOptions
from seewhy.perception.rehearsal import Rehearsal
from seewhy.perception.training import train_network

__all__ = ["Trained", "train_networks"]

Trained = tuple[GrowingNetwork, FeatureRecord]
_POLL = 0.2  # seconds between looks at how far the processes are


def train_networks(
    shown: LabelledPictures,
    *,
    options: Mapping[str, TrainingOptions],
    start_from: Mapping[str, GrowingNetwork] | None = None,
    rehearsal: Rehearsal | None = None,
    course: Course = QUIETLY,
) -> dict[str, Trained]:
    """Train one network a feature; see :func:`~seewhy.perception.training.train_network`.

    Networks this small gain little from a second thread and lose much where the cores are busy,
    so each is trained on one, and as many at a time as there are ``workers`` (-1: one a core).
    The weights do not depend on the number of workers. Where there is a GPU, features are trained
    one after another.

    Raises
    ------
    DatasetError
        A feature has no label at all, or one that is none of its values.
    SeeWhyError
        A worker process was ended from outside.
    """
    from loky import cpu_count  # counts the cores that this process may use

    earlier = start_from or {}
    arguments: dict[str, dict[str, Any]] = {
        name: {
            "feature": name,
            "options": options[name],
            "start_from": earlier.get(name),
            "rehearsal": rehearsal if name in earlier else None,
        }
        for name in shown.labels
    }
    if not arguments:
        return {}
    at_once = min(len(arguments), cpu_count() if course.workers < 1 else course.workers)
    if at_once < 2 or torch.cuda.is_available():
        return {name: _on_one_thread(shown, of_one, course) for name, of_one in arguments.items()}
    return _in_processes(shown, arguments, at_once, course)


def _on_one_thread(
    shown: LabelledPictures, arguments: Mapping[str, Any], course: Course
) -> Trained:
    with one_thread():
        return train_network(shown, course=course, **arguments)


def _in_processes(
    shown: LabelledPictures,
    arguments: Mapping[str, Mapping[str, Any]],
    at_once: int,
    course: Course,
) -> dict[str, Trained]:
    from loky import ProcessPoolExecutor

    # Processes tell of their progress by lines in files: it works however they were started.
    with scratch_folder() as folder:
        events = {name: folder / f"{number}" for number, name in enumerate(arguments)}
        executor = ProcessPoolExecutor(
            max_workers=at_once, initializer=_end_with, initargs=(os.getpid(),)
        )
        finished = False
        try:
            running: dict[str, Future[Trained]] = {
                name: executor.submit(
                    _train_and_tell,
                    shown.of_features([name]),
                    arguments_of_one,
                    course.checkpoints,
                    events[name],
                )
                for name, arguments_of_one in arguments.items()
            }
            read = dict.fromkeys(events, 0)
            open_futures = set(running.values())
            while open_futures:
                done, open_futures = wait(open_futures, timeout=_POLL)
                for name, file in events.items():
                    read[name] = _tell_new(file, read[name], course.on_progress)
                for future in done:
                    future.result()  # an error of one ends all
            finished = True
            return {name: future.result() for name, future in running.items()}
        except BrokenProcessPool as error:
            raise SeeWhyError(
                "a training process was ended from outside, most often for want of memory: close "
                "other programs and train again; with checkpoints it goes on where it was"
            ) from error
        finally:
            executor.shutdown(kill_workers=not finished)


def _end_with(parent: int) -> None:
    """End this process when ``parent`` is gone, however that came to its end.

    Otherwise a worker whose parent was killed would train on and then wait for ever.
    """

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(1)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _train_and_tell(
    shown: LabelledPictures, arguments: Mapping[str, Any], checkpoints: Path | None, events: Path
) -> Trained:
    with events.open("a", encoding="utf-8", buffering=1) as stream:
        course = Course(
            checkpoints=checkpoints,
            on_progress=lambda event: print(json.dumps(asdict(event)), file=stream),
        )
        return _on_one_thread(shown, arguments, course)


def _tell_new(file: Path, read: int, on_progress: Progress | None) -> int:
    """Report the whole lines after the first ``read`` bytes; return the bytes read by now."""
    if on_progress is None or not file.exists():
        return read
    with file.open("rb") as stream:
        stream.seek(read)
        new = stream.read()
    whole = new[: new.rfind(b"\n") + 1]
    for line in whole.splitlines():
        on_progress(TrainingEvent(**json.loads(line)))
    return read + len(whole)
