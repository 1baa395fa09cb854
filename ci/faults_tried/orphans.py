"""Programs that start others, ended by a signal: nothing that they started goes on, and the next start finds its way free."""

import json
import os
import signal
import subprocess
import time
from pathlib import Path

from faults_tried.bench import NotTried, TableError, told_of_our_end

START = 180.0  # seconds until the program has started another
REPORT = 900.0  # seconds until it has said what it made of that
END = 30.0  # seconds after the signal in which all of them must have gone


def processes_of(place):
    """Processes that have a place in their command or work in it: number and command."""
    found = {}
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            command = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            inside = Path(os.readlink(entry / "cwd")).is_relative_to(place)
            ended = (entry / "stat").read_text().rpartition(")")[2].split()[0] == "Z"
        except OSError:
            continue  # it has ended, or is another user's
        if (inside or f"{place}/" in command) and not ended:
            found[int(entry.name)] = command
    return found


def wait_until(true, longest):
    until = time.monotonic() + longest
    while not true():
        if time.monotonic() > until:
            return False
        time.sleep(0.05)
    return True


def as_from_a_terminal():
    """A shell's background job ignores these, nohup SIGHUP, and both hand that on."""
    for number in (signal.SIGINT, signal.SIGQUIT, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def ended_in_the_midst(command, place, child, number, root):
    """Why something was left of a command that got the signal once a process with `child` in its command was there."""
    with open(place / "said", "w") as said:
        running = subprocess.Popen([str(part) for part in command], cwd=root, stdin=subprocess.DEVNULL, stdout=said,
                                   stderr=said, preexec_fn=told_of_our_end(as_from_a_terminal))

    def begun():
        return running.poll() is not None or any(child in words for pid, words in processes_of(place).items()
                                                 if pid != running.pid)

    if not wait_until(begun, START) or running.poll() is not None:
        running.kill()
        running.wait()
        raise TableError(f"{command[0]}: it has started no {child}: {(place / 'said').read_text()[-200:].strip()!r}")
    running.send_signal(number)
    wait_until(lambda: running.poll() is not None, END)
    gone = wait_until(lambda: not processes_of(place), END)
    left = processes_of(place)
    for pid in left:  # they are of this try: their command names its place
        os.kill(pid, signal.SIGKILL)
    running.wait()
    return "" if gone else f"{len(left)} left, as {next(iter(left.values()), '?')[:100]!r}"


def ended_children(bench, entry):
    """What a program has started is ended from without, or a library ends it from within: it says so, and so does its record."""
    if "{demvof}" in entry["command"] and not bench.demvof.exists():
        raise NotTried("demvof was not built")
    for name in bench.some(entry["signals"], entry["sample"]):
        place = bench.place()
        (place / "checks.toml").write_text(entry.get("checks", ""))
        running = subprocess.Popen(bench.filled(entry["command"], work=place), cwd=bench.root, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=told_of_our_end())

        def children():
            return [pid for pid, words in processes_of(place).items() if pid != running.pid and entry["starts"] in words]

        record = place / entry["record"]
        wait_until(lambda: running.poll() is not None or (children() and record.exists()), START)
        for pid in children():
            os.kill(pid, getattr(signal, "SIG" + name))
        try:
            said = running.communicate(timeout=REPORT)[0].decode(errors="replace")
        except subprocess.TimeoutExpired:
            running.kill()
            running.wait()
            said = ""
        state = json.loads(record.read_text())["exit"] if record.exists() else {}
        why = "" if running.returncode == 1 else f"exit code {running.returncode}: {said[-200:]!r}"
        if entry.get("states") and not why and state.get("state") != entry["states"]:
            why = f"{entry['record']} says {state}"
        yield f"{name} to what {' '.join(entry['command'][:2])} has started", why or ("" if said.strip() else "it said nothing")
        bench.drop(place / "any")


def orphans(bench, entry):
    """Ended while what it started goes on: nothing is left running."""
    if "demvof" in entry["starts"] and not bench.demvof.exists():
        raise NotTried("demvof was not built")
    for name in bench.some(entry["signals"], entry.get("sample", len(entry["signals"]))):
        place = bench.place()
        (place / "checks.toml").write_text(entry.get("checks", ""))
        (place / "plan").write_text(entry.get("plan", "").replace("PLACE", str(place)) + "\n")
        command = bench.filled(entry["command"], work=place)
        yield (f"{name} to {' '.join(entry['command'][:2])}",
               ended_in_the_midst(command, place, entry["starts"], getattr(signal, "SIG" + name), bench.root))
        bench.drop(place / "any")
