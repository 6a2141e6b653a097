"""What a result of Label Studio says: where its region is, how it is labelled, what was chosen."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from seewhy.data.importers.boxes import around_turned
from seewhy.data.importers.tables import known


class Result(BaseModel):
    """A result, as a task has it; of what it may hold, only what is read."""

    model_config = ConfigDict(extra="ignore")

    id: str | int | None = None
    from_name: str = Field(default="", max_length=500)
    type: str = Field(default="", max_length=200)
    value: dict[str, Any] = Field(default_factory=dict)
    original_width: float | None = Field(default=None, gt=0, le=1e6)
    original_height: float | None = Field(default=None, gt=0, le=1e6)
    image_rotation: float = 0.0


def labels_of(result: Result) -> list[str]:
    """The labels of a region: rectanglelabels, polygonlabels, labels, …"""
    return [
        label.strip()
        for key, value in result.value.items()
        if key.endswith("labels") and isinstance(value, list)
        for label in value
        if isinstance(label, str) and label.strip()
    ]


def said_of(result: Result) -> list[str]:
    """What a control says in words: choices, the ends of a taxonomy, a rating, a number."""
    value = result.value
    choices = value.get("choices")
    if isinstance(choices, str):
        choices = [choices]
    if isinstance(choices, list):
        return [known(choice) for choice in choices if isinstance(choice, str)]
    paths = value.get("taxonomy")
    if isinstance(paths, list):
        return [known(path[-1]) for path in paths if isinstance(path, list) and path]
    return [
        known(value[key]) for key in ("rating", "number") if isinstance(value.get(key), int | float)
    ]


def corners_of(result: Result) -> tuple[float, float, float, float] | None:
    """Left, top, right and bottom in shares of the picture."""
    value = result.value
    width, height = result.original_width or 1.0, result.original_height or 1.0
    points = value.get("points")
    if isinstance(points, list) and len(points) > 2:
        pairs = [_numbers(point) for point in points if isinstance(point, list) and len(point) == 2]
        if len(pairs) == len(points) and all(pairs):
            across, down = [pair[0] for pair in pairs], [pair[1] for pair in pairs]
            return (min(across) / 100, min(down) / 100, max(across) / 100, max(down) / 100)
        return None
    corner = _numbers([value.get("x"), value.get("y")])
    size = _numbers([value.get("width"), value.get("height")])
    radii = _numbers([value.get("radiusX"), value.get("radiusY")])
    turned = _numbers([value.get("rotation", 0)])
    if not corner or not (size or radii):
        return None
    if radii:
        box = (
            corner[0] - radii[0],
            corner[1] - radii[1],
            corner[0] + radii[0],
            corner[1] + radii[1],
        )
    else:
        box = (corner[0], corner[1], corner[0] + size[0], corner[1] + size[1])
    # It is turned around its corner (an ellipse around its centre) on the picture in pixels.
    left, top, right, bottom = around_turned(
        (box[0] * width, box[1] * height, box[2] * width, box[3] * height),
        turned[0] if turned else 0.0,
        pivot=(corner[0] * width, corner[1] * height),
    )
    return (
        left / width / 100, top / height / 100, right / width / 100, bottom / height / 100
    )  # fmt: skip


def _numbers(values: list[Any]) -> list[float]:
    """The numbers of a list; none where one of them is no number of reasonable size."""
    found = [
        float(value)
        for value in values
        if isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= 1e7
    ]
    return found if len(found) == len(values) else []
