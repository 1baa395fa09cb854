"""Reads a run directory with tools that share no code with the writer: h5py, csv, json and an XML parser."""

import csv
import hashlib
import json
import os
import subprocess
import xml.etree.ElementTree as xml

import h5py
import numpy as np
import pytest


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    directory = tmp_path_factory.mktemp("runs")
    subprocess.run([os.environ["GRANVOF_WRITE_SAMPLE_RUN"], str(directory)], check=True)
    return directory


# name, cells (x, y, z), tank as shown (a slab of one cell is as thick as a cell is long), datasets beyond the contract's
RUNS = [("2d", (8, 5, 1), (0.4, 0.1, 0.05), []), ("3d", (4, 3, 2), (0.4, 0.3, 0.2), ["p_s"])]
AXES = ["z", "y", "x", "component"]


@pytest.mark.parametrize("name, cells, tank, more", RUNS)
def test_fields(runs, name, cells, tank, more):
    nx, ny, nz = cells
    n = nx * ny * nz
    with h5py.File(runs / name / "fields.h5", "r") as file:
        assert list(file.attrs["cells"]) == list(cells)
        assert np.allclose(file.attrs["spacing"], np.array(tank) / cells)
        assert list(file.attrs["origin"]) == [0, 0, 0]
        assert file.attrs["scene"] == b"sample" or file.attrs["scene"] == "sample"
        assert file.attrs["contract_version"] == 1
        assert list(file) == ["t0000", "t0001"]
        assert [file[t].attrs["time"] for t in file] == [0.0, 0.5]
        group = file["t0001"]
        assert sorted(group) == sorted(["f_s", "alpha", "p_c", "theta", "phi", "u_s", "u_c", *AXES, *more])
        first = 2.0
        for scalar in ["f_s", "alpha", "p_c", "theta", "phi"]:
            data = group[scalar]
            assert data.dtype == np.float32 and data.shape == (nz, ny, nx)
            assert data.compression == "gzip" and data.shuffle and data.chunks == (1, ny, nx)
            assert np.array_equal(data[...].ravel() * 1024, first + np.arange(n))
            first += n
        for vector in ["u_s", "u_c"]:
            assert group[vector].shape == (nz, ny, nx, 3)
            for d in range(3):
                component = group[vector][..., d].ravel() * 1024
                if d == 2 and nz == 1:
                    assert not component.any()
                else:
                    assert np.array_equal(component, first + np.arange(n))
                    first += n


@pytest.mark.parametrize("name, cells, tank, more", RUNS)
def test_each_dimension_has_its_axis(runs, name, cells, tank, more):
    with h5py.File(runs / name / "fields.h5", "r") as file:
        for group in file.values():
            for d, axis in enumerate("xyz"):
                assert h5py.h5ds.is_scale(group[axis].id) and group[axis].attrs["units"] == b"m"
                assert np.allclose(group[axis][...], (np.arange(cells[d]) + 0.5) * tank[d] / cells[d])
            for field in ["f_s", "alpha", "p_c", "theta", "phi", "u_s", "u_c", *more]:
                data = group[field]
                assert [data.dims[i].keys()[0] for i in range(data.ndim)] == AXES[:data.ndim]
                assert [data.dims[i][0] for i in range(data.ndim)] == [group[axis] for axis in AXES[:data.ndim]]
                assert data.attrs["long_name"]
            assert group["p_c"].attrs["units"] == b"Pa" and group["u_s"].attrs["units"] == b"m/s"


# Of a run that has finished, whose fields.h5 holds its instants itself.
@pytest.mark.parametrize("name, cells, tank, more", RUNS[:1])
def test_xarray_reads_an_instant_as_it_is(runs, name, cells, tank, more):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    with xarray.open_dataset(runs / name / "fields.h5", group="t0001", engine="h5netcdf") as data:
        assert data["f_s"].dims == ("z", "y", "x") and data["u_s"].dims == ("z", "y", "x", "component")
        assert data["p_c"].attrs["units"] == "Pa" and data["p_c"].attrs["long_name"] == "fluid pressure"
        assert np.isclose(float(data["x"][-1]), tank[0] * (1 - 0.5 / cells[0]))
        assert float(data["f_s"].sel(x=0, y=0, z=0, method="nearest")) * 1024 == 2.0
        assert data.attrs["time"] == 0.5


@pytest.mark.parametrize("name, cells, tank, more", RUNS)
def test_xdmf_describes_the_data(runs, name, cells, tank, more):
    root = xml.parse(runs / name / "fields.xdmf").getroot()
    grids = root.findall("./Domain/Grid/Grid")
    assert [float(grid.find("Time").get("Value")) for grid in grids] == [0.0, 0.5]
    for grid in grids:
        corners = [int(v) for v in grid.find("Topology").get("Dimensions").split()]
        assert corners == [n + 1 for n in reversed(cells)]
        origin, spacing = ([float(v) for v in item.text.split()] for item in grid.findall("Geometry/DataItem"))
        assert origin == [0, 0, 0]
        assert np.allclose(spacing, (np.array(tank) / cells)[::-1])
        attributes = grid.findall("Attribute")
        names = {attribute.get("Name") for attribute in attributes}
        assert names == {"f_s", "alpha", "p_c", "theta", "phi", "u_s", "u_c", *more}
        for attribute in attributes:
            assert attribute.get("Center") == "Cell"
            item = attribute.find("DataItem")
            file, dataset = item.text.strip().split(":")
            with h5py.File(runs / name / file, "r") as data:
                shape = data[dataset].shape
            assert [int(v) for v in item.get("Dimensions").split()] == list(shape)
            assert attribute.get("AttributeType") == ("Vector" if len(shape) == 4 else "Scalar")


@pytest.mark.parametrize("name", ["2d", "3d"])
def test_series_and_record(runs, name):
    with open(runs / name / "series.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0][0] == "time [s]"
    assert [row[0] for row in rows[1:]] == ["0", "0.5"]
    assert {len(row) for row in rows} == {len(rows[0])}
    text = (runs / name / "run.json").read_text()
    content, _, seal = text.rpartition(',\n  "sha256": "')
    assert seal == hashlib.sha256(content.encode()).hexdigest() + '"\n}\n'
    record = json.loads(text)
    assert record["exit"]["state"] == ("finished" if name == "2d" else "running")
