"""Ways in which a file is damaged. Each takes its path, where the whole file stands, and chance."""

import os
import re
import shutil
import stat

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


BY_NAME = {way.__name__: way for way in (empty, missing, directory, half, last_byte, zeros, foreign, binary, unreadable_text,
                                         fifo, endless, null, bound, to_nothing, to_itself, flipped, line_out, line_twice, digit)}
NO_FILES = ("directory", "missing", "fifo", "endless", "null", "bound", "to_nothing", "to_itself")  # nothing to be read
BY_CHANCE = ("flipped", "line_out", "line_twice", "digit")  # another one every time


def copy_of(source, target):
    shutil.copytree(source, target, symlinks=True)
    return target


def of_entry(entry):
    """Name and way of every damage that an entry of the table lists."""
    return listed(entry, "damages", BY_NAME)
