"""The page of an evaluation, and what `seewhy evaluate` prints and writes."""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from conftest import Run
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.evaluation import Evaluation, Misreading, WrongPicture, evaluate
from seewhy.report.evaluation_page import evaluation_page
from test_advice import evaluation, point, recognised
from test_report import Page


@pytest.fixture(scope="module")
def mislabelled(tiles_data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The tiles, with a red test tile called bad, and a blue one called green."""
    folder = tmp_path_factory.mktemp("data") / "mislabelled"
    shutil.copytree(tiles_data, folder)
    table = folder / "scenes.csv"
    lines = table.read_text().splitlines()
    red = next(n for n, line in enumerate(lines) if ",good,red,yes,test" in line)
    blue = next(n for n, line in enumerate(lines) if ",bad,blue,no,test" in line)
    lines[red] = lines[red].replace(",good,", ",bad,")
    lines[blue] = lines[blue].replace(",blue,", ",green,")
    table.write_text("\n".join(lines) + "\n")
    return folder


@pytest.fixture(scope="module")
def result(agent: Agent, mislabelled: Path, tiles: Domain) -> Evaluation:
    return evaluate(agent, Dataset.load(mislabelled, tiles), questions_per_scene=2)


@pytest.fixture(scope="module")
def page(result: Evaluation, tiles: Domain) -> str:
    return evaluation_page(tiles, result, command="seewhy evaluate <x>")


def cells(page: str, row: str) -> list[str]:
    """The words of the first table row that has this cell."""
    found = re.search(rf"<tr><td>{row}</td>.*?</tr>", page, flags=re.DOTALL)
    assert found is not None
    return [
        re.sub(r"<.*?>", "", cell)
        for cell in re.findall(r"<td.*?>(.*?)</td>", found.group(), re.DOTALL)
    ]


def test_the_page_needs_no_network(page: str) -> None:
    assert not re.search(r"https?:|//[a-z]+\.|@import|url\(", page)
    for tag, attributes in Page(page).started:
        assert tag not in ("script", "link", "iframe", "object")
        assert attributes.get("src", "data:").startswith("data:")
        assert "href" not in attributes


def test_the_page_has_the_figures(page: str) -> None:
    class_row = cells(page, "class")
    assert class_row[:2] == ["class", "95.0 %"]
    assert class_row[2] == "76.4 % to 99.1 %"
    assert class_row[5] == "20"
    assert cells(page, "shape")[1] == "100.0 %"
    assert "<li>20 pictures are few to evaluate on: 95.0 % of the classes were right" in page
    assert "seewhy evaluate &lt;x&gt;" in page
    assert 'class="notice"' not in page


def test_the_page_shows_every_wrong_picture(page: str, result: Evaluation) -> None:
    assert len(result.wrong) == 2
    started = Page(page).started
    assert sum(tag == "img" for tag, _ in started) == 2
    shown = page[page.index('class="wrong-pictures"') :]
    first, second = re.findall(r'<div class="wrong">.*?</div>\n</div>', shown, flags=re.DOTALL)
    assert result.wrong[0].image in first
    assert "annotated: bad" in first
    assert "nothing was misread: the knowledge concludes another class" in first
    assert result.wrong[1].image in second
    assert re.search(
        r'colour: <span class="bad">blue</span> \([01]\.\d\d\), annotated green', second
    )


def test_a_page_shows_so_many_pictures(tiles: Domain, result: Evaluation) -> None:
    page = evaluation_page(tiles, result, command="seewhy", most=1)
    assert sum(tag == "img" for tag, _ in Page(page).started) == 1
    assert "Shown: 1 of 2; --most 2 shows all, --json lists all." in page


def test_the_page_says_what_was_taken_for_what(page: str) -> None:
    tables = re.findall(r'<table class="matrix">.*?</table>', page, flags=re.DOTALL)
    classes = re.sub(r"<.*?>", " ", tables[0]).split()
    assert classes[:5] == ["annotated", "\\", "said", "good", "bad"]
    good, bad = classes.index("good", 5), classes.index("bad", 5)
    assert classes[good + 2] == "0"  # no good tile is called bad
    assert classes[bad + 1] == "1"  # the one that was annotated as bad


def test_of_many_values_confusions_are_listed(tiles: Domain) -> None:
    order = tuple(f"v{number}" for number in range(60))
    counts = {(v, v): 9 for v in order} | {(v, "v0"): 1 for v in order[1:]}
    many = evaluation(
        feature_recognition={"colour": recognised(counts, order=order)},
        training_pictures={
            "class": {"good": 500, "bad": 500},
            "colour": dict.fromkeys(order, 100),
        },
    )
    page = evaluation_page(tiles, many, command="seewhy")
    assert "19 more confusions, each at most as frequent; --json has all." in page
    assert page.count('class="matrix"') == 1  # that of the two classes


def test_the_page_draws_a_curve(tiles: Domain) -> None:
    from seewhy.evaluation.curve import LearningCurve

    curve = LearningCurve((point(100, 60), point(200, 80)), 100)
    page = evaluation_page(tiles, evaluation(curve=curve), command="seewhy")
    assert "<h2>Learning curve</h2>" in page
    assert "<title>class, 200: 80.0 % (71.1 to 86.7 %)</title>" in page
    assert "more labels help" in page


def test_evaluate_writes_a_page(
    run: Run, model_folder: Path, mislabelled: Path, tmp_path: Path
) -> None:
    target = tmp_path / "new" / "page.html"
    shown = run("evaluate", model_folder, "--data", mislabelled, "--page", target, "--most", 1)
    assert (shown.code, shown.err) == (0, "")
    assert shown.out.splitlines()[-1] == f"page: {target}"
    text = target.read_text(encoding="utf-8")
    assert "--most 2 shows all" in text
    assert f"<code>seewhy evaluate {model_folder} --data" in text
    lines = shown.out.splitlines()
    assert " ".join(lines[1].split()) == (
        "recognised right 95 % interval majority balanced pictures"
    )
    assert " ".join(lines[2].split()) == ("classification 95.0 % 76.4 to 99.1 % 60.0 % 93.8 % 20")
    assert lines[5].split() == [
        "how",
        "sure",
        "said",
        "on",
        "average",
        "right",
        "calibration",
        "error",
    ]
    assert lines[6].split()[-5:-2] == ["%", "95.0", "%"]
    assert "what the figures say:" in lines
    assert any(line.split()[:4] == ["class", "bad", "good", "1"] for line in lines)


def test_evaluate_says_the_same_to_programs(
    run: Run, model_folder: Path, mislabelled: Path
) -> None:
    record = json.loads(run("evaluate", model_folder, "--data", mislabelled, "--json").out)
    assert record["class_recognition"]["confusion"] == {
        "values": ["good", "bad"],
        "counts": [[12, 0], [1, 7]],
        "undecided": [0, 0],
    }
    assert record["class_recognition"]["majority"] == "good"
    assert len(record["wrong"]) == 2
    assert record["curve"] is None
    assert record["redecided"]["wrong"] == 1
    assert record["advice"][0].startswith("20 pictures are few to evaluate on")


def test_most_goes_with_a_page(run: Run, model_folder: Path, tiles_data: Path) -> None:
    result = run("evaluate", model_folder, "--data", tiles_data, "--most", 3)
    assert (result.code, result.out) == (2, "")
    assert result.err == "seewhy: --most goes with --page; --json lists all wrong pictures\n"


def test_pictures_trained_on_are_said_first_on_the_page(
    run: Run, model_folder: Path, tiles_data: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "data"
    shutil.copytree(tiles_data, folder)
    table = folder / "scenes.csv"
    table.write_text(re.sub(r",(train|test|split)\n", "\n", table.read_text()))
    page = tmp_path / "page.html"
    lines = table.read_text().splitlines()
    table.write_text("\n".join([*lines, lines[1]]) + "\n")  # there is something to remark on
    result = run("evaluate", model_folder, "--data", folder, "--page", page)
    assert result.code == 0
    said = (
        "41 of 61 pictures were trained on; results on them prove nothing: the table keeps none "
        "for evaluation; add a column split, with test in a quarter of the rows, and train again"
    )
    assert result.err.splitlines()[0] == said
    assert "1 picture is in several rows" in result.err.splitlines()[1]
    assert result.out.splitlines()[0] == (
        "61 scenes, 41 of them trained on: results on them prove nothing"
    )
    body = page.read_text().split("<body>")[1]
    assert re.sub(r"<.*?>", "", body).split("\n")[2] == f"{said}."


def test_what_the_network_alone_saw_is_shown(
    tiles: Domain, result: Evaluation, mislabelled: Path
) -> None:
    wrong = WrongPicture(
        image="a <b>.png",
        picture=mislabelled / "images" / "000.png",
        label="good",
        said=None,
        method="none",
        verdict="silent",
        probability=None,
        misread=(Misreading("colour", "blue", 0.25, "red", overruled=("green", 0.7)),),
        not_annotated=(),
    )
    page = evaluation_page(tiles, replace(result, wrong=(wrong,)), command="seewhy")
    assert (
        'colour: <span class="bad">blue</span> (0.25; the network alone saw green, 0.70), '
        "annotated red"
    ) in page
    assert "a &lt;b&gt;.png" in page
    assert '<span class="bad">undecided: silent</span>' in page
