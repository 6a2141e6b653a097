"""An evaluation as tables on the screen, with what its figures say."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seewhy.cli.screen import add_row, output, say, share_of_cases, table
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.evaluation import Evaluation
    from seewhy.evaluation.curve import LearningCurve
    from seewhy.evaluation.share import Share

MOST = 12
"""So many rows of classes, values and confusions are printed."""


def print_evaluation(result: Evaluation) -> None:
    """Print an evaluation as tables, and the advice that follows from it."""
    seen = result.seen_in_training
    trained_on = f", {seen} of them trained on: results on them prove nothing" if seen else ""
    say(f"{result.scenes} scenes{trained_on}")
    print_recognised(result)
    rows = table("measured on", ">share")
    add_row(rows, "the best over the annotated features", percent(result.determined))
    for method, share in result.accuracy_by_method.items():
        add_row(rows, f"classes decided by {method}", percent(share))
    add_row(rows, "decided by knowledge", percent(result.decided_by_knowledge))
    if result.unknown:
        add_row(rows, "said not to be known", percent(result.unknown))
    add_row(rows, "answers (every relevant attribute)", percent(result.answer_accuracy))
    add_row(rows, "answers, strict (and no other)", percent(result.answer_accuracy_strict))
    add_row(rows, "explanatory answers", percent(result.explanation_accuracy))
    add_row(rows, "explanatory answers, strict", percent(result.explanation_accuracy_strict))
    output().print(rows)
    print_classes(result)
    print_values(result)
    print_confused(result)
    print_axioms(result)
    print_sentences("what the figures say", result.advice())


def print_recognised(result: Evaluation) -> None:
    """Print accuracies beside the majority's, balanced, with their intervals; and calibration."""
    recognitions = {"classification": result.class_recognition}
    recognitions |= {
        f"feature {key}": recognition for key, recognition in result.feature_recognition.items()
    }
    rows = table("recognised", ">right", ">95 % interval", ">majority", ">balanced", ">pictures")
    for name, recognition in recognitions.items():
        confusion = recognition.confusion
        add_row(
            rows,
            name,
            percent(confusion.share.value),
            interval(confusion.share),
            percent(confusion.majority_share.value),
            percent(confusion.balanced_accuracy),
            str(confusion.share.of),
        )
    output().print(rows)
    rows = table("how sure", ">said on average", ">right", ">calibration error")
    for name, recognition in recognitions.items():
        calibration = recognition.calibration
        if calibration.share.of:
            add_row(
                rows,
                name,
                percent(calibration.said),
                percent(calibration.share.value),
                percent(calibration.error),
            )
    output().print(rows)


def interval(share: Share) -> str:
    """The ends of the interval of a share, as short as may be.

    Examples
    --------
    >>> from seewhy.evaluation.share import Share
    >>> interval(Share(18, 20))
    '69.9 to 97.2 %'
    """
    low, high = share.interval
    return f"{100 * low:.1f} to {100 * high:.1f} %"


def print_classes(result: Evaluation, *, most: int = MOST) -> None:
    """Print the classes that no picture was shown of, and the least well recognised of the rest."""
    recall = result.class_recognition.confusion.recall
    worst = sorted(recall, key=lambda label: (label not in result.without, recall[label].value))
    rows = table("class", ">pictures", ">classified rightly")
    for label in worst[: max(most, len(result.without))]:
        note = " (left out of training)" if label in result.without else ""
        add_row(rows, f"{label}{note}", str(recall[label].of), percent(recall[label].value))
    more = len(worst) - most
    if more > 0:
        add_row(rows, f"{more} more, each at least", "", percent(recall[worst[-more]].value))
    output().print(rows)


def print_values(result: Evaluation) -> None:
    """Print the values of features that are recognised worst, with the number of their pictures."""
    worst = sorted(
        (
            (f"{key} = {value}", share)
            for key, recognition in result.feature_recognition.items()
            for value, share in recognition.confusion.recall.items()
        ),
        key=lambda row: row[1].value,
    )
    rows = table("value", ">pictures", ">recognised")
    for name, share in worst[:MOST]:
        add_row(rows, name, str(share.of), percent(share.value))
    if len(worst) > MOST:
        more = len(worst) - MOST
        add_row(rows, f"{more} more, each at least", "", percent(worst[MOST][1].value))
    if worst:
        output().print(rows)


def print_confused(result: Evaluation) -> None:
    """Print what was most often taken for what."""
    recognitions = {"class": result.class_recognition, **result.feature_recognition}
    found = sorted(
        (
            (key, *case)
            for key, recognition in recognitions.items()
            for case in recognition.confusion.confused
        ),
        key=lambda row: (-row[3], row[0] != "class"),
    )
    rows = table("confused", "annotated", "said", ">pictures")
    for key, true, said, count in found[:MOST]:
        add_row(rows, key, true, said or "undecided", str(count))
    if len(found) > MOST:
        add_row(rows, f"{len(found) - MOST} more", "", "", f"at most {found[MOST][3]}")
    if found:
        output().print(rows)


def print_axioms(result: Evaluation) -> None:
    """Print how often axioms applied and were right, on the annotated features.

    All of a few, in the order of their file; of many those that were wrong most often.
    """
    axioms = list(result.axioms)
    if len(axioms) > MOST:
        axioms.sort(
            key=lambda record: (record.accuracy is None, record.accuracy or 0.0, -record.decided)
        )
    rows = table("axiom", ">decides", ">right")
    for axiom in axioms[:MOST]:
        add_row(rows, axiom.statement, str(axiom.decided), share_of_cases(axiom.accuracy))
    more = axioms[MOST:]
    if more:
        decided = sum(axiom.decided for axiom in more)
        least = more[0].accuracy
        say_right = share_of_cases(least) if least is None else f"at least {percent(least)}"
        add_row(rows, f"{len(more)} more", str(decided), say_right)
    output().print(rows)


def print_curve(curve: LearningCurve) -> None:
    """Print a learning curve as a table, and whether more labels would help."""
    keys = list(curve.points[-1].feature_recognition)
    rows = table(">trained on", ">class", ">95 % interval", *(f">{key}" for key in keys))
    for point in curve.points:
        share = point.class_recognition.confusion.share
        add_row(
            rows,
            f"{point.pictures:,}",
            percent(share.value),
            interval(share),
            *(
                percent(recognition.confusion.share.value)
                for recognition in point.feature_recognition.values()
            ),
        )
    output().print(rows)
    print_sentences("what the curve says", curve.sentences())


def print_sentences(title: str, sentences: tuple[str, ...]) -> None:
    """Print sentences under a title, if there are some."""
    if sentences:
        say(f"{title}:")
    for sentence in sentences:
        say(f"  - {sentence}")
