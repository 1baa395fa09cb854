"""`import granvof`: a run directory as tables and fields with coordinates, with and without pandas and xarray."""

import hashlib
import importlib.util
import json
import re
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parent.parent.parent


@pytest.fixture(params=["xarray", "arrays"])
def granvof(request, monkeypatch):
    if request.param == "arrays":
        monkeypatch.setitem(sys.modules, "pandas", None)  # as where it is not installed
    specification = importlib.util.spec_from_file_location("granvof", ROOT / "solver/python/granvof.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    assert (module.xarray is None) == (request.param == "arrays"), "ci/setup installs python3-xarray"
    return module


@pytest.fixture
def directory(tmp_path):
    (tmp_path / "series.csv").write_text("time [s],front_dense [m],y_c [m]\n0,0.1,0.02\n0.5,0.2,\n")
    (tmp_path / "run.json").write_text(json.dumps({"scene": "s1", "core_seconds": 2.5}))
    with h5py.File(tmp_path / "fields.h5", "w") as file:
        file.attrs["cells"], file.attrs["spacing"], file.attrs["origin"] = [4, 3, 2], [0.1, 0.2, 0.5], [0.0, 0.0, 0.0]
        file.attrs["scene"] = np.bytes_("s1")
        for place, time in enumerate((0.0, 0.5)):
            group = file.create_group(f"t000{place}")
            group.attrs["time"] = time
            for name in ("f_s", "alpha", "p_c", "theta", "phi"):
                group[name] = np.arange(24.0).reshape(2, 3, 4) + 100 * place
            group["u_s"] = group["u_c"] = np.arange(72.0).reshape(2, 3, 4, 3)
    return tmp_path


def test_series_by_name_with_units(granvof, directory):
    run = granvof.load(directory)
    assert list(np.asarray(run.series["front_dense"])) == [0.1, 0.2]
    assert np.isnan(np.asarray(run.series["y_c"])[1])  # undefined is neither 0 nor left out
    assert run.units["front_dense"] == "m" and run.facts["core_seconds"] == 2.5
    if granvof.pandas:
        assert list(run.series.index) == [0.0, 0.5] and run.series.attrs["units"]["y_c"] == "m"


def test_fields_at_the_centres_of_cells(granvof, directory):
    run = granvof.load(directory)
    assert np.allclose(run.fields["x"], [0.05, 0.15, 0.25, 0.35]) and np.allclose(run.fields["y"], [0.1, 0.3, 0.5])
    assert np.asarray(run.fields["f_s"]).shape == (2, 2, 3, 4) and np.asarray(run.fields["u_s"]).shape == (2, 2, 3, 4, 3)
    if granvof.xarray:
        at = run.fields["f_s"].sel(time=0.5, x=0.15, y=0.5, z=0.25, method="nearest")
        assert float(at) == 109.0 and at.attrs == {"units": "-", "long_name": "solid fraction"}
        assert float(run.fields["u_s"].sel(time=0, component="y").isel(x=0, y=0, z=0)) == 1.0
    assert granvof.load(directory, fields=False).fields is None


def test_what_is_no_run_is_said(granvof, directory):
    for name, text in (("fields.h5", "no"), ("run.json", "{"), ("series.csv", "time\n0\n")):
        (directory / name).write_text(text)
        with pytest.raises(granvof.NotARun, match=name):
            granvof.load(directory)
    with pytest.raises(granvof.NotARun, match="series.csv"):
        granvof.load(directory / "nowhere")


def test_fields_are_described_as_in_the_docs(granvof):
    page = (ROOT / "docs/output.md").read_text()
    for name, (unit, _) in granvof.FIELDS.items():
        row = next((line for line in page.splitlines() if line.startswith("|") and re.search(rf"`{name}`", line)
                    and line.rstrip().endswith(f"| {unit} |")), None)
        assert row, f"{name} [{unit}]"


def test_a_file_that_was_exchanged_after_the_end_is_refused(granvof, directory):
    """Of a run that goes on it may be newer than its record."""
    digests = {name: hashlib.sha256((directory / name).read_bytes()).hexdigest() for name in ("series.csv", "fields.h5")}
    facts = {"exit": {"state": "finished"}, "files": {name: {"sha256": digest} for name, digest in digests.items()}}
    (directory / "run.json").write_text(json.dumps(facts))
    granvof.load(directory)
    with h5py.File(directory / "fields.h5", "r+") as file:
        file["t0001/f_s"][...] = 0.5
    with pytest.raises(granvof.NotARun, match="fields.h5: it is not the file that was written"):
        granvof.load(directory)
    granvof.load(directory, fields=False)
    (directory / "series.csv").write_text("time [s],front_dense [m],y_c [m]\n0,0.1,0.02\n0.5,0.3,\n")
    with pytest.raises(granvof.NotARun, match="series.csv: it is not the file that was written"):
        granvof.load(directory, fields=False)
    facts["exit"]["state"] = "running"
    (directory / "run.json").write_text(json.dumps(facts))
    granvof.load(directory)
