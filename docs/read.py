#!/usr/bin/env python3
"""Reads pmpipe streams (docs/stream.md) in plain Python: `for header, data, tail in frames(file)`; data[i][c] is component c of field i.
As a program it prints standard input: a line per field, then its values. SPDX-License-Identifier: GPL-3.0-or-later"""
import array, json, math, sys

TYPES = {"f64": "d", "f32": "f", "i64": "q", "u8": "B"}
TABLE = list(range(256))
for _ in range(8):
    TABLE = [i >> 1 ^ (0x82F63B78 if i & 1 else 0) for i in TABLE]

def crc32c(data, c=0xFFFFFFFF):
    for byte in data:
        c = c >> 8 ^ TABLE[(c ^ byte) & 255]
    return c ^ 0xFFFFFFFF

def frames(file):
    def take(n):
        data = file.read(n)
        return data if len(data) == n else sys.exit("the stream is cut")
    def block(n):
        text = take(int(n))
        return sys.exit(text.decode().strip()) if words[1] == b"abort" else json.loads(text)
    line = take(64)
    while line:                                              # after an end, end-of-file or another stream
        words = line.split()
        if words[0] != b"PMPIPE/1":
            sys.exit("not a stream of version 1")
        if words[1] != b"end":
            header = block(words[-1] if words[1] == b"abort" else words[2])
            length = {s["name"]: s["n"] for s in header["sets"]}
            for m in header["meshes"]:
                faces = header["box"]["fields"]
                length[m["name"]] = math.prod(n + (f[0] != "periodic") for n, f in zip(m["cells"], faces))
            data, sums = [], []
            for f in header["fields"]:
                n, all = length[f["on"]], array.array(TYPES[f["type"]])
                if "uniform" not in f:
                    bytes = f["components"] * n * all.itemsize
                    padded = take(-(-bytes // 64) * 64)
                    all.frombytes(padded[:bytes])
                sums.append(crc32c(all.tobytes()))
                if sys.byteorder == "big":
                    all.byteswap()
                data.append([[v] * n for v in f["uniform"]] if "uniform" in f else [all[c * n:c * n + n] for c in range(f["components"])])
            words = take(64).split()
            tail = block(words[-1])
            if tail["crc32c"] != sums:
                sys.exit("a checksum is wrong")
            yield header, data, tail
        line = take(64) if words[1] != b"end" else file.read(64)

if __name__ == "__main__":
    for header, data, tail in frames(sys.stdin.buffer):
        for field, values in zip(header["fields"], data):
            print(field["on"], field["name"], field["type"])
            for row in zip(*values):
                print(*(repr(v) for v in row), sep="\t")
