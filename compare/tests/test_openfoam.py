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
    assert from_openfoam.convert(case, tmp_path / "theirs.h5") == ["3 instants, 0 to 10 s, on 4 x 2 x 1 cells"]
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
    assert from_openfoam.convert(case, case / "theirs.h5")[0].startswith("3 instants")
    (case / "0.5/alpha.air").write_text(field(range(8)))
    assert "one field alpha.* is needed, there are 2" in refusal(case)


# Names of an Euler-Euler program: no free surface, a velocity each.
EULER = {"f_s": "alpha.a", "u_s": "U.a", "u_c": "U.b"}


def two_phases(case):
    for time in ("0", "0.5", "10"):
        (case / time / "alpha.water").unlink()
        (case / time / "U").rename(case / time / "U.b")
        (case / time / "alpha.a").write_text(field([0.1 * i for i in range(8)]))
        (case / time / "U.a").write_text(field([(0, i, 0) for i in range(8)], "vector"))


def test_names_can_be_mapped(case):
    two_phases(case)
    said = from_openfoam.convert(case, case / "theirs.h5", EULER)
    assert said == ["3 instants, 0 to 10 s, on 4 x 2 x 1 cells", "f_s is alpha.a", "u_s is U.a", "u_c is U.b",
                    "no other alpha.*: all is liquid between the grains"]
    with h5py.File(case / "theirs.h5") as file:
        assert file["t0001/f_s"][0, 1, 2] == pytest.approx(0.6)
        assert file["t0001/u_s"][0, 1, 2].tolist() == [0, 6, 0]
        assert file["t0001/u_c"][0, 1, 2].tolist() == [6, -6, 0]
        assert (file["t0001/alpha"][:] == 1).all()


def test_grains_are_what_the_share_of_the_fluid_leaves(case):
    for time in ("0", "0.5", "10"):
        (case / time / "voidfraction").write_text(field([1 - 0.1 * i for i in range(8)]))
        (case / time / "Us").write_text(field([(0, i, 0) for i in range(8)], "vector"))
    said = from_openfoam.convert(case, case / "theirs.h5", {"f_s": "1-voidfraction", "u_s": "Us [cm/s]"})
    assert said[1:] == ["f_s is 1 - voidfraction", "u_s is Us, times 0.01"]
    with h5py.File(case / "theirs.h5") as file:
        assert file["t0001/f_s"][0, 1, 2] == pytest.approx(0.6)
        assert file["t0001/u_s"][0, 1, 2].tolist() == pytest.approx([0, 0.06, 0])


def refused_map(case, names):
    with pytest.raises(from_openfoam.CaseError) as error:
        from_openfoam.convert(case, case / "theirs.h5", names)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_a_name_that_is_not_there_is_refused(case):
    two_phases(case)
    assert "alpha.sand is missing; there are: U.a, U.b, alpha.a" in refused_map(case, EULER | {"f_s": "alpha.sand"})
    assert "'speed' given; allowed: alpha, f_s" in refused_map(case, {"speed": "U.a"})
    assert "no output times with U.c" in refused_map(case, EULER | {"u_c": "U.c"})


def test_text_where_a_number_belongs_is_one_line(case):
    (case / "0.5/alpha.water").write_text(field(range(7)).replace("3", "three") + "x")
    assert "three" in refused_map(case, {}) or "numbers for" in refused_map(case, {})
    (case / "0.5/alpha.water").write_bytes(b"\xff\xfe\x00\x01")
    assert refused_map(case, {})
