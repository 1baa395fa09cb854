"""Where faults are tried: the programs, a place to work, and what every end of a program must keep to."""

import os
import random
import signal
import subprocess
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

SAMPLE = 12  # tries of an entry in a sample
LONGEST_MESSAGE = 2000  # characters
PATIENCE = 60.0  # seconds for a program that has nothing to compute


class TableError(Exception):
    """What is wrong with the table, in one line."""


def read_table(path, kinds):
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise TableError(f"{path}: {' '.join(str(error).split())}") from error
    for kind, entries in table.items():
        if kind not in kinds or not isinstance(entries, list):
            raise TableError(f"{path}: [[{kind}]] is no kind of fault; known: {', '.join(sorted(kinds))}")
    if not table:
        raise TableError(f"{path}: there is nothing in it")
    return table


@dataclass
class Bench:
    build: Path
    root: Path
    work: Path
    sample: bool
    chance: random.Random = field(default_factory=lambda: random.Random(1))  # the same tries every time
    made: int = 0

    def __post_init__(self):
        for program in (self.granvof, self.compare):
            if not program.exists():
                raise TableError(f"{program} is missing; `make build` builds it")

    @property
    def granvof(self):
        return self.build / "solver/granvof"

    @property
    def compare(self):
        return self.build / "compare/granvof-compare"

    def some(self, tries):
        tries = list(tries)
        return self.chance.sample(tries, SAMPLE) if self.sample and len(tries) > SAMPLE else tries

    def place(self):
        """A new empty directory."""
        self.made += 1
        directory = self.work / f"{self.made:05}"
        directory.mkdir()
        return directory

    def filled(self, command, **places):
        """The command of the table with {granvof}, {compare} and further places filled in."""
        return [part.format(granvof=self.granvof, compare=self.compare, **places) for part in command]

    def call(self, command, **options):
        environment = {**os.environ, **options.pop("environment", {})}
        try:
            return subprocess.run([str(part) for part in command], cwd=self.root, stdin=subprocess.DEVNULL,
                                  stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE,
                                  timeout=options.pop("patience", PATIENCE), env=environment, **options)
        except subprocess.TimeoutExpired:
            return None


def refused(ended):
    """Why a refusal is none; empty where it is one: exit code 2, one bounded line on stderr, no crash."""
    if ended is None:
        return f"not done after {PATIENCE:g} s"
    said = ended.stderr.decode(errors="replace")
    if ended.returncode < 0:
        return f"ended by {signal.Signals(-ended.returncode).name}"
    if ended.returncode != 2:
        return f"exit code {ended.returncode}"
    if not said.strip():
        return "no message on stderr"
    if "Traceback" in said or len(said) > LONGEST_MESSAGE:
        return f"a message of {len(said)} characters: {said[:80]!r}"
    if any(ord(letter) < 32 and letter not in "\n\t" for letter in said):
        return f"a control character in the message: {said[:80]!r}"
    return ""
