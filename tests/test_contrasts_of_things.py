"""Why the answer about things is not about another thing: "why not the green block?"."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from conftest import Run

TABLE = {
    "scenes": [
        {
            "image_index": 1,
            "objects": [
                {"size": "small", "color": "red", "material": "metal", "shape": "cube"},
                {"size": "large", "color": "blue", "material": "rubber", "shape": "sphere"},
                {"size": "small", "color": "green", "material": "rubber", "shape": "cube"},
                {"size": "small", "color": "yellow", "material": "metal", "shape": "cylinder"},
            ],
            "relationships": {
                "left": [[], [0], [0, 1], [0, 1]],
                "front": [[1, 2, 3], [], [1], [1]],
                "on": [[], [], [3], []],
            },
        }
    ]
}

CONTRASTS = [
    (
        "which blocks are left of the ball?",
        "why not the green block?",
        "The small green rubber cube is not left of the large blue rubber sphere.",
    ),
    (
        "which blocks are left of the ball?",
        "and why not the red block?",
        "But the small red metal cube is one: it is a cube and it is left of the large blue rubber "
        "sphere.",
    ),
    (
        "which blocks are left of the ball?",
        "why the red one and not the green one?",
        "The small green rubber cube is not left of the large blue rubber sphere.",
    ),
    (
        "is the red block clear?",
        "why not the green block?",
        "It does not follow that the small green rubber cube is clear: the small green rubber cube "
        "carries something, since the small yellow metal cylinder is on the small green rubber "
        "cube.",
    ),
    (
        "how many things are clear?",
        "why not the green one?",
        "It does not follow that the small green rubber cube is clear: the small green rubber cube "
        "carries something, since the small yellow metal cylinder is on the small green rubber "
        "cube.",
    ),
    (
        "which is the largest thing?",
        "why not the green block?",
        "The small green rubber cube is not the largest thing: it is small.",
    ),
    (
        "which thing is the leftmost?",
        "why not the ball?",
        "The large blue rubber sphere is not the leftmost thing: one thing is left of it.",
    ),
    (
        "what would happen if the green block were removed?",
        "why not the yellow cylinder?",
        "But it is so: the small yellow metal cylinder would fall.",
    ),
    (
        "what would happen if the green block were removed?",
        "why not the green block?",
        "The small green rubber cube is what would be taken away.",
    ),
    (
        "are most things small?",
        "why not the ball?",
        "The large blue rubber sphere is large, not small.",
    ),
    ("which blocks are left of the ball?", "why not the pink block?", None),
    ("what is the ball made of?", "why not the green block?", None),
]


@pytest.mark.parametrize(("question", "contrast", "text"), CONTRASTS)
def test_an_answer_is_contrasted_with_a_thing(
    question: str, contrast: str, text: str | None, run: Run, tmp_path: Path
) -> None:
    file = tmp_path / "table.json"
    file.write_text(json.dumps(TABLE), encoding="utf-8")
    asked = ("--ask", question, "--ask", contrast)
    found = run("decide", "tabletop", "--scene", file, *asked, "--json")
    told = [answer["text"] for answer in json.loads(found.out)["answers"]]
    assert (found.code, told[1:]) == ((2, []) if text is None else (0, [text]))
