"""compare/verify with programs that stand in for granvof and granvof-compare."""

import importlib.machinery
import importlib.util
import json
import signal
import stat
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
SCRIPT = ROOT / "compare/verify"
COMPARE = ROOT / "build/release/compare/granvof-compare"


@pytest.fixture
def verify(monkeypatch):
    loader = importlib.machinery.SourceFileLoader("verify_script", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("verify_script", loader))
    loader.exec_module(module)
    monkeypatch.setattr(module, "make_report", lambda out: 0)
    monkeypatch.setattr(module, "run_canary", lambda build_dir, out: ("not run", "demvof is not built"))
    return module


def program(path, body):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#!/bin/sh\n" + body)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


LEAVES = """while [ $# -gt 0 ]; do [ "$1" = --out ] && out=$2; shift; done; mkdir -p $out
echo '{"exit": {"state": "finished", "kind": "finished"}, "core_seconds": 1}' > $out/run.json
"""


def plan_of(build):
    orders = [{"id": "a", "case": str(ROOT / "cases/s1.toml"), "directory": str(build / "out/runs/a"), "set": []},
              {"id": "b", "case": str(ROOT / "cases/s1.toml"), "directory": str(build / "out/runs/b"),
               "set": ["grid.dx=0.005", "model.drag=false"]}]
    return "\n".join(json.dumps(order) for order in orders)


def stand_ins(build, check_code=0, solver=LEAVES, other=""):
    """The plan is of two runs, which the real run engine makes."""
    program(build / "compare/granvof-compare",
            f"case \"$1\" in plan) echo '{plan_of(build)}'; exit 0;; run) exec {COMPARE} \"$@\";; esac\n{other}\nexit {check_code}\n")
    program(build / "solver/granvof", f'[ "$1" = --version ] && echo "granvof 1.0 (abc)" && exit\necho "$@" >> "{build}/calls"\n{solver}\n')
    return ["--build-dir", str(build), "--out", str(build / "out"), "--jobs", "2"]


def test_runs_what_the_plan_says(verify, tmp_path, capsys):
    assert verify.main(stand_ins(tmp_path)) == 0
    calls = sorted((tmp_path / "calls").read_text().splitlines())
    assert len(calls) == 2
    assert "cases/s1.toml" in calls[0] and calls[0].endswith("out/runs/a --threads 1 --force")
    assert calls[1].endswith("out/runs/b --threads 1 --force --set grid.dx=0.005 --set model.drag=false")
    printed = capsys.readouterr().out
    assert "a " in printed and "done" in printed
    assert len((tmp_path / "out/runs/accounts.csv").read_text().splitlines()) == 3


def test_what_was_made_is_kept_only_where_it_is_asked_for(verify, tmp_path, capsys):
    arguments = stand_ins(tmp_path)
    calls = lambda: len((tmp_path / "calls").read_text().splitlines())  # noqa: E731
    assert verify.main([*arguments, "--go-on"]) == 0
    assert verify.main([*arguments, "--go-on"]) == 0
    assert calls() == 2 and "kept" in capsys.readouterr().out
    assert verify.main(arguments) == 0
    assert calls() == 4


