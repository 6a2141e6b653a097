"""Learn from the record of earlier runs: what is usually so at first, and what does not work."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from seewhy.errors import PlanningError
from seewhy.induction.axiom_learning import LearningOptions
from seewhy.induction.candidate import Tally
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.history import History
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.learning.attempts import attempts_of
from seewhy.planning.learning.learning_conditions import learn_conditions
from seewhy.planning.learning.learning_defaults import learn_defaults, open_cases
from seewhy.planning.learning.refutation import judged_again
from seewhy.planning.learning.validation import (
    Rejected,
    check_explained,
    validated,
    validated_by_runs,
)
from seewhy.planning.things.recorded_scene import domain_of_record

__all__ = ["LearnedFromRuns", "Rejected", "learn_from_runs"]

SUPPORT = 0.02


@dataclass(frozen=True)
class LearnedFromRuns:
    """What came of learning from earlier runs.

    Attributes
    ----------
    axioms : tuple of Axiom
        With a sentence, and the observations or attempts that they rest on.
    rejected : tuple of Rejected
    tolerances : mapping of str to float
        Fluent or action → how often what is usual may be otherwise, as the record suggests.
    runs, observations, attempts : int
        How many runs the record has, how many observations of it count for what is so at first,
        and how many attempts for what does not work.
    kept : tuple of Axiom
        What was learned before and stays, with these runs among what it rests on.
    withdrawn : tuple of Withdrawn
        What was learned before, and these runs refute.
    held_back : int
        How many runs only judged what the others say of attempts.
    judged : mapping of str to Tally
        Axiom about attempts → how the runs held back bear it out.
    """

    axioms: tuple[Axiom, ...]
    rejected: tuple[Rejected, ...]
    tolerances: Mapping[str, float]
    runs: int
    observations: int
    attempts: int
    kept: tuple[Axiom, ...] = ()
    withdrawn: tuple[Withdrawn, ...] = ()
    held_back: int = 0
    judged: Mapping[str, Tally] = field(default_factory=dict)


def learn_from_runs(
    domain: PlanningDomain,
    record: Sequence[History],
    *,
    names: Sequence[str] = (),
    support: float = SUPPORT,
    tolerance: float | None = None,
    seed: int = 0,
    learned: Sequence[Axiom] = (),
) -> LearnedFromRuns:
    """Learn what is usually so at first, and for whom it is not; and what actions do not achieve.

    Parameters
    ----------
    domain : PlanningDomain
        With the knowledge that the robot had in those runs. Of what this knowledge and
        ``history.al`` say at first nothing is learned.
    record : sequence of History
        Where the domain plans about things of pictures, each says what they are like (``statics``).
    names : sequence of str, optional
        What errors call the runs; by default "run 1" and so on.
    support : float
        The least share, of the observations or attempts that nothing explains, that an axiom
        speaks about.
    tolerance : float, optional
        How often what is usual may be otherwise; by default the record decides it, for every
        fluent and action
        (:func:`~seewhy.planning.learning.one_standard_error.suggested_tolerance`).
    seed : int
    learned : sequence of Axiom
        What was learned from other runs. What these refute is withdrawn, before more is learned.

    Notes
    -----
    What is so at first is learned by
    :func:`~seewhy.planning.learning.learning_defaults.learn_defaults`, of what is no thing of a
    picture: those are seen anew each time. What does not work is learned by
    :func:`~seewhy.planning.learning.learning_conditions.learn_conditions`.

    An axiom must be such that every recorded run can still be explained, and must leave what was
    believed at first as it was.

    Raises
    ------
    PlanningError
        If a run of the record cannot be explained by the knowledge as it is, or if no run shows
        anything that is not known at first, nor what came of an action.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.planning.domain import load_planning_domain
    >>> office = load_planning_domain("robot_assistant")
    >>> robot = office.without("loc(P, L) if work_place(P, L), not -loc(P, L).")
    >>> people, places = ("bob", "john", "sarah", "sally"), ("kitchen", "library")
    >>> seen = [f"observed loc({p}, {p}s_office) at {n}." for n, p in enumerate(people)]
    >>> seen += [f"observed -loc({p}, {place}) at 5." for p in people for place in places]
    >>> run = read_history(" ".join(seen), office.knowledge.signature)
    >>> for axiom in learn_from_runs(robot, [run] * 8).axioms:
    ...     print(axiom.text, "/", axiom, axiom.origin.support)  # doctest: +NORMALIZE_WHITESPACE
    if a person works in a place, then usually the person is in the place /
    loc(P, L) if work_place(P, L), not -loc(P, L). 32
    """
    named = list(names) or [f"run {number}" for number in range(1, len(record) + 1)]
    runs = [
        (name, domain_of_record(domain, history, name=name), history)
        for name, history in zip(named, record, strict=True)
    ]
    check_explained(runs)
    attempts = [
        attempt
        for number, (_, about, history) in enumerate(runs)
        for attempt in attempts_of(about, history, number)
    ]
    kept, withdrawn = judged_again(learned, runs, attempts)
    knowing = domain.knowing(kept)
    runs = [(name, about.knowing(kept), history) for name, about, history in runs]
    options = LearningOptions(support=support, seed=seed)
    first = diagnose(knowing.knowledge, knowing.history).states[0]
    # Things of pictures are seen at first, and are others in every run.
    cases = open_cases(knowing, record, first) if domain.at_first is None else []
    if not cases and not attempts:
        raise PlanningError(_nothing_shown(domain))
    found, tolerances = learn_defaults(knowing, cases, tolerance=tolerance, options=options)
    usual, rejected = validated(knowing, runs, first, found)
    conditions = learn_conditions(knowing, runs, attempts, tolerance=tolerance, options=options)
    possible, more = validated_by_runs(runs, usual, conditions.axioms)
    return LearnedFromRuns(
        axioms=tuple(
            replace(axiom, identifier=f"l{number}")
            for number, axiom in enumerate([*usual, *possible], start=len(kept) + 1)
        ),
        rejected=(*rejected, *conditions.rejected, *more),
        tolerances={**tolerances, **conditions.tolerances},
        runs=len(record),
        observations=len(cases),
        attempts=len(attempts),
        kept=tuple(kept),
        withdrawn=tuple(withdrawn),
        held_back=conditions.held_back,
        judged=conditions.judged,
    )


def _nothing_shown(domain: PlanningDomain) -> str:
    if domain.at_first is not None:
        return (
            "the record shows nothing of what came of an action that the knowledge holds possible, "
            "so nothing is to be learned from it; record runs in which something is done and then "
            "seen"
        )
    return (
        "the record shows nothing of which the knowledge leaves open how it is at first, so "
        "nothing is to be learned from it; leave out what shall be learned (--without AXIOM), "
        "or record runs in which more is seen"
    )
