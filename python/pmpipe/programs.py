"""Where the words are, and how they are started. SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import difflib
import os
import shutil
import subprocess
from typing import Optional

from .wire import Error

_HERE = os.path.dirname(os.path.abspath(__file__))


def directory() -> Optional[str]:
    """Where the words are: PM_BIN, the programs that came with the package, those of the tree that it lies in, or those of a
    `pmpipe` on PATH; None if there are none."""
    for path in (os.environ.get("PM_BIN"), os.path.join(_HERE, "libexec"), os.path.join(_HERE, "..", "..", "bin")):
        if path and os.access(os.path.join(path, "pinit"), os.X_OK):
            return os.path.abspath(path)
    for place in os.environ.get("PATH", "").split(os.pathsep):
        command = os.path.join(place, "pmpipe")
        if os.access(command, os.X_OK) and "PMPIPE_ASKED" not in os.environ:  # it may be this package's own script
            said = subprocess.run([command, "path"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env={**os.environ, "PMPIPE_ASKED": "1"})
            if said.returncode == 0 and os.access(os.path.join(said.stdout.strip(), "pinit"), os.X_OK):
                return said.stdout.strip()
    return None


def environment() -> dict[str, str]:
    """The environment for words: PATH begins with their directory, since cycle looks there for words that it does not know."""
    path = directory()
    return {**os.environ, "PATH": os.pathsep.join(filter(None, (path, os.environ.get("PATH", os.defpath))))}


def words() -> list[str]:
    """The names of all words.

    >>> "poisson-fft" in words()
    True
    """
    path = directory()
    if path is None:
        return []
    return sorted(n for n in os.listdir(path) if n != "pmpipe" and os.access(os.path.join(path, n), os.X_OK))


def program(name: str) -> str:
    """The path of a word, or of any other program. Raises Error (code 2) if there is none, with the nearest name."""
    path = environment()["PATH"]
    found = shutil.which(name, path=path)
    if found is None:
        near = difflib.get_close_matches(name, words(), 1)
        hint = "did you mean %s?" % near[0] if near else "python -m pmpipe lists the words" if directory() else \
            "the programs of pmpipe are not here: make, or name their directory in PM_BIN"
        raise Error("no word '%s' (%s)" % (name, hint), 2)
    return found
