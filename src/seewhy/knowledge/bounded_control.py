"""clingo's control, whose every call ends: by an answer, by a bound, or by Ctrl-C.

clingo cannot be stopped while it grounds. What may grow large is grounded in a process of its own
first, which has a bound of time and memory and can be ended; only what ends there is grounded here.
Searching is given a few thousand conflicts; what needs more goes on in a thread that is waited
for, so that bounds and Ctrl-C are heard.
"""

from __future__ import annotations

import math
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

import clingo

from seewhy.errors import ReasoningError
from seewhy.knowledge import ground_process
from seewhy.knowledge.abandoned import abandon
from seewhy.knowledge.deferred_interrupt import DeferredInterrupt
from seewhy.knowledge.ground_process import Request
from seewhy.knowledge.grounding_size import GroundingSize

__all__ = ["SOLVING_SECONDS", "BoundedControl", "OutOfTimeError", "out_of_time"]

SMALL = 500_000
"""So many instances are grounded within about a second, and need no process of their own."""
MOST_ATOMS = 2_000_000
"""The atoms that a program may have."""
GROUNDING_SECONDS = 30.0
SOLVING_SECONDS = 120.0
MEMORY = 4 * 2**30
"""The bytes that grounding may take, and by which the process may grow in one search."""

_CONFLICTS = 5_000
"""What a search may take before it goes on in a thread: a tenth of a second."""
_OUT_OF_TIME = 24  # the signal of a process that took longer than it may
_HEARD = 0.05  # seconds between two looks at the clock
_GRACE = 0.5  # seconds for a search to end that was told to
_SOON = 0.5  # seconds for a search before it goes on in a thread
_SOONER = 0.02  # seconds in which no search comes to so many conflicts
_REMEDY = "give its sorts fewer members, or write it with fewer variables"

_Result = TypeVar("_Result")
_Read = TypeVar("_Read")


@dataclass(frozen=True)
class _Search(Generic[_Read]):
    """What a search found, whether all was looked through, and how long it took.

    ``cut`` says that it was ended by the clock, before the model that came next.
    """

    found: list[_Read]
    ended: bool
    interrupted: bool
    seconds: float
    cut: bool = False


class OutOfTimeError(ReasoningError):
    """A call of clingo took longer than it may."""


def out_of_time(size: GroundingSize, what: str, seconds: float) -> OutOfTimeError:
    """Return the error of what took longer than it may."""
    return OutOfTimeError(f"{size.largest}; {what} took longer than {seconds:.0f} s; {_REMEDY}")


