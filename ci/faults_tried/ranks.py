"""Runs of several processes under mpirun: what one of them meets is met by all."""

import json
import os
import shutil
import signal
import subprocess
from pathlib import Path

from faults_tried.bench import NotTried
from faults_tried.orphans import START, processes_of, wait_until
from faults_tried.runs import SmallRun

END = 120.0  # seconds after a signal in which mpirun must have ended: it waits for all
MPIRUN = ("--oversubscribe", "--allow-run-as-root", "--bind-to", "none")  # as root on a small machine too


def ranks_of(place):
    """Number of the process by rank, of the run below `place`."""
    found = {}
    for pid in processes_of(place):
        try:
            environment = Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
        except OSError:
            continue  # it has ended
        found |= {int(word.partition(b"=")[2]): pid for word in environment if word.startswith(b"OMPI_COMM_WORLD_RANK=")}
    return found


class SharedRun(SmallRun):
    """The run of so many processes. NotTried where there is no mpirun, or the solver was built without MPI."""

    def __init__(self, bench, entry, processes):
        mpirun = shutil.which("mpirun")
        if not mpirun:
            raise NotTried("mpirun is not installed")
        self.before = [mpirun, *MPIRUN, "-np", str(processes)]
        super().__init__(bench, entry)
        if json.loads((self.whole / "run.json").read_text())["ranks"] != processes:
            raise NotTried("the solver was built without MPI")

    def command(self, out, *words, sets=()):
        return [*self.before, *super().command(out, *words, sets=sets)]


def told(run, place, rank, number, processes):
    """Why a run does not end as it should once the process of that rank has got the signal."""
    out = place / "run"
    running = run.start(out)
    wait_until(lambda: running.poll() is not None or (out / "checkpoint.h5").exists(), START)
    found = ranks_of(place)
    if running.poll() is not None or len(found) != processes:
        running.kill()
        running.wait()
        return f"{len(found)} of {processes} processes were there to be told"
    os.kill(found[rank], number)
    try:
        code = running.wait(timeout=END)
    except subprocess.TimeoutExpired:
        running.terminate()
        running.wait()
        return f"it goes on {END:g} s later"
    ended = json.loads((out / "run.json").read_text())["exit"]
    if (code, ended["state"]) != (1, "stopped") or number.name not in ended["reason"]:
        return f"exit code {code}, run.json says {ended}"
    return run.why_not_whole(out)


def signals_to_ranks(bench, entry):
    """A signal to one of several processes: all end with a checkpoint, and go on from it to the same files."""
    tries = [(processes, rank, name) for processes in entry["processes"] for rank in range(processes) for name in entry["signals"]]
    runs = {}
    for processes, rank, name in bench.some(tries, entry["sample"]):
        if processes not in runs:
            runs[processes] = SharedRun(bench, entry, processes)
        run, place = runs[processes], bench.place()
        yield f"{name} to process {rank} of {processes}", told(run, place, rank, getattr(signal, "SIG" + name), processes)
        bench.drop(place / "any")
