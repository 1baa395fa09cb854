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
