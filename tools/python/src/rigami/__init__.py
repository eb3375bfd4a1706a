"""Folds origami crease patterns as rigid plates: librigami for NumPy.

    import rigami
    pattern = rigami.Pattern.read("miura.opx")
    for state in rigami.Fold(pattern):
        print(state.progress, state.angles)

Angles are in radians, valley positive. Arrays that come out are views of the library's own memory, not to be written
to; each keeps what it belongs to alive. Those of a Fold show its present state and hold until it is moved: copy what is
to be kept. Structs such as Motion.report keep their owner alive as arrays do, but what they point to does not: hold
the object itself for that. Arrays that go in are used where they are, if they are of the right type (float64, int32)
and in one piece. `lib` and `ffi` are the whole C face, see rigami.h."""
import os

import numpy as np

from ._face import ffi, lib

__all__ = ["Error", "Fold", "FREE", "Motion", "Pattern", "Snapshot", "Tangent", "convert", "ffi", "lib", "version"]

FREE = lib.RG_FREE
version = ffi.string(lib.rg_version()).decode()


class Error(Exception):
    """A status that is not RG_OK: .status its name, .line of the input file or 0."""

    def __init__(self, status, why=None):
        self.status = ffi.string(ffi.cast("rg_status", status))
        self.line = why.line if why else 0
        words = ffi.string(why.text).decode(errors="replace") if why else ""
        words = words or ffi.string(lib.rg_status_text(status)).decode()
        super().__init__(f"line {self.line}: {words}" if self.line else words)


def _check(status, why=None):
    if status == lib.RG_ENOMEM:
        raise MemoryError
    if status != lib.RG_OK:
        raise Error(status, why)


class _Lent:
    """Memory of the library as NumPy asks for it; holds its owner as long as an array looks at it."""

    def __init__(self, pointer, shape, kind, owner):
        self.owner = owner
        self.__array_interface__ = {"version": 3, "shape": shape, "typestr": np.dtype(kind).str,
                                    "data": (int(ffi.cast("uintptr_t", pointer)), True)}


def _view(pointer, shape, kind, owner):
    if pointer == ffi.NULL or 0 in shape:
        return np.zeros(shape, kind)
    return np.asarray(_Lent(pointer, shape, kind, owner))


def _held(struct, owner):
    """A struct that the library lends; holds its owner as long as somebody looks at it."""
    return ffi.gc(struct, lambda _: owner)


def _text(words):
    """A string or a path as C takes it, to its end."""
    words = os.fsencode(words) if isinstance(words, os.PathLike) else words
    words = words.encode(errors="surrogateescape") if isinstance(words, str) else words
    if b"\0" in words:
        raise ValueError("embedded null byte")
    return words


def _array(x, kind, ctype, *shape):
    """An array as C takes it: (the array, which must outlive the call, and its pointer)."""
    given = np.asarray(x)
    x = np.ascontiguousarray(given, kind)
    if np.issubdtype(x.dtype, np.integer) and not np.array_equal(x, given):
        raise ValueError(f"whole numbers of {8 * x.itemsize} bits are asked for")
    if x.ndim != len(shape) or any(want is not None and want != has for want, has in zip(shape, x.shape)):
        raise ValueError(f"an array of shape {shape} is asked for, not {x.shape}")
    return x, ffi.cast(ctype, ffi.from_buffer(x))


def _fill(struct, keep, options):
    """Options by the names of the struct's members; of an enum by the end of a value's name: method="rk4"."""
    kind = ffi.typeof(struct)
    fields = dict((kind if kind.kind == "struct" else kind.item).fields)
    for name, value in options.items():
        if name not in fields or name in ("size", "memory", "progress", "progress_ctx"):
            raise TypeError(f"there is no option {name}")
        kind = fields[name].type
        if kind.kind == "enum" and isinstance(value, str):
            ends = [(label, number) for number, label in kind.elements.items() if label.endswith("_" + value.upper())]
            if not ends:
                raise ValueError(f"{name} is one of {', '.join(kind.elements.values())}")
            value = min(ends, key=lambda end: len(end[0]))[1]
        elif isinstance(value, str):
            value = ffi.new("char[]", _text(value))
            keep.append(value)
        setattr(struct, name, value)
    return struct


def _made(kind, options):
    """A struct of options at their defaults but for these, and what must live as long as it."""
    keep = []
    struct = ffi.new(kind + " *")
    getattr(lib, kind + "_init")(struct, ffi.sizeof(kind))
    return _fill(struct, keep, options), keep


