"""The whole nightly run on a small repository whose parts are a few lines each."""

import fcntl
import json
import os
import shutil
import signal
import subprocess
from pathlib import Path

import pytest

CI = Path(__file__).resolve().parent.parent

VERIFY = """#!/usr/bin/python3
import json, pathlib, sys
value = float(pathlib.Path("value").read_text())
out = pathlib.Path("out/verify"); out.mkdir(parents=True)
results = [{"id": "s1-run-out", "scene": "s1", "metric": "run_out@10", "unit": "-", "value": value, "reference": 2.1,
            "verdict": "agrees", "unexpected": False}]
runs = [{"id": "s1", "numbers": {"core_seconds": 3.0}}]
(out / "results.json").write_text(json.dumps({"results": results, "runs": runs}))
"""
MAKEFILE = """test:
\t@echo tests with labels $(LABELS)
sanitize tidy:
\t@echo $@ with REFERENCE=$(REFERENCE)
"""
PERFORMANCE = """#!/usr/bin/python3
import json, sys
json.dump({"s1 least core-seconds": {"value": 3.0, "unit": "s"}}, open(sys.argv[sys.argv.index("--times") + 1], "w"))
"""


def git(repository, *arguments):
    subprocess.run(["git", "-c", "user.name=tester", "-c", "user.email=tester@example.org", *arguments],
                   cwd=repository, check=True, capture_output=True)


