"""A copy of the project with all faults in it, built once; kept up to date by writing only what differs."""

import os
import subprocess
from collections import defaultdict
from pathlib import Path

from mutation import cpp
from mutation.listed import ListError


OWN_SWITCH = Path(__file__).with_name("switch.hpp")


def project_files(root):
    """What git knows and what is new and not ignored, as it stands in the working tree."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root, check=True,
                            stdout=subprocess.PIPE).stdout.decode()
    return [name for name in dict.fromkeys(listed.split("\0")) if name and (root / name).is_file()]


def content(root, name, faults):
    """The bytes of a file of the copy. ListError where a fault cannot be switched."""
    original = (root / name).read_bytes()
    if name not in faults:
        return original
    try:
        return cpp.switched(original.decode(), faults[name]).encode()
    except cpp.NoPlace as error:
        raise ListError(f"{name}: {error}") from error


def write(root, tree, places):
    """Makes `tree` the project with the faults of `places` ({mutant: (start, end, new)}) that are compiled; says how many files
    were written."""
    faults = defaultdict(list)
    for mutant, (start, end, new) in places.items():
        if mutant.compiled:
            faults[mutant.file].append((start, end, new, mutant.number))
    names = project_files(root)
    switch = tree / cpp.SWITCH
    if not switch.exists() or switch.read_bytes() != OWN_SWITCH.read_bytes():
        switch.parent.mkdir(parents=True, exist_ok=True)
        switch.write_bytes(OWN_SWITCH.read_bytes())
    written = 0
    for name in names:
        wanted, path = content(root, name, faults), tree / name
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


def build(tree, jobs, programs_alone=False):
    """Exit code of configuring and building the copy. Faults make odd code: warnings are no errors there."""
    environment = {key: value for key, value in os.environ.items() if key not in ("CI", "GRANVOF_MUTANT")} | {"JOBS": str(jobs)}
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
