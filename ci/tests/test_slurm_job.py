"""The job script of a long run (ci/slurm/run.sbatch), with stand-ins for Slurm, Open MPI and granvof."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
# Each writes how it was called; launchers then start the program behind their options.
STANDINS = {
    "srun": 'while [[ $1 == --* ]]; do shift; done; exec "$@"',
    "mpirun": 'while [[ $1 != */granvof ]]; do shift; done; exec "$@"',
    "scontrol": "",
    "sleep": "",
    "granvof": 'for ((i = 1; i < $#; ++i)); do [[ ${!i} == --out ]] && { j=$((i + 1)); mkdir -p "${!j}"; touch "${!j}/run.json"; }; done; exit "$CODE"',
}


@pytest.fixture
def job(tmp_path):
    """job(code, tasks): the script where granvof ends with that code; its own code, and what was called."""
    for name, rest in STANDINS.items():
        script = tmp_path / "bin" / name
        script.parent.mkdir(exist_ok=True)
        script.write_text(f'#!/usr/bin/env bash\necho "{name} $*" >> "$CALLS"\n{rest}\n')
        script.chmod(0o755)

    def run(code, tasks=1):
        calls = tmp_path / "calls"
        calls.unlink(missing_ok=True)
        own = {"PATH": f"{tmp_path}/bin:{os.environ['PATH']}", "CALLS": str(calls), "CODE": str(code), "CASE": "case.toml",
               "OUT": str(tmp_path / "out"), "GRANVOF": str(tmp_path / "bin/granvof"), "SLURM_NTASKS": str(tasks),
               "SLURM_CPUS_PER_TASK": "4", "SLURM_JOB_ID": "17"}  # fmt: skip
        done = subprocess.run(["bash", ROOT / "ci/slurm/run.sbatch"], env=own, capture_output=True, text=True)
        return done.returncode, calls.read_text().splitlines()

    return run


def started(calls):
    return next(line for line in calls if line.startswith("granvof "))


def test_a_run_that_stops_at_its_limit_is_queued_again_and_goes_on(job):
    code, calls = job(3)
    assert code == 3 and "scontrol requeue 17" in calls
    assert "--stop-after 3h50m" in started(calls) and "--threads 4" in started(calls) and "--resume" not in started(calls)
    code, calls = job(0)
    assert code == 0 and "--resume" in started(calls)
    assert not any(line.startswith("scontrol") for line in calls)


@pytest.mark.parametrize("code", [1, 2])
def test_a_run_that_fails_is_not_queued_again(job, code):
    got, calls = job(code)
    assert got == code and not any(line.startswith("scontrol") for line in calls)


def test_several_tasks_share_the_tank(job):
    code, calls = job(3, tasks=8)
    assert code == 3 and "scontrol requeue 17" in calls
    assert any(line.startswith("mpirun -np 8 --bind-to none ") for line in calls)
    assert not any(line.startswith("srun") for line in calls)
