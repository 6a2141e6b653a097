"""The exceptions that SeeWhy raises on purpose: one root, each with a sentence for the user."""

from __future__ import annotations


class SeeWhyError(Exception):
    """Root of all errors that are somebody's to mend; its text is one sentence with the remedy.

    The command line prints the text and exits with code 2. Subclasses double as the builtin
    that fits, so that ``except ValueError`` works as a reader expects.
    """


class DomainError(SeeWhyError, ValueError):
    """A domain folder is missing, incomplete or contradicts itself."""


class KnowledgeError(SeeWhyError, ValueError):
    """A knowledge file cannot be read; the text names the file, line and column."""


class ReasoningError(SeeWhyError, RuntimeError):
    """Grounding or a search for answer sets took more time or memory than it may."""


class DatasetError(SeeWhyError, ValueError):
    """A dataset folder or its scenes.csv cannot be used."""


class PictureError(SeeWhyError, ValueError):
    """A file is not a picture that can be looked at."""


class ModelError(SeeWhyError, ValueError):
    """A model folder is missing, incomplete, edited or belongs to another domain."""


class QuestionError(SeeWhyError, LookupError):
    """A question was not understood; ``nearest`` holds the questions that would have been.

    Parameters
    ----------
    text : str
        The sentence for the user.
    nearest : tuple of str
        Questions that are understood, the nearest first.
    """

    def __init__(self, text: str, *, nearest: tuple[str, ...] = ()) -> None:
        super().__init__(text)
        self.nearest = nearest


class NotFittedError(SeeWhyError, ValueError):
    """An agent was asked before it was trained."""


class RevisionError(SeeWhyError, ValueError):
    """A revision cannot be taken or taken back: what it would change is not there any more."""


class PlanningError(SeeWhyError, ValueError):
    """A goal, a history or a simulation cannot be used as it stands."""


class ExperimentError(SeeWhyError, ValueError):
    """An experiment cannot be run as it was asked for, or its folder cannot be used."""


class SpeechError(SeeWhyError, RuntimeError):
    """An answer cannot be spoken: nothing that speaks is there, or it failed."""


class BusyError(SeeWhyError, BlockingIOError):
    """Another run is writing the file or folder that was to be written."""
