"""The uncertainty of the recorded series."""
import runpy
from pathlib import Path

import pytest

bands = runpy.run_path(str(Path(__file__).resolve().parent.parent / "bands"))["bands"]


def write_record(folder, offset, end):
    folder.mkdir(parents=True)
    rows = "".join(f"{t},{2 * t + offset},\n" for t in range(end + 1))
    (folder / "series.csv").write_text("time [s],front_dense [m],y_solid_mean [m]\n" + rows)


def test_seeds_and_variants_are_compared_over_the_common_time(tmp_path):
    write_record(tmp_path / "s1/seed1", 0.0, 10)
    write_record(tmp_path / "s1/seed2", 0.5, 8)
    write_record(tmp_path / "variants/coarse/s1/seed1", -0.25, 10)
    write_record(tmp_path / "controls/s1/seed1", 9.0, 10)
    found = {row["against"]: row for row in bands(tmp_path)}
    assert set(found) == {"seed2", "coarse"}
    assert found["seed2"]["rms"] == pytest.approx(0.5) and found["seed2"]["at_end"] == pytest.approx(0.5)
    assert found["coarse"]["largest"] == pytest.approx(0.25) and found["coarse"]["at_end"] == pytest.approx(-0.25)
