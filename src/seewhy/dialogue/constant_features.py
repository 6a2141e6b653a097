"""That of a feature which an answer rests on, training showed one value only."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from seewhy.dialogue.reply import Reply
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words, sentence

__all__ = ["say_only_shown", "with_only_shown"]


def say_only_shown(domain: Domain, features: Collection[str], only_shown: Mapping[str, str]) -> str:
    """Return "of the colour, only red was ever shown" for those of some features; else "".

    A network that was shown one value sees it in every picture.

    Parameters
    ----------
    domain : Domain
    features : collection of str
    only_shown : mapping of str to str
        Feature → the one value that training pictures showed.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> say_only_shown(domain, ["base", "lean"], {"base": "wide"})
    'of the width of the base, only wide was ever shown'
    """
    return join_words(
        [
            f"of the {feature.name}, only {feature.words[only_shown[key]][0]} was ever shown"
            for key, feature in domain.features.items()
            if key in features and key in only_shown
        ]
    )


def with_only_shown(domain: Domain, reply: Reply, only_shown: Mapping[str, str]) -> Reply:
    """Return a reply that says beside its answer of which features one value only was shown."""
    if reply.scene.told:
        return reply
    features = {*reply.kind.mentions, *reply.justification.features()} & reply.features.keys()
    said = say_only_shown(domain, features, only_shown)
    return replace(reply, text=f"{reply.text} {sentence(said)}") if said else reply
