"""What is recorded of the DEM-VOF reference, and how a finished run becomes a record.

A record is reference/results/<scene>/seed<N>/ with series.csv, fields.h5 (solid fraction and liquid at a few instants,
which is what comparison and plots read) and record.json: run.json of the run, with `case_hash` set to what the reference
depends on, the seed and the versions of all parts. Records that no comparison may take for the scene are kept apart:
controls/ (gate closed), variants/<variant>/ (another grid, depth, floor, scheme or bead size), bulk-friction/ (the chute) and
element/ (all tests of the beads' material).
"""
import csv
import hashlib
import json
import math
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "solver/python"))

from granvof_files import bytes_of, fields_of, is_there, json_in, json_of, no_program, opened, text_of, toml_of, write_whole  # noqa: E402

RESULTS = ROOT / "reference/results"
PACKAGES = ("libliggghts3", "libopenfoam")
INSTANTS_KEPT = 4  # of fields.h5 that go into a record: the first, the last and two between
FIELDS_KEPT = ("f_s", "alpha")
NAME = r"[A-Za-z0-9][A-Za-z0-9_.-]{0,199}"  # of a scene or variant: it becomes part of a path
UPWIND = 'reference.convection="upwind"'
SEAL = ',\n  "sha256": "@"\n}\n'
DIGITS_KEPT = 9  # significant, of series.csv


@dataclass(frozen=True)
class Run:
    scene: str
    seed: int
    gate_closed: bool = False
    core_minutes: float = 0.0
    variant: str = ""  # name of a run with overrides
    set: tuple = ()  # its overrides, "key=value"
    chute: bool = False  # bulk friction of the scene's beads instead of the scene
    element: bool = False  # their whole material

    def __post_init__(self):
        object.__setattr__(self, "set", tuple(self.set))  # a list in the plan
        for name in (self.scene, self.variant or "none"):
            if not isinstance(name, str) or not re.fullmatch(NAME, name):
                raise RecordError(f"{str(name)[:80]!r} is no name: letters, digits and -_. after a letter or digit")
        if isinstance(self.seed, bool) or not isinstance(self.seed, int) or self.seed < 0:
            raise RecordError(f"{self.scene}: the seed {self.seed!r} is no number of 0 or more")
        if self.chute and self.element:
            raise RecordError(f"{self.scene}: a chute or element tests, which have one of their own")
        if bool(self.variant) != bool(self.set):
            raise RecordError(f"{self.scene}: a variant has a name and overrides, both or neither")

    @property
    def name(self):
        notes = [self.variant] * bool(self.variant) + ["gate closed"] * self.gate_closed + [self.kind] * self.of_beads
        return f"{self.scene}/seed{self.seed}" + (f" ({', '.join(notes)})" if notes else "")

    @property
    def of_beads(self):
        """Tests of the scene's beads, not the scene: without fields."""
        return self.chute or self.element

    @property
    def kind(self):
        """The subcommand of demvof."""
        return "chute" if self.chute else "element" if self.element else "run"

    @property
    def arguments(self):
        """Of demvof, without places."""
        closed = ["--gate-closed"] if self.gate_closed else []
        sets = [word for override in self.set for word in ("--set", override)]
        return [self.kind, f"cases/{self.scene}.toml", "--seed", str(self.seed), *closed, *sets]

    @property
    def command(self):
        return " ".join(["demvof", *self.arguments])

    def folder(self, results=RESULTS):
        base = results
        if self.gate_closed:
            base = base / "controls"
        if self.variant:
            base = base / "variants" / self.variant
        if self.chute:
            base = base / "bulk-friction"
        if self.element:
            base = base / "element"
        return base / self.scene / f"seed{self.seed}"


class RecordError(Exception):
    """What is missing or wrong, in one line."""


def one_line(error):
    return " ".join(f"{type(error).__name__}: {error}".split())


def facts_of(path):
    """Content of a run.json or record.json without its seal. RecordError where it is damaged."""
    try:
        text = text_of(path)
        facts = json_in(text)
    except (OSError, ValueError) as error:
        raise RecordError(f"{path} cannot be read: {one_line(error)}") from error
    if not isinstance(facts, dict):
        raise RecordError(f"{path} is no JSON object")
    if facts.pop("sha256", None) and not is_sealed(text):
        raise RecordError(f"{path} is not what was written: its own SHA-256 is another")
    return facts


def sealed(facts):
    """The text of a JSON file that carries its own digest as its last member (solver/output/seal.hpp)."""
    text = json.dumps({key: value for key, value in facts.items() if key != "sha256"}, indent=2).removesuffix("\n}")
    return text + SEAL.replace("@", hashlib.sha256(text.encode()).hexdigest())


def is_sealed(text):
    content, begin, _ = text.rpartition(SEAL.split("@")[0])
    return bool(begin) and text == content + SEAL.replace("@", hashlib.sha256(content.encode()).hexdigest())


