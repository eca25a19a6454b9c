#!/usr/bin/env python3
"""Reads pmpipe streams (docs/stream.md) in plain Python: `for header, data, tail in frames(file)`; data[i][c] is component c of field i.
As a program it prints standard input: a line per field, then its values. SPDX-License-Identifier: GPL-3.0-or-later"""
import array, json, math, signal, sys

TYPES = {"f64": "d", "f32": "f", "i64": "q", "u8": "B"}
TABLE = list(range(256))
for _ in range(8):
    TABLE = [i >> 1 ^ (0x82F63B78 if i & 1 else 0) for i in TABLE]

def crc32c(data, c=0xFFFFFFFF):
    for byte in data:
        c = c >> 8 ^ TABLE[(c ^ byte) & 255]
    return c ^ 0xFFFFFFFF

def fail(message, code=1):
    print(message, file=sys.stderr)
    sys.exit(code)

def frames(file):
    def take(n):
        data = file.read(n)
        return data if len(data) == n else fail("the stream is cut")
    def line(*kinds):                                   # the kind of the line, its numbers, the block behind it
        text = take(64)
        words = text.split()
        if words[:1] != [b"PMPIPE/1"]:
            fail("this is not a stream of version 1")
        kind, last = words[1].decode(), 4 if words[1] in (b"frame", b"abort") else 3
        numbers, seal = [int(w) for w in words[2:last]], words[last:]
        block = take(0 if kind == "end" else numbers[kind == "abort"])
        sums = [], [b"%08x" % crc32c(b" ".join(words[:last]) + block)]     # without one: written by an older version
        if seal not in sums or text != b" ".join(words).ljust(63) + b"\n":
            fail("a checksum is wrong")
        if kind == "abort":
            fail(block.decode().strip(), numbers[0])
        return (kind, numbers, block) if kind in kinds else fail("the stream is damaged")
    try:
        while True:
            kind, numbers, block = line("frame", "end")
            if kind == "end":
                if not file.peek(1):                    # or another stream follows
                    return
                continue
            header = json.loads(block)
            length = {s["name"]: s["n"] for s in header["sets"]}
            for m in header["meshes"]:
                faces = header["box"]["fields"]
                length[m["name"]] = math.prod(n + (f[0] != "periodic") for n, f in zip(m["cells"], faces))
            data, sums = [], []
            for f in header["fields"]:
                n, values = length[f["on"]], array.array(TYPES[f["type"]])
                if "uniform" not in f:
                    size = f["components"] * n * values.itemsize
                    padded = take(-(-size // 64) * 64)
                    values.frombytes(padded[:size] if not any(padded[size:]) else fail("the stream is damaged"))
                sums.append(crc32c(values.tobytes()))
                if sys.byteorder == "big":
                    values.byteswap()
                data.append([[u] * n for u in f["uniform"]] if "uniform" in f else
                            [values[c * n:c * n + n] for c in range(f["components"])])
            tail = json.loads(line("tail")[2])
            if tail["crc32c"] != sums:
                fail("a checksum is wrong")
            yield header, data, tail
    except (ValueError, LookupError, TypeError, AttributeError, OverflowError, MemoryError, RecursionError):
        fail("the stream is damaged")

if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    for header, data, tail in frames(sys.stdin.buffer):
        for field, values in zip(header["fields"], data):
            print(field["on"], field["name"], field["type"])
            for row in zip(*values):
                print(*(repr(v) for v in row), sep="\t")
