"""Checks the header of a frame before memory is taken for it: the range of every number, the length of every name, the target of every reference, as
lib/stream/header-read.c does. SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import math
from typing import Any, Callable, Optional, Sequence

from .wire import Error

SIZE = {"f64": 8, "f32": 4, "i64": 8, "u8": 1}
ROLES = ("state", "change", "derived", "register")
KINDS = ("value", "strength")
FACES = ("periodic", "open", "wall", "neumann", "absorbing")
PARTICLE_FACES = ("periodic", "reflect", "absorb", "open")
_MOST_PARTICLES, _MOST_CELLS, _MOST_POINTS, _MOST_OBJECTS, _MOST_INT = 1 << 48, 1 << 31, 1 << 48, 4096, (1 << 63) - 1


class _Look:
    """One object of the header, with the word for it in messages."""

    def __init__(self, value: Any, what: str) -> None:
        self.value, self.what = value, what
        if not isinstance(value, dict):
            self.complain("", "is not an object")

    def complain(self, key: str, why: str) -> None:
        raise Error("the header is wrong: %s '%s' %s" % (self.what, key, why))

    def take(self, key: str, good: Callable[[Any], bool], why: str, must: bool = True, otherwise: Any = None) -> Any:
        if key not in self.value:
            if must:
                self.complain(key, "is missing")
            return otherwise
        if not good(self.value[key]):
            self.complain(key, why)
        return self.value[key]

    def integer(self, key: str, low: int, high: int, must: bool = True, otherwise: int = 0) -> int:
        return self.take(key, lambda v: type(v) is int and low <= v <= high, "is not an integer in its range", must, otherwise)

    def real(self, key: str, must: bool = True) -> Any:
        return self.take(key, _is_real, "is not a number", must)

    def name(self, key: str, must: bool = True, empty: bool = False) -> str:
        return self.take(key, lambda v: isinstance(v, str) and len(v.encode()) < 64 and (empty or v != ""), "is not a name of 1 to 63 bytes", must, "")

    def choice(self, key: str, words: Sequence[str], must: bool = True) -> Any:
        return self.take(key, lambda v: isinstance(v, str) and v in words, "is not one of the words allowed", must)

    def reals(self, key: str, n: int) -> list[float]:
        return self.take(key, lambda v: isinstance(v, list) and len(v) == n and all(map(_is_real, v)), "is not an array of %d numbers" % n)

    def listed(self, key: str) -> list[Any]:
        return self.take(key, lambda v: isinstance(v, list) and len(v) <= _MOST_OBJECTS, "is not an array, or too long")


def _is_real(value: Any) -> bool:
    return type(value) in (int, float)


def _box(value: Any, dim: int) -> list[Any]:
    box = _Look(value, "box")
    lo, hi = box.reals("lo", dim), box.reals("hi", dim)
    faces = []
    for key, words in (("fields", FACES), ("particles", PARTICLE_FACES)):
        pairs = box.take(key, lambda v: isinstance(v, list) and len(v) >= dim and all(
            isinstance(p, list) and len(p) >= 2 and all(isinstance(f, str) and f in words for f in p[:2]) for p in v[:dim]),
            "is not a pair of face words per axis")
        faces.append(pairs)
        if any((p[0] == "periodic") != (p[1] == "periodic") for p in pairs[:dim]):
            box.complain(key, "has an axis with one periodic face")
    if not all(b > a for a, b in zip(lo, hi)):
        box.complain("hi", "is not above lo")
    return faces[0]


def _named(value: Any, what: str, inside: str) -> None:
    named = _Look(value, what)
    named.name("name", empty=True)
    named.take(inside, lambda v: isinstance(v, dict), "is not an object", must=False)


def _set(value: Any) -> tuple[str, tuple[int, ...]]:
    one = _Look(value, "set")
    one.take("done", lambda v: isinstance(v, dict) and all(_is_real(v.get(k)) and 0 <= v[k] <= 1 for k in ("kick", "drift")),
        "is not a fraction", must=False)
    one.integer("stage", 0, 64, must=False)
    return one.name("name"), (one.integer("n", 0, _MOST_PARTICLES),)


def points(mesh: dict[str, Any], faces: list[Any]) -> tuple[int, ...]:
    """The points per axis of a mesh: its cells on a periodic axis, one more on any other."""
    return tuple(int(n) + (f[0] != "periodic") for n, f in zip(mesh["cells"], faces))


def _mesh(value: Any, dim: int, faces: list[Any]) -> tuple[str, tuple[int, ...]]:
    one = _Look(value, "mesh")
    name, cells, h = one.name("name"), one.reals("cells", dim), one.reals("h", dim)
    one.reals("lo", dim)
    if not all(1 <= n <= _MOST_CELLS and n == math.floor(n) for n in cells) or not all(s > 0 for s in h):
        one.complain(name, "has an invalid number of cells or spacing")
    if math.prod(int(n) + 1 for n in cells) > _MOST_POINTS:
        one.complain(name, "has too many points")
    return name, points(value, faces)


def _field(value: Any, owners: dict[str, tuple[int, ...]]) -> tuple[str, str]:
    one = _Look(value, "field")
    name, on, components = one.name("name"), one.name("on"), one.integer("components", 1, 16)
    if on not in owners:
        one.complain(on, "owns a field, but is neither a set nor a mesh")
    one.choice("type", tuple(SIZE))
    one.choice("role", ROLES)
    one.choice("kind", KINDS)
    for key in ("unit", "of", "kernel"):
        one.name(key, must=False, empty=True)
    interlaced = one.take("interlaced", lambda v: isinstance(v, bool), "is neither true nor false", must=False)
    if interlaced and not value.get("kernel"):
        one.complain("interlaced", "has no kernel")
    one.choice("outside", ("monopole", "drop", "error"), must=False)
    if "uniform" in value:
        one.reals("uniform", components)
    one.take("terms", lambda v: isinstance(v, list) and len(v) <= 16 and all(isinstance(t, str) and len(t.encode()) < 64 for t in v),
        "are not up to 16 names", must=False)
    one.take("half", lambda v: isinstance(v, list) and len(v) == components and all(
        isinstance(e, list) and len(e) >= 3 and all(type(b) is int and 0 <= b <= 1 for b in e[:3]) for e in v),
        "is not three times 0 or 1 per component", must=False)
    return on, name


def shapes(header: dict[str, Any]) -> dict[str, tuple[int, ...]]:
    """Points per axis of every mesh, and (n,) of every set; the whole header is checked first.

    Raises Error with the first thing that is wrong.
    """
    top = _Look(header, "frame")
    top.take("byte_order", lambda v: v == "little", "is not little (data must be little-endian; swap the bytes where they are written)", must=False)
    dim = top.integer("dim", 1, 3)
    _named(top.take("law", lambda v: True, ""), "law", "constants")
    _named(top.take("scene", lambda v: True, ""), "scene", "parameters")
    for key, must in (("time", True), ("dt", True), ("start", False)):
        top.real(key, must)
    top.integer("step", 0, _MOST_INT)
    top.integer("substep", 0, 1 << 20)
    top.integer("seed", 0, _MOST_INT, must=False)
    if "since" in header:
        since = _Look(header["since"], "since")
        since.real("time")
        since.integer("step", 0, _MOST_INT)
    top.take("history", lambda v: isinstance(v, list) and all(isinstance(e, dict) for e in v), "is not an array of objects", must=False)
    faces = _box(top.take("box", lambda v: True, ""), dim)
    owners: dict[str, tuple[int, ...]] = {}
    for key, one in (("sets", lambda v: _set(v)), ("meshes", lambda v: _mesh(v, dim, faces))):
        for value in top.listed(key):
            name, shape = one(value)
            if name in owners:
                top.complain(name, "occurs twice")
            owners[name] = shape
    seen = set()
    for value in top.listed("fields"):
        pair = _field(value, owners)
        if pair in seen:
            top.complain(pair[1], "occurs twice")
        seen.add(pair)
    return owners


def payload(header: dict[str, Any], owners: dict[str, tuple[int, ...]]) -> list[int]:
    """The bytes of each field in the stream, without padding; 0 of a uniform one."""
    return [0 if "uniform" in f else math.prod(owners[f["on"]]) * f["components"] * SIZE[f["type"]] for f in header["fields"]]


def limits_check(limits: Optional[Any]) -> None:
    """The rates in a tail."""
    if limits is not None and not (isinstance(limits, dict) and all(isinstance(e, dict) and all(
            k not in e or _is_real(e[k]) and e[k] >= 0 for k in ("decay", "oscillation", "strain")) for e in limits.values())):
        raise Error("the limits in the tail are not rates by change field ({\"owner/change\": {decay, oscillation, strain}})")
