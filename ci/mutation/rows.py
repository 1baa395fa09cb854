"""The rows of `make verify` against a fault: runs made again with it, those that notice most for their cost first, until
a row changes its verdict. A row counts once every run that it reads is as it would be with the fault in the whole
project: between a run with it and one without, any fault shows. Rows of what a run costs say how busy the machine is."""

import hashlib
import os
import shutil
import subprocess
import tempfile
import time
from collections import Counter
from pathlib import Path

from granvof_files import json_of, write_json
from mutation import process, workers

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

    def make(self, run, directory, time_limit, environment, scratch):
        identity, case, overrides = run
        command = [self.solver, "run", f"cases/{case}.toml", "--out", directory / identity, "--threads", "1", "--force"]
        for override in overrides:
            command += ["--set", override]
        return process.run(command, self.tree, time_limit, scratch, environment)

    def verdicts(self, runs, environment, out, scratch):
        """{id of a row: verdict} of the runs in that directory, None where there is no comparison; {id: runs that it reads}."""
        shutil.rmtree(out, ignore_errors=True)
        ended = process.run([self.compare, "check", "--runs", runs, "--leave-out", "canary", "--out", out], self.tree,
                            process_limit(self.seconds.get("check", 30.0)), scratch, environment)
        if ended.code not in (0, 1):
            return None, {}
        rows = [row for row in json_of(out / "results.json")["results"] if row["reference_kind"] != "aim"]
        return ({row["id"]: row["verdict"] for row in rows},
                {row["id"]: [row[key] for key in ("scene", "against") if row.get(key)] for row in rows})

    def held_against(self, run):
        """Runs that rows of this one read too."""
        return {other for reads in self.reads.values() if run in reads for other in reads if other != run}

    @staticmethod
    def traced(make, scratch):
        """What `make(environment)` gives, and the numbers of the faults it reaches."""
        notes = scratch / "reached"
        notes.unlink(missing_ok=True)
        made = make({"GRANVOF_MUTANTS_REACHED": str(notes)})
        return made, set(notes.read_text().split()) if notes.exists() else set()

    def without_fault(self, say, at_once=1):
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
                self.seconds, self.base, self.reads = before["seconds"], before["verdicts"], before["reads"]
                return ""
        shutil.rmtree(base, ignore_errors=True)
        base.mkdir(parents=True)

        def look(run, scratch):
            begun = time.monotonic()
            ended, reached = self.traced(lambda environment: self.make(run, base, 600.0, environment, scratch), scratch)
            return ended, reached, round(time.monotonic() - begun, 2)

        for run, (ended, reached, seconds) in workers.each(self.runs, look, at_once, self.scratch):
            self.reached[run[0]], self.seconds[run[0]] = reached, seconds
            if ended.code != 0:
                return f"the run {run[0]} fails without a fault: {ended.how}"
            say(f"without a fault: {run[0]}, {seconds:.1f} s")
        for name in self.others:
            if self.made and (self.made / name).is_dir():
                os.symlink((self.made / name).resolve(), base / name)
        begun = time.monotonic()
        (self.base, self.reads), self.reached["check"] = self.traced(
            lambda environment: self.verdicts(base, environment, self.work / "verdicts", self.scratch), self.scratch)
        self.seconds["check"] = round(time.monotonic() - begun, 2)
        if self.base is None:
            return "the rows cannot be judged without a fault"
        write_json(kept, {"stamp": stamp, "reached": {name: sorted(numbers) for name, numbers in self.reached.items()},
                          "seconds": self.seconds, "verdicts": self.base, "reads": self.reads})
        return ""

    def judge(self, mutant, scratch, known=""):
        """("noticed", the row), ("survived", "") or ("not reached", ""). `known`: what noticed the fault before."""
        if mutant.number not in self.reached["check"] and not any(mutant.number in self.reached[run[0]] for run in self.runs):
            return "not reached", ""
        self.work.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=self.work, prefix="with-fault-") as place:
            return WithFault(self, mutant.number, Path(place), scratch).judge(known)

    def in_order(self, due):
        """By what each has noticed so far for a second of its time."""
        return sorted(due, key=lambda run: -(1 + self.noticed[run[0]]) / max(self.seconds[run[0]], 0.01))


class WithFault:
    """A directory of runs, of which some are made with one fault."""

    def __init__(self, rows, number, place, scratch):
        self.rows, self.number, self.scratch = rows, number, scratch
        self.runs, self.out = place / "runs", place / "verdicts"
        self.environment = {"GRANVOF_MUTANT": number}
        self.judged = number in rows.reached["check"]  # the fault is one of what judges
        self.runs.mkdir()

    def judge(self, known):
        due = [run for run in self.rows.runs if self.number in self.rows.reached[run[0]]]
        if self.judged:
            for path in (self.rows.work / "runs").iterdir():
                os.symlink(path.resolve(), self.runs / path.name)
            changed = self.changed({run[0] for run in due})
            if changed:
                return "noticed", changed
        remaining, spend = self.in_order(due, known), self.rows.seconds["check"]
        while remaining:
            batch, spent = 0, 0.0
            while batch < len(remaining) and (batch == 0 or spent < spend):
                run = remaining[batch]
                begun = time.monotonic()
                ended = self.make(run)
                spent += time.monotonic() - begun
                batch += 1
                if ended.code != 0:
                    self.rows.noticed[run[0]] += 1
                    return "noticed", f"run {run[0]}: {ended.how}"
            remaining, spend = remaining[batch:], 2.0 * spend
            changed = self.changed({run[0] for run in remaining} | set(self.rows.others))
            if changed:
                self.rows.noticed[self.rows.reads.get(changed.split(": ")[0], [None])[0]] += 1
                return "noticed", changed
        return "survived", ""

    def make(self, run):
        """With the fault; and beside it, as they are, those that it is held against and that the fault does not reach."""
        if (self.runs / run[0]).is_symlink():
            (self.runs / run[0]).unlink()
        for beside in self.rows.held_against(run[0]):
            if self.number not in self.rows.reached.get(beside, {self.number}) and not (self.runs / beside).exists() and \
                    (self.rows.work / "runs" / beside).exists():
                os.symlink((self.rows.work / "runs" / beside).resolve(), self.runs / beside)
        return self.rows.make(run, self.runs, process_limit(self.rows.seconds[run[0]]), self.environment, self.scratch)

    def in_order(self, due, known):
        """Those that the known row reads first, or the run that failed."""
        first = self.rows.reads.get(known.split(": ")[0], [known.removeprefix("run ").split(":")[0]])
        return sorted(self.rows.in_order(due), key=lambda run: run[0] not in first)

    def changed(self, without):
        """The first row with another verdict, or ''; those that read a run of `without`, which lacks the fault, or one that is
        not here, are not asked."""
        now, reads = self.rows.verdicts(self.runs, self.environment, self.out, self.scratch)
        if now is None:
            return "the comparison fails"
        base = self.rows.base
        here = {path.name for path in self.runs.iterdir()} - without
        return next((f"{row}: {base.get(row, 'no row')} -> {now.get(row, 'no row')}" for row in {**base, **now}
                     if now.get(row) != base.get(row) and here.issuperset(reads.get(row) or self.rows.reads.get(row, []))), "")


def process_limit(seconds):
    return 20.0 + 10.0 * seconds
