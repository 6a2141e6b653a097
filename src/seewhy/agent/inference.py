"""What a trained agent concludes: what a picture shows, its class, and answers about it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from seewhy.agent.composition import Composition
from seewhy.agent.deciding import Demands
from seewhy.agent.picture_reading import Reading
from seewhy.agent.seeing import Looking, Pictures
from seewhy.dialogue.question import Question
from seewhy.dialogue.reply import Classification, Reply

if TYPE_CHECKING:
    from seewhy.agent.seeing import Picture
    from seewhy.perception.extractor import Seen
    from seewhy.perception.familiarity import NearPicture
    from seewhy.perception.where import Where

__all__ = ["Inference"]


class Inference(Composition):
    """Reads, decides, classifies and answers; :class:`seewhy.agent.agent.Agent` learns as well."""

    def read(self, pictures: Pictures) -> list[Reading]:
        """Return what the features of pictures are taken to be.

        ``pictures`` is uint8 of shape (scenes, size, size, 3), of :attr:`picture_size`.
        """
        return self.reading_by.read_pictures(pictures, self.reading)

    def decide(self, features: Mapping[str, str | None]) -> str | None:
        """Return the class of named feature values, by knowledge or by the tree."""
        return self.deciding.label_of(self.domain.vector(features))

    def classify(self, image: Picture) -> Classification:
        """Classify one picture (a path, a Pillow image or an array)."""
        return self.classify_all(self._pixels(image)[None])[0]

    def classify_values(self, features: Mapping[str, str]) -> Classification:
        """Classify what is said to be shown instead of seen, as if it were sure.

        ``features`` are named values; those left out are not known.

        Examples
        --------
        >>> import seewhy
        >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
        >>> agent.classify_values({"block_displaced": "yes"}).label
        'unstable'
        """
        return self.deciding.classify_told(features)

    def classify_all(self, pictures: Pictures) -> list[Classification]:
        """Classify pictures, uint8 of shape (scenes, size, size, 3), of :attr:`picture_size`."""
        return self.classify_seen(self.see(pictures))

    def see(self, pictures: Pictures) -> Seen:
        """Return what networks make of pictures; several threads may look at the same time.

        ``pictures`` is as for :meth:`classify_all`.
        """
        return self.seeing.trained.see(pictures)

    def classify_seen(self, seen: Seen) -> list[Classification]:
        """Classify pictures by what networks make of them."""
        readings, scores = self.reading_by.read_and_score(seen, self.reading)
        demands = Demands(self.gate, self.unknown_below, self.settings.believed_from(self.domain))
        return self.deciding.classify(readings, scores, demands)

    def nearest(self, image: Picture, *, count: int = 3) -> tuple[NearPicture, ...]:
        """Return the pictures of training that are most like one, the most alike first.

        Parameters
        ----------
        image : path, Pillow image or array
        count : int, default 3
            At most so many.

        Returns
        -------
        tuple of NearPicture
            Each with its likeness, 0 to 1, and what was annotated of it. None where networks grew
            on the domain's pictures alone: each makes something of its own of a picture.

        Raises
        ------
        NotFittedError, PictureError, DatasetError
            If the agent is not trained; if the image is no picture; if ``count`` is below 1.
        """
        self.seeing.require_trained()
        return self.seeing.nearest(self._pixels(image), count=count)

    def where(self, image: Picture, *, scene: Classification | None = None) -> dict[str, Where]:
        """Return where in a picture each feature is seen, and the class where that has a say.

        Parameters
        ----------
        image : path, Pillow image or array
        scene : Classification, optional
            What the picture is taken to be, as an answer has it; it is classified where left out.

        Returns
        -------
        dict of str to Where
            By feature, and "class"; see :func:`seewhy.perception.where.find_where`.

        Raises
        ------
        NotFittedError, PictureError
            If the agent is not trained; if the image is no picture.
        """
        self.seeing.require_trained()
        pixels = self._pixels(image)
        scene = self.classify_all(pixels[None])[0] if scene is None else scene
        return self.seeing.where(pixels, scene)

    def _pixels(self, image: Picture) -> Pictures:
        """An image as what sees looks at it."""
        from seewhy.perception.picture import as_picture

        return as_picture(image, size=self.picture_size, fit=self.domain.pictures.fit)

    def ask(self, image: Picture, question: str, *, previous: Reply | None = None) -> Reply:
        """Answer a question about a picture.

        Parameters
        ----------
        image : path, Pillow image or array
        question : str
            In plain words, see docs/questions.md; spelling and word forms are forgiven.
        previous : Reply, optional
            The answer before, which "please explain this answer" and "and the base?" are about;
            without it, the classification is explained.

        Raises
        ------
        QuestionError
            If the question is not understood; it names the nearest ones that are.
        PictureError
            If the image is no picture.
        """
        asked = previous.question if previous is not None else None
        understood = self.questions.understand(question, previous=asked)
        return self.answer(self.classify(image), understood, previous=previous, image=image)

    def answer(
        self,
        scene: Classification,
        question: Question,
        *,
        previous: Reply | None = None,
        image: Picture | None = None,
    ) -> Reply:
        """Answer an understood question about a classified scene.

        Raises
        ------
        QuestionError
            If it asks where something is seen or which pictures are similar, and there is no
            ``image``.
        """
        look = None
        if image is not None:
            look = Looking(lambda: self.where(image, scene=scene), lambda: self.nearest(image))
        return self.answering.answer(scene, question, previous=previous, look=look)

    def answer_all(self, asked: Sequence[tuple[Classification, Question]]) -> list[Reply]:
        """Answer many questions about classified scenes; the recurrent network runs once for all.

        The replies are those of :meth:`answer`, one by one.
        """
        return self.answering.answer_all(asked)

    def say_uncertain(self, scene: Classification) -> str:
        """Say of which feature a network is too little sure for the gate."""
        return self.answering.say_uncertain(scene)
