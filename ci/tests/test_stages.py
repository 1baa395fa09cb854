"""Stages: order, logs, time limits, blocking, resuming."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from night import stages
from night.stages import Stage, StageRun, run_stages

PYTHON = sys.executable
CI = Path(stages.__file__).resolve().parent.parent


def execute(tmp_path, plan, run=None):
    run = run or StageRun(tmp_path / "run")
    run.save()
    run_stages(plan, run, lambda line: None)
    return run


def status(run):
    return {name: outcome.status for name, outcome in run.outcomes.items()}


def test_log_holds_commands_and_output(tmp_path):
    run = execute(tmp_path, [Stage("one", tmp_path, 20, [["echo", "hello"], ["sh", "-c", "echo oops >&2"]])])
    log = (run.directory / "1-one.log").read_text()
    assert log == "$ echo hello\nhello\n$ sh -c echo oops >&2\noops\n"
    assert status(run) == {"one": "passed"}


def test_first_failing_command_ends_the_stage(tmp_path):
    run = execute(tmp_path, [Stage("one", tmp_path, 20, [["sh", "-c", "exit 3"], ["touch", "never"]])])
    assert status(run) == {"one": "failed"}
    assert "exit code 3" in (run.directory / "1-one.log").read_text()
    assert not (tmp_path / "never").exists()


def test_failure_blocks_only_what_needs_it(tmp_path):
    run = execute(tmp_path, [
        Stage("build", tmp_path, 20, [["false"]]),
        Stage("tests", tmp_path, 20, [["touch", "never"]], needs=["build"]),
        Stage("after", tmp_path, 20, [["true"]], needs=["tests"]),
        Stage("report", tmp_path, 20, [["true"]]),
    ])
    assert status(run) == {"build": "failed", "tests": "blocked", "after": "blocked", "report": "passed"}
    assert not (tmp_path / "never").exists()


def test_missing_part_and_missing_program(tmp_path):
    run = execute(tmp_path, [
        Stage("part", tmp_path, 20, [["true"]], part="not/here"),
        Stage("program", tmp_path, 20, [["./not-here"]]),
    ])
    assert status(run) == {"part": "not available", "program": "failed"}


PATIENCE = 120.0  # seconds that a busy machine may take for what takes a moment


def test_watchdog_ends_the_stage_and_its_children(tmp_path, monkeypatch, until, lives):
    monkeypatch.setattr(stages, "GRACE", 0.5)
    # The child ignores the polite request and would outlive its parent.
    child = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); open('up', 'w').close(); time.sleep(1000)"
    parent = (f"import os, subprocess, sys, time; p = subprocess.Popen([sys.executable, '-c', {child!r}]);"
              "open('pid.part', 'w').write(str(p.pid)); os.rename('pid.part', 'pid'); time.sleep(1000)")
    for limit in (1, 4, 16, 64):  # until one is long enough for both to be up when it ends
        place = tmp_path / str(limit)
        place.mkdir()
        started = time.monotonic()
        run = execute(place, [Stage("slow", place, limit, [[PYTHON, "-c", parent]]), Stage("next", place, PATIENCE, [["true"]])])
        assert time.monotonic() - started < limit + PATIENCE
        assert status(run) == {"slow": "timed out", "next": "passed"}
        assert f"time limit of {limit} s" in (run.directory / "1-slow.log").read_text()
        if (place / "up").exists() and (place / "pid").exists():
            break
    pid = int((place / "pid").read_text())
    assert (place / "up").exists() and until(lambda: not lives(pid), PATIENCE)


def test_time_limit_is_for_the_stage_as_a_whole(tmp_path):
    nap = [PYTHON, "-c", "import time; time.sleep(0.8)"]
    run = execute(tmp_path, [Stage("naps", tmp_path, 1.2, [nap, nap])])
    assert status(run) == {"naps": "timed out"}


def limits(left, *own):
    """What stages of these limits get one after the other, where each takes all of it."""
    found, plan = [], [Stage(str(number), Path("."), limit) for number, limit in enumerate(own)]
    for number in range(len(plan)):
        found.append(stages.fitted(plan[number:], left - sum(found)).time_limit)
    return found


def test_whatever_stages_take_they_end_within_the_total():
    assert limits(1000, 10, 20, 30) == [10, 20, 30]  # there is room for all
    half = stages.FLOOR
    assert limits(4 * half, half, 10 * half, 9 * half) == pytest.approx([half, 3 * half * 10 / 19, 3 * half * 9 / 19])  # a short one whole
    for total in (half / 2, half, 3 * half, 10 * half):
        assert sum(limits(total, 2 * half, 16 * half, 8 * half)) <= total
    assert limits(0, 10, 10) == [0, 0]


def test_a_total_ends_what_takes_too_long_but_not_the_report(tmp_path, monkeypatch):
    monkeypatch.setattr(stages, "FLOOR", 0.0)
    run = StageRun(tmp_path / "run")
    run.save()
    nap = [[PYTHON, "-c", "import time; time.sleep(60)"]]
    begun = time.monotonic()
    run_stages([Stage("one", tmp_path, 40, nap), Stage("two", tmp_path, 40, nap), Stage("report", tmp_path, 5, [["true"]])], run,
               lambda line: None, total=7)
    assert time.monotonic() - begun < 20
    assert status(run) == {"one": "timed out", "two": "timed out", "report": "passed"}


def test_resumes_after_the_last_finished_stage(tmp_path):
    count = [["sh", "-c", "echo x >> count"]]
    with pytest.raises(KeyboardInterrupt):
        def interrupt():
            raise KeyboardInterrupt
        execute(tmp_path, [Stage("one", tmp_path, 20, count), Stage("two", tmp_path, 20, action=interrupt)])
    again = StageRun.load(tmp_path / "run")
    assert status(again) == {"one": "passed"} and not again.finished
    run = execute(tmp_path, [Stage("one", tmp_path, 20, count), Stage("two", tmp_path, 20, count)], again)
    assert status(run) == {"one": "passed", "two": "passed"}
    assert (tmp_path / "count").read_text() == "x\nx\n"  # one once, two once


def test_action_decides(tmp_path):
    run = execute(tmp_path, [Stage("good", tmp_path, 20, action=lambda: True), Stage("bad", tmp_path, 20, action=lambda: False)])
    assert status(run) == {"good": "passed", "bad": "failed"}


def test_stage_reads_no_terminal(tmp_path):
    run = execute(tmp_path, [Stage("input", tmp_path, 20, [["cat"]])])
    assert status(run) == {"input": "passed"}
    assert os.path.getsize(run.directory / "1-input.log") < 20


def alive(mark):
    """Processes whose command line holds a text, this one not among them."""
    found = []
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if mark.encode() in entry.read_bytes() and int(entry.parent.name) != os.getpid():
                found.append(int(entry.parent.name))
        except OSError:
            pass  # it ended just now
    return found


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_nothing_outlives_a_night_that_is_ended(tmp_path, number):
    """Not even what a script of a stage left in the background, or started in turn."""
    mark = str(tmp_path / "mark")
    Path(mark).touch()
    text = f"tail -f {mark} & sh -c 'tail -f {mark}; true'; true"
    night = subprocess.Popen([PYTHON, "-c", f"""
import sys
sys.path[:0] = [{str(CI)!r}, {str(CI.parent / "solver/python")!r}]
from pathlib import Path
from night.stages import Stage, StageRun, run_stages
from night.together import end_cleanly_on_signals
end_cleanly_on_signals()
run = StageRun(Path({str(tmp_path / 'run')!r}))
run.save()
run_stages([Stage("one", Path({str(tmp_path)!r}), 600, [["sh", "-c", {text!r}]])], run, print)
"""])
    tails = lambda: [pid for pid in alive(mark) if Path(f"/proc/{pid}/comm").read_text() == "tail\n"]  # noqa: E731
    deadline = time.monotonic() + 60
    while len(tails()) < 2 and time.monotonic() < deadline:
        time.sleep(0.05)
    night.send_signal(number)
    night.wait(30)
    while alive(mark) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not alive(mark)
