"""What is recorded of the DEM-VOF reference, and how a finished run becomes a record.

A record is reference/results/<scene>/seed<N>/ with series.csv, fields.h5 (a few instants) and record.json: run.json of
the run, with `case_hash` set to what the reference depends on, the seed and the versions of all parts.
"""
import json
import shutil
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path

import h5py

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "reference/results"
PACKAGES = ("libliggghts3", "libopenfoam")
FIELDS_KEPT = 4  # instants of fields.h5 that go into a record: the first, the last and two between


@dataclass(frozen=True)
class Run:
    scene: str
    seed: int
    gate_closed: bool = False
    core_minutes: float = 0.0

    @property
    def name(self):
        return f"{self.scene}/seed{self.seed}" + (" (gate closed)" if self.gate_closed else "")

    @property
    def command(self):
        return f"demvof run cases/{self.scene}.toml --seed {self.seed}" + (" --gate-closed" if self.gate_closed else "")

    def folder(self, results=RESULTS):
        base = results / "controls" if self.gate_closed else results
        return base / self.scene / f"seed{self.seed}"


class RecordError(Exception):
    """What is missing or wrong, in one line."""


def read_plan(path=ROOT / "reference/plan.toml"):
    runs = [Run(**entry) for entry in tomllib.loads(path.read_text())["run"]]
    if len({(r.scene, r.seed, r.gate_closed) for r in runs}) != len(runs):
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
    path = Path(build_dir) / "reference/demvof/demvof"
    if not path.exists():
        raise RecordError(f"{path} is missing; ci/setup-reference installs what it needs, `make reference` builds it")
    return path


def current_hashes(demvof, scene):
    """Hash of what the reference depends on, and of the whole case."""
    result = subprocess.run([demvof, "hash", ROOT / f"cases/{scene}.toml"], capture_output=True, text=True)
    if result.returncode:
        raise RecordError(f"cases/{scene}.toml: {result.stderr.strip()}")
    return result.stdout.split()[-2:]


def run_of(directory):
    """Which run of which case a run directory of demvof holds: Run, case hash."""
    try:
        facts = json.loads((directory / "run.json").read_text())
        if facts["program"] != "demvof":
            raise RecordError(f"{directory} is a run of {facts['program']}, not of demvof")
        run = Run(facts["scene"], int(facts["monitors"]["seed"]), "--gate-closed" in facts["command"])
        return run, facts["case_hash"]
    except (OSError, ValueError, KeyError) as error:
        raise RecordError(f"{directory} holds no run of demvof: {error}") from error


def state(run, case_hash, results=RESULTS):
    """'current', 'stale' or 'missing'."""
    try:
        record = json.loads((run.folder(results) / "record.json").read_text())
    except FileNotFoundError:
        return "missing"
    except ValueError:
        return "stale"
    return "current" if record.get("case_hash") == case_hash else "stale"


def package_versions():
    versions = {}
    for package in PACKAGES:
        found = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package], capture_output=True, text=True)
        versions[package] = found.stdout.strip() or "unknown"
    return versions


def kept(names):
    """First, last and two between, evenly spread."""
    if len(names) <= FIELDS_KEPT:
        return list(names)
    last = len(names) - 1
    return [names[round(n * last / (FIELDS_KEPT - 1))] for n in range(FIELDS_KEPT)]


def slim_fields(source, target):
    """Copies a few instants in single precision, compressed. Every other number of the file is kept as it is."""
    with h5py.File(source) as old, h5py.File(target, "w") as new:
        new.attrs.update(old.attrs)
        for name in kept(sorted(old)):
            group = new.create_group(name)
            group.attrs.update(old[name].attrs)
            for field, data in old[name].items():
                group.create_dataset(field, data=data[()], dtype="f4", compression="gzip", compression_opts=9, shuffle=True)
                group[field].attrs.update(data.attrs)


def make_record(run, run_directory, case_hash, results=RESULTS):
    """Turns a finished run into a record; replaces an older one only when all is written."""
    facts = json.loads((run_directory / "run.json").read_text())
    if facts["exit"]["state"] != "finished":
        raise RecordError(f"{run.name}: no record, the run {facts['exit']['state']}: {facts['exit']['reason']}")
    facts["run_hash"] = facts["case_hash"]
    facts["case_hash"] = case_hash
    facts["command"] = run.command  # as anyone would call it, without this machine's folders
    facts["seed"] = run.seed
    facts["gate_closed"] = run.gate_closed
    facts["parts"] = package_versions()
    folder = run.folder(results)
    draft = folder.with_name(folder.name + ".part")
    shutil.rmtree(draft, ignore_errors=True)
    draft.mkdir(parents=True)
    shutil.copy(run_directory / "series.csv", draft / "series.csv")
    slim_fields(run_directory / "fields.h5", draft / "fields.h5")
    (draft / "record.json").write_text(json.dumps(facts, indent=2) + "\n")
    shutil.rmtree(folder, ignore_errors=True)
    draft.rename(folder)
    return folder
