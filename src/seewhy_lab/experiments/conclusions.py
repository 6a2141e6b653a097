"""What the rows of an experiment say about its hypothesis: tests, and a sentence for each claim."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from seewhy_lab.experiments.catalogue import experiment
from seewhy_lab.experiments.experiment import ALL, Claim, Experiment, Row, say_size
from seewhy_lab.experiments.statistics import LEVEL, Paired, can_tell, compare, holm

__all__ = ["Compared", "Finding", "conclude", "finite", "summary", "values_of"]


@dataclass(frozen=True)
class Compared:
    """Two systems at one size, with the p-values corrected for the number of sizes (Holm)."""

    size: int
    paired: Paired
    corrected_t: float
    corrected_wilcoxon: float

    @property
    def verdict(self) -> str:
        """ "better", "worse" or "open": both tests must reach the level after correction."""
        largest = max(self.corrected_t, self.corrected_wilcoxon)
        if math.isnan(largest) or largest >= LEVEL or self.paired.difference.mean == 0.0:
            return "open"
        return "better" if self.paired.difference.mean > 0.0 else "worse"

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as values that JSON can hold."""
        return {
            **finite(asdict(self.paired)),
            **finite(
                {
                    "corrected_t": self.corrected_t,
                    "corrected_wilcoxon": self.corrected_wilcoxon,
                }
            ),
            "verdict": self.verdict,
        }


@dataclass(frozen=True)
class Finding:
    """A claim, what the trials say about it at each size, and both in a sentence.

    ``subject`` is what the claim compares, in words; ``failed`` are the sizes at which the trials
    do not bear the claim out.
    """

    claim: Claim
    subject: str
    compared: tuple[Compared, ...]
    failed: tuple[int, ...]
    text: str

    @property
    def supported(self) -> bool:
        """Whether the trials bear the claim out at every size."""
        return bool(self.compared) and not self.failed

    def to_dict(self) -> dict[str, Any]:
        """Return the finding as values that JSON can hold."""
        return {
            **asdict(self.claim),
            "supported": self.supported,
            "text": self.text,
            "sizes": [
                {"size": say_size(comparison.size), **comparison.to_dict()}
                for comparison in self.compared
            ],
        }


def finite(values: dict[str, Any]) -> dict[str, Any]:
    """Return values with None for every number that JSON has no word for.

    Examples
    --------
    >>> finite({"p": float("nan"), "interval": {"low": 0.5}})
    {'p': None, 'interval': {'low': 0.5}}
    """
    return {
        key: finite(value) if isinstance(value, dict) else _number(value)
        for key, value in values.items()
    }


def _number(value: Any) -> Any:
    """The value, or None for a number that JSON has no word for."""
    return None if isinstance(value, float) and not math.isfinite(value) else value


def values_of(rows: Sequence[Row], system: str, size: int, measure: str) -> dict[int, float]:
    """Seed → the measure of a system at a size."""
    return {
        int(row["seed"]): float(row[measure])
        for row in rows
        if row["system"] == system and row["size"] == size and row.get(measure) is not None
    }


def conclude(name: str, rows: Sequence[Row], *, domain: str) -> list[Finding]:
    """Test every claim of an experiment in a domain on its rows."""
    design = experiment(name)
    return [_finding(design, claim, rows, domain) for claim in design.claims]


def summary(findings: Sequence[Finding]) -> str:
    """Say in a sentence or two how many claims the trials bear out, and where they do not."""
    sizes = {found.size for finding in findings for found in finding.compared}
    thin = {size for finding in findings for size in _too_few(finding)}
    if sizes and thin == sizes:
        return (
            "There are too few trials for any difference to be significant after correction; the "
            "differences say where to look, and no more."
        )
    held = sum(bool(finding.compared) and thin.issuperset(finding.failed) for finding in findings)
    said = f"{held} of {len(findings)} claims hold at every size that was tried"
    said += " often enough to tell." if thin else "."
    parts = [
        f"{finding.subject} at {_say_sizes(finding, missed)}"
        for finding in findings
        if (missed := [size for size in finding.failed if size not in thin])
    ]
    if parts:
        said += f" The hypothesis is not supported for {'; '.join(parts)}."
    if thin:
        said += f" At {', '.join(map(say_size, sorted(thin)))} there are too few trials to tell."
    return said


def _say_sizes(finding: Finding, missed: Sequence[int]) -> str:
    if len(missed) == len(finding.compared) > 1:
        return "any size"
    return ", ".join(map(say_size, missed))


def _too_few(finding: Finding) -> list[int]:
    """Sizes at which no difference could be significant."""
    enough = can_tell([comparison.paired.trials for comparison in finding.compared])
    return [
        comparison.size
        for comparison, told in zip(finding.compared, enough, strict=True)
        if not told
    ]


def _finding(design: Experiment, claim: Claim, rows: Sequence[Row], domain: str) -> Finding:
    paired: dict[int, Paired] = {}
    for size in dict.fromkeys(row["size"] for row in rows):
        one = values_of(rows, claim.system, size, claim.measure)
        other = values_of(rows, claim.against, size, claim.measure)
        seeds = sorted(one.keys() & other.keys())
        if seeds:
            paired[size] = compare([one[seed] for seed in seeds], [other[seed] for seed in seeds])
    tested = holm([pair.p_t for pair in paired.values()])
    ranked = holm([pair.p_wilcoxon for pair in paired.values()])
    compared = tuple(
        Compared(size, found, p_t, p_wilcoxon)
        for (size, found), p_t, p_wilcoxon in zip(paired.items(), tested, ranked, strict=True)
    )
    failed = tuple(found.size for found in compared if not _holds(claim, found, domain))
    subject = (
        f"{design.measure(claim.measure).name}: {design.systems[claim.system]} against "
        f"{design.systems[claim.against]}"
    )
    return Finding(claim, subject, compared, failed, _sentence(subject, compared, failed))


def _holds(claim: Claim, found: Compared, domain: str) -> bool:
    """Whether the trials of one size bear a claim out."""
    if claim.at_least_equal(domain):
        return found.verdict != "worse"
    beyond = claim.significant_to != ALL and (
        found.size == ALL or found.size > claim.significant_to
    )
    if beyond:
        return found.verdict != "worse" and found.paired.difference.mean > 0.0
    return found.verdict == "better"


def _sentence(subject: str, compared: Sequence[Compared], failed: Sequence[int]) -> str:
    if not compared:
        return f"{subject}: there is no finished trial yet."
    parts = []
    for verdict, said in (
        ("better", "significantly better"),
        ("worse", "significantly worse"),
        ("open", "not told apart"),
    ):
        there = [found for found in compared if found.verdict == verdict]
        if there:
            sizes = ", ".join(say_size(found.size) for found in there)
            points = [100 * found.paired.difference.mean for found in there]
            least, most = f"{min(points):+.1f}", f"{max(points):+.1f}"
            span = least if least == most else f"{least} to {most}"
            parts.append(f"{said} at {sizes} ({span} points)")
    trials = sorted({found.paired.trials for found in compared})
    number = str(trials[0]) if len(trials) == 1 else f"{trials[0]} to {trials[-1]}"
    number += " trial" if number == "1" else " trials"
    judged = f"does not hold at {', '.join(map(say_size, failed))}" if failed else "holds"
    return f"{subject}, {number}: {'; '.join(parts)}. What is claimed {judged}."
