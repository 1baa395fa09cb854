"""Makes the parts of the nightly run importable; programs made up for a test."""

import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "ci"), str(ROOT / "solver/python")]


@pytest.fixture
def shell():
    """Writes a program of the shell's."""
    def write(path, text):
        path.write_text("#!/bin/sh\n" + text)
        path.chmod(0o755)
        return path
    return write


@pytest.fixture
def until():
    """Waits for what takes a moment, on a busy machine longer; whether it came true."""
    def wait(true, longest):
        end = time.monotonic() + longest
        while not true() and time.monotonic() < end:
            time.sleep(0.02)
        return true()
    return wait


@pytest.fixture
def lives():
    """Whether a process does. An orphan is reaped by whoever adopts it, soon after its end."""
    def runs(pid):
        try:
            return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
        except OSError:
            return False
    return runs
