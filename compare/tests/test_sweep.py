"""compare/sweep with a stand-in for the program: every combination once, side by side."""

import csv
import os
import subprocess
from pathlib import Path

import pytest
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent.parent

# Its front is 10 times the friction, and a friction of 9 fails.
STAND_IN = """#!/usr/bin/python3
import json, os, sys
if sys.argv[1] == "--version":
    print("granvof 1.0 (abc)"); sys.exit()
sets = dict(text.split("=", 1) for before, text in zip(sys.argv, sys.argv[1:]) if before == "--set")
out = sys.argv[sys.argv.index("--out") + 1]
open(os.path.join(os.path.dirname(sys.argv[0]), "calls"), "a").write("run\\n")
friction = float(sets.get("solid.friction", 0.4))
if friction > 9:
    print("solid.friction: got more than 9, allowed: less", file=sys.stderr); sys.exit(2)
if friction == 9:
    sys.exit(1)
os.makedirs(out, exist_ok=True)
open(out + "/series.csv", "w").write(f"time [s],front_dense [m]\\n0,0\\n1,{10 * friction}\\n")
json.dump({"exit": {"state": "finished", "kind": "finished"}, "core_seconds": 2.5}, open(out + "/run.json", "w"))
"""


@pytest.fixture
def sweep(tmp_path, compare):
    solver = tmp_path / "stand-in"
    solver.write_text(STAND_IN)
    solver.chmod(0o755)
    case = tmp_path / "mine.toml"
    case.write_text((ROOT / "cases/s1.toml").read_text().replace('name = "s1"', 'name = "mine"'))

    def call(*arguments):
        return subprocess.run([ROOT / "compare/sweep", case, "--solver", solver, "--compare", compare, "--out", tmp_path / "out", *arguments],
                              capture_output=True, text=True, env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"})

    call.out, call.calls = tmp_path / "out/mine", lambda: len((tmp_path / "calls").read_text().splitlines())
    return call


def test_every_combination_is_run_once_and_stands_in_the_table(sweep):
    ended = sweep("--set", "solid.friction=0.1,0.2", "--set", "grid.dx=0.005,0.01")
    assert ended.returncode == 0, ended.stderr
    with open(sweep.out / "sweep.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["solid.friction", "grid.dx", "front_dense [m]", "cost [core-s]"]
    assert rows[1:] == [["0.1", "0.005", "1", "2.5"], ["0.1", "0.01", "1", "2.5"], ["0.2", "0.005", "2", "2.5"], ["0.2", "0.01", "2", "2.5"]]
    with Image.open(sweep.out / "sweep.png") as picture:
        assert picture.width > 300
    assert sweep("--set", "solid.friction=0.1,0.2", "--set", "grid.dx=0.005,0.01").returncode == 0
    assert sweep.calls() == 4  # what is there is not run again


def test_what_another_version_made_is_made_again(sweep, tmp_path):
    assert sweep("--set", "solid.friction=0.1").returncode == 0
    solver = tmp_path / "stand-in"
    solver.write_text(solver.read_text().replace("granvof 1.0 (abc)", "granvof 1.0 (abd)"))
    assert sweep("--set", "solid.friction=0.1").returncode == 0
    assert sweep.calls() == 2


def test_no_cost_is_told_of_runs_beside_each_other(sweep):
    assert sweep("--set", "solid.friction=0.1,0.2", "--jobs", "2").returncode == 0
    with open(sweep.out / "sweep.csv", newline="") as file:
        assert list(csv.reader(file)) == [["solid.friction", "front_dense [m]"], ["0.1", "1"], ["0.2", "2"]]
    with open(sweep.out / "accounts.csv", newline="") as file:
        accounts = list(csv.DictReader(file))
    assert {line["run"] for line in accounts} == {"solid.friction=0.1", "solid.friction=0.2"}
    assert all(float(line["core_seconds [s]"]) == 2.5 for line in accounts)


def test_a_failed_run_is_a_line_and_an_exit_code(sweep):
    ended = sweep("--set", "solid.friction=0.1,9")
    assert ended.returncode == 1
    assert "failed" in ended.stdout.splitlines()[2]


def test_a_list_is_one_value(sweep):
    assert sweep("--set", "output.field_times=[0, 1],[0, 2]").returncode == 0
    assert sweep.calls() == 2


@pytest.mark.parametrize("arguments, word", [(["--set", "solid.friction"], "--set"), (["--set", "a=1,,2"], "--set"), (["--set", "a=1,1"], "twice"),
                                             (["--set", "a=1", "--set", "a=2"], "twice"), (["--metric", "nothing"], "front_dense"),
                                             (["--set", "solid.friction=10"], "allowed: less")])
def test_bad_input_is_one_line(sweep, arguments, word):
    ended = sweep(*arguments)
    said = [line for line in ended.stderr.splitlines() if not line.endswith("...")]
    assert ended.returncode == 2 and len(said) == 1 and word in said[0], ended.stderr


def test_a_table_of_the_users_stays(sweep):
    sweep.out.mkdir(parents=True)
    (sweep.out / "sweep.csv").write_text("mine\n")
    ended = sweep("--set", "solid.friction=0.1")
    assert ended.returncode == 2 and "something else" in ended.stderr, ended.stderr
    assert (sweep.out / "sweep.csv").read_text() == "mine\n" and len(list(sweep.out.iterdir())) == 1
