"""What a domain folder says of things: read whole, refused with place and remedy."""

from __future__ import annotations

from pathlib import Path

import pytest

from conftest import KNOWLEDGE as KNOWLEDGE_OF_TILES
from conftest import write_domain
from seewhy.domain.domain import load_domain
from seewhy.errors import SeeWhyError

DOMAIN = """\
[domain]
name = "plates"
title = "Fruits on a plate"
scene = "plate"
subject = "the plate"

[things]
sort = "fruit"
most = 8
one = "fruit"
many = "fruits"
words = ["piece"]

[things.features.kind_of_fruit]
name = "kind"

[things.features.kind_of_fruit.values]
apple = { nouns = ["apple"] }
cherry = { nouns = ["cherry"] }
pear = { nouns = ["pear"] }

[things.features.ripe.values]
yes = { say = "{it} is ripe", words = ["ripe"] }
no = { say = "{it} is unripe", words = ["unripe", "green"] }

[things.features.weight]
ordered = true
how = ["heavy"]

[things.relations.touching]
measure = "touching"
say = "{0} touches {1}"
words = ["touching", "next to"]
verbs = ["touch"]
converse = "touching"

[things.relations.above]
measure = "above"
say = "{0} is above {1}"
words = ["above", "over"]
most = ["topmost"]
side = ["top"]
"""

KNOWLEDGE = """\
#sort plate.
#sort fruit = things.
#sort fruit_kind = {apple, cherry, pear}.
#sort load = {light, heavy}.
#static kind_of_fruit(fruit, fruit_kind).
#static ripe(fruit).
#static weight(fruit, load).
#static touching(fruit, fruit).
#static above(fruit, fruit).
#static gone(plate).
#fluent basic eaten(fruit).
"""


def write_plates(folder: Path, *, domain: str = DOMAIN, knowledge: str = KNOWLEDGE) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "domain.toml").write_text(domain, encoding="utf-8")
    (folder / "knowledge.al").write_text(knowledge, encoding="utf-8")
    (folder / "questions.toml").write_text("", encoding="utf-8")
    return folder


def test_a_domain_of_things_alone(tmp_path: Path) -> None:
    things = load_domain(write_plates(tmp_path)).things
    assert things is not None
    assert (things.sort, things.most, things.one, things.many) == ("fruit", 8, "fruit", "fruits")
    assert things.words == ("fruit", "piece")
    kind, ripe, weight = things.features.values()
    assert kind.values == ("apple", "cherry", "pear")
    assert kind.say["apple"] == "{it} is an apple"
    assert kind.words["apple"] == ()
    assert ripe.values == ("yes", "no")
    assert ripe.words["no"] == ("unripe", "green")
    assert weight.say["heavy"] == "{it} is heavy"
    assert weight.ordered
    assert things.relations["touching"].converse == "touching"
    assert things.relations["above"].side == ("top",)


def test_a_domain_without_things_has_none() -> None:
    assert load_domain("structure_stability").things is None


