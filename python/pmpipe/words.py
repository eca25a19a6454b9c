"""Runs sentences: words joined by pipes, without a shell. SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import builtins
import os
import shlex
import subprocess
import sys
import tempfile
import threading
from typing import Any, BinaryIO, Iterable, Optional, Union

from .frame import Frame
from .programs import environment, program
from .stream import Stream, Writer, of_bytes, of_file
from .wire import Error

Input = Union[None, str, "os.PathLike[str]", bytes, Frame, Iterable[Frame]]


def split(sentence: str) -> list[list[str]]:
    """The words of a sentence with their arguments, quotes read as the shell does.

    >>> split("pinit two-body | cycle -n 2 'pp | push euler'")
    [['pinit', 'two-body'], ['cycle', '-n', '2', 'pp | push euler']]
    """
    lexer = shlex.shlex(sentence, posix=True, punctuation_chars="|")
    lexer.whitespace_split, lexer.commenters = True, "#"
    out: list[list[str]] = [[]]
    try:
        for token in lexer:
            if token in ("<", ">", ">>", "&", "&&", "||", ";"):
                raise Error("'%s' in the sentence: words and | alone, since no shell runs it (input= gives it a file)" % token, 2)
            if token == "|":
                out.append([])
            else:
                out[-1].append(token)
    except ValueError as e:
        raise Error("the sentence cannot be read: %s" % e, 2) from None
    if not all(out):
        raise Error("the sentence has a | without a word", 2)
    return out


class _Feeder(threading.Thread):
    """Writes frames or bytes into a pipe while the programs run."""

    def __init__(self, file: BinaryIO, what: Any) -> None:
        super().__init__(daemon=True)
        self.file, self.what, self.error = file, what, None  # type: ignore[var-annotated]
        self.start()

    def run(self) -> None:
        try:
            with self.file:
                if isinstance(self.what, (bytes, bytearray, memoryview)):
                    self.file.write(self.what)
                    return
                with Writer(self.file) as out:
                    for frame in [self.what] if isinstance(self.what, Frame) else self.what:
                        out.write(frame)
        except BrokenPipeError:
            pass
        except BaseException as e:
            self.error = e


def _said(errors: list[BinaryIO]) -> list[list[str]]:
    out = []
    for e in errors:
        e.seek(0)
        out.append(e.read().decode("utf-8", "replace").strip().splitlines())
    return out


def _result(codes: list[int], said: list[list[str]], commands: list[list[str]]) -> None:
    """Raises the first failure of a sentence that is not the closed pipe of another; prints what words said that did not fail."""
    bad = [i for i, c in enumerate(codes) if c not in (0, 141, -13)] or [i for i, c in enumerate(codes[-1:], len(codes) - 1) if c]
    if bad:
        i = bad[0]
        message = said[i][-1] if said[i] else "%s ended with exit status %d and no message" % (commands[i][0], codes[i])
        raise Error(message, codes[i] if codes[i] in (1, 2, 3) else 1)
    for lines in said:
        for line in lines:
            print(line, file=sys.stderr)


def _run(sentence: str, input: Input, threads: Optional[int]) -> BinaryIO:
    """Runs the programs to their end; what the last one wrote, in a file without a name."""
    commands, env = split(sentence), environment()
    if threads is not None:
        env["OMP_NUM_THREADS"] = str(threads)
    if isinstance(input, (str, os.PathLike)):
        path = os.fspath(input)
        with builtins.open(path, "rb") as file:
            hdf5 = file.read(8) == b"\x89HDF\r\n\x1a\n"
        if hdf5:
            commands.insert(0, ["sh5", "--", path])
    programs = [program(c[0]) for c in commands]
    errors: list[BinaryIO] = [tempfile.TemporaryFile() for _ in commands]  # type: ignore[misc]
    out: BinaryIO = tempfile.TemporaryFile()  # type: ignore[assignment]
    running: list[subprocess.Popen[bytes]] = []
    feed = not (input is None or isinstance(input, (str, os.PathLike)))
    first: Any = subprocess.PIPE if feed else builtins.open(path, "rb") if isinstance(input, (str, os.PathLike)) else subprocess.DEVNULL
    feeder = None
    try:
        before: Any = first
        for i, (command, at) in enumerate(zip(commands, programs)):
            last = i == len(commands) - 1
            running.append(subprocess.Popen([command[0]] + command[1:], executable=at, stdin=before, stdout=out if last else subprocess.PIPE,
                                            stderr=errors[i], env=env))
            if hasattr(before, "close"):
                before.close()
            before = running[-1].stdout
        if feed:
            feeder = _Feeder(running[0].stdin, input)  # type: ignore[arg-type]
        codes = [p.wait() for p in running]
    finally:
        for p in running:
            if p.poll() is None:
                p.kill()
                p.wait()
    if feeder:
        feeder.join()
        if feeder.error and not isinstance(feeder.error, OSError):
            raise feeder.error
    _result(codes, _said(errors), commands)
    out.seek(0)
    return out


def run(sentence: str, input: Input = None, threads: Optional[int] = None) -> Stream:
    """Runs a sentence and returns the frames of its output, which lie in a temporary file until they are asked for.

    input: a file (a stream or HDF5), a frame, several frames, a Stream, or bytes; threads: per word. Raises Error with the message and the exit
    status of the word that failed first (1 data or system, 2 usage, 3 numerics). Notices of the words go to standard error.

    >>> frames = run("pinit two-body | cycle -n 2 --every 1 'push kick/2 drift | pp | push kick/2'")
    >>> [frame.step for frame in frames], frames[-1]["matter"]["x"].shape
    ([0, 1, 2], (2, 3))
    >>> run("pinit two-body | push kick")
    Traceback (most recent call last):
    pmpipe.Error: push: frame 1: no field 'acc' on 'matter' (compute it first: p2m | poisson-fft | mgrad | m2p, or pp)
    """
    out = _run(sentence, input, threads)
    begin = out.read(7)
    out.seek(0)
    if begin and begin != b"PMPIPE/":
        raise Error("the sentence ends in text, not in a stream (use pmpipe.text or pmpipe.table)", 2)
    return of_file(out) if begin else of_bytes(b"PMPIPE/1 end 0".ljust(63) + b"\n")


def text(sentence: str, input: Input = None, threads: Optional[int] = None) -> str:
    """Runs a sentence and returns what its last word prints (diag, sls, stab, scmp).

    >>> text("diag --columns step,mass", Frame(dim=1)).split()[:2]
    ['step', 'mass']
    """
    return _run(sentence, input, threads).read().decode()


def table_of(printed: str) -> Any:
    """The columns of a table with one row of names, separated by tabs; lines that begin with # are left out.

    A pandas.DataFrame, or without pandas a dict of arrays by column. Numbers are float (int where all are), anything else text.

    >>> list(table_of("step\\tenergy\\n0\\t-0.5\\n1\\t-0.25\\n")["energy"])
    [-0.5, -0.25]
    """
    import numpy as np
    lines = [line.split("\t") for line in printed.splitlines() if line and not line.startswith("#")]
    names, rows = (lines[0], lines[1:]) if lines else ([], [])
    columns: dict[str, Any] = {}
    for i, name in enumerate(names):
        values: Any = [row[i] if i < len(row) else "" for row in rows]
        for kind in (np.int64, np.float64):
            try:
                values = np.array(values, kind)
                break
            except (ValueError, OverflowError):
                continue
        columns[name] = np.asarray(values)
    try:
        import pandas
    except ImportError:
        return columns
    return pandas.DataFrame(columns)


def table(sentence: str, input: Input = None, threads: Optional[int] = None) -> Any:
    """Runs a sentence that ends in a table (diag, scmp) and returns its columns: see table_of.

    >>> energy = table("pinit two-body | diag")["energy_kinetic"]
    >>> len(energy)
    1
    """
    return table_of(text(sentence, input, threads))


def diag(frames: Input, *options: str) -> Any:
    """What diag measures of frames or of a file, a row per frame; options as typed: `diag(frames, "--columns", "time,energy")`."""
    return table(" ".join(["diag"] + [shlex.quote(o) for o in options]), frames)