class BoundedControl:
    """A program grounded by clingo, for one thread at a time; others wait.

    Parameters
    ----------
    program : str
    size : GroundingSize
        What the program may come to, of what it grows with.
    arguments : sequence of str
        Options for clingo.
    parts : sequence of (str, list of clingo.Symbol)
        What is grounded at first.
    observer : clingo.Observer, optional
        Is told the ground program, which is not solved then.

    Raises
    ------
    ReasoningError
        If grounding or a search takes longer, or more memory, than it may.

    Examples
    --------
    >>> control = BoundedControl("1 { a; b } 1. :- a.", size=GroundingSize())
    >>> control.models()
    [[Function('b', [], True)]]
    """

    def __init__(
        self,
        program: str,
        *,
        size: GroundingSize,
        arguments: Sequence[str] = (),
        parts: Sequence[tuple[str, Sequence[clingo.Symbol]]] = (("base", ()),),
        observer: clingo.Observer | None = None,
    ) -> None:
        self.size = size
        self.lock = threading.RLock()
        self._abandoned: threading.Thread | None = None
        self._conflicts = ""
        self._control = clingo.Control(["--warn=none", *arguments], logger=lambda *_: None)
        if observer is not None:
            self._control.register_observer(observer, replace=True)
        self._control.add("base", [], program)
        if size.instances > SMALL:
            _try_out(program, arguments, parts, size)
        self.ground(parts)

    @property
    def atoms(self) -> clingo.SymbolicAtoms:
        """The atoms of the ground program."""
        return self._control.symbolic_atoms

    @property
    def configuration(self) -> Any:
        """How searches are done; to be set and used under :attr:`lock`."""
        return self._control.configuration.solve

    def by_signature(self, name: str, arity: int) -> Iterator[clingo.SymbolicAtom]:
        """Return the atoms of a predicate."""
        return self._control.symbolic_atoms.by_signature(name, arity)

    def add(self, part: str, program: str) -> None:
        """Add rules, as a part of the program that has no parameters, and ground them."""
        with self.lock:
            self._control.add(part, [], program)
            self.ground([(part, ())])

    def ground(self, parts: Sequence[tuple[str, Sequence[clingo.Symbol]]]) -> None:
        """Ground parts of the program."""
        given = [(name, list(parameters)) for name, parameters in parts]
        with self.lock:
            if self.size.instances <= SMALL:
                self._checked(lambda: self._control.ground(given))
            else:
                self._watched(
                    lambda: self._control.ground(given), seconds=GROUNDING_SECONDS, what="grounding"
                )

    def assign_external(self, atom: clingo.Symbol, truth: bool | None) -> None:
        """Set an external atom, or release it for good with None."""
        with self.lock:
            if truth is None:
                self._control.release_external(atom)
            else:
                self._control.assign_external(atom, truth)

    def solve(
        self,
        assumptions: Iterable[tuple[clingo.Symbol, bool] | int] = (),
        *,
        on_model: Callable[[clingo.Model], _Read],
        last_only: bool = False,
        seconds: float | None = None,
    ) -> list[_Read]:
        """Return what ``on_model`` returns of each model, in the order in which they are found.

        With ``last_only`` it is asked of the last one alone: reading a model takes longer than
        finding the next, of a hundred on the way to the best one.

        Raises
        ------
        OutOfTimeError
            If the search takes longer than ``seconds``.
        """
        given = list(assumptions)
        with self.lock:
            if self.size.instances <= SMALL:
                self._limit(str(_CONFLICTS))
                with DeferredInterrupt():
                    search = self._checked(
                        lambda: self._search(given, on_model, last_only=last_only, seconds=_SOON)
                    )
                if search.ended or not self._limited(search):
                    return search.found
            self._limit("umax")
            for _ in range(2):
                search = self._watched(
                    lambda: self._search(given, on_model, last_only=last_only),
                    seconds=SOLVING_SECONDS if seconds is None else seconds,
                    what="the search for answer sets",
                )
                if not search.interrupted:
                    break
                # An interruption that was meant for the call before; it is heard once.
        return search.found

    def satisfiable(self, assumptions: Iterable[tuple[clingo.Symbol, bool] | int] = ()) -> bool:
        """Whether there is an answer set."""
        return bool(self.solve(assumptions, on_model=lambda _: True))

    def models(self) -> list[list[clingo.Symbol]]:
        """Return what each answer set shows."""
        return self.solve(on_model=_shown)

    def last_model(self) -> list[clingo.Symbol] | None:
        """Return what the last model shows: the best one, or what all have in common.

        None where there is no answer set.

        Examples
        --------
        >>> control = BoundedControl("1 { a; b } 1. :~ a. [1]", size=GroundingSize())
        >>> [str(symbol) for symbol in control.last_model()]
        ['b']
        """
        found = self.solve(on_model=_shown, last_only=True)
        return found[-1] if found else None

    def _search(
        self,
        assumptions: Sequence[tuple[clingo.Symbol, bool] | int],
        on_model: Callable[[clingo.Model], _Read],
        *,
        last_only: bool = False,
        seconds: float = math.inf,
    ) -> _Search[_Read]:
        """Search, for a time that is looked at between two models."""
        begun = time.perf_counter()
        found: list[_Read] = []
        with self._control.solve(assumptions, yield_=True) as solving:
            for number, model in enumerate(solving):
                # One that is found late is found: where no other is asked for, it would be another
                # that a search anew finds.
                if number and time.perf_counter() - begun >= seconds:
                    return _Search(found, ended=False, interrupted=False, seconds=seconds, cut=True)
                if not last_only:
                    found.append(on_model(model))
            result = solving.get()
            if last_only and (last := solving.last()) is not None:
                found.append(on_model(last))
        return _Search(
            found,
            ended=bool(result.exhausted),
            interrupted=bool(result.interrupted),
            seconds=time.perf_counter() - begun,
        )

    def _limit(self, conflicts: str) -> None:
        if conflicts != self._conflicts:
            self.configuration.solve_limit = self._conflicts = conflicts

    def _limited(self, search: _Search[Any]) -> bool:
        """Whether a search may have been cut short: it took its time, or all its conflicts."""
        if search.interrupted or search.cut or not search.found:
            return True
        if search.seconds < _SOONER:
            return False
        conflicts: float = self._control.statistics["solving"]["solvers"]["conflicts"]
        return conflicts >= _CONFLICTS

    def _checked(self, work: Callable[[], _Result]) -> _Result:
        if self._abandoned is not None and self._abandoned.is_alive():
            raise ReasoningError(
                f"{self.size.largest}; clingo has not yet ended a call that was given up; go on "
                "with knowledge that is read anew"
            )
        return work()

    def _watched(self, work: Callable[[], _Result], *, seconds: float, what: str) -> _Result:
        """Do it in a thread, so that this one hears Ctrl-C and the clock."""
        outcome: list[_Result | BaseException] = []
        done = threading.Event()

        def run() -> None:
            try:
                outcome.append(work())
            except BaseException as problem:  # it is raised again by who waits
                outcome.append(problem)
            finally:
                done.set()

        thread = threading.Thread(target=run, daemon=True)
        until = time.perf_counter() + seconds
        memory = _resident()
        self._checked(thread.start)
        try:
            while not done.wait(_HEARD):
                if time.perf_counter() >= until:
                    raise out_of_time(self.size, what, seconds)
                if _resident() - memory > MEMORY:
                    raise ReasoningError(
                        f"{self.size.largest}; {what} took more than "
                        f"{MEMORY / 2**30:.2g} GiB of memory; {_REMEDY}"
                    )
        finally:
            if not done.is_set():
                self._control.interrupt()
                if not done.wait(_GRACE):
                    self._abandoned = thread
                    abandon(thread)
        (result,) = outcome
        if isinstance(result, BaseException):
            raise result
        return result


