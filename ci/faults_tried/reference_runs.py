"""Runs of the reference, which writes no checkpoints: ended, or short of something, they say so, and begun again they are whole."""

import json
import signal
import time

from faults_tried.bench import NotTried
from faults_tried.runs import SmallRun, crashed


class ReferenceRun(SmallRun):
    """An entry's case by demvof. It is begun again where it was ended: it does not resume."""

    def command(self, out, *words, sets=()):
        overrides = [word for given in (*self.entry["set"], *sets) for word in ("--set", given)]
        return [str(word) for word in (self.bench.demvof, "run", self.entry["case"], *overrides, "--out", out,
                                       "--scratch", out.parent / "scratch", *words)]

    def go_on(self, out):
        return self.go(out)

    def why_not_whole(self, out):
        return super().why_not_whole(out) or ("its scratch files stay" if (out.parent / "scratch").exists() and any((out.parent / "scratch").iterdir()) else "")


def reference_runs(bench, entry):
    """demvof ended at a moment, or short of disk: it says so, its record too, and begun again it is whole."""
    if not bench.demvof.exists():
        raise NotTried("demvof was not built")
    begun = time.monotonic()
    run = ReferenceRun(bench, entry)
    length = time.monotonic() - begun
    tries = [("signal", name) for name in entry["signals"]] + [("disk", size) for size in entry["bytes"]] + [("call", name) for name in entry["errors"]]
    for what, how in bench.some(tries, entry["sample"]):
        out = bench.place() / "run"
        if what == "signal":
            running = run.start(out)
            time.sleep(bench.chance.uniform(0.05, 0.95) * length)
            running.send_signal(getattr(signal, "SIG" + how))
            running.wait()
            why = not_ended(out) if how != "KILL" and running.returncode != 0 else ""
            why = why or ("" if running.returncode in (0, 1, -getattr(signal, "SIG" + how)) else f"exit code {running.returncode}")
        elif what == "disk":
            why = crashed(run.go(out, environment=bench.shimmed(FAULT_BYTES=str(how))))
        else:
            why = crashed(run.go(out, environment=bench.shimmed(FAULT_CALL=str(bench.chance.randrange(1, bench.calls_of(run))), FAULT_ERRNO=str(how))))
        yield f"{what} {how}", why or run.why_not_whole(out)
        bench.drop(out)


def not_ended(out):
    """Why the record of a run that has ended says that it goes on."""
    record = out / "run.json"
    return "run.json says that it runs" if record.exists() and json.loads(record.read_text())["exit"]["state"] == "running" else ""
