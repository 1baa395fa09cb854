"""Opens what a run has left behind, or what others give: only what is a file. Opening a pipe waits for its other end, and a
device may have no end. Writes results whole or not at all."""

import contextlib
import csv
import errno
import json
import os
import re
import stat
import tomllib
from pathlib import Path


class NotAFile(OSError):
    """A name that is no regular file, or one too large to be ours, or an HDF5 file that leads to one; says which, and what it is."""


# What reading a file that others wrote may raise: no such values, of another kind or shape, too many of them.
OF_READING = (OSError, ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RuntimeError, MemoryError, csv.Error)

MOST_BYTES = 1 << 31  # of a file read at once, as solver/output/atomic_file.cpp: one with holes takes no room where it lies
KINDS = ((stat.S_ISDIR, "a directory"), (stat.S_ISFIFO, "a pipe"), (stat.S_ISSOCK, "a socket"), (stat.S_ISCHR, "a device"),
         (stat.S_ISBLK, "a device"))


def _name_of(mode):
    return next((name for of_kind, name in KINDS if of_kind(mode)), "something else")


def required(path):
    """The path, as it was given, for libraries that open by name (others take opened()). NotAFile where something else than a
    regular file has that name; where nothing has it, FileNotFoundError or what else the system says."""
    mode = os.stat(path).st_mode
    if not stat.S_ISREG(mode):
        raise NotAFile(f"it is {_name_of(mode)}, not a file")
    return path


def _open_regular(path, flags):
    """For open(): waits for nobody, and what a name stands for is asked of what was opened: it may be another's a moment later."""
    descriptor = os.open(path, flags | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY)
    found = os.fstat(descriptor)
    if stat.S_ISREG(found.st_mode) and found.st_size <= MOST_BYTES:
        return descriptor
    os.close(descriptor)
    if stat.S_ISREG(found.st_mode):
        raise NotAFile(f"it has {found.st_size} bytes, more than {MOST_BYTES}")
    raise NotAFile(f"it is {_name_of(found.st_mode)}, not a file")


def opened(path, mode="r", **form):
    """open() for reading, of a regular file and nothing else; raises as required()."""
    try:
        return open(path, mode, opener=_open_regular, **form)
    except OSError as error:
        if error.errno == errno.ENXIO:  # a socket
            required(path)
        raise


def text_of(path, encoding="utf-8"):
    with opened(path, encoding=encoding) as file:
        return file.read()


def bytes_of(path):
    with opened(path, "rb") as file:
        return file.read()


def no_program(path, made_by="`make build` builds it"):
    """Why a file is no program that can be started, in a sentence; empty where it is one."""
    path = Path(path)
    try:
        with opened(path, "rb") as file:
            begins = file.read(4)
    except FileNotFoundError:
        return f"{path} is missing; {made_by}"
    except OSError as error:
        return f"{path} is no program: {error.strerror or error}; {made_by}"
    if not os.access(path, os.X_OK) or not begins.startswith((b"\x7fELF", b"#!")):
        return f"{path} is no program; {made_by}"
    return ""


def json_of(path):
    """What a JSON file holds; raises as required() and the parser do."""
    return json_in(text_of(path))


HALF_CHARACTER = re.compile(r"\\u[dD][89a-fA-F]")  # of two, or alone, which is none and cannot be written


def json_in(text):
    """ValueError where it is none, nested deeper than the parser can follow, or holds what is no character."""
    try:
        content = json.loads(text)
        if HALF_CHARACTER.search(text):
            json.dumps(content, ensure_ascii=False).encode()
        return content
    except RecursionError:
        raise ValueError("it is nested too deeply") from None


MOST_KEY_PARTS = 64  # as solver/scene/key_parts.hpp
NO_KEY = re.compile(r"""\"(?:\\.|[^"\\\n])*"|'[^'\n]*'|#.*""")  # texts in quotes, comments
KEYS = re.compile(r"[\w. \t-]+")


def toml_of(path):
    """What a TOML file holds; raises as required() and the parser do."""
    return toml_in(text_of(path))


def toml_in(text):
    """ValueError where it is none, or deeper than the parser can follow."""
    if not isinstance(text, str):
        raise ValueError(f"{type(text).__name__} given, not a text")
    if any(run.group().count(".") >= MOST_KEY_PARTS for run in KEYS.finditer(NO_KEY.sub("_", text))):
        raise ValueError(f"a key of more than {MOST_KEY_PARTS} parts")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError("it is nested too deeply") from None


def write_whole(path, content):
    """Text or bytes into a file whose name appears, or changes its content, only when all of it is written: on a full disk
    what was there stays. The folder is made. OSError where it cannot be written, NotAFile where no file has that name."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    if is_there(path):
        required(path)
    draft = path.with_name(path.name + ".part")
    try:
        draft.write_bytes(content if isinstance(content, bytes) else content.encode())
        draft.replace(path)
    except OSError:
        draft.unlink(missing_ok=True)
        raise


def write_json(path, content, **form):
    write_whole(path, json.dumps(content, **(form or {"indent": 1})) + "\n")


def is_there(path):
    """Whether something has that name, be it a link to nothing: what is there must be read or refused, not left out."""
    return os.path.lexists(path)


@contextlib.contextmanager
def fields_of(path):
    """An HDF5 file, open for reading, of which nothing leads elsewhere but groups that are the file of an instant beside it
    (fields/tNNNN.h5). NotAFile where something does; OSError, KeyError, RuntimeError where it is damaged."""
    import h5py  # here: not every reader of files has it

    path = Path(path)
    with h5py.File(required(path), "r", locking=False) as file:
        for name in file:
            link = file.get(name, getlink=True)
            if isinstance(link, h5py.ExternalLink):
                if link.filename != f"fields/{name}.h5":
                    raise NotAFile(f"{name} links to {link.filename}, allowed: fields/{name}.h5")
                with h5py.File(required(path.parent / link.filename), "r", locking=False) as piece:
                    _require_inside(piece, h5py)
            else:
                _require_member_inside(file, name, h5py)
        yield file


def values_of(dataset):
    """The values of a field (z, y, x) or of vectors (z, y, x, 3). ValueError where it is none; as much as it says must fit into
    memory, else MemoryError."""
    shape = getattr(dataset, "shape", None)
    if shape is None or len(shape) not in (3, 4) or 0 in shape or dataset.dtype.kind != "f":
        raise ValueError(f"{dataset.name} is no field of numbers (z, y, x)")
    return dataset[...]


def _require_inside(group, h5py):
    for name in group:
        _require_member_inside(group, name, h5py)


def _require_member_inside(group, name, h5py):
    if isinstance(group.get(name, getlink=True), h5py.ExternalLink):
        raise NotAFile(f"{name} lies in another file")
    member = group[name]
    if isinstance(member, h5py.Group):
        _require_inside(member, h5py)
    elif isinstance(member, h5py.Dataset) and (member.is_virtual or member.external):
        raise NotAFile(f"the values of {name} lie in another file")
