"""What every importer makes of a source: pictures with what somebody said about them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Box:
    """A thing in a picture: its bounding box, what it is, and what else is said about it.

    Left and top count from the picture's top left corner; right and bottom are the first that
    lie outside. The unit is that of :attr:`AnnotatedPicture.measured_in`.
    """

    left: float
    top: float
    right: float
    bottom: float
    kind: str
    attributes: Mapping[str, str] = field(default_factory=dict)

    @property
    def area(self) -> float:
        """How much of the picture it covers; 0 for an empty box."""
        return max(0.0, self.right - self.left) * max(0.0, self.bottom - self.top)


@dataclass(frozen=True)
class AnnotatedPicture:
    """One picture of a source, in the source's own words.

    Attributes
    ----------
    file : str
        The picture's name among the files of the source.
    class_name : str
        Empty where nobody said it.
    features : mapping of str to str
        Only what somebody said.
    boxes : tuple of Box
    split, group : str
        Empty where the source has none; a split is one of "train", "validation" and "test".
    measured_in : pair of float or None
        The width and height in whose unit boxes are: pixels as the tool saw the picture, (1, 1)
        for shares; None for pixels of the picture as it is.
    reasons : tuple of str
        The features that somebody named as why it is of its class.
    """

    file: str
    class_name: str = ""
    features: Mapping[str, str] = field(default_factory=dict)
    boxes: tuple[Box, ...] = ()
    split: str = ""
    group: str = ""
    measured_in: tuple[float, float] | None = None
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True)
class Note:
    """Something that was not as it should be, and where.

    Examples
    --------
    >>> Note("boxes outside of their picture, left out", ("a.jpg", "b.jpg")).say(most=1)
    'boxes outside of their picture, left out (2): a.jpg; and 1 more'
    """

    text: str
    places: tuple[str, ...] = ()

    def say(self, *, most: int = 5) -> str:
        """Return one line; of the places, at most so many."""
        if not self.places:
            return self.text
        more = len(self.places) - most
        shown = "; ".join(self.places[:most]) + f"; and {more} more" * (more > 0)
        return f"{self.text} ({len(self.places):,}): {shown}"


def readable(text: str) -> str:
    """Return text that can be written: what a file name has of no known letters becomes "?".

    Examples
    --------
    >>> readable(b"caf\\xe9".decode(errors="surrogateescape"))
    'caf?'
    """
    return text.encode("utf-8", errors="replace").decode()


class Notes:
    """Collects notes while a source is read.

    Examples
    --------
    >>> notes = Notes()
    >>> notes.add("empty files", "a.jpg")
    >>> notes.add("empty files", "b.jpg")
    >>> notes.all()
    (Note(text='empty files', places=('a.jpg', 'b.jpg')),)
    """

    def __init__(self) -> None:
        self._places: dict[str, list[str]] = {}

    def add(self, text: str, place: str | None = None) -> None:
        """Note something; equal texts become one note with all their places."""
        places = self._places.setdefault(text, [])
        if place is not None:
            places.append(readable(place))

    def count(self, text: str) -> int:
        """How many places a note has so far."""
        return len(self._places.get(text, ()))

    def places(self, text: str) -> tuple[str, ...]:
        """The places of a note so far."""
        return tuple(self._places.get(text, ()))

    def all(self) -> tuple[Note, ...]:
        """What was noted, in the order of the first of each."""
        return tuple(Note(text, tuple(places)) for text, places in self._places.items())
