"""What is said of a name steers no terminal, and is one short line."""

import subprocess
from pathlib import Path

import pytest

import complaint

ROOT = Path(__file__).resolve().parent.parent.parent


def test_what_steers_a_terminal_is_escaped(capsys):
    complaint.complain("a\x1b[31m\nb\u202ec\udcff é")
    assert capsys.readouterr().err == "a\\u001B[31m\\u000Ab\\u202Ec\\uDCFF é\n"


def test_a_long_one_is_cut():
    assert complaint.printable("x" * 5000) == "x" * 1500 + "... (5000 characters)"


@pytest.mark.parametrize("command", [
    ["compare/verify", "--out", ""], ["compare/sweep", "cases/s1.toml", "--out", ""], ["compare/show", ""], ["compare/stability", "--out", ""],
    ["compare/lay/lay", "--series", ""], ["reference/record", "--adopt", ""], ["reference/canary", "--out", ""], ["ci/nightly", "--out", ""],
    ["ci/faults", "--out", ""], ["/usr/bin/python3", "compare/report/report.py", "--verify", ""]])
def test_nothing_is_no_path(command):
    """It would be the folder that one is in."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 2 and "'' given; a path is needed" in done.stderr


CLOSED = """import sys
sys.path.insert(0, {modules!r})
from complaint import ended
def main():
    with open("held", "w") as held:
        {body}
    return 0
sys.exit(ended(main))
"""


def shell_of(tmp_path, body, words):
    """A script with such a body, started by a shell with these words before it and at its end."""
    script = tmp_path / "script.py"
    script.write_text(CLOSED.format(modules=str(ROOT / "solver/python"), body=body))
    before, after = words
    return subprocess.run(["/bin/sh", "-c", f"{before} /usr/bin/python3 {script} {after}"], cwd=tmp_path, capture_output=True, text=True)


@pytest.mark.parametrize("body", ["print('a result')", "print('a result', flush=True)", "import subprocess; subprocess.run(['/bin/echo', 'x'], check=True)"])
def test_a_result_that_nobody_can_get_is_no_success(tmp_path, body):
    """As on a full disk; and what is printed goes into no file that is opened meanwhile."""
    done = shell_of(tmp_path, body, ("", ">&-"))
    assert done.returncode == 1 and (tmp_path / "held").read_text() == "", done.stderr
    if "subprocess" not in body:
        assert done.stderr == "script.py: cannot write to standard output: Bad file descriptor\n"


def test_who_prints_nothing_needs_no_standard_output(tmp_path):
    assert shell_of(tmp_path, "pass", ("", "<&- >&- 2>&-")).returncode == 0
    assert shell_of(tmp_path, "print('a message', file=sys.stderr)", ("", "2>&-")).returncode == 0
    assert (tmp_path / "held").read_text() == ""


@pytest.mark.parametrize("files", [5, 8, 12])  # with fewer the interpreter reads none of its own modules
def test_too_few_descriptors_are_one_line(tmp_path, files):
    done = shell_of(tmp_path, "pass", (f"ulimit -n {files};", ""))
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "(ulimit -n)" in done.stderr
    assert shell_of(tmp_path, "pass", ("ulimit -n 64;", "")).returncode == 0