def read_plan(path=ROOT / "reference/plan.toml"):
    try:
        runs = [Run(**entry) for entry in toml_of(path)["run"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RecordError(f"{path} is no plan: {one_line(error)}") from error
    if not runs:
        raise RecordError(f"{path}: there is no [[run]]")
    if len({r.folder() for r in runs}) != len(runs):
        raise RecordError(f"{path}: a run is listed twice")
    return runs


def select(runs, scenes):
    """The runs of these scenes; all without any."""
    known = sorted({r.scene for r in runs})
    for scene in scenes:
        if scene not in known:
            raise RecordError(f"no scene '{scene}' in reference/plan.toml (there: {', '.join(known)})")
    return [r for r in runs if not scenes or r.scene in scenes]


def program(build_dir):
    path = Path(build_dir).resolve() / "reference/demvof/demvof"
    if why := no_program(path, "ci/setup-reference installs what it needs, `make reference` builds it"):
        raise RecordError(why)
    return path


def hashes(demvof, scene, overrides):
    sets = [word for override in overrides for word in ("--set", override)]
    result = subprocess.run([demvof, "hash", ROOT / f"cases/{scene}.toml", *sets], capture_output=True, text=True)
    if result.returncode:
        raise RecordError(f"cases/{scene}.toml: {result.stderr.strip()}")
    return result.stdout.split()[-2:]


def current_hashes(demvof, run):
    """Hash of what the reference depends on, and of the whole case. Tests of the beads are dry: how the fluid's momentum is carried
    is nothing to them."""
    case_hash, whole = hashes(demvof, run.scene, run.set)
    return (hashes(demvof, run.scene, [UPWIND])[0] if run.of_beads else case_hash), whole


def variant_of(scene, sets, plan):
    """Name of the plan's variant of a scene with these overrides."""
    named = [run.variant for run in plan if run.scene == scene and sorted(run.set) == sorted(sets)]
    if not named:
        raise RecordError(f"reference/plan.toml has no variant of {scene} with {', '.join(sets)}")
    return named[0]


def run_of(directory, plan=()):
    """Which run of which case a run directory of demvof holds: Run, case hash."""
    facts = facts_of(directory / "run.json")
    try:
        if facts["program"] != "demvof":
            raise RecordError(f"{directory} is a run of {facts['program']}, not of demvof")
        words = facts["command"].split()
        sets = [value for option, value in zip(words, words[1:]) if option == "--set"]
        variant = variant_of(facts["scene"], sets, plan) if sets else ""
        run = Run(facts["scene"], int(facts["monitors"]["seed"]), "--gate-closed" in words, variant=variant, set=sets,
                  chute="chute" in words, element="element" in words)
        return run, facts["case_hash"]
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise RecordError(f"{directory} holds no run of demvof: {one_line(error)}") from error


def state(run, case_hash, results=RESULTS):
    """'current', 'stale' or 'missing'."""
    try:
        record = json_of(run.folder(results) / "record.json")
    except FileNotFoundError:
        return "missing"
    except (OSError, ValueError):
        return "stale"
    return "current" if isinstance(record, dict) and record.get("case_hash") == case_hash else "stale"


def package_version(package):
    found = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package], capture_output=True, text=True)
    return found.stdout.strip() or "unknown"


def kept(names):
    """First, last and two between, evenly spread."""
    if len(names) <= INSTANTS_KEPT:
        return list(names)
    last = len(names) - 1
    return [names[round(n * last / (INSTANTS_KEPT - 1))] for n in range(INSTANTS_KEPT)]


def slim_fields(source, target):
    """Copies what a record keeps of fields.h5, in single precision, compressed; attributes are kept as they are."""
    with fields_of(source) as old, h5py.File(target, "w", libver=("v110", "v110")) as new:  # less overhead than older formats
        new.attrs.update(old.attrs)
        for number, name in enumerate(kept(sorted(old))):
            group = new.create_group(f"t{number:04}")
            group.attrs.update(old[name].attrs)
            for field in FIELDS_KEPT:
                if field not in old[name]:
                    continue
                data = old[name][field]
                group.create_dataset(field, data=data[()], dtype="f4", chunks=data.shape, compression="gzip", compression_opts=9,
                                     shuffle=True)
                group[field].attrs.update(data.attrs)


def slim_series(source, target):
    """Copies series.csv with fewer digits."""
    with opened(source, newline="") as file:
        header, *rows = csv.reader(file)
    rows = [[value and f"{float(value):.{DIGITS_KEPT}g}" for value in row] for row in rows]
    target.write_text("".join(",".join(row) + "\n" for row in [header, *rows]))


def read_series(path):
    """Header and rows of a series.csv, as texts. RecordError where it is damaged."""
    try:
        with opened(path, newline="", encoding="utf-8") as file:
            text = file.read()
        header, *rows = csv.reader(text.splitlines(), strict=True)
        times = [float(row[0]) for row in rows]
    except (OSError, ValueError, IndexError, csv.Error) as error:
        raise RecordError(f"{path} cannot be read: {error}") from error
    if not text.endswith("\n") or len(rows) < 2 or any(len(row) != len(header) for row in rows):
        raise RecordError(f"{path} is cut: not every row is whole")
    if any(later <= earlier for earlier, later in zip(times, times[1:])):
        raise RecordError(f"{path}: time does not ascend")
    return header, rows


