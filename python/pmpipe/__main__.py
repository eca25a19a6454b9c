"""`python -m pmpipe` lists the words; `python -m pmpipe WORD ...` runs one, `python -m pmpipe path` prints their directory.
 SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import os
import signal
import subprocess
import sys

from .wire import Error
from .words import directory, environment, program, words


def main() -> int:
    """Exit status 0, or that of the word; 2 if there is no such word."""
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    try:
        if sys.argv[1:] == ["path"]:
            print(directory() or "")
            return 0 if directory() else 1
        if len(sys.argv) > 1:
            path = program(sys.argv[1])
            os.execve(path, sys.argv[1:], environment())
        if directory() is None:
            raise Error("the programs of pmpipe are not here: make, or name their directory in PM_BIN", 1)
        for word in words():
            print(subprocess.run([program(word), "--help"], capture_output=True, text=True).stdout.partition("\n")[0] or word)
    except (Error, OSError) as e:
        print("pmpipe: %s" % e, file=sys.stderr)
        return e.code if isinstance(e, Error) else 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
