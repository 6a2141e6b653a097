"""Knowledge about change that cannot be meant is refused; what may not be meant is noted."""

from __future__ import annotations

from pathlib import Path

import pytest

from seewhy.check.change import check_change
from seewhy.errors import KnowledgeError, PlanningError, SeeWhyError
from seewhy.planning.domain import PlanningDomain, load_planning_domain

HEADER = (
    "#sort robot = {rob1}. #sort place = {hall, kitchen, attic}. #static next_to(place, place).\n"
    "#fluent basic at(place). #fluent basic closed(place). #fluent defined warm(place).\n"
    "#action move(robot, place). #action exogenous shut(place).\n"
    "move(R, L) causes at(L).\n"
    "-at(L2) if at(L1), L1 != L2.\n"
    "impossible move(R, L) if at(K), not next_to(K, L).\n"
    "shut(L) causes closed(L).\n"
    "next_to(hall, kitchen). next_to(kitchen, hall). next_to(A, A) if place(A).\n"
    "next_to(kitchen, attic). next_to(attic, kitchen).\n"
)
TOML = '[planning]\nname = "rooms"\ntitle = "Rooms"\nrobot = "rob1"\n'
IN_HALL = "observed at(hall) at 0.\n"


WORDS = (
    '[things]\nrob1 = "the robot"\nhall = "the hall"\n'
    '[fluents.at]\nsay = "the robot is in {0}"\n'
    '[actions.move]\ndo = "move to {1}"\ndid = "moved to {1}"\n'
    '[actions.shut]\ndid = "somebody closed {0}"\n'
)


def written(
    folder: Path, text: str, *, history: str = IN_HALL, header: str = HEADER, words: str = ""
) -> PlanningDomain:
    (folder / "knowledge.al").write_text(header + text)
    (folder / "history.al").write_text(history)
    (folder / "planning.toml").write_text(TOML + words)
    return load_planning_domain(folder)


def problem(folder: Path, text: str, *, history: str = IN_HALL) -> tuple[type[SeeWhyError], str]:
    """The error, its file without the folder."""
    domain = written(folder, text, history=history)
    with pytest.raises(SeeWhyError) as raised:
        check_change(domain)
    return type(raised.value), str(raised.value).replace(f"{folder}/", "")


def test_knowledge_without_mistakes_passes(tmp_path: Path) -> None:
    assert check_change(written(tmp_path, "")) == ()
    assert check_change(load_planning_domain("robot_assistant")) == ()


# Errors; the text of each comes with a way out, which is then tried

