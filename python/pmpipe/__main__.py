"""`python -m pmpipe` lists the words, `python -m pmpipe WORD ...` runs one; all else that the command `pmpipe` does, it does too (help, doctor, path).
SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import os
import sys

from .programs import directory, environment


def main() -> int:
    """Becomes the command `pmpipe` of the programs; exit status 1 if there are none."""
    path = directory()
    if path is None:
        print("pmpipe: the programs of pmpipe are not here (make, or name their directory in PM_BIN)", file=sys.stderr)
        return 1
    os.execve(os.path.join(path, "pmpipe"), ["pmpipe"] + sys.argv[1:], environment())


if __name__ == "__main__":
    sys.exit(main())
