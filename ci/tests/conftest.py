"""Makes the parts of the nightly run importable; programs made up for a test."""

import sys
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
