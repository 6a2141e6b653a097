"""Answers that are spoken: by pyttsx3 or espeak-ng, where one of them is there."""

from __future__ import annotations

import importlib
import importlib.util
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

from seewhy.errors import SpeechError

__all__ = ["Voice", "find_voice"]

Voice = Callable[[str], None]
"""Speaks a text, and returns when it is spoken."""

_PROGRAMS = ("espeak-ng", "espeak")


def find_voice(file: Path | None = None) -> Voice:
    """Return what speaks: aloud, or into a WAV file.

    Parameters
    ----------
    file : Path, optional
        A file to write instead of speaking aloud; what was there is replaced.

    Raises
    ------
    SpeechError
        If nothing that speaks is installed, if the file's name does not end in .wav, or, from the
        voice, if it fails.
    """
    if file is not None and file.suffix.lower() != ".wav":
        raise SpeechError(f"{file}: speech is written as WAV; give a name that ends in .wav")
    program = next((found for name in _PROGRAMS if (found := shutil.which(name))), None)
    if program is not None:
        return lambda text: _by_program(program, text, file)
    if importlib.util.find_spec("pyttsx3") is not None:
        return lambda text: _by_library(text, file)
    raise SpeechError(
        "nothing that speaks is installed; install espeak-ng ('apt install espeak-ng') or pyttsx3 "
        "('pip install pyttsx3')"
    )


def _by_program(program: str, text: str, file: Path | None) -> None:
    command = [program, "--stdin", *(["-w", str(file.absolute())] if file else [])]
    # The text goes by standard input: an answer that begins with "-" is no option.
    done = subprocess.run(command, input=text, text=True, capture_output=True, check=False)
    if done.returncode:
        said = " ".join(done.stderr.split()) or f"exit status {done.returncode}"
        raise SpeechError(f"{Path(program).name} could not speak: {said}")


def _by_library(text: str, file: Path | None) -> None:
    pyttsx3: Any = importlib.import_module("pyttsx3")
    try:
        engine = pyttsx3.init()
        if file is None:
            engine.say(text)
        else:
            engine.save_to_file(text, str(file))
        engine.runAndWait()
    except Exception as problem:  # its drivers raise whatever their system does
        raise SpeechError(f"pyttsx3 could not speak: {' '.join(str(problem).split())}") from None
