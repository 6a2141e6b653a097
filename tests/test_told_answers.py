"""Questions that no template words: golden answers, in a bundled domain and in a user's own."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from conftest import Run, draw_tile, seen
from seewhy.agent.agent import Agent
from seewhy.dialogue.reply import Reply
from seewhy.dialogue.telling import Look
from seewhy.dialogue.text_to_speech import find_voice
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError, SpeechError
from seewhy.perception.familiarity import NearPicture, TrainingPicture
from seewhy.perception.where import Where

HAND = {
    "domain.toml": """\
[domain]
name = "hands"
title = "Hands"
scene = "hand"
subject = "the hand"
eyes = "none"
"""
    + "".join(
        f"""
[features.{finger}]
name = "{finger.replace("_", " ")}"

[features.{finger}.values]
yes = {{ say = "the {finger.replace("_", " ")} is stretched", words = ["stretched"] }}
no = {{ say = "the {finger.replace("_", " ")} is folded", words = ["folded"] }}
"""
        for finger in ("thumb", "index_finger", "middle_finger")
    )
    + """
[classes.fist]
literal = "fist(H)"
say = "a fist"

[classes.open]
literal = "-fist(H)"
say = "open"
words = ["open", "a friendly greeting"]

[beliefs.intent]
name = "intention"
say = "{it} wants to {value}"

[beliefs.intent.values]
greet = "greet"
hit = "hit"
""",
    "knowledge.al": """\
#sort hand.
#sort intention = {greet, hit}.
#static thumb(hand).
#static index_finger(hand).
#static middle_finger(hand).
#static fist(hand).
#static intent(hand, intention).

%% a hand of which every finger is folded is a fist
fist(H) if -thumb(H), -index_finger(H), -middle_finger(H).

%% a hand with a stretched middle finger is open
-fist(H) if middle_finger(H).

