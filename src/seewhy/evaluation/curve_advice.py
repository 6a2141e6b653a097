"""Whether more labels would help, in words, from a learning curve."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.evaluation.curve import LearningCurve

__all__ = ["curve_advice"]

LEVEL = 0.05
"""Of the test whether the last step of the curve is a gain or chance."""


def curve_advice(curve: LearningCurve) -> tuple[str, ...]:
    """Say whether the last step of a learning curve was a gain, and what the next may bring.

    The last two points are compared picture by picture (the sign test, two-sided, 5 %). The
    accuracy of twice as many pictures supposes that the share of wrong classes shrinks once more
    as it did; it is no more than the annotated features tell.
    """
    return tuple(_sentences(curve))


def _sentences(curve: LearningCurve) -> Iterator[str]:
    from scipy.stats import binomtest  # slow to import, and answering needs none of it

    if curve.skipped:
        numbers = ", ".join(f"{count:,}" for count, _ in curve.skipped)
        yield f"No model could be trained on {numbers} pictures: {curve.skipped[-1][1]}."
    if len(curve.points) < 2:
        yield "One point is no curve: there are too few pictures to train on parts of them."
        return
    fewer, most = curve.points[-2:]
    steps = f"{fewer.pictures:,} to {most.pictures:,} pictures to train on"
    pairs = list(zip(fewer.right, most.right, strict=True))
    mended, spoilt = pairs.count((False, True)), pairs.count((True, False))
    before, after = (sum(point.right) / curve.held_out for point in (fewer, most))
    told = bool(mended + spoilt) and binomtest(mended, mended + spoilt).pvalue < LEVEL
    step = (
        f"From {steps}, {mended} of {curve.held_out} held-out classes became right and {spoilt} "
        f"wrong ({percent(before)} to {percent(after)})"
    )
    if told and mended > spoilt:
        reached = 1.0 - (1.0 - after) ** 2 / (1.0 - before)
        next_share = min(reached, max(after, curve.determined))
        yield (
            f"{step}: more labels help. Twice as many may bring about {percent(next_share)}, if "
            "mistakes go on to become fewer as they did."
        )
    elif told:
        yield f"{step}: more labels did harm; look at the annotation of what was added."
    elif after == 1.0:
        yield f"{step}: nothing is left to gain on these pictures."
    else:
        yield (
            f"{step}: no more than chance. More labels of the same kind may help little; "
            f"{curve.held_out} held-out pictures do not tell smaller gains from none."
        )
    yield from _features(curve)


def _features(curve: LearningCurve) -> Iterator[str]:
    """Name the feature that gained most in the last step."""
    fewer, most = curve.points[-2:]
    gains = {
        key: recognition.confusion.share.value
        - fewer.feature_recognition[key].confusion.share.value
        for key, recognition in most.feature_recognition.items()
    }
    if gains and max(gains.values()) > 0.0:
        key = max(gains, key=lambda key: gains[key])
        yield f"Of the features, '{key}' gained most: {100 * gains[key]:.1f} points."
