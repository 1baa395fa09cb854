"""Runs one point and judges it. To hold is more than to end: no monitor warns, and half the step gives the same."""

import csv
import json
import math
import resource
import signal
import subprocess
import tomllib
from dataclasses import dataclass

from granvof_files import required

# Classes of an outcome, from good to bad. The last is the one that must not exist: wrong, and no monitor says so.
HOLDS, COLLAPSE, BLOW_UP, DETECTED, UNDETECTED = (
    "holds", "step collapse", "blow-up", "wrong answer, detected", "wrong answer, undetected")


@dataclass
class Outcome:
    kind: str
    why: str = ""
    steps: int = 0
    core_seconds: float = 0.0

    @property
    def holds(self):
        return self.kind == HOLDS


class Runner:
    def __init__(self, solver, directory, timeout):
        self.solver, self.directory, self.timeout = solver, directory, timeout
        self.core_seconds, self.runs = 0.0, 0

    def run(self, case, overrides, name):
        """Exit text ("finished", ...) and directory of a run."""
        out = self.directory / name
        command = [self.solver, "run", case, "--threads", "1", "--out", out]
        for override in overrides:
            command += ["--set", override]
        self.runs += 1
        ended = subprocess.run([str(part) for part in command], capture_output=True, text=True, preexec_fn=self.limit)
        if ended.returncode == -signal.SIGXCPU or "(SIGXCPU)" in ended.stderr:  # it ends itself, with a checkpoint
            return "timeout", out
        if ended.returncode == 2:
            raise RuntimeError(f"{name}: {ended.stderr.strip()}")
        return "done", out

    def limit(self):
        """CPU time and not the clock: a border must not move with what else the machine does."""
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(self.timeout), math.ceil(self.timeout) + 5))

    def judge(self, scene, overrides, name, allow=()):
        """The outcome of a point: `overrides` of the scene's case, and the same at half the step."""
        ended, out = self.run(scene.case, overrides, name)
        if ended == "timeout":
            return Outcome(COLLAPSE, f"not done after {self.timeout:g} core-s")
        record = json.loads(required(out / "run.json").read_text())
        self.core_seconds += record["core_seconds"]
        outcome = self.classify(record, allow)
        # What a monitor warns of, allowed or not, is detected.
        apart = DETECTED if record["warnings"] else UNDETECTED
        if not outcome.holds:
            return outcome
        numerics = tomllib.loads(record["resolved_case"])["numerics"]
        refined = overrides + [f"numerics.{key}={0.5 * numerics[key]:.9g}" for key in ("cfl", "dt_max")]
        ended, finer = self.run(scene.case, refined, name + "-half-step")
        if ended == "timeout":
            return Outcome(COLLAPSE, f"half the step takes more than {self.timeout:g} core-s", outcome.steps,
                           outcome.core_seconds)
        other = json.loads(required(finer / "run.json").read_text())
        self.core_seconds += other["core_seconds"]
        if other["exit"]["state"] != "finished":
            return Outcome(apart, f"half the step fails: {other['exit']['reason']}", outcome.steps, outcome.core_seconds)
        for column, tolerance in scene.compare.items():
            moved = distance(series(out, column), series(finer, column))
            if moved > tolerance:
                return Outcome(apart, f"{column} {moved:.2g} from half the step's, {tolerance:g} allowed", outcome.steps,
                               outcome.core_seconds)
        return outcome

    @staticmethod
    def classify(record, allow):
        """By run.json alone."""
        steps, cost = record["steps"], record["core_seconds"]
        state, reason = record["exit"]["state"], record["exit"]["reason"]
        if state != "finished":
            kind = COLLAPSE if reason.startswith("step collapse") and "not finite" not in reason else BLOW_UP
            return Outcome(kind, reason, steps, cost)
        warnings = [w for w in record["warnings"] if w["monitor"] not in allow]
        if warnings:
            worst = max(warnings, key=lambda w: w["value"] / w["limit"] if w["limit"] else float("inf"))
            return Outcome(DETECTED, f"{worst['monitor']}: {worst['value']:.2g}, limit {worst['limit']:g}", steps, cost)
        return Outcome(HOLDS, "", steps, cost)


def series(run, column):
    """(times, values) of a column of series.csv; undefined values left out."""
    with open(required(run / "series.csv"), newline="") as file:
        rows = list(csv.reader(file))
    names = [name.split(" [")[0] for name in rows[0]]
    at = names.index(column)
    return [(float(row[0]), float(row[at])) for row in rows[1:] if row[at]]


def distance(a, b):
    """Largest difference of two curves at the times of the first that the second covers; infinite where only one is
    there."""
    if bool(a) != bool(b):
        return float("inf")
    largest = 0.0
    for time, value in a:
        later = next((i for i, (t, _) in enumerate(b) if t >= time), None)
        if later is None:
            continue
        t1, v1 = b[later]
        t0, v0 = b[max(later - 1, 0)]
        share = 0.0 if t1 == t0 else min(max((time - t0) / (t1 - t0), 0.0), 1.0)
        largest = max(largest, abs(value - (v0 + share * (v1 - v0))))
    return largest
