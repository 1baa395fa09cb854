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


# name, cells (x, y, z), tank, datasets beyond the contract's
RUNS = [("2d", (8, 5, 1), (0.4, 0.1, 0.1), []), ("3d", (4, 3, 2), (0.4, 0.3, 0.2), ["p_s"])]


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
        assert sorted(group) == sorted(["f_s", "alpha", "p_c", "theta", "phi", "u_s", "u_c", *more])
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
