"""When to say "I don't know": of a picture less like those of training than others of its kind."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["KNOWN_SHARE", "refusal_threshold"]

KNOWN_SHARE = 0.995
"""Of two hundred pictures like those of training one is refused in vain, where eyes see."""


def refusal_threshold(scores: Sequence[float], *, known_share: float) -> float | None:
    """Return the score below which a picture is not known.

    The threshold is that of split conformal prediction: of new pictures like the given ones, at
    least ``known_share`` reach it, on average over what the given ones may be. For shares near
    to 1 that takes many pictures: 19 for a share of 0.95, 99 for 0.99, 199 for 0.995.

    Parameters
    ----------
    scores : sequence of float
        Of pictures that the networks were not trained on, see
        :class:`seewhy.perception.familiarity.Familiarity`.
    known_share : float
        Above 0, at most 1; 1 refuses no picture.

    Returns
    -------
    float or None
        None where no picture is refused: ``known_share`` is 1, or there are too few pictures to
        keep it.

    Examples
    --------
    >>> refusal_threshold([0.6, 0.98, 0.93, 0.99], known_share=0.75)
    0.6
    >>> refusal_threshold([0.6, 0.98], known_share=0.75) is None
    True
    """
    # A share such as 0.99 is no binary number: 0.01 * 100 must not come out below 1.
    refused = int((1.0 - known_share) * (len(scores) + 1) + 1e-9)
    return sorted(scores)[refused - 1] if refused else None
