"""What answers questions about a project's pictures: loaded once, and again when it changes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from threading import Lock, RLock
from typing import Generic, TypeVar

from seewhy.agent.manifest_file import MANIFEST
from seewhy.errors import SeeWhyError
from seewhy.studio.model_there import Missing, missing_of, stamp_of
from seewhy.studio.project import Project

__all__ = ["CORRECTED", "AnsweringAgent", "Remembered"]

CORRECTED = "corrected"
"""How a label was said that an answer got wrong; it holds on the page until the next training."""

_REMEMBERED = 200
"""Pictures of which it is remembered what they show."""

AgentT = TypeVar("AgentT")
SeenT = TypeVar("SeenT")
FoundT = TypeVar("FoundT")


class Remembered(Generic[FoundT]):
    """What was found of the last pictures, by all that it depends on."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._found: OrderedDict[tuple[object, ...], FoundT] = OrderedDict()

    def get(self, key: tuple[object, ...], find: Callable[[], FoundT]) -> FoundT:
        """What was found before, or is found now."""
        found = self._found.get(key)
        if found is None:
            found = find()
            with self._lock:
                self._found[key] = found
                while len(self._found) > _REMEMBERED:
                    self._found.popitem(last=False)
        return found

    def clear(self) -> None:
        """Forget all."""
        with self._lock:
            self._found.clear()


class AnsweringAgent(ABC, Generic[AgentT, SeenT]):
    """What answers questions about the pictures of a project, for one thread at a time.

    What sees is the model's; what is known is what the project's files say by now, so that a
    revision holds at once.

    Parameters
    ----------
    project : Project
    """

    def __init__(self, project: Project) -> None:
        self.project = project
        self._lock = RLock()
        self._loaded: tuple[tuple[int, ...], AgentT] | None = None
        self._seen: Remembered[SeenT] = Remembered()

    @property
    def missing(self) -> Missing | None:
        """What there must be before a question can be answered; None where all is there."""
        return missing_of(self.project)

    @contextmanager
    def at_work(self) -> Iterator[AgentT]:
        """The agent, for one thread at a time: what reasons is not shared.

        Raises
        ------
        SeeWhyError
            If there is none, or its folder is damaged.
        """
        with self._lock:
            yield self._agent()

    @property
    @abstractmethod
    def trained_for_this(self) -> bool:
        """Whether the model has the features that the domain has by now."""

    @abstractmethod
    def look(self, picture: str) -> SeenT:
        """What a picture of the project is taken to show, with what was corrected since training.

        Raises
        ------
        LookupError
            If it is no picture of the project.
        PictureError
            If it cannot be read.
        """

    def _agent(self) -> AgentT:
        missing = self.missing
        if missing is not None:
            raise SeeWhyError(f"{missing.sentence} The page {missing.words} does that.")
        stamp = stamp_of(self.project)
        if self._loaded is None or self._loaded[0] != stamp:
            self._loaded = stamp, self._load()
            self._forget()
        return self._knowing_now(self._loaded[1])

    @abstractmethod
    def _load(self) -> AgentT:
        """The model as it lies in the project's folder."""

    @abstractmethod
    def _knowing_now(self, agent: AgentT) -> AgentT:
        """The same, knowing what the project's files say by now."""

    def _forget(self) -> None:
        """Forget what was looked at: it would be another by now."""
        self._seen.clear()

    def _trained_at(self) -> str:
        """When the model was trained, as entries of the record say when they were made."""
        trained = (self.project.model_folder / MANIFEST).stat().st_mtime
        return datetime.fromtimestamp(trained, UTC).isoformat(timespec="milliseconds")
