"""The converter of OpenFOAM cases, on cases made up here."""

import h5py
import numpy as np
import pytest

from lay import from_openfoam

BLOCK = """
scale 0.1;
vertices ( (0 0 0) (4 0 0) (4 2 0) (0 2 0) (0 0 1) (4 0 1) (4 2 1) (0 2 1) );
blocks ( hex (0 1 2 3 4 5 6 7) (4 2 1) simpleGrading (1 1 1) );
"""


def field(values, kind="scalar"):
    rows = "\n".join(str(value) if kind == "scalar" else "({} {} {})".format(*value) for value in values)
    return f"internalField   nonuniform List<{kind}> \n{len(values)}\n(\n{rows}\n)\n;\nboundaryField {{ top {{ value uniform 0; }} }}\n"


@pytest.fixture
def case(tmp_path):
    (tmp_path / "system").mkdir()
    (tmp_path / "system/blockMeshDict").write_text(BLOCK)
    for time in ("0", "0.5", "10"):
        (tmp_path / time).mkdir()
        (tmp_path / time / "alpha.water").write_text(field(range(8)))
        (tmp_path / time / "U").write_text(field([(i, -i, 0) for i in range(8)], "vector"))
        if time != "0":
            (tmp_path / time / "p").write_text("internalField   uniform 7;\n")
    (tmp_path / "constant").mkdir()
    return tmp_path


def test_fields_keep_their_place_and_order(case, tmp_path):
    assert from_openfoam.convert(case, tmp_path / "theirs.h5") == 3
    with h5py.File(tmp_path / "theirs.h5") as file:
        assert file.attrs["cells"].tolist() == [4, 2, 1]
        assert np.allclose(file.attrs["spacing"], 0.1)
        assert [file[name].attrs["time"] for name in file] == [0, 0.5, 10]
        assert file["t0001/alpha"][0, 1, 2] == 6  # x runs fastest
        assert file["t0001/u_c"][0, 1, 2].tolist() == [6, -6, 0]
        assert (file["t0002/p_c"][:] == 7).all() and (file["t0000/p_c"][:] == 0).all()
        assert (file["t0001/f_s"][:] == 0).all()


def test_where_there_are_parcels_the_solid_fraction_is_what_the_fluid_leaves(case, tmp_path):
    (case / "10/alphac").write_text(field([0.43] * 8))
    from_openfoam.convert(case, tmp_path / "theirs.h5")
    with h5py.File(tmp_path / "theirs.h5") as file:
        assert np.allclose(file["t0002/f_s"][:], 0.57)
        assert np.allclose(file["t0002/alpha"][0, 1, 2], 6)


def refusal(case):
    with pytest.raises(from_openfoam.CaseError) as error:
        from_openfoam.convert(case, case / "theirs.h5")
    return str(error.value)


def test_graded_or_many_blocks_are_refused(case):
    path = case / "system/blockMeshDict"
    path.write_text(BLOCK.replace("(1 1 1) );", "(1 2 1) );"))
    assert "simpleGrading (1 1 1)" in refusal(case)
    path.write_text(BLOCK.replace("blocks (", "blocks ( hex (0 1 2 3 4 5 6 7) (4 2 1) simpleGrading (1 1 1)"))
    assert "one block" in refusal(case)


def test_a_folder_that_is_no_case_is_named(tmp_path):
    assert "is missing" in refusal(tmp_path)


def test_no_output_times(case):
    for time in ("0", "0.5", "10"):
        (case / time / "U").unlink()
    assert "no output times" in refusal(case)


def test_a_field_of_another_size_or_in_binary_is_refused(case):
    (case / "0.5/alpha.water").write_text(field(range(7)))
    assert "7 numbers for 8 cells" in refusal(case)
    (case / "0.5/alpha.water").write_text("format binary;")
    assert "writeFormat ascii" in refusal(case)


def test_which_liquid_must_be_clear(case):
    (case / "0.5/alpha.water").rename(case / "0.5/alpha.oil")
    assert from_openfoam.convert(case, case / "theirs.h5") == 3
    (case / "0.5/alpha.air").write_text(field(range(8)))
    assert "one field alpha.* is needed, there are 2" in refusal(case)