@pytest.fixture
def repository(tmp_path):
    root = tmp_path / "repository"
    (root / "ci").mkdir(parents=True)
    (root / "compare/report").mkdir(parents=True)
    shutil.copytree(CI / "night", root / "ci/night", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(CI.parent / "solver/python", root / "solver/python", ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("nightly", "bless"):
        shutil.copy(CI / name, root / "ci" / name)
    scripts = {"ci/setup": "#!/bin/sh\n", "ci/build": "#!/bin/sh\nmkdir -p build\n", "ci/bench": "#!/bin/sh\n", "ci/mutate": "#!/bin/sh\n",
               "ci/fuzz": "#!/bin/sh\n",
               "ci/performance": PERFORMANCE, "compare/verify": VERIFY, "compare/report/trust_table.py": "#!/bin/sh\n"}
    for name, text in scripts.items():
        (root / name).write_text(text)
        (root / name).chmod(0o755)
    (root / "Makefile").write_text(MAKEFILE)
    (root / "value").write_text("2.16")
    (root / ".gitignore").write_text("out/\n__pycache__/\n")
    git(root, "init", "-q")
    commit(root)
    return root


def commit(root):
    git(root, "add", "-A")
    git(root, "commit", "-q", "-m", "state")


def nightly(root, *arguments):
    return subprocess.run([root / "ci/nightly", "--frequency", "nightly", *arguments], capture_output=True, text=True,
                          check=False, env={**os.environ, "MPLCONFIGDIR": str(root / "out/matplotlib")},
                          # a job started in the background ignores interrupts, and its children with it
                          preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))


@pytest.mark.parametrize("mine", ["notes.txt", ".git/config"])
def test_a_clone_that_is_a_users_is_not_removed(repository, mine):
    file = repository / "out/nightly/clone" / mine
    file.parent.mkdir(parents=True)
    file.write_text("mine\n")
    done = nightly(repository)
    assert done.returncode == 2 and "no nightly run has made it" in done.stderr and done.stderr.count("\n") == 1, done.stderr
    assert file.read_text() == "mine\n" and not (repository / "out/nightly/runs").exists()


def test_twice_on_one_commit_is_no_change_then_a_change_then_blessed(repository):
    first = nightly(repository)
    assert first.returncode == 0, first.stdout + first.stderr
    assert "1 without a past" in first.stdout
    second = nightly(repository)
    assert second.returncode == 0
    assert ": no change\n" in second.stdout and "0 without a past; 2 costs" in second.stdout

    (repository / "value").write_text("2.4")
    commit(repository)
    third = nightly(repository)
    assert third.returncode == 1
    assert "s1-run-out: 2.16 -> 2.4" in third.stdout

    silent = subprocess.run([repository / "ci/bless", "s1-run-out", "--reason", "fine"], capture_output=True, text=True, check=False)
    assert silent.returncode == 2 and "reason" in silent.stderr
    reason = "bounded second-order flux, nearer to the finest grid"
    subprocess.run([repository / "ci/bless", "s1-run-out", "--reason", reason], check=True, capture_output=True)
    assert reason in (repository / "ci/blessings.csv").read_text()
    commit(repository)
    fourth = nightly(repository)
    assert fourth.returncode == 0, fourth.stdout

    runs = sorted((repository / "out/nightly/runs").iterdir())
    assert len(runs) == 4
    assert {"1-clone.log", "2-build.log", "3-tests.log", "4-sanitize.log", "5-tidy.log", "6-fuzz.log", "7-mutate.log", "8-verify.log",
            "10-performance.log", "summary.txt", "trends.html",
            "state.json", "times.json", "verify"} <= {p.name for p in runs[0].iterdir()}
    assert "REFERENCE=on" in (runs[0] / "5-tidy.log").read_text()
    assert not (repository / "out/nightly/clone").exists()
    page = (runs[-1] / "trends.html").read_text()
    assert "<svg " in page and 'href="../' in page and "http" not in page


def test_broken_build_blocks_the_rest_but_is_reported(repository):
    (repository / "ci/build").write_text("#!/bin/sh\necho no compiler\nexit 1\n")
    commit(repository)
    done = nightly(repository)
    assert done.returncode == 1
    assert "build: failed, tests: blocked, sanitize: blocked, tidy: blocked, fuzz: blocked, mutate: blocked, verify: blocked" in done.stdout


def test_interrupted_run_goes_on(repository):
    flag = repository.parent / "ready"
    (repository / "ci/performance").write_text(
        f"#!/bin/sh\ntest -e {flag} || kill -INT $(cat {repository}/out/nightly/lock)\nsleep 2\necho '{{}}' > \"$4\"\n")
    commit(repository)
    broken = nightly(repository)
    assert broken.returncode != 0
    flag.touch()
    again = nightly(repository)
    assert "going on with" in again.stdout
    assert "2/11 build        passed (before)" in again.stdout
    assert again.returncode == 0, again.stdout + again.stderr
    assert len(list((repository / "out/nightly/runs").iterdir())) == 1


def test_interrupted_run_begins_anew_where_its_clone_is_of_another_commit(repository):
    flag = repository.parent / "ready"
    (repository / "ci/performance").write_text(
        f"#!/bin/sh\ntest -e {flag} || kill -INT $(cat {repository}/out/nightly/lock)\nsleep 2\necho '{{}}' > \"$4\"\n")
    commit(repository)
    assert nightly(repository).returncode != 0
    flag.touch()
    git(repository / "out/nightly/clone", "commit", "-q", "--allow-empty", "-m", "another")
    again = nightly(repository)
    assert "going on with" in again.stdout and "(before)" not in again.stdout
    assert again.returncode == 0, again.stdout + again.stderr


def test_a_trial_runs_the_unit_tests_and_leaves_benchmarks_and_sanitizers_out(repository):
    (repository / "ci/bench").write_text("#!/bin/sh\nexit 1\n")
    commit(repository)
    trial = nightly(repository, "--frequency", "short")
    assert trial.returncode == 0
    assert "sanitize" not in trial.stdout and "tidy" not in trial.stdout
    log = next((repository / "out/nightly/runs").iterdir()) / "3-tests.log"
    assert "labels unit" in log.read_text()
    assert nightly(repository).returncode == 1


def test_stages_can_be_left_out_and_are_named(repository):
    (repository / "ci/build").write_text("#!/bin/sh\necho built with $*\n")
    commit(repository)
    done = nightly(repository, "--without", "tests", "reference")
    assert done.returncode == 0, done.stdout
    assert "7/9 verify" in done.stdout and "stages left out\n  reference\n  tests\n" in done.stdout
    run = next((repository / "out/nightly/runs").iterdir())
    assert "built with --programs --reference=off release" in (run / "2-build.log").read_text()
    assert "REFERENCE=off" in (run / "4-tidy.log").read_text()


def test_findings_of_sanitizers_and_lint_are_named_and_the_rest_runs(repository):
    (repository / "Makefile").write_text(MAKEFILE + "\t@exit 1\n")
    commit(repository)
    done = nightly(repository)
    assert done.returncode == 1
    assert "stages not passed: sanitize: failed, tidy: failed" in done.stdout and "8/11 verify       passed" in done.stdout


def test_a_readme_that_states_other_results_is_red(repository):
    (repository / "compare/report/trust_table.py").write_text('#!/bin/sh\necho "$@: kept 2.1; now 2.16"\nexit 1\n')
    commit(repository)
    done = nightly(repository)
    assert done.returncode == 1
    assert "stages not passed: verify: failed" in done.stdout
    run = next((repository / "out/nightly/runs").iterdir())
    assert "--check --verify out/verify: kept 2.1; now 2.16" in (run / "8-verify.log").read_text()


def test_a_run_that_failed_is_named(repository):
    (repository / "compare/verify").write_text(VERIFY.replace(
        'runs = [', 'runs = [{"id": "sw-2d", "state": "failed", "reason": "step collapse"}, ') + "sys.exit(1)\n")
    commit(repository)
    done = nightly(repository)
    assert done.returncode == 1
    assert "stages not passed: verify: failed; 1 runs without a result" in done.stdout and "  sw-2d: failed, step collapse" in done.stdout


def test_only_one_at_a_time(repository):
    out = repository / "out/nightly"
    out.mkdir(parents=True)
    with (out / "lock").open("w") as lock:
        lock.write("4711\n")
        lock.flush()
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = nightly(repository)
    assert done.returncode == 3
    assert "process 4711" in done.stderr
    assert not (out / "runs").exists()


def test_unknown_commit(repository):
    done = nightly(repository, "--commit", "nowhere")
    assert done.returncode == 2 and "no such commit: nowhere" in done.stderr


def test_uncommitted_changes_are_left_out(repository):
    (repository / "value").write_text("99")
    assert nightly(repository).returncode == 0
    (run,) = (repository / "out/nightly/runs").iterdir()
    assert json.loads((run / "verify/results.json").read_text())["results"][0]["value"] == 2.16
