"""One user of a directory at a time, and nothing left behind by those who end."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "ci"))

from night.together import Held, hold  # noqa: E402

HOLDS = f"""import sys
sys.path.insert(0, {str(ROOT / "ci")!r})
from night.together import hold
hold(sys.argv[1], "it")
{{}}
"""


def test_a_directory_is_held_once_and_nothing_is_left(tmp_path):
    with hold(tmp_path, "the first"):
        with pytest.raises(Held, match="is in use by the first"):
            hold(tmp_path, "the second")
    assert list(tmp_path.iterdir()) == []
    hold(tmp_path, "the second").close()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("end", ["", "sys.exit(2)", "raise OSError('of another kind')"])
def test_whoever_ends_leaves_no_lock(tmp_path, end):
    subprocess.run([sys.executable, "-c", HOLDS.format(end), tmp_path], capture_output=True)
    assert list(tmp_path.iterdir()) == []


def test_the_lock_of_one_who_was_killed_is_taken_over(tmp_path):
    killed = subprocess.run([sys.executable, "-c", HOLDS.format("import os; os.kill(os.getpid(), 9)"), tmp_path])
    assert killed.returncode == -9 and (tmp_path / ".lock").exists()
    hold(tmp_path, "the next").close()
    assert list(tmp_path.iterdir()) == []