intent(H, hit) if fist(H).
intent(H, greet) if -fist(H).
""",
    "questions.toml": '[[question]]\nasks = "is_class"\npatterns = ["is {it} {class}"]\n',
}


@pytest.fixture(scope="module")
def hands(tmp_path_factory: pytest.TempPathFactory) -> Agent:
    folder = tmp_path_factory.mktemp("hands")
    for name, text in HAND.items():
        (folder / name).write_text(text)
    return Agent(load_domain(folder))


@pytest.fixture(scope="module")
def structures_agent() -> Agent:
    return Agent(load_domain("structure_stability"))


TOLD = {
    "what if the base were narrow?": "If the structure has a narrow base, it is still unstable, "
    "since a block is displaced.",
    "what if no block were displaced?": "If no block is displaced, the structure is stable, since "
    "it has a wide base, and it is standing straight.",
    "what if a block were displaced?": "A block is displaced as it is, and the structure is "
    "unstable.",
    "what if it leaned and no block were displaced?": "If the structure leans to one side, and no "
    "block is displaced, I cannot tell what it is.",
    "how sure are you?": "I am sure: the least sure is the displaced block, with a probability of "
    "0.90.",
    "are you sure that it leans?": "That the structure is standing straight has a probability of "
    "0.90.",
    "which rule did you use?": 'By the rule "a block that is not balanced on the one below it '
    'falls" (knowledge.al:11).',
    "what should I check?": "Check the displaced block first: it is seen with a probability of "
    "0.90; if no block is displaced, the structure is stable.",
    "why is a block displaced?": "I see that a block is displaced, with a probability of 0.90.",
    "why is the base narrow?": "But I see that the structure has a wide base, with a probability "
    "of 0.90.",
    "why is the base not narrow?": "I see that the structure has a wide base, with a probability "
    "of 0.90.",
    "why unstable rather than stable?": (
        "The structure is unstable, since a block is displaced; it is stable when no block is "
        "displaced."
    ),
    "why stable rather than unstable?": "The structure is not stable: it is unstable, since a "
    "block is displaced.",
    "why four blocks rather than three?": "I see that the structure has four blocks, with a "
    "probability of 0.90; that it has three blocks has at most 0.10.",
    "is it leaning and is a block displaced?": "No, the structure is standing straight, and a "
    "block is displaced.",
    "does it lean or is a block displaced?": "Yes, a block is displaced.",
    "is it neither leaning nor narrow at the base?": "Yes, the structure is standing straight, "
    "and it has a wide base.",
    "describe it": "The structure has four blocks and a wide base, it is standing straight, and a "
    "block is displaced; the structure is unstable.",
    "can't you tell me is it stable?": "No, the structure is unstable.",
    "how does it differ from a stable structure?": "The structure is stable when no block is "
    "displaced; here a block is displaced.",
    "what distinguishes it from an unstable tower?": "The structure is unstable.",
    "which base is it showing?": "The structure has a wide base.",
    "what is the tower's base?": "The structure has a wide base.",
    "what can make it stable?": "To make the structure stable, put the displaced block back in "
    "place.",
    "what could make it stable?": "To make the structure stable, put the displaced block back in "
    "place.",
}


@pytest.mark.parametrize(("question", "answer"), TOLD.items())
def test_structures_are_told_of(structures_agent: Agent, question: str, answer: str) -> None:
    scene = seen(structures_agent, "4", "wide", "no", "yes")
    assert (
        structures_agent.answer(scene, structures_agent.questions.understand(question)).text
        == answer
    )


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("how many fingers are stretched?", "1 of 3 is stretched: the middle finger."),
        ("which fingers are folded?", "The thumb and the index finger are folded."),
        ("why is the thumb folded?", "I see that the thumb is folded, with a probability of 0.90."),
        (
            "what if the middle finger were folded?",
            "If the middle finger is folded, the hand is a fist, since the thumb is folded, and "
            "the index finger is folded.",
        ),
        ("is the thumb folded and the index finger stretched?", None),
        ("is the thumb stretched?", "No, the thumb is folded."),
        ("which hand is folded?", None),
        ("why is the hand open?", "The middle finger is stretched."),
        ("what is the hand's intention?", "The hand wants to greet."),
        ("what is its intention?", "The hand wants to greet."),
        ("which intention is it showing?", "The hand wants to greet."),
        ("what does the hand's intention show?", None),
        ("is the greeting friendly?", "Yes, the hand is open."),
        ("why is that greeting friendly?", "The middle finger is stretched."),
        ("is the thumb friendly?", None),
        (
            "how is it different from a fist?",
            "The hand is a fist when the middle finger is folded; here the middle finger is "
            "stretched.",
        ),
        (
            "how does the hand differ from one that is a fist?",
            "The hand is a fist when the middle finger is folded; here the middle finger is "
            "stretched.",
        ),
    ],
)
def test_a_folder_without_templates_is_told_of(
    hands: Agent, question: str, answer: str | None
) -> None:
    scene = seen(hands, "no", "no", "yes")
    try:
        text = hands.answer(scene, hands.questions.understand(question)).text
    except QuestionError:
        assert answer is None
        return
    assert answer is None or text == answer


class Picture(Look):
    """A picture in whose upper right corner the displaced block is seen."""

    def where(self) -> dict[str, Where]:
        corner = np.zeros((9, 9), dtype=np.float32)
        corner[:3, 6:] = 1
        return {"block_displaced": Where("block_displaced", "yes", 0.9, 0.6, corner)}

    def nearest(self) -> list[NearPicture]:
        return [NearPicture(TrainingPicture("7.png", "unstable", {}), 0.925)]


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("where is it displaced?", "A block is displaced, and I see it most of all in the upper "
         "right."),
        ("where is the lean?", "Nowhere: the structure is standing straight."),
        ("why is a block displaced?", "I see that a block is displaced, with a probability of "
         "0.90, most of all in the upper right."),
        ("where is the base?", "The structure has a wide base, and no single place of the picture "
         "tells it."),
        ("are there similar pictures?", "Of the pictures of training, the most like it: 7.png "
         "(unstable, alike to 0.93)."),
    ],
)  # fmt: skip
def test_a_picture_is_looked_at_again(structures_agent: Agent, question: str, answer: str) -> None:
    scene = seen(structures_agent, "4", "wide", "no", "yes")
    asked = structures_agent.questions.understand(question)
    assert structures_agent.answering.answer(scene, asked, look=Picture()).text == answer


@pytest.mark.parametrize("question", ["where is it displaced?", "are there similar pictures?"])
def test_without_a_picture_it_is_said_that_one_is_needed(
    structures_agent: Agent, question: str
) -> None:
    with pytest.raises(QuestionError, match="and there is none; ask 'seewhy ask MODEL IMAGE'"):
        structures_agent.answer(
            seen(structures_agent, "4", "wide", "no", "yes"),
            structures_agent.questions.understand(question),
        )


def talk(structures_agent: Agent, *questions: str) -> list[tuple[str | None, ...]]:
    """What questions ask that are put one after the other."""
    scene = seen(structures_agent, "4", "wide", "no", "yes")
    previous: Reply | None = None
    found = []
    for text in questions:
        asked = structures_agent.questions.understand(
            text, previous=previous.question if previous else None
        )
        previous = structures_agent.answer(scene, asked, previous=previous)
        found.append(asked.query)
    return found


@pytest.mark.parametrize(
    ("questions", "answer"),
    [
        (
            ("what if no block were displaced?", "why?"),
            "You asked: what if no block is displaced? Suppose that no block is displaced. I see "
            "that the structure has a wide base, and it is standing straight (each with a "
            'probability of at least 0.90). Then the structure is stable, because "a structure on '
            'a wide base does not fall when it stands straight and every block is balanced".',
        ),
        (
            ("what if no block were displaced?", "how sure are you?"),
            "My answer supposes that no block is displaced; beside that, I am sure: the least sure "
            "is the width of the base, with a probability of 0.90.",
        ),
        (
            ("what if a block were displaced?", "how sure are you?"),
            "My answer supposes that a block is displaced; beside that, I am sure: nothing that it "
            "rests on is uncertain.",
        ),
    ],
)
def test_what_was_supposed_is_not_told_as_seen(
    structures_agent: Agent, questions: tuple[str, ...], answer: str
) -> None:
    scene = seen(structures_agent, "4", "wide", "no", "yes")
    reply: Reply | None = None
    for text in questions:
        asked = structures_agent.questions.understand(
            text, previous=reply.question if reply else None
        )
        reply = structures_agent.answer(scene, asked, previous=reply)
    assert reply is not None
    assert reply.text == answer


def test_what_was_just_spoken_of_may_be_left_out(structures_agent: Agent) -> None:
    assert talk(structures_agent, "is it stable?", "and why?") == [
        ("is_class", "stable", None, None),
        ("explain", None, None, None),
    ]
    assert talk(structures_agent, "is it stable?", "why not?")[1] == (
        "why_not_class",
        "stable",
        None,
        None,
    )
    assert talk(structures_agent, "is it unstable?", "why not stable?")[1][:2] == (
        "why_not_class",
        "stable",
    )
    assert talk(structures_agent, "how many blocks are there?", "and the base?")[1][:3:2] == (
        "feature_value",
        "base",
    )
    assert talk(structures_agent, "how sure are you about the lean?", "and the base?")[1][:3:2] == (
        "how_sure",
        "base",
    )
    assert talk(structures_agent, "what would make it stable?", "and unstable?")[1] == (
        "change_to_class",
        "unstable",
        None,
        None,
    )
    assert (
        talk(structures_agent, "what if the base were narrow?", "and if it leaned?")[1][-1]
        == "lean=yes"
    )


@pytest.mark.parametrize(
    "text", ["and why?", "why not?", "and the base?", "which block is displaced?"]
)
def test_what_cannot_be_known_is_asked_back(structures_agent: Agent, text: str) -> None:
    with pytest.raises(QuestionError) as problem:
        structures_agent.questions.understand(text)
    for nearest in problem.value.nearest:
        structures_agent.questions.understand(nearest)


def test_what_is_asked_back_keeps_the_question_word_and_what_is_denied(
    structures_agent: Agent,
) -> None:
    with pytest.raises(QuestionError) as problem:
        structures_agent.questions.understand("why isn't it wobbly on Mondays?")
    assert problem.value.nearest
    assert all(near.startswith("why ") and " not " in near for near in problem.value.nearest)


def test_a_driver_is_answered_from_what_the_sign_tells() -> None:
    signs = Agent(load_domain("traffic_signs"))
    scene = signs.classify_values(
        {
            "shape": "circle", "main_color": "white", "border_color": "red",
            "background_image": "none", "primary_symbol": "left_turn",
            "secondary_symbol": "none", "cross": "red",
        }
    )  # fmt: skip
    assert scene.label == "no_left_turn"
    for question in ("can I turn left?", "may I turn left here?", "am I allowed to turn left?"):
        asked = signs.questions.understand(question)
        assert signs.answer(scene, asked).text == "The driver must not turn left."
    for question in ("can you turn left?", "why must I stop?", "when may I turn left?"):
        with pytest.raises(QuestionError):
            signs.questions.understand(question)


# Named values ---------------------------------------------------------------------------------


def test_named_values_are_decided(run: Run) -> None:
    told = run(
        "decide", "structure_stability", "block_displaced=yes", "--ask", "why is it unstable?"
    )
    assert (told.code, told.err) == (0, "")
    assert told.out == (
        "class: unstable\n"
        "because:\n"
        '  the structure is unstable: "a block that is not balanced on the one below it falls" '
        "(knowledge.al:11)\n"
        "  └─ a block is displaced\n"
        "\n"
        "why is it unstable?\n"
        "A block is displaced.\n"
    )
    told = run("decide", "structure_stability", "base=wide", "--ask", "does it lean?", "--json")
    found = json.loads(told.out)
    assert found["features"] == {
        "num_blocks": None, "base": "wide", "lean": None, "block_displaced": None,
    }  # fmt: skip
    assert found["answers"][0]["text"] == "Nothing is known of the lean."


@pytest.mark.parametrize(
    ("value", "complaint"),
    [
        ("bass=wide", "'bass' is no feature of structure_stability; did you mean 'base'?"),
        ("base=wyde", "'wyde' is no value of 'base'; did you mean 'wide'?"),
        ("base", "'base' gives no value; write FEATURE=VALUE, as in num_blocks=1"),
    ],
)
def test_a_misspelt_value_is_named(run: Run, value: str, complaint: str) -> None:
    told = run("decide", "structure_stability", value)
    assert (told.code, told.out) == (2, "")
    assert told.err == f"seewhy: {complaint}\n"


def test_a_value_is_given_once(run: Run) -> None:
    told = run("decide", "structure_stability", "base=wide", "base=narrow")
    assert told.err == "seewhy: 'base' is given twice, wide and narrow; leave one out\n"


# Speech ---------------------------------------------------------------------------------------


@pytest.fixture
def no_voice(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A machine on which nothing speaks; a program put into the folder is found."""
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "pyttsx3", None)
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    return tmp_path


