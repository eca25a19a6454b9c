"""A word in ten lines: a function that changes a frame, as a program in a pipe and inside cycle (docs/stage.md).
SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import argparse
import inspect
import os
import signal
import sys
import typing
from typing import Any, Callable, NoReturn, Optional

from .frame import Frame
from .stream import Writer, open as open_stream
from .wire import Error

VERSION = "0.1.0"
_COMMON = {"input": None, "output": None, "no_history": False, "version": False}


class _Parser(argparse.ArgumentParser):
    """One line per mistake, as an Error with code 2."""

    def error(self, message: str) -> NoReturn:
        raise Error("%s (--help lists the options)" % message, 2)


class Stage:
    """A function `f(frame, ...)` as a word. Called, it is the function; `main()` is the program."""

    def __init__(self, function: Callable[..., Any], name: Optional[str] = None) -> None:
        self.function, self.__doc__ = function, function.__doc__
        self.name = name or function.__name__.replace("_", "-")

    def __call__(self, frame: Frame, *args: Any, **kwargs: Any) -> Any:
        """The function, on one frame."""
        return self.function(frame, *args, **kwargs)

    def _parser(self) -> _Parser:
        p = _Parser(prog=self.name, description=inspect.getdoc(self.function), allow_abbrev=False)
        types = typing.get_type_hints(self.function)
        for one in list(inspect.signature(self.function).parameters.values())[1:]:
            kind, name = types.get(one.name, str), one.name.replace("_", "-")
            if one.default is inspect.Parameter.empty:
                p.add_argument(one.name, type=kind)
            elif kind is bool:
                p.add_argument("--" + name, dest=one.name, action="store_true")
            else:
                p.add_argument("--" + name, dest=one.name, type=kind, default=one.default, metavar=kind.__name__.upper(), help="default: %s" % one.default)
        p.add_argument("-i", "--input", metavar="FILE", help="read FILE instead of standard input")
        p.add_argument("-o", "--output", metavar="FILE", help="write FILE instead of standard output")
        p.add_argument("--no-history", action="store_true", help="add no entry to the history of the stream")
        p.add_argument("--version", action="version", version="%s (pmpipe %s)" % (self.name, VERSION))
        return p

    def _entry(self, options: dict[str, Any]) -> dict[str, Any]:
        """What the history says of it: the program and its parameters."""
        given, arguments = {}, []
        for one in list(inspect.signature(self.function).parameters.values())[1:]:
            if one.default is inspect.Parameter.empty:
                arguments.append(str(options[one.name]))
            elif options[one.name] != one.default:
                given[one.name.replace("_", "-")] = str(options[one.name])
        return {"program": self.name, "version": VERSION, "arguments": arguments, "options": given}

    def _frames(self, options: dict[str, Any], common: dict[str, Any], out: Writer) -> None:
        source = open_stream(common["input"] or sys.stdin.buffer)
        source._at_end = out.end  # at once: cycle waits for it before it closes the pipe
        entry, number = None if common["no_history"] else self._entry(options), 0
        frames = iter(source)
        while True:
            number += 1
            try:
                frame = next(frames, None)
                if frame is None:
                    return
                frame.load()
                self.function(frame, **options)
                if entry is not None and entry not in frame.history:
                    frame.history.append(entry)
                out.write(frame)
            except Error as e:
                if getattr(e, "aborted", False):
                    e.args = ("stopped by %s" % e,)
                else:
                    e.args = ("frame %d: %s" % (number, e),)
                raise
            except MemoryError:
                raise Error("frame %d: out of memory" % number) from None

    def main(self, arguments: Optional[list[str]] = None) -> NoReturn:
        """The program: reads frames, calls the function on each, writes them, flushes each before it reads the next.

        Ends the process: 0, or 1 data or system, 2 usage, 3 numerics, with one line on standard error and an abort in the stream.
        """
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
        code, out = 0, None
        try:
            given = vars(self._parser().parse_args(arguments))
            common = {k: given.pop(k) for k in list(given) if k in _COMMON}
            if not common["output"] and sys.stdout.isatty():
                raise Error("the stream is not for a terminal (-o FILE, or | diag)", 2)
            out = Writer(common["output"] or sys.stdout.buffer)
            self._frames(given, common, out)
            out.close()
        except Exception as e:
            code = e.code if isinstance(e, Error) else 1
            self._fail(e, code, out)
        sys.stdout.flush()
        os._exit(code) if code else sys.exit(0)

    def _fail(self, e: Exception, code: int, out: Optional[Writer]) -> None:
        plain = isinstance(e, (Error, OSError))
        message = "%s: %s" % (self.name, " ".join(str(e).split()) if plain else "%s: %s" % (type(e).__name__, " ".join(str(e).split())))
        if not plain:
            import traceback
            where = traceback.extract_tb(e.__traceback__)[-1]
            message += " (%s, line %s)" % (os.path.basename(where.filename), where.lineno)
        print(message, file=sys.stderr)
        aborted = str(e)[len("stopped by "):] if getattr(e, "aborted", False) else message
        try:
            target = out or Writer(sys.stdout.buffer)
            if out or not sys.stdout.isatty():
                target.abort(aborted, code)
            if out:
                out.close(False)
        except OSError:
            pass


def stage(function: Callable[..., Any]) -> Stage:
    """Makes a word of a function `f(frame, ...)` that changes the frame in place.

    Its parameters are the options: without a default an argument, with one `--name`; the annotation converts the text (float, int, str, bool).
    `word.main()` at the foot of the file makes it a program, and the head of its docstring is the help.

    >>> @stage
    ... def drag(frame, rate: float = 0.1):
    ...     frame.contributes("matter", "acc", of="v", term="drag")[...] -= rate * frame.reads("matter", "v")
    >>> import numpy as np
    >>> frame = Frame(dim=1, law="gravity")
    >>> matter = frame.add_set("matter", x=np.zeros(2), v=np.array([1.0, 2.0]))
    >>> drag(frame, rate=0.5)
    >>> matter["acc"].tolist(), matter.field("acc").meta["terms"]
    ([-0.5, -1.0], ['drag'])
    """
    return Stage(function)