ERRORS: dict[str, tuple[str, str, str]] = {
    "two effects that contradict each other": (
        "move(R, L) causes -at(L).",
        "knowledge.al:4:1: 'move(R, L) causes at(L).' defeats itself: wherever it applies, "
        "'move(R, L) causes -at(L).' (line 10) brings about the opposite, so that 'move(R, L)' "
        "can never happen where this applies; change or remove one of them, or write "
        "'impossible move(R, L) if …' for where they contradict",
        "move(R, L) causes -at(K) if at(K), K != L.",
    ),
    "an effect under a condition": (
        "move(R, L) causes -at(L) if closed(L).",
        "knowledge.al:10:1: 'move(R, L) causes -at(L) if closed(L).' defeats itself: wherever it "
        "applies, 'move(R, L) causes at(L).' (line 4) brings about the opposite, so that "
        "'move(R, L)' can never happen where this applies; change or remove one of them, or "
        "write 'impossible move(R, L) if …' for where they contradict",
        "impossible move(R, L) if closed(L).",
    ),
    "an effect that a constraint denies": (
        "-closed(L) if place(L).",
        "knowledge.al:7:1: 'shut(L) causes closed(L).' defeats itself: wherever it applies, "
        "'-closed(L) if place(L).' (line 10) brings about the opposite, so that 'shut(L)' can "
        "never happen where this applies; change or remove one of them, or write "
        "'impossible shut(L) if …' for where they contradict",
        "-closed(L) if at(L).",
    ),
    "two consequences of an effect": (
        "#fluent basic dark. dark if closed(hall). -dark if closed(L).\n"
        "#action lock. lock causes closed(hall).",
        "knowledge.al:11:15: 'lock causes closed(hall).' defeats itself: wherever it applies, "
        "'dark if closed(hall).' (line 10) and '-dark if closed(L).' (line 10) bring about "
        "opposites, so that 'lock' can never happen where this applies; change or remove one of "
        "them, or write 'impossible lock if …' for where they contradict",
        "#fluent basic dark. dark if closed(hall). -dark if closed(L), L != hall, at(L).\n"
        "#action lock. lock causes closed(hall).",
    ),
    "an action that one condition forbids": (
        "impossible shut(L) if place(L).",
        "knowledge.al:10:1: 'shut' is never possible: in every state this forbids it: "
        "'impossible shut(L) if place(L).' (line 10); change it, or remove the action",
        "impossible shut(L) if at(L).",
    ),
    "an action that two conditions forbid": (
        "impossible shut(L) if closed(L). impossible shut(L) if at(L).\n"
        "impossible shut(L) if -closed(L).",
        "knowledge.al:10:1: 'shut' is never possible: in every state one of these forbids it: "
        "'impossible shut(L) if closed(L).' (line 10) and 'impossible shut(L) if -closed(L).' "
        "(line 11); change one of them, or remove the action",
        "impossible shut(L) if closed(L). impossible shut(L) if at(L).",
    ),
    "constraints that contradict each other": (
        "closed(L) if at(hall). -closed(attic) if at(hall).\nat(hall). -at(attic).",
        "knowledge.al:10:1: no state satisfies 'closed(L) if at(hall).' (line 10) and "
        "'-closed(attic) if at(hall).' (line 10) and 'at(hall).' (line 11); change one of them, "
        "or give one a condition",
        "closed(L) if at(hall). -closed(attic) if at(kitchen).",
    ),
    "statics that contradict each other": (
        "-next_to(hall, kitchen).",
        "knowledge.al: the axioms about what never changes contradict each other; look for a "
        "static that is concluded with and without '-'",
        "-next_to(hall, attic).",
    ),
}


@pytest.mark.parametrize("kind", ERRORS)
def test_every_error_in_full(kind: str, tmp_path: Path) -> None:
    text, expected, _ = ERRORS[kind]
    assert problem(tmp_path, text) == (KnowledgeError, expected)


@pytest.mark.parametrize("kind", ERRORS)
def test_nothing_is_refused_where_the_mistake_is_not(kind: str, tmp_path: Path) -> None:
    check_change(written(tmp_path, ERRORS[kind][2]))


def test_a_law_that_contradicts_another_in_some_states_only_is_accepted(tmp_path: Path) -> None:
    # Who is at home can move there.
    assert check_change(written(tmp_path, "move(R, L) causes at(hall).")) == ()


def test_a_history_that_no_state_satisfies_is_refused_with_its_place(tmp_path: Path) -> None:
    history = "observed closed(attic) at 0.\nobserved at(hall) at 0.\n  observed at(attic) at 0.\n"
    kind, text = problem(tmp_path, "", history=history)
    assert kind is PlanningError
    said = (
        "history.al:{}: nothing that may be assumed explains this history as long as it says "
        "'observed at({}) at 0'; correct it, or add to the knowledge what could have happened"
    )
    assert text in (said.format("2:1", "hall"), said.format("3:3", "attic"))


# Notes


def notes(folder: Path, text: str, *, history: str = IN_HALL) -> list[str]:
    found = check_change(written(folder, text, history=history))
    return [note.replace(f"{folder}/", "") for note in found]


def test_rooms_that_cannot_be_reached_are_noted(tmp_path: Path) -> None:
    cut_off = HEADER.replace("next_to(kitchen, attic). ", "")
    assert check_change(written(tmp_path, "", header=cut_off)) == (
        "never possible: move(rob1, attic)",
    )


