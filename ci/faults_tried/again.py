"""Programs that take long and start others, ended in their midst and started again: the same results, and none of before."""

import csv
import json
import os
import shutil
import signal
import subprocess
import time

from faults_tried.bench import TableError, told_of_our_end
from faults_tried.orphans import END, as_from_a_terminal, processes_of, wait_until

LONG = 900.0  # seconds


def result_of(place, name, members=None, cost=None):
    """The bytes of a result; with `members` the second of each step by the first, with `cost` the table without that column: costs, and
    what is tried by them, are not the same twice. None where it is not there. Places in it are not the same twice either."""
    path = place / name
    if cost and path.exists():
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        return None if any(cost not in row for row in rows) else [{column: row[column] for column in row if column != cost} for row in rows]
    if members and path.exists():
        return {step[members[0]]: step[members[1]] for step in json.loads(path.read_bytes())["steps"]}
    return path.read_bytes().replace(str(place).encode(), b"") if path.exists() else None


def is_same(one, other):
    """Two results: to the byte, or in all steps that both have, which must be some."""
    if not isinstance(one, dict) or not isinstance(other, dict):
        return one == other
    return one.keys() & other.keys() != set() and all(one[step] == other[step] for step in one.keys() & other.keys())


def finished_in(place):
    """When each run below a place that has finished was written."""
    finished = {}
    for path in place.rglob("run.json"):
        try:
            if json.loads(path.read_bytes())["exit"]["state"] == "finished" and (path.parent / "made.json").exists():
                finished[path] = os.stat(path).st_mtime_ns
        except (ValueError, KeyError, OSError):
            pass  # it had just begun
    return finished


def ended_after(command, place, root, seconds, number):
    """Starts a command, ends it after so many seconds, and waits for all that it has started."""
    with open(place / "said", "w") as said:
        running = subprocess.Popen([str(part) for part in command], cwd=root, stdin=subprocess.DEVNULL, stdout=said, stderr=said,
                                   preexec_fn=told_of_our_end(as_from_a_terminal))
        try:
            running.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            running.send_signal(number)
        running.wait()
    return wait_until(lambda: not processes_of(place), END)


def begun_again(bench, entry):
    """Killed at a random moment, over the results of before, and started again: what stands there meanwhile is none of before, and in
    the end it is what a call that was let alone leaves."""
    first = bench.place()
    begun = time.monotonic()
    whole = bench.call(bench.filled(entry["command"], work=first), patience=LONG)
    length = time.monotonic() - begun
    apart = entry.get("members"), entry.get("cost")
    result = result_of(first, entry["result"], *apart)
    if whole is None or whole.returncode != 0 or result is None:
        raise TableError(f"{' '.join(entry['command'])}: exit code {whole and whole.returncode}: {whole and (whole.stdout + whole.stderr)[-200:]!r}")
    for number in bench.some(range(entry["times"]), entry["sample"]):
        place = bench.place()
        if over_old := number % 2 == 1:
            shutil.copytree(first, place, dirs_exist_ok=True)
        name = ("KILL", "TERM", "INT")[number % 3]
        started = time.time_ns()
        command = bench.filled(entry["command"], work=place)
        why = "" if ended_after(command, place, bench.root, bench.chance.uniform(0.1, 1.0) * length, getattr(signal, "SIG" + name)) else "something was left running"
        path = place / entry["result"]
        if not why and over_old and path.exists() and os.stat(path).st_mtime_ns < started and entry.get("replaces", True):
            begun_it = any(part.stat().st_mtime_ns > started for part in (place / "out/runs").rglob("*"))
            why = "the results of before stand there" if begun_it else ""
        made = finished_in(place) if entry.get("keeps") else {}
        ended = bench.call([*command, *(entry.get("again", []) if number % 4 > 1 else [])], patience=LONG)
        if not why and (ended is None or ended.returncode != 0):
            why = f"started again: exit code {ended and ended.returncode}: {ended and (ended.stdout + ended.stderr)[-200:]!r}"
        again = [path for path, at in made.items() if not path.exists() or os.stat(path).st_mtime_ns != at]
        if not why and again:
            why = f"{len(again)} of {len(made)} finished runs were made again"
        if not why and not is_same(result_of(place, entry["result"], *apart), result):
            why = f"other results in {entry['result']}"
        yield f"{name} to {' '.join(entry['command'][:2])}, try {number + 1}", why
        bench.drop(place / "any")
