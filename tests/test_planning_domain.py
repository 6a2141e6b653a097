"""A planning domain's folder, read as a whole: every mistake is named with its line."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from seewhy.errors import DomainError, KnowledgeError, SeeWhyError
from seewhy.planning.domain import bundled_planning_domains, load_planning_domain

KNOWLEDGE = (
    "#sort robot = {rob1}. #sort place = {hall, kitchen}. #static next_to(place, place).\n"
    "#fluent basic at(robot, place). #fluent basic closed(place).\n"
    "#action move(robot, place). #action exogenous shut(place).\n"
    "move(R, L) causes at(R, L). shut(L) causes closed(L).\n"
)
TOML = """\
[planning]
name = "rooms"
title = "Rooms"
robot = "rob1"
horizon = 9

[things]
hall = "the hall"

[fluents.at]
say = "{0} is in {1}"
deny = "{0} is not in {1}"

[actions.move]
do = "move to {1}"
did = "moved to {1}"

[[sensing]]
literal = "at(R, L)"
where = "robot(R)"

[[sensing]]
literal = "closed(L)"
where = "at(rob1, L)"
error = 0.25

[simulation.events]
shut = 0.1

[simulation.failures]
move = 0.1

[map]
places = "place"
links = "next_to"
where = "at"
closed = "closed"
"""


def written(folder: Path, toml: str = TOML, knowledge: str = KNOWLEDGE) -> Path:
    (folder / "planning.toml").write_text(toml)
    (folder / "knowledge.al").write_text(knowledge)
    return folder


def refused(folder: Path, kind: type[SeeWhyError] = DomainError) -> str:
    with pytest.raises(kind) as problem:
        load_planning_domain(folder)
    return str(problem.value).replace(f"{folder}/", "").replace(f"{folder}", "FOLDER")


def test_a_folder_without_mistakes_is_loaded(tmp_path: Path) -> None:
    domain = load_planning_domain(written(tmp_path))
    assert (domain.name, domain.title, domain.robot, domain.horizon) == (
        "rooms",
        "Rooms",
        "rob1",
        9,
    )
    assert domain.history.last_step == 0
    assert [
        (str(sensing.literal), list(map(str, sensing.conditions)), sensing.error)
        for sensing in domain.sensing
    ] == [("at(R, L)", ["robot(R)"], 0.0), ("closed(L)", ["at(rob1, L)"], 0.25)]


def test_bundled_domains_are_loaded_by_name() -> None:
    names = bundled_planning_domains()
    assert {"robot_assistant", "tabletop"} <= {*names}
    assert [load_planning_domain(name).name for name in names] == list(names)


# Wrong lines of planning.toml: what stands there, what is put there instead, the whole error

MISTAKES = {
    "a robot of no sort": (
        'robot = "rob1"',
        'robot = "rob2"',
        "planning.toml:4: 'rob2' is of no sort; did you mean 'rob1'?",
    ),
    "a name with capitals": (
        'name = "rooms"',
        'name = "Rooms"',
        "planning.toml:2: 'planning.name': string should match pattern '^[a-z][a-z0-9_]*$', got "
        "'Rooms'",
    ),
    "no title": ('title = "Rooms"\n', "", "planning.toml:1: 'planning.title' is missing; add it"),
    "a misspelt key": (
        "horizon = 9",
        "horizont = 9",
        "planning.toml:5: 'planning.horizont' is not known here; did you mean 'horizon'?",
    ),
    "a horizon of none": (
        "horizon = 9",
        "horizon = 0",
        "planning.toml:5: 'planning.horizon': input should be greater than or equal to 1, got 0",
    ),
    "a thing that there is not": (
        'hall = "the hall"',
        'hal = "the hall"',
        "planning.toml:8: 'hal' is of no sort; did you mean 'hall'?",
    ),
    "a thing called by no word": (
        'hall = "the hall"',
        'hall = "★"',
        "planning.toml:8: 'things.hall': must have a letter or a digit, got '★'",
    ),
    "a clause that is nothing but its slots": (
        'say = "{0} is in {1}"',
        'say = "{0} {1}"',
        "planning.toml:11: 'fluents.at.say': must have a letter or a digit beside its slots, got "
        "'{0} {1}'",
    ),
    "an instruction of no word": (
        'do = "move to {1}"',
        'do = ""',
        "planning.toml:15: 'actions.move.do': must have a letter or a digit, got ''",
    ),
    "a fluent that there is not": (
        "[fluents.at]",
        "[fluents.att]",
        "planning.toml:10: 'att' is none of the fluents; did you mean 'at'?",
    ),
    "a static among the fluents": (
        "[fluents.at]",
        "[fluents.next_to]",
        "planning.toml:10: 'next_to' is none of the fluents; it must be one of: at, closed",
    ),
    "a slot too many in a fluent": (
        'deny = "{0} is not in {1}"',
        'deny = "{0} is not in {2}"',
        "planning.toml:12: 'at' has 2 arguments, counted from 0, but '{0} is not in {2}' asks for "
        "{2}",
    ),
    "an action that there is not": (
        "[actions.move]",
        "[actions.moves]",
        "planning.toml:14: 'moves' is none of the actions; did you mean 'move'?",
    ),
    "a fluent among the actions": (
        "[actions.move]",
        "[actions.closed]",
        "planning.toml:14: 'closed' is none of the actions; it must be one of: move, shut",
    ),
    "a slot too many in an action": (
        'do = "move to {1}"',
        'do = "move to {7}"',
        "planning.toml:15: 'move' has 2 arguments, counted from 0, but 'move to {7}' asks for {7}",
    ),
    "an action without words": (
        'did = "moved to {1}"\n',
        "",
        "planning.toml:14: 'actions.move.did' is missing; add it",
    ),
    "an event that there is not": (
        "shut = 0.1",
        "shout = 0.1",
        "planning.toml:28: 'shout' is no exogenous action; did you mean 'shut'?",
    ),
    "an action of the robot among the events": (
        "shut = 0.1",
        "move = 0.1",
        "planning.toml:28: 'move' is no exogenous action; it must be one of: shut",
    ),
    "a failure of something that happens": (
        "move = 0.1",
        "shut = 0.1",
        "planning.toml:31: 'shut' is no action; it must be one of: move",
    ),
    "a fluent among the statics": (
        "[map]",
        '[statics.at]\nsay = "{0} is in {1}"\n\n[map]',
        "planning.toml:33: 'at' is none of the statics; it must be one of: next_to",
    ),
    "a duration of something that happens": (
        "[map]",
        "[simulation.durations]\nshut = 3\n\n[map]",
        "planning.toml:34: 'shut' is no action; it must be one of: move",
    ),
    "a duration below nothing": (
        "[map]",
        "[simulation.durations]\nmove = -3\n\n[map]",
        "planning.toml:34: 'simulation.durations.move': input should be greater than or equal to "
        "0, got -3",
    ),
    "no probability": (
        "move = 0.1",
        "move = 1.5",
        "planning.toml:31: 'simulation.failures.move': input should be less than or equal to 1, "
        "got 1.5",
    ),
    "places that are no sort": (
        'places = "place"',
        'places = "plaze"',
        "planning.toml:34: 'plaze' is no sort; did you mean 'place'?",
    ),
    "links that are no static": (
        'links = "next_to"',
        'links = "nextto"',
        "planning.toml:35: 'nextto' is no static; did you mean 'next_to'?",
    ),
    "where that is no fluent": (
        'where = "at"',
        'where = "next_to"',
        "planning.toml:36: 'next_to' is no fluent; it must be one of: at, closed",
    ),
    "where of the wrong sorts": (
        'where = "at"',
        'where = "closed"',
        "planning.toml:36: 'closed(place)' must be of the form closed(thing, place)",
    ),
    "closed of the wrong sorts": (
        'closed = "closed"',
        'closed = "at"',
        "planning.toml:37: 'at(robot, place)' must be of the form at(place)",
    ),
    "a sensed fluent that there is not": (
        'literal = "closed(L)"',
        'literal = "closd(L)"',
        "planning.toml:23: 'closd' is not declared; did you mean 'closed'?",
    ),
    "sensing of a static": (
        'literal = "closed(L)"',
        'literal = "next_to(L, L)"',
        "planning.toml:23: 'next_to(L, L)' is no fluent; what is sensed is whether a fluent such "
        "as at(rob1, hall) holds",
    ),
    "sensing of an action": (
        'literal = "closed(L)"',
        'literal = "shut(L)"',
        "planning.toml:23: 'shut(L)' is no fluent; what is sensed is whether a fluent such "
        "as at(rob1, hall) holds",
    ),
    "sensing of a denial": (
        'literal = "closed(L)"',
        'literal = "-closed(L)"',
        "planning.toml:23: '-closed(L)' is no fluent; what is sensed is whether a fluent such as "
        "at(rob1, hall) holds",
    ),
    "sensing of no literal": (
        'literal = "closed(L)"',
        'literal = "closed(L) if"',
        "planning.toml:23: 'closed(L) if' is no fluent; what is sensed is whether a fluent such "
        "as at(rob1, hall) holds",
    ),
    "sensing where a place is unknown": (
        'where = "at(rob1, L)"',
        'where = "at(rob1, L), next_to(L, garden)"',
        "planning.toml:24: 'garden' is not of sort 'place', which 'next_to' takes here; it must "
        "be one of: hall, kitchen",
    ),
    "sensing where nothing is said": (
        'where = "at(rob1, L)"',
        'where = " "',
        "planning.toml:24: nothing is said; write where the robot senses this, such as "
        "at(rob1, hall)",
    ),
    "sensing where an action happens": (
        'where = "at(rob1, L)"',
        'where = "move(rob1, L)"',
        "planning.toml:24: the action 'move' is a condition; actions stand before 'causes' or "
        "after 'impossible' only",
    ),
    "sensing with two statements": (
        'where = "at(rob1, L)"',
        'where = "at(rob1, L). closed(L)"',
        "planning.toml:24: found 2 statements in 'at(rob1, L). closed(L)'; write conditions with "
        "commas between them and no full stop",
    ),
    "sensing that cannot be parsed": (
        'where = "at(rob1, L)"',
        'where = "at(rob1 L)"',
        "planning.toml:24: syntax error, unexpected a variable, expecting ) or ;; an axiom reads "
        "'head if condition, condition.'",
    ),
    "unbound where": (
        'where = "at(rob1, L)"',
        'where = "not at(R, L)"',
        "planning.toml:24: nothing says what 'R' ranges over; use it in a condition without "
        "'not', a sort such as structure(S) for instance",
    ),
    "a sensor that errs too much": (
        "error = 0.25",
        "error = 2",
        "planning.toml:25: 'sensing.1.error': input should be less than or equal to 1, got 2",
    ),
    "no literal to sense": (
        'literal = "closed(L)"\n',
        "",
        "planning.toml:22: 'sensing.1.literal' is missing; add it",
    ),
    "no TOML": (
        "[things]",
        "[things",
        "planning.toml:7:8: not valid TOML: expected ']' at the end of a table declaration",
    ),
}


@pytest.mark.parametrize("kind", MISTAKES)
def test_every_mistake_in_planning_toml(kind: str, tmp_path: Path) -> None:
    right, wrong, expected = MISTAKES[kind]
    assert TOML.count(right) == 1 or right == "hall"
    assert refused(written(tmp_path, TOML.replace(right, wrong))) == expected


def test_a_folder_without_planning_toml(tmp_path: Path) -> None:
    (written(tmp_path) / "planning.toml").unlink()
    names = ", ".join(bundled_planning_domains())
    assert refused(tmp_path) == (
        "FOLDER: the domain has no planning.toml, so nothing can be planned in it; the domains "
        f"that plan are {names}"
    )


def test_neither_a_folder_nor_a_name() -> None:
    with pytest.raises(DomainError) as problem:
        load_planning_domain("tabeltop")
    assert str(problem.value) == (
        "'tabeltop' is neither a folder nor a bundled domain that plans; did you mean 'tabletop'?"
    )


def test_a_folder_without_knowledge(tmp_path: Path) -> None:
    (written(tmp_path) / "knowledge.al").unlink()
    assert refused(tmp_path, KnowledgeError) == (
        "knowledge.al: there is no such file; a domain needs its axioms in knowledge.al"
    )


def test_knowledge_without_actions(tmp_path: Path) -> None:
    """Something that happens unasked is nothing that one could plan."""
    unasked = "#fluent basic open. #action exogenous shut. shut causes -open."
    written(tmp_path, '[planning]\nname = "rooms"\ntitle = "Rooms"\n', unasked)
    assert refused(tmp_path) == (
        "planning.toml:1: knowledge.al declares no action, so nothing can be planned"
    )


def test_a_sort_without_members(tmp_path: Path) -> None:
    written(tmp_path, knowledge=KNOWLEDGE + "#sort picture.")
    assert refused(tmp_path) == (
        "planning.toml:1: the sort 'picture' has no members (knowledge.al:5:1)"
    )


def test_planning_toml_that_is_no_text(tmp_path: Path) -> None:
    (written(tmp_path) / "planning.toml").write_bytes(b"\xff\xfe")
    assert refused(tmp_path).startswith("planning.toml: cannot be read as UTF-8 text (")


def test_a_mistake_in_the_history(tmp_path: Path) -> None:
    (written(tmp_path) / "history.al").write_text("observed at(rob1, hal) at 0.")
    assert refused(tmp_path, KnowledgeError) == (
        "history.al:1:10: 'hal' is not of sort 'place', which 'at' takes; did you mean 'hall'?"
    )


def test_a_folder_may_be_copied(tmp_path: Path) -> None:
    shutil.copytree(load_planning_domain("tabletop").folder, tmp_path / "mine")
    assert load_planning_domain(tmp_path / "mine").title == "Things on a table"
