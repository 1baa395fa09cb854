"""What `granvof-compare check` wrote, as the plots and the page read it."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from granvof_files import OF_READING, fields_of, is_there, json_of, text_of, values_of
from report import versions


class Damaged(ValueError):
    """A file that cannot be read or does not hold what it must: which, and why, in one line."""

    def __init__(self, path, error):
        super().__init__(f"{path} cannot be shown: " + " ".join(f"{type(error).__name__}: {error}".split()))


def read_json(path, *needed):
    """A JSON object that has these keys. Damaged where it is none."""
    try:
        content = json_of(path)
        if not isinstance(content, dict):
            raise ValueError("no JSON object")
        for key in needed:
            content[key]
        return content
    except OF_READING as error:
        raise Damaged(path, error) from error


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
    damaged: list = field(default_factory=list)  # what could not be shown, and why: one sentence each
    causes: dict = field(default_factory=dict)  # key -> what expected failures have in common
    cases: Path = Path("cases")  # directory of the case files, with published/

    @property
    def version(self):
        """The minor version of the program that made the runs."""
        return versions.newest(run.get("version") for run in self.runs.values())

    def row(self, scene, metric):
        """The first row of that scene and metric, or None."""
        return next((row for row in self.rows if row["scene"] == scene and row["metric"] == metric), None)

    def record_of(self, run):
        """The record that a run is shown beside: the one that its rows are judged by, or that of its case."""
        entry = self.runs.get(run, {})
        return entry.get("record", entry.get("case", run))

    def curve(self, run, name):
        """Arrays x, y of a run's curve; None where there is none."""
        return arrays(self.curves.get(run, {}), name)

    def published(self, file, column):
        """Arrays of a series of cases/published: its first column and the one named; None where there is no such file."""
        path = self.cases / "published" / file
        if not path.exists():
            return None
        try:
            lines = [line.split("\t") for line in text_of(path).splitlines() if line and not line.startswith("#")]
            index = [name.split(" [")[0] for name in lines[0]].index(column)
            values = np.array([[float(line[0]), float(line[index])] for line in lines[1:]])
            return values[:, 0], values[:, 1]
        except OF_READING as error:
            raise Damaged(path, error) from error

    def shown(self, make):
        """What `make` gives; nothing where a file it needs is damaged, and then a sentence says so."""
        try:
            return make()
        except Damaged as error:
            if str(error) not in self.damaged:
                self.damaged.append(str(error))
            return None

    def facts(self, *names):
        return [self.runs[name] for name in names if name in self.runs]


def arrays(entry, name):
    curve = entry.get("curves", {}).get(name)
    return (np.array(curve["x"]), np.array(curve["y"])) if curve else None


def load(directory, cases=Path("cases")):
    """Reads results.json, curves.json and, if there is one, results.previous.json of a directory. Damaged where one of the
    first two is; of the last it is only said."""
    results = read_json(directory / "results.json", "date", "frequency")
    try:
        loaded = Results(directory, results["date"], results["frequency"], rows_of(results),
                         {run["id"]: run for run in results["runs"]})
    except OF_READING as error:
        raise Damaged(directory / "results.json", error) from error
    loaded.cases = cases
    loaded.causes = results.get("causes", {})
    curves = read_json(directory / "curves.json", "runs", "records")
    loaded.curves, loaded.records, loaded.peers = curves["runs"], curves["records"], curves.get("peers", {})
    before = directory / "results.previous.json"
    if before.exists():
        previous = loaded.shown(lambda: read_previous(before))
        if previous:
            loaded.previous, loaded.previous_date = previous
    return loaded


def rows_of(results):
    """The rows of a results.json, each with what the page shows of it."""
    if not results["results"]:
        raise ValueError("there is no row in it")
    for row in results["results"]:
        for key in ("id", "scene", "metric", "verdict", "value", "reference", "unit"):
            row[key]
    return results["results"]


def read_previous(path):
    content = read_json(path, "date")
    try:
        return {row["id"]: row for row in rows_of(content)}, content["date"]
    except OF_READING as error:
        raise Damaged(path, error) from error


def changes(results, relative=1e-3, since=None):
    """Rows whose verdict changed, or whose value moved by more than `relative`, since the last comparison, or since the rows
    `since` (by id).

    Cost is left out: it moves with the load of the machine.
    """
    found = []
    previous = results.previous if since is None else since
    for row in results.rows:
        before = previous.get(row["id"])
        if before is None:
            if previous and (since is None or row["unit"] != "core-s"):
                found.append((row, None, "new"))
            continue
        if before["verdict"] != row["verdict"]:
            found.append((row, before, f"{before['verdict']} → {row['verdict']}"))
        elif moved(before["value"], row["value"], relative) and row["unit"] != "core-s" and matters(row):
            found.append((row, before, f"{before['value']:.6g} → {row['value']:.6g}"))
    now = {row["id"] for row in results.rows}
    found += [(before, before, "gone") for key, before in previous.items() if key not in now]
    return found


def moved(before, now, relative):
    if before is None or now is None:
        return before is not now
    return abs(now - before) > relative * max(abs(now), abs(before))


def matters(row):
    """Rounding noise far inside an absolute tolerance (volume errors) is no change."""
    return row["reference"] != 0 or row["distance"] is None or row["distance"] > 0 or abs(row["value"]) > 1e-6


def snapshots(run):
    """Yields (time, f_s, alpha, phi) as 2D arrays (y, x), of a 3D scene its mid-plane and of the slice of a 2D one the mean across it, for each instant of a run."""
    for time, fields in instants(run):
        yield time, *(None if field is None else across(field, run["scene"]["dimensions"]) for field in fields)


def across(field, dimensions):
    """(y, x[, component]) of a field (z, y, x[, component])."""
    return field[field.shape[0] // 2] if dimensions == 3 else field.mean(axis=0)


def instants(run, names=("f_s", "alpha", "phi")):
    """Yields (time, the fields of those names) as arrays (z, y, x[, component]), None for a field that was not written."""
    path = Path(run["directory"]) / "fields.h5"
    if not is_there(path):
        return
    try:
        with fields_of(path) as file:
            groups = [file[name] for name in file if "f_s" in file[name]]
            for group in sorted(groups, key=lambda g: float(g.attrs["time"])):
                yield float(group.attrs["time"]), tuple(values_of(group[name]) if name in group else None
                                                        for name in names)
    except OF_READING as error:
        raise Damaged(path, error) from error
