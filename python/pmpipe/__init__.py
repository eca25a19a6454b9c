"""pmpipe for Python: read and write streams, run sentences, write words.

    import pmpipe
    frames = pmpipe.run("pinit plummer -n 1000 | cycle -n 10 --every 5 'push kick/2 drift | pp | push kick/2'")
    frames[-1]["matter"]["x"]                 # (1000, 3)
    pmpipe.write("run.pm", frames)
    for frame in pmpipe.open("run.pm"):       # mapped: data are read, and checked, where they are touched
        print(frame.time, frame["matter"]["v"].std())

docs/python.md shows more. Units are those of the frame: G = 1 and the like; an array of n particles is (n,) or (n, components), of a mesh (nx, ny, nz) or
(nx, ny, nz, components). Everything that fails raises `Error`, with one line and the exit status of a program. SPDX-License-Identifier: GPL-3.0-or-later
"""
from .checksum import crc32c
from .frame import Field, Frame, Mesh, Owner, Set
from .stage import VERSION as __version__
from .stage import Stage, stage
from .stream import Stream, Writer, create, of_bytes, open, write
from .wire import Error
from .words import diag, run, table, table_of, text
from .programs import directory, words  # the last, since the module words has that name too

__all__ = ["Error", "Field", "Frame", "Mesh", "Owner", "Set", "Stage", "Stream", "Writer", "crc32c", "create", "diag", "directory", "of_bytes", "open", "run",
           "stage", "table", "table_of", "text", "words", "write", "__version__"]
