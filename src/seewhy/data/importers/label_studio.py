"""Label Studio: exports as JSON and as JSON-MIN, with choices and regions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import urlsplit

from pydantic import BaseModel, ConfigDict, Field

from seewhy.data.importers.annotation import AnnotatedPicture, Box
from seewhy.data.importers.boxes import TURNED
from seewhy.data.importers.column_words import class_column
from seewhy.data.importers.json_reading import checked, json_items, json_outline
from seewhy.data.importers.label_studio_result import Result, corners_of, labels_of, said_of
from seewhy.data.importers.picture_files import is_picture_name
from seewhy.data.importers.source import Source, split_in_folders
from seewhy.data.importers.source_files import SourceFiles
from seewhy.data.importers.tables import known
from seewhy.errors import DatasetError
from seewhy.text.nearest import did_you_mean

_IMAGE_KEYS = ("image", "img", "picture", "photo", "file", "url", "path")
_ABOUT_THE_TASK = frozenset(
    {
        "id", "annotator", "annotation_id", "created_at", "updated_at", "lead_time", "agreement",
        "completed_by", "inner_id", "total_annotations", "meta", "file_upload", "storage_filename",
    }
)  # fmt: skip
_NO_REGION = frozenset({"choices", "taxonomy", "rating", "number", "text", "pairwise"})
_UNLABELLED = "thing"


class _Completed(BaseModel):
    model_config = ConfigDict(extra="ignore")

    result: list[Result] = Field(default_factory=list, max_length=100_000)
    was_cancelled: bool = False
    skipped: bool = False
    ground_truth: bool = False
    created_at: str | int | float | None = None
    updated_at: str | int | float | None = None

    @property
    def rank(self) -> tuple[bool, str]:
        """What is declared to be the truth is before the rest, the newest before the older."""
        return (self.ground_truth, str(self.updated_at or self.created_at or ""))


class _Task(BaseModel):
    model_config = ConfigDict(extra="ignore")

    data: dict[str, Any] = Field(min_length=1)
    annotations: list[_Completed] | None = Field(default=None, max_length=10_000)
    completions: list[_Completed] | None = Field(default=None, max_length=10_000)
    file_upload: str | None = None


@dataclass
class _Answers:
    """What was answered about one picture: control → answers, and the boxes."""

    file: str
    answered: bool = False
    choices: dict[str, list[str]] = field(default_factory=dict)
    boxes: list[Box] = field(default_factory=list)

    def add(self, control: str, answers: Iterable[str]) -> None:
        """Add what a control says, once."""
        said = self.choices.setdefault(control, [])
        said.extend(answer for answer in answers if answer and answer not in said)


def is_label_studio(files: SourceFiles, name: str) -> bool:
    """Whether a JSON file is an export of Label Studio by its first item."""
    task = json_outline(files, name, most=1).get("")
    if not isinstance(task, dict):
        return False
    if isinstance(task.get("data"), dict):
        return "annotations" in task or "completions" in task or "predictions" in task
    return "annotation_id" in task or "lead_time" in task or "annotator" in task


def label_studio_files(source: Source) -> list[str]:
    """The exports of Label Studio in a source."""
    return [name for name in source.named(".json") if is_label_studio(source.files, name)]


def read_label_studio(source: Source) -> Iterator[AnnotatedPicture]:
    """Yield the pictures of exports of Label Studio.

    Of the controls that ask about the whole picture, one says the class (see
    :func:`~seewhy.data.importers.column_words.class_column`), the others are features; where a
    picture has several choices of one, each choice is a feature, yes or no. What is asked about
    a region stays with its box.

    Raises
    ------
    DatasetError
        If there is none, or what stands in one is not Label Studio's.
    """
    names = label_studio_files(source) or ([] if source.only is None else [source.only])
    if not names:
        raise source.nothing(
            "no export of Label Studio; export the project as JSON or JSON-MIN and name the file"
        )
    finder = source.finder()
    answers: list[_Answers] = []
    for name in names:
        said = source.files.said(name)
        for key, position, item in json_items(source.files, name):
            place = f"{said}: [{position}]"
            if key or not isinstance(item, dict):
                raise DatasetError(
                    f"{said}: is no export of Label Studio, which is a list of tasks; export the "
                    "project as JSON or JSON-MIN"
                )
            task = item if _is_whole(item) else {"data": item}
            checked_task = checked(_Task, task, place)
            written = _written(checked_task, source, place)
            file = finder.find(written)
            if file is None:
                source.miss(written)
            elif _is_whole(item):
                answers.append(_of_task(source, checked_task, file))
            else:
                answers.append(_of_record(source, item, file, written, place))
    yield from _pictures(source, answers)


def _is_whole(item: Mapping[str, Any]) -> bool:
    return isinstance(item.get("data"), dict)


def _written(task: _Task, source: Source, place: str) -> str:
    """The path of the picture as the task has it."""
    data = {key: value for key, value in task.data.items() if isinstance(value, str)}
    wanted = source.columns.image
    if wanted is not None:
        if wanted not in data:
            raise DatasetError(f"{place}: has no '{wanted}'; {did_you_mean(wanted, data)}")
        return data[wanted]
    candidates = [key for key, value in data.items() if _looks_like_a_picture(value)]
    for key in (*_IMAGE_KEYS, *candidates):
        if key in candidates:
            return data[key]
    if task.file_upload:
        return task.file_upload
    for key in _IMAGE_KEYS:
        if key in data:
            return data[key]
    raise DatasetError(
        f"{place}: names no picture (its data are: {', '.join(task.data) or 'none'}); say which "
        "holds the picture's path with --image-column"
    )


def _looks_like_a_picture(value: str) -> bool:
    path = urlsplit(value).path if "://" in value else value
    return is_picture_name(path) or is_picture_name(value)


def _of_task(source: Source, task: _Task, file: str) -> _Answers:
    answers = _Answers(file)
    completed = [
        answer
        for answer in (task.annotations or task.completions or ())
        if not (answer.was_cancelled or answer.skipped)
    ]
    if not completed:
        return answers
    if len(completed) > 1:
        source.notes.add("pictures that were annotated several times, the newest counts", file)
    chosen = max(completed, key=lambda one: one.rank)
    answers.answered = True
    regions: dict[str, list[Result]] = {}
    for number, result in enumerate(chosen.result):
        regions.setdefault(str(result.id if result.id is not None else -number - 1), []).append(
            result
        )
    for results in regions.values():
        _add_region(source, answers, results)
    return answers


def _of_record(
    source: Source, record: Mapping[str, Any], file: str, written: str, place: str
) -> _Answers:
    """What a record of JSON-MIN says: control → answer, or a list of regions."""
    answers = _Answers(file, answered=True)
    for control, value in record.items():
        if control in _ABOUT_THE_TASK or value == written:
            continue
        values = value if isinstance(value, list) else [value]
        for said in values:
            if isinstance(said, dict):
                region = {"from_name": control, "value": said}
                sides = {
                    side: said[side]
                    for side in ("original_width", "original_height")
                    if side in said
                }
                _add_region(source, answers, [checked(Result, {**region, **sides}, place)])
            elif not isinstance(said, list):
                answers.add(control, [known(said)])
    return answers


def _add_region(source: Source, answers: _Answers, results: list[Result]) -> None:
    """Add what was said about one region, or about the picture as a whole."""
    shaped = next((result for result in results if corners_of(result) is not None), None)
    if shaped is None:
        for result in results:
            said = said_of(result)
            if said:
                answers.add(result.from_name, said)
            elif not _NO_REGION.intersection(result.value) and result.value:
                source.notes.add(
                    "regions without a box (brushes, points), left out",
                    f"{answers.file} {result.from_name}",
                )
        return
    corners = corners_of(shaped)
    if corners is None or shaped.image_rotation % 360:
        source.notes.add(
            "boxes on pictures that were turned while they were labelled, left out", answers.file
        )
        return
    if shaped.value.get("rotation"):
        source.notes.add(TURNED, answers.file)
    kind = next((label for result in results for label in labels_of(result)), _UNLABELLED)
    attributes = {
        result.from_name: ", ".join(said) for result in results if (said := said_of(result))
    }
    answers.boxes.append(Box(*corners, kind, attributes))


def _pictures(source: Source, answers: list[_Answers]) -> Iterator[AnnotatedPicture]:
    controls = list(dict.fromkeys(control for answer in answers for control in answer.choices))
    several = {
        control
        for control in controls
        if any(len(answer.choices.get(control, ())) > 1 for answer in answers)
    }
    single = [control for control in controls if control not in several]
    label = _class_control(source, single, several)
    every = {
        control: list(
            dict.fromkeys(
                choice for answer in answers for choice in answer.choices.get(control, ())
            )
        )
        for control in several
    }
    for answer in answers:
        features: dict[str, str] = {}
        for control in controls:
            chosen = answer.choices.get(control, [])
            if control in several:
                # Nothing ticked in a picture that was labelled means that nothing applies.
                for choice in every[control] if answer.answered else ():
                    features[choice] = "yes" if choice in chosen else "no"
            elif control != label and chosen:
                features[control] = chosen[0]
        yield AnnotatedPicture(
            file=answer.file,
            class_name=next(iter(answer.choices.get(label, ())), "") if label else "",
            features=features,
            boxes=tuple(answer.boxes),
            split=split_in_folders(answer.file),
            measured_in=(1, 1),
        )


def _class_control(source: Source, single: list[str], several: set[str]) -> str | None:
    """The control that says the class."""
    wanted = source.columns.label
    if wanted is not None:
        if wanted in several:
            raise DatasetError(
                f"{source.said}: '{wanted}' has several choices for one picture and cannot be "
                "the class; name another control with --class-column"
            )
        if wanted not in single:
            raise DatasetError(
                f"{source.said}: there is no control '{wanted}'; {did_you_mean(wanted, single)}"
            )
        return wanted
    if len(single) == 1:
        return single[0]
    label = class_column(single)
    if label is not None:
        source.notes.add(f"the control '{label}' is taken as the class")
    elif single:
        source.notes.add(
            f"no control says the class; --class-column names it ({', '.join(single)})"
        )
    return label
