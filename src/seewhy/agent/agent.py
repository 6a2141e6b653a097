"""Agent: a picture becomes features, features a class, a question an answer with its reasons."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.agent.inference import Inference
from seewhy.agent.seeing import Seeing
from seewhy.agent.training_pictures import TrainingPictures, scenes_to_train_on
from seewhy.agent.working_knowledge import WorkingKnowledge
from seewhy.data.dataset import Dataset
from seewhy.dialogue.reference import ReferenceAnswers, experience_of
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception.course import Course

if TYPE_CHECKING:
    from seewhy.agent.learning_from_pictures import Learning
    from seewhy.agent.pretraining import Pretrained
    from seewhy.induction.axiom_learning import LearningOptions

__all__ = ["Agent"]


class Agent(Inference):
    """Answers questions about pictures of one domain and says why.

    Use it when you have a domain folder and some annotated pictures. The networks see, the
    knowledge reasons; what the knowledge leaves open, and only that, trains a decision tree (for
    the class) and a recurrent network (for the answers).

    Source: Riley and Sridharan (2019), figure 1, section 3; departures: docs/departures.md.

    Parameters
    ----------
    domain : Domain
        As its folder says it: ``agent.given``. What is reasoned with is ``agent.domain``: with
        what was learned, and without what is set aside.
    minimality : {"cardinality", "inclusion"}
        Which exceptions to defaults are preferred (:class:`~seewhy.knowledge.reasoner.Reasoner`).
    seed, eyes, device, reading, gate, known_share, trust : optional
        How to see, read and answer (:class:`~seewhy.agent.settings.Settings`); where left out, as
        the domain says. A gate of 0 is none.
    learned, withdrawn : sequence of Axiom, of Withdrawn; optional
        Axioms that were learned before, and those that are known no more, given ones set aside.

    Raises
    ------
    DomainError
        If an option is out of its range.

    Examples
    --------
    >>> import seewhy
    >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
    >>> agent.decide({"num_blocks": "4", "base": "wide", "lean": "no", "block_displaced": "yes"})
    'unstable'
    """

    def fit(
        self,
        dataset: Dataset,
        *,
        without: Sequence[str] = (),
        start_from: Agent | Pretrained | None = None,
        drawn: int | None = None,
        answers: bool = True,
        reference: ReferenceAnswers | None = None,
        workers: int = -1,
        checkpoints: Path | None = None,
        on_picture: Callable[[int], None] | None = None,
        on_progress: Callable[[Any], None] | None = None,
    ) -> Agent:
        """Train on the scenes of a dataset (those with split "train", where there are splits).

        Pictures without a class teach what the networks of features see, and nothing else.

        Parameters
        ----------
        dataset : Dataset
        without : sequence of str
            Classes whose pictures are left out. What the knowledge says of them stays, so that
            they can be recognised all the same.
        start_from : Agent or Pretrained, optional
            Networks to fine-tune.
        drawn : int, optional
            Pictures that the domain's source draws to train on before. As many as the domain says
            where left out; none where the dataset was drawn itself, or with ``start_from``.
        answers : bool, default True
            False leaves the recurrent network out, where only classes are of interest.
        reference : ReferenceAnswers, optional
            Whose answers to learn; see :meth:`fit_induction`.
        workers, checkpoints, on_picture, on_progress : optional
            How the training is run; see :class:`~seewhy.perception.course.Course`.

        Raises
        ------
        DatasetError
            If the dataset is of another domain or of one class only, if no picture has a value of
            some feature, if a class to leave out is none of the domain's, or if there are both
            networks to start from and pictures to draw.
        """
        from seewhy.agent.fitting import known_from_training, pictures_to_draw, teach
        from seewhy.agent.pretraining import pretrained

        course = Course(
            checkpoints=checkpoints,
            workers=workers,
            on_picture=on_picture,
            on_progress=on_progress,
        )
        scenes = scenes_to_train_on(dataset, self.domain, without=without)
        count = pictures_to_draw(dataset, self.domain, drawn=drawn, start_from=start_from)
        if count:
            start_from = pretrained(
                self.domain, count=count, settings=self.settings, without=without, course=course
            )
        taught = teach(scenes, self.settings, start_from=start_from, course=course)
        self.seeing = Seeing(taught.extractor)
        self.training_pictures = TrainingPictures.of(scenes, without)
        unsure = taught.less_sure_than(self.gate)
        self.fit_induction(
            *taught.annotated, uncertain=unsure, answers=answers, reference=reference
        )
        self.seeing = known_from_training(taught, self.reading_by)
        return self

    def fit_induction(
        self,
        vectors: Sequence[FeatureVector],
        labels: Sequence[str],
        *,
        uncertain: Sequence[int] = (),
        answers: bool = True,
        reference: ReferenceAnswers | None = None,
    ) -> Agent:
        """Train the tree, and with ``answers`` the recurrent network, on what is left open.

        Only scenes whose annotated features the knowledge does not decide, or decides wrongly,
        are used (section 3.3 of the paper), and those at the positions ``uncertain``. The answers
        to learn are those of ``reference``; without it, those that follow from what is known.
        """
        from seewhy.dialogue.learned import fit_learned_answers

        self.experience = experience_of(vectors, labels)
        left = self.known.left_open(vectors, labels, also=uncertain)
        self.tree = self.known.untrained_tree().fit(*left, seed=self.seed)
        self.answerer = None
        if any(left) and answers:
            told = reference or self.reference
            self.answerer = fit_learned_answers(
                self.domain, self.questions, told, *left, seed=self.seed
            )
        return self

    def learn(
        self,
        dataset: Dataset,
        *,
        options: LearningOptions | None = None,
        accept: Callable[[Sequence[Axiom]], Sequence[Axiom]] | None = None,
        set_aside: Callable[[Sequence[Withdrawn]], Sequence[Withdrawn]] | None = None,
        answers: bool = True,
    ) -> Learning:
        """Learn axioms from annotated pictures, and reason with them from now on.

        The pictures seen before count too. Axioms learned earlier that the pictures contradict
        are withdrawn, as are those that a more general new one makes needless. What the knowledge
        still leaves open trains the tree and the recurrent network again; the networks that see
        are not touched.

        Parameters
        ----------
        dataset : Dataset
            Of its splits, "train" is used.
        options : LearningOptions, optional
            How much evidence an axiom needs; the defaults where left out.
        accept : callable, optional
            Called with the axioms found; returns those to add. All are added without it.
        set_aside : callable, optional
            Called, before anything is learned, with the given axioms that the pictures refute
            (:func:`seewhy.agent.refutation.refuted`), if there are any; returns those to set aside.
            All are without it.
        answers : bool, default True
            False leaves the recurrent network out.

        Raises
        ------
        DatasetError
            If the dataset is of another domain, or there is one class only.
        """
        from seewhy.agent import axiom_revision
        from seewhy.agent.learning_from_pictures import Learning
        from seewhy.induction.axiom_learning import DEFAULTS

        options = DEFAULTS if options is None else options
        counted = self.training_pictures.counted
        scenes = axiom_revision.scenes_to_learn_from(dataset, self.known, counted=counted)
        before = len(self.withdrawn)
        self.known = axiom_revision.without_what_is_wrong(
            self.known, scenes, tolerance=options.tolerance, set_aside=set_aside
        )
        found = axiom_revision.proposed_axioms(self.known, scenes, options=options)
        chosen = tuple(found.axioms if accept is None else accept(found.axioms))
        self.known = axiom_revision.extended(self.known, chosen)
        self.training_pictures = self.training_pictures.and_classes_of(dataset)
        self.fit_induction(scenes.vectors, scenes.labels, answers=answers)
        return Learning(
            found.axioms,
            self.learned[len(self.learned) - len(chosen) :],
            self.withdrawn[before:],
            found.learned.judgements,
            found.learned.tree,
            found.learned.accepted_leaves,
        )

    def withdraw(self, identifier: str, *, reason: str = "a person withdrew it") -> Withdrawn:
        """Know a learned axiom no more; the tree and the answers are trained again without it.

        Raises
        ------
        KnowledgeError
            If no learned axiom has this identifier.
        """
        gone = Withdrawn(str(self.known.learned_axiom(identifier)), reason)
        self.know(self.known.withdrawing(gone))
        return gone

    def restore(self, identifier: str) -> Axiom:
        """Know a given axiom again that was set aside.

        Raises
        ------
        KnowledgeError
            If no axiom with this identifier is set aside.
        """
        axiom = self.known.axiom_set_aside(identifier)
        self.know(self.known.restoring(axiom))
        return axiom

    def know(self, known: WorkingKnowledge) -> None:
        """Reason with this, and learn from what is remembered what it leaves open."""
        from seewhy.agent.learning_from_pictures import AnnotatedScenes

        self.known = known
        scenes = AnnotatedScenes.of_experience(known.experience)
        self.fit_induction(scenes.vectors, scenes.labels, answers=self.answerer is not None)
