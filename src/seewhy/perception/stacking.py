"""How much each of several ways of seeing a feature counts, by what each makes of unseen ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["MOST", "Stack", "fit_stack", "log_probabilities", "stacked"]

Table = npt.NDArray[np.float64]

FLOOR = 1e-4
"""No way of seeing excludes a value altogether: one that never met it would overrule the others."""

FEW = 10
"""With fewer unseen pictures than this, nothing is fitted to them."""

MOST = 20.0
"""The largest weight of a way of seeing."""

_EVIDENCE = 5.0
"""Nats by which others must explain unseen pictures better than the preferred way of seeing: the
few that are held out favour one way or the other by as much as three, by chance."""


@dataclass(frozen=True)
class Stack:
    """What a feature is seen by.

    Probabilities of ways of seeing are multiplied, each to the power of its weight.

    Attributes
    ----------
    weights : dict of str to float
        Way of seeing → weight; 0 for those that are not asked.
    accuracies : dict of str to float
        Way of seeing → share of the unseen pictures read rightly; that of all together under
        "together" where they are.
    pictures : int
        Unseen pictures by which they were judged.
    """

    weights: dict[str, float]
    accuracies: dict[str, float]
    pictures: int

    @property
    def asked(self) -> tuple[str, ...]:
        """The ways of seeing that count."""
        return tuple(name for name, weight in self.weights.items() if weight > 0)

    @property
    def accuracy(self) -> float | None:
        """Of what counts, on unseen pictures; None where there were none."""
        key = "together" if len(self.asked) > 1 else self.asked[0]
        return self.accuracies.get(key)


def log_probabilities(logits: npt.NDArray[np.floating]) -> Table:
    """Logits of shape (n, values) → logarithms of probabilities, none below :data:`FLOOR`."""
    shifted = logits.astype(np.float64)
    shifted = shifted - shifted.max(axis=1, keepdims=True)
    probabilities = np.exp(shifted)
    probabilities /= probabilities.sum(axis=1, keepdims=True)
    found: Table = np.log(np.maximum(probabilities, FLOOR))
    return found


def stacked(tables: Mapping[str, Table], weights: Mapping[str, float]) -> Table:
    """Probabilities, shape (n, values), of several ways of seeing together.

    Parameters
    ----------
    tables : mapping of str to ndarray, shape (n, values)
        Logarithms of probabilities; see :func:`log_probabilities`.
    weights : mapping of str to float
    """
    summed = sum(
        (weight * tables[name] for name, weight in weights.items() if weight > 0),
        start=np.zeros_like(next(iter(tables.values()))),
    )
    raised = np.exp(summed - summed.max(axis=1, keepdims=True))
    found: Table = raised / raised.sum(axis=1, keepdims=True)
    return found


def fit_stack(
    tables: Mapping[str, Table],
    targets: npt.NDArray[np.int64],
    *,
    preferred: str,
    clearly: bool = True,
) -> Stack:
    """Weigh ways of seeing so that the values of unseen pictures are most likely.

    The preferred way alone is asked, unless another, or all together, makes the values clearly
    more likely, by more than :data:`_EVIDENCE` and what the further weights would by chance
    (Akaike's criterion). Its weight calibrates it, as a temperature does. Targets are softened by
    one supposed mistake (Platt 1999).

    Parameters
    ----------
    tables : mapping of str to ndarray, shape (n, values)
        Way of seeing → logarithms of its probabilities.
    targets : ndarray of int, shape (n,)
        The index of each picture's value.
    preferred : str
        The way of seeing that is asked where pictures do not clearly tell.
    clearly : bool, default True
        Whether another way alone has to be clearly better to be asked instead; all together
        always have to.

    Examples
    --------
    >>> sure, unsure = np.log([[0.99, 0.01]] * 20), np.log([[0.5, 0.5]] * 20)
    >>> fit_stack({"a": sure, "b": unsure}, np.zeros(20, dtype=int), preferred="b").asked
    ('a',)
    """
    from scipy.optimize import minimize

    count, values = next(iter(tables.values())).shape
    accuracies = {
        name: float((table.argmax(axis=1) == targets).mean())
        for name, table in tables.items()
        if count
    }
    if count < FEW or values < 2:
        weights = {name: float(name == preferred) for name in tables}
        return Stack(weights, accuracies, count)
    soft = np.full((count, values), 1.0 / (count + 2.0) / (values - 1))
    soft[np.arange(count), targets] = 1.0 - 1.0 / (count + 2.0)

    def fitted(names: tuple[str, ...]) -> tuple[float, dict[str, float]]:
        stack = np.stack([tables[name] for name in names])

        def loss(weights: Table) -> tuple[float, Table]:
            summed = np.tensordot(weights, stack, axes=1)
            summed -= summed.max(axis=1, keepdims=True)
            normal = np.log(np.exp(summed).sum(axis=1, keepdims=True))
            logs = summed - normal
            slope = np.einsum("nv,mnv->m", np.exp(logs) - soft, stack)
            return float(-(soft * logs).sum()), slope

        start = np.full(len(names), 1.0 / len(names))
        bounds = [(0.0, MOST)] * len(names)
        result = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=bounds)
        chosen = {name: float(x) for name, x in zip(names, result.x, strict=True)}
        as_good = names == (preferred,) or (len(names) == 1 and not clearly)
        evidence = 0.0 if as_good else _EVIDENCE
        return float(result.fun) + len(names) + evidence, chosen

    ranked = sorted(
        (fitted(names) for names in [*((name,) for name in tables), tuple(tables)]),
        key=lambda pair: pair[0],
    )
    _, best = ranked[0]
    weights = {name: round(best.get(name, 0.0), 4) for name in tables}
    if not any(weights.values()):
        weights[preferred] = 0.05  # nothing tells: nearly even, and not nothing at all
    if sum(weight > 0 for weight in weights.values()) > 1:
        together = stacked(tables, weights)
        accuracies["together"] = float((together.argmax(axis=1) == targets).mean())
    return Stack(weights, accuracies, count)
