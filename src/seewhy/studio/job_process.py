"""The process of a job: runs a command in a session of its own and keeps how it ended in a file.

``python -m seewhy.studio.job_process FOLDER COMMAND…`` writes ``FOLDER/log`` (what was complained
and remarked), ``FOLDER/output``, and at the end ``FOLDER/code``. Whoever started it may be gone by
then.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path
from types import FrameType

from seewhy.files.whole_files import write_whole

__all__ = ["CODE", "LOG", "OUTPUT", "run_command"]

CODE, LOG, OUTPUT = "code", "log", "output"


def run_command(folder: Path, command: list[str]) -> int:
    """Run a command to its end and return its code; signals to the session reach it alone."""

    def wait_on(_number: int, _frame: FrameType | None) -> None:
        """The command ends by itself when it is interrupted; then its code is to be kept."""

    # A handler of our own, not SIG_IGN: the command must not inherit that signals are ignored.
    signal.signal(signal.SIGINT, wait_on)
    signal.signal(signal.SIGTERM, wait_on)
    with (folder / LOG).open("ab") as log, (folder / OUTPUT).open("wb") as output:
        code = subprocess.run(
            command, stdin=subprocess.DEVNULL, stdout=output, stderr=log, check=False
        ).returncode
    write_whole(folder / CODE, f"{code}\n")
    return code


if __name__ == "__main__":
    sys.exit(max(0, run_command(Path(sys.argv[1]), sys.argv[2:])))
