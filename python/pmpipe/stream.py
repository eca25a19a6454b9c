"""Streams: read without loading them, and written. SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import builtins
import mmap
import os
import subprocess
import tempfile
import weakref
from typing import Any, BinaryIO, Callable, Iterable, Iterator, Optional, Union, overload

import numpy as np

from . import header as _header
from .checksum import crc32c
from .frame import Field, Frame, payload_size
from .programs import environment, program
from .wire import LINE, Error, Line, block_make, block_size, canonical, json_parse, line_check, line_make, line_parse, padded

PIECE = 1 << 24
Source = Union[str, "os.PathLike[str]", BinaryIO]


def _cut(where: str) -> Error:
    return Error("the input ends in %s: it was cut (run the whole pipeline again)" % where)


class _Mapped:
    """A file in memory: what is taken is a view of it."""

    def __init__(self, view: memoryview) -> None:
        self.view, self.at = view, 0

    def take(self, size: int, where: str) -> memoryview:
        if size > len(self.view) - self.at:
            raise _cut(where)
        self.at += size
        return self.view[self.at - size:self.at]

    def empty(self) -> bool:
        return self.at == len(self.view)


class _Piped:
    """A pipe: what is taken is read, in pieces, so that a header that lies about sizes takes no memory."""

    def __init__(self, file: BinaryIO) -> None:
        self.file, self.ahead = file, b""

    def take(self, size: int, where: str) -> memoryview:
        out, self.ahead = bytearray(self.ahead[:size]), self.ahead[size:]
        while len(out) < size:
            piece = self.file.read(min(size - len(out), PIECE))
            if not piece:
                raise _cut(where)
            out += piece
        return memoryview(out)

    def empty(self) -> bool:
        if not self.ahead:
            self.ahead = self.file.read(1)
        return not self.ahead


class _Payload:
    """Data and tail of one frame: at once if the file is mapped, else when something of it is asked for or the stream goes on."""

    def __init__(self, source: Union[_Mapped, _Piped], metas: list[dict[str, Any]], sizes: list[int], size: int) -> None:
        self.source, self.metas, self.sizes, self.size = source, metas, sizes, size
        self.data: Optional[memoryview] = None
        self.tail: dict[str, Any] = {}
        self.crcs: list[Any] = []

    def load(self) -> None:
        if self.data is None:
            self.data = self.source.take(self.size, "the data")
            self._tail()

    def _tail(self) -> None:
        line = line_parse(bytes(self.source.take(LINE, "a tail")))
        if line.kind == "abort":
            raise abort_of(line, self.source)
        if line.kind != "tail":
            raise Error("'%s' instead of the tail of the frame" % line.kind)
        block = bytes(self.source.take(block_size(line, "a tail"), "a tail"))
        line_check(line, block, "a tail")
        tail = json_parse(block, "a tail")
        crcs = tail.pop("crc32c", None)
        if not isinstance(crcs, list) or len(crcs) != len(self.sizes) or not all(type(c) is int for c in crcs) \
                or any(c for c, size in zip(crcs, self.sizes) if not size) or not isinstance(tail.get("report", {}), dict):
            raise Error("the tail does not fit the fields of the frame")
        _header.limits_check(tail.get("limits"))
        self.tail, self.crcs = tail, crcs

    def tail_of(self) -> dict[str, Any]:
        self.load()
        return self.tail

    def field(self, i: int) -> tuple[np.ndarray, int]:
        """The bytes of a field, with its padding and its checksum checked."""
        self.load()
        assert self.data is not None
        at, size = payload_size(self.sizes[:i]), self.sizes[i]
        raw = np.frombuffer(self.data, np.uint8, size, at) if size else np.empty(0, np.uint8)
        if any(self.data[at + size:at + padded(size)]):
            raise Error("the bytes behind field %d of %d are not zero: the data are damaged" % (i + 1, len(self.sizes)))
        crc = crc32c(raw)
        if crc != self.crcs[i]:
            raise Error("the checksum of field %d of %d ('%s' on '%s') is wrong: the data are damaged" % (
                i + 1, len(self.sizes), self.metas[i]["name"], self.metas[i]["on"]))
        return raw, crc


def abort_of(line: Line, source: Union[_Mapped, _Piped]) -> Error:
    """The message that a word upstream left in the stream."""
    block = bytes(source.take(block_size(line, "an abort message"), "an abort message"))
    line_check(line, block, "an abort message")
    code = line.numbers[0] if line.numbers[0] in (1, 2, 3) else 1
    error = Error(block.decode("utf-8", "replace").rstrip("\n ") or "the stream was aborted without a reason", code)
    error.aborted = True  # type: ignore[attr-defined]
    return error


class Stream(Iterable[Frame]):
    """The frames of a stream, one after the other: `for frame in stream`. Of a file also `len(stream)`, `stream[-1]` and `stream[2:5]`.

    A header is read when its frame is reached, the data of a field when its array is asked for; each is compared with its checksum then.
    Raises Error where the stream is damaged or cut, and with the message and the code of an abort.
    """

    def __init__(self, source: Union[_Mapped, _Piped], process: Optional[subprocess.Popen[bytes]] = None, errors: Optional[BinaryIO] = None) -> None:
        self._source, self._process, self._errors = source, process, errors
        self._found: list[int] = []                      # where the frames of a file begin
        self._next, self._ended = 0, False               # where the search goes on
        self._inside, self._count, self._any = False, 0, False
        self._payload: Optional[_Payload] = None
        self._last: Optional[weakref.ref[Frame]] = None  # of a pipe
        self._at_end: Optional[Callable[[], None]] = None  # called at every end marker

    def _frame(self, line: Line) -> Frame:
        block = bytes(self._source.take(block_size(line, "a header"), "a header"))
        line_check(line, block, "a header")
        head = json_parse(block, "a header")
        owners = _header.shapes(head)
        sizes = _header.payload(head, owners)
        if payload_size(sizes) != line.numbers[1]:
            raise Error("the header describes %d bytes of data, its line announces %d" % (payload_size(sizes), line.numbers[1]))
        payload = _Payload(self._source, head["fields"], sizes, line.numbers[1])
        if isinstance(self._source, _Mapped):
            payload.load()
        fields = [Field(meta, owners[meta["on"]], (lambda k=i: payload.field(k))) for i, meta in enumerate(head["fields"])]
        frame = Frame._of(head, owners, fields, payload.tail_of)
        self._payload = payload
        return frame

    def _line(self) -> Optional[Line]:
        """The next line that begins a frame; None at the end. Streams may follow each other."""
        while True:
            if self._source.empty():
                if not self._any:
                    raise Error("no input: zero bytes are not a stream (the stage before did not start)")
                if self._inside:
                    raise Error("the input ends without an end marker: it was cut (run the whole pipeline again)")
                return None
            line = line_parse(bytes(self._source.take(LINE, "a line")))
            self._any = True
            if line.kind == "frame":
                self._inside, self._count = True, self._count + 1
                return line
            if line.kind == "abort":
                raise abort_of(line, self._source)
            if line.kind != "end":
                raise Error("'%s' instead of a frame or the end" % line.kind)
            line_check(line, b"", "the end marker")
            if line.numbers[0] != self._count:
                raise Error("the end marker does not count the %d frames received" % self._count)
            self._inside, self._count = False, 0
            if self._at_end:
                self._at_end()

    def _advance(self) -> Optional[Frame]:
        """The next frame of all; of a file its place is kept."""
        if self._ended:
            return None
        if isinstance(self._source, _Mapped):
            self._source.at = self._next
        elif self._payload is not None:  # what nobody holds any longer is read and forgotten
            last = self._last() if self._last else None
            self._payload.load()
            if last is None:
                self._payload.data = None
        line = self._line()
        if line is None:
            self._ended = True
            self._finish()
            return None
        begin = self._source.at if isinstance(self._source, _Mapped) else 0
        frame = self._frame(line)
        if isinstance(self._source, _Mapped):
            self._found.append(begin - LINE)
            self._next = self._source.at
        else:
            self._last = weakref.ref(frame)
        return frame

    def _finish(self) -> None:
        """The exit status of the program behind a pipe."""
        if self._process is not None:
            code = self._process.wait()
            if code and self._errors is not None:
                self._errors.seek(0)
                said = self._errors.read().decode("utf-8", "replace").strip().splitlines()
                message = said[-1] if said else "sh5 ended with exit status %d and no message" % code
                raise Error(message, code if code in (1, 2, 3) else 1)
            self._process = None

    def _at(self, i: int) -> Frame:
        assert isinstance(self._source, _Mapped)
        self._source.at = self._found[i]
        return self._frame(line_parse(bytes(self._source.take(LINE, "a line"))))

    def __iter__(self) -> Iterator[Frame]:
        i = 0
        while True:
            if i < len(self._found):
                frame: Optional[Frame] = self._at(i)
            else:
                try:
                    frame = self._advance()
                except Error as e:
                    if getattr(e, "aborted", False):
                        self._finish_quietly()
                    raise
            if frame is None:
                return
            i += 1
            yield frame

    def _finish_quietly(self) -> None:
        if self._process is not None:
            self._process.wait()
            self._process = None

    def _whole(self) -> int:
        if not isinstance(self._source, _Mapped):
            raise TypeError("frames of a pipe come one after the other: use list(stream), or a file")
        while self._advance() is not None:
            pass
        return len(self._found)

    def __len__(self) -> int:
        return self._whole()

    @overload
    def __getitem__(self, i: int) -> Frame: ...
    @overload
    def __getitem__(self, i: slice) -> list[Frame]: ...

    def __getitem__(self, i: Union[int, slice]) -> Union[Frame, list[Frame]]:
        if isinstance(i, slice):
            return [self._at(k) for k in range(self._whole())[i]]
        if i >= 0:
            while i >= len(self._found) and self._advance() is not None:
                pass
        elif self._whole():
            i += len(self._found)
        if not isinstance(self._source, _Mapped) or not 0 <= i < len(self._found):
            self._whole()
            raise IndexError("the stream has %d frames" % len(self._found))
        return self._at(i)

    def close(self) -> None:
        """Ends the program behind an HDF5 file. Arrays of a file stay readable."""
        if self._process is not None:
            assert self._process.stdout is not None
            self._process.stdout.close()
            self._process.wait()
            self._process = None

    def __enter__(self) -> Stream:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()


def of_bytes(data: Any) -> Stream:
    """The stream in these bytes."""
    return Stream(_Mapped(memoryview(data).cast("B")))


def of_file(file: BinaryIO) -> Stream:
    """A stream that lies in a file is mapped; anything else is read as it comes."""
    try:
        size = os.fstat(file.fileno()).st_size if file.seekable() and file.tell() == 0 else -1
    except (OSError, AttributeError, ValueError):
        size = -1
    if size < 0:
        return Stream(_Piped(file))
    return of_bytes(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) if size else b"")


def open(source: Source) -> Stream:
    """The stream in a file, which is mapped and not loaded; in an HDF5 file, which sh5 reads frame by frame; or in a binary file object (a pipe).

    Raises OSError if there is no such file, Error if it is no stream.
    """
    if hasattr(source, "read"):
        return of_file(source)  # type: ignore[arg-type]
    with builtins.open(source, "rb") as file:  # type: ignore[arg-type]
        magic = file.read(8)
        if magic != b"\x89HDF\r\n\x1a\n":
            file.seek(0)
            return of_file(file)
    errors = tempfile.TemporaryFile()
    process = subprocess.Popen([program("sh5"), "--", os.fspath(source)], stdout=subprocess.PIPE, stderr=errors, env=environment())  # type: ignore
    assert process.stdout is not None
    return Stream(_Piped(process.stdout), process, errors)


class Writer:
    """Writes frames: `with create("out.pm") as out: out.write(frame)`. A file is replaced when the stream is whole and stays as it was if not."""

    def __init__(self, target: Source) -> None:
        self.count, self._process, self._path, self._part = 0, None, None, None
        self._errors: Optional[Any] = None
        if hasattr(target, "write"):
            self._file: BinaryIO = target  # type: ignore[assignment]
            return
        path = os.fspath(target)  # type: ignore[arg-type]
        if path.endswith((".h5", ".hdf5")):
            self._errors = tempfile.TemporaryFile()
            self._process = subprocess.Popen([program("sh5"), "-o", path], stdin=subprocess.PIPE, stderr=self._errors, env=environment())
            assert self._process.stdin is not None
            self._file = self._process.stdin  # type: ignore[assignment]
        else:
            self._path, self._part = path, "%s.%d.part" % (path, os.getpid())
            self._file = builtins.open(self._part, "wb")

    def write(self, frame: Frame) -> None:
        """Writes a frame, whole, and flushes it. Nothing is written if it is refused."""
        head, data, tail = frame.parts()
        block = block_make(canonical(head))
        self._file.write(line_make("PMPIPE/1 frame %d %d" % (len(block), payload_size([len(d) for d, _ in data])), block))
        for d, _ in data:
            self._file.write(d)
            self._file.write(bytes(padded(len(d)) - len(d)))
        block = block_make(canonical(tail))
        self._file.write(line_make("PMPIPE/1 tail %d" % len(block), block))
        self._file.flush()
        self.count += 1

    def end(self) -> None:
        """Writes the end marker; more frames after it are another stream."""
        self._file.write(line_make("PMPIPE/1 end %d" % self.count))
        self._file.flush()
        self.count = 0

    def abort(self, message: str, code: int = 1) -> None:
        """Ends the stream with a message for the program that reads it."""
        block = block_make(message)
        self._file.write(line_make("PMPIPE/1 abort %d %d" % (code, len(block)), block))
        self._file.flush()

    def close(self, whole: bool = True) -> None:
        """Puts the file in its place; with whole=False takes it away."""
        if self._part:
            self._file.close()
            os.replace(self._part, self._path) if whole and self._path else os.unlink(self._part)
            self._part = None
        elif self._process is not None:
            self._file.close()
            code, self._process = self._process.wait(), None
            if code and whole and self._errors is not None:
                self._errors.seek(0)
                raise Error(self._errors.read().decode("utf-8", "replace").strip(), code if code in (1, 2, 3) else 1)

    def __enter__(self) -> Writer:
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        try:
            if kind is None:
                self.end()
            elif self._process is not None:
                self.abort(str(value) or kind.__name__)
        except BaseException:
            self.close(False)
            raise
        self.close(kind is None)


def create(target: Source) -> Writer:
    """A writer of a stream to a file, to an HDF5 file (by sh5; the name ends in .h5), or to a binary file object."""
    return Writer(target)


def write(target: Source, frames: Union[Frame, Iterable[Frame]]) -> None:
    """Writes a frame, or several, as one stream.

    >>> import io
    >>> out = io.BytesIO()
    >>> write(out, Frame(dim=1, time=0.25))
    >>> [frame.time for frame in of_bytes(out.getvalue())]
    [0.25]
    """
    with create(target) as out:
        for frame in [frames] if isinstance(frames, Frame) else frames:
            out.write(frame)
