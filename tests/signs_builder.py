"""A domain of road signs with as many classes as a test wants, written as a user would."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from seewhy.agent.agent import Agent
from seewhy.domain.domain import load_domain

FEATURES: Mapping[str, tuple[str, ...]] = {
    "shape": (
        "triangle", "inverted_triangle", "circle", "octagon", "diamond", "square",
        "tall_rectangle", "wide_rectangle",
    ),
    "main_color": ("white", "red", "blue"),
    "border_color": ("red", "white", "blue"),
    "background_image": ("none", "triangle", "square"),
    "primary_symbol": ("bumpy_road", "stop", "blank", *(f"symbol_{n}" for n in range(36))),
    "secondary_symbol": ("none", *(f"plate_{n}" for n in range(9))),
    "cross": ("none", "red", "black"),
}  # fmt: skip
Row = tuple[str, ...]
"""A class's value of every feature."""

FOUR: Mapping[str, Row] = {
    "uneven_road": ("triangle", "white", "red", "none", "bumpy_road", "none", "none"),
    "stop_sign": ("octagon", "red", "white", "none", "stop", "none", "none"),
    "give_way": ("inverted_triangle", "white", "red", "none", "blank", "none", "none"),
    "no_entry": ("circle", "red", "red", "none", "symbol_0", "none", "none"),
}
"""The first four classes; no axiom concludes the last of them."""

_SAY = {
    "shape": ("{{it}} is {}", "be {}"),
    "main_color": ("{{it}} is mainly {}", "be mainly {}"),
    "border_color": ("{{it}} has a {} border", "have a {} border"),
    "background_image": ("{{it}} has the background {}", "have the background {}"),
    "primary_symbol": ("{{it}} shows the symbol {}", "show the symbol {}"),
    "secondary_symbol": ("{{it}} shows the plate {}", "show the plate {}"),
    "cross": ("{{it}} has the cross {}", "have the cross {}"),
}
BELIEFS = """
[beliefs.message]
name = "message"
say = "{it} tells the driver: {value}"

[beliefs.message.values]
uneven_road = "uneven road ahead"
"""
ANSWERS = """
[answers]
change = "to be {asked}, {it} would have to {changes}"
difference = "{required}; {reasons}"
"""


