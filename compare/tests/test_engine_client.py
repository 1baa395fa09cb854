"""The run engine's client leaves nothing open."""

import gc
import stat
import warnings
from pathlib import Path

from engine.client import Engine


def test_an_engine_that_has_ended_leaves_no_pipe_open(tmp_path: Path):
    stand_in = tmp_path / "engine"
    stand_in.write_text("#!/bin/sh\ncat > /dev/null\n", encoding="utf-8")
    stand_in.chmod(stand_in.stat().st_mode | stat.S_IXUSR)
    with warnings.catch_warnings(record=True) as left:
        warnings.simplefilter("always", ResourceWarning)
        with Engine(stand_in, "solver"):
            pass
        gc.collect()
    assert [str(warning.message) for warning in left] == []
