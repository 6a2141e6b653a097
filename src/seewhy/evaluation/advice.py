"""What the figures of an evaluation suggest, in words; each sentence follows from them alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from seewhy.domain.tables import CLASS
from seewhy.evaluation.share import Share
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.evaluation.recognition import Recognition
    from seewhy.evaluation.result import Evaluation

__all__ = ["ENOUGH", "Shown", "advice", "few_pictures", "training_notice"]

ENOUGH = 40
"""So many pictures to train on should show a value that is not recognised well."""

WELL = 0.95
"""Of a value that is recognised so often no more pictures are asked for."""

UNCERTAIN = 0.1
"""An accuracy whose interval is wider is said to be uncertain."""

UNBALANCED = 0.1
"""So far below the accuracy the balanced accuracy is spoken of."""

SHOWN = 5
"""So many values are named in a sentence, or with a sentence each."""


def advice(evaluation: Evaluation) -> tuple[str, ...]:
    """Return sentences for whoever wants better figures, what matters most first.

    What is said: that pictures were trained on; how uncertain figures of few pictures are; what is
    not clearly better than always saying the most frequent value; which feature holds the class
    back, and how much is the fault of the knowledge; of which values there are too few pictures;
    what is never recognised; what is said too surely; which feature could be dropped.
    """
    return tuple(
        f"{sentence[:1].upper()}{sentence[1:]}"
        for part in (
            _trained_on,
            _uncertain,
            _majority,
            _held_back,
            _unbalanced,
            _never_recognised,
            _too_few,
            _not_evaluated,
            _miscalibrated,
            _droppable,
        )
        for sentence in part(evaluation)
    )


def training_notice(*, seen: int, scenes: int, has_splits: bool) -> str | None:
    """Say that pictures were trained on, if some were: of them figures prove nothing.

    Parameters
    ----------
    seen, scenes : int
        Pictures that were trained on, and all that are evaluated.
    has_splits : bool
        Whether the dataset keeps pictures for evaluation.

    Examples
    --------
    >>> training_notice(seen=2, scenes=9, has_splits=True)
    '2 of 9 pictures were trained on; results on them prove nothing'
    """
    if not seen:
        return None
    said = f"{seen} of {scenes} pictures were trained on; results on them prove nothing"
    if has_splits:
        return said
    return (
        f"{said}: the table keeps none for evaluation; add a column split, with test in a quarter "
        "of the rows, and train again"
    )


def _trained_on(evaluation: Evaluation) -> Iterator[str]:
    notice = evaluation.training_notice
    if notice is not None:
        yield f"{notice}."


def _uncertain(evaluation: Evaluation) -> Iterator[str]:
    share = evaluation.class_recognition.confusion.share
    low, high = share.interval
    if high - low > UNCERTAIN:
        yield (
            f"{share.of} pictures are few to evaluate on: {percent(share.value)} of the classes "
            f"were right, which may as well be {percent(low)} to {percent(high)}."
        )
    if 2 * evaluation.groups <= evaluation.scenes:
        yield (
            f"The {evaluation.scenes} pictures are of {evaluation.groups} groups: figures are less "
            "certain than their intervals, which take pictures as independent."
        )


def _majority(evaluation: Evaluation) -> Iterator[str]:
    for key, recognition in _recognitions(evaluation):
        confusion = recognition.confusion
        if len(confusion.pictures) < 2:
            yield (
                f"All {confusion.share.of} pictures evaluated have {_named(key)} "
                f"{confusion.majority}: whether others are recognised is not known."
            )
        elif confusion.share.interval[0] <= confusion.majority_share.value:
            better = confusion.share.value > confusion.majority_share.value
            verdict = "so few pictures do not tell whether" if better else "it is not so that"
            yield (
                f"{_named(key)}: {percent(confusion.share.value)} are right, "
                f"{percent(confusion.majority_share.value)} would be by always saying "
                f"{confusion.majority}; {verdict} the model is better than that."
            )


def _held_back(evaluation: Evaluation) -> Iterator[str]:
    found = evaluation.redecided
    if not found.wrong:
        return
    ranked = sorted(
        (key for key, count in found.mended.items() if count > found.spoilt[key]),
        key=lambda key: found.spoilt[key] - found.mended[key],
    )
    if ranked:
        most, *others = ranked
        lost = found.spoilt[most]
        also = "; ".join(f"{found.mended[key]} for {_named(key)}" for key in others[:SHOWN])
        yield (
            f"{_named(most)} holds the class back most: {found.mended[most]} of {found.wrong} "
            f"wrong classes would be right if only it were read rightly"
            f"{f' (and {lost} right would be wrong)' if lost else ''}"
            f"{f'; {also}' if also else ''}."
        )
    if found.not_known:
        yield (
            f"{found.not_known} of {found.wrong} wrong classes are of pictures that the model says "
            "it does not know."
        )
    rest = found.wrong - found.not_known - found.mended_by_all
    # Of scenes that are annotated alike and have several classes, all but one class are wrong.
    left_open = round((1.0 - evaluation.determined) * evaluation.scenes)
    if rest:
        alike = "pictures that are annotated alike have several classes"
        if rest <= left_open:
            fault = (
                f"the features do not tell: {alike}, which one more feature or better annotation "
                "would have to tell apart"
            )
        else:
            fault = (
                "the knowledge, the tree or the annotation is at fault, not what is seen; 'seewhy "
                "learn' looks for axioms that are missing"
            )
            if left_open:
                fault += f", but {left_open} of {evaluation.scenes} no axiom tells: {alike}"
        yield (
            f"{rest} of {found.wrong} wrong classes would stay wrong with every annotated feature "
            f"read rightly. There {fault}."
        )


def _unbalanced(evaluation: Evaluation) -> Iterator[str]:
    for key, recognition in _recognitions(evaluation):
        confusion = recognition.confusion
        if confusion.share.value - confusion.balanced_accuracy > UNBALANCED:
            yield (
                f"{_named(key)}: {percent(confusion.share.value)} are right of all pictures, but "
                f"{percent(confusion.balanced_accuracy)} where every value counts alike: what is "
                "rare is recognised worse."
            )


def _never_recognised(evaluation: Evaluation) -> Iterator[str]:
    for key, recognition in _recognitions(evaluation):
        confusion = recognition.confusion
        never = [value for value, share in confusion.recall.items() if not share.right]
        for value in never[:SHOWN]:
            taken = next(said for true, said, _ in confusion.confused if true == value)
            number = confusion.pictures[value]
            yield (
                f"{'The only picture' if number == 1 else f'None of {number} pictures'} of "
                f"{_value(key, value)} was {'not ' if number == 1 else ''}recognised; "
                f"{'it was' if number == 1 else 'most were'} "
                f"{'left undecided' if taken is None else f'taken for {taken}'}."
            )


def _too_few(evaluation: Evaluation) -> Iterator[str]:
    yield from few_pictures(
        Shown(key, value, number, recognition.confusion.recall.get(value))
        for key, recognition in _recognitions(evaluation)
        for value, number in evaluation.training_pictures[key].items()
        if not (key == CLASS and value in evaluation.without)
    )


@dataclass(frozen=True)
class Shown:
    """How many pictures teach a value, and how well it is recognised.

    Attributes
    ----------
    key, value : str
        A feature, or ``class``, and its value.
    pictures : int
        To train on that show it.
    recognised : Share or None
        Of evaluated pictures that show it; None where none does.
    """

    key: str
    value: str
    pictures: int
    recognised: Share | None


def few_pictures(values: Iterable[Shown]) -> Iterator[str]:
    """Say of which values too few pictures are there to learn them, and how many more to label.

    Examples
    --------
    >>> from seewhy.evaluation.share import Share
    >>> for sentence in few_pictures([Shown("light", "dim", 12, Share(3, 4))]):
    ...     print(sentence)
    12 pictures to train on show light = dim, 75.0 % of 4 evaluated were recognised: label 30 more.
    """
    cases = [
        shown
        for shown in values
        if shown.pictures < ENOUGH and (shown.recognised is None or shown.recognised.value < WELL)
    ]
    # What nothing was learned of first, then what is recognised worst.
    cases.sort(
        key=lambda case: (
            case.pictures > 0,
            case.recognised.value if case.recognised else 1.0,
            case.pictures,
        )
    )
    for case in cases[:SHOWN]:
        number, share = case.pictures, case.recognised
        more = 10 * math.ceil((ENOUGH - number) / 10)
        shown = f"{number or 'no'} picture{'s' * (number > 1)} to train on"
        judged = (
            "no picture evaluated does"
            if share is None
            else f"{percent(share.value)} of {share.of} evaluated {_were(share.of)} recognised"
        )
        yield (
            f"{shown} show{'s' * (number < 2)} {_value(case.key, case.value)}, "
            f"{judged}: label {more}{' more' if number else ''}."
        )
    if len(cases) > SHOWN:
        yield (
            f"{len(cases) - SHOWN} more values have fewer than {ENOUGH} pictures to train on and "
            "are not recognised well."
        )


def _not_evaluated(evaluation: Evaluation) -> Iterator[str]:
    missing = [
        _value(key, value)
        for key, recognition in _recognitions(evaluation)
        for value, number in evaluation.training_pictures[key].items()
        if number >= ENOUGH and value not in recognition.confusion.recall
    ]
    if missing:
        more = f" and {len(missing) - SHOWN} more" if len(missing) > SHOWN else ""
        yield (
            f"No picture evaluated shows {_listed(missing[:SHOWN])}{more}: how well such are "
            "recognised is not known."
        )


def _miscalibrated(evaluation: Evaluation) -> Iterator[str]:
    surer: list[str] = []
    less_sure: list[str] = []
    for key, recognition in _recognitions(evaluation):
        found = recognition.calibration
        if not found.off_by_chance:
            (surer if found.said > found.share.value else less_sure).append(
                f"{_named(key)} ({percent(found.said)} said, {percent(found.share.value)} right)"
            )
    for what, named in (
        ("Surer than it is right, on average", surer),
        ("Right more often than it is sure, on average", less_sure),
    ):
        if named:
            yield f"{what}: {', '.join(named)}."


def _droppable(evaluation: Evaluation) -> Iterator[str]:
    for key, depends in evaluation.depended_on.items():
        if not depends and not evaluation.asked_by_axioms[key]:
            yield (
                f"No class of these pictures depends on {_named(key)}, and no axiom speaks of it: "
                "it could be dropped, unless somebody asks about it."
            )


def _recognitions(evaluation: Evaluation) -> list[tuple[str, Recognition]]:
    return [(CLASS, evaluation.class_recognition), *evaluation.feature_recognition.items()]


def _named(key: str) -> str:
    return "the class" if key == CLASS else f"'{key}'"


def _value(key: str, value: str) -> str:
    return f"the class {value}" if key == CLASS else f"{key} = {value}"


def _were(number: int) -> str:
    return "was" if number == 1 else "were"


def _listed(parts: Sequence[str]) -> str:
    return " or ".join(filter(None, [", ".join(parts[:-1]), parts[-1]]))
