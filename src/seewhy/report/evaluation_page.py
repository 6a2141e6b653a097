"""The page of an evaluation: figures, advice, confusions, the wrong pictures, a learning curve."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from seewhy import __version__
from seewhy.domain.tables import CLASS
from seewhy.report.card import embedded
from seewhy.report.html import rendered
from seewhy.report.line_chart import Line, Point, draw_lines

if TYPE_CHECKING:
    from seewhy.domain.domain import Domain
    from seewhy.evaluation import Evaluation, WrongPicture
    from seewhy.evaluation.confusion import Confusion
    from seewhy.evaluation.curve import LearningCurve
    from seewhy.evaluation.recognition import Recognition
    from seewhy.report.figure import Figure

__all__ = ["MOST_PICTURES", "draw_curve", "evaluation_page"]

MOST_PICTURES = 100
"""So many wrong pictures a page shows where nothing else is asked for."""

_TABLE = 12
"""Of more values than these only what was confused is listed."""

_CONFUSED = 40
"""So many confusions are listed, the most frequent ones."""

_SIDE = 112
"""Of the pictures on the page, in pixels."""

_LINES = 6
"""So many features are drawn in a chart beside the class."""


def evaluation_page(
    domain: Domain, evaluation: Evaluation, *, command: str, most: int = MOST_PICTURES
) -> str:
    """Return an evaluation as the text of an HTML file that opens with no network.

    Parameters
    ----------
    domain : Domain
    evaluation : Evaluation
    command : str
        The command that makes the page, for its last line.
    most : int, default 100
        How many of the wrong pictures to show.
    """
    recognitions = [(CLASS, "class", evaluation.class_recognition)]
    recognitions += [
        (key, domain.features[key].name, recognition)
        for key, recognition in evaluation.feature_recognition.items()
    ]
    return rendered(
        "evaluation.html",
        domain=domain,
        evaluation=evaluation,
        notice=evaluation.training_notice,
        advice=[*evaluation.advice(), *(evaluation.curve.sentences() if evaluation.curve else ())],
        recognitions=[
            _recognition(domain, key, name, recognition, evaluation.training_pictures[key])
            for key, name, recognition in recognitions
        ],
        wrong=[_wrong(domain, picture) for picture in evaluation.wrong[:most]],
        wrong_classes=sum(picture.wrong_class for picture in evaluation.wrong),
        curve=evaluation.curve,
        curve_figure=draw_curve(evaluation.curve).svg if evaluation.curve else "",
        version=__version__,
        command=command,
    )


def draw_curve(curve: LearningCurve) -> Figure:
    """Draw accuracies over the number of training pictures, the class and up to six features.

    The bands are the 95 % intervals; the features with the lowest accuracy at the end are drawn.
    """
    last = curve.points[-1].feature_recognition
    shown = sorted(last, key=lambda key: last[key].confusion.share.value)[:_LINES]
    series: list[tuple[str, list[Recognition]]] = [
        (CLASS, [point.class_recognition for point in curve.points]),
        *((key, [point.feature_recognition[key] for point in curve.points]) for key in shown),
    ]
    labels = [f"{point.pictures:,}" for point in curve.points]
    lines = [
        Line(
            name,
            tuple(
                Point(label, one.confusion.share.value, *one.confusion.share.interval)
                for label, one in zip(labels, recognitions, strict=True)
            ),
        )
        for name, recognitions in series
    ]
    return draw_lines(lines, labels, across="pictures to train on", up="recognised")


def _recognition(
    domain: Domain, key: str, name: str, recognition: Recognition, trained_on: Mapping[str, int]
) -> dict[str, Any]:
    confusion, calibration = recognition.confusion, recognition.calibration
    return {
        "name": name,
        "confusion": confusion,
        "calibration": calibration,
        "values": [
            {
                "name": _said(domain, key, value),
                "share": share,
                "trained_on": trained_on[value],
                "taken": [
                    (_said(domain, key, said), count)
                    for true, said, count in confusion.confused
                    if true == value
                ][:3],
            }
            for value, share in confusion.recall.items()
        ],
        "matrix": _matrix(confusion) if len(confusion.values) <= _TABLE else None,
        "confused": confusion.confused[:_CONFUSED],
        "more_confused": max(0, len(confusion.confused) - _CONFUSED),
    }


def _matrix(confusion: Confusion) -> dict[str, Any]:
    """The table of a few values, with a column for what was left undecided if anything was."""
    undecided = any(confusion.undecided)
    rows = [
        (value, [*counts, *([left] if undecided else [])], position)
        for position, (value, counts, left) in enumerate(
            zip(confusion.values, confusion.counts, confusion.undecided, strict=True)
        )
        if value in confusion.pictures
    ]
    return {"columns": [*confusion.values, *(["undecided"] if undecided else [])], "rows": rows}


def _wrong(domain: Domain, picture: WrongPicture) -> dict[str, Any]:
    return {
        "image": picture.image,
        "data": embedded(picture.picture, size=_SIDE),
        "wrong_class": picture.wrong_class,
        "annotated": _said(domain, CLASS, picture.label) if picture.label else "no class annotated",
        "said": _said(domain, CLASS, picture.said)
        if picture.said
        else f"undecided: {picture.verdict}",
        "method": picture.method,
        "probability": picture.probability,
        "misread": [
            {
                "name": domain.features[misreading.feature].name,
                "seen": misreading.seen,
                "probability": misreading.probability,
                "annotated": misreading.annotated,
                "overruled": misreading.overruled,
            }
            for misreading in picture.misread
        ],
        "why": _why(domain, picture),
    }


def _why(domain: Domain, picture: WrongPicture) -> str:
    """Say what is at fault where the class is wrong and nothing is known to be misread."""
    if not picture.wrong_class or picture.misread:
        return ""
    if picture.not_annotated:
        names = ", ".join(domain.features[key].name for key in picture.not_annotated)
        return f"nothing annotated was misread; not annotated: {names}"
    at_fault = {
        "knowledge": "the knowledge concludes another class",
        "tree": "the tree says another class",
    }
    said = at_fault.get(picture.method, "nothing decides")
    return f"nothing was misread: {said}, or the annotation is wrong"


def _said(domain: Domain, key: str, value: str | None) -> str:
    if value is None:
        return "undecided"
    return domain.classes[value].say if key == CLASS else value
