"""`seewhy decide` over things: what follows of a scene that somebody writes down."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from conftest import Run
from seewhy.data.named_things import named_scene, supposed
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DatasetError, DomainError

DOMAIN = """\
[domain]
name = "blocks"
title = "Blocks on blocks"
scene = "picture"
subject = "the pile"

[things]
sort = "block"
most = 4
one = "block"

[things.features.colour]
[things.features.round]

[things.relations.on]
measure = "seen"
say = "{0} is on {1}"
words = ["on"]

[things.relations.above]
measure = "axioms"
say = "{0} is above {1}"
words = ["above"]

[classes.stable]
literal = "stable(picture)"
say = "stable"
words = ["stable"]

[classes.unstable]
literal = "-stable(picture)"
say = "unstable"
words = ["unstable"]
"""
KNOWLEDGE = """\
#sort picture.
#sort block = things.
#sort hue = {red, green}.
#static colour(block, hue).
#static round(block).
#static on(block, block).
#static above(block, block).
#static falls(block).
#static stable(picture).
above(X, Y) if on(X, Y).
above(X, Z) if on(X, Y), above(Y, Z).
%% what lies on something round falls
falls(X) if on(X, Y), round(Y).
-stable(P) if picture(P), falls(X).
stable(P) if picture(P), not -stable(P), block(X).
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    home = tmp_path / "blocks"
    home.mkdir()
    (home / "domain.toml").write_text(DOMAIN)
    (home / "knowledge.al").write_text(KNOWLEDGE)
    (home / "questions.toml").write_text("")
    return home


@pytest.fixture
def domain(folder: Path) -> Domain:
    return load_domain(folder)


def test_a_value_may_be_named_by_any_word() -> None:
    domain = load_domain("set_cards")
    _, found = named_scene(domain, ["a.number=2", "a.colour=RED"])
    assert found[0].values == {"number": "two", "colour": "red"}


def test_what_follows_why_and_what_would_change_it(run: Run, folder: Path) -> None:
    found = run(
        *("decide", str(folder), "a.colour=red", "b.round=yes", "on=a,b", "--why", "falls(b)"),
        *("--change", "stable(picture)", "--if", "b.round=no"),
        *("--ask", "is there a block above the red block?"),
    )
    assert found.code == 0
    assert "class: unstable" in found.out
    assert 'a falls: "what lies on something round falls"' in found.out
    assert "  a is above b" in found.out
    assert "falls(b): not believed" in found.out
    assert "the pile is stable if b were not there" in found.out
    assert "the pile is stable if b is not round" in found.out
    supposed_part = found.out.split("supposing b.round=no:")[1]
    assert "class: stable" in supposed_part
    assert "is there a block above the red block?" in supposed_part


def test_the_same_for_programs(run: Run, folder: Path) -> None:
    found = run("decide", str(folder), "on=a,b", "b.round=yes", "--change", "falls(b)", "--json")
    told = json.loads(found.out)
    assert (told["class"], told["things"]) == ("unstable", ["a", "b"])
    assert {"literal": "falls(a)", "text": "a falls"} in told["concluded"]
    assert told["change"][0]["changes"] == [
        {"text": "there were another block (it is round and b is on it)", "cost": 1}
    ]
    assert all("1" not in literal["literal"] for literal in told["concluded"])


def test_a_table_of_things(run: Run, folder: Path, tmp_path: Path) -> None:
    table = tmp_path / "things.csv"
    table.write_text("image,thing,round\np.png,top,no\np.png,ball,yes\nq.png,x,no\n")
    (tmp_path / "relations.csv").write_text("image,relation,thing,other\np.png,on,top,ball\n")
    found = run("decide", str(folder), "--things", str(table), "--image", "p.png")
    assert found.code == 0
    assert "top falls" in found.out
    assert run("decide", str(folder), "--things", str(table)).err == (
        f"seewhy: {table}: has the things of 2 pictures; name one of them with --image\n"
    )
    assert run("decide", str(folder), "--things", str(table), "--image", "r.png").err == (
        f"seewhy: {table}: has no things of 'r.png'; did you mean 'p.png'?\n"
    )


def test_supposing_takes_away_and_adds(domain: Domain) -> None:
    vector, _ = named_scene(domain, ["on=a,b", "b.round=yes"])
    other = supposed(domain, vector, ["a", "b"], ["-block=b", "c.colour=green"])
    shown = {k: v for k, v in zip(domain.schema.features, other, strict=True) if v is not None}
    assert shown == {
        "block(block1)": "yes",
        "block(block2)": "no",
        "block(block3)": "yes",
        "block(block4)": "no",
        "colour(block3)": "green",
    }