def test_an_action_that_needs_what_can_never_be_is_noted(tmp_path: Path) -> None:
    text = (
        "#fluent basic lit(place). #action heat(robot, place).\n"
        "heat(R, L) causes lit(L). impossible heat(R, L) if not at(L).\n"
        "impossible heat(R, L) if not lit(L). default -lit(L)."
    )
    assert notes(tmp_path, text) == ["never possible: heat(rob1, _)"]
    # What happens unasked may make it possible.
    text += "#action exogenous dawn. dawn causes lit(L)."
    assert notes(tmp_path, text) == []


def test_a_law_that_never_applies_is_noted(tmp_path: Path) -> None:
    text = "impossible shut(L) if at(L). shut(L) causes -at(L) if at(L)."
    assert notes(tmp_path, text) == [
        "knowledge.al:10:30: 'shut(L) causes -at(L) if at(L).' never applies: where its "
        "conditions hold, 'shut(L)' is impossible"
    ]


def test_defaults_that_contradict_each_other_are_noted(tmp_path: Path) -> None:
    text = "default -closed(L).\ndefault closed(L) if at(K), L != K, next_to(K, L)."
    assert notes(tmp_path, text + " at(hall).") == [
        "knowledge.al:10:1: in every initial state there is an exception to 'default -closed(L).' "
        "or to what it contradicts: 'default closed(L) if at(K), L != K, next_to(K, L).' (line 11) "
        "and 'at(hall).' (line 11)"
    ]
    assert notes(tmp_path, text.replace("next_to(K, L)", "not next_to(K, L), K != hall")) == []


def test_what_follows_is_noted_where_it_is_left_open(tmp_path: Path) -> None:
    text = "#fluent defined kept(place).\nkept(L) if at(L), L != hall.\n"
    open_ended = text + "at(hall) if place(hall), not kept(kitchen), not kept(attic)."
    said = (
        "knowledge.al:12:1: where nothing is done it is left open in some state whether '{}' "
        "holds; 'at(hall) if place(hall), not kept(kitchen), not kept(attic).' asks with 'not' "
        "for what its own conclusion decides"
    )
    (note,) = notes(tmp_path, open_ended)
    assert note in {said.format(f"at({place})") for place in ("hall", "kitchen", "attic")}
    assert notes(tmp_path, text) == []


# Notes in the words of planning.toml


def test_what_is_never_possible_is_said_in_words(tmp_path: Path) -> None:
    cut_off = HEADER.replace("next_to(kitchen, attic). ", "")
    assert check_change(written(tmp_path, "", header=cut_off, words=WORDS)) == (
        "it is never possible to move to attic: move(rob1, attic)",
    )
    nowhere = HEADER.replace("if at(K), not next_to(K, L)", "if not next_to(hall, attic)")
    nowhere = nowhere.replace("#action exogenous", "#fluent basic lit. #action exogenous")
    nowhere = nowhere.replace("if not next_to(hall, attic)", "if not lit") + "default -lit."
    assert check_change(written(tmp_path, "", header=nowhere, words=WORDS)) == (
        "it is never possible to move to any place: move(rob1, _)",
    )


def test_what_is_left_open_is_said_in_words(tmp_path: Path) -> None:
    text = (
        "#fluent basic rung. #fluent basic lit(place). #action exogenous ring. ring causes rung.\n"
        "lit(hall) if rung, not lit(attic).\nlit(attic) if rung, not lit(hall)."
    )
    (note,) = check_change(written(tmp_path, text))
    assert "after 'ring' it is left open in some state whether 'lit(" in note
    words = '[fluents.lit]\nsay = "there is light in {0}"\n[actions.ring]\ndid = "the bell rang"\n'
    (note,) = check_change(written(tmp_path, text, words=WORDS + words))
    said = (
        "after the bell rang ('ring') it is left open in some state whether there is light in {}; "
    )
    assert said.format("attic ('lit(attic)')") in note or (
        said.format("the hall ('lit(hall)')") in note
    )
