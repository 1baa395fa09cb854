"""Runs one point and judges it. To hold is more than to end: no monitor warns, and half the step gives the same."""

import csv
import threading
from dataclasses import dataclass
from pathlib import Path

from engine.client import BAD_INPUT, CPU_LIMIT, FINISHED, SIGNAL, order

from granvof_files import opened, toml_in

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
    """Judges points with runs of the engine, as many at a time as that makes; its methods may be called from several threads."""

    def __init__(self, engine, directory, limit, keep=True):
        self.engine, self.directory, self.limit, self.keep = engine, directory, limit, keep
        self.core_seconds, self.runs, self.lock = 0.0, 0, threading.Lock()

    def run(self, case, overrides, name):
        """Its ending. CPU time is limited and not the clock: a border must not move with what else the machine does."""
        ending = self.engine.make(order(name, case, self.directory / name, overrides, keep=self.keep, clear=True,
                                        cpu_limit=self.limit))
        if ending.kind in (BAD_INPUT, SIGNAL, "crashed"):
            raise RuntimeError(f"{name}: {ending.message}")
        with self.lock:
            self.runs += 1
            self.core_seconds += 0.0 if ending.kind == CPU_LIMIT else ending.record()["core_seconds"]
        return ending

    def judge(self, scene, overrides, name, allow=()):
        """The outcome of a point: `overrides` of the scene's case, and the same at half the step."""
        ended = self.run(scene.case, overrides, name)
        if ended.kind == CPU_LIMIT:
            return Outcome(COLLAPSE, f"not done after {self.limit:g} core-s")
        record = ended.record()
        outcome = self.classify(record, allow)
        # What a monitor warns of, allowed or not, is detected.
        apart = DETECTED if record["warnings"] else UNDETECTED
        if not outcome.holds:
            return outcome
        numerics = toml_in(record["resolved_case"])["numerics"]
        refined = overrides + [f"numerics.{key}={0.5 * numerics[key]:.9g}" for key in ("cfl", "dt_max")]
        finer = self.run(scene.case, refined, name + "-half-step")
        if finer.kind == CPU_LIMIT:
            return Outcome(COLLAPSE, f"half the step takes more than {self.limit:g} core-s", outcome.steps, outcome.core_seconds)
        if not finer.finished:
            return Outcome(apart, f"half the step fails: {finer.message}", outcome.steps, outcome.core_seconds)
        for column, tolerance in scene.compare.items():
            moved = distance(series(Path(ended.directory), column), series(Path(finer.directory), column))
            if moved > tolerance:
                return Outcome(apart, f"{column} {moved:.2g} from half the step's, {tolerance:g} allowed", outcome.steps,
                               outcome.core_seconds)
        return outcome

    @staticmethod
    def classify(record, allow):
        """By run.json alone."""
        steps, cost = record["steps"], record["core_seconds"]
        kind, reason = record["exit"]["kind"], record["exit"]["reason"]
        if kind != FINISHED:
            return Outcome(COLLAPSE if kind == "step collapse" else BLOW_UP, reason, steps, cost)
        warnings = [w for w in record["warnings"] if w["monitor"] not in allow]
        if warnings:
            worst = max(warnings, key=lambda w: w["value"] / w["limit"] if w["limit"] else float("inf"))
            return Outcome(DETECTED, f"{worst['monitor']}: {worst['value']:.2g}, limit {worst['limit']:g}", steps, cost)
        return Outcome(HOLDS, "", steps, cost)


def series(run, column):
    """(times, values) of a column of series.csv; undefined values left out."""
    with opened(run / "series.csv", newline="") as file:
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