WRONG = {
    "a.colour": "'a.colour' gives no value; write NAME.FEATURE=VALUE or RELATION=NAME,NAME, as in "
    "cup.colour=red",
    "a.color=red": "'a.color=red': 'color' is no feature of things; did you mean 'colour'?",
    "a.colour=rad": "'a.colour=rad': 'rad' is no value of 'colour'; did you mean 'red'?",
    "on=a": "'on=a' must name two things, as in on=cup,book",
    "oon=a,b": "'oon' is no feature of the picture and no relation; what is seen of a thing is "
    "written as NAME.FEATURE=VALUE; did you mean 'on'?",
    "a.colour=red a.colour=green": "'a.colour=green': 'colour' is given twice, red and green; "
    "leave one out",
    "on=a,b -on=a,b": "'on' of 'a' and 'b' is said in two ways; leave one out",
}


@pytest.mark.parametrize("said", WRONG)
def test_scenes_that_cannot_be_meant(domain: Domain, said: str) -> None:
    with pytest.raises(DomainError) as error:
        named_scene(domain, said.split())
    assert str(error.value) == WRONG[said]


WRONG_THINGS = {
    "on=a,a": "'on' is said of 'a' and itself; name two things",
    "above=a,b": "'above' is concluded by axioms and cannot be said; leave it out",
    "block=a,b,c,d,e": "there are 5 things, and a picture of the domain 'blocks' has at most 4; "
    "leave some out, or raise most under [things] of its domain.toml",
}


@pytest.mark.parametrize("said", WRONG_THINGS)
def test_things_that_cannot_be(domain: Domain, said: str) -> None:
    with pytest.raises(DatasetError) as error:
        named_scene(domain, said.split())
    assert str(error.value) == WRONG_THINGS[said]


@pytest.mark.parametrize(
    ("asked", "problem"),
    [
        ("fals(a)", "'fals' is not declared in knowledge.al; did you mean 'falls'?"),
        ("falls(a, b)", "'falls' takes 1 arguments (block), got 'falls(a, b)'"),
        ("falls(z)", "'z' is no block here; it must be one of: a, b"),
    ],
)
def test_what_cannot_be_asked(run: Run, folder: Path, asked: str, problem: str) -> None:
    found = run("decide", str(folder), "on=a,b", "--why", asked)
    assert (found.code, found.err) == (2, f"seewhy: {problem}\n")


def test_options_of_things_where_there_are_none(run: Run) -> None:
    found = run("decide", "structure_stability", "--why", "stable(structure)")
    assert found.code == 2
    assert found.err.startswith("seewhy: the domain 'structure_stability' has no things, of which")


def test_check_knows_things(run: Run, folder: Path) -> None:
    found = run("check", str(folder))
    assert found.code == 0
    assert "features of things: colour, round" in found.out
    assert "nothing is wrong" in found.out


def test_a_table_of_things_is_asked_about_what_follows(run: Run, tmp_path: Path) -> None:
    (tmp_path / "things.csv").write_text(
        "thing,colour,shape\na,red,cube\nb,green,cube\nc,blue,sphere\nd,gray,cube\n"
    )
    (tmp_path / "relations.csv").write_text("image,relation,thing,other\n,on,b,a\n,on,d,c\n")
    asked = ("what would happen if the red cube were removed?", "which things would fall?", "why?")
    options = [part for question in asked for part in ("--ask", question)]
    table = str(tmp_path / "things.csv")
    found = run("decide", "tabletop", "--things", table, *options, "--json")
    told = [answer["text"] for answer in json.loads(found.out)["answers"]]
    assert told == [
        "The green cube would fall.",
        "There is one thing that would fall: the gray cube.",
        "There is the gray cube: it would fall, since the gray cube is on the blue sphere and the "
        "blue sphere is a sphere.",
    ]


def test_an_annotated_scene_is_asked_about_what_follows(run: Run, tmp_path: Path) -> None:
    scene = {
        "image_index": 0,
        "objects": [{"color": "red", "shape": "cube"}, {"color": "blue", "shape": "sphere"}],
        "relationships": {"on": [[], [0]]},
    }
    file = tmp_path / "scenes.json"
    file.write_text(json.dumps({"scenes": [scene]}))
    found = run("decide", "tabletop", "--scene", str(file), "--ask", "which thing would fall?")
    assert "There is one thing that would fall: the red cube." in found.out
    assert '"nothing stays on a ball"' in found.out
