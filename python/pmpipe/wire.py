"""Lines and blocks of the stream (docs/stream.md): parsed, checked, written in canonical form. SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import json
import math
import os
import re
from typing import Any, NamedTuple, Optional

from .checksum import crc32c

LINE = 64
MOST_TEXT = 16 << 20  # bytes of a header, a tail or a message
_NUMBERS = {b"frame": 2, b"abort": 2, b"tail": 1, b"end": 1}


class Error(Exception):
    """What went wrong, as one line, and the exit status that a program would have.

    code: 1 data or system, 2 usage, 3 numerics.

    >>> Error("no field 'mass' on 'matter'").code
    1
    """

    def __init__(self, message: str, code: int = 1) -> None:
        super().__init__(re.sub(r"[\x00-\x1f\x7f]+", " ", message))
        self.code = code


Error.__module__ = "pmpipe"


class Line(NamedTuple):
    """A line of 64 bytes: its kind, its numbers, its words as bytes, and its checksum (None: of a version that wrote none)."""
    kind: str
    numbers: tuple[int, ...]
    words: bytes
    seal: Optional[int]


def padded(size: int) -> int:
    """The next multiple of 64."""
    return -(-size // LINE) * LINE


def line_parse(text: bytes) -> Line:
    """The line in these 64 bytes; its checksum is compared by line_check, when the block behind it is there."""
    if text[:7] != b"PMPIPE/":
        raise Error("this is not a pmpipe stream (stab reads text, sh5 reads HDF5)")
    if text[:9] != b"PMPIPE/1 ":
        raise Error("the stream is of a version that this reader does not know (use a newer pmpipe)")
    kind = text[9:-1].rstrip(b" ").split(b" ")[0]
    if text[-1:] != b"\n" or kind not in _NUMBERS:
        raise Error("a line of the stream is damaged")
    words = text[:-1].rstrip(b" ").split(b" ")
    numbers, rest = words[2:2 + _NUMBERS[kind]], words[2 + _NUMBERS[kind]:]
    if len(numbers) != _NUMBERS[kind] or not all(re.fullmatch(rb"[0-9]{1,20}", n) and int(n) < 1 << 64 for n in numbers) \
            or len(rest) > 1 or not all(re.fullmatch(rb"[0-9a-f]{8}", r) for r in rest):
        raise Error("a line of the stream is damaged")
    return Line(kind.decode(), tuple(map(int, numbers)), b" ".join(words[:2] + numbers), int(rest[0], 16) if rest else None)


def line_check(line: Line, block: bytes, what: str) -> None:
    """Compares the checksum, unless PM_UNSEALED=1."""
    if line.seal is not None and crc32c(block, crc32c(line.words)) != line.seal and os.environ.get("PM_UNSEALED") != "1":
        raise Error("the checksum of %s is wrong: it is damaged, or was edited without a new checksum (docs/stream.md)" % what)


def block_size(line: Line, what: str) -> int:
    """The size of the block that the line announces."""
    size = line.numbers[1 if line.kind == "abort" else 0]
    if size > MOST_TEXT or size % LINE:
        raise Error("%s of %d bytes: not a multiple of 64 up to 16 MiB" % (what, size))
    return size


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    out = dict(pairs)
    if len(out) != len(pairs):
        raise Error("an object of the JSON names a key twice")
    return out


def _real(text: str) -> float:
    value = float(text)
    if math.isinf(value):
        raise Error("a number of the JSON is too large")
    return value


def _integer(text: str) -> int:
    value = int(text) if len(text) < 21 else 1 << 63
    if not -1 << 63 <= value < 1 << 63:
        raise Error("an integer of the JSON is too large")
    return value


def _constant(text: str) -> float:
    raise Error("%s is no number of JSON" % text)


def json_parse(block: bytes, what: str) -> dict[str, Any]:
    """The object in a block that is padded with spaces and a newline."""
    text = block[:-1].rstrip(b" ")
    if block[-1:] != b"\n" or text[-1:] <= b" ":
        raise Error("%s does not end in spaces and a newline: it is damaged" % what)
    try:
        value = json.loads(text.decode(), object_pairs_hook=_object, parse_float=_real, parse_int=_integer, parse_constant=_constant)
        if b"\\u" in text and b"\\u0000" in canonical(value).encode():
            raise Error("%s is not JSON: a text holds a zero byte" % what)
    except Error as e:
        raise Error("%s is not JSON: %s" % (what, e)) from None
    except (ValueError, RecursionError):
        raise Error("%s is not JSON: it is damaged" % what) from None
    if not isinstance(value, dict):
        raise Error("the header is wrong: frame '' is not an object" if what == "a header" else "%s is not an object" % what)
    return value


def _number(value: float) -> str:
    """As the C library writes it: 17 digits, recognizable as a real, no + and no leading zeros in the exponent."""
    if not math.isfinite(value):
        raise Error("a number of the header is not finite (time, dt, box, mesh or a uniform field)", 3)
    text = "%.17g" % value
    if "e" in text:
        return re.sub(r"e\+?(-?)0*", r"e\1", text)
    return text if "." in text else text + ".0"


def canonical(value: Any) -> str:
    """JSON with sorted keys, without white space, reals with 17 digits: equal values are equal texts.

    >>> canonical({"b": [1, 2.5, True, None], "a": 1e-7})
    '{"a":9.9999999999999995e-8,"b":[1,2.5,true,null]}'
    """
    if isinstance(value, dict):
        return "{%s}" % ",".join("%s:%s" % (canonical(str(k)), canonical(value[k])) for k in sorted(value))
    if isinstance(value, (list, tuple)):
        return "[%s]" % ",".join(map(canonical, value))
    if isinstance(value, str):
        return re.sub(r"\\u00[01][0-9a-f]", lambda m: "\\u" + m.group()[2:].upper(), json.dumps(value, ensure_ascii=False))
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    if hasattr(value, "tolist"):  # of numpy
        return canonical(value.tolist())
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _number(value)
    raise Error("a header holds text, numbers, lists and objects, not %s" % type(value).__name__, 2)


def block_make(text: str) -> bytes:
    """The text, padded with spaces to a multiple of 64 bytes, the last a newline."""
    raw = text.encode()
    return raw.ljust(padded(len(raw) + 1) - 1) + b"\n"


def line_make(words: str, block: bytes = b"") -> bytes:
    """The line of these words with its checksum, and the block behind it."""
    raw = words.encode()
    return (raw + b" %08x" % crc32c(block, crc32c(raw))).ljust(LINE - 1) + b"\n" + block
