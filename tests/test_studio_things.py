"""Things on the page Label: boxes, what is said of them, and the tables that are written."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from seewhy.data.thing import BoundingBox
from seewhy.errors import DatasetError, SeeWhyError
from seewhy.studio.drawing import draw, relate, remove
from seewhy.studio.project import Project
from seewhy.studio.site import site
from seewhy.studio.thing_bench import thing_bench
from studio_builder import FRUIT, HTMX, RULES, Browser, embed, pictures, with_domain
from thing_pictures import DOMAIN, piles

RED = {"left": 20, "top": 50, "right": 60, "bottom": 90}
GREEN = {"left": 100, "top": 40, "right": 150, "bottom": 90}


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(piles(tmp_path / "p"))


@pytest.fixture
def browser(project: Project) -> Iterator[Browser]:
    with TestClient(site(project, rules=RULES, embed=embed)) as client:
        yield Browser(client)


def rows(project: Project, table: str = "things.csv") -> list[str]:
    return (project.folder / table).read_text().splitlines()[1:]


def draw_two(browser: Browser, picture: str = "a.png") -> None:
    browser.post("/label/thing/draw", picture=picture, **RED)
    browser.post("/label/thing/draw", picture=picture, **GREEN)


def test_a_box_is_drawn_said_moved_and_removed(browser: Browser, project: Project) -> None:
    text = browser.post("/label/thing/draw", picture="a.png", **RED)
    assert 'data-chosen="1"' in text
    assert 'data-box="20 50 60 90"' in text
    assert rows(project) == ["a.png,1,20,50,60,90,,"]
    assert rows(project, "scenes.csv") == ["a.png,,,,,"]
    text = browser.post("/label/thing/set", picture="a.png", thing="1", choice="colour=red")
    assert "block 1, red: left 20, top 50, right 60, bottom 90" in text
    assert rows(project) == ["a.png,1,20,50,60,90,red,"]
    browser.post("/label/thing/draw", picture="a.png", thing="1", **{**RED, "left": 10.4})
    assert rows(project) == ["a.png,1,10,50,60,90,red,"]
    browser.post("/label/thing/set", picture="a.png", thing="1", choice="colour=")
    assert rows(project) == ["a.png,1,10,50,60,90,,"]
    browser.post("/label/thing/remove", picture="a.png", thing="1")
    assert rows(project) == []
    assert rows(project, "scenes.csv") == []


def test_each_step_is_an_entry_with_who_and_when(browser: Browser, project: Project) -> None:
    draw_two(browser)
    browser.post("/label/thing/set", picture="a.png", thing="1", choice="round=yes")
    browser.post("/label/thing/relate", picture="a.png", thing="1", choice="on=yes=2")
    stored = sqlite3.connect(project.folder / "studio.sqlite").execute(
        "SELECT at, who, body FROM entries WHERE kind = 'boxes'"
    )
    entries = [(at, who, json.loads(body)["how"]) for at, who, body in stored]
    assert [how for _, _, how in entries] == ["drawn", "drawn", "typed", "typed"]
    assert all(at.endswith("+00:00") and who for at, who, _ in entries)
    assert "typed: 1 on 2" in browser.get("/label/history")


def test_a_relation_is_said_and_leaves_open_what_nobody_said(
    browser: Browser, project: Project
) -> None:
    draw_two(browser)
    draw_two(browser, "b.png")
    text = browser.post("/label/thing/relate", picture="a.png", thing="2", choice="under=yes=1")
    assert 'value="under=no=1"' in text  # the next press says that it is not so
    assert rows(project, "relations.csv") == [
        "a.png,on,1,2,yes",
        "a.png,on,2,1,unknown",
        "b.png,on,1,2,unknown",
        "b.png,on,2,1,unknown",
    ]
    browser.post("/label/thing/relate", picture="a.png", thing="2", choice="on=no=")
    assert "a.png,on,2,1,unknown" not in rows(project, "relations.csv")
    first, second = project.dataset().vectors
    shown = [dict(zip(project.domain().schema.features, v, strict=True)) for v in (first, second)]
    assert [one["on(block1,block2)"] for one in shown] == ["yes", None]
    assert [one["on(block2,block1)"] for one in shown] == ["no", None]
    assert [one["under(block2,block1)"] for one in shown] == ["yes", None]
    assert [one["left(block1,block2)"] for one in shown] == ["yes", "yes"]
    browser.post("/label/thing/relate", picture="a.png", thing="1", choice="on=open=2")
    browser.post("/label/thing/relate", picture="a.png", thing="2", choice="on=open=1")
    assert rows(project, "relations.csv") == []


def test_what_only_does_not_hold_is_said_too(browser: Browser, project: Project) -> None:
    draw_two(browser)
    browser.post("/label/thing/relate", picture="a.png", thing="1", choice="on=no=2")
    browser.post("/label/thing/relate", picture="a.png", thing="2", choice="on=no=1")
    (vector,) = project.dataset().vectors
    shown = dict(zip(project.domain().schema.features, vector, strict=True))
    assert (shown["on(block1,block2)"], shown["on(block2,block1)"]) == ("no", "no")


def test_the_key_of_another_thing_is_its_number_or_its_place(project: Project) -> None:
    for _ in range(3):
        draw(project, "a.png", None, who="Ada")
    things = project.domain().things
    assert things is not None
    size = (200, 100)
    bench = thing_bench(project.labels().drawn_in("a.png"), things, size=size, chosen="1")
    assert [to.key for to in bench.relations[0].to] == ["2", "3"]
    (project.folder / "things.csv").write_text("image,thing\na.png,cup\na.png,box\na.png,7\n")
    project.refresh()
    bench = thing_bench(project.labels().drawn_in("a.png"), things, size=size, chosen="cup")
    assert [to.key for to in bench.relations[0].to] == ["1", "2"]
    assert bench.relations[0].before == "cup is on"


def test_undo_has_no_end(browser: Browser, project: Project) -> None:
    states = []
    for path, said in [
        ("/label/thing/draw", RED),
        ("/label/thing/draw", GREEN),
        ("/label/thing/set", {"thing": "1", "choice": "colour=red"}),
        ("/label/thing/relate", {"thing": "1", "choice": "on=yes=2"}),
        ("/label/thing/draw", {"thing": "2", **RED, "left": 30}),
        ("/label/thing/remove", {"thing": "1"}),
    ]:
        states.append(tables(project))
        browser.post(path, picture="a.png", **said)
    last = tables(project)
    for state in reversed(states[1:]):
        browser.post("/label/undo")
        assert tables(project) == state
    browser.post("/label/undo")
    assert tables(project)[0] == []
    for state in [*states[1:], last]:
        browser.post("/label/redo")
        assert tables(project) == state


def tables(project: Project) -> tuple[list[str], list[str]]:
    names = ("things.csv", "relations.csv")
    return tuple(  # type: ignore[return-value]
        rows(project, name) if (project.folder / name).is_file() else [] for name in names
    )


def test_what_was_drawn_since_keeps_a_removal_from_being_taken_back(project: Project) -> None:
    for _ in range(4):
        draw(project, "a.png", None, who="Ada")
    remove(project, "a.png", "4", who="Ada")
    removal = project.record.all()[-1].number
    draw(project, "a.png", (0, 0, 9, 9), who="Ada")
    with pytest.raises(SeeWhyError, match=f"entry {removal} cannot be taken back: .*called '4'"):
        project.take_back(removal, who="Ada")
    assert rows(project)[-1] == "a.png,4,0,0,9,9,,"
    remove(project, "a.png", "3", who="Ada")
    project.take_back(project.record.all()[-2].number, who="Ada")  # the box that came since
    project.take_back(removal, who="Ada")
    assert len(rows(project)) == 3


@pytest.mark.parametrize(
    ("path", "fields", "said"),
    [
        ("draw", {**RED, "right": 201}, "reaches out of 'a.png', which is 200 × 100 pixels"),
        ("draw", {**RED, "left": -3}, "reaches out"),
        ("draw", {**RED, "right": 20}, "is empty: right must be more than left"),
        ("draw", {**RED, "left": "nan"}, "are numbers"),
        ("draw", {**RED, "left": "wide"}, "left: input should be a valid number"),
        ("draw", {"left": 1, "top": 1}, "four numbers"),
        ("draw", {"thing": "1"}, "four numbers"),
        ("draw", {"thing": "7", **GREEN}, "'7' is no thing of 'a.png'"),
        ("draw", RED, "would have the box of '1'"),
        ("draw", {**GREEN, "picture": "z.png"}, "no picture of the project"),
        ("draw", {**GREEN, "picture": "../a.png"}, "no picture of the project"),
        ("remove", {"thing": "two"}, "no thing of 'a.png'"),
        ("set", {"thing": "1", "choice": "colour=rad"}, "no value of 'colour'; did you mean 'red'"),
        ("set", {"thing": "1", "choice": "color=red"}, "no feature of things; did you mean"),
        ("set", {"thing": "9", "choice": "colour=red"}, "no thing of 'a.png'"),
        ("relate", {"thing": "1", "choice": "on=yes=9"}, "no thing of 'a.png'"),
        ("relate", {"thing": "1", "choice": "on=yes=1"}, "'1' is one"),
        ("relate", {"thing": "1", "choice": "on=perhaps=2"}, "got 'perhaps'"),
        ("relate", {"thing": "1", "choice": "onto=yes=2"}, "no relation of things; did you mean"),
        ("relate", {"thing": "1", "choice": "left=yes=2"}, "comes from 'left'"),
        ("relate", {"thing": "1", "choice": "above=yes=2"}, "comes from 'axioms'"),
    ],
)
def test_what_cannot_be_drawn_or_said(
    browser: Browser, project: Project, path: str, fields: dict[str, object], said: str
) -> None:
    browser.post("/label/thing/draw", picture="a.png", **RED)
    browser.post("/label/thing/draw", picture="a.png", **{**GREEN, "left": 99})
    before = len(project.record.all()), tables(project)
    answered = browser.client.post(
        f"/label/thing/{path}",
        data={"csrf": browser.csrf, "picture": "a.png", **fields},
        headers=HTMX,
    )
    assert answered.status_code == 422
    assert said in answered.text.replace("&#39;", "'")
    assert answered.headers["HX-Retarget"] == "#problem"
    assert (len(project.record.all()), tables(project)) == before


def test_more_than_the_domain_allows(browser: Browser, project: Project) -> None:
    for _ in range(4):
        text = browser.post("/label/thing/draw", picture="a.png")
    assert "The domain allows 4 blocks in a picture" in text
    refused = browser.client.post(
        "/label/thing/draw", data={"csrf": browser.csrf, "picture": "a.png"}, headers=HTMX
    )
    assert refused.status_code == 422
    assert "would have 5 blocks, and the domain allows 4" in refused.text
    assert len(rows(project)) == 4


def test_no_form_of_elsewhere_draws(browser: Browser, project: Project) -> None:
    for path in ("draw", "remove", "set", "relate"):
        said = {"picture": "a.png", "thing": "1", "choice": "colour=red"}
        assert browser.client.post(f"/label/thing/{path}", data=said).status_code == 403
        foreign = browser.client.post(
            f"/label/thing/{path}",
            data={"csrf": browser.csrf, **said},
            headers={"Origin": "http://elsewhere.example"},
        )
        assert foreign.status_code == 403
    assert not (project.folder / "things.csv").exists()


def test_a_domain_without_things_has_no_boxes(tmp_path: Path) -> None:
    project = Project(with_domain(pictures(tmp_path / "fruit"), FRUIT))
    with TestClient(site(project, rules=RULES, embed=embed)) as client:
        browser = Browser(client)
        assert "boxes.js" not in browser.get("/label")
        answered = client.post(
            "/label/thing/draw", data={"csrf": browser.csrf, "picture": "a.png", **RED}
        )
    assert answered.status_code == 422
    assert "the domain has no things" in answered.text


def test_without_scripts_the_same_comes_by_a_page(browser: Browser, project: Project) -> None:
    text = browser.post("/label/thing/draw", part=False, picture="a.png")
    assert 'data-chosen="1"' in text
    assert rows(project) == ["a.png,1,67,33,133,66,,"]
    text = browser.post("/label/thing/draw", part=False, picture="a.png", thing="1", **RED)
    assert "left 20, top 50, right 60, bottom 90" in text


def test_tables_that_are_there_are_taken_up(tmp_path: Path) -> None:
    folder = piles(tmp_path / "p")
    (folder / "things.csv").write_text(
        "image,thing,left,top,right,bottom,colour\n"
        "a.png,cup,1,2,30,40,red\na.png,book,50,60,90,100,\nb.png,,,,,,green\n"
    )
    (folder / "relations.csv").write_text(
        "image,relation,thing,other\na.png,under,book,cup\na.png,left,cup,book\n"
    )
    project = Project(folder)
    here = project.labels().drawn_in("a.png")
    assert here.things["cup"].box == BoundingBox(1, 2, 30, 40)
    assert here.things["cup"].values["colour"].how == "table"
    assert here.related == {
        ("on", "cup", "book"): True,
        ("on", "book", "cup"): False,
        ("left", "cup", "book"): True,
        ("left", "book", "cup"): False,
    }
    # What is drawn beside it is measured, and what nobody said of it is open.
    name = draw(project, "a.png", (100, 0, 120, 20), who="Ada")
    assert "b.png,1,,,,,green," in rows(project)
    related = rows(project, "relations.csv")
    assert f"a.png,left,cup,{name},yes" in related
    assert f"a.png,on,cup,{name},unknown" in related
    assert len(project.record.all()) == 3  # the domain, the tables, the box
    assert Project(folder).labels().drawn == project.labels().drawn


def test_a_table_changed_by_another_program_is_taken_in(project: Project) -> None:
    draw(project, "a.png", (20, 50, 60, 90), who="Ada")
    draw(project, "a.png", (100, 40, 150, 90), who="Ada")
    relate(project, "a.png", "on", "1", "2", True, who="Ada")
    table = project.folder / "things.csv"
    table.write_text(
        table.read_text().replace("a.png,1,20,50,60,90,,", "a.png,1,21,50,60,90,red,")
        + "a.png,3,0,0,5,5,,yes\n"
    )
    project.refresh()
    things = project.labels().drawn_in("a.png").things
    assert things["1"].box == BoundingBox(21, 50, 60, 90)
    assert things["1"].values["colour"].who == "another program"
    assert things["3"].values["round"].value == "yes"
    assert project.labels().drawn_in("a.png").related[("on", "1", "2")] is True
    table.write_text("image,thing\na.png,2\n")
    (project.folder / "relations.csv").unlink()
    project.refresh()
    here = project.labels().drawn_in("a.png")
    assert list(here.things) == ["2"]
    assert here.things["2"].box is None
    assert here.related == {}


def test_a_broken_table_is_said_and_not_written_over(tmp_path: Path) -> None:
    folder = piles(tmp_path / "p")
    broken = "image,thing,left,top,right,bottom\na.png,1,0,0,999,9\n"
    (folder / "things.csv").write_text(broken)
    with pytest.raises(DatasetError, match=r"things\.csv:2: .*reaches out of its picture"):
        Project(folder)
    assert (folder / "things.csv").read_text() == broken


def test_what_the_domain_forgets_is_not_written(project: Project) -> None:
    draw(project, "a.png", (20, 50, 60, 90), who="Ada")
    file = project.folder / "piles" / "domain.toml"
    file.write_text(DOMAIN.replace("[things.features.round]\n", ""))
    project.refresh()
    assert rows(project) == ["a.png,1,20,50,60,90,"]
    assert project.dataset().scenes[0].things


def test_pictures_without_classes_are_labelled_by_their_things(tmp_path: Path) -> None:
    folder = piles(tmp_path / "p")
    text = DOMAIN[: DOMAIN.index("[classes.")]
    text = text[: text.index("[features.")] + text[text.index("[things]") :]
    (folder / "piles" / "domain.toml").write_text(text)
    knowledge = folder / "piles" / "knowledge.al"
    lines = knowledge.read_text().splitlines(keepends=True)
    knowledge.write_text(
        "".join(line for line in lines if "(P)" not in line and "light" not in line)
    )
    project = Project(folder)
    with TestClient(site(project, rules=RULES, embed=embed)) as client:
        browser = Browser(client)
        assert "0 of 3 pictures are labelled, 0 blocks drawn" in browser.get("/label?picture=a.png")
        browser.post("/label/thing/draw", picture="a.png", **RED)
        browser.post("/label/thing/set", picture="a.png", thing="1", choice="colour=red")
        text = browser.post("/label/thing/set", picture="a.png", thing="1", choice="round=no")
        assert "1 of 3 pictures are labelled, 1 block drawn" in text
        assert "there are no proposals" not in browser.get("/label?picture=a.png")
        progress = browser.get("/label/progress")
        assert "Of things" in progress
        assert "<td>1</td>" in progress
        sheet = client.get("/label/sheet")
        assert (sheet.status_code, "one picture at a time" in sheet.text) == (422, True)
        assert 'data-picture="a.png"' not in browser.get("/label?go=on", part=True)


# Pictures that show none ----------------------------------------------------------------------


def test_that_nothing_is_there_is_a_label(browser: Browser, project: Project) -> None:
    assert 'data-key="n">No blocks here' in browser.get("/label?picture=b.png")
    text = browser.post("/label/thing/none", picture="b.png", choice="yes")
    assert "no blocks here" in text
    assert "it teaches where none are" in text
    table = project.folder / "scenes.csv"
    assert table.read_text() == "image,split,class,light,things,group,reasons\nb.png,,,,none,,\n"
    labels = project.labels()
    assert labels.is_boxed("b.png")
    assert [scene.no_things for scene in project.dataset().scenes] == [True]
    browser.post("/label/thing/draw", picture="b.png", **RED)
    assert not project.labels().drawn_in("b.png").none
    assert rows(project, "scenes.csv") == ["b.png,,,,,"]
    refused = browser.client.post(
        "/label/thing/none", data={"csrf": browser.csrf, "picture": "b.png", "choice": "yes"}
    )
    assert refused.status_code == 422
    assert "has 1 block; remove it before saying that there are none" in refused.text
    browser.post("/label/undo")
    assert project.labels().drawn_in("b.png").none
    assert "none there" in browser.get("/label/history")
    browser.post("/label/thing/none", picture="b.png", choice="open")
    assert rows(project, "scenes.csv") == []
    refused = browser.client.post(
        "/label/thing/none", data={"csrf": browser.csrf, "picture": "b.png", "choice": "no"}
    )
    assert refused.status_code == 422


def test_what_a_table_says_of_none_is_taken_in(project: Project) -> None:
    draw(project, "a.png", (20, 50, 60, 90), who="Ada")
    project.label({"a.png": {"light": "yes"}}, who="Ada")
    (project.folder / "things.csv").write_text("image,thing\n")
    table = project.folder / "scenes.csv"
    table.write_text("image,light,things\na.png,yes,none\n")
    project.refresh()
    assert project.labels().drawn_in("a.png").none
    assert rows(project, "scenes.csv") == ["a.png,,,yes,none,,"]
    table.write_text("image,light\na.png,yes\n")
    project.refresh()
    assert not project.labels().drawn_in("a.png").none


def test_pictures_with_things_have_proposals_for_the_whole(
    browser: Browser, project: Project
) -> None:
    for name, light, label in (("a.png", "yes", "stable"), ("b.png", "no", "unstable")):
        browser.post("/label/set", picture=name, choice=f"light={light}")
        browser.post("/label/set", picture=name, choice=f"class={label}")
    text = browser.get("/label?picture=c.png")
    assert "there are no proposals" not in text
    assert "Confirm 2 proposed" in text
    assert project.labels().values("a.png") == {"light": "yes", "class": "stable"}
