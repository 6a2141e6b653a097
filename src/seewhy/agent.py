"""Agent: a picture becomes features, features a class, a question an answer with its reasons."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seewhy.dataset import Dataset
from seewhy.dialogue.answer import AnswerType, answer_templates, word_answer
from seewhy.dialogue.narration import narrate
from seewhy.dialogue.question import Asks, Question, Questions
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reference import Experience, ReferenceAnswers, experience_of
from seewhy.domain import Domain
from seewhy.errors import DatasetError, NotFittedError
from seewhy.induction.sentence import say_path
from seewhy.induction.tree import DecisionTree, TreePath
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.reasoner import Minimality, Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.why import contradiction
from seewhy.reply import Classification, FeatureReading, Reply
from seewhy.wording import say_literal

if TYPE_CHECKING:
    from PIL import Image

    from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
    from seewhy.perception.extractor import FeatureExtractor

    Picture = Path | str | Image.Image | np.ndarray[Any, Any]

Progress = Callable[[Any], None]

_UNDECIDED = {
    Verdict.SILENT: "no axiom concludes a class",
    Verdict.SEVERAL: "it concludes more than one class",
    Verdict.CONTRADICTION: "it contradicts itself here",
    Verdict.NO_ANSWER_SET: "no set of beliefs agrees with all axioms",
    Verdict.BELIEVED: "",
}


class Agent:
    """Answers questions about pictures of one domain and says why.

    Use it when you have a domain folder and some annotated pictures. The networks see, the
    knowledge reasons; what the knowledge leaves open, and only that, trains a decision tree (for
    the class) and a recurrent network (for the answers).

    Parameters
    ----------
    domain : Domain
    minimality : {"cardinality", "inclusion"}
        Which exceptions to defaults are preferred; see
        :class:`~seewhy.knowledge.reasoner.Reasoner`.
    seed : int
        Two agents with the same seed and data agree.

    Source: Riley and Sridharan (2019), figure 1 and section 3. Departures are listed in
    docs/departures.md.

    Examples
    --------
    >>> import seewhy
    >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
    >>> agent.decide({"num_blocks": "4", "base": "wide", "lean": "no", "block_displaced": "yes"})
    'unstable'
    """

    def __init__(
        self, domain: Domain, *, minimality: Minimality = "cardinality", seed: int = 0
    ) -> None:
        self.domain = domain
        self.seed = seed
        self.minimality: Minimality = minimality
        self.reasoner = Reasoner(domain.knowledge, domain.schema, minimality=minimality)
        self.questions = Questions(domain)
        answer_templates(domain)  # a wrong template is found here, not after the training
        self.reasoned = ReasonedAnswers(domain, self.reasoner)
        self.tree = DecisionTree({key: f.values for key, f in domain.features.items()})
        self.extractor: FeatureExtractor | None = None
        self.answerer: RecurrentAnswerer | None = None
        self.experience: Experience = {}
        self.trained_on: frozenset[str] = frozenset()

    # Training -------------------------------------------------------------------------------

    def fit(
        self,
        dataset: Dataset,
        *,
        start_from: Agent | None = None,
        checkpoints: Path | None = None,
        on_progress: Progress | None = None,
    ) -> Agent:
        """Train on the scenes of a dataset (those with split "train", where there are splits).

        Parameters
        ----------
        dataset : Dataset
        start_from : Agent, optional
            Fine-tune this agent's networks instead of growing new ones.
        checkpoints : Path, optional
            A folder in which an interrupted training finds where it was.
        on_progress : callable, optional
            Called with a :class:`~seewhy.perception.training.TrainingEvent` after every epoch.

        Raises
        ------
        DatasetError
            If the dataset is of another domain or of one class only.
        """
        from seewhy.perception.extractor import fit_extractor
        from seewhy.perception.options import TrainingOptions

        if dataset.domain.name != self.domain.name:
            raise DatasetError(
                f"{dataset.folder}: the dataset is of the domain '{dataset.domain.name}', the "
                f"agent of '{self.domain.name}'; load it with the agent's domain"
            )
        scenes = dataset.of_split("train")
        scenes.require_two_classes()
        pictures = self.domain.pictures
        values = {key: feature.values for key, feature in self.domain.features.items()}
        columns = list(zip(*scenes.vectors, strict=True))
        self.extractor = fit_extractor(
            scenes.pictures(pictures.size),
            dict(zip(values, columns, strict=True)),
            values=values,
            options={
                key: TrainingOptions(
                    threshold=feature.threshold,
                    flip=pictures.flip,
                    shift=pictures.shift,
                    seed=self.seed,
                )
                for key, feature in self.domain.features.items()
            },
            groups=scenes.groups,
            checkpoints=checkpoints,
            start_from=start_from.extractor if start_from else None,
            on_progress=on_progress,
        )
        self.trained_on = frozenset(scenes.picture_digests())
        return self.fit_induction(scenes.vectors, scenes.labels)

    def fit_induction(self, vectors: Sequence[FeatureVector], labels: Sequence[str]) -> Agent:
        """Train the tree and the recurrent network on what the knowledge leaves open.

        Only scenes whose annotated features the knowledge does not decide, or decides wrongly,
        are used (section 3.3 of the paper).
        """
        from seewhy.dialogue.learned import fit_learned_answers

        self.experience = experience_of(vectors, labels)
        decisions = self.reasoner.decide_all(vectors)
        left = [n for n, own in enumerate(decisions) if own.label != labels[n]]
        left_vectors, left_labels = [vectors[n] for n in left], [labels[n] for n in left]
        self.tree.fit(left_vectors, left_labels, seed=self.seed)
        self.answerer = None
        if left:
            self.answerer = fit_learned_answers(
                self.domain,
                self.questions,
                self.reference,
                left_vectors,
                left_labels,
                seed=self.seed,
            )
        return self

    @property
    def reference(self) -> ReferenceAnswers:
        """What correct answers say about annotated scenes."""
        return ReferenceAnswers(self.domain, self.reasoned, self.experience)

    # Seeing ---------------------------------------------------------------------------------

    def read(self, pictures: np.ndarray[Any, Any]) -> list[dict[str, FeatureReading]]:
        """Return the most probable value of every feature, for pictures of the domain's size.

        ``pictures`` is uint8 of shape (scenes, size, size, 3).
        """
        if self.extractor is None:
            raise NotFittedError("the agent is not trained yet; call fit, or load a model")
        probabilities = self.extractor.probabilities(pictures)
        readings: list[dict[str, FeatureReading]] = []
        for number in range(len(pictures)):
            reading = {}
            for key, feature in self.domain.features.items():
                row = probabilities[key][number]
                best = int(row.argmax())
                reading[key] = FeatureReading(feature.values[best], float(row[best]))
            readings.append(reading)
        return readings

    # Deciding -------------------------------------------------------------------------------

    def decide(self, features: Mapping[str, str | None]) -> str | None:
        """Return the class of named feature values, by knowledge or by the tree."""
        return self._decide(self.domain.vector(features))[0]

    def _decide(self, vector: FeatureVector) -> tuple[str | None, str, Verdict]:
        decision = self.reasoner.decide(vector)
        if decision.label is not None:
            return decision.label, "knowledge", decision.verdict
        if self.tree.fitted:
            return self.tree.classify(vector), "tree", decision.verdict
        return None, "none", decision.verdict

    def classify(self, image: Picture) -> Classification:
        """Classify one picture (a path, a Pillow image or an array)."""
        from seewhy.perception.picture import as_picture

        pixels = as_picture(image, size=self.domain.pictures.size)
        return self.classify_all(pixels[None])[0]

    def classify_all(self, pictures: np.ndarray[Any, Any]) -> list[Classification]:
        """Classify pictures, uint8 of shape (scenes, size, size, 3)."""
        found: list[Classification] = []
        for reading in self.read(pictures):
            vector = self.domain.vector({key: own.value for key, own in reading.items()})
            label, method, verdict = self._decide(vector)
            found.append(Classification(label, method, vector, reading, verdict.value))
        return found

    # Answering ------------------------------------------------------------------------------

    def ask(self, image: Picture, question: str, *, previous: Reply | None = None) -> Reply:
        """Answer a question about a picture.

        Parameters
        ----------
        image : path, Pillow image or array
        question : str
            In the words of the domain's templates; spelling and word forms are forgiven.
        previous : Reply, optional
            The answer that "please explain this answer" is about; without it, the
            classification is explained.

        Raises
        ------
        QuestionError
            If the question is not understood; it names the nearest ones that are.
        PictureError
            If the image is no picture.
        """
        understood = self.questions.understand(question)
        return self.answer(self.classify(image), understood, previous=previous)

    def answer(
        self, scene: Classification, question: Question, *, previous: Reply | None = None
    ) -> Reply:
        """Answer an understood question about a classified scene."""
        if question.asks is Asks.EXPLAIN:
            return self._explain(scene, question, previous)
        kind, justification = self._answer(scene, question)
        justification = justification.with_probabilities(
            {key: (own.value, own.probability) for key, own in scene.features.items()}
        )
        text = word_answer(self.domain, question, kind, vector=scene.vector, label=scene.label)
        return Reply(question, text, scene.method, justification, kind, scene)

    def _answer(self, scene: Classification, question: Question) -> tuple[AnswerType, Node]:
        if scene.method == "knowledge" and scene.label is not None:
            reasoned = self.reasoned.answer(question, scene.vector, scene.label)
            return reasoned.kind, reasoned.justification
        if scene.label is None or self.answerer is None:
            if question.feature is not None:
                own = self.reasoned.feature(question, scene.vector)
                return own.kind, own.justification
            return AnswerType("undecided"), self._undecided(scene.vector)
        return self._learned(scene, question, scene.label)

    def _learned(
        self, scene: Classification, question: Question, label: str
    ) -> tuple[AnswerType, Node]:
        from seewhy.dialogue.learned import learned_answers

        assert self.answerer is not None
        path = self.tree.path(scene.vector)
        tested = [condition.feature for condition in path.conditions]
        ((kind, probability),) = learned_answers(
            self.domain, self.answerer, [(question, scene.vector, label, tested)]
        )
        return kind, self._tree_node(scene.vector, label, path, kind, probability)

    def _tree_node(
        self,
        vector: FeatureVector,
        label: str,
        path: TreePath,
        kind: AnswerType,
        probability: float,
    ) -> Node:
        """The justification of a class that the tree gave and an answer that was learned."""
        seen = tuple(self.reasoned.seen(vector, c.feature) for c in path.conditions)
        sentence = say_path(self.domain, path)
        literal = self.domain.classes[label].literal
        return Node(
            literal=str(literal),
            text=say_literal(self.domain, literal),
            basis=Basis.TREE,
            children=(
                Node(str(literal), sentence, Basis.PATH, children=seen),
                Node(
                    literal=kind.identifier,
                    text="the answer was chosen by the recurrent network "
                    f"(p = {probability:.2f} among the answers that fit)",
                    basis=Basis.RECURRENT,
                ),
                self._undecided(vector),
            ),
        )

    def _undecided(self, vector: FeatureVector) -> Node:
        """Why the knowledge does not decide a scene."""

        def say(literal: Any) -> str:
            return say_literal(self.domain, literal)

        both = contradiction(self.reasoner, vector, say=say)
        if both is not None:
            return both
        verdict = self.reasoner.decide(vector).verdict
        children = tuple(
            self.reasoned.why_not_class(vector, label) for label in self.domain.classes
        )
        return Node(
            literal="undecided",
            text=f"the knowledge does not decide: {_UNDECIDED[verdict]}",
            basis=Basis.ABSENCE,
            holds=False,
            children=children if verdict is Verdict.SILENT else (),
        )

    def _explain(self, scene: Classification, question: Question, previous: Reply | None) -> Reply:
        if previous is None:
            asks = Question(asks=Asks.CLASS, text="", words=())
            previous = self.answer(scene, asks)
        text = narrate(self.domain, previous)
        return Reply(
            question,
            text,
            previous.method,
            previous.justification,
            AnswerType("explain", previous.kind.mentions, previous.kind.changes),
            previous.classification,
        )

    # On disk --------------------------------------------------------------------------------

    def save(self, folder: Path | str) -> None:
        """Write the model to a folder, whole or not at all."""
        from seewhy.model import Model, write_model

        if self.extractor is None:
            raise NotFittedError("the agent is not trained yet; call fit before save")
        model = Model(
            domain=self.domain,
            extractor=self.extractor,
            tree=self.tree,
            answerer=self.answerer,
            experience=self.experience,
            trained_on=self.trained_on,
            minimality=self.minimality,
            seed=self.seed,
        )
        write_model(model, Path(folder))

    @staticmethod
    def load(folder: Path | str) -> Agent:
        """Read a model.

        Raises
        ------
        ModelError
            If the folder is incomplete, was edited, or was made by another version.
        """
        from seewhy.model import read_model

        model = read_model(Path(folder))
        agent = Agent(model.domain, minimality=model.minimality, seed=model.seed)
        agent.extractor, agent.tree, agent.answerer = model.extractor, model.tree, model.answerer
        agent.experience, agent.trained_on = model.experience, model.trained_on
        return agent
