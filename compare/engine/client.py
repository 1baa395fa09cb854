"""Runs of granvof made by the run engine (`granvof-compare run`, docs/run-engine.md), which alone starts, limits, times and keeps
them. An order is a dict: id, case, directory; set, threads, program, timed, timings, keep, clear, wall_limit, cpu_limit."""

import json
import subprocess
import sys
import threading
from concurrent.futures import Future
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "ci"), str(ROOT / "solver/python")]

from granvof_files import json_in, json_of  # noqa: E402
from night.together import ends_with_parent  # noqa: E402

FINISHED, BAD_INPUT, SIGNAL, CPU_LIMIT, TIME_LIMIT = "finished", "bad input", "signal", "CPU limit", "time limit"


class EngineError(RuntimeError):
    """The engine itself ended: what it said."""


@dataclass
class Ending:
    """How a run ended (compare/engine/order.hpp)."""
    id: str
    directory: str
    kind: str
    message: str
    code: int
    wall_seconds: float
    cpu_seconds: float
    kilobytes: int
    core_seconds: list
    work_units: list
    beside: int
    kept: bool
    resumed: bool

    @property
    def finished(self):
        return self.kind == FINISHED

    def record(self):
        """run.json; the run must have written one."""
        return json_of(Path(self.directory) / "run.json")


class Engine:
    """An engine at work. Orders may be given from several threads; it ends, and what it runs with it, with the `with` block."""

    def __init__(self, compare, solver, jobs=1, accounts=None, on_start=lambda identity: None):
        command = [str(compare), "run", "-", "--solver", str(solver), "--jobs", str(jobs)]
        if accounts:
            command += ["--accounts", str(accounts)]
        try:
            self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                            preexec_fn=ends_with_parent)
        except OSError as error:
            raise EngineError(f"{compare} cannot be started: {error.strerror}") from error
        self.on_start = on_start
        self.waiting, self.lock = {}, threading.Lock()
        self.said = None  # why it takes no more orders, once it has ended
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def __enter__(self):
        return self

    def __exit__(self, *failure):
        if failure[0]:
            self.process.terminate()
        try:
            self.process.stdin.close()
        except BrokenPipeError:
            pass  # it has ended before
        self.process.wait()
        self.reader.join()
        self.process.stdout.close()
        self.process.stderr.close()

    def submit(self, order):
        """A Future of its Ending; EngineError where the engine ends before."""
        promised = Future()
        with self.lock:
            if order["id"] in self.waiting:
                raise ValueError(f"two orders of the name {order['id']} at once")
            if self.said is not None:
                promised.set_exception(EngineError(self.said))
                return promised
            self.waiting[order["id"]] = promised
            try:
                self.process.stdin.write(json.dumps(order) + "\n")
                self.process.stdin.flush()
            except BrokenPipeError:
                pass  # the reader says why
        return promised

    def _take(self, told):
        if "started" in told:
            self.on_start(told["started"])
            return
        with self.lock:
            promised = self.waiting.pop(told["id"])
        promised.set_result(Ending(**told))

    def make(self, order):
        return self.submit(order).result()

    def _read(self):
        said = ""
        try:
            for line in self.process.stdout:
                self._take(json_in(line))
        except (ValueError, KeyError, TypeError):  # no engine, or one that was killed within a line
            self.process.terminate()
            said = f"{self.process.args[0]} does not speak as a run engine: {line.strip()[:200]}"
        said = self.process.stderr.read().strip() or said or "the run engine has ended"
        with self.lock:
            left, self.waiting, self.said = self.waiting, {}, said
        for promised in left.values():
            promised.set_exception(EngineError(said))


def order(identity, case, directory, assignments=(), **more):
    """`assignments`: "key=value"; `more`: the other keys of an order."""
    return {"id": identity, "case": str(case), "directory": str(directory), "set": list(assignments), **more}
