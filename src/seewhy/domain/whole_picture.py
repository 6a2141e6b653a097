"""What a picture of several things is called as a whole, and of which classes it may be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from seewhy.domain.scene_class import SceneClass

__all__ = ["WholePicture"]


@dataclass(frozen=True)
class WholePicture:
    """The picture itself, beside the things in it.

    Attributes
    ----------
    subject : str
        How answers name it: "the structure".
    nouns : tuple of str
        The nouns by which questions may name it.
    classes : mapping of str to SceneClass
        What it may be as a whole; empty where the domain has no classes.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> whole = load_domain("structure_blocks").things.whole
    >>> whole.say("unstable"), whole.nouns[0]
    ('the structure is unstable', 'structure')
    """

    subject: str = "the picture"
    nouns: tuple[str, ...] = ("picture",)
    classes: Mapping[str, SceneClass] = field(default_factory=dict)

    def say(self, label: str, *, be: str = "is") -> str:
        """Return that the picture is of a class."""
        return f"{self.subject} {be} {self.classes[label].say}"