@ffi.def_extern()
def rigami_watch(ctx, progress):
    """What the library asks as it goes on: the caller's function, whose true answer or exception ends it."""
    box = ffi.from_handle(ctx)
    try:
        return 1 if box["progress"](progress) else 0
    except BaseException as e:
        box["raised"] = e
        return 1


class _Watched:
    def __init__(self, progress):
        self.box = {"progress": progress, "raised": None}
        self.handle = ffi.new_handle(self.box)
        self.arguments = (lib.rigami_watch, self.handle) if progress else (ffi.NULL, ffi.NULL)

    def end(self):
        if self.box["raised"] is not None:
            raise self.box["raised"]


@ffi.def_extern(error=1)
def rigami_take(ctx, data, size):
    ffi.from_handle(ctx).append(bytes(ffi.buffer(data, size)))
    return 0


def _written(call, *before, after=()):
    """The bytes that a writer gives to a sink."""
    parts = []
    handle = ffi.new_handle(parts)
    sink = ffi.new("rg_sink *", {"write": lib.rigami_take, "ctx": handle})
    why = ffi.new("rg_diag *")
    _check(call(*before, sink, *after, why), why)
    return b"".join(parts)


class Pattern:
    """A crease pattern as a plane graph: what was drawn, merged and split. Options are the members of rg_reading."""

    def __init__(self, handle):
        self._handle = ffi.gc(handle, lib.rg_pattern_destroy)
        self.info = _held(lib.rg_pattern_get_info(self._handle), self._handle)

    @classmethod
    def _from(cls, call, *arguments, **options):
        reading, keep = _made("rg_reading", options)
        out, why = ffi.new("rg_pattern **"), ffi.new("rg_diag *")
        _check(call(*arguments, reading, out, why), why)
        return cls(out[0])

    @classmethod
    def read(cls, path, **options):
        """From a file: .opx, .cp, .fold, .svg, .dxf or .ori."""
        return cls._from(lib.rg_pattern_read, _text(path), **options)

    @classmethod
    def parse(cls, data, **options):
        """From the bytes of such a file."""
        data = data.encode() if isinstance(data, str) else data
        return cls._from(lib.rg_pattern_parse, ffi.from_buffer(data), len(data), **options)

    @classmethod
    def generate(cls, kind, n=0, m=0, angle=0.0, **options):
        """An example, such as ("miura", 8, 8)."""
        return cls._from(lib.rg_generate_pattern, _text(kind), n, m, angle, **options)

    @classmethod
    def from_arrays(cls, vertices, edges, assignment, targets=None, title=None, **options):
        """vertices (n, 2), edges (m, 2) numbers of vertices, assignment m letters BMVUFC, targets m radians: nan by
        assignment, FREE."""
        x, at = _array(vertices, np.float64, "double (*)[2]", None, 2)
        e, ends = _array(edges, np.int32, "int32_t (*)[2]", None, 2)
        letters = assignment.encode() if isinstance(assignment, str) else bytes("".join(assignment), "ascii")
        if len(letters) != len(e):
            raise ValueError("as many letters as edges")
        drawing, keep = _made("rg_drawing", {} if title is None else {"title": title})
        letter = ffi.from_buffer(letters)
        drawing.vertices, drawing.at, drawing.edges, drawing.ends = len(x), at, len(e), ends
        drawing.assignment = ffi.cast("const char *", letter)
        if targets is not None:
            t, drawing.target = _array(targets, np.float64, "double *", len(e))
        return cls._from(lib.rg_pattern_create, drawing, **options)

    def _plane(self):
        return lib.rg_pattern_get_plane(self._handle)

    @property
    def vertices(self):
        q = self._plane()
        return _view(q.at, (q.vertices, 2), np.float64, self)

    @property
    def edges(self):
        q = self._plane()
        return _view(q.ends, (q.edges, 2), np.int32, self)

    @property
    def assignment(self):
        q = self._plane()
        return bytes(ffi.buffer(q.assignment, q.edges)).decode()

    @property
    def targets(self):
        q = self._plane()
        return _view(q.target, (q.edges,), np.float64, self)

    @property
    def facets(self):
        q = self._plane()
        return _facets(q, self)

    @property
    def warnings(self):
        out = ffi.new("const rg_diag **")
        count = lib.rg_pattern_warnings(self._handle, out)
        return [(out[0][i].line, ffi.string(out[0][i].text).decode()) for i in range(count)]

    def edge_at(self, x, y):
        """The edge nearest to a point, -1: none."""
        return lib.rg_pattern_edge_at(self._handle, [x, y])

    def edge_between(self, v, w):
        return lib.rg_pattern_edge_between(self._handle, v, w)

    def set_target(self, edge, radians):
        """What the crease on an edge aims at when it is folded next; FREE: nothing."""
        _check(lib.rg_pattern_set_target(self._handle, edge, radians))

    def pin(self, edge):
        _check(lib.rg_pattern_pin(self._handle, edge))


