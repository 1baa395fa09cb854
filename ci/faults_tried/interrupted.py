"""Runs that are cut short, at random and at every call that changes a file, and go on."""

import errno
import json
import shutil
import signal
import time

from faults_tried.runs import SmallRun, crashed, stops, tree_of


def kills(bench, entry):
    """Killed or stopped at a random moment, then resumed (begun anew where nothing was there): the same files."""
    run = SmallRun(bench, entry)
    begun = time.monotonic()
    run.go(bench.place() / "run")
    length = time.monotonic() - begun
    for number in bench.some(range(entry["times"]), entry["sample"]):
        out = bench.place() / "run"
        running = run.start(out)
        time.sleep(bench.chance.uniform(0.0, length))
        running.send_signal(bench.chance.choice([signal.SIGKILL, signal.SIGTERM]))
        running.wait()
        yield f"kill {number + 1}", run.why_not_whole(out)
        bench.drop(out)


def at_calls(bench, entry):
    """The run, and the numbers of its calls at which something happens: every `step`-th, and `beyond` more for the process that
    joins the fields, whose calls are not counted."""
    run = SmallRun(bench, entry)
    return run, bench.some(range(1, bench.calls_of(run) + entry.get("beyond", 0) + 1, entry.get("step", 1)), entry["sample"])


def kills_at_calls(bench, entry):
    """Killed at the n-th call that changes a file (a write: after half of its bytes), then as above."""
    run, numbers = at_calls(bench, entry)
    for number in numbers:
        out = bench.place() / "run"
        ended = run.go(out, environment=bench.shimmed(FAULT_CALL=str(number)))
        why = "" if ended is not None and ended.returncode == -signal.SIGKILL else "it was not killed"
        yield f"{entry['case']}, call {number}", why or run.why_not_whole(out)
        bench.drop(out)


def signals_at_calls(bench, entry):
    """A signal at the n-th call that changes a file, the last ones too: the end is written, and it goes on as above."""
    run, numbers = at_calls(bench, entry)
    for name in entry["signals"]:
        for number in numbers:
            out = bench.place() / "run"
            ended = run.go(out, environment=bench.shimmed(FAULT_CALL=str(number), FAULT_SIGNAL=str(int(getattr(signal, name)))))
            before = ended is not None and ended.returncode == -getattr(signal, name) and not out.exists()  # it had not begun
            yield (f"{entry['case']}, call {number}: {name}",
                   "" if before else crashed(ended) or end_not_written(out) or run.why_not_whole(out))
            bench.drop(out)


def swaps_at_calls(bench, entry):
    """Another run is put in its place at the n-th call that changes a file: the other stays as it is, and what was moved goes on
    from where it was as above, to its end at once where it does not notice any more."""
    run, numbers = at_calls(bench, entry)
    other = bench.place() / "run"
    run.go(other, sets=entry["other"])
    before = tree_of(other)
    for number in numbers:
        out = bench.place() / "run"
        running = run.start(out, environment=bench.shimmed(FAULT_CALL=str(number), FAULT_SIGNAL=str(int(signal.SIGSTOP))))
        moved = out.with_name("moved")
        if stops(running) and out.exists():
            out.rename(moved)
            shutil.copytree(other, out)
        running.send_signal(signal.SIGCONT)
        code = running.wait()
        if moved.exists():
            wrong = "" if tree_of(out) == before else "it wrote into the other"
            wrong = wrong or ("" if code in (0, 1, 2) else f"exit code {code}") or run.why_not_whole(moved)
        else:
            wrong = f"exit code {code}" if code else run.same_bytes(out)
        yield f"{entry['case']}, call {number}", wrong
        bench.drop(out)


def end_not_written(out):
    """Why run.json does not say how the run ended; empty where it does, or where there is none."""
    if not (out / "run.json").exists():
        return ""
    state = json.loads((out / "run.json").read_text())["exit"]["state"]
    return "run.json says that it runs" if state == "running" else ""


def failing_calls(bench, entry):
    """The n-th call fails: an error that is said, or no harm done; then as above."""
    run, numbers = at_calls(bench, entry)
    for name in entry["errors"]:
        for number in numbers:
            out = bench.place() / "run"
            ended = run.go(out, environment=bench.shimmed(FAULT_CALL=str(number), FAULT_ERRNO=str(getattr(errno, name))))
            yield f"{entry['case']}, call {number}: {name}", crashed(ended) or run.why_not_whole(out)
            bench.drop(out)