@pytest.mark.usefixtures("no_voice")
def test_where_nothing_speaks_it_is_said() -> None:
    with pytest.raises(SpeechError, match="nothing that speaks is installed; install espeak-ng"):
        find_voice()


@pytest.mark.usefixtures("no_voice")
def test_speech_is_written_as_wav() -> None:
    with pytest.raises(SpeechError, match=r"give a name that ends in \.wav"):
        find_voice(Path("answer.mp3"))


def test_a_program_speaks(no_voice: Path) -> None:
    program = no_voice / "espeak-ng"
    program.write_text(f'#!/bin/sh\necho "$@" >{no_voice}/asked\n/bin/cat >>{no_voice}/asked\n')
    program.chmod(0o755)
    find_voice(no_voice / "answer.wav")("-stable")
    assert (no_voice / "asked").read_text() == f"--stdin -w {no_voice}/answer.wav\n-stable"
    program.write_text("#!/bin/sh\necho no sound card >&2\nexit 3\n")
    with pytest.raises(SpeechError, match="espeak-ng could not speak: no sound card"):
        find_voice()("stable")


@pytest.mark.usefixtures("no_voice")
def test_a_library_speaks(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    engine = SimpleNamespace(say=said.append, runAndWait=lambda: said.append("spoken"))
    monkeypatch.setattr("importlib.util.find_spec", lambda _: object())
    monkeypatch.setitem(sys.modules, "pyttsx3", SimpleNamespace(init=lambda: engine))
    find_voice()("stable")
    assert said == ["stable", "spoken"]


def test_the_commands_speak(run: Run, model_folder: Path, no_voice: Path) -> None:
    image = no_voice / "tile.png"
    draw_tile("blue", "no", 1).save(image)
    told = run("ask", model_folder, image, "is it good?", "--speak")
    assert (told.code, told.out) == (2, "")
    assert told.err.startswith("seewhy: nothing that speaks is installed; install espeak-ng")
    program = no_voice / "espeak-ng"
    program.write_text(f"#!/bin/sh\n/bin/cat >>{no_voice}/spoken\n")
    program.chmod(0o755)
    told = run("chat", model_folder, image, "--speak", stdin="is it good?\nand why?\n")
    assert told.code == 0
    assert (no_voice / "spoken").read_text() == told.out.replace("\n", "")
    told = run("ask", model_folder, image, "is it good?", "--speech", no_voice / "answer.wav")
    assert told.code == 0
    assert (no_voice / "spoken").read_text().endswith(told.out.splitlines()[0])


def test_one_question_that_is_not_understood_leaves_the_others_answered(run: Run) -> None:
    told = run(
        *("decide", "structure_stability", "block_displaced=yes"),
        *("--ask", "do fish sing?", "--ask", "is it stable?"),
    )
    assert told.code == 2
    assert told.out.splitlines()[0] == "class: unstable"
    assert told.out.splitlines()[-2:] == ["is it stable?", "No, the structure is unstable."]
    assert told.err.startswith("seewhy: 'do fish sing?' is not understood; ask for instance: ")


@pytest.mark.parametrize("domain", ["structure_stability", "traffic_signs", "robot_assistant"])
def test_whatever_is_not_known_every_question_has_an_answer(domain: str) -> None:
    agent = Agent(load_domain(domain))
    features = agent.domain.features
    rng = np.random.default_rng(0)
    asked = [*agent.questions.one_of_each()[:40]]
    asked += [
        agent.questions.understand(text)
        for text in ("how sure are you?", "which rule did you use?", "what should I check?")
    ]
    why = agent.questions.understand("why?")
    for known in range(len(features) + 1):
        some = rng.permutation(list(features))[:known]
        values = {name: str(rng.choice(features[name].values)) for name in some}
        scene = agent.classify_values(values)
        for question in asked:
            reply = agent.answer(scene, question)
            assert reply.text
            assert agent.answer(scene, why, previous=reply).text
