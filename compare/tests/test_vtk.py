"""The converter of VTK files, on files made up here in the layout of MFiX: tags, then big-endian single precision; no XML."""

import json
import re
import struct
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

from lay import from_vtk
from lay.their_fields import CaseError

ROOT = Path(__file__).resolve().parents[2]
DX = 0.1


def of_mfix(path, time, fields, cells=(4, 2), deep=False, swap=None, dx=DX):
    """A .vtu file of MFiX: squares of a plane (polygons), or cells with depth (convex point sets). `swap` puts two cells in other places."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    corners += [(x, y, 1) for x, y, _ in corners] if deep else []
    at = [(i, j, 0) for j in range(cells[1]) for i in range(cells[0])]
    if swap:
        at[swap[0]], at[swap[1]] = at[swap[1]], at[swap[0]]
    points = np.array([np.add(cell, corner) * dx for cell in at for corner in corners], dtype=">f4")
    ends = np.array([len(corners) * (i + 1) for i in range(len(at))], dtype=">i4")
    arrays = [("Points", "Float32", "coordinates", 3, points), ("Cells", "Int32", "connectivity", 1, np.arange(len(points), dtype=">i4")),
              ("Cells", "Int32", "offsets", 1, ends), ("Cells", "Int32", "types", 1, np.full(len(at), 41 if deep else 7, dtype=">i4"))]
    arrays += [("CellData", "Float32", name, 3 if np.ndim(values) == 2 else 1, np.array(values, dtype=">f4")) for name, values in fields.items()]
    tags, data, within = "", b"", None
    for place, kind, name, width, values in arrays:
        if place != within:
            tags += f"      </{within}>\n" * (within is not None) + f"      <{place}>\n"
        within = place
        components = ' NumberOfComponents="3"' if width == 3 else ""
        tags += f'        <DataArray type="{kind}" Name="{name}"{components} format="appended" offset="{len(data):12}" />\n'
        data += struct.pack(">i", values.nbytes) + values.tobytes()
    path.write_bytes((f'<?xml version="1.0"?>\n<!-- Time ={time:14.7E} sec. -->\n'
                      '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="BigEndian">\n  <UnstructuredGrid>\n'
                      f'    <Piece NumberOfPoints="{len(points):12}" NumberOfCells="{len(at):12}" >\n{tags}      </{within}>\n'
                      '    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding="raw">\n_').encode()
                     + data + b"\n  </AppendedData>\n</VTKFile>\n")


FIELDS = {"EP_G": [1 - 0.1 * i for i in range(8)], "P_G": [100 * i for i in range(8)], "Gas_Velocity": [(i, -i, 0) for i in range(8)],
          "Solids_Velocity_1": [(0, i, 0) for i in range(8)]}


@pytest.fixture
def run(tmp_path):
    folder = tmp_path / "run"
    folder.mkdir()
    for number, time in enumerate((0.0, 0.5, 10.0)):
        of_mfix(folder / f"BACK_{number:04}.vtu", time, FIELDS)
    return folder


def test_a_folder_is_read_in_the_order_of_time(run, tmp_path):
    (run / "BACK_0000.vtu").rename(run / "LAST.vtu")
    assert from_vtk.convert(run, tmp_path / "theirs.h5") == [
        "3 instants, 0 to 10 s, on 4 x 2 x 1 cells", "f_s is 1 - EP_G", "u_c is Gas_Velocity", "p_c is P_G", "u_s is Solids_Velocity_1",
        "alpha is not given: all is liquid between the grains"]
    with h5py.File(tmp_path / "theirs.h5") as file:
        assert file.attrs["cells"].tolist() == [4, 2, 1]
        assert np.allclose(file.attrs["spacing"], DX)
        assert [file[name].attrs["time"] for name in file] == [0, 0.5, 10]
        assert file["t0001/f_s"][0, 1, 2] == pytest.approx(0.6)  # x runs fastest
        assert file["t0001/u_c"][0, 1, 2].tolist() == [6, -6, 0] and file["t0001/u_s"][0, 1, 2].tolist() == [0, 6, 0]
        assert file["t0002/p_c"][0, 0, 3] == 300 and (file["t0002/alpha"][:] == 1).all() and (file["t0002/theta"][:] == 0).all()


def test_cells_are_placed_by_where_they_are(run, tmp_path):
    for file in run.iterdir():
        of_mfix(file, float(file.stem[-1]), FIELDS, deep=True, swap=(0, 6))
    from_vtk.convert(run, tmp_path / "theirs.h5")
    with h5py.File(tmp_path / "theirs.h5") as file:
        assert file["t0000/p_c"][0, 0, 0] == 600 and file["t0000/p_c"][0, 1, 2] == 0


def test_a_collection_says_the_times(run, tmp_path):
    (run / "BACK.pvd").write_text('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="BigEndian">\n<Collection>\n'
                                  '<DataSet timestep="0.1000000E+01" group="" part="0" file="BACK_0002.vtu"/>\n'
                                  '<DataSet timestep="0.5000000E+00" group="" part="0" file="BACK_0001.vtu"/>\n</Collection>\n</VTKFile>\n')
    assert from_vtk.convert(run / "BACK.pvd", tmp_path / "theirs.h5")[0].startswith("2 instants, 0.5 to 1 s")


def test_names_and_units_can_be_mapped(run, tmp_path):
    names = {"f_s": "1-EP_G [%]", "u_s": "Solids_Velocity_1 [cm/s]", "p_c": "P_G [dyn/cm2]", "x": "coordinates [cm]", "alpha": "EP_G"}
    for file in run.iterdir():
        of_mfix(file, float(file.stem[-1]), FIELDS | {"EP_G": [100 - 10 * i for i in range(8)]})
    said = from_vtk.convert(run, tmp_path / "theirs.h5", names)
    assert said[1:] == ["f_s is 1 - EP_G, times 0.01", "u_s is Solids_Velocity_1, times 0.01", "p_c is P_G, times 0.1", "alpha is EP_G",
                        "u_c is Gas_Velocity", "lengths are multiplied by 0.01"]
    with h5py.File(tmp_path / "theirs.h5") as file:
        assert np.allclose(file.attrs["spacing"], 0.01 * DX)
        assert file["t0000/u_s"][0, 1, 2].tolist() == pytest.approx([0, 0.06, 0]) and file["t0000/p_c"][0, 1, 2] == pytest.approx(60)
        assert file["t0000/f_s"][0, 1, 2] == pytest.approx(0.6)


def test_ascii_of_paraview(run, tmp_path):
    points = " ".join(f"{x} {y} {z}" for z in (0, 0.5) for y in (0, 0.5) for x in (0, 0.5, 1.0))
    cells = " ".join(str(corner + at) for at in (0, 1) for corner in (0, 1, 4, 3, 6, 7, 10, 9))
    (run / "one.vtu").write_text(f"""<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" header_type="UInt64"><UnstructuredGrid>
      <FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">3</DataArray></FieldData>
      <Piece NumberOfPoints="12" NumberOfCells="2">
      <Points><DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>
      <Cells><DataArray type="Int64" Name="connectivity" format="ascii">{cells}</DataArray>
      <DataArray type="Int64" Name="offsets" format="ascii">8 16</DataArray><DataArray type="UInt8" Name="types" format="ascii">12 12</DataArray></Cells>
      <CellData><DataArray type="Float64" Name="EP_G" format="ascii">0.5 1</DataArray>
      <DataArray type="Float64" Name="Gas_Velocity" NumberOfComponents="3" format="ascii">1 2 3 4 5 6</DataArray></CellData>
      </Piece></UnstructuredGrid></VTKFile>""")
    for file in run.glob("BACK*"):
        file.unlink()
    from_vtk.convert(run, tmp_path / "theirs.h5")
    with h5py.File(tmp_path / "theirs.h5") as file:
        assert file["t0000"].attrs["time"] == 3 and file["t0000/u_c"][0, 0, 1].tolist() == [4, 5, 6] and file["t0000/f_s"][0, 0, 0] == 0.5


def refusal(path, names=None):
    with pytest.raises(CaseError) as error:
        from_vtk.convert(path, path.parent / "theirs.h5", names)
    assert "\n" not in str(error.value) and len(str(error.value)) < 500
    return str(error.value)


def test_what_is_no_box_of_cells_is_refused(run):
    path = run / "BACK_0001.vtu"
    of_mfix(path, 0.5, {name: values[:7] for name, values in FIELDS.items()}, cells=(7, 1))
    assert "not those of BACK_0000.vtu" in refusal(run)
    whole = (run / "BACK_0000.vtu").read_bytes()
    for at, cause in ((whole.index(b"_\x00") + 5, "cells that fill one box"), (len(whole) - 400, "the file ends before its data")):
        damaged = whole[:at] + np.array(-0.03, ">f4").tobytes() + whole[at + 4:] if "box" in cause else whole[:at]
        (run / "BACK_0000.vtu").write_bytes(damaged)
        assert cause in refusal(run)


@pytest.mark.parametrize("was, now, cause", [
    (b'type="UnstructuredGrid"', b'type="PolyData"', "a .vtu file of cells is needed, it is of 'PolyData'"),
    (b'byte_order="BigEndian"', b'compressor="vtkZLibDataCompressor"', "its data are compressed"),
    (b'encoding="raw"', b'encoding="base64"', "ascii or appended raw"),
    (b"<?xml version=\"1.0\"?>", b"<!DOCTYPE a [<!ENTITY b 'b'>]>", "DOCTYPE"),
    (b"<!-- Time", b"<!-- Zeit", "it states no time; name the .pvd"),
    (b'NumberOfCells="           8"', b'NumberOfCells="           9"', "its cells are not what it says"),
    (b'offset="           0"', b'offset="          -9"', "the file ends before its data"),
    (b'type="Int32" Name="offsets"', b'type="Float80" Name="offsets"', "numbers are needed"),
    (b'"offsets"', b'"ends"', "'offsets'"),
    (b"</Piece>", b"", "mismatched tag"),
])
def test_a_file_of_another_kind_is_one_line(run, was, now, cause):
    path = run / "BACK_0001.vtu"
    whole = path.read_bytes()
    assert whole.count(was) == 1
    path.write_bytes(whole.replace(was, now))
    assert cause in refusal(run)


def test_a_field_that_is_not_there_or_not_what_it_should_be(run):
    assert "there is no EP_S; there are: EP_G, P_G, Gas_Velocity, Solids_Velocity_1" in refusal(run, {"f_s": "EP_S"})
    assert "P_G has not 3 numbers a cell" in refusal(run, {"u_c": "P_G"})
    assert "'speed' given; allowed: alpha, f_s" in refusal(run, {"speed": "P_G"})
    assert "'p_c' is given in 'm'; allowed: Pa, hPa" in refusal(run, {"p_c": "P_G [m]"})
    assert "only of a share" in refusal(run, {"p_c": "1-P_G"})
    of_mfix(run / "BACK_0001.vtu", 0.5, FIELDS | {"P_G": [float("nan")] * 8})
    assert "P_G is not finite" in refusal(run)
    of_mfix(run / "BACK_0000.vtu", 0, FIELDS | {"Solids_Velocity_2": FIELDS["Gas_Velocity"]})
    assert "Solids_Velocity_1, Solids_Velocity_2; --map u_s=NAME says which" in refusal(run)


def test_which_files_must_be_clear(run, tmp_path):
    (run / "AGAIN.vtu").write_bytes((run / "BACK_0001.vtu").read_bytes())
    assert "AGAIN.vtu and BACK_0001.vtu are of the same time 0.5" in refusal(run)
    assert "a .pvd file, or a folder" in refusal(run / "AGAIN.vtu")
    (tmp_path / "empty").mkdir()
    assert "there is no .vtu file" in refusal(tmp_path / "empty")
    (tmp_path / "bad.pvd").write_text("<VTKFile><Collection>")
    assert refusal(tmp_path / "bad.pvd")


def test_the_example_of_its_page(tmp_path):
    """Our own fields in MFiX's clothes lie where ours are."""
    run = tmp_path / "out/runs/canary"
    subprocess.run([ROOT / "build/release/solver/granvof", "run", ROOT / "cases/canary.toml", "--out", run], check=True, capture_output=True)
    with h5py.File(run / "fields.h5") as file:
        cells, dx = file.attrs["cells"], file.attrs["spacing"][0]
        times = {name: float(group.attrs["time"]) for name, group in file.items() if name.startswith("t0")}
        for name in times:
            group = file[name]
            of_mfix(tmp_path / f"BACKGROUND_{name[1:]}.vtu", times[name], cells=tuple(cells[:2]), dx=100 * dx, fields={
                "EP_G": 1 - group["f_s"][:].ravel(), "P_G": 10 * group["p_c"][:].ravel(), "Gas_Velocity": 100 * group["u_c"][:].reshape(-1, 3),
                "Solids_Velocity_1": 100 * group["u_s"][:].reshape(-1, 3)})
    listed = "".join(f'<DataSet timestep="{time:.7E}" group="" part="0" file="BACKGROUND_{name[1:]}.vtu"/>\n' for name, time in times.items())
    (tmp_path / "BACKGROUND.pvd").write_text(f'<?xml version="1.0"?>\n<VTKFile type="Collection">\n<Collection>\n{listed}</Collection>\n</VTKFile>\n')
    page = (ROOT / "compare/lay/README.md").read_text(encoding="utf-8")
    command, = re.findall(r"^```\n(compare/lay/lay [^`]*--vtk BACKGROUND.pvd [^`]*)^```", page, re.MULTILINE)
    done = subprocess.run(command.replace("compare/lay/lay", str(ROOT / "compare/lay/lay")), shell=True, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "understood: u_s is Solids_Velocity_1, times 0.01\n" in done.stdout and "understood: p_c is P_G, times 0.1\n" in done.stdout
    curves = {curve["name"]: curve for curve in json.loads((tmp_path / "out/lay/lay.json").read_text())["curves"]}
    for name in ("run_out", "run_out_dense", "excess_base_pressure"):
        assert curves[name]["theirs_at_end"] == pytest.approx(curves[name]["ours_at_end"], rel=1e-5)