WRONG: dict[str, tuple[str, str, str]] = {
    "sort not declared": (
        'sort = "fruit"',
        'sort = "fruits"',
        "domain.toml:8: sort = 'fruits' is no sort of knowledge.al; did you mean 'fruit'?",
    ),
    "sort of other members": (
        'sort = "fruit"',
        'sort = "load"',
        "domain.toml:8: the sort 'load' stands for things and must be declared as '#sort load = "
        "things.', see knowledge.al:4:1",
    ),
    "feature not declared": (
        "[things.features.weight]",
        "[things.features.wait]",
        "domain.toml:26: the feature 'wait' of things is not declared in knowledge.al; did you "
        "mean 'weight'?",
    ),
    "feature of the picture": (
        "[things.features.weight]",
        "[things.features.gone]",
        "domain.toml:26: the feature 'gone' of things must be declared as '#static gone(fruit).' "
        "(yes or no) or '#static gone(fruit, SORT).', got 'gone(plate)' (knowledge.al:10:1)",
    ),
    "feature that changes": (
        "[things.features.weight]",
        "[things.features.eaten]",
        "domain.toml:26: the feature 'eaten' of things must be declared as a static, got '#fluent "
        "basic eaten(fruit)' (knowledge.al:11:1)",
    ),
    "feature with the name of a column": (
        "[things.features.weight]",
        "[things.features.left]",
        "domain.toml:26: 'left' is what another column of things.csv is called; call the feature "
        "otherwise",
    ),
    "value not declared": (
        "cherry = {",
        "chery = {",
        "domain.toml:19: 'chery' is no value of 'kind_of_fruit' in knowledge.al; did you mean "
        "'cherry'?",
    ),
    "noun of two values": (
        '"cherry"',
        '"apple"',
        "domain.toml:19: 'apple' stands for 'cherry' and for 'apple'; let it stand for one",
    ),
    "noun of a value and of all": (
        '"cherry"',
        '"piece"',
        "domain.toml:19: 'piece' stands for 'cherry' and for 'any fruit'; let it stand for one",
    ),
    "adjective of two values": (
        '"unripe"',
        '"ripe"',
        "domain.toml:24: 'ripe' stands for 'no' and for 'yes'; let it stand for one",
    ),
    "relation not declared": (
        "[things.relations.above]",
        "[things.relations.abov]",
        "domain.toml:37: the relation 'abov' of things is not declared in knowledge.al; did you "
        "mean 'above'?",
    ),
    "relation to something else": (
        "[things.relations.above]",
        "[things.relations.weight]",
        "domain.toml:37: the relation 'weight' must be declared as '#static weight(fruit, "
        "fruit).', got 'weight(fruit, load)' (knowledge.al:7:1)",
    ),
    "measure that is none": (
        'measure = "above"',
        'measure = "abuv"',
        "domain.toml:38: 'things.relations.above.measure': input should be 'left', 'right', "
        "'above', 'below', 'inside', 'touching', 'nearer', 'larger', 'in_front', 'behind', 'seen' "
        "or 'axioms', got 'abuv'",
    ),
    "clause about one thing": (
        "{0} is above {1}",
        "{0} is above",
        "domain.toml:39: 'things.relations.above.say': must have the slots {0} and {1} and no "
        "others, got '{0} is above'",
    ),
    "converse that is none": (
        'converse = "touching"',
        'converse = "toching"',
        "domain.toml:35: converse = 'toching' is no relation; did you mean 'touching'?",
    ),
    "converse one way": (
        'converse = "touching"',
        'converse = "above"',
        "domain.toml:35: 'above' is the converse of 'touching', but has no converse; write "
        "converse = 'touching' in [things.relations.above]",
    ),
    "word of two relations": (
        '"over"',
        '"next to"',
        "domain.toml:37: 'next to' stands for 'above' and for 'touching'; let it stand for one",
    ),
    "phrase of two values": (
        'cherry = { nouns = ["cherry"] }\npear = { nouns = ["pear"] }',
        'cherry = { behind = "with a stone" }\npear = { behind = "with a stone" }',
        "domain.toml:20: 'with a stone' stands for 'cherry' of 'kind_of_fruit', too; let it stand "
        "for one",
    ),
    "feature of the picture called like a column": (
        "[things]\n",
        '[features.things]\nname = "things"\n[features.things.values]\n'
        'yes = { say = "yes" }\nno = { say = "no" }\n\n[things]\n',
        "domain.toml:7: 'things' is what another column of scenes.csv is called; call the feature "
        "otherwise",
    ),
    "feature of things called like a column": (
        "[things.features.weight]",
        "[things.features.left]",
        "domain.toml:26: 'left' is what another column of things.csv is called; call the feature "
        "otherwise",
    ),
    "key that is none": (
        "most = 8",
        "mots = 8",
        "domain.toml:9: 'things.mots' is not known here; did you mean 'most'?",
    ),
    "no thing at all": (
        "most = 8",
        "most = 0",
        "domain.toml:9: 'things.most': input should be greater than or equal to 1, got 0",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_with_things(name: str, tmp_path: Path) -> None:
    old, new, said = WRONG[name]
    assert old in DOMAIN
    write_plates(tmp_path, domain=DOMAIN.replace(old, new))
    with pytest.raises(SeeWhyError) as refused:
        load_domain(tmp_path)
    assert str(refused.value).replace(f"{tmp_path}/", "") == said


def test_a_domain_of_nothing(tmp_path: Path) -> None:
    write_plates(tmp_path, domain=DOMAIN[: DOMAIN.index("[things]")])
    with pytest.raises(SeeWhyError, match=r"domain.toml:1: 'features' is missing; add it"):
        load_domain(tmp_path)


def test_a_sort_of_things_of_which_nothing_is_said(tmp_path: Path) -> None:
    write_domain(tmp_path, knowledge=KNOWLEDGE_OF_TILES + "#sort spot = things.\n")
    with pytest.raises(SeeWhyError) as refused:
        load_domain(tmp_path)
    assert str(refused.value).replace(f"{tmp_path}/", "") == (
        f"knowledge.al:{len(KNOWLEDGE_OF_TILES.splitlines()) + 1}:1: the sort 'spot' stands for "
        'things, of which domain.toml says nothing; add [things] with sort = "spot"'
    )
