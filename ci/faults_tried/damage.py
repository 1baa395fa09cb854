"""Ways in which a file is damaged. Each takes its path, where the whole file stands, and chance."""

import os
import re
import shutil
import stat

import h5py

from faults_tried.bench import listed


def empty(path, chance):
    path.write_bytes(b"")


def missing(path, chance):
    path.unlink()


def directory(path, chance):
    path.unlink()
    path.mkdir()


def half(path, chance):
    """Cut in the middle; TOML behind the next key's "=", where no whole table can end."""
    content = path.read_bytes()
    middle = len(content) // 2
    key = re.compile(rb"^\w+ = ", re.MULTILINE).search(content, middle) if path.suffix == ".toml" else None
    path.write_bytes(content[:key.end() if key else middle])


def last_byte(path, chance):
    path.write_bytes(path.read_bytes()[:-1])


def zeros(path, chance):
    path.write_bytes(bytes(path.stat().st_size))


def foreign(path, chance):
    """Another program's file of another kind."""
    path.write_bytes(b'{"format": "something else", "results": 3}\n')


def binary(path, chance):
    path.write_bytes(chance.randbytes(4096))


def unreadable_text(path, chance):
    path.write_bytes(b"\xff\xfe\x00\xd8" + path.read_bytes())


def fifo(path, chance):
    path.unlink()
    os.mkfifo(path)


def endless(path, chance):
    path.unlink()
    path.symlink_to("/dev/zero")


def null(path, chance):
    path.unlink()
    path.symlink_to("/dev/null")


def bound(path, chance):
    """A socket."""
    path.unlink()
    os.mknod(path, stat.S_IFSOCK | 0o600)


def to_nothing(path, chance):
    path.unlink()
    path.symlink_to(path.with_name("nothing at all"))


def to_itself(path, chance):
    path.unlink()
    path.symlink_to(path.name)


def flipped(path, chance):
    """One bit of one byte."""
    content = bytearray(path.read_bytes())
    content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    path.write_bytes(content)


def line_out(path, chance):
    lines = path.read_bytes().splitlines(keepends=True)
    if len(lines) > 2:
        del lines[chance.randrange(1, len(lines) - 1)]
    path.write_bytes(b"".join(lines))


def line_twice(path, chance):
    lines = path.read_bytes().splitlines(keepends=True)
    at = chance.randrange(len(lines))
    path.write_bytes(b"".join(lines[:at + 1] + lines[at:]))


def digit(path, chance):
    """Another digit in the place of one: a number that still reads as one."""
    content = bytearray(path.read_bytes())
    at = chance.choice([index for index, byte in enumerate(content) if byte in b"0123456789"])
    content[at] = chance.choice([byte for byte in b"123456789" if byte != content[at]])
    path.write_bytes(content)


def sparse(path, chance):
    """Grown to a size that no memory holds, and that takes no room on the disk: whoever reads all of it takes minutes."""
    os.truncate(path, 64 << 30)


def utf_16(path, chance):
    """A text as another system's editor leaves it."""
    path.write_bytes(path.read_bytes().decode("utf-8", "replace").encode("utf-16"))


DEPTH = 100_000  # of what is nested, where a parser may descend once for each
GROUPS = 2_000  # that lie in each other in an HDF5 file: each costs a thousand times what a bracket does


def deep(path, chance):
    """Arrays in arrays, groups in groups: in the place of a text, else beside what is there."""
    if path.suffix == ".h5":
        with h5py.File(path, "r+") as file:
            group = file
            for _ in range(GROUPS):
                group = group.create_group("t")
    else:
        begin = b"" if path.suffix == ".json" else b"a = "
        path.write_bytes(begin + b"[" * DEPTH + b"]" * DEPTH + b"\n")


def deep_tables(path, chance):
    """Inline tables in each other, objects in objects."""
    one = b'{"a":' if path.suffix == ".json" else b"{a = "
    path.write_bytes((b"" if path.suffix == ".json" else b"a = ") + one * DEPTH + b"1" + b"}" * DEPTH + b"\n")


def deep_key(path, chance):
    path.write_bytes(b"a" + b".a" * DEPTH + b" = 1\n")


def deep_header(path, chance):
    path.write_bytes(b"[[a" + b" . \"a\"" * DEPTH + b"]]\n")


def long_line(path, chance):
    """One cell of a table, one text, that has no end."""
    path.write_bytes(path.read_bytes() + b"9" * (1 << 20) + b"\n")


def is_still(path, content):
    """A sparse file is told by its size: nobody can read all of it."""
    return path.stat().st_size == len(content) and path.read_bytes() == content


BY_NAME = {way.__name__: way for way in (empty, missing, directory, half, last_byte, zeros, foreign, binary, unreadable_text, sparse, utf_16,
                                         fifo, endless, null, bound, to_nothing, to_itself, flipped, line_out, line_twice, digit,
                                         deep, deep_tables, deep_key, deep_header, long_line)}
NO_FILES = ("directory", "missing", "fifo", "endless", "null", "bound", "to_nothing", "to_itself")  # nothing to be read
BY_CHANCE = ("flipped", "line_out", "line_twice", "digit")  # another one every time


def copy_of(source, target):
    shutil.copytree(source, target, symlinks=True)
    return target


def of_entry(entry):
    """Name and way of every damage that an entry of the table lists."""
    return listed(entry, "damages", BY_NAME)
