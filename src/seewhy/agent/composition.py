"""What an agent consists of, in the memory and on disk."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Self

from seewhy.agent.deciding import Deciding
from seewhy.agent.part_attribute import part_attribute
from seewhy.agent.picture_reader import PictureReader
from seewhy.agent.reading_weights import ReadingWeights
from seewhy.agent.seeing import Seeing
from seewhy.agent.settings import settings_for
from seewhy.agent.training_pictures import TrainingPictures
from seewhy.agent.working_knowledge import WorkingKnowledge, working_knowledge
from seewhy.dialogue.answer import answer_templates
from seewhy.dialogue.answering import Answering
from seewhy.dialogue.question import Questions
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reference import Experience, ReferenceAnswers
from seewhy.domain.domain import Domain
from seewhy.domain.reading_rule import ReadingRule
from seewhy.errors import NotFittedError
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.knowledge.reasoner import Minimality, Reasoner

if TYPE_CHECKING:
    from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
    from seewhy.perception.extractor import FeatureExtractor
    from seewhy.perception.eyes import Eyes
    from seewhy.perception.familiarity import Familiarity

__all__ = ["Composition"]


class Composition:
    """The parts of an agent, and what each of them has; see :class:`seewhy.agent.agent.Agent`.

    Parts are values: one is never changed, another takes its place. So a copy of an agent has the
    same parts, and stays as it is when the agent learns.

    Attributes
    ----------
    settings : Settings
        What the agent was told.
    known : WorkingKnowledge
        What it reasons with, and which annotated scenes it remembers.
    seeing : Seeing
        What sees, and what is known of it from training.
    tree : DecisionTree
        Of which class a scene is that the knowledge leaves open.
    answerer : RecurrentAnswerer or None
        The answers about such scenes; None where none were learned.
    training_pictures : TrainingPictures
        Those that it was trained on.
    questions : Questions
        What the domain is asked.
    """

    seed: int = part_attribute("settings.seed")
    eyes: str = part_attribute("settings.eyes")
    device: str = part_attribute("settings.device")
    reading: ReadingRule = part_attribute("settings.reading")
    gate: float | None = part_attribute("settings.gate")
    known_share: float = part_attribute("settings.known_share")
    trust: float = part_attribute("settings.trust")

    experience: Experience = part_attribute("known.experience")

    extractor: FeatureExtractor | Eyes | None = part_attribute("seeing.extractor")
    familiarity: Familiarity | None = part_attribute("seeing.familiarity")
    validation_scores: Mapping[ReadingRule, list[float]] = part_attribute(
        "seeing.validation_scores"
    )
    reading_weights: Mapping[ReadingRule, ReadingWeights] = part_attribute("seeing.reading_weights")

    trained_on: frozenset[str] = part_attribute("training_pictures.trained_on")
    without_class: frozenset[str] = part_attribute("training_pictures.without_class")
    without: tuple[str, ...] = part_attribute("training_pictures.without")

    def __init__(
        self,
        domain: Domain,
        *,
        minimality: Minimality = "cardinality",
        seed: int = 0,
        eyes: str | None = None,
        device: str = "auto",
        reading: str | None = None,
        gate: float | None = None,
        known_share: float | None = None,
        trust: float = 0.9,
        learned: Sequence[Axiom] = (),
        withdrawn: Sequence[Withdrawn] = (),
    ) -> None:
        self.settings = settings_for(
            domain,
            eyes=eyes,
            device=device,
            reading=reading,
            gate=gate,
            known_share=known_share,
            trust=trust,
            seed=seed,
        )
        self.questions = Questions(domain)
        answer_templates(domain)  # a wrong template is found here, not after the training
        self.known: WorkingKnowledge = working_knowledge(
            domain, learned=learned, withdrawn=withdrawn, minimality=minimality
        )
        self.seeing = Seeing()
        self.tree = self.known.untrained_tree()
        self.answerer: RecurrentAnswerer | None = None
        self.training_pictures = TrainingPictures()
        self._reading_by: PictureReader | None = None

    @property
    def given(self) -> Domain:
        """The domain as its folder says it."""
        return self.known.given

    @property
    def learned(self) -> tuple[Axiom, ...]:
        """The axioms that were learned."""
        return self.known.learned

    @property
    def withdrawn(self) -> tuple[Withdrawn, ...]:
        """The axioms that are known no more; given ones among them are set aside."""
        return self.known.withdrawn

    @property
    def minimality(self) -> Minimality:
        """Which exceptions to defaults are preferred."""
        return self.known.minimality

    @property
    def domain(self) -> Domain:
        """The domain that is reasoned with: with what was learned, without what is set aside."""
        return self.known.domain

    @property
    def reasoner(self) -> Reasoner:
        """What reasons with it."""
        return self.known.reasoner

    @property
    def reasoned(self) -> ReasonedAnswers:
        """Answers by what is known."""
        return self.known.reasoned

    @property
    def reference(self) -> ReferenceAnswers:
        """What correct answers say about annotated scenes."""
        return self.known.reference

    @property
    def deciding(self) -> Deciding:
        """What decides of which class a scene is: the knowledge, or the tree."""
        return Deciding(self.known, self.tree)

    @property
    def reading_by(self) -> PictureReader:
        """What reads the features of pictures; it is kept until another part takes some place."""
        by_now = PictureReader(self.deciding, self.seeing, self.settings.believed_from(self.domain))
        if self._reading_by != by_now:
            self._reading_by = by_now
        return self._reading_by

    @property
    def answering(self) -> Answering:
        """What answers with all that is known and was learned by now."""
        return Answering(
            self.domain,
            self.reasoned,
            self.tree,
            self.answerer,
            self.experience,
            gate=self.gate or 0.0,
            known_share=self.known_share,
            least_likeness=self.unknown_below or 0.0,
            trust=self.trust,
            only_shown=self.only_shown,
        )

    @property
    def unknown_below(self) -> float | None:
        """The score below which a picture is not known; None where every picture is answered."""
        return self.seeing.unknown_below(self.reading, self.known_share)

    @property
    def only_shown(self) -> dict[str, str]:
        """Of features of which training pictures showed one value only, that value."""
        return self.seeing.only_shown(self.domain.features)

    @property
    def picture_size(self) -> int:
        """The side, in pixels, of the pictures that the trained agent looks at."""
        return self.domain.pictures.size if self.extractor is None else self.extractor.size

    def save(self, folder: Path | str) -> None:
        """Write the model to a folder, whole or not at all.

        Raises
        ------
        NotFittedError, ModelError
            If the agent is not trained yet; if the folder is there and is no model.
        """
        from seewhy.agent.model import Model, write_model

        if self.extractor is None:
            raise NotFittedError("the agent is not trained yet; call fit before save")
        model = Model(
            settings=self.settings,
            known=self.known,
            seeing=self.seeing,
            tree=self.tree,
            answerer=self.answerer,
            training_pictures=self.training_pictures,
        )
        write_model(model, Path(folder))

    @classmethod
    def load(
        cls,
        folder: Path | str,
        *,
        device: str = "auto",
        reading: str | None = None,
        gate: float | None = None,
        known_share: float | None = None,
    ) -> Self:
        """Read a model.

        Parameters
        ----------
        folder : Path or str
        device, reading, gate, known_share : optional
            As for a new agent, instead of what the model was trained with; a gate of 0 is none.

        Raises
        ------
        ModelError
            If the folder is incomplete, was edited, or was made by another version; or if pictures
            are to be read with a network of the class, and it has none.
        DomainError
            If an option is out of its range.
        """
        from seewhy.agent.model import read_model, require_readable

        model = read_model(Path(folder), device=device)
        settings = model.settings.but(reading=reading, gate=gate, known_share=known_share)
        require_readable(model, settings.reading, Path(folder))
        agent = cls(model.known.given, **asdict(settings))
        agent.known, agent.seeing = model.known, model.seeing
        agent.training_pictures = model.training_pictures
        agent.tree, agent.answerer = model.tree, model.answerer
        return agent