def _facets(q, owner):
    """A list of facets, each a view of its vertices, counter-clockwise."""
    start = _view(q.facet_start, (q.facets + 1,), np.int32, owner) if q.facets else [0]
    vertex = _view(q.facet_vertex, (int(start[-1]),), np.int32, owner)
    return [vertex[start[f] : start[f + 1]] for f in range(q.facets)]


class _Sheet:
    """What a motion and a fold have in common: the sheet that is folded."""

    def _sheet(self):
        return lib.rg_motion_get_sheet(self._motion)

    @property
    def flat(self):
        """Vertices in the pattern, (n, 2)."""
        q = self._sheet()
        return _view(q.flat, (q.vertices, 2), np.float64, self)

    @property
    def facets(self):
        return _facets(self._sheet(), self)

    @property
    def triangles(self):
        """What facets are drawn as, (n, 3) vertices: for plot_trisurf and others."""
        q = self._sheet()
        return _view(q.triangle, (q.triangles, 3), np.int32, self)

    @property
    def edges(self):
        q = self._sheet()
        return _view(q.ends, (q.edges, 2), np.int32, self)

    @property
    def crease_edge(self):
        """Edge of each crease; edges of the pattern keep their numbers, those of added creases come last."""
        q = self._sheet()
        return _view(q.crease_edge, (q.creases,), np.int32, self)

    @property
    def edge_crease(self):
        q = self._sheet()
        return _view(q.edge_crease, (q.edges,), np.int32, self)

    def crease_at(self, x, y):
        """The crease nearest to a point of the pattern, -1: none."""
        return lib.rg_motion_crease_at(self._motion, [x, y])

    def crease_between(self, v, w):
        return lib.rg_motion_crease_between(self._motion, v, w)


