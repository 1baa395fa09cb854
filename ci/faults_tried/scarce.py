"""Runs that lack something: room on the disk, memory, descriptors, standard streams; and long runs that must not need more."""

import itertools
import json
import resource
import time
from pathlib import Path

from faults_tried.runs import SmallRun, crashed, same_content

SETTLED = 0.25  # share of a long run after which its memory has its size
ENDS = 0.98  # share after which it may be ending: joining the fields takes memory once, and a busy machine makes that last
GROWTH = 1.02  # of the memory beyond that: what the allocator may keep, not what a leak of one byte a step would take


def judged(run, out, ended):
    """A run that was short of something: it says so, or its output is whole; with enough of it, it goes on."""
    if why := crashed(ended):
        return why
    if ended.returncode == 0 and run.same_bytes(out) and not same_content(out, run.whole):
        return "exit code 0, and its files are others"
    return run.why_not_whole(out)


def full_disks(bench, entry):
    """A disk that is full after so many bytes (a call that fails), or a file that may not grow beyond so many."""
    run = SmallRun(bench, entry)
    sizes = [path.stat().st_size for path in run.whole.rglob("*") if path.is_file()]
    for share in bench.some(entry["shares"], entry["sample"]):
        out = bench.place() / "run"
        ended = run.go(out, environment=bench.shimmed(FAULT_BYTES=str(int(share * sum(sizes)))))
        yield f"a disk with room for {share:g} of the run", judged(run, out, ended)
        out = bench.place() / "run"
        ended = run.go(out, preexec_fn=limit(resource.RLIMIT_FSIZE, int(share * max(sizes))))
        yield f"files of at most {share:g} of the largest", judged(run, out, ended)


def limit(what, value):
    return lambda: resource.setrlimit(what, (value, value))


LIMITS = {"memory": resource.RLIMIT_AS, "descriptors": resource.RLIMIT_NOFILE, "cpu": resource.RLIMIT_CPU,
          "stack": resource.RLIMIT_STACK}


def limits(bench, entry):
    """ulimit: an error that is said, or no harm done."""
    run = SmallRun(bench, entry)
    for value in bench.some(entry["values"], entry["sample"]):
        out = bench.place() / "run"
        ended = run.go(out, preexec_fn=limit(LIMITS[entry["of"]], value))
        yield f"{entry['of']}: {value}", judged(run, out, ended)


def closed_streams(bench, entry):
    """Standard streams that the caller has closed: the same files, and nothing of the messages in them."""
    run = SmallRun(bench, entry)
    tries = [closed for count in range(4) for closed in itertools.combinations(range(3), count)]
    for closed in bench.some(tries, len(tries)):
        out = bench.place() / "run"
        shell = " ".join(["exec", '"$@"', *(f"{stream}{'<' if stream == 0 else '>'}&-" for stream in closed)])
        ended = bench.call(["/bin/sh", "-c", shell, "sh", *run.command(out)], patience=600)
        why = "" if ended is not None and ended.returncode == 0 else f"exit code {ended and ended.returncode}"
        yield f"closed: {', '.join(map(str, closed)) or 'none'}", why or run.same_bytes(out)


def resident(process):
    """Memory in use [kB]; None where the process has gone."""
    try:
        for line in Path(f"/proc/{process.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1])
    except OSError:
        pass
    return None


def long_runs(bench, entry):
    """Many steps of a small scene: the memory has its size after the first of them. Not in a sample."""
    if bench.sample:
        return
    run = SmallRun(bench, entry)
    out = bench.place() / "run"
    sets = [word for key, value in entry["long"].items() for word in ("--set", f"{key}={value}")]
    running = run.start(out, *sets)
    seen = []
    while running.poll() is None:
        if (kilobytes := resident(running)) is not None:
            seen.append((time.monotonic(), kilobytes))
        time.sleep(0.2)
    why = f"exit code {running.returncode}" if running.returncode != 0 else fewer_steps(out, entry["steps"]) or grown(seen)
    yield f"{entry['case']}: {entry['steps']} steps", why


def fewer_steps(out, least):
    steps = json.loads((out / "run.json").read_text())["steps"]
    return f"{steps} steps only" if steps < least else ""


def grown(seen):
    """Why memory (pairs of time and kB) grows; empty where it does not."""
    if len(seen) < 8:
        return "too short to be judged"
    begun, ended = seen[0][0], seen[-1][0]
    early = max(kilobytes for at, kilobytes in seen if at <= begun + SETTLED * (ended - begun))
    late = max(kilobytes for at, kilobytes in seen if at <= begun + ENDS * (ended - begun))
    return f"{early} kB after {SETTLED:g} of the run, {late} kB at most" if late > GROWTH * early else ""
