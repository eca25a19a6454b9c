#!/usr/bin/env python3
"""Takes streams apart and puts strange ones together, for the tests (docs/stream.md). Plain Python, streams of a few kilobytes.

  wire.py places FILE               name and offset of every place where a cut tells: before and inside each part
  wire.py cut FILE PLACE            the stream up to that place
  wire.py header FILE [FRAME]       the header as JSON
  wire.py tail FILE [FRAME]         the tail as JSON
  wire.py edit FILE CODE            runs Python CODE on each frame and writes the stream anew with right sizes and checksums; it sees
                                    h (header), data (list of bytearray, one per field), field(NAME) -> index, put(NAME, I, VALUE), resize(SET, N)
  wire.py text FILE FROM TO         replaces text in the header as it stands (bytes, \\xNN understood), sizes kept right
  wire.py tail-text FILE FROM TO    the same in the tail
  wire.py line FILE FROM TO         replaces text in the 64-byte lines
  wire.py seal FILE                 the stream with its checksums of lines, headers and tails made anew; for edits by sed and the like
  wire.py unseal FILE               the stream without them, as older versions wrote it
  wire.py end                       a stream of no frames
  wire.py flip FILE PLACE           inverts one bit of the byte at that place
  wire.py frames FILE...            the frames of all these files as one stream
  wire.py messages FILE             the aborts in a stream, one `code message` a line
  wire.py closed COMMAND...         runs it with a standard output that nobody reads; prints its exit status, 141 for SIGPIPE
SPDX-License-Identifier: GPL-3.0-or-later"""
import json, struct, sys

SIZE = {"f64": 8, "f32": 4, "i64": 8, "u8": 1}
CODE = {"f64": "d", "f32": "f", "i64": "q", "u8": "B"}


def table():
    rows = []
    for i in range(256):
        for _ in range(8):
            i = i >> 1 ^ (0x82F63B78 if i & 1 else 0)
        rows.append(i)
    return rows


TABLE = table()


def crc32c(data):
    c = 0xFFFFFFFF
    for b in data:
        c = c >> 8 ^ TABLE[(c ^ b) & 255]
    return c ^ 0xFFFFFFFF