def test_the_canary_can_be_left_out(verify, tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(verify, "run_canary", lambda build_dir, out: asked.append(out) or ("agrees", "said"))
    arguments = stand_ins(tmp_path, other=f'echo "$@" >> "{tmp_path}/checked"')
    assert verify.main([*arguments, "--without-canary"]) == 0
    assert verify.main(arguments) == 0
    without, with_it = (tmp_path / "checked").read_text().splitlines()
    assert "--canary" not in without and without.endswith("--leave-out canary") and with_it.endswith("--canary agrees --canary-note said")
    assert len(asked) == 1


def test_a_failed_run_is_named_with_its_reason(verify, tmp_path, capsys):
    arguments = stand_ins(tmp_path, solver='echo "step collapse at t = 0.1 s" >&2; exit 1')
    assert verify.main(arguments) == 1
    printed = capsys.readouterr()
    assert "FAILED, exit code 1: step collapse at t = 0.1 s" in printed.out
    assert "runs that failed: " in printed.err


def test_figures_that_the_readme_no_longer_states_are_said(verify, tmp_path, capsys):
    kept = json.loads((SCRIPT.parent / "kept/verify/results.json").read_text())["rows"][0]
    out, judged = tmp_path / "out/verify", tmp_path / "judged.json"
    arguments = stand_ins(tmp_path, other=f"mkdir -p '{out}'; cp '{judged}' '{out}/results.json'")

    def run_with(verdict):
        judged.write_text(json.dumps({"date": "", "frequency": "short", "runs": [], "results": [kept | {"verdict": verdict}]}))
        assert verify.main(arguments) == 0, "verdicts decide the exit code, the README does not"
        return capsys.readouterr().out

    assert "README" not in run_with(kept["verdict"])
    assert f"state other results in 1 places, as {kept['id']}: kept " in run_with("stale")


def test_results_of_before_do_not_stand_for_those_of_now(verify, tmp_path):
    """It is ended before it has judged anything, here by its runs: no page of runs that are gone."""
    for name in ("results.json", "report.html"):
        (tmp_path / "out/verify").mkdir(parents=True, exist_ok=True)
        (tmp_path / "out/verify" / name).write_text("of before")
    assert verify.main(stand_ins(tmp_path, check_code=2)) == 2
    assert not (tmp_path / "out/verify/results.json").exists() and not (tmp_path / "out/verify/report.html").exists()
    assert (tmp_path / "out/verify-before/results.json").read_text() == "of before"


def test_an_unexpected_verdict_is_the_exit_code(verify, tmp_path):
    assert verify.main(stand_ins(tmp_path, check_code=1)) == 1


def test_bad_input_is_two(verify, tmp_path):
    assert verify.main(stand_ins(tmp_path, check_code=2)) == 2


def test_a_run_that_hangs_is_stopped(verify, tmp_path, capsys):
    assert verify.main(stand_ins(tmp_path, solver="exec sleep 60") + ["--timeout", "0.3"]) == 1
    assert "ended after 0.3 s" in capsys.readouterr().out


def test_a_missing_program_is_named(verify, tmp_path, capsys):
    assert verify.main(["--build-dir", str(tmp_path), "--out", str(tmp_path / "out")]) == 2
    assert "granvof-compare is missing" in capsys.readouterr().err


def test_plots_alone_need_results(verify, tmp_path, capsys):
    assert verify.main(["--out", str(tmp_path), "--plots-only"]) == 2
    assert "no results" in capsys.readouterr().err


def running(pattern):
    """Process ids whose command line holds a text."""
    found = []
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if pattern.encode() in entry.read_bytes():
                found.append(int(entry.parent.name))
        except OSError:
            pass  # it ended just now
    return found


def wait_for(condition, seconds=30.0):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.05)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL, signal.SIGHUP, signal.SIGINT])
def test_no_run_outlives_the_verification(tmp_path, number):
    arguments = stand_ins(tmp_path, solver=f"exec tail -f {tmp_path}/calls {tmp_path}/mark")
    (tmp_path / "mark").touch()
    # A shell's background job, as a test may be one, ignores SIGINT and hands that on.
    started = subprocess.Popen([SCRIPT, *arguments, "--without-canary"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    runs = lambda: [pid for pid in running(f"{tmp_path}/mark") if pid != started.pid]  # noqa: E731
    wait_for(lambda: len(runs()) == 2)
    started.send_signal(number)
    started.wait(30)
    wait_for(lambda: not runs(), 10)
    assert started.returncode != 0


def test_a_second_start_says_what_holds_the_directory(tmp_path):
    arguments = stand_ins(tmp_path, solver="exec sleep 60")
    first = subprocess.Popen([SCRIPT, *arguments, "--without-canary"], stdout=subprocess.DEVNULL)
    try:
        wait_for(lambda: (tmp_path / "calls").exists())
        second = subprocess.run([SCRIPT, *arguments], capture_output=True, text=True)
        assert second.returncode == 2
        assert f"in use by compare/verify (process {first.pid})" in second.stderr and second.stderr.count("\n") == 1
    finally:
        first.terminate()
        first.wait(30)


def test_a_place_that_cannot_be_written_is_one_line(tmp_path):
    arguments = stand_ins(tmp_path)
    (tmp_path / "out").write_text("a file")
    ended = subprocess.run([SCRIPT, *arguments], capture_output=True, text=True)
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1 and "OUT=DIR takes another directory" in ended.stderr
