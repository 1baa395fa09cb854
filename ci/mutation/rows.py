"""The rows of `make verify` against a fault: runs made again with it, those that notice most for their cost first, until
a row changes its verdict. A row counts once every run that it reads is as it would be with the fault in the whole
project: between a run with it and one without, any fault shows. Rows of what a run costs say how busy the machine is."""

import hashlib
import os
import shutil
import subprocess
import time
from collections import Counter

from granvof_files import json_of, write_json
from mutation import process

DEAREST, ALL = 2.5, 45.0  # core-seconds of a run, and of all that are tried, by the kept costs


class Rows:
    """The runs that are cheap enough, made without a fault, and the verdicts that follow."""

    def __init__(self, tree, work, scratch, dearest=DEAREST, budget=ALL, made=None):
        """`made`: a directory of runs that `make verify` has made: the dearer ones are taken from there as they are, for faults
        of what judges them."""
        self.tree, self.work, self.scratch, self.made = tree, work, scratch, made
        self.build = tree / "build/release"
        self.solver, self.compare = self.build / "solver/granvof", self.build / "compare/granvof-compare"
        self.dearest, self.budget = dearest, budget
        self.runs, self.others, self.reached, self.seconds = [], [], {}, {}
        self.reads = {}  # of a row: the run it judges, and the one it is judged against, if any
        self.noticed = Counter()  # faults that each run has noticed in this call

    def plan(self):
        """(id, case, overrides) of the runs, cheapest first; and the ids of the others."""
        said = subprocess.run([self.compare, "plan", "--frequency", "verify"], cwd=self.tree, check=True,
                              stdout=subprocess.PIPE, text=True).stdout
        kept = json_of(self.tree / "compare/kept/verify/results.json")["costs"]
        planned = [(fields[0], fields[1], fields[2:]) for fields in (line.split("\t") for line in said.splitlines())]
        # a run that nothing was kept of yet is new, and tried
        cost = {run[0]: kept[run[0]]["core_seconds"] if run[0] in kept else 0.0 for run in planned}
        chosen, spent = [], 0.0
        for run in sorted(planned, key=lambda run: cost[run[0]]):
            spent += cost[run[0]]
            if cost[run[0]] > self.dearest or spent > self.budget:
                break
            chosen.append(run)
        return chosen, [run[0] for run in planned if run not in chosen]

    def make(self, run, directory, time_limit, environment):
        identity, case, overrides = run
        command = [self.solver, "run", f"cases/{case}.toml", "--out", directory / identity, "--threads", "1", "--force"]
        for override in overrides:
            command += ["--set", override]
        return process.run(command, self.tree, time_limit, self.scratch, environment)

    def verdicts(self, runs, environment, out):
        """{id of a row: verdict} of the runs in that directory; None where there is no comparison."""
        shutil.rmtree(out, ignore_errors=True)
        ended = process.run([self.compare, "check", "--runs", runs, "--leave-out", "canary", "--out", out], self.tree,
                            process_limit(self.seconds.get("check", 30.0)), self.scratch, environment)
        if ended.code not in (0, 1):
            return None
        rows = [row for row in json_of(out / "results.json")["results"] if row["reference_kind"] != "aim"]
        self.reads |= {row["id"]: [row[key] for key in ("scene", "against") if row.get(key)] for row in rows}
        return {row["id"]: row["verdict"] for row in rows}

    def traced(self, make):
        """What `make(environment)` gives, and the numbers of the faults it reaches."""
        notes = self.scratch / "reached"
        notes.unlink(missing_ok=True)
        made = make({"GRANVOF_MUTANTS_REACHED": str(notes)})
        return made, set(notes.read_text().split()) if notes.exists() else set()

    def without_fault(self, say):
        """Makes the runs and judges them; what was found for the same programs is taken as it is. What is wrong, else ''."""
        kept = self.work / "rows.json"
        table = hashlib.sha1((self.tree / "compare/checks.toml").read_bytes()).hexdigest()
        stamp = [self.solver.stat().st_mtime_ns, self.compare.stat().st_mtime_ns, table, self.dearest, self.budget, str(self.made)]
        self.runs, self.others = self.plan()
        base = self.work / "runs"
        if kept.exists():
            before = json_of(kept)
            if before["stamp"] == stamp:
                self.reached = {name: set(numbers) for name, numbers in before["reached"].items()}
                self.seconds, self.base = before["seconds"], before["verdicts"]
                return ""
        shutil.rmtree(base, ignore_errors=True)
        base.mkdir(parents=True)
        for run in self.runs:
            begun = time.monotonic()
            ended, self.reached[run[0]] = self.traced(lambda environment: self.make(run, base, 600.0, environment))
            self.seconds[run[0]] = round(time.monotonic() - begun, 2)
            if ended.code != 0:
                return f"the run {run[0]} fails without a fault: {ended.how}"
            say(f"without a fault: {run[0]}, {self.seconds[run[0]]:.1f} s")
        for name in self.others:
            if self.made and (self.made / name).is_dir():
                os.symlink((self.made / name).resolve(), base / name)
        begun = time.monotonic()
        self.base, self.reached["check"] = self.traced(lambda environment: self.verdicts(base, environment, self.work / "verdicts"))
        self.seconds["check"] = round(time.monotonic() - begun, 2)
        if self.base is None:
            return "the rows cannot be judged without a fault"
        write_json(kept, {"stamp": stamp, "reached": {name: sorted(numbers) for name, numbers in self.reached.items()},
                          "seconds": self.seconds, "verdicts": self.base})
        return ""

    def judge(self, mutant):
        """("noticed", the row), ("survived", "") or ("not reached", "")."""
        environment = {"GRANVOF_MUTANT": mutant.number}
        due = [run for run in self.runs if mutant.number in self.reached[run[0]]]
        if not due and mutant.number not in self.reached["check"]:
            return "not reached", ""
        place = self.work / "with-fault"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        for path in (self.work / "runs").iterdir():
            os.symlink(path.resolve(), place / path.name)
        if mutant.number in self.reached["check"]:
            changed = self.changed(place, environment, {run[0] for run in due})
            if changed:
                return "noticed", changed
        remaining, spend = self.in_order(due), self.seconds["check"]
        while remaining:
            batch, spent = 0, 0.0
            while batch < len(remaining) and (batch == 0 or spent < spend):
                run = remaining[batch]
                (place / run[0]).unlink()
                begun = time.monotonic()
                ended = self.make(run, place, process_limit(self.seconds[run[0]]), environment)
                spent += time.monotonic() - begun
                batch += 1
                if ended.code != 0:
                    self.noticed[run[0]] += 1
                    return "noticed", f"run {run[0]}: {ended.how}"
            remaining, spend = remaining[batch:], 2.0 * spend
            changed = self.changed(place, environment, {run[0] for run in remaining} | set(self.others))
            if changed:
                self.noticed[self.reads.get(changed.split(": ")[0], [None])[0]] += 1
                return "noticed", changed
        return "survived", ""

    def in_order(self, due):
        """By what each has noticed so far for a second of its time."""
        return sorted(due, key=lambda run: -(1 + self.noticed[run[0]]) / max(self.seconds[run[0]], 0.01))

    def changed(self, runs, environment, without):
        """The first row with another verdict, or ''; those that read a run of `without`, which lacks the fault, are not asked."""
        now = self.verdicts(runs, environment, self.work / "verdicts-with-fault")
        if now is None:
            return "the comparison fails"
        return next((f"{row}: {self.base.get(row, 'no row')} -> {now.get(row, 'no row')}" for row in {**self.base, **now}
                     if now.get(row) != self.base.get(row) and without.isdisjoint(self.reads.get(row, []))), "")


def process_limit(seconds):
    return 20.0 + 10.0 * seconds
