"""A frame: attributes, particle sets, meshes, and named arrays on them. SPDX-License-Identifier: GPL-3.0-or-later"""
from __future__ import annotations

import copy
import math
from collections.abc import MutableMapping
from typing import Any, Callable, Iterator, Optional, Sequence, Union

import numpy as np

from . import header as _header
from .checksum import crc32c
from .wire import Error, padded

DTYPE = {"f64": np.dtype("<f8"), "f32": np.dtype("<f4"), "i64": np.dtype("<i8"), "u8": np.dtype("u1")}
STRENGTHS = ("mass", "charge", "circulation", "volume")  # new fields of these names are extensive


def _type_of(dtype: np.dtype) -> str:
    """The type of the stream for an array of numpy."""
    if dtype.kind == "f":
        return "f32" if dtype.itemsize == 4 else "f64"
    if dtype.kind in "bu" and dtype.itemsize == 1:
        return "u8"
    if dtype.kind in "iu":
        return "i64"
    raise Error("an array of %s is no field (real numbers, integers or bytes)" % dtype, 2)


class Field:
    """One field: its description `meta` (a row of `fields` in docs/stream.md) and its data, which are read when they are first asked for.

    shape: the points of its owner, (n,) or (nx, ny, nz), and behind them the components if there are several.
    """

    def __init__(self, meta: dict[str, Any], points: tuple[int, ...], load: Optional[Callable[[], tuple[np.ndarray, int]]] = None,
                 planar: Optional[np.ndarray] = None) -> None:
        self.meta, self.points = meta, points
        self._load, self._planar = load, planar
        self._crc: Optional[int] = None  # of data as they were read

    @property
    def name(self) -> str:
        """Its name."""
        return self.meta["name"]

    @property
    def on(self) -> str:
        """The set or mesh it belongs to."""
        return self.meta["on"]

    @property
    def components(self) -> int:
        """1 to 16."""
        return self.meta["components"]

    @property
    def uniform(self) -> Optional[list[float]]:
        """One number per component if all values are equal, and the field has no data; else None."""
        return self.meta.get("uniform")

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of `array`."""
        return self.points + ((self.components,) if self.components > 1 else ())

    @property
    def planar(self) -> np.ndarray:
        """The data in the order of the stream: (components, n), or (components, nz, ny, nx); component c is contiguous.

        Read-only unless `Owner.change` or `Owner.make` gave the array. Raises Error if the checksum of the data is wrong.
        """
        if self._planar is None:
            shape, dtype = (self.components,) + self.points[::-1], DTYPE[self.meta["type"]]
            if self.uniform is not None:
                each = np.array(self.uniform, dtype).reshape((-1,) + (1,) * len(self.points))
                self._planar = np.broadcast_to(each, shape)
            elif self._load is None:
                self._planar = np.zeros(shape, dtype)
            else:
                raw, self._crc = self._load()
                self._planar = raw.view(dtype).reshape(shape)
                self._planar.flags.writeable = False
        return self._planar

    @property
    def array(self) -> np.ndarray:
        """A view of `planar`, without a copy: (n,) or (n, components), (nx, ny, nz) or (nx, ny, nz, components)."""
        return self.planar[0].T if self.components == 1 else self.planar.T

    def wire(self) -> tuple[bytes, int]:
        """The data as the stream has them, without padding, and their checksum. Raises Error (code 3) if what was computed is not finite."""
        if self.uniform is not None:
            return b"", 0
        planar = np.ascontiguousarray(self.planar)
        data = memoryview(planar.reshape(-1).view(np.uint8))
        if self._crc is not None:
            return data, self._crc
        self.finite(3)
        return data, crc32c(data)

    def finite(self, code: int = 1) -> None:
        """Raises Error with the place of the first value that is not finite."""
        planar = self.planar
        if planar.dtype.kind == "f" and not np.isfinite(planar).all():
            at = int(np.argmin(np.isfinite(planar).reshape(-1)))
            i, n = at % max(1, math.prod(self.points)), planar.reshape(-1)[at]
            raise Error("'%s' on '%s' is %s at %d (of %d), component %d" % (self.name, self.on, n, i, math.prod(self.points), at // max(1, math.prod(
                self.points))), code)

    def __repr__(self) -> str:
        return "<field %s on %s: %s %s, %s>" % (self.name, self.on, self.meta["type"], self.shape, self.meta["role"])


class Owner(MutableMapping):
    """A particle set or a mesh: a mapping from the names of its fields to their arrays.

    `owner["x"]` is a view of shape (n,) or (n, components), or (nx, ny, nz[, components]); it is read-only, because a stream is not changed where it
    lies. `owner["x"] = array` puts another array in its place, `owner["mass"] = 0.5` a uniform one, and `owner.change("x")` gives one to write to.
    """

    def __init__(self, frame: Frame, meta: dict[str, Any], points: tuple[int, ...]) -> None:
        self.frame, self.meta, self.points = frame, meta, points

    @property
    def name(self) -> str:
        """Its name."""
        return self.meta["name"]

    def field(self, name: str) -> Field:
        """The field itself, with its description. Raises Error if there is none."""
        try:
            return self.frame._fields[self.name, name]
        except KeyError:
            raise Error("no field '%s' on '%s' (there are: %s)" % (name, self.name, ", ".join(self) or "none")) from None

    def __getitem__(self, name: str) -> np.ndarray:
        if (self.name, name) not in self.frame._fields:
            raise KeyError(name)
        return self.field(name).array

    def __setitem__(self, name: str, value: Any) -> None:
        value = np.asarray(value)
        old = self.frame._fields.get((self.name, name))
        if old is None:
            components = value.shape[-1] if value.ndim == len(self.points) + 1 else 1
            old = self.make(name, components, type=_type_of(value.dtype))
        if old._planar is not None and np.may_share_memory(value, old._planar) and old._planar.flags.writeable:
            old.array[...] = value.reshape(old.shape)  # as in frame["matter"]["acc"] -= ..., where it is the same array
            return
        planar = np.empty((old.components,) + self.points[::-1], DTYPE[old.meta["type"]])
        if value.ndim <= 1 and value.size in (1, old.components) and value.shape != old.shape:
            old.meta["uniform"] = [float(v) for v in np.broadcast_to(value, (old.components,))]
            new = Field(old.meta, self.points)
        else:
            if value.shape not in (old.shape, old.points + (old.components,)):
                raise Error("'%s' on '%s' has the shape %s, not %s" % (name, self.name, old.shape, value.shape), 2)
            planar.T[...] = value.reshape(old.points + (old.components,))
            old.meta.pop("uniform", None)
            new = Field(old.meta, self.points, planar=planar)
        self.frame._put(new)

    def __delitem__(self, name: str) -> None:
        if (self.name, name) not in self.frame._fields:
            raise KeyError(name)
        self.frame._drop(self.name, name)

    def __iter__(self) -> Iterator[str]:
        return iter([name for on, name in self.frame._fields if on == self.name])

    def __len__(self) -> int:
        return sum(on == self.name for on, _ in self.frame._fields)

    def make(self, name: str, components: int = 1, role: str = "state", type: str = "f64", unit: str = "", kind: Optional[str] = None,
             **more: Any) -> Field:
        """A new field of zeros, the last of the frame; one of the same name is dropped. `array` of the result can be written to.

        role: state, change, derived or register; kind: strength (extensive) or value; more: other keys of docs/stream.md (of, terms, kernel, half).
        """
        meta = {"name": name, "on": self.name, "components": int(components), "type": type, "role": role, "unit": unit,
                "kind": kind or ("strength" if name in STRENGTHS else "value"), **more}
        _header._field(meta, {self.name: self.points})
        if (self.name, name) in self.frame._fields:
            self.frame._drop(self.name, name)
        return self.frame._put(Field(meta, self.points))

    def change(self, name: str) -> np.ndarray:
        """The array of a field to write to; the field moves to the end of the frame, as docs/stream.md (Order) wants it."""
        old = self.field(name)
        planar = old.planar
        if not planar.flags.writeable:
            planar = planar.copy()
        old.meta.pop("uniform", None)
        return self.frame._put(Field(old.meta, self.points, planar=planar)).array

    def __repr__(self) -> str:
        return "<%s %s: %s; %s>" % (type(self).__name__.lower(), self.name, self.points, ", ".join(self))


class Set(Owner):
    """A particle set; its fields have the shape (n,) or (n, components)."""

    @property
    def n(self) -> int:
        """The number of its particles."""
        return self.points[0]

    def keep(self, which: Any) -> None:
        """Keeps the particles that `which` selects or reorders: a mask of shape (n,), or indices."""
        index = np.arange(self.n)[np.asarray(which)]
        fields = [self.field(name) for name in self]
        for f in fields:
            if f.uniform is None:
                f._planar, f._crc = np.ascontiguousarray(f.planar[:, index]), None
        self.meta["n"], self.points = int(index.size), (int(index.size),)
        for f in fields:
            f.points, f._planar = self.points, None if f.uniform is not None else f._planar


class Mesh(Owner):
    """A mesh; its fields have the shape (nx, ny, nz) or (nx, ny, nz, components), with as many axes as the frame."""

    @property
    def lo(self) -> np.ndarray:
        """Where point 0 is [length], per axis."""
        return np.array(self.meta["lo"], float)

    @property
    def h(self) -> np.ndarray:
        """The spacing [length], per axis."""
        return np.array(self.meta["h"], float)

    @property
    def cells(self) -> tuple[int, ...]:
        """Cells per axis; a periodic axis has as many points, any other one more."""
        return tuple(map(int, self.meta["cells"]))

    def axes(self, name: Optional[str] = None, component: int = 0) -> list[np.ndarray]:
        """The coordinates [length] of the points per axis: lo + i h, half a cell up where that component of that field is staggered."""
        half = (self.field(name).meta.get("half") if name else None) or [[0, 0, 0]] * 16
        return [lo + h * (np.arange(n) + 0.5 * half[component][d]) for d, (lo, h, n) in enumerate(zip(self.lo, self.h, self.points))]


Fields = dict[str, Any]


class Frame:
    """One instant of one simulation.

    `frame["matter"]["x"]` is the array of the field x of the set (or mesh) matter. The attributes read and write `header`, the JSON of
    docs/stream.md, in which everything is kept that this package does not know.

    >>> frame = Frame(dim=2, law="gravity", constants={"G": 1.0}, lo=[0, 0], hi=[1, 1], time=0.5)
    >>> matter = frame.add_set("matter", x=[[0.25, 0.5], [0.75, 0.5]], v=np.zeros((2, 2)), mass=0.5)
    >>> frame["matter"]["x"].shape, float(matter["mass"].sum())
    ((2, 2), 1.0)
    >>> mesh = frame.add_mesh("mesh", cells=[4, 3], rho=np.ones((5, 4)))
    >>> [float(a[-1]) for a in mesh.axes()]
    [1.0, 1.0]
    """

    def __init__(self, dim: int = 3, law: str = "free", constants: Optional[dict[str, float]] = None, lo: Optional[Sequence[float]] = None,
                 hi: Optional[Sequence[float]] = None, faces: Union[str, list[Any]] = "open", particle_faces: Union[str, list[Any], None] = None,
                 time: float = 0.0, dt: float = 0.0, seed: int = 0) -> None:
        def pairs(word: Union[str, list[Any]]) -> list[Any]:
            return [[word, word] for _ in range(dim)] if isinstance(word, str) else word
        particle_faces = particle_faces or ("periodic" if faces == "periodic" else "open")
        self.header: dict[str, Any] = {
            "byte_order": "little", "dim": dim, "law": {"name": law, "constants": dict(constants or {})}, "scene": {"name": "", "parameters": {}},
            "time": float(time), "dt": float(dt), "step": 0, "substep": 0, "seed": seed, "history": [], "sets": [], "meshes": [], "fields": [],
            "box": {"lo": [float(v) for v in (lo if lo is not None else [0] * dim)], "hi": [float(v) for v in (hi if hi is not None else [1] * dim)],
                    "fields": pairs(faces), "particles": pairs(particle_faces)}}
        _header.shapes(self.header)
        self._tail: dict[str, Any] = {"report": {}}
        self._tail_load: Optional[Callable[[], dict[str, Any]]] = None
        self._fields: dict[tuple[str, str], Field] = {}
        self._owners: dict[str, Owner] = {}

    @classmethod
    def _of(cls, header: dict[str, Any], owners: dict[str, tuple[int, ...]], fields: list[Field], tail: Callable[[], dict[str, Any]]) -> Frame:
        frame = cls.__new__(cls)
        frame.header, frame._tail_load = header, tail
        frame._fields = {(f.on, f.name): f for f in fields}
        frame._owners = {}
        for kind, key in ((Set, "sets"), (Mesh, "meshes")):
            for meta in header[key]:
                frame._owners[meta["name"]] = kind(frame, meta, owners[meta["name"]])
        return frame

    def _put(self, field: Field) -> Field:
        self._fields.pop((field.on, field.name), None)
        self._fields[field.on, field.name] = field
        return field

    def _drop(self, on: str, name: str) -> None:
        del self._fields[on, name]
        self.limits.pop("%s/%s" % (on, name), None)

    @property
    def tail(self) -> dict[str, Any]:
        """The tail of docs/stream.md, without its checksums."""
        if self._tail_load is not None:
            self._tail, self._tail_load = self._tail_load(), None
        return self._tail

    @property
    def report(self) -> dict[str, Any]:
        """What the words report, by word: `frame.report["poisson-mg"]["iterations"]`."""
        return self.tail.setdefault("report", {})

    @property
    def limits(self) -> dict[str, Any]:
        """How fast change fields let their states decay, oscillate and strain [1/time], by OWNER/CHANGE."""
        return self.tail.get("limits", {})

    @property
    def dim(self) -> int:
        """1, 2 or 3."""
        return self.header["dim"]

    @property
    def law(self) -> str:
        """The name of the law: gravity, electrostatic, vortex, passive or free."""
        return self.header["law"]["name"]

    @property
    def constants(self) -> dict[str, float]:
        """The constants of the law by name (G, eps0, nu, softening ...); write to it to change them."""
        return self.header["law"].setdefault("constants", {})

    @property
    def scene(self) -> dict[str, Any]:
        """The initial condition: {"name": ..., "parameters": {...}}."""
        return self.header["scene"]

    def _set_time(self, key: str, value: Any) -> None:
        self.header[key] = value
        self.header.pop("since", None)  # time is counted from here on

    @property
    def time(self) -> float:
        """The time of all state [time]."""
        return float(self.header["time"])

    @time.setter
    def time(self, value: float) -> None:
        self._set_time("time", float(value))

    @property
    def dt(self) -> float:
        """The length of a step [time]."""
        return float(self.header["dt"])

    @dt.setter
    def dt(self, value: float) -> None:
        self._set_time("dt", float(value))

    @property
    def step(self) -> int:
        """Full steps done."""
        return self.header["step"]

    @step.setter
    def step(self, value: int) -> None:
        self._set_time("step", int(value))

    @property
    def substep(self) -> int:
        """Pushes done in the current step; 0 between steps."""
        return self.header["substep"]

    @property
    def seed(self) -> int:
        """The seed of the random numbers."""
        return self.header.get("seed", 0)

    @property
    def lo(self) -> np.ndarray:
        """The lower corner of the box [length], (dim,)."""
        return np.array(self.header["box"]["lo"], float)

    @property
    def hi(self) -> np.ndarray:
        """The upper corner of the box [length], (dim,)."""
        return np.array(self.header["box"]["hi"], float)

    @property
    def history(self) -> list[Any]:
        """One object per word that worked on the frame."""
        return self.header.setdefault("history", [])

    @property
    def sets(self) -> list[Set]:
        """The particle sets."""
        return [o for o in self._owners.values() if isinstance(o, Set)]

    @property
    def meshes(self) -> list[Mesh]:
        """The meshes."""
        return [o for o in self._owners.values() if isinstance(o, Mesh)]

    @property
    def fields(self) -> list[Field]:
        """All fields, in the order of the stream."""
        return list(self._fields.values())

    def __getitem__(self, name: str) -> Owner:
        return self._owners[name]

    def __contains__(self, name: object) -> bool:
        return name in self._owners

    def __iter__(self) -> Iterator[str]:
        return iter(self._owners)

    def keys(self) -> list[str]:
        """The names of the sets and meshes."""
        return list(self._owners)

    def owner(self, name: str) -> Owner:
        """The set or mesh of this name. Raises Error if there is none."""
        if name not in self._owners:
            raise Error("no set or mesh '%s' (there are: %s)" % (name, ", ".join(self._owners) or "none"))
        return self._owners[name]

    def _add(self, owner: Owner, fields: Fields) -> None:
        if owner.name in self._owners:
            raise Error("there is a set or mesh '%s' already" % owner.name, 2)
        self._owners[owner.name] = owner
        for name, value in fields.items():
            owner[name] = value

    def add_set(self, name: str, n: Optional[int] = None, **fields: Any) -> Set:
        """A new particle set, of n particles or as many as the first field has; fields: arrays (n,) or (n, components), or numbers for uniform ones."""
        arrays = {k: np.asarray(v) for k, v in fields.items()}
        n = n if n is not None else next((a.shape[0] for a in arrays.values() if a.ndim), 0)
        one = Set(self, {"name": name, "n": int(n), "done": {"kick": 0.0, "drift": 0.0}}, (int(n),))
        self._add(one, arrays)
        self.header["sets"].append(one.meta)
        return one

    def add_mesh(self, name: str, cells: Sequence[int], lo: Optional[Sequence[float]] = None, h: Optional[Sequence[float]] = None,
                 **fields: Any) -> Mesh:
        """A new mesh, over the box unless lo and h [length] are given; fields: arrays of the shape of its points."""
        low = self.lo if lo is None else np.array(lo, float)
        step = (self.hi - self.lo) / np.array(cells) if h is None else np.array(h, float)
        meta = {"name": name, "cells": [int(c) for c in cells], "lo": low.tolist(), "h": step.tolist()}
        _, shape = _header._mesh(meta, self.dim, self.header["box"]["fields"])
        one = Mesh(self, meta, shape)
        self._add(one, {k: np.asarray(v) for k, v in fields.items()})
        self.header["meshes"].append(one.meta)
        return one

    def reads(self, on: str, name: str) -> np.ndarray:
        """The array of a field, read-only. Raises Error if it is missing or a value is not finite."""
        field = self.owner(on).field(name)
        field.finite()
        return field.array

    def changes(self, on: str, name: str) -> np.ndarray:
        """The array of a field to write to. Raises Error if it is missing or a value is not finite."""
        self.reads(on, name)
        return self.owner(on).change(name)

    def makes(self, on: str, name: str, components: int = 1, role: str = "derived", **more: Any) -> np.ndarray:
        """The array, zero, of a new field (see Owner.make)."""
        return self.owner(on).make(name, components, role, **more).array

    def contributes(self, on: str, name: str, of: str, term: str) -> np.ndarray:
        """The array of a change field, the rate of the state `of`, to add the contribution `term` to; made of zeros if it is missing.

        Raises Error if it holds the term already: no force is counted twice.
        """
        owner, state = self.owner(on), self.owner(on).field(of)
        if name not in owner:
            return self.makes(on, name, state.components, "change", of=of, terms=[term])
        field = owner.field(name)
        terms = field.meta.get("terms", [])
        if field.meta["role"] != "change":
            raise Error("'%s' on '%s' has the role %s, not change (rename it)" % (name, on, field.meta["role"]))
        if term in terms:
            raise Error("'%s' on '%s' already holds the term '%s' (push clear drops it)" % (name, on, term))
        if field.components != state.components:
            raise Error("'%s' on '%s' has %d components, %d would be added" % (name, on, field.components, state.components))
        field.meta["terms"] = terms + [term]
        return self.changes(on, name)

    def parts(self) -> tuple[dict[str, Any], list[tuple[Any, int]], dict[str, Any]]:
        """Header, data with their checksums, and tail, as they are written. Raises Error if something is not finite."""
        self.header["fields"] = [f.meta for f in self.fields]
        data = [f.wire() for f in self.fields]
        owners = _header.shapes(self.header)
        for f, (d, _), size in zip(self.fields, data, _header.payload(self.header, owners)):
            if len(d) != size:
                raise Error("'%s' on '%s' has %d bytes, its header says %d" % (f.name, f.on, len(d), size))
        return self.header, data, {**self.tail, "crc32c": [crc for _, crc in data]}

    def load(self) -> Frame:
        """Reads all data and the tail, and compares every checksum; returns the frame. Raises Error if something is damaged."""
        for f in self.fields:
            f.planar
        self.tail
        return self

    def copy(self) -> Frame:
        """A frame of its own, which shares the arrays until they are changed."""
        header, tail = copy.deepcopy({**self.header, "fields": [f.meta for f in self.fields]}), copy.deepcopy(self.tail)
        fields = []
        for f, meta in zip(self.fields, header["fields"]):
            new = Field(meta, f.points, planar=f.planar.view())
            new._planar.flags.writeable, new._crc = False, f._crc
            fields.append(new)
        return Frame._of(header, {o.name: o.points for o in self._owners.values()}, fields, lambda: tail)

    def __repr__(self) -> str:
        return "<frame: %s, time %.6g, step %d; %s>" % (self.law, self.time, self.step, ", ".join(
            "%s %s" % (o.name, o.points) for o in self._owners.values()))


def payload_size(sizes: list[int]) -> int:
    """The bytes of all fields with their padding."""
    return sum(map(padded, sizes))
