"""ci/targets on a program that writes what it is told: what it measures, and how it judges."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent

# Writes a record of 1000 cells (16000 with dx = 1) and 10 steps; 2 us of core time a cell-step in the step's parts.
PROGRAM = """#!/usr/bin/python3
import json, os, sys
if "CODE" in os.environ:
    sys.exit(int(os.environ["CODE"]))
out, fine = sys.argv[sys.argv.index("--out") + 1], "grid.dx=1" in sys.argv
cells = 16000 if fine else 1000
held = bytearray(os.urandom(1)) * (64_000_000 if fine else 34_000_000)
seconds = 2e-6 * cells * 10 / (2 if sys.argv[sys.argv.index("--threads") + 1] == "2" else 1)
os.makedirs(out)
json.dump({"exit": {"state": "finished", "kind": "finished"}, "cells": cells, "steps": 10, "core_seconds": 4 * seconds, "wall_seconds": 4 * seconds,
           "cost": {"pressure": 0.75 * seconds, "friction": 0.25 * seconds}}, open(out + "/run.json", "w"))
open(out + "/series.csv", "w").write("time [s],friction_iterations [-]\\n0,7\\n1,30\\n2,60\\n")
"""


@pytest.fixture
def judged(tmp_path):
    program = tmp_path / "build/solver/granvof"
    program.parent.mkdir(parents=True)
    program.write_text(PROGRAM)
    program.chmod(0o755)
    (tmp_path / "build/compare").mkdir()
    (tmp_path / "build/compare/granvof-compare").symlink_to(ROOT / "build/release/compare/granvof-compare")

    def call(row, *arguments, **environment):
        targets = tmp_path / "targets.toml"
        lines = [f"{key} = {json.dumps(value)}" for key, value in {"name": "it", "case": "s1", "today": 9, **row}.items()]
        targets.write_text("[[row]]\n" + "\n".join(lines) + "\n")
        return subprocess.run([ROOT / "ci/targets", "--build-dir", tmp_path / "build", "--targets", targets, "--repeats",
                               "3", *arguments], capture_output=True, text=True, check=False,
                              env={**os.environ, **environment})

    return call


@pytest.mark.parametrize("row, value, verdict", [
    ({"kind": "cost", "target": 2.5}, "2", "met"),
    ({"kind": "cost", "target": 0.5}, "2", "missed by 4 times"),
    ({"kind": "friction", "from": 1.0, "target": 40}, "45", "missed by 1.1 times"),
    ({"kind": "friction", "from": 0.0, "target": 40}, "32.3", "met"),
    ({"kind": "threads", "target": 1.8}, "2", "met"),
    ({"kind": "threads", "target": 3.0}, "2", "missed by 1.5 times"),
])
def test_value_and_verdict(judged, row, value, verdict):
    done = judged(row)
    assert done.returncode == 0, done.stderr
    line = done.stdout.splitlines()[-1].split(maxsplit=4)
    assert line[2] == value and line[4] == verdict, done.stdout


def test_memory_is_the_growth_a_cell(judged):
    done = judged({"kind": "memory", "target": 1.0, "spacings": [2, 1]})
    assert float(done.stdout.splitlines()[-1].split()[2]) == pytest.approx(30_000_000 / 1024 / 15000, rel=0.1)
    assert "missed by" in done.stdout


def test_long_rows_only_when_asked(judged):
    row = {"kind": "cost", "target": 2.5, "long": True}
    assert "not measured" in judged(row).stdout
    assert judged(row, "--long").stdout.rstrip().endswith("met")


def test_a_failed_run_is_no_result(judged):
    done = judged({"kind": "cost", "target": 2.5}, CODE="3")
    assert done.returncode == 1 and "exit code 3" in done.stderr, done.stderr


def test_every_row_of_the_project_is_complete():
    import tomllib
    rows = tomllib.loads((ROOT / "ci/targets.toml").read_text(encoding="utf-8"))["row"]
    for row in rows:
        assert row["kind"] in ("cost", "friction", "memory", "threads") and row["target"] > 0 and row["today"] > 0
        assert (ROOT / f"cases/{row['case']}.toml").exists(), row["name"]