def instants_of(path):
    """How many instants a fields.h5 holds. RecordError where it is damaged."""
    try:
        with fields_of(path) as file:
            return len([file[name].attrs["time"] for name in file])
    except (OSError, KeyError) as error:
        raise RecordError(f"{path} cannot be read: {error}") from error


def stated_files(folder):
    """What run.json and record.json say of the files beside them: rows, end, columns and SHA-256 of series.csv, instants and
    SHA-256 of fields.h5 where there is one."""
    def digest(path):
        return hashlib.sha256(bytes_of(path)).hexdigest()

    series, fields = folder / "series.csv", folder / "fields.h5"
    header, rows = read_series(series)
    stated = {"series.csv": {"rows": len(rows), "end": float(rows[-1][0]), "columns": header, "sha256": digest(series)}}
    if is_there(fields):
        stated["fields.h5"] = {"instants": instants_of(fields), "sha256": digest(fields)}
    return stated


def require_files(folder, facts):
    """RecordError unless the files of `folder` are those that `facts` (run.json or record.json) state."""
    if "files" not in facts:
        raise RecordError(f"{folder} was made by an earlier version, which did not say what it wrote")
    if not isinstance(facts["files"], dict):
        raise RecordError(f"{folder}: 'files' is no table")
    found = stated_files(folder)
    for name in {*found, *facts["files"]}:
        stated = facts["files"].get(name)
        if name not in found and stated == {"instants": 0, "sha256": None}:  # tests of beads write no fields
            continue
        if not isinstance(stated, dict) or name not in found:
            raise RecordError(f"{folder / name} is stated or there, not both")
        if "sha256" in stated and stated["sha256"] is None:  # fields.h5 that links to a file an instant
            stated = stated | {"sha256": found[name]["sha256"]}
        # demvof stated the end of a chute with all digits and wrote it with six; the digest tells files apart.
        if name in found and math.isclose(found[name].get("end", 0), stated.get("end", 0), rel_tol=1e-6):
            stated = stated | {key: found[name][key] for key in ("end",) if key in found[name]}
        if found[name] != stated:
            raise RecordError(f"{folder / name} is not the file that was written")


def write_sealed(path, facts):
    write_whole(path, sealed(facts))


def state_files(folder):
    """Adds to a record of an earlier version what is said of its files, and the seal; True if one was missing. The files are
    taken as they are: that they are those that were written rests on the history of the repository alone, and is said so."""
    path = folder / "record.json"
    facts = facts_of(path)
    if "files" in facts and is_sealed(text_of(path)):
        return False
    if "files" not in facts:
        facts["files"] = stated_files(folder)
        facts["files_stated"] = "afterwards, from the files as they were in the repository"
    write_sealed(path, facts)
    return True


def slim_record(folder):
    """Rewrites series.csv and fields.h5 of a record to what a record keeps. True if that made them smaller."""
    smaller = False
    facts = facts_of(folder / "record.json")
    require_files(folder, facts)
    for name, slim in (("series.csv", slim_series), ("fields.h5", slim_fields)):
        path, draft = folder / name, folder / (name + ".part")
        if not path.exists():
            continue
        slim(path, draft)
        if draft.stat().st_size < path.stat().st_size:
            draft.rename(path)
            smaller = True
        else:
            draft.unlink()
    if smaller:
        write_sealed(folder / "record.json", facts | {"files": stated_files(folder)})
    return smaller


def make_record(run, run_directory, case_hash, results=RESULTS):
    """Turns a finished run, whose files are those that it wrote, into a record; replaces an older one only when all is
    written."""
    facts = facts_of(run_directory / "run.json")
    if facts["exit"]["state"] != "finished":
        raise RecordError(f"{run.name}: no record, the run {facts['exit']['state']}: {facts['exit']['reason']}")
    facts["run_hash"] = facts["case_hash"]
    facts["case_hash"] = case_hash
    facts["command"] = run.command  # as anyone would call it, without this machine's folders
    facts["seed"] = run.seed
    facts["gate_closed"] = run.gate_closed
    facts["variant"] = run.variant
    facts["parts"] = {package: package_version(package) for package in PACKAGES}
    require_files(run_directory, facts)
    folder = run.folder(results)
    draft = folder.with_name(folder.name + ".part")
    shutil.rmtree(draft, ignore_errors=True)
    draft.mkdir(parents=True)
    slim_series(run_directory / "series.csv", draft / "series.csv")
    if not run.of_beads:
        slim_fields(run_directory / "fields.h5", draft / "fields.h5")
    facts["files"] = stated_files(draft)
    write_sealed(draft / "record.json", facts)
    shutil.rmtree(folder, ignore_errors=True)
    draft.rename(folder)
    return folder