def up(n):
    return -(-n // 64) * 64


NUMBERS = {b"frame": 2, b"abort": 2, b"tail": 1, b"end": 1}


def line(words, block=b""):
    """The line of these words, with the checksum of words and block, and the block."""
    text = words.encode() if isinstance(words, str) else b" ".join(words)
    return (text + b" %08x" % crc32c(text + block)).ljust(63) + b"\n" + block


def canonical(v):
    if isinstance(v, dict):
        return "{%s}" % ",".join(canonical(k) + ":" + canonical(v[k]) for k in sorted(v))
    if isinstance(v, list):
        return "[%s]" % ",".join(map(canonical, v))
    if isinstance(v, float):
        t = "%.17g" % v
        return t if set(t) & set(".en") else t + ".0"
    return json.dumps(v, ensure_ascii=False)


def block(value):
    """Canonical JSON, padded to a multiple of 64 with the newline last."""
    text = value if isinstance(value, bytes) else canonical(value).encode()
    return text.ljust(up(len(text) + 1) - 1) + b"\n"


def count(h, f):
    """Values per component of a field."""
    for s in h["sets"]:
        if s["name"] == f["on"]:
            return s["n"]
    m = next(m for m in h["meshes"] if m["name"] == f["on"])
    n = 1
    for a in range(h["dim"]):
        n *= m["cells"][a] + (h["box"]["fields"][a][0] != "periodic")
    return n


def size(h, f):
    return 0 if "uniform" in f else f["components"] * count(h, f) * SIZE[f["type"]]


def split(data, at):
    """Words and checksum (or None) of the line there, and its block."""
    words = data[at:at + 64].split()
    n = 2 + NUMBERS[words[1]]
    size = 0 if words[1] == b"end" else int(words[3 if words[1] == b"abort" else 2])
    return words[:n], (words[n:] or [None])[0], data[at + 64:at + 64 + size]


def parts(data, check=True):
    """[(kind, start, end)] of a sound stream: line, header, field NAME, tail-line, tail, end."""
    at, out = 0, []
    while at < len(data):
        words, seal, block = split(data, at)
        if check and seal is not None and line(words, block)[:64] != data[at:at + 64]:
            sys.exit("wire.py: the checksum of the %s line at byte %d is wrong" % (words[1].decode(), at))
        out.append((words[1].decode() + "-line", at, at + 64))
        at += 64
        if words[1] == b"frame":
            hb = int(words[2])
            h = json.loads(data[at:at + hb])
            out.append(("header", at, at + hb))
            at += hb
            for f in h["fields"]:
                n = up(size(h, f))
                if n:
                    out.append(("field %s" % f["name"], at, at + n))
                at += n
        elif words[1] in (b"tail", b"abort"):
            n = int(words[-1])
            out.append((words[1].decode(), at, at + n))
            at += n
    return out


def frames(data):
    """[(header, [field bytes], tail)]"""
    out = []
    for kind, a, b in parts(data):
        if kind == "header":
            h, fields = json.loads(data[a:b]), []
            left = [f for f in h["fields"]]
        elif kind.startswith("field "):
            while size(h, left[0]) == 0:
                fields.append(bytearray())
                left.pop(0)
            fields.append(bytearray(data[a:a + size(h, left.pop(0))]))
        elif kind == "tail":
            fields += [bytearray() for f in left]
            out.append((h, fields, json.loads(data[a:b])))
    return out


def frame_bytes(h, fields, tail):
    header = block(h)
    payload = b"".join(bytes(d).ljust(up(len(d)), b"\0") for d in fields)
    tail = dict(tail, crc32c=[crc32c(d) for d in fields])
    t = block(tail)
    return line("PMPIPE/1 frame %d %d" % (len(header), len(payload)), header) + payload + line("PMPIPE/1 tail %d" % len(t), t)


def places(data):
    """Every boundary, and one place inside each part."""
    out, seen = [], {}
    for kind, a, b in parts(data):
        seen[kind] = seen.get(kind, 0) + 1
        name = kind.replace(" ", "-") + (str(seen[kind]) if seen[kind] > 1 else "")
        out += [("before-" + name, a), ("in-" + name, (a + b) // 2 + 1)]
    return out


def edit(data, code):
    out = []
    all = frames(data)
    for h, fields, tail in all:
        def field(name):
            return [f["name"] for f in h["fields"]].index(name)

        def put(name, i, value):
            f = h["fields"][field(name)]
            struct.pack_into("<" + CODE[f["type"]], fields[field(name)], i * SIZE[f["type"]], value)

        def resize(name, n):
            s = next(s for s in h["sets"] if s["name"] == name)
            for f, d in zip(h["fields"], data):
                if f["on"] == name and "uniform" not in f:
                    one, w = s["n"] * SIZE[f["type"]], n * SIZE[f["type"]]
                    d[:] = b"".join((d[c * one:c * one + one] * (n // max(s["n"], 1) + 1))[:w] for c in range(f["components"]))
            s["n"] = n
        data = fields
        exec(code, {"resize": resize, "h": h, "data": fields, "tail": tail, "field": field, "put": put, "struct": struct, "crc32c": crc32c})
        out.append(frame_bytes(h, fields, tail))
    return b"".join(out) + line("PMPIPE/1 end %d" % len(all))


def text(data, a, b, old, new):
    old_block = data[a:b].rstrip()
    if old not in old_block:
        sys.exit("wire.py: no %r in %r" % (old, old_block))
    new_block = block(old_block.replace(old, new, 1))
    words = split(data, a - 64)[0]
    words[2] = b"%d" % len(new_block)
    return data[:a - 64] + line(words, new_block) + data[b:]


def seal(data, sealed):
    """The same stream with its checksums made anew, or without them."""
    out, done = [], 0
    for kind, a, b in parts(data, False):
        if kind.endswith("-line"):
            words, _, block = split(data, a)
            out += [data[done:a], line(words, block)[:64] if sealed else b" ".join(words).ljust(63) + b"\n"]
            done = b
    return b"".join(out) + data[done:]


def literal(s):
    return s.encode("latin-1").decode("unicode_escape").encode("latin-1") if "\\" in s else s.encode()


def closed(command):
    import os, subprocess  # not for the others, which start a hundred times a minute
    r, w = os.pipe()
    os.close(r)
    code = subprocess.run(command, stdout=w).returncode
    print(code if code >= 0 else 128 - code)


def main(action, path=None, *rest):
    if action == "end":
        return sys.stdout.buffer.write(line("PMPIPE/1 end 0"))
    if action == "closed":
        return closed([path, *rest])
    data = open(path, "rb").read()
    out = sys.stdout.buffer
    spots = parts(data) if action not in ("line", "seal", "unseal") else []
    if action == "places":
        out.write("".join("%s\n" % n for n, _ in places(data)).encode())
    elif action == "cut":
        out.write(data[:dict(places(data))[rest[0]]])
    elif action == "flip":
        at = dict(places(data))[rest[0]]
        out.write(data[:at] + bytes([data[at] ^ 1]) + data[at + 1:])
    elif action in ("header", "tail"):
        h = frames(data)[int(rest[0]) - 1 if rest else 0][0 if action == "header" else 2]
        out.write(json.dumps(h, indent=1, sort_keys=True).encode() + b"\n")
    elif action == "frames":
        all = [f for p in (path, *rest) for f in frames(open(p, "rb").read())]
        out.write(b"".join(frame_bytes(*f) for f in all) + line("PMPIPE/1 end %d" % len(all)))
    elif action == "messages":
        for kind, a, b in spots:
            if kind == "abort":
                out.write(data[a - 64:a].split()[2] + b" " + data[a:b].rstrip() + b"\n")
    elif action == "edit":
        out.write(edit(data, rest[0]))
    elif action in ("text", "tail-text"):
        _, a, b = next(p for p in spots if p[0] == ("header" if action == "text" else "tail"))
        out.write(text(data, a, b, literal(rest[0]), literal(rest[1])))
    elif action == "line":
        old, new = literal(rest[0]), literal(rest[1])
        at = data.index(old) // 64 * 64
        words, _, block = split(data, at)
        changed = (b" ".join(words) + b" ").replace(old, new, 1)
        out.write(data[:at] + line([changed.rstrip()], block)[:63] + b"\n" + data[at + 64:])
    elif action in ("seal", "unseal"):
        out.write(seal(data, action == "seal"))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(*sys.argv[1:])
