"""The runner of faults: it notices what is not held; and a sample of the table against the built programs."""

import subprocess
from pathlib import Path

import pytest

from faults_tried import damage
from faults_tried.bench import read_table
from faults_tried.kinds import KINDS

ROOT = Path(__file__).resolve().parent.parent.parent
FAULTS = ROOT / "ci/faults"


def stand_in(build, granvof, compare="exit 2"):
    for name, body in (("solver/granvof", granvof), ("compare/granvof-compare", compare)):
        path = build / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/bin/sh\n" + body + "\n")
        path.chmod(0o755)
    return build


def table_of(tmp_path, text):
    path = tmp_path / "faults.toml"
    path.write_text(text)
    return path


BAD_VALUES = '[[bad_values]]\ncase = "cases/s1.toml"\nkeys = ["grid.dx"]\nvalues = ["nan", "0"]\n'


def tried(tmp_path, granvof, text=BAD_VALUES, compare="exit 2"):
    build = stand_in(tmp_path / "build", granvof, compare)
    return subprocess.run([FAULTS, "--build-dir", build, "--table", table_of(tmp_path, text)], capture_output=True, text=True)


def test_what_refuses_is_held(tmp_path):
    done = tried(tmp_path, "echo 'grid.dx: refused' >&2; exit 2")
    assert (done.returncode, done.stdout) == (0, "bad_values     tried     2, held     2\n")


@pytest.mark.parametrize("granvof, why", [
    ("echo no >&2; exit 0", "exit code 0"),
    ("exit 2", "no message on stderr"),
    ("kill -SEGV $$", "ended by SIGSEGV"),
    ("echo 'Traceback (most recent' >&2; exit 2", "a message of"),
    ("printf 'a\\033b' >&2; exit 2", "a control character"),
    ("for o; do d=$o; done; mkdir -p $d; echo no >&2; exit 2", "something was written"),
    ("sleep 60", "not done"),
])
def test_what_does_not_is_named(tmp_path, granvof, why):
    done = tried(tmp_path, granvof, BAD_VALUES.replace(', "0"', "") if "sleep" in granvof else BAD_VALUES)
    assert done.returncode == 1
    assert "held     0" in done.stdout and why in done.stdout and "grid.dx='nan'" in done.stdout


def test_a_verdict_on_a_damaged_run_is_not_held(tmp_path):
    """A comparison that says "nothing unexpected" whatever it is given."""
    granvof = "for o; do d=$o; done; mkdir -p $d; seq 99 > $d/series.csv; exit 0"
    done = tried(tmp_path, granvof, '[[damaged_runs]]\ncase = "cases/s1.toml"\nfiles = ["series.csv"]\ndamages = ["half", "line_out"]\n',
                 "exit 0")
    assert done.returncode == 1 and "held     0" in done.stdout and "series.csv, half: exit code 0" in done.stdout


def test_a_full_standard_output_must_not_be_a_success(tmp_path):
    text = '[[outputs]]\ncommand = ["{granvof}"]\nstdout = "/dev/full"\n'
    assert tried(tmp_path, "echo said 2>/dev/null; exit 0", text).returncode == 1
    assert tried(tmp_path, "exit 2", text).returncode == 0


@pytest.mark.parametrize("text", ["", "[[nothing]]\n", "bad_values = 3\n", "[[", '[[bad_files]]\ncommand = []\ndamages = ["x"]\nof = "a"\n'])
def test_a_bad_table_is_one_line(tmp_path, text):
    done = tried(tmp_path, "exit 2", text)
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "Traceback" not in done.stderr


def test_every_damage_changes_the_file(tmp_path):
    import random
    chance = random.Random(1)
    for name, way in damage.BY_NAME.items():
        path = tmp_path / name
        path.write_text("".join(f"{n},{n}\n" for n in range(20)))
        before = path.read_bytes()
        way(path, chance)
        changed = not path.is_file() or path.is_symlink() or path.read_bytes() != before
        assert changed, name


def test_the_table_is_large_enough():
    table = read_table(ROOT / "ci/faults.toml", KINDS)
    assert sum(len(entry["keys"]) * len(entry["values"]) for entry in table["bad_values"]) >= 400
    assert sum(entry["times"] for entry in table["kills"]) >= 60
    assert set(table) == set(KINDS)


@pytest.mark.skipif(not (ROOT / "build/release/compare/granvof-compare").exists(), reason="the programs are not built")
@pytest.mark.parametrize("kind", ["outputs", "locales", "damaged_runs"])
def test_a_sample_is_held(kind):
    done = subprocess.run([FAULTS, "--sample", "--only", kind], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
