"""Scripts that start what takes long, ended by a signal: what they started ends too."""

import os
import signal
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent

# What each starts first, and under which name; the stand-in answers what it is asked before.
STARTED = {
    "ci/faults": (["--build-dir", "BUILD", "--only", "outputs"], "solver/granvof", "check"),
    "ci/faults --jobs": (["--build-dir", "BUILD", "--only", "odd_cases", "--jobs", "2"], "solver/granvof", "check"),
    "reference/record": (["--build-dir", "BUILD", "--out", "OUT", "canary-dry"], "reference/demvof/demvof", "run"),
    "compare/lay/lay": (["--build-dir", "BUILD", "--scene", "canary", "--series", "SERIES", "--out", "OUT"], "compare/granvof-compare", "lay"),
}
STAND_IN = """case $1 in
  WORD) echo $$ > PLACE/pid.part && mv PLACE/pid.part PLACE/pid; exec sleep 300;;
  *) echo 1111111111111111 2222222222222222;;
esac
"""


@pytest.mark.parametrize("name", ["TERM", "KILL"])
@pytest.mark.parametrize("script", STARTED)
def test_what_was_started_ends_with_who_started_it(tmp_path, shell, until, lives, script, name):
    words, program, word = STARTED[script]
    for path in ("solver/granvof", "compare/granvof-compare", "reference/demvof/demvof"):
        (tmp_path / "build" / path).parent.mkdir(parents=True, exist_ok=True)
        shell(tmp_path / "build" / path, STAND_IN.replace("WORD", word if path == program else "nothing").replace("PLACE", str(tmp_path)))
    (tmp_path / "series.csv").write_text("time [s],front_dense [m]\n0,0.1\n1,0.2\n")
    given = {"BUILD": tmp_path / "build", "OUT": tmp_path / "out", "SERIES": tmp_path / "series.csv"}
    running = subprocess.Popen([ROOT / script.split()[0], *(given.get(part, part) for part in words)], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    started = until(lambda: (tmp_path / "pid").exists() or running.poll() is not None, 60.0)
    assert started and running.poll() is None, running.stderr.read()
    pid = int((tmp_path / "pid").read_text())
    running.send_signal(getattr(signal, "SIG" + name))
    running.wait()
    gone = until(lambda: not lives(pid), 10.0)
    if not gone:
        os.kill(pid, signal.SIGKILL)
    assert gone
