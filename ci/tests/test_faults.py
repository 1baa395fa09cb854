"""The runner of faults: it notices what is not held; and a sample of the table against the built programs."""

import subprocess
import sys
from pathlib import Path

import pytest

from faults_tried import damage, parts, runs, scarce
from faults_tried.bench import Bench, read_table
from faults_tried.kinds import KINDS

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "compare"))

from report import sections  # noqa: E402

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
    lines = [line.rsplit(",", 2)[0] for line in done.stdout.splitlines()]
    assert (done.returncode, lines) == (0, ["bad_values       tried     2, held     2", "all              tried     2, held     2"])


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


def test_a_contradiction_that_is_taken_without_a_word_is_named(tmp_path):
    text = '[[contradictions]]\ncase = "cases/s1.toml"\ngiven = [["a.b=1", "c.d=2"]]\n'
    assert tried(tmp_path, "echo 's1: warning: c.d = 2: usual is 1' >&2; exit 0", text).returncode == 0
    assert tried(tmp_path, "echo 'c.d: refused' >&2; exit 2", text).returncode == 0
    for silent in ("exit 0", "echo 's1: warning: e.f = 2' >&2; exit 0"):
        done = tried(tmp_path, silent, text)
        assert done.returncode == 1 and "a.b=1, c.d=2: exit code 0" in done.stdout


def test_parts_try_all_between_them_and_each_once(tmp_path):
    """Five tries for three parts, one of which is not held; and a kind that is not divided."""
    text = BAD_VALUES.replace('"nan", "0"', '"1", "2", "3", "4", "5"') + '[[outputs]]\ncommands = [["{granvof}"]]\nstdouts = ["/dev/full"]\n'
    build = stand_in(tmp_path / "build", f'echo "$*" >> {tmp_path}/calls; [ $# = 0 ] && {{ echo said || exit 2; exit 0; }}\n'
                     'case "$*" in *=4*) exit 0;; esac; echo no >&2; exit 2')
    done = subprocess.run([FAULTS, "--jobs", "3", "--build-dir", build, "--table", table_of(tmp_path, text)], capture_output=True, text=True)
    assert done.returncode == 1 and "tried     6, held     5" in done.stdout and "grid.dx='4': exit code 0" in done.stdout, done.stdout
    assert len((tmp_path / "calls").read_text().splitlines()) == 7  # an output is tried with one that takes it first


def test_a_part_that_ends_is_no_success(tmp_path):
    """Killed by what it tries: its tries are missing, and that is said."""
    build = stand_in(tmp_path / "build", 'case "$*" in *=4*) kill -9 $PPID;; esac; echo no >&2; exit 2')
    text = BAD_VALUES.replace('"nan", "0"', '"1", "2", "3", "4"')
    done = subprocess.run([FAULTS, "--jobs", "2", "--build-dir", build, "--table", table_of(tmp_path, text)], capture_output=True, text=True)
    assert done.returncode == 2 and "a part of the tries ended" in done.stderr, done.stdout + done.stderr


def test_a_verdict_on_a_damaged_run_is_not_held(tmp_path):
    """A comparison that says "nothing unexpected" whatever it is given."""
    granvof = "for o; do d=$o; done; mkdir -p $d; seq 99 > $d/series.csv; exit 0"
    done = tried(tmp_path, granvof, '[[damaged_runs]]\ncase = "cases/s1.toml"\nfiles = ["series.csv"]\ndamages = ["half", "line_out"]\n',
                 "exit 0")
    assert done.returncode == 1 and "held     0" in done.stdout and "series.csv, half: exit code 0" in done.stdout


def test_parts_beside_each_other_do_all_of_it(tmp_path, monkeypatch):
    """Also of a kind that one part does alone."""
    build = stand_in(tmp_path / "build", "exit 2")
    for kind in ("orphans", "kills"):
        monkeypatch.setitem(KINDS, kind, lambda bench, entry: ((str(number), "") for number in bench.some(range(7))))
    benches = [Bench(build, ROOT, tmp_path, False, part, 2) for part in range(2)]
    made = parts.all_of(["orphans", "kills"], {"orphans": [{}], "kills": [{}]}, benches)
    assert [sorted(name for name, _ in results) for results, *_ in made] == [[str(number) for number in range(7)]] * 2


