"""What was tried and held, as a section of the report (compare/report/sections.py); and what of it a later call need not repeat."""

import dataclasses
import datetime
import hashlib
import inspect
import json
import subprocess
from pathlib import Path

from granvof_files import OF_READING, bytes_of, json_of, write_json

LONGEST_LIST = 200  # tries that were not held, in the report
KINDS_FILE = "kinds.json"
COMMON = ("bench.py", "runs.py", "parts.py", "shim.c")  # of the tries, whatever the kind


@dataclasses.dataclass
class Tried:
    """What came of one kind, and on what: `identity` is that of the programs and of the tries, `commit` that of the tree."""

    kind: str
    what: str
    tried: int
    held: int
    seconds: int
    core_seconds: int
    commit: str
    identity: str
    missed: list  # of (try, why)

    def row(self):
        return [self.kind, self.what, self.tried, self.held, self.seconds, self.core_seconds, self.commit]


def commit_of(root):
    """The commit of the tree, marked where files differ from it."""
    def git(*words):
        return subprocess.run(["git", *words], cwd=root, capture_output=True, text=True).stdout.strip()
    return git("rev-parse", "--short=12", "HEAD") + ("-dirty" if git("status", "--porcelain", "--untracked-files=no") else "")


def identity_of(kind, entries, attempt, bench):
    """Of the programs, the entries of the table and the code of the tries; where an entry starts a script, of all scripts."""
    digest = hashlib.sha256(json.dumps([kind, entries, bench.sample], sort_keys=True).encode())
    folder = Path(__file__).parent
    sources = [Path(inspect.getsourcefile(attempt)), *(folder / name for name in COMMON)]
    if any(f'"{place}/' in json.dumps(entries) for place in ("compare", "reference", "ci", "/usr/bin")):
        listed = subprocess.run(["git", "ls-files", "-z", "solver/python", "compare", "reference", "ci"], cwd=bench.root, capture_output=True, text=True)
        scripts = (bench.root / name for name in listed.stdout.split("\0") if name)
        sources += [path for path in scripts if path.suffix == ".py" or (not path.suffix and path.stat().st_mode & 0o100)]
    for path in (bench.granvof, bench.compare, *([bench.demvof] if bench.demvof.exists() else []), *sources):
        digest.update(hashlib.sha256(bytes_of(path)).digest())
    return digest.hexdigest()


def kept_of(directory):
    """By kind, what an earlier call has tried and found held; nothing where there is none."""
    try:
        found = [Tried(**one) for one in json_of(directory / KINDS_FILE)]
    except OF_READING:
        return {}
    return {one.kind: one for one in found if one.tried and one.held == one.tried}


def section(made, sample, to_come):
    tried, held = sum(one.tried for one in made), sum(one.held for one in made)
    used = [sum(one.seconds for one in made), sum(one.core_seconds for one in made)]
    commits = list(dict.fromkeys(one.commit for one in made))
    text = [f"What can go wrong was tried against the built programs (ci/faults.toml{', a sample' if sample else ''}): "
            f"{held} of {tried} tries held."]
    if len(commits) > 1:
        text.append("Kinds whose programs and tries had not changed since an earlier call stand as that found them; the commit is named.")
    if to_come:
        text.append(f"It was ended before these were tried: {', '.join(to_come)}.")
    tables = [{"caption": "Tried and held", "columns": ["kind", "what", "tried", "held", "s", "core-s", "commit"],
               "rows": [*(one.row() for one in made), ["all", "", tried, held, *used, ""]]}]
    missed = [[one.kind, *miss] for one in made for miss in one.missed]
    if missed:
        tables.append({"caption": "Not held", "columns": ["kind", "try", "why"], "rows": missed[:LONGEST_LIST]})
    return {"title": "What goes wrong around a run", "text": text, "figures": [], "tables": tables, "commit": commits[-1] if commits else "",
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")}


def write(directory, made, sample, to_come):
    write_json(directory / KINDS_FILE, [dataclasses.asdict(one) for one in made])
    write_json(directory / "faults.json", section(made, sample, to_come))