def _try_out(
    program: str,
    arguments: Sequence[str],
    parts: Sequence[tuple[str, Sequence[clingo.Symbol]]],
    size: GroundingSize,
) -> None:
    """Ground in a process of its own, which is ended where it takes too long."""
    request = Request(
        arguments=list(arguments),
        program=program,
        parts=[(name, [number.number for number in numbers]) for name, numbers in parts],
        memory=MEMORY,
        seconds=int(GROUNDING_SECONDS),
        atoms=MOST_ATOMS,
    )
    source = Path(__file__).parents[2]
    paths = [str(source), *filter(None, [os.environ.get("PYTHONPATH")])]
    process = subprocess.Popen(
        [sys.executable, "-m", ground_process.__name__],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
    )
    try:
        process.communicate(request.to_json().encode(), timeout=GROUNDING_SECONDS)
        code = process.returncode
    except subprocess.TimeoutExpired:
        code = None
    finally:
        process.kill()
        process.wait()
    if code == ground_process.TOO_MANY_ATOMS:
        took = f"it comes to more than {MOST_ATOMS:,} atoms"
    elif code is None or code == -_OUT_OF_TIME:
        took = f"grounding took longer than {GROUNDING_SECONDS:.0f} s"
    elif code == ground_process.OUT_OF_MEMORY or code < 0:
        took = f"grounding took more than {MEMORY / 2**30:.2g} GiB of memory"
    else:
        return  # done; or no process can be started here, and the clock alone bounds it
    raise ReasoningError(f"{size.largest}; {took}; {_REMEDY}")


def _shown(model: clingo.Model) -> list[clingo.Symbol]:
    return list(model.symbols(shown=True))


def _resident() -> int:
    """The bytes of memory that this process has; 0 where the system does not say so."""
    try:
        pages = Path("/proc/self/statm").read_text(encoding="ascii").split()[1]
    except OSError:
        return 0
    return int(pages) * os.sysconf("SC_PAGE_SIZE")
