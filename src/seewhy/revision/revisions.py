"""Revisions are taken and taken back: files, record and what an agent knows go together."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy.agent.manifest_file import is_of_things
from seewhy.agent.things.thing_model import write_domain_files
from seewhy.agent.working_knowledge import WorkingKnowledge, working_knowledge
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.folder import REVISIONS
from seewhy.errors import KnowledgeError, RevisionError
from seewhy.files.whole_files import write_whole
from seewhy.revision.correction import cells_of
from seewhy.revision.edit import KNOWLEDGE, TABLE, Edit, FileName, edited
from seewhy.revision.model_folder import folder_of_domain, save_revised
from seewhy.revision.proposal import Proposal, known_by, texts_of
from seewhy.revision.record import (
    Counted,
    EditLine,
    Record,
    RecordFile,
    Revision,
    Taken,
    TakenBack,
    revisions_of,
)
from seewhy.revision.remembered import counted_by, pictures_after, remembering
from seewhy.revision.table_text import label_edits, read_text
from seewhy.text.nearest import did_you_mean

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["Revisions"]


class Revisions:
    """The revisions of a model or of a domain folder.

    Parameters
    ----------
    folder : Path or str
        A model's folder, or a domain's.
    agent : Agent, optional
        What reasons with the knowledge, and follows it. The one that was loaded from the folder,
        where that is a model's; with a domain's folder it may be left out, or be any agent of the
        domain. Of a model of several things none follows: whoever asks it reads its domain again.
    record : Record, optional
        Where revisions are recorded; ``revisions.jsonl`` beside ``knowledge.al`` without it.
    dataset : Path, optional
        The folder of a dataset, into whose table labels are written.

    Raises
    ------
    DomainError, ModelError, RevisionError
        If the folder is neither a model nor a domain; if its record is damaged.

    Examples
    --------
    >>> import shutil, tempfile
    >>> folder = Path(tempfile.mkdtemp()) / "structures"
    >>> _ = shutil.copytree(load_domain("structure_stability").folder, folder)
    >>> known = working_knowledge(load_domain(folder))
    >>> from seewhy.agent.learning_from_pictures import AnnotatedScenes
    >>> from seewhy.revision.new_rule import Candidate, PathCondition, new_rule
    >>> from seewhy.revision.proposal import Doubted
    >>> revisions = Revisions(folder)
    >>> before = revisions.texts["knowledge.al"]
    >>> doubted = Doubted(known, revisions.texts, ("4", "wide", "yes", "no"),
    ...                   AnnotatedScenes((), (), ()))
    >>> leans = Candidate("unstable", (PathCondition("lean", ("yes",)),
    ...                                PathCondition("num_blocks", ("4",))))
    >>> revisions.take(new_rule(doubted, leans)[0]).number
    1
    >>> _ = revisions.take_back(1)
    >>> revisions.texts["knowledge.al"] == before
    True
    """

    def __init__(
        self,
        folder: Path | str,
        *,
        agent: Agent | None = None,
        record: Record | None = None,
        dataset: Path | None = None,
    ) -> None:
        self.folder = Path(folder)
        self.domain_folder = folder_of_domain(self.folder)
        self.is_model = self.domain_folder != self.folder
        self.is_of_things = self.is_model and is_of_things(self.folder)
        if self.is_model and agent is None and not self.is_of_things:
            from seewhy.agent.agent import Agent

            agent = Agent.load(self.folder)
        self.agent = agent
        self.record = RecordFile.beside(self.domain_folder) if record is None else record
        self.dataset = dataset
        self.record.lines()

    @property
    def all(self) -> tuple[Revision, ...]:
        """All that were taken, those that were taken back included."""
        return revisions_of(self.record.lines())

    @property
    def known(self) -> WorkingKnowledge:
        """What is known now."""
        if self.agent is not None:
            return self.agent.known
        return working_knowledge(load_domain(self.domain_folder))

    @property
    def texts(self) -> dict[FileName, str]:
        """What the files of the knowledge hold now."""
        knowledge = read_text(self.domain_folder / KNOWLEDGE)
        if self.agent is None:
            return {KNOWLEDGE: knowledge, "learned.al": ""}
        return texts_of(self.agent.known, knowledge)

    # Taking -----------------------------------------------------------------------------------

    def take(self, proposal: Proposal, *, picture: Path | None = None) -> Revision:
        """Take a proposal: its files are written, it is recorded, and the agent knows it.

        Parameters
        ----------
        proposal : Proposal
        picture : Path, optional
            For a label: the picture's file.

        Raises
        ------
        KnowledgeError, RevisionError
            If the knowledge would be broken, or has changed since this was proposed; if a label
            has no dataset to stand in, or stands there already.
        """
        edits, counted = proposal.edits, None
        if proposal.reading is not None:
            edits, counted = self._label(proposal, picture)
        line = Taken(
            number=len(self.all) + 1,
            at=_now(),
            cause=proposal.cause,
            sentence=proposal.sentence,
            statement=proposal.statement,
            about=proposal.about,
            picture="" if picture is None or proposal.reading is None else picture.name,
            edits=tuple(
                EditLine(file=edit.file, at=edit.at, before=edit.before, after=edit.after)
                for edit in edits
            ),
            counted=counted,
        )
        self._write(edits, counted, line)
        return Revision(line)

    def _label(
        self, proposal: Proposal, picture: Path | None
    ) -> tuple[tuple[Edit, ...], Counted | None]:
        """What a label writes into the dataset's table, and what the agent is told by it."""
        assert proposal.reading is not None
        if self.dataset is None or picture is None:
            raise RevisionError(
                "no dataset is at hand for the label to stand in; give --data FOLDER with "
                "pictures and scenes.csv"
            )
        cells = cells_of(proposal)
        dataset = Dataset.load(self.dataset, self._domain)
        edits = label_edits(dataset, picture, cells, text=read_text(self.dataset / TABLE))
        if not edits:
            raise RevisionError(
                f"{self.dataset / TABLE}: says so of {picture.name} already; it was misread all "
                "the same, so that labels of other pictures help, and more training"
            )
        if self.agent is None:
            return edits, None
        return edits, counted_by(self.agent, dataset, picture, cells)

    @property
    def _domain(self) -> Domain:
        return load_domain(self.domain_folder) if self.agent is None else self.agent.domain

    # Taking back ------------------------------------------------------------------------------

    def take_back(self, number: int) -> Revision:
        """Take a revision back: what it wrote is gone, and the rest stays as it is.

        Raises
        ------
        RevisionError
            If there is no such revision, or it was taken back; if what it wrote was changed
            since, by a later revision or by somebody.
        """
        revision = self._to_take_back(number)
        taken = revision.taken
        edits = tuple(edit.undone for edit in reversed(taken.changes))
        if any(edit.file == TABLE for edit in edits) and self.dataset is None:
            raise RevisionError(
                f"revision {number} is a label in {TABLE}; name its dataset with --data FOLDER"
            )
        counted = taken.counted
        undone = counted and Counted(less=counted.more, more=counted.less, picture=counted.picture)
        line = TakenBack(number=number, at=_now())
        try:
            self._write(edits, undone, line, back=True)
        except RevisionError as problem:
            raise RevisionError(
                f"revision {number} cannot be taken back: {self._in_the_way(taken) or problem}"
            ) from None
        except KnowledgeError as problem:
            raise RevisionError(
                f"revision {number} cannot be taken back, the knowledge would be broken: {problem}"
            ) from None
        return Revision(taken, line.at)

    def _to_take_back(self, number: int) -> Revision:
        numbers = {revision.number: revision for revision in self.all}
        if not numbers:
            raise RevisionError(f"{self.folder}: nothing was revised, so nothing is taken back")
        if number not in numbers:
            raise RevisionError(
                f"there is no revision {number}; {did_you_mean(str(number), map(str, numbers))}"
            )
        if numbers[number].taken_back is not None:
            raise RevisionError(f"revision {number} was taken back already")
        return numbers[number]

    def _in_the_way(self, taken: Taken) -> str | None:
        """That a later revision changed what a revision wrote; None where none did."""
        wrote = {edit.file: edit.after.strip() for edit in taken.changes if edit.after.strip()}
        for revision in self.all[taken.number :]:
            changed = any(
                (passage := edit.before.strip())
                and edit.file in wrote
                and (passage in wrote[edit.file] or wrote[edit.file] in passage)
                for edit in revision.taken.changes
            )
            if revision.taken_back is None and changed:
                return f"revision {revision.number} changed what it wrote; take that one back first"
        return None

    # Writing ----------------------------------------------------------------------------------

    def _write(
        self,
        edits: Sequence[Edit],
        counted: Counted | None,
        line: Taken | TakenBack,
        *,
        back: bool = False,
    ) -> None:
        """Write the files, then let the agent follow; where a file cannot be written, none is."""
        before = self.texts
        after = edited(before, [edit for edit in edits if edit.file != TABLE])
        table = [edit for edit in edits if edit.file == TABLE]
        agent = None if self.agent is None else self._following(after, counted, back=back)
        if agent is None and after != before:
            known_by(self.known, after)
        old = new = ""
        if table and self.dataset is not None:
            old = read_text(self.dataset / TABLE)
            new = edited({TABLE: old}, table)[TABLE]
            write_whole(self.dataset / TABLE, new.encode())
        try:
            self._write_knowledge(agent, before, after, line)
        except BaseException:
            if table and self.dataset is not None:
                write_whole(self.dataset / TABLE, old.encode())
            raise
        if self.agent is not None and agent is not None:
            self.agent.__dict__.update(agent.__dict__)

    def _write_knowledge(
        self,
        agent: Agent | None,
        before: Mapping[FileName, str],
        after: Mapping[FileName, str],
        line: Taken | TakenBack,
    ) -> None:
        """Write the knowledge and the record.

        A revision is recorded before it is written, and taken back before that is recorded: so
        whatever was written stands in the record, whenever the process is killed.
        """
        record = self.record
        files = {str(KNOWLEDGE): after[KNOWLEDGE]}
        if self.is_of_things and isinstance(record, RecordFile):
            write_domain_files(self.folder, {**files, REVISIONS: record.text_with(line)})
            return
        if self.is_model and agent is not None and isinstance(record, RecordFile):
            # The record lies in the model, which is written whole.
            save_revised(agent, self.folder, {**files, REVISIONS: record.text_with(line)})
            return
        if isinstance(line, Taken):
            record.append(line)
        if self.is_model and agent is not None:
            save_revised(agent, self.folder, files)
        elif after[KNOWLEDGE] != before[KNOWLEDGE]:
            write_whole(self.domain_folder / KNOWLEDGE, after[KNOWLEDGE].encode())
        if isinstance(line, TakenBack):
            record.append(line)

    def _following(
        self, texts: Mapping[FileName, str], counted: Counted | None, *, back: bool
    ) -> Agent:
        """A copy of the agent that knows what the files say."""
        assert self.agent is not None
        agent = copy.copy(self.agent)
        known = known_by(agent.known, texts)
        if counted is not None:
            known = replace(known, experience=remembering(known.experience, counted))
            agent.training_pictures = pictures_after(agent.training_pictures, counted, back=back)
        agent.know(known)
        return agent


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