class Motion(_Sheet):
    """A whole motion, frame by frame. Options are the members of rg_settings."""

    def __init__(self, pattern, progress=None, **options):
        settings, keep = _made("rg_settings", options)
        out, why, watched = ffi.new("rg_motion **"), ffi.new("rg_diag *"), _Watched(progress)
        status = lib.rg_motion_create(pattern._handle, settings, *watched.arguments, out, why)
        self._motion = ffi.gc(out[0], lib.rg_motion_destroy) if status == lib.RG_OK else None
        watched.end()
        _check(status, why)

    @classmethod
    def _of(cls, handle, owner=None):
        self = cls.__new__(cls)
        self._motion = handle if owner else ffi.gc(handle, lib.rg_motion_destroy)
        self._owner = owner
        return self

    @classmethod
    def driven(cls, pattern, angles, progress=None, **options):
        """Only some creases are driven: {edge of the pattern: radians}."""
        settings, keep = _made("rg_settings", options)
        out, why, watched = ffi.new("rg_motion **"), ffi.new("rg_diag *"), _Watched(progress)
        driven = ffi.new("rg_driven[]", list(angles.items()))
        status = lib.rg_motion_create_driven(pattern._handle, len(angles), driven, settings, *watched.arguments, out,
                                             why)
        self = cls._of(out[0]) if status == lib.RG_OK else None
        watched.end()
        _check(status, why)
        return self

    @classmethod
    def read(cls, path, **options):
        """One that was written as .fold before."""
        reading, keep = _made("rg_reading", options)
        out, why = ffi.new("rg_motion **"), ffi.new("rg_diag *")
        _check(lib.rg_motion_read(_text(path), reading, out, why), why)
        return cls._of(out[0])

    @property
    def report(self):
        """rg_report as it is, for its members."""
        return _held(lib.rg_motion_report(self._motion), self)

    @property
    def outcome(self):
        names = {lib.RG_FOLDED: "folded", lib.RG_STOPPED: "stopped", lib.RG_RESTS: "rests"}
        return names.get(self.report.outcome, "running")

    @property
    def reason(self):
        return ffi.string(self.report.reason).decode()

    def __len__(self):
        return self.report.frame_count

    @property
    def path(self):
        """Fold angles of all frames, (frames, creases)."""
        return _view(lib.rg_motion_angles(self._motion, 0), (len(self), self._sheet().creases), np.float64, self)

    @property
    def percent(self):
        """Folded percent of all frames."""
        frames = self.report.frames
        return _view(frames, (len(self), ffi.sizeof("rg_frame") // 8), np.float64, self)[:, 0]

    def mobility(self, frame=-1):
        """How many ways the sheet could go from there, to first order."""
        ways = ffi.new("int32_t *")
        _check(lib.rg_motion_mobility(self._motion, range(len(self))[frame], ways))
        return ways[0]

    def angles(self, frame):
        rho = lib.rg_motion_angles(self._motion, range(len(self))[frame])
        return _view(rho, (self._sheet().creases,), np.float64, self)

    def positions(self, frame):
        """Where the vertices are, (n, 3): made for this call."""
        x = np.empty((self._sheet().vertices, 3))
        _check(lib.rg_motion_pose(self._motion, range(len(self))[frame], ffi.cast("double (*)[3]", ffi.from_buffer(x))))
        return x

    def tangent(self, frame):
        out = ffi.new("rg_tangent **")
        _check(lib.rg_motion_tangent(self._motion, range(len(self))[frame], out))
        return Tangent(out[0])

    def draw(self, frame=-1, **options):
        """A picture, (height, width, 3) bytes. Options are the members of rg_picture."""
        picture, keep = _made("rg_picture", options)
        rgb, why = np.empty((picture.height, picture.width, 3), np.uint8), ffi.new("rg_diag *")
        pixels = ffi.cast("unsigned char *", ffi.from_buffer(rgb))
        _check(lib.rg_motion_draw(self._motion, range(len(self))[frame], picture, pixels, why), why)
        return rgb

    def write(self, path, **options):
        """In the form that the path's extension asks for. Options are the members of rg_picture."""
        picture, keep = _made("rg_picture", options)
        why = ffi.new("rg_diag *")
        _check(lib.rg_motion_write(self._motion, _text(path), picture, why), why)

    def _repr_png_(self):
        """What a notebook shows: the last frame."""
        return self.to_bytes(".png", width=480, height=360)

    def to_bytes(self, form, frame=-1, **options):
        """The same to memory; form: an extension, such as ".glb"."""
        picture, keep = _made("rg_picture", options)
        return _written(lib.rg_motion_write_to, self._motion, _text(form), frame, after=(picture,))


class Snapshot:
    """A state of a fold that was kept."""

    def __init__(self, handle):
        self._handle = ffi.gc(handle, lib.rg_snapshot_destroy)


class Fold(_Sheet):
    """A fold that the caller moves, in one thread at a time: the interpreter is let go while it does. Options are the
    members of rg_settings; flat=True: looks for no motion, to be driven."""

    def __init__(self, pattern, progress=None, flat=False, **options):
        settings, keep = _made("rg_settings", options)
        out, why, watched = ffi.new("rg_fold **"), ffi.new("rg_diag *"), _Watched(progress)
        if flat:
            status = lib.rg_fold_create_flat(pattern._handle, settings, out, why)
        else:
            status = lib.rg_fold_create(pattern._handle, settings, *watched.arguments, out, why)
        if status == lib.RG_OK:
            self._hold(out[0])
        watched.end()
        _check(status, why)

    def _hold(self, handle):
        self._handle = ffi.gc(handle, lib.rg_fold_destroy)
        self._motion = lib.rg_fold_motion(self._handle)

    @property
    def motion(self):
        """The motion that was found, with its report."""
        return Motion._of(self._motion, owner=self)

    @property
    def info(self):
        """rg_step_info as it is, for its members."""
        return _held(lib.rg_fold_get_info(self._handle), self)

    @property
    def progress(self):
        return self.info.progress

    @property
    def frame(self):
        return self.info.frame

    @property
    def running(self):
        return self.info.outcome == lib.RG_RUNNING

    @property
    def reason(self):
        return ffi.string(self.info.reason).decode()

    def step(self):
        """On to the next state; whether there is more to come."""
        return lib.rg_fold_step(self._handle).outcome == lib.RG_RUNNING

    def step_back(self):
        lib.rg_fold_step_back(self._handle)

    def __iter__(self):
        """The present state and all that follow it: the fold itself, moved on."""
        yield self
        while self.running:
            self.step()
            yield self

    def go_to(self, percent):
        _check(lib.rg_fold_go_to(self._handle, percent))

    def go_to_angle(self, crease, radians):
        _check(lib.rg_fold_go_to_angle(self._handle, crease, radians))

    def drive(self, angles):
        """{crease: radians}: each turns evenly there with the steps that follow, all others follow by the least
        motion, eq. (9)."""
        creases, where = _array(list(angles.keys()), np.int32, "int32_t *", None)
        radians, to = _array(list(angles.values()), np.float64, "double *", None)
        _check(lib.rg_fold_drive(self._handle, len(creases), where, to))

    def set_target(self, crease, radians):
        _check(lib.rg_fold_set_target(self._handle, crease, radians))

    def free(self, crease):
        self.set_target(crease, FREE)

    def pin(self, crease):
        _check(lib.rg_fold_pin(self._handle, crease))

    def forget(self):
        """The present state becomes the first of the track."""
        _check(lib.rg_fold_forget(self._handle))

    @property
    def angles(self):
        n = ffi.new("int32_t *")
        rho = lib.rg_fold_angles(self._handle, n)
        return _view(rho, (n[0],), np.float64, self)

    @property
    def positions(self):
        n = ffi.new("int32_t *")
        x = lib.rg_fold_positions(self._handle, n)
        return _view(x, (n[0], 3), np.float64, self)

    @property
    def transforms(self):
        """Where each facet goes, (facets, 4, 3): rows 0 to 2 are the columns of R, row 3 is t."""
        n = ffi.new("int32_t *")
        t = lib.rg_fold_transforms(self._handle, n)
        return _view(t, (n[0], 4, 3), np.float64, self)

    def snapshot(self):
        out = ffi.new("rg_snapshot **")
        _check(lib.rg_fold_snapshot(self._handle, out))
        return Snapshot(out[0])

    def restore(self, snapshot):
        _check(lib.rg_fold_restore(self._handle, snapshot._handle))

    def clone(self):
        out = ffi.new("rg_fold **")
        _check(lib.rg_fold_clone(self._handle, out))
        other = Fold.__new__(Fold)
        other._hold(out[0])
        return other

    def record(self):
        """The track so far as a motion of its own."""
        out, why = ffi.new("rg_motion **"), ffi.new("rg_diag *")
        _check(lib.rg_fold_record(self._handle, out, why), why)
        return Motion._of(out[0])

    def tangent(self):
        out = ffi.new("rg_tangent **")
        _check(lib.rg_fold_tangent(self._handle, out))
        return Tangent(out[0])

    def draw(self, **options):
        """A picture of the present state, (height, width, 3) bytes. Options are the members of rg_picture."""
        picture, keep = _made("rg_picture", options)
        rgb, why = np.empty((picture.height, picture.width, 3), np.uint8), ffi.new("rg_diag *")
        _check(lib.rg_fold_draw(self._handle, picture, ffi.cast("unsigned char *", ffi.from_buffer(rgb)), why), why)
        return rgb


class Tangent:
    """The linear algebra of one state: C and what it leaves free."""

    def __init__(self, handle):
        self._handle = ffi.gc(handle, lib.rg_tangent_destroy)
        self.info = _held(lib.rg_tangent_get_info(self._handle), self._handle)
        self.shape = (self.info.rows, self.info.columns)

    @property
    def csr(self):
        """C as scipy.sparse.csr_array takes it: (value, column, row_start)."""
        q = self.info
        start = _view(q.row_start, (q.rows + 1,), np.int32, self)
        n = int(start[-1])
        return _view(q.value, (n,), np.float64, self), _view(q.column, (n,), np.int32, self), start

    @property
    def residual(self):
        """By interior vertex, (M, 3), eqs. (12), (13)."""
        return _view(self.info.residual, (self.info.rows // 3, 3), np.float64, self)

    def project(self, wish):
        """The nearest velocity that the facets allow, eq. (9)."""
        wish, given = _array(wish, np.float64, "double *", self.shape[1])
        step = np.empty(self.shape[1])
        _check(lib.rg_tangent_project(self._handle, given, ffi.cast("double *", ffi.from_buffer(step)), ffi.NULL))
        return step

    @property
    def basis(self):
        """An orthonormal basis of the infinitesimal motions, (freedoms, creases)."""
        n, out = ffi.new("int32_t *"), ffi.new("const double **")
        _check(lib.rg_tangent_basis(self._handle, n, out))
        return _view(out[0], (n[0], self.shape[1]), np.float64, self)


@ffi.def_extern()
def rigami_warn(ctx, warning):
    ffi.from_handle(ctx).append(ffi.string(warning.text).decode())


def convert(path, out, **options):
    """One crease pattern file to another; what the output cannot hold comes back as a list of texts. Options: of
    rg_reading."""
    told, reading = [], _made("rg_reading", options)
    why = ffi.new("rg_diag *")
    handle = ffi.new_handle(told)
    _check(lib.rg_convert(_text(path), _text(out), lib.RG_FORMAT_AUTO, reading[0], lib.rigami_warn, handle, why), why)
    return told
