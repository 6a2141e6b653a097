"""The rules of a ground program, layer by layer, with the truth of their atoms in many scenes.

Truth in many scenes is one whole number, a bit a scene: a rule is then evaluated for all of them
by a few operations on numbers.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import clingo

__all__ = ["GroundRules", "Layer", "layers_of"]


@dataclass(frozen=True, slots=True)
class Rule:
    """One way in which an atom becomes true: so many of some literals hold, by weight.

    ``at_least`` is None where all of them have to hold. A literal is an atom's number, negative
    where it is denied.
    """

    body: tuple[int, ...]
    weights: tuple[int, ...] = ()
    at_least: int | None = None

    def holds(self, true: Mapping[int, int], denied: Mapping[int, int], all_scenes: int) -> int:
        """Return the scenes in which it applies.

        ``denied`` tells of each atom the scenes in which a ``not`` before it fails.
        """
        if self.at_least is not None:
            parts = [
                true[literal] if literal > 0 else all_scenes & ~denied[-literal]
                for literal in self.body
            ]
            return _reached(parts, self.weights, self.at_least, all_scenes)
        scenes = all_scenes
        for literal in self.body:
            scenes &= true[literal] if literal > 0 else ~denied[-literal]
        return scenes


def _reached(parts: Sequence[int], weights: Sequence[int], at_least: int, all_scenes: int) -> int:
    """The scenes in which weights add up to enough: numbers are added digit by digit."""
    digits = [0] * max(sum(weights).bit_length(), at_least.bit_length())
    for scenes, weight in zip(parts, weights, strict=True):
        for place in range(weight.bit_length()):
            carry = scenes if weight >> place & 1 else 0
            at = place
            while carry:
                digits[at], carry = digits[at] ^ carry, digits[at] & carry
                at += 1
    more, same = 0, all_scenes
    for place in reversed(range(len(digits))):
        if at_least >> place & 1:
            same &= digits[place]
        else:
            more |= same & digits[place]
            same &= ~digits[place]
    return more | same


@dataclass
class GroundRules(clingo.Observer):
    """Keeps the rules that clingo grounds.

    Attributes
    ----------
    rules : dict of int to list of Rule
        Atom → its rules. What a choice leaves open has none.
    atoms : dict of clingo.Symbol to int
        Symbol → its atom; 0 where it is always true.
    """

    rules: dict[int, list[Rule]] = field(default_factory=dict)
    atoms: dict[clingo.Symbol, int] = field(default_factory=dict)

    def rule(self, choice: bool, head: Sequence[int], body: Sequence[int]) -> None:
        """Keep a rule of literals."""
        self._keep(choice, head, Rule(tuple(body)))

    def weight_rule(
        self, choice: bool, head: Sequence[int], lower_bound: int, body: Sequence[tuple[int, int]]
    ) -> None:
        """Keep a rule of weighted literals."""
        literals = tuple(literal for literal, _ in body)
        weights = tuple(weight for _, weight in body)
        self._keep(choice, head, Rule(literals, weights, lower_bound))

    def output_atom(self, symbol: clingo.Symbol, atom: int) -> None:
        """Keep which atom a symbol is."""
        self.atoms[symbol] = atom

    def _keep(self, choice: bool, head: Sequence[int], rule: Rule) -> None:
        if not choice and len(head) == 1:
            self.rules.setdefault(head[0], []).append(rule)


@dataclass(frozen=True)
class Layer:
    """Atoms that rest on each other, or one by itself; all else that they rest on stands before.

    ``denies`` says that one of them rests on the absence of another.
    """

    rules: tuple[tuple[int, tuple[Rule, ...]], ...]
    circular: bool
    denies: bool

    def settle(self, true: dict[int, int], all_scenes: int) -> int:
        """Add in which scenes the layer's atoms are true; return those in which it is not settled.

        Where atoms deny each other, it is settled what the alternating fixpoint settles (Van
        Gelder, "The alternating fixpoint of logic programs with negation", 1993).
        """
        if not self.circular:
            ((atom, rules),) = self.rules
            scenes = 0
            for rule in rules:
                scenes |= rule.holds(true, true, all_scenes)
            true[atom] = scenes
            return 0
        least = self._least(true, None, all_scenes)
        if not self.denies:
            true.update(least)
            return 0
        least = dict.fromkeys(least, 0)
        while True:
            most = self._least(true, least, all_scenes)
            more = self._least(true, most, all_scenes)
            if more == least:
                break
            least = more
        true.update(least)
        unsettled = 0
        for atom, scenes in most.items():
            unsettled |= scenes & ~least[atom]
        return unsettled

    def _least(
        self, true: Mapping[int, int], denied: Mapping[int, int] | None, all_scenes: int
    ) -> dict[int, int]:
        """What follows where each ``not`` of an atom of the layer fails in the scenes given."""
        found = dict.fromkeys((atom for atom, _ in self.rules), 0)
        here = {**{other: true[other] for other in self._below}, **found}
        fails = here if denied is None else {**here, **denied}
        changed = True
        while changed:
            changed = False
            for atom, rules in self.rules:
                scenes = here[atom]
                for rule in rules:
                    scenes |= rule.holds(here, fails, all_scenes)
                if scenes != here[atom]:
                    here[atom] = scenes
                    changed = True
        return {atom: here[atom] for atom in found}

    @property
    def _below(self) -> set[int]:
        inside = {atom for atom, _ in self.rules}
        named = {abs(lit) for _, rules in self.rules for rule in rules for lit in rule.body}
        return named - inside


def layers_of(rules: Mapping[int, Sequence[Rule]], given: Collection[int]) -> list[Layer]:
    """Return the layers of a program, each behind those that it rests on.

    ``given`` are the atoms that are settled from outside. The strongly connected components of the
    atoms are found by Tarjan's algorithm ("Depth-first search and linear graph algorithms", 1972).
    """
    rests_on = {
        atom: tuple(
            dict.fromkeys(
                other
                for rule in of_atom
                for other in map(abs, rule.body)
                if other in rules and other not in given
            )
        )
        for atom, of_atom in rules.items()
        if atom not in given
    }
    found: list[Layer] = []
    for component in _components(rests_on):
        inside = set(component)
        bodies = [rule.body for atom in component for rule in rules[atom]]
        found.append(
            Layer(
                tuple((atom, tuple(rules[atom])) for atom in component),
                circular=len(component) > 1 or component[0] in rests_on[component[0]],
                denies=any(-literal in inside for body in bodies for literal in body),
            )
        )
    return found


def _components(rests_on: Mapping[int, Sequence[int]]) -> Iterable[list[int]]:
    """Yield the strongly connected components of a graph, each behind those that it leads to."""
    number: dict[int, int] = {}
    lowest: dict[int, int] = {}
    open_atoms: list[int] = []
    is_open: set[int] = set()
    for start in rests_on:
        if start in number:
            continue
        number[start] = lowest[start] = len(number)
        open_atoms.append(start)
        is_open.add(start)
        path = [(start, iter(rests_on[start]))]
        while path:
            atom, others = path[-1]
            for other in others:
                if other not in number:
                    number[other] = lowest[other] = len(number)
                    open_atoms.append(other)
                    is_open.add(other)
                    path.append((other, iter(rests_on[other])))
                    break
                if other in is_open:
                    lowest[atom] = min(lowest[atom], number[other])
            else:
                path.pop()
                if path:
                    above = path[-1][0]
                    lowest[above] = min(lowest[above], lowest[atom])
                if lowest[atom] == number[atom]:
                    component = [open_atoms.pop()]
                    while component[-1] != atom:
                        component.append(open_atoms.pop())
                    is_open.difference_update(component)
                    yield component
