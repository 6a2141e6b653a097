"""A project's model: loaded once, again when it changes, and with the knowledge as it stands."""

from __future__ import annotations

import copy
from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from threading import RLock
from typing import TYPE_CHECKING

from seewhy.agent.manifest_file import MANIFEST
from seewhy.errors import RevisionError, SeeWhyError
from seewhy.revision.correction import corrected
from seewhy.revision.edit import KNOWLEDGE, LEARNED, Edit
from seewhy.revision.proposal import Texts, known_by, texts_of
from seewhy.studio.model_there import Missing, missing_of, stamp_of
from seewhy.studio.project import Project
from seewhy.studio.writing import FILES, learned_edits, read_text

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.dialogue.reply import Classification
    from seewhy.perception.where import Where

__all__ = ["CORRECTED", "ProjectModel"]

CORRECTED = "corrected"
"""How a label was said that an answer got wrong; it holds on the page until the next training."""

_REMEMBERED = 200
"""Pictures of which it is remembered what they show."""

_OF_ONE = Missing(
    "This is for pictures of one thing, and those of the domain show several: ask about them.",
    "/ask",
    "Ask",
)


class ProjectModel:
    """What answers questions about the pictures of a project.

    What sees is the model's. What is known is what knowledge.al of the project says by now, with
    what the model learned, so that a revision holds at once.

    Parameters
    ----------
    project : Project
    """

    def __init__(self, project: Project) -> None:
        self.project = project
        self._lock = RLock()
        self._loaded: tuple[tuple[int, ...], Agent] | None = None
        self._knowing: tuple[object, Agent] | None = None
        self._seen: OrderedDict[tuple[object, ...], Classification] = OrderedDict()
        self._where: OrderedDict[tuple[object, ...], Mapping[str, Where]] = OrderedDict()

    @property
    def missing(self) -> Missing | None:
        """What there must be before a question can be answered; None where all is there."""
        if self.project.has_things:
            return _OF_ONE
        return missing_of(self.project)

    @contextmanager
    def at_work(self) -> Iterator[Agent]:
        """The agent, for one thread at a time: what reasons is not shared.

        Raises
        ------
        SeeWhyError
            If there is none, or its folder is damaged.
        """
        with self._lock:
            yield self._agent()

    @property
    def trained_for_this(self) -> bool:
        """Whether the model has the features and classes that the domain has by now."""
        with self.at_work() as agent:
            return agent.given.schema == self.project.domain().schema

    def texts(self) -> Texts:
        """The files that the agent's knowledge is read from."""
        with self.at_work() as agent:
            return texts_of(agent.known, self._knowledge())

    def look(self, picture: str) -> Classification:
        """What a picture of the project is taken to be, with what was corrected since training.

        Raises
        ------
        LookupError
            If it is no picture of the project.
        PictureError
            If it cannot be read.
        """
        file = self.project.picture_file(picture)
        with self.at_work() as agent:
            corrections = self._corrections(picture, agent)
            key = (id(agent), picture, file.stat().st_mtime_ns, tuple(corrections.items()))
            if key not in self._seen:
                self._seen[key] = corrected(agent, agent.classify(file), corrections)
                while len(self._seen) > _REMEMBERED:
                    self._seen.popitem(last=False)
            return self._seen[key]

    def where(self, picture: str) -> Mapping[str, Where]:
        """Where in a picture each feature is seen; it takes seconds, and then is remembered."""
        file = self.project.picture_file(picture)
        scene = self.look(picture)
        with self.at_work() as agent:
            key = (id(agent), picture, file.stat().st_mtime_ns, scene.vector)
        if key not in self._where:
            # What sees may work beside what reasons.
            found = agent.where(file, scene=scene)
            with self._lock:
                self._where[key] = found
                while len(self._where) > _REMEMBERED:
                    self._where.popitem(last=False)
        return self._where[key]

    # The agent --------------------------------------------------------------------------------

    def _agent(self) -> Agent:
        missing = self.missing
        if missing is not None:
            raise SeeWhyError(f"{missing.sentence} The page {missing.words} does that.")
        stamp = stamp_of(self.project)
        if self._loaded is None or self._loaded[0] != stamp:
            from seewhy.agent.agent import Agent

            self._loaded = stamp, Agent.load(self.project.model_folder)
            self._forget()
        agent = self._loaded[1]
        if agent.given.schema != self.project.domain().schema:
            return agent
        key = (stamp, self._knowledge(), self._learned_edits())
        if self._knowing is None or self._knowing[0] != key:
            self._knowing = key, self._following(agent)
            self._forget()
        return self._knowing[1]

    def _forget(self) -> None:
        self._seen.clear()
        self._where.clear()

    def _following(self, agent: Agent) -> Agent:
        """The agent as it is when it knows what the project's files say."""
        trained_with = read_text(self.project.model_folder / "domain" / KNOWLEDGE) or ""
        before = texts_of(agent.known, trained_with)
        texts = {**before, KNOWLEDGE: self._knowledge()}
        for edit in self._learned_edits():
            try:
                texts[LEARNED] = edit.applied(texts[LEARNED])
            except RevisionError:
                continue  # a later training did not learn it again
        if texts == before:
            return agent
        follower = copy.copy(agent)
        follower.know(known_by(agent.known, texts))
        return follower

    def _knowledge(self) -> str:
        folder = self.project.domain_folder
        assert folder is not None
        return read_text(folder / KNOWLEDGE) or ""

    def _learned_edits(self) -> Sequence[Edit]:
        return learned_edits(self.project.record.holding(FILES))

    def _corrections(self, picture: str, agent: Agent) -> dict[str, str]:
        trained = (self.project.model_folder / MANIFEST).stat().st_mtime
        since = datetime.fromtimestamp(trained, UTC).isoformat(timespec="milliseconds")
        features = agent.domain.features
        return {
            name: label.value
            for name, label in self.project.labels().of.get(picture, {}).items()
            if label.how == CORRECTED
            and label.at > since
            and name in features
            and label.value in features[name].values
        }