# Without a lock, blind to errors, to damage and to what else is in its directory; a resumed run repeats rows.
CARELESS = """#!/usr/bin/python3
import os, sys, time
from pathlib import Path
if sys.argv[1] == "check":
    print("[a]\\nb = " + ("2" if "a.b=2" in sys.argv else "1"))
    sys.exit()
out = Path(sys.argv[sys.argv.index("--out") + 1])
try:
    os.makedirs(out / "fields", exist_ok=True)
except OSError:
    pass
def put(name, content, flag):
    try:
        os.write(os.open(out / name, os.O_WRONLY | os.O_CREAT | flag), content)
    except OSError:
        pass
put("series.csv", b"time\\n", os.O_APPEND)
os.write(1, b"begun")
for name in ("run.json", "checkpoint.h5", "fields/t0000.h5", "fields.h5", "fields.xdmf"):
    put(name, b"{}", os.O_TRUNC)
for row in range(3):
    put("series.csv", b"%d\\n" % row, os.O_APPEND)
    time.sleep(0.01)
"""


@pytest.mark.parametrize("kind, entry, why", [
    ("kills_at_calls", "", "other bytes in series.csv"),
    ("failing_calls", 'errors = ["EIO"]', "other bytes in"),
    ("full_disks", "shares = [0.5]", "exit code 0, and its files are others"),
    ("limits", 'of = "descriptors"\nvalues = [6]', "exit code 0, and its files are others"),
    ("closed_streams", "", "closed: 1: "),
    ("two_in_one", 'second = [["--force"]]', "a second run --force: "),
    ("foreign", 'places = ["of_a_user", "a_file"]', "a directory of_a_user: exit code 0"),
    ("damaged_resumes", 'files = ["checkpoint.h5"]\ndamages = ["zeros"]', "checkpoint.h5, zeros: other bytes"),
    ("changed_keys", "words = {}\nmay_change = []", "a.b=2: it goes on with another case"),
    ("changed_keys", 'words = {}\nmay_change = ["a.b"]', "a.b=2: run.json does not name it"),
])
def test_a_careless_program_is_found_out(tmp_path, kind, entry, why):
    build = stand_in(tmp_path / "build", "exit 2")
    (build / "solver/granvof").write_text(CARELESS)
    table = table_of(tmp_path, f'[[{kind}]]\ncase = "cases/s1.toml"\nsample = 3\n{entry}\n')
    done = subprocess.run([FAULTS, "--sample", "--build-dir", build, "--table", table], capture_output=True, text=True)
    assert done.returncode == 1 and why in done.stdout, done.stdout + done.stderr


def test_a_run_that_does_not_go_on_after_a_kill_is_found_out(tmp_path):
    granvof = ('for o; do case $o in --*) ;; *) d=$o;; esac; done; mkdir -p $d; cd $d; echo row >> series.csv; sleep 1; '
               "echo {} > run.json; touch fields.h5 fields.xdmf; exit 0")
    done = tried(tmp_path, granvof, '[[kills]]\ncase = "cases/s1.toml"\ntimes = 2\nsample = 2\n')
    assert done.returncode == 1 and "other bytes in series.csv" in done.stdout, done.stdout + done.stderr


def test_a_process_that_is_stopped_has_stopped():
    """A signal takes its time, and what is looked at meanwhile may change."""
    for _ in range(20):
        process = subprocess.Popen(["/bin/sh", "-c", "while :; do :; done"])
        assert runs.stop(process)
        state = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()[0]
        process.kill()
        process.wait()
        assert state == "T"
    ended = subprocess.Popen(["/bin/true"])
    assert not runs.stopped_once(ended, lambda: False)


def test_memory_that_grows_is_found_out():
    level = [(0.1 * n, 30000 if n > 5 else 20000) for n in range(100)]
    assert scarce.grown(level) == ""
    assert scarce.grown([(at, kilobytes + 20 * number) for number, (at, kilobytes) in enumerate(level)])
    assert scarce.grown(level[:-1] + [(level[-1][0], 31000)]) == ""  # the end is no step
    assert scarce.grown(level[:3]) == "too short to be judged"


