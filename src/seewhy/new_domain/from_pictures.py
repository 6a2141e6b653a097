"""Write a domain with the classes and features that pictures and their labels say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from seewhy.check.domain import check_domain
from seewhy.domain.domain import Domain, load_domain
from seewhy.files.folders import whole_folder
from seewhy.induction.axiom_text import axiom_statement
from seewhy.induction.candidate import Candidate
from seewhy.induction.sentence import say_rule
from seewhy.induction.things.conditions import Pattern, There, ThingRule
from seewhy.induction.things.rule_sentence import say_thing_rule
from seewhy.induction.things.rule_text import thing_rule_statement
from seewhy.induction.tree import PathCondition
from seewhy.new_domain.proposals import Proposals, Values, proposals
from seewhy.new_domain.sketch import Sketch
from seewhy.new_domain.template import check_new_folder, write_texts
from seewhy.new_domain.texts import domain_text, knowledge_text, questions_text, readme_text


@dataclass(frozen=True)
class WrittenDomain:
    """The domain written.

    Attributes
    ----------
    folder : Path
    classes, features, axioms : int
        How many it has.
    alike : tuple of str
        Classes that the table of features does not tell apart.
    """

    folder: Path
    classes: int
    features: int
    axioms: int
    alike: tuple[str, ...]


def write_domain_of(
    sketch: Sketch, folder: Path, *, classes_table: str, commands: Sequence[str], data: str
) -> WrittenDomain:
    """Write a domain folder from a sketch, whole or not at all; it passes ``seewhy check``.

    Parameters
    ----------
    sketch : Sketch
    folder : Path
    classes_table : str
        The text of classes.csv; empty for none.
    commands : sequence of str
        What to do next, for README.md.
    data : str
        The folder of the pictures, for README.md.

    Raises
    ------
    DomainError
        If the folder exists, or its name cannot be a domain's.
    """
    check_new_folder(folder)
    nothing = Proposals({}, {})
    found = proposals(sketch.class_values) if not sketch.has_look else nothing
    with whole_folder(folder) as temporary:
        texts = {
            "domain.toml": domain_text(sketch),
            "knowledge.al": knowledge_text(sketch, [], nothing, ""),
            "questions.toml": questions_text(sketch),
            "README.md": readme_text(sketch, commands, data),
        }
        if classes_table:
            texts["classes.csv"] = classes_table
        write_texts(temporary, texts)
        # Axioms are said in the words of the domain, which is read for that.
        domain = load_domain(temporary)
        axioms = [_axiom(domain, label, values) for label, values in found.told_by.items()]
        knowledge = knowledge_text(sketch, axioms, found, _example(domain))
        write_texts(temporary, {"knowledge.al": knowledge})
        check_domain(load_domain(temporary))
    return WrittenDomain(
        folder=folder,
        classes=len(sketch.classes),
        features=len(sketch.features),
        axioms=len(axioms),
        alike=tuple(found.alike),
    )


def _axiom(domain: Domain, label: str, values: Values) -> tuple[str, str]:
    """The sentence and the statement of an axiom."""
    conditions = tuple(PathCondition(feature, (value,)) for feature, value in values.items())
    statement = axiom_statement(Candidate(label, conditions), domain.schema)
    return say_rule(domain, conditions, label), statement


def _example(domain: Domain) -> str:
    """An axiom that could be, with its sentence; empty where there is no class to conclude."""
    if not domain.classes:
        return ""
    if not domain.features:
        label = next(iter(domain.classes))
        rule = ThingRule(label, (There(Pattern(1, ()), least=2),))
        assert domain.things is not None
        statement = thing_rule_statement(
            rule, domain.things, domain.schema, domain.knowledge.signature
        )
        return f"%% {say_thing_rule(domain, rule)}\n{statement}"
    name, feature = next(iter(domain.features.items()))
    label = next(iter(domain.classes))
    sentence, statement = _axiom(domain, label, {name: feature.values[0]})
    return f"%% {sentence}\n{statement}"
