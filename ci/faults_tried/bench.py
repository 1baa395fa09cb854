"""Where faults are tried: the programs, a place to work, and what every end of a program must keep to."""

import os
import random
import shutil
import signal
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from granvof_files import no_program, toml_of
from night.together import ends_with_parent

SAMPLE = 4  # tries of an entry in a sample
LONGEST_MESSAGE = 2000  # characters
PATIENCE = 60.0  # seconds for a program that has nothing to compute


class TableError(Exception):
    """What is wrong with the table, in one line."""


def listed(entry, key, known):
    """Name and meaning of all that an entry of the table lists under a key; TableError for a name that is not known."""
    for name in entry[key]:
        if name not in known:
            raise TableError(f"{key}: '{name}' given; known: {', '.join(known)}")
        yield name, known[name]


class NotTried(Exception):
    """Why a kind cannot be tried on this machine, in one line."""


def read_table(path, kinds):
    try:
        table = toml_of(path)
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
    part: int = 0  # of so many, each of which does its share
    parts: int = 1
    alone: bool = False  # of the kind that is tried just now this part does all
    chance: random.Random = field(default_factory=lambda: random.Random(1))  # the same tries every time
    made: int = 0
    seen: dict = field(default_factory=dict)  # what several tries have in common, by name

    def __post_init__(self):
        for program in (self.granvof, self.compare):
            if why := no_program(program):
                raise TableError(why)

    @property
    def granvof(self):
        return self.build / "solver/granvof"

    @property
    def demvof(self):
        return self.build / "reference/demvof/demvof"

    @property
    def compare(self):
        return self.build / "compare/granvof-compare"

    def some(self, tries, sample=SAMPLE):
        tries = list(tries)
        if self.sample and len(tries) > sample:
            return self.chance.sample(tries, sample)
        return tries if self.alone else tries[self.part::self.parts]

    def place(self):
        """A new empty directory."""
        self.made += 1
        directory = self.work / f"{self.made:05}"
        directory.mkdir()
        return directory

    def drop(self, directory):
        """Removes what a try has made: a whole table's runs would fill a small disk."""
        shutil.rmtree(directory.parent, ignore_errors=True)

    def kept(self, name, make):
        """A directory that `make` fills once."""
        if name not in self.seen:
            target = self.place() / "kept"
            make(target)
            self.seen[name] = target
        return self.seen[name]

    def shimmed(self, **settings):
        """The environment of a program whose calls go through shim.c."""
        if "shim" not in self.seen:
            library = self.place() / "shim.so"
            source = Path(__file__).with_name("shim.c")
            built = subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, source, "-ldl"], capture_output=True, text=True)
            if built.returncode != 0:
                raise TableError(f"{source} cannot be compiled: {built.stderr.strip()[:300]}")
            self.seen["shim"] = library
        return {"LD_PRELOAD": str(self.seen["shim"]), **settings}

    def calls_of(self, run):
        """How many calls that change files a run makes."""
        name = "calls " + str(run.entry)
        if name not in self.seen:
            count = self.place() / "count"
            run.go(count.parent / "run", environment=self.shimmed(FAULT_COUNT=str(count)))
            self.seen[name] = int(count.read_text())
        return self.seen[name]

    def filled(self, command, **places):
        """The command of the table with {granvof}, {compare}, {demvof}, {build} and further places filled in."""
        return [part.format(granvof=self.granvof, compare=self.compare, demvof=self.demvof, build=self.build, **places)
                for part in command]

    def call(self, command, **options):
        environment = {**os.environ, **options.pop("environment", {})}
        before = told_of_our_end(options.pop("preexec_fn", None))
        try:
            return subprocess.run([str(part) for part in command], cwd=options.pop("cwd", self.root), stdin=subprocess.DEVNULL,
                                  stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE,
                                  timeout=options.pop("patience", PATIENCE), env=environment, preexec_fn=before, **options)
        except subprocess.TimeoutExpired:
            return None


def told_of_our_end(further=None):
    """For preexec_fn: what is tried ends with the tries; then what the try itself asks for."""
    parent = os.getpid()

    def before():
        ends_with_parent(parent)
        if further is not None:
            further()
    return before


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