def test_the_report_shows_what_was_tried(tmp_path):
    build = stand_in(tmp_path / "build", "echo no >&2; exit 0")
    done = subprocess.run([FAULTS, "--build-dir", build, "--table", table_of(tmp_path, BAD_VALUES), "--out", tmp_path / "out"],
                          capture_output=True, text=True)
    assert done.returncode == 1
    (shown,) = sections.read_all(tmp_path / "out")
    assert shown.name == "faults" and "0 of 2 tries held" in shown.text[0]
    assert shown.tables[0]["rows"][-1] == ["all", "", 2, 0, 0, 0, ""]
    assert shown.tables[1]["rows"][0] == ["bad_values", "cases/s1.toml: grid.dx='nan'", "exit code 0"]


def test_what_was_held_before_is_kept_while_nothing_has_changed(tmp_path):
    """A kind that was not held is tried again, and all of them on another program or by other entries; the sum is of all."""
    build = stand_in(tmp_path / "build", 'case "$*" in *dx=5*) exit 0;; esac; echo said >&2; exit 2')
    other = '[[contradictions]]\ncase = "cases/s1.toml"\ngiven = [["a.b=1"]]\n'

    def call(text, *words):
        done = subprocess.run([FAULTS, "--build-dir", build, "--table", table_of(tmp_path, text), "--out", tmp_path / "out", *words],
                              capture_output=True, text=True)
        lines = [line for line in done.stdout.splitlines() if " tried " in line]
        return done.returncode, {line.split()[0]: "kept" in line for line in lines}, " ".join(lines[-1].split()[:5])

    assert call(BAD_VALUES, "--only", "bad_values") == (0, {"bad_values": False, "all": False}, "all tried 2, held 2,")
    assert call(BAD_VALUES + other, "--go-on") == (0, {"bad_values": True, "contradictions": False, "all": False}, "all tried 3, held 3,")
    (shown,) = sections.read_all(tmp_path / "out")
    assert [row[2] for row in shown.tables[0]["rows"]] == [2, 1, 3]
    assert call(BAD_VALUES.replace('"0"', '"5"') + other, "--go-on") == (1, {"contradictions": True, "bad_values": False, "all": False}, "all tried 3, held 2,")
    assert call(BAD_VALUES.replace('"0"', '"5"') + other, "--go-on")[:2] == (1, {"contradictions": True, "bad_values": False, "all": False})
    assert not call(other)[1]["contradictions"]  # not asked to go on
    with open(build / "solver/granvof", "a") as program:
        program.write("# another\n")
    assert not call(other, "--go-on")[1]["contradictions"]


def test_a_kind_of_which_nothing_was_tried_is_no_success(tmp_path):
    done = tried(tmp_path, "echo no >&2; exit 2", BAD_VALUES + BAD_VALUES.replace("bad_values", "contradictions").replace("keys", "given = [] #"))
    assert done.returncode == 2 and "contradictions: nothing was tried" in done.stderr, done.stdout + done.stderr


def test_a_full_standard_output_must_not_be_a_success(tmp_path):
    text = '[[outputs]]\ncommands = [["{granvof}"]]\nstdouts = ["/dev/full"]\n'
    assert tried(tmp_path, "echo said 2>/dev/null; exit 0", text).returncode == 1
    assert tried(tmp_path, "echo said || exit 2; exit 0", text).returncode == 0
    assert tried(tmp_path, "exit 2", text).returncode == 2  # of a program that always fails it says nothing


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
        changed = not path.is_file() or path.is_symlink() or path.stat().st_size != len(before) or path.read_bytes() != before
        assert changed, name


def test_the_table_is_large_enough():
    table = read_table(ROOT / "ci/faults.toml", KINDS)
    assert sum(len(entry["keys"]) * len(entry["values"]) for entry in table["bad_values"]) >= 400
    assert sum(entry["times"] for entry in table["kills"]) >= 60
    assert sum(len(entry["shares"]) for entry in table["full_disks"]) >= 12
    assert set(table) == set(KINDS)


@pytest.mark.skipif(not (ROOT / "build/release/compare/granvof-compare").exists(), reason="the programs are not built")
def test_a_sample_is_held():
    done = subprocess.run([FAULTS, "--sample"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
