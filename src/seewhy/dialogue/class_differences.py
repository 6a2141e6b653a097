"""In what a scene differs from all annotated pictures of a class."""

from __future__ import annotations

from seewhy.dialogue.reference import Experience
from seewhy.domain.domain import Domain
from seewhy.domain.wording import say_features
from seewhy.induction.sentence import things
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.scene import FeatureVector

__all__ = ["shared_by_pictures"]


def shared_by_pictures(
    domain: Domain, experience: Experience, vector: FeatureVector, label: str
) -> Node | None:
    """Return what all annotated pictures of a class share and a scene has not.

    None where there is nothing such. It is no rule: the text says of how many pictures it is so.
    """
    counts = {
        vector: classes[label] for vector, classes in experience.items() if classes.get(label)
    }
    shared = {
        key: values[0]
        for key, here, values in zip(
            domain.features, vector, map(list, zip(*counts, strict=True)), strict=False
        )
        if here is not None and values[0] not in (None, here) and len({*values}) == 1
    }
    if not shared:
        return None
    features, number = tuple(shared), sum(counts.values())
    of_class = f"of training that {{}} {domain.classes[label].say}"
    which = (
        f"all {number} {things(domain)} {of_class.format('are')} share"
        if number > 1
        else f"the only {domain.scene.replace('_', ' ')} {of_class.format('is')} has"
    )
    there = say_features(domain, domain.vector(shared), features)
    here_said = say_features(domain, vector, features, subject="it")
    return Node(
        str(domain.classes[label].literal),
        f"{which} this: {there}; here {here_said}",
        Basis.PICTURES,
    )
