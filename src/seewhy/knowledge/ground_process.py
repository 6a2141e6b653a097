"""A process of its own that grounds a program, to see that it ends: it can be ended, clingo not.

Reads a :class:`Request` as JSON from standard input, says nothing, and ends with 0 where the
program was grounded within its bounds.
"""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from dataclasses import asdict, dataclass

import clingo

OUT_OF_MEMORY = 3
TOO_MANY_ATOMS = 4


@dataclass(frozen=True)
class Request:
    """What is to be grounded: options, the program, its parts with numbers, and the bounds."""

    arguments: list[str]
    program: str
    parts: list[tuple[str, list[int]]]
    memory: int
    seconds: int
    atoms: int

    def to_json(self) -> str:
        """Return the request as the process reads it."""
        return json.dumps(asdict(self))


def main() -> int:
    """Ground what standard input asks for."""
    asked = Request(**json.load(sys.stdin))
    _limit(memory=asked.memory, seconds=asked.seconds)
    try:
        control = clingo.Control(["--warn=none", *asked.arguments], logger=lambda *_: None)
        control.add("base", [], asked.program)
        control.ground(
            [(name, [clingo.Number(number) for number in numbers]) for name, numbers in asked.parts]
        )
    except (MemoryError, RuntimeError):
        # The program can be read: what fails is memory.
        return OUT_OF_MEMORY
    return TOO_MANY_ATOMS if len(control.symbolic_atoms) > asked.atoms else 0


def _limit(*, memory: int, seconds: int) -> None:
    with suppress(ImportError):  # elsewhere than on Unix, the parent's clock alone bounds it
        import resource

        with suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        with suppress(ValueError, OSError):
            # Should the parent be gone, nobody else ends it.
            resource.setrlimit(resource.RLIMIT_CPU, (seconds + 1, seconds + 2))


if __name__ == "__main__":
    sys.exit(main())
