"""A copy of the project with all faults in it, built once; kept up to date by writing only what differs."""

import functools
import os
import re
import subprocess
from collections import defaultdict
from pathlib import Path

from mutation import cpp
from mutation.listed import ListError


OWN_SWITCH = Path(__file__).with_name("switch.hpp")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
NAMES_OF_LAWS = "solver/scene/scene.hpp"
CALLERS = ("solver/closures/", "solver/operators/", "solver/run/")


def project_files(root):
    """What git knows and what is new and not ignored, as it stands in the working tree."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root, check=True,
                            stdout=subprocess.PIPE).stdout.decode()
    return [name for name in dict.fromkeys(listed.split("\0")) if name and (root / name).is_file()]


def content(root, name, faults, switched):
    """The bytes of a file of the copy. `faults`: (start, end, new, number) of each file; `switched`: the .cpp that take faults.
    ListError where a fault cannot be switched."""
    original = (root / name).read_bytes()
    try:
        if name in faults:
            text = original.decode()
            changed = cpp.switched(text, faults[name])
            return (changed if name.endswith(".cpp") else cpp.where_switched(text, changed)).encode()
        if name in switched:
            return cpp.after_first_comment(original.decode()).encode()
    except cpp.NoPlace as error:
        raise ListError(f"{name}: {error}") from error
    return original


def write(root, tree, places):
    """Makes `tree` the project with the faults of `places` ({mutant: (start, end, new)}) that are compiled; says how many files
    were written."""
    faults = defaultdict(list)
    for mutant, (start, end, new) in places.items():
        if mutant.compiled:
            faults[mutant.file].append((start, end, new, mutant.number))
    names = project_files(root)
    switched = {name for name in names if name.endswith(".cpp") and not faults.keys().isdisjoint(reached(root, name))}
    switch = tree / cpp.SWITCH
    if not switch.exists() or switch.read_bytes() != OWN_SWITCH.read_bytes():
        switch.parent.mkdir(parents=True, exist_ok=True)
        switch.write_bytes(OWN_SWITCH.read_bytes())
    written = 0
    for name in names:
        wanted, path = content(root, name, faults, switched), tree / name
        if path.exists() and path.read_bytes() == wanted:
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(wanted)
        path.chmod((root / name).stat().st_mode)
        written += 1
    known = {*names, cpp.SWITCH}
    for path in list(tree.rglob("*")):  # what the project no longer has
        relative = path.relative_to(tree)
        if path.is_file() and relative.parts[0] not in ("build", ".git") and "__pycache__" not in relative.parts and \
                relative.as_posix() not in known:
            path.unlink()
    return written


def reached(root, name):
    """A .cpp and the files of the project that it includes, those whose bodies it calls at least; what takes no fault comes from
    the compiler cache. (301 of 351 objects include a fault, and 140 take one.) scene.hpp names the laws of the model and their
    bodies stand in headers, but who is none of CALLERS calls none of them through it. A test calls what it includes itself;
    the rest is in the libraries. What is left out so goes unnoticed at worst."""
    found, due = set(), [name]
    while due:
        file = due.pop()
        if file in found:
            continue
        found.add(file)
        if (file != NAMES_OF_LAWS or name.startswith(CALLERS)) and ("/tests/" not in name or "/tests/" in file):
            due += [other for other in INCLUDE.findall(text_of(root / file)) if (root / other).exists()]
    return found


@functools.lru_cache(maxsize=None)
def text_of(path):
    return path.read_text(encoding="utf-8")


def build(tree, jobs, programs_alone=False):
    """Exit code of configuring and building the copy, with the flags of the project's own build: what has no fault in it comes
    from the compiler cache."""
    environment = {key: value for key, value in os.environ.items() if key != "GRANVOF_MUTANT"} | {"JOBS": str(jobs)}
    command = ["ci/build", *(["--programs"] if programs_alone else []), "release"]
    return subprocess.run(command, cwd=tree, env=environment).returncode


class Altered:
    """A file of the copy with one fault that is not compiled, for as long as the block lasts."""

    def __init__(self, tree, mutant, place):
        self.path = tree / mutant.file
        self.start, self.end, self.new = place

    def __enter__(self):
        self.original = self.path.read_bytes()
        text = self.original.decode()
        self.path.write_text(text[:self.start] + self.new + text[self.end:], encoding="utf-8")

    def __exit__(self, *_):
        self.path.write_bytes(self.original)
