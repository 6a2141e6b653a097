"""A project's model: loaded once, again when it changes, and with the knowledge as it stands."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from seewhy.errors import RevisionError
from seewhy.revision.correction import corrected
from seewhy.revision.edit import KNOWLEDGE, LEARNED, Edit
from seewhy.revision.proposal import Texts, known_by, texts_of
from seewhy.studio.answering_agent import CORRECTED, AnsweringAgent, Remembered
from seewhy.studio.model_there import Missing, stamp_of
from seewhy.studio.project import Project
from seewhy.studio.writing import FILES, learned_edits, read_text

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.dialogue.reply import Classification
    from seewhy.perception.where import Where

__all__ = ["ProjectModel"]

_OF_ONE = Missing(
    "This is for pictures of one thing, and those of the domain show several: ask about them.",
    "/ask",
    "Ask",
)


class ProjectModel(AnsweringAgent["Agent", "Classification"]):
    """What answers questions about the pictures of a project that show one thing each.

    What is known is what knowledge.al of the project says by now, with what the model learned.

    Parameters
    ----------
    project : Project
    """

    def __init__(self, project: Project) -> None:
        super().__init__(project)
        self._knowing: tuple[object, Agent] | None = None
        self._where: Remembered[Mapping[str, Where]] = Remembered()

    @property
    def missing(self) -> Missing | None:
        """What there must be before a question can be answered; None where all is there."""
        return _OF_ONE if self.project.has_things else super().missing

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
            return self._seen.get(key, lambda: corrected(agent, agent.classify(file), corrections))

    def where(self, picture: str) -> Mapping[str, Where]:
        """Where in a picture each feature is seen; it takes seconds, and then is remembered."""
        file = self.project.picture_file(picture)
        scene = self.look(picture)
        with self.at_work() as agent:
            key = (id(agent), picture, file.stat().st_mtime_ns, scene.vector)
        # What sees may work beside what reasons.
        return self._where.get(key, lambda: agent.where(file, scene=scene))

    # The agent --------------------------------------------------------------------------------

    def _load(self) -> Agent:
        from seewhy.agent.agent import Agent

        return Agent.load(self.project.model_folder)

    def _knowing_now(self, agent: Agent) -> Agent:
        if agent.given.schema != self.project.domain().schema:
            return agent
        key = (stamp_of(self.project), self._knowledge(), self._learned_edits())
        if self._knowing is None or self._knowing[0] != key:
            self._knowing = key, self._following(agent)
            self._forget()
        return self._knowing[1]

    def _forget(self) -> None:
        super()._forget()
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
        since = self._trained_at()
        features = agent.domain.features
        return {
            name: label.value
            for name, label in self.project.labels().of.get(picture, {}).items()
            if label.how == CORRECTED
            and label.at > since
            and name in features
            and label.value in features[name].values
        }
