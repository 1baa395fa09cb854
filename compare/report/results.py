"""What `granvof-compare check` wrote, as the plots and the page read it."""

import json
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np


@dataclass
class Results:
    directory: Path
    date: str
    frequency: str
    rows: list
    runs: dict  # id -> entry of results.json
    previous: dict = field(default_factory=dict)  # id of a row -> row, of the comparison before this one
    previous_date: str = ""
    curves: dict = field(default_factory=dict)  # id -> {"scene", "directory", "curves"}
    records: dict = field(default_factory=dict)  # scene -> variant -> the same
    peers: dict = field(default_factory=dict)  # run -> stock program -> the same
    cases: Path = Path("cases")  # directory of the case files, with published/

    def row(self, scene, metric):
        """The first row of that scene and metric, or None."""
        return next((row for row in self.rows if row["scene"] == scene and row["metric"] == metric), None)

    def curve(self, run, name):
        """Arrays x, y of a run's curve; None where there is none."""
        return arrays(self.curves.get(run, {}), name)

    def published(self, file, column):
        """Arrays of a series of cases/published: its first column and the one named; None where there is no such file."""
        path = self.cases / "published" / file
        if not path.exists():
            return None
        lines = [line.split("\t") for line in path.read_text().splitlines() if line and not line.startswith("#")]
        index = [name.split(" [")[0] for name in lines[0]].index(column)
        values = np.array([[float(line[0]), float(line[index])] for line in lines[1:]])
        return values[:, 0], values[:, 1]

    def facts(self, *names):
        return [self.runs[name] for name in names if name in self.runs]


def arrays(entry, name):
    curve = entry.get("curves", {}).get(name)
    return (np.array(curve["x"]), np.array(curve["y"])) if curve else None


def load(directory, cases=Path("cases")):
    """Reads results.json, curves.json and, if there is one, results.previous.json of a directory."""
    results = json.loads((directory / "results.json").read_text())
    loaded = Results(directory, results["date"], results["frequency"], results["results"],
                     {run["id"]: run for run in results["runs"]})
    loaded.cases = cases
    curves = json.loads((directory / "curves.json").read_text())
    loaded.curves, loaded.records, loaded.peers = curves["runs"], curves["records"], curves.get("peers", {})
    before = directory / "results.previous.json"
    if before.exists():
        previous = json.loads(before.read_text())
        loaded.previous = {row["id"]: row for row in previous["results"]}
        loaded.previous_date = previous["date"]
    return loaded


def changes(results, relative=1e-3):
    """Rows whose verdict changed, or whose value moved by more than `relative`, since the last comparison.

    Cost is left out: it moves with the load of the machine.
    """
    found = []
    for row in results.rows:
        before = results.previous.get(row["id"])
        if before is None:
            if results.previous:
                found.append((row, None, "new"))
            continue
        if before["verdict"] != row["verdict"]:
            found.append((row, before, f"{before['verdict']} → {row['verdict']}"))
        elif moved(before["value"], row["value"], relative) and row["unit"] != "core-s" and matters(row):
            found.append((row, before, f"{before['value']:.6g} → {row['value']:.6g}"))
    now = {row["id"] for row in results.rows}
    found += [(before, before, "gone") for key, before in results.previous.items() if key not in now]
    return found


def moved(before, now, relative):
    if before is None or now is None:
        return before is not now
    return abs(now - before) > relative * max(abs(now), abs(before))


def matters(row):
    """Rounding noise far inside an absolute tolerance (volume errors) is no change."""
    return row["reference"] != 0 or row["distance"] is None or row["distance"] > 0 or abs(row["value"]) > 1e-6


def snapshots(run):
    """Yields (time, f_s, alpha, phi) as 2D arrays (y, x), the mean across the tank, for each instant of a run."""
    path = Path(run["directory"]) / "fields.h5"
    if not path.exists():
        return
    with h5py.File(path, "r") as file:
        groups = [file[name] for name in file if "f_s" in file[name]]
        for group in sorted(groups, key=lambda g: float(g.attrs["time"])):
            flat = [np.asarray(group[name]).mean(axis=0) if name in group else None for name in ("f_s", "alpha", "phi")]
            yield float(group.attrs["time"]), *flat