def many_signs(count: int) -> dict[str, Row]:
    """The four signs and further ones, each with values that no other has."""
    rows = dict(FOUR)
    shapes, symbols = FEATURES["shape"], FEATURES["primary_symbol"]
    for n in range(count - len(FOUR)):
        rows[f"sign_{n}"] = (
            shapes[n % 7], FEATURES["main_color"][n % 2], "red", "none",
            symbols[3 + n % 36], FEATURES["secondary_symbol"][n // 36], "none",
        )  # fmt: skip
    return dict(list(rows.items())[:count])


def write_signs(
    folder: Path,
    rows: Mapping[str, Row] = FOUR,
    *,
    unknown: Sequence[str] = ("no_entry",),
    beliefs: str = BELIEFS,
    answers: str = ANSWERS,
    questions: str = "",
    axioms: str = "",
) -> Path:
    """Write the folder of a domain; no axiom concludes the classes ``unknown``."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "domain.toml").write_text(_domain(rows) + beliefs, encoding="utf-8")
    (folder / "knowledge.al").write_text(_knowledge(rows, unknown) + axioms, encoding="utf-8")
    (folder / "questions.toml").write_text(answers + _questions() + questions, encoding="utf-8")
    return folder


@cache
def trained_signs(home: Path) -> Agent:
    """An agent of the four signs; scenes of the one that the knowledge leaves open trained it.

    Do not train it again: it is one for all tests of a session, whose folder ``home`` is.
    """
    domain = load_domain(write_signs(home / "trained_signs"))
    other = (*FOUR["no_entry"][:4], "symbol_5", "none", "none")
    vectors = [FOUR["no_entry"]] * 10 + [other] * 10
    return Agent(domain).fit_induction(vectors, ["no_entry"] * 10 + ["uneven_road"] * 10)


def _domain(rows: Mapping[str, Row]) -> str:
    lines = ['[domain]\nname = "signs"\ntitle = "Signs"\nscene = "sign"\nsubject = "the sign"\n']
    for feature, values in FEATURES.items():
        lines.append(f'[features.{feature}]\nname = "{feature.replace("_", " ")}"')
        lines.append(f"[features.{feature}.values]")
        say, change = _SAY[feature]
        for value in values:
            word = value.replace("_", " ")
            lines.append(
                f'{value} = {{ say = "{say.format(word)}", words = ["{word}"], '
                f'change = "{change.format(word)}" }}'
            )
    for key in rows:
        word = key.replace("_", " ")
        article = "an" if word[0] in "aeiou" else "a"
        lines.append(f'[classes.{key}]\nliteral = "kind(S, {key})"\nsay = "{article} {word}"')
    return "\n".join(lines) + "\n"


def _knowledge(rows: Mapping[str, Row], unknown: Sequence[str]) -> str:
    lines = ["#sort sign.", f"#sort kinds = {{{', '.join(rows)}}}."]
    for feature, values in FEATURES.items():
        lines.append(f"#sort {feature}s = {{{', '.join(values)}}}.")
        lines.append(f"#static {feature}(sign, {feature}s).")
    lines += [
        "#static kind(sign, kinds).",
        f"#sort messages = {{{', '.join(rows)}}}.",
        "#sort responses = {stop, slow_down, be_careful, give_way}.",
        "#static message(sign, messages).",
        "#static response(sign, responses).",
    ]
    for key, (shape, main, _, background, symbol, plate, cross) in rows.items():
        word = key.replace("_", " ")
        if key not in unknown:
            lines.append(f"%% a {shape} with the symbol {symbol} is the sign {word}")
            lines.append(
                f"kind(S, {key}) if shape(S, {shape}), primary_symbol(S, {symbol}), "
                f"secondary_symbol(S, {plate})."
            )
            lines.append(f"%% the sign {word} is mainly {main}")
            lines.append(f"main_color(S, {main}) if kind(S, {key}).")
            lines.append(f"border_color(S, {rows[key][2]}) if kind(S, {key}).")
            lines.append(f"background_image(S, {background}) if kind(S, {key}).")
            lines.append(f"cross(S, {cross}) if kind(S, {key}).")
        if key != "give_way":
            lines.append(f"%% the sign {word} says so")
            lines.append(f"message(S, {key}) if kind(S, {key}).")
        lines.append(f"%% the driver heeds the sign {word}")
        response = "stop" if key in ("stop_sign", "no_entry") else "slow_down"
        lines.append(f"response(S, {response}) if kind(S, {key}).")
        if key == "uneven_road":
            lines.append("%% the driver is careful on an uneven road")
            lines.append("response(S, be_careful) if kind(S, uneven_road).")
    return "\n".join(lines) + "\n"


def _questions() -> str:
    about_classes = {
        "is_class": ("is {it} {class}", "would you say {it} is {class}"),
        "why_not_class": ("why is {it} not {class}",),
        "why_class": ("why is {it} {class}", "what makes {it} {class}"),
        "change_to_class": ("what would make {it} {class}",),
        "difference_to_class": ("how does {it} differ from {class}", "how is {it} unlike {class}"),
        "class": ("what is {it}", "which sign is this"),
        "explain": ("please explain this answer", "explain"),
    }
    lines: list[str] = []
    for asks, patterns in about_classes.items():
        lines.append(f'[[question]]\nasks = "{asks}"\npatterns = {list(patterns)}')
    for predicate in ("message", "response"):
        lines.append(
            f'[[question]]\nasks = "belief_value"\npredicate = "{predicate}"\n'
            f'patterns = ["what is the {predicate} of {{it}}", "which {predicate} is it"]'
        )
    for feature in FEATURES:
        word = feature.replace("_", " ")
        lines.append(
            f'[[question]]\nasks = "feature_value"\nfeature = "{feature}"\n'
            f'patterns = ["what is the {word}"]\n'
            f'[[question]]\nasks = "feature_is"\nfeature = "{feature}"\n'
            f'patterns = ["is the {word} {{value}}"]'
        )
    return "\n".join(lines) + "\n"
