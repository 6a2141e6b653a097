"""The tables that discuss the evaluation say what the committed rows say."""

from __future__ import annotations

import csv
import re
from collections import defaultdict
from pathlib import Path
from statistics import fmean

import pytest

ROOT = Path(__file__).parents[1]
CLASSIFY = ("seewhy", "end_to_end", "frozen")
ASKED = ("seewhy", "believing", "end_to_end")
READ = ("argmax", "consistent", "with_class", "end_to_end")
KNOWN = ("incomplete", "learned", "explained", "full")
QUESTIONS = ("answers", "answers_strict", "explanations_strict", "explanations_sufficient")

TABLES: list[tuple[str, str, str, list[tuple[str, str]]]] = [
    *(("docs/results.md", f"#### {heading}{domain}{read}\n", experiment,
       [(key, system) for key in keys for system in systems])
      for domain, read, experiment in (
          ("structures", "", "structures/vqa"),
          ("signs", "", "signs/vqa-with_class"),
          ("signs", ", read as the domain says", "signs/vqa"))
      for heading, keys, systems in (
          ("Classes of ", ("accuracy",), CLASSIFY),
          ("Answers about ", QUESTIONS[:2], ASKED),
          ("Explanatory answers about ", QUESTIONS[2:], ASKED))),
    *(("docs/results.md", f"#### {heading}\n", f"{domain}/axioms",
       [(key, system) for key in keys for system in KNOWN])
      for domain in ("structures", "signs")
      for heading, keys in (
          (f"Classes of {domain}, axioms learned again", ("accuracy",)),
          (f"Answers about {domain}, axioms learned again", QUESTIONS[:2]),
          (f"Explanatory answers about {domain}, axioms learned again", QUESTIONS[2:]),
          (f"What the knowledge of {domain} decides", ("by_knowledge", "agreement")))),
    ("docs/results.md", "**How the classes came", "structures/reading",
     [("accuracy", system) for system in READ]),
    ("docs/results.md", "The ways of reading side by side", "signs/reading",
     [("accuracy", system) for system in READ]),
    ("docs/results.md", "## What each coupling", "structures/ablation",
     [("accuracy", "seewhy"), ("accuracy", "no_tree"), ("accuracy", "tree_on_all"),
      ("answers", "seewhy"), ("answers", "no_lstm"), ("answers", "lstm_on_all")]),
    ("docs/results.md", "**A gate of confidence", "structures/confidence",
     [(key, system) for key in ("accuracy", "answers")
      for system in ("no_gate", "gate_50", "gate_70", "gate_90")]),
    ("README.md", "## The paper's claims", "structures/vqa",
     [("accuracy", "seewhy"), ("accuracy", "end_to_end"), ("accuracy", "frozen"),
      ("answers", "believing"), ("answers", "end_to_end")]),
]  # fmt: skip
"""A document, the text that the table follows, the rows, and what its numbers are in turn."""


def documented(document: str, after: str) -> dict[str, list[float]]:
    """Size → the numbers of its line, of the first table after a text."""
    text = (ROOT / document).read_text(encoding="utf-8")
    _, found, rest = text.partition(after)
    assert found, f"{document}: {after}"
    table = re.search(r"(?:^\|.*\n)+", rest, flags=re.MULTILINE)
    assert table is not None
    lines = {}
    for line in table.group().splitlines()[2:]:
        size, *cells = [cell.strip() for cell in line.strip("|").split("|")]
        lines[size.replace(",", "")] = [
            float(number) for cell in cells for number in re.findall(r"[\d.]+", cell)
        ]
    return lines


def measured(experiment: str) -> dict[tuple[str, str], dict[str, list[float]]]:
    """Size and system → measure → its values, one a trial."""
    found: dict[tuple[str, str], dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    path = ROOT / "results" / experiment / "rows.csv"
    with path.open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream):
            for key, value in row.items():
                if value and key not in ("seed", "size", "system"):
                    size = "all" if row["size"] == "0" else row["size"]
                    found[size, row["system"]][key].append(float(value))
    return found


@pytest.mark.parametrize(("document", "after", "experiment", "columns"), TABLES)
def test_tables_say_what_the_rows_say(
    document: str, after: str, experiment: str, columns: list[tuple[str, str]]
) -> None:
    values = measured(experiment)
    lines = documented(document, after)
    assert lines
    for size, numbers in lines.items():
        found = [100 * fmean(values[size, system][key]) for key, system in columns]
        assert numbers == pytest.approx(found, abs=0.0501), (document, after, size)
